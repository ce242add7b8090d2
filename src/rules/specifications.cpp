// Parses regions and supports as command lines and rules specify them.
#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/message_text.hpp"
#include "vspring/error.hpp"
#include "vspring/input_file.hpp"
#include "vspring/rules.hpp"

namespace vspring {

namespace {

/// The numbers of a list with commas, as many as `count`. malformed: makes the error to throw of what is wrong.
std::vector<double> number_list(std::string_view list, std::size_t count,
                                const std::function<Error(const std::string&)>& malformed) {
  std::vector<double> values;
  for (std::size_t begin = 0; begin <= list.size();) {
    const std::size_t end = std::min(list.find(',', begin), list.size());
    const std::string text(list.substr(begin, end - begin));
    const auto value = nlohmann::json::parse(text, nullptr, false);
    if (!value.is_number()) throw malformed(fmt::format("\"{}\" is no number", in_one_line(text)));
    values.push_back(value.get<double>());
    begin = end + 1;
  }
  if (values.size() != count) throw malformed(fmt::format("{} numbers are needed, {} are given", count, values.size()));
  return values;
}

Error malformed_region(const std::string& specification, const std::string& what) {
  return {
      ErrorCode::unusable_constraint,
      fmt::format("region \"{}\": {}; write sphere:x,y,z,r, box:x0,y0,z0,x1,y1,z1, group:NAME or the name of a JSON "
                  "file with a list of nodes",
                  in_one_line(specification), what)};
}

std::vector<double> numbers(const std::string& specification, const std::string& text, std::size_t count) {
  return number_list(text, count, [&](const std::string& what) { return malformed_region(specification, what); });
}

std::vector<Index> nodes_of_file(const std::string& path) {
  std::string text;
  try {
    text = read_file(path);
  } catch (const Error& fault) {
    throw Error(
        fault.code(),
        fmt::format("{}; a region is sphere:x,y,z,r, box:x0,y0,z0,x1,y1,z1, group:NAME or the name of a JSON file with "
                    "a list of nodes",
                    in_one_line(fault.what(), 4096)));
  }
  nlohmann::json list;
  try {
    list = nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& fault) {
    throw Error(ErrorCode::unusable_constraint,
                fmt::format("{}: no JSON: {}", in_one_line(path, 4096), in_one_line(fault.what())));
  }
  if (list.is_object() && list.size() == 1 && list.contains("nodes")) list = nlohmann::json(list["nodes"]);
  if (!list.is_array())
    throw Error(ErrorCode::unusable_constraint,
                fmt::format("{}: write a list of node numbers, such as [1, 2, 3]", in_one_line(path, 4096)));
  std::vector<Index> nodes;
  for (const auto& entry : list) {
    if (!entry.is_number_integer() || entry.get<double>() > std::numeric_limits<Index>::max() ||
        entry.get<double>() < std::numeric_limits<Index>::min())
      throw Error(ErrorCode::unusable_constraint,
                  fmt::format("{}: {} is not a node; write a list of node numbers, such as [1, 2, 3]",
                              in_one_line(path, 4096), in_one_line(entry.dump())));
    nodes.push_back(entry.get<Index>());
  }
  return nodes;
}

}  // namespace

Region parse_region(std::string_view specification) {
  Region region{.extent = NodeRegion(), .name = std::string(specification)};
  const std::string& name = region.name;
  const std::size_t colon = name.find(':');
  const std::string kind = colon == std::string::npos ? "" : name.substr(0, colon);
  const std::string rest = colon == std::string::npos ? "" : name.substr(colon + 1);
  if (kind == "sphere") {
    const auto v = numbers(name, rest, 4);
    if (!(v[3] >= 0)) throw malformed_region(name, "the radius must not be negative");
    region.extent = SphereRegion{.centre = {v[0], v[1], v[2]}, .radius = v[3]};
  } else if (kind == "box") {
    const auto v = numbers(name, rest, 6);
    region.extent = BoxRegion{.from = {v[0], v[1], v[2]}, .to = {v[3], v[4], v[5]}};
  } else if (kind == "group") {
    region.extent = GroupRegion{rest};
  } else {
    region.extent = NodeRegion{nodes_of_file(name)};
  }
  return region;
}

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
