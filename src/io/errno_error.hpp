#pragma once

#include <string>

namespace vspring {

/// Throws Error(unusable_file): "NAME: cannot be WHAT: the system's reason; what to do". number: a value of errno.
[[noreturn]] void refuse_file(const std::string& name, const char* what, int number);

}  // namespace vspring
