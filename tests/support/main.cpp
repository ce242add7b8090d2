// Runs the tests of a program. With VSPRING_SHARED_WORK=FILE it adds a line to that file for each test that shared work
// among threads: its name, its time in milliseconds, and the kinds of work.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <mutex>
#include <set>
#include <string>
#include <typeinfo>
#include <utility>

#include "base/threads.hpp"

namespace {

std::mutex kinds_mutex;
std::set<std::string> kinds;

void note_kind(const std::type_info& work) {
  const std::lock_guard lock(kinds_mutex);
  kinds.insert(work.name());
}

class SharedWork : public ::testing::EmptyTestEventListener {
 public:
  explicit SharedWork(std::string path) : path_(std::move(path)) { vspring::ThreadTeam::watch(note_kind); }

  void OnTestStart(const ::testing::TestInfo& /*test*/) override { kinds.clear(); }

  void OnTestEnd(const ::testing::TestInfo& test) override {
    if (kinds.empty()) return;
    std::string line =
        std::string(test.test_suite_name()) + '.' + test.name() + ' ' + std::to_string(test.result()->elapsed_time());
    for (const std::string& kind : kinds) line += ' ' + kind;
    std::ofstream(path_, std::ios::app) << line + '\n';
  }

 private:
  std::string path_;
};

}  // namespace

int main(int argc, char** argv) {
  // By default properties are tested on few shapes from one seed.
  setenv("RC_PARAMS", "seed=1 max_success=30", 0);
  ::testing::InitGoogleTest(&argc, argv);
  if (const char* path = std::getenv("VSPRING_SHARED_WORK"))
    ::testing::UnitTest::GetInstance()->listeners().Append(new SharedWork(path));
  return RUN_ALL_TESTS();
}
