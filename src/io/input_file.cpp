#include "io/input_file.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>

#include "io/errno_error.hpp"
#include "io/file_descriptor.hpp"
#include "vspring/error.hpp"

namespace vspring {
namespace {

void read_all(int number, InputFile& file) {
  struct stat status {};
  if (::fstat(number, &status) != 0) refuse_file(file.name, "read", errno);
  if (S_ISDIR(status.st_mode)) refuse_file(file.name, "read", EISDIR);
  // One byte more than the size, so that the end is seen without growing.
  std::size_t room = S_ISREG(status.st_mode) ? static_cast<std::size_t>(status.st_size) + 1 : std::size_t{1} << 16;
  std::size_t filled = 0;
  for (;;) {
    file.bytes.resize(std::max(room, file.bytes.size()));
    const ssize_t count = ::read(number, file.bytes.data() + filled, file.bytes.size() - filled);
    if (count < 0) {
      if (errno == EINTR) continue;
      refuse_file(file.name, "read", errno);
    }
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
    if (filled == file.bytes.size()) room = 2 * filled;
  }
  file.bytes.resize(filled);
}

}  // namespace

std::size_t InputFile::line_of(std::size_t offset) const {
  const std::string_view before = std::string_view(bytes).substr(0, offset);
  const auto count = [&](char end) { return static_cast<std::size_t>(std::count(before.begin(), before.end(), end)); };
  return 1 + (bytes.find('\n') == std::string::npos ? count('\r') : count('\n'));
}

void InputFile::refuse(std::string_view what) const {
  throw Error(ErrorCode::unusable_file, fmt::format("{}: {}", name, what));
}

void InputFile::refuse_line(std::size_t offset, std::string_view what) const {
  throw Error(ErrorCode::unusable_file, fmt::format("{}:{}: {}", name, line_of(offset), what));
}

InputFile read_input(const std::string& path) {
  InputFile file;
  if (path == "-") {
    file.name = "standard input";
    read_all(STDIN_FILENO, file);
  } else {
    file.name = path;
    const FileDescriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
    if (!descriptor.valid()) refuse_file(path, "read", errno);
    read_all(descriptor.number(), file);
  }
  if (file.bytes.empty()) file.refuse("is empty; choose another file");
  return file;
}

}  // namespace vspring
