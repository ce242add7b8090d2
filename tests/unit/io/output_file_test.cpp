#include "vspring/output_file.hpp"

#include <fcntl.h>
#include <linux/capability.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <thread>

#include "unit/io/scratch.hpp"
#include "vspring/surface_file.hpp"

namespace vspring::output_file_test {
namespace {

namespace fs = std::filesystem;

class OutputFile : public Scratch {};

TEST_F(OutputFile, TakesThePlaceOfWhatWasThere) {
  write_file(path("new"), "one");
  EXPECT_EQ(get("new"), "one");
  write_file(path("new"), "");
  EXPECT_EQ(get("new"), "");
  write_file(path("new"), std::string("\0two", 4));
  EXPECT_EQ(get("new"), std::string("\0two", 4));
  EXPECT_EQ(files(), (std::set<std::string>{"new"}));
}

TEST_F(OutputFile, HasThePermissionsOfTheOldFileOrOfAnyNewOne) {
  put("old", "text");
  ::chmod(path("old").c_str(), 0640);
  write_file(path("old"), "more");
  EXPECT_EQ(fs::status(path("old")).permissions(), fs::perms(0640));
  write_file(path("new"), "more");
  put("usual", "");
  EXPECT_EQ(fs::status(path("new")).permissions(), fs::status(path("usual")).permissions());
}

TEST_F(OutputFile, FollowsLinks) {
  fs::create_directory(path("there"));
  put("there/file", "text");
  fs::create_symlink("there/file", path("link"));
  fs::create_symlink(path("link"), path("link of link"));
  write_file(path("link of link"), "more");
  EXPECT_TRUE(fs::is_symlink(path("link")));
  EXPECT_TRUE(fs::is_symlink(path("link of link")));
  EXPECT_EQ(get("there/file"), "more");
  fs::create_symlink("there/later", path("loose"));
  write_file(path("loose"), "late");
  EXPECT_TRUE(fs::is_symlink(path("loose")));
  EXPECT_EQ(get("there/later"), "late");
  fs::create_symlink("round", path("round"));
  EXPECT_NE(message_of([&] { write_file(path("round"), "x"); }).find("round: cannot be written: Too many levels"),
            std::string::npos);
}

TEST_F(OutputFile, LeavesNothingWhereItCannotBe) {
  EXPECT_EQ(message_of([&] { write_file(path("none/file"), "x"); }).substr(0, 54),
            "none/file: cannot be written: No such file or director");
  EXPECT_EQ(message_of([&] { write_file(path("."), "x"); }).substr(0, 39), ".: cannot be written: Is a directory; g");
  put("file", "text");
  EXPECT_NE(message_of([&] { write_file(path("file/more"), "x"); }).find("Not a directory;"), std::string::npos);
  EXPECT_EQ(files(), (std::set<std::string>{"file"}));
  EXPECT_EQ(get("file"), "text");
}

TEST_F(OutputFile, IsRefusedBeforehandWhereItCannotBe) {
  put("file", "text");
  fs::create_symlink("none/file", path("loose"));
  for (const std::string name : {"none/file", "file/more", ".", "loose"}) {
    const std::string refused = message_of([&] { write_file(path(name), "x"); });
    EXPECT_EQ(message_of([&] { check_writable(path(name)); }), refused);
  }
  for (const std::string name : {"file", "new"}) check_writable(path(name));
  check_writable("-");
  EXPECT_EQ(files(), (std::set<std::string>{"file", "loose"}));
  EXPECT_EQ(get("file"), "text");
}

TEST_F(OutputFile, LeavesTheOldFileWhenTheNewOneDoesNotFit) {
  put("file", "text");
  rlimit before{};
  ASSERT_EQ(::getrlimit(RLIMIT_FSIZE, &before), 0);
  const auto handler = std::signal(SIGXFSZ, SIG_IGN);
  const rlimit small{4096, before.rlim_max};
  ASSERT_EQ(::setrlimit(RLIMIT_FSIZE, &small), 0);
  const std::string over = message_of([&] { write_file(path("file"), std::string(100'000, 'x')); });
  const std::string fresh = message_of([&] { write_file(path("other"), std::string(100'000, 'x')); });
  ::setrlimit(RLIMIT_FSIZE, &before);
  std::signal(SIGXFSZ, handler);
  EXPECT_EQ(over, "file: cannot be written: File too large; make room or choose another place");
  EXPECT_EQ(fresh, "other: cannot be written: File too large; make room or choose another place");
  EXPECT_EQ(files(), (std::set<std::string>{"file"}));
  EXPECT_EQ(get("file"), "text");
}

TEST_F(OutputFile, NamesAFullDevice) {
  if (!fs::exists("/dev/full")) GTEST_SKIP();
  EXPECT_EQ(message_of([&] { write_file("/dev/full", "x"); }),
            "/dev/full: cannot be written: No space left on device; make room or choose another place");
  MeshBuilder builder;
  for (int k = 0; k < 3; ++k) builder.add_node({1.0 * k, 1.0 * k * k, 0});
  builder.add_face({0, 1, 2});
  const PolygonMesh mesh = builder.take();
  for (const SurfaceFormat format : {SurfaceFormat::obj, SurfaceFormat::off, SurfaceFormat::ply, SurfaceFormat::stl})
    EXPECT_NE(message_of([&] { write_surface("/dev/full", mesh, format); }).find("No space left"), std::string::npos);
  fs::create_symlink("/dev/full", path("link"));
  EXPECT_NE(message_of([&] { write_file(path("link"), "x"); }).find("No space left"), std::string::npos);
  EXPECT_TRUE(fs::is_character_file("/dev/full"));
}

TEST_F(OutputFile, MayBeAPipe) {
  ASSERT_EQ(::mkfifo(path("pipe").c_str(), 0600), 0);
  std::string received;
  std::thread reader([&] { received = get("pipe"); });
  check_writable(path("pipe"));
  write_file(path("pipe"), "through");
  reader.join();
  EXPECT_EQ(received, "through");
  EXPECT_TRUE(fs::is_fifo(path("pipe")));
}

/// Runs something in a thread that may write only what permissions let it, whoever owns the process.
template <typename Act>
void without_privilege(const Act& act) {
  std::thread([&] {
    __user_cap_header_struct header{_LINUX_CAPABILITY_VERSION_3, 0};
    std::array<__user_cap_data_struct, _LINUX_CAPABILITY_U32S_3> rights{};
    ASSERT_EQ(::syscall(SYS_capget, &header, rights.data()), 0);
    rights[0].effective &= ~(1U << CAP_DAC_OVERRIDE);
    rights[0].permitted &= ~(1U << CAP_DAC_OVERRIDE);
    ASSERT_EQ(::syscall(SYS_capset, &header, rights.data()), 0);
    act();
  }).join();
}

TEST_F(OutputFile, RespectsFilesThatMayNotBeWritten) {
  put("fixed", "text");
  ::chmod(path("fixed").c_str(), 0444);
  without_privilege([&] {
    EXPECT_NE(message_of([&] { write_file(path("fixed"), "x"); }).find("Permission denied"), std::string::npos);
    EXPECT_NE(message_of([&] { check_writable(path("fixed")); }).find("Permission denied"), std::string::npos);
  });
  EXPECT_EQ(get("fixed"), "text");
}

TEST_F(OutputFile, RespectsFoldersThatMayNotBeWritten) {
  fs::create_directory(path("locked"));
  put("locked/file", "text");
  ::chmod(path("locked").c_str(), 0555);
  without_privilege([&] {
    for (const std::string name : {"locked/file", "locked/new"}) {
      const std::string refused =
          name + ": cannot be written: Permission denied; check its permissions or choose another place";
      EXPECT_EQ(message_of([&] { write_file(path(name), "x"); }), refused);
      EXPECT_EQ(message_of([&] { check_writable(path(name)); }), refused);
    }
  });
  ::chmod(path("locked").c_str(), 0755);
  EXPECT_EQ(get("locked/file"), "text");
  EXPECT_EQ(std::distance(fs::directory_iterator(path("locked")), fs::directory_iterator()), 1);
}

/// Puts a file in place of an open one while it lives.
class Redirected {
 public:
  Redirected(int number, const std::string& path, int flags) : number_(number), kept_(::dup(number)) {
    const int file = ::open(path.c_str(), flags, 0600);
    ::dup2(file, number);
    ::close(file);
  }
  ~Redirected() {
    ::dup2(kept_, number_);
    ::close(kept_);
  }
  Redirected(const Redirected&) = delete;
  Redirected& operator=(const Redirected&) = delete;

 private:
  int number_;
  int kept_;
};

TEST_F(OutputFile, StandardInputAndOutputAreFilesToo) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  put("in", text);
  {
    const Redirected in(STDIN_FILENO, path("in"), O_RDONLY);
    const Redirected out(STDOUT_FILENO, path("out"), O_WRONLY | O_CREAT);
    const SurfaceFile surface = read_surface("-");
    write_surface("-", surface, surface.mesh.positions());
    write_file("/dev/stdout", "and ");
    write_surface("-", surface, surface.mesh.positions(), SurfaceFormat::off);
  }
  EXPECT_EQ(get("out"), text + "and OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n");
  const Redirected in(STDIN_FILENO, "/dev/null", O_RDONLY);
  EXPECT_EQ(message_of([&] { std::ignore = read_surface("-"); }), "standard input: is empty; choose another file");
}

}  // namespace
}  // namespace vspring::output_file_test
