#include "browser.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include "vspring/error.hpp"
#include "vspring/output_file.hpp"

namespace vspring::cli {

namespace {

/// The path of the first of these programs in PATH.
std::optional<std::string> find_program(std::initializer_list<const char*> names) {
  const char* paths = std::getenv("PATH");
  if (paths == nullptr) return std::nullopt;
  for (const char* name : names) {
    for (std::string_view rest = paths; !rest.empty();) {
      const std::size_t end = rest.find(':');
      const std::string program = std::string(rest.substr(0, end)) + "/" + name;
      if (access(program.c_str(), X_OK) == 0) return program;
      rest = end == std::string_view::npos ? std::string_view() : rest.substr(end + 1);
    }
  }
  return std::nullopt;
}

[[noreturn]] void fail(const std::string& browser, const std::string& what) {
  throw Error(ErrorCode::unusable_file, fmt::format("{}, which draws the picture: {}", browser, what));
}

/// A folder for one run of the browser.
class Folder {
 public:
  explicit Folder(const std::string& browser) {
    std::error_code none;
    std::string name = (std::filesystem::temp_directory_path(none) / "vspring-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) fail(browser, fmt::format("no folder {}: {}", name, std::strerror(errno)));
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  [[nodiscard]] std::string inside(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

/// A program whose standard output is read. It leads a process group that ends with this object.
class Child {
 public:
  explicit Child(const std::vector<std::string>& command) {
    std::array<int, 2> ends{};
    if (pipe2(ends.data(), O_CLOEXEC) != 0) fail(command.front(), std::strerror(errno));
    output_ = ends[0];
    posix_spawn_file_actions_t files;
    posix_spawn_file_actions_init(&files);
    posix_spawn_file_actions_addopen(&files, 0, "/dev/null", O_RDONLY, 0);
    posix_spawn_file_actions_adddup2(&files, ends[1], 1);
    posix_spawn_file_actions_addopen(&files, 2, "/dev/null", O_WRONLY, 0);
    // A process group of its own: Ctrl-C goes to this program, which then ends the browser with all its processes.
    posix_spawnattr_t attributes;
    posix_spawnattr_init(&attributes);
    posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP);
    posix_spawnattr_setpgroup(&attributes, 0);
    std::vector<std::string> words = command;
    std::vector<char*> arguments;
    arguments.reserve(words.size() + 1);
    for (std::string& word : words) arguments.push_back(word.data());
    arguments.push_back(nullptr);
    const int fault = posix_spawn(&process_, arguments[0], &files, &attributes, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
    close(ends[1]);
    if (fault == 0) return;
    close(output_);
    fail(command.front(), std::strerror(fault));
  }
  ~Child() {
    kill(-process_, SIGKILL);
    close(output_);
    waitpid(process_, nullptr, 0);
  }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// All output until the program ends or the context is cancelled.
  [[nodiscard]] std::string read_all(const Context& context) const {
    std::string text;
    std::array<char, 65536> buffer{};
    while (!context.cancelled()) {
      pollfd waiting = {.fd = output_, .events = POLLIN, .revents = 0};
      constexpr int milliseconds = 100;
      if (poll(&waiting, 1, milliseconds) <= 0) continue;
      const ssize_t size = read(output_, buffer.data(), buffer.size());
      if (size < 0 && errno == EINTR) continue;
      if (size <= 0) break;
      text.append(buffer.data(), static_cast<std::size_t>(size));
    }
    return text;
  }

 private:
  pid_t process_ = 0;
  int output_ = -1;
};

}  // namespace

std::optional<std::string> find_browser() {
  return find_program({"chromium-headless-shell", "chromium", "chromium-browser", "google-chrome"});
}

std::string loaded_document(const std::string& browser, const std::string& page, const Context& context) {
  const Folder folder(browser);
  const std::string path = folder.inside("page.html");
  write_file(path, page);
  // The sandbox needs rights that containers lack; the page is our own and loads nothing from outside.
  const Child child({browser, "--headless", "--no-sandbox", "--use-gl=angle", "--use-angle=swiftshader",
                     "--enable-unsafe-swiftshader", "--disable-dev-shm-usage", "--no-first-run", "--disable-extensions",
                     "--disable-background-networking", "--disable-crash-reporter", "--force-device-scale-factor=1",
                     "--user-data-dir=" + folder.inside("profile"), "--dump-dom", "file://" + path});
  return child.read_all(context);
}

bool open_in_browser(std::string address) {
  std::optional<std::string> program = find_program({"xdg-open", "open"});
  if (!program) return false;
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  for (const int stream : {0, 1, 2}) posix_spawn_file_actions_addopen(&files, stream, "/dev/null", O_RDWR, 0);
  // Ctrl-C for this program must not end the browser, which otherwise takes signals as usual.
  posix_spawnattr_t attributes;
  posix_spawnattr_init(&attributes);
  posix_spawnattr_setflags(&attributes, POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  posix_spawnattr_setpgroup(&attributes, 0);
  sigset_t signals;
  sigemptyset(&signals);
  posix_spawnattr_setsigmask(&attributes, &signals);
  sigaddset(&signals, SIGPIPE);
  posix_spawnattr_setsigdefault(&attributes, &signals);
  std::array<char*, 3> words = {program->data(), address.data(), nullptr};
  pid_t process = 0;
  const int fault = posix_spawn(&process, program->c_str(), &files, &attributes, words.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  posix_spawnattr_destroy(&attributes);
  return fault == 0;
}

}  // namespace vspring::cli
