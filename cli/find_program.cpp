#include "find_program.hpp"

#include <unistd.h>

#include <cstdlib>
#include <string_view>

namespace vspring::cli {

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

}  // namespace vspring::cli
