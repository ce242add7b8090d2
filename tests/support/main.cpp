// Runs the tests of a program. With VSPRING_THREADED_TESTS=FILE the names of those that ran on several threads are
// added to that file: these are for the thread sanitizer.

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <string>
#include <utility>

#include "base/threads.hpp"

namespace {

class ThreadedTests : public ::testing::EmptyTestEventListener {
 public:
  explicit ThreadedTests(std::string path) : path_(std::move(path)) {}

  void OnTestStart(const ::testing::TestInfo& /*test*/) override {
    calls_before_ = vspring::ThreadTeam::calls_for_help();
  }

  void OnTestEnd(const ::testing::TestInfo& test) override {
    if (vspring::ThreadTeam::calls_for_help() == calls_before_) return;
    std::ofstream(path_, std::ios::app) << test.test_suite_name() << '.' << test.name() << '\n';
  }

 private:
  std::string path_;
  std::size_t calls_before_ = 0;
};

}  // namespace

int main(int argc, char** argv) {
  // What properties are tried on is drawn from one seed, and not for long, unless whoever runs this says otherwise.
  setenv("RC_PARAMS", "seed=1 max_success=30", 0);
  ::testing::InitGoogleTest(&argc, argv);
  if (const char* path = std::getenv("VSPRING_THREADED_TESTS"))
    ::testing::UnitTest::GetInstance()->listeners().Append(new ThreadedTests(path));
  return RUN_ALL_TESTS();
}
