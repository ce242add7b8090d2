// Coordinates of a curve as users name them.
#include <fmt/format.h>

#include <algorithm>

#include "base/message_text.hpp"
#include "io/column_names.hpp"
#include "vspring/curve_file.hpp"
#include "vspring/error.hpp"

namespace vspring {
namespace {

constexpr std::string_view axis_letters = "xyz";

std::string known_names(const CurveFile& file, std::size_t count) {
  std::string list;
  for (std::size_t axis = 0; axis < count; ++axis) {
    if (axis > 0) list += ", ";
    list += axis_letters[axis];
    if (!file.column_names.empty() && !file.column_names[axis].empty())
      list += " or " + in_quotes(file.column_names[axis]);
  }
  return list;
}

}  // namespace

std::array<bool, 3> choose_axes(const CurveFile& file, const std::vector<std::string>& names) {
  const std::size_t count = file.planar ? 2 : 3;
  const Cells header(file.column_names.begin(), file.column_names.end());
  std::array<bool, 3> chosen = {false, false, false};
  const auto choose = [&](std::string_view name) {
    std::size_t axis = column_like(header, name);
    if (axis == header.size()) axis = name.size() == 1 ? axis_letters.find(name[0]) : axis_letters.size();
    if (axis >= count) return false;
    chosen[axis] = true;
    return true;
  };
  for (const std::string& name : names) {
    if (choose(name)) continue;
    const bool are_letters =
        !name.empty() && std::all_of(name.begin(), name.end(), [&](char c) { return choose(std::string_view(&c, 1)); });
    if (!are_letters)
      throw Error(ErrorCode::invalid_argument, fmt::format("{} is no coordinate of this curve; it has {}",
                                                           in_quotes(name), known_names(file, count)));
  }
  if (file.plane && chosen[0] != chosen[1])
    throw Error(ErrorCode::invalid_argument,
                "longitude and latitude are one place on the ground and move together; name both, or neither");
  return chosen;
}

}  // namespace vspring
