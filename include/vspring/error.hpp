#pragma once

#include <stdexcept>
#include <string>

#include "vspring/export.hpp"

namespace VSPRING_API vspring {

/// What kind of input a call refuses.
enum class ErrorCode {
  invalid_argument,    ///< an option or argument outside its range
  unusable_file,       ///< a file that cannot be opened, read, understood or written
  unusable_shape,      ///< connectivity or coordinates that do not allow a node to move that has to
  unusable_constraint  ///< constraints that contradict each other or leave the shape unheld
};

/// The one exception type of the library. The message names the file, line, node or face, says what is
/// wrong with it, and what to do. A call that throws leaves its arguments as they were.
class Error : public std::runtime_error {
 public:
  /// message: for people, one line.
  Error(ErrorCode code, const std::string& message) : std::runtime_error(message), code_(code) {}
  /// For programs.
  [[nodiscard]] ErrorCode code() const noexcept { return code_; }

 private:
  ErrorCode code_;
};

}  // namespace vspring
