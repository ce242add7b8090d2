#include "io/errno_error.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <system_error>

#include "vspring/error.hpp"

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

}  // namespace

void refuse_file(const std::string& name, const char* what, int number) {
  throw Error(ErrorCode::unusable_file, fmt::format("{}: cannot be {}: {}{}", name.empty() ? "\"\"" : name, what,
                                                    std::generic_category().message(number), advice(number)));
}

}  // namespace vspring
