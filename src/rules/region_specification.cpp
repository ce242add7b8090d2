// Parses regions as command lines and rules specify them.
#include <fmt/format.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>
#include <string_view>
#include <vector>

#include "base/message_text.hpp"
#include "rules/number_list.hpp"
#include "vspring/error.hpp"
#include "vspring/input_file.hpp"
#include "vspring/rules.hpp"

namespace vspring {

namespace {

Error malformed(const std::string& specification, const std::string& what) {
  return {
      ErrorCode::unusable_constraint,
      fmt::format("region \"{}\": {}; write sphere:x,y,z,r, box:x0,y0,z0,x1,y1,z1, group:NAME or the name of a JSON "
                  "file with a list of nodes",
                  in_one_line(specification), what)};
}

std::vector<double> numbers(const std::string& specification, const std::string& text, std::size_t count) {
  return number_list(text, count, [&](const std::string& what) { return malformed(specification, what); });
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
  nlohmann::json json;
  try {
    json = nlohmann::json::parse(text);
  } catch (const nlohmann::json::exception& fault) {
    throw Error(ErrorCode::unusable_constraint,
                fmt::format("{}: no JSON: {}", in_one_line(path, 4096), in_one_line(fault.what())));
  }
  if (json.is_object() && json.size() == 1 && json.contains("nodes")) json = nlohmann::json(json["nodes"]);
  if (!json.is_array())
    throw Error(ErrorCode::unusable_constraint,
                fmt::format("{}: write a list of node numbers, such as [1, 2, 3]", in_one_line(path, 4096)));
  std::vector<Index> nodes;
  for (const auto& entry : json) {
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
    if (!(v[3] >= 0)) throw malformed(name, "the radius must not be negative");
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

}  // namespace vspring
