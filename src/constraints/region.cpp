#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "base/message_text.hpp"
#include "vspring/constraints.hpp"
#include "vspring/error.hpp"
#include "vspring/topology.hpp"

namespace vspring {

namespace {

std::vector<Index> boundary_list(const PolygonMesh& mesh) {
  const auto boundary = boundary_nodes(mesh);
  std::vector<Index> nodes;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (boundary[static_cast<std::size_t>(i)] != 0) nodes.push_back(i);
  }
  return nodes;
}

/// Gives nodes the estimated normals; those without a usable face keep theirs free.
void fix_estimated(Constraints& constraints, const PolygonMesh& mesh, const std::vector<Index>& nodes,
                   std::span<const std::uint8_t> usable_face) {
  const auto normals = estimate_normals(mesh, nodes, usable_face);
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    if (!normals[k].isZero(0)) constraints.fix_normal(nodes[k], normals[k]);
  }
}

Error malformed(const std::string& specification, const std::string& what) {
  return {
      ErrorCode::unusable_constraint,
      fmt::format("region \"{}\": {}; write sphere:x,y,z,r, box:x0,y0,z0,x1,y1,z1, group:NAME or the name of a JSON "
                  "file with a list of nodes",
                  in_one_line(specification), what)};
}

std::vector<double> numbers(const std::string& specification, const std::string& text, std::size_t count) {
  std::vector<double> values;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    const auto value = nlohmann::json::parse(text.substr(begin, end - begin), nullptr, false);
    if (!value.is_number())
      throw malformed(specification, fmt::format("\"{}\" is no number", in_one_line(text.substr(begin, end - begin))));
    values.push_back(value.get<double>());
    begin = end + 1;
  }
  if (values.size() != count)
    throw malformed(specification, fmt::format("{} numbers are needed, {} are given", count, values.size()));
  return values;
}

std::vector<Index> nodes_within(const std::vector<Vector3>& positions, const auto& inside) {
  std::vector<Index> nodes;
  for (std::size_t i = 0; i < positions.size(); ++i) {
    if (inside(positions[i])) nodes.push_back(static_cast<Index>(i));
  }
  return nodes;
}

std::vector<Index> nodes_of_file(Index node_count, const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(file)), std::istreambuf_iterator<char>());
  if (!file.is_open() || file.bad() || text.empty())
    throw Error(
        ErrorCode::unusable_file,
        fmt::format("{}: cannot be read; a region is sphere:x,y,z,r, box:x0,y0,z0,x1,y1,z1, group:NAME or the name "
                    "of a JSON file with a list of nodes",
                    in_one_line(path, 4096)));
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
    if (!entry.is_number_integer() || entry.get<std::int64_t>() < 0 || entry.get<std::int64_t>() >= node_count)
      throw Error(ErrorCode::unusable_constraint,
                  fmt::format("{}: {} is not a node; nodes go from 0 to {}", in_one_line(path, 4096),
                              in_one_line(entry.dump()), node_count - 1));
    nodes.push_back(entry.get<Index>());
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

}  // namespace

void fix_boundary_normals(Constraints& constraints, const PolygonMesh& mesh) {
  fix_estimated(constraints, mesh, boundary_list(mesh), {});
}

void restrict_to_region(Constraints& constraints, const PolygonMesh& mesh, std::span<const Index> region) {
  Constraints restricted = constraints;
  std::vector<std::uint8_t> inside(static_cast<std::size_t>(mesh.node_count()), 0);
  for (const Index i : region) {
    (void)restricted.position_fixed(i);  // names a node out of range
    inside[static_cast<std::size_t>(i)] = 1;
  }
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (inside[static_cast<std::size_t>(i)] == 0 && !restricted.position_fixed(i))
      restricted.fix_position(i, mesh.position(i));
  }
  std::vector<std::uint8_t> outer_face(static_cast<std::size_t>(mesh.face_count()), 1);
  std::vector<std::uint8_t> rim(static_cast<std::size_t>(mesh.node_count()), 0);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const auto moves = [&](Index i) { return !restricted.position_fixed(i); };
    if (std::none_of(face.begin(), face.end(), moves)) continue;
    outer_face[static_cast<std::size_t>(f)] = 0;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index a = face[k];
      const Index b = face[(k + 1) % face.size()];
      if (moves(a) && !moves(b)) rim[static_cast<std::size_t>(b)] = 1;
      if (moves(b) && !moves(a)) rim[static_cast<std::size_t>(a)] = 1;
    }
  }
  // With faces all round, those that move tell more of the normal than an estimate from one side.
  const std::vector<std::uint8_t> boundary = boundary_nodes(mesh);
  std::vector<Index> rim_nodes;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    const auto node = static_cast<std::size_t>(i);
    if (rim[node] != 0 && boundary[node] != 0 && !restricted.normal_fixed(i)) rim_nodes.push_back(i);
  }
  fix_estimated(restricted, mesh, rim_nodes, outer_face);
  constraints = std::move(restricted);
}

std::vector<Index> select_region(const std::vector<Vector3>& positions, const std::string& specification,
                                 const Groups& groups) {
  std::vector<Index> nodes;
  const std::size_t colon = specification.find(':');
  const std::string kind = specification.substr(0, colon);
  const std::string rest = colon == std::string::npos ? "" : specification.substr(colon + 1);
  if (kind == "sphere" && colon != std::string::npos) {
    const auto v = numbers(specification, rest, 4);
    if (!(v[3] >= 0)) throw malformed(specification, "the radius must not be negative");
    const Vector3 centre(v[0], v[1], v[2]);
    nodes = nodes_within(positions, [&](const Vector3& p) { return (p - centre).norm() <= v[3]; });
  } else if (kind == "box" && colon != std::string::npos) {
    const auto v = numbers(specification, rest, 6);
    const Eigen::AlignedBox<double, 3> box(Vector3(v[0], v[1], v[2]).cwiseMin(Vector3(v[3], v[4], v[5])),
                                           Vector3(v[0], v[1], v[2]).cwiseMax(Vector3(v[3], v[4], v[5])));
    nodes = nodes_within(positions, [&](const Vector3& p) { return box.contains(p); });
  } else if (kind == "group" && colon != std::string::npos) {
    const auto group = groups.find(rest);
    if (group == groups.end()) {
      std::string known;
      for (const auto& [name, members] : groups) known += (known.empty() ? "" : ", ") + name;
      throw Error(ErrorCode::unusable_constraint,
                  fmt::format("region \"{}\": the shape has no such group; {}", in_one_line(specification),
                              known.empty() ? "it has none at all" : "it has " + in_one_line(known, 1000)));
    }
    nodes = group->second;
  } else {
    nodes = nodes_of_file(static_cast<Index>(positions.size()), specification);
  }
  if (nodes.empty())
    throw Error(ErrorCode::unusable_constraint,
                fmt::format("region \"{}\": no node lies in it", in_one_line(specification)));
  return nodes;
}

}  // namespace vspring
