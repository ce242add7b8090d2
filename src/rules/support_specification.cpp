// Parses what nodes slide on as command lines specify it.
#include <fmt/format.h>

#include <string>
#include <string_view>
#include <vector>

#include "base/message_text.hpp"
#include "rules/number_list.hpp"
#include "vspring/error.hpp"
#include "vspring/rules.hpp"

namespace vspring {

Support parse_support(std::string_view specification) {
  const auto malformed = [&](const std::string& what) {
    return Error(ErrorCode::unusable_constraint,
                 fmt::format("support \"{}\": {}; write plane:px,py,pz,nx,ny,nz, line:px,py,pz,dx,dy,dz, "
                             "cylinder:px,py,pz,dx,dy,dz,r or circle:cx,cy,cz,nx,ny,nz,r",
                             in_one_line(specification), what));
  };
  const std::string_view kind = specification.substr(0, specification.find(':'));
  const bool has_radius = kind == "cylinder" || kind == "circle";
  if (!has_radius && kind != "plane" && kind != "line") throw malformed("it is nothing to slide on");
  if (kind.size() == specification.size()) throw malformed("numbers are needed");
  const std::vector<double> v = number_list(specification.substr(kind.size() + 1), has_radius ? 7 : 6, malformed);
  const Vector3 point(v[0], v[1], v[2]);
  const Vector3 axis(v[3], v[4], v[5]);
  if (kind == "plane") return Support::plane(point, axis);
  if (kind == "line") return Support::line(point, axis);
  return kind == "cylinder" ? Support::cylinder(point, axis, v[6]) : Support::circle(point, axis, v[6]);
}

}  // namespace vspring
