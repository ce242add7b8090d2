#pragma once

#include <memory>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "vspring/advice.hpp"
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
  /// fault: for people, one line. advice: what to do about it; the message is with_advice(fault, advice). Empty where
  /// the fault says it already.
  Error(ErrorCode code, const std::string& fault, std::vector<Advice> advice = {});
  /// For programs.
  [[nodiscard]] ErrorCode code() const noexcept { return code_; }
  /// The message without its advice.
  [[nodiscard]] std::string fault() const;
  /// What to do, for programs that have words of their own for it.
  [[nodiscard]] std::span<const Advice> advice() const noexcept;

 private:
  ErrorCode code_;
  std::shared_ptr<const std::vector<Advice>> advice_;  ///< shared, as copies of exceptions may not throw
};

}  // namespace vspring
