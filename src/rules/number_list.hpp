#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "vspring/error.hpp"

namespace vspring {

/// The numbers of a list with commas, as many as `count`. malformed: makes the error to throw of what is wrong.
std::vector<double> number_list(std::string_view list, std::size_t count,
                                const std::function<Error(const std::string&)>& malformed);

}  // namespace vspring
