#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

#include "base/message_text.hpp"
#include "io/text_cursor.hpp"
#include "vspring/error.hpp"
#include "vspring/symmetry.hpp"

namespace vspring {

namespace {

[[noreturn]] void refuse_plane(std::string_view specification, const std::string& what) {
  throw Error(
      ErrorCode::unusable_constraint,
      fmt::format("plane \"{}\": {}; write x, y or z, x=2.5, or plane:px,py,pz,nx,ny,nz by a point and a normal",
                  in_one_line(specification), what));
}

double number_in(std::string_view specification, std::string_view text) {
  double number = 0;
  const char* const end = text.data() + text.size();
  if (parse_number(text.data(), end, number) != end || text.empty() || !std::isfinite(number))
    refuse_plane(specification, fmt::format("\"{}\" is no number", in_one_line(text)));
  return number;
}

std::vector<double> numbers_in(std::string_view specification, std::string_view list) {
  std::vector<double> numbers;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    numbers.push_back(number_in(specification, list.substr(begin, end - begin)));
    begin = end + 1;
  }
  return numbers;
}

}  // namespace

MirrorPlane parse_plane(std::string_view specification) {
  constexpr std::string_view general = "plane:";
  MirrorPlane plane;
  if (specification.starts_with(general)) {
    const std::vector<double> v = numbers_in(specification, specification.substr(general.size()));
    if (v.size() != 6) refuse_plane(specification, fmt::format("6 numbers are needed, {} are given", v.size()));
    plane.point = {v[0], v[1], v[2]};
    plane.normal = Vector3(v[3], v[4], v[5]).stableNormalized();
    if (plane.normal.isZero(0)) refuse_plane(specification, "a normal of zero has no direction");
    plane.name = fmt::format("through ({:g}, {:g}, {:g}) with the normal ({:g}, {:g}, {:g})", v[0], v[1], v[2], v[3],
                             v[4], v[5]);
    return plane;
  }
  const std::string_view axis = specification.substr(0, specification.find('='));
  const std::size_t coordinate = axis.size() == 1 ? std::string_view("xyz").find(axis) : std::string_view::npos;
  if (coordinate == std::string_view::npos) refuse_plane(specification, "this is no plane");
  const bool shifted = axis.size() < specification.size();
  const double at = shifted ? number_in(specification, specification.substr(axis.size() + 1)) : 0;
  plane.normal = Vector3::Unit(static_cast<Eigen::Index>(coordinate));
  plane.point = at * plane.normal;
  plane.name = fmt::format("{} = {:g}", axis, at);
  return plane;
}

}  // namespace vspring
