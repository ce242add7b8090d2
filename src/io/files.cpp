// Calls of the system: reads whole files, and writes them whole or not at all.
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <filesystem>
#include <optional>
#include <system_error>
#include <utility>

#include "io/input_file.hpp"
#include "vspring/error.hpp"
#include "vspring/input_file.hpp"
#include "vspring/output_file.hpp"

namespace vspring {
namespace {

const char* advice(int number) {
  switch (number) {
    case ENOENT:
    case ENOTDIR:
      return "; check the path, its folders have to exist";
    case EISDIR:
      return "; give the path of a file";
    case EACCES:
    case EPERM:
    case EROFS:
      return "; check its permissions or choose another place";
    case ENOSPC:
    case EDQUOT:
    case EFBIG:
      return "; make room or choose another place";
    default:
      return "; choose another file";
  }
}

/// Throws Error(unusable_file): "NAME: cannot be WHAT: the system's reason; what to do". number: a value of errno.
[[noreturn]] void refuse_file(const std::string& name, const char* what, int number) {
  throw Error(ErrorCode::unusable_file, fmt::format("{}: cannot be {}: {}{}", name.empty() ? "\"\"" : name, what,
                                                    std::generic_category().message(number), advice(number)));
}

/// Owns an open file.
class FileDescriptor {
 public:
  explicit FileDescriptor(int number) : number_(number) {}
  ~FileDescriptor() {
    if (number_ >= 0) ::close(number_);
  }
  FileDescriptor(const FileDescriptor&) = delete;
  FileDescriptor& operator=(const FileDescriptor&) = delete;

  [[nodiscard]] bool valid() const noexcept { return number_ >= 0; }
  [[nodiscard]] int number() const noexcept { return number_; }
  /// False, with errno set, if the system could not keep the bytes written.
  [[nodiscard]] bool close() noexcept { return ::close(std::exchange(number_, -1)) == 0; }

 private:
  int number_;
};

/// Reads the whole of an open file; refuses one that changes meanwhile. A pipe or device has no size and may never end,
/// so it is read up to a limit.
std::string read_all(int number, const std::string& name) {
  constexpr std::size_t most_without_size = std::size_t{1} << 30;
  struct stat before {};
  if (::fstat(number, &before) != 0) refuse_file(name, "read", errno);
  if (S_ISDIR(before.st_mode)) refuse_file(name, "read", EISDIR);
  const std::size_t size = S_ISREG(before.st_mode) ? static_cast<std::size_t>(before.st_size) : 0;
  const std::size_t most = std::max(size, most_without_size);
  // One byte more than the size, so the end is found without growing the buffer.
  std::size_t room = size > 0 ? size + 1 : std::size_t{1} << 16;
  std::string bytes;
  std::size_t filled = 0;
  for (;;) {
    bytes.resize(std::max(room, bytes.size()));
    const ssize_t count = ::read(number, bytes.data() + filled, bytes.size() - filled);
    if (count < 0) {
      if (errno == EINTR) continue;
      refuse_file(name, "read", errno);
    }
    if (count == 0) break;
    filled += static_cast<std::size_t>(count);
    if (filled > most)
      throw Error(ErrorCode::unusable_file, fmt::format("{}: gives more than 1 GiB; save it as a file", name));
    if (filled == bytes.size()) room = std::min(2 * filled, most + 1);
  }
  bytes.resize(filled);
  struct stat after {};
  if (::fstat(number, &after) != 0) refuse_file(name, "read", errno);
  const bool same = after.st_size == before.st_size && after.st_mtim.tv_sec == before.st_mtim.tv_sec &&
                    after.st_mtim.tv_nsec == before.st_mtim.tv_nsec;
  if (S_ISREG(before.st_mode) && !same)
    throw Error(ErrorCode::unusable_file, fmt::format("{}: was changed while it was read; try again", name));
  return bytes;
}

namespace fs = std::filesystem;

constexpr const char* written = "written";

/// False, with errno set, if not all bytes could be written.
bool write_all(int number, std::string_view bytes) {
  while (!bytes.empty()) {
    const ssize_t count = ::write(number, bytes.data(), bytes.size());
    if (count < 0) {
      if (errno == EINTR) continue;
      return false;
    }
    bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return true;
}

/// False, with errno set, if the system could not flush a file or folder to its disk; true on file systems that cannot
/// flush.
bool reaches_the_disk(int number) {
  while (::fsync(number) != 0) {
    if (errno == EINTR) continue;
    return errno == EINVAL || errno == ENOTSUP || errno == EROFS;
  }
  return true;
}

void write_directly(const std::string& path, std::string_view bytes) {
  FileDescriptor target(::open(path.c_str(), O_WRONLY | O_CLOEXEC | O_TRUNC));
  if (!target.valid() || !write_all(target.number(), bytes) || !target.close()) refuse_file(path, written, errno);
}

/// The file that symbolic links lead to, whether it exists or not; nothing for links into /proc, which stand for open
/// files, not for paths.
std::optional<fs::path> followed(const std::string& path) {
  constexpr int most_links = 40;
  fs::path place = path;
  for (int links = 0; links < most_links; ++links) {
    std::error_code fault;
    if (!fs::is_symlink(fs::symlink_status(place, fault))) return place;
    const fs::path folder = fs::canonical(place.has_parent_path() ? place.parent_path() : ".", fault);
    if (!fault && folder.native().starts_with("/proc/")) return std::nullopt;
    place = place.parent_path() / fs::read_symlink(place, fault);
    if (fault) refuse_file(path, written, fault.value());
  }
  refuse_file(path, written, ELOOP);
}

/// A new file beside `target`, removed again unless it is moved to its place.
class TemporaryFile {
 public:
  TemporaryFile(const fs::path& target, const std::string& name) {
    static std::atomic<unsigned> counter = 0;
    for (;;) {
      path_ = target.parent_path() / fmt::format(".vspring-{}-{}.tmp", ::getpid(), counter++);
      // The mode of any new file: the system applies the umask.
      number_ = ::open(path_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
      if (number_ >= 0) return;
      if (errno != EEXIST) refuse_file(name, written, errno);
    }
  }
  ~TemporaryFile() {
    if (!path_.empty()) ::unlink(path_.c_str());
  }
  TemporaryFile(const TemporaryFile&) = delete;
  TemporaryFile& operator=(const TemporaryFile&) = delete;

  [[nodiscard]] int number() const noexcept { return number_; }
  [[nodiscard]] bool move_to(const fs::path& target) {
    if (::rename(path_.c_str(), target.c_str()) != 0) return false;
    path_.clear();
    return true;
  }

 private:
  fs::path path_;
  int number_ = -1;
};

void write_beside(const std::string& path, const fs::path& target, const struct stat* before, std::string_view bytes) {
  TemporaryFile temporary(target, path);
  FileDescriptor descriptor(temporary.number());
  if (!write_all(descriptor.number(), bytes)) refuse_file(path, written, errno);
  if (before != nullptr) {
    // Only privileged users can keep another owner. Owner first, as changing it can clear mode bits.
    const bool owner_kept = ::fchown(descriptor.number(), before->st_uid, before->st_gid) == 0;
    const mode_t mode = before->st_mode & (owner_kept ? 07777 : 0777);
    if (::fchmod(descriptor.number(), mode) != 0) refuse_file(path, written, errno);
  }
  // The bytes reach the disk before the name, so a power cut leaves the old file or the new one.
  if (!reaches_the_disk(descriptor.number()) || !descriptor.close() || !temporary.move_to(target))
    refuse_file(path, written, errno);
  // A folder that cannot be flushed is no reason to fail: the file is there.
  const fs::path parent = target.parent_path();
  const FileDescriptor folder(::open(parent.empty() ? "." : parent.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (folder.valid()) (void)reaches_the_disk(folder.number());
}

/// Where a file is written, and whether a file is there already.
struct Place {
  std::optional<fs::path> target;  ///< nothing: what is at the path is written directly
  struct stat status {};
  bool exists = false;
};

/// Throws if the path cannot be written, as far as that can be known without a new file.
Place place_of(const std::string& path) {
  Place place;
  place.exists = ::stat(path.c_str(), &place.status) == 0;
  if (place.exists && S_ISDIR(place.status.st_mode)) refuse_file(path, written, EISDIR);
  place.target = followed(path);
  if (place.exists && !S_ISREG(place.status.st_mode)) place.target.reset();
  // Renaming would replace even a write-protected file.
  if (place.exists && ::access(path.c_str(), W_OK) != 0) refuse_file(path, written, errno);
  return place;
}

bool is_standard_output(const std::string& path) { return path == "-" || path == "/dev/stdout"; }

}  // namespace

std::size_t InputFile::line_of(std::size_t offset) const {
  const std::string_view before = std::string_view(bytes).substr(0, offset);
  const auto count = [&](char end) { return static_cast<std::size_t>(std::count(before.begin(), before.end(), end)); };
  return 1 + (bytes.find('\n') == std::string::npos ? count('\r') : count('\n'));
}

void InputFile::refuse(std::string_view fault, std::vector<Advice> advice) const {
  throw Error(ErrorCode::unusable_file, fmt::format("{}: {}", name, fault), std::move(advice));
}

void InputFile::refuse_line(std::size_t offset, std::string_view fault, std::vector<Advice> advice) const {
  throw Error(ErrorCode::unusable_file, fmt::format("{}:{}: {}", name, line_of(offset), fault), std::move(advice));
}

void require_utf8(const InputFile& file) {
  const std::string_view bytes = file.bytes;
  if (bytes.starts_with("\xFE\xFF") || bytes.starts_with("\xFF\xFE") ||
      (bytes.size() > 1 && (bytes[0] == '\0' || bytes[1] == '\0')))
    file.refuse("is in UTF-16; save it in UTF-8");
}

InputFile input_of(std::string bytes, const std::string& name) {
  InputFile file{name, std::move(bytes)};
  if (file.bytes.empty()) file.refuse("is empty; choose another file");
  return file;
}

InputFile read_input(const std::string& path) {
  if (path == "-") {
    constexpr const char* name = "standard input";
    return input_of(read_all(STDIN_FILENO, name), name);
  }
  return input_of(read_file(path), path);
}

std::string read_file(const std::string& path) {
  const FileDescriptor descriptor(::open(path.c_str(), O_RDONLY | O_CLOEXEC));
  if (!descriptor.valid()) refuse_file(path, "read", errno);
  return read_all(descriptor.number(), path);
}

void check_writable(const std::string& path) {
  if (is_standard_output(path)) return;
  const Place place = place_of(path);
  if (!place.target) return;
  const TemporaryFile temporary(*place.target, path);
  const FileDescriptor closing(temporary.number());
}

void write_file(const std::string& path, std::string_view bytes) {
  if (is_standard_output(path)) {
    if (!write_all(STDOUT_FILENO, bytes)) refuse_file("standard output", written, errno);
    return;
  }
  const Place place = place_of(path);
  if (!place.target) return write_directly(path, bytes);
  write_beside(path, *place.target, place.exists ? &place.status : nullptr, bytes);
}

}  // namespace vspring
