#include "vspring/remesh.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <map>
#include <numeric>
#include <utility>

#include "base/cancellation.hpp"
#include "base/disjoint_sets.hpp"
#include "base/median.hpp"
#include "refine/edge_table.hpp"
#include "refine/editable_triangles.hpp"
#include "refine/evening.hpp"
#include "refine/input_surface.hpp"
#include "refine/moving_part.hpp"
#include "shape/direction.hpp"
#include "shape/face_geometry.hpp"
#include "shape/frame.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

// A node at which a line turns by more stays, in degrees.
constexpr double greatest_turn_of_line = 60;
// Smaller shares are rounding.
constexpr double no_share = 1e-12;

/// A line through the part: an edge of the boundary, or a given one.
struct LineEdge {
  NodePair nodes;
  Index face;   ///< one of those at it
  Index given;  ///< its number in Remeshing::lines, or −1
};

class Remesher {
 public:
  Remesher(const PolygonMesh& mesh, const Constraints& constraints, const Remeshing& how);

  Remeshed run();

 private:
  void take_part();
  void find_lines();
  void add_triangles();
  void find_nodes_that_stay();
  [[nodiscard]] std::map<Index, std::vector<std::size_t>> lines_at_nodes() const;
  [[nodiscard]] bool turns(Index node, const std::vector<std::size_t>& lines) const;
  void number_lines();
  void choose_length();
  void refuse_too_many() const;
  [[nodiscard]] Vector3 local(Index node) const { return positions_[static_cast<std::size_t>(node)]; }

  void number_nodes();
  void add_mean(Index node);
  void take_faces(const InputSurface& surface);
  void take_lines();
  [[nodiscard]] Vector3 outside(Index node) const;

  const PolygonMesh& mesh_;
  const Remeshing& how_;
  std::vector<std::uint8_t> in_part_;
  std::vector<Triangle> triangles_of_part_;
  std::vector<NodePair> kept_edges_;
  std::vector<LineEdge> lines_;
  std::vector<LineSegment> segments_;  ///< of the lines, with the number of their chain
  std::vector<Index> given_of_line_;   ///< per chain, or −1
  std::map<NodePair, Index> line_of_edge_;
  Frame frame_;
  std::vector<Vector3> positions_;  ///< of the input, at the scale of the frame
  TrianglesOnSurface shape_;
  Constraints held_;
  std::vector<Index> number_;  ///< per node its number in the result, or −1
  Remeshed result_;
};

Remesher::Remesher(const PolygonMesh& mesh, const Constraints& constraints, const Remeshing& how)
    : mesh_(mesh), how_(how), shape_{EditableTriangles(mesh.node_count()), {}, {}, {}, {}, {}}, held_(constraints) {}

Remeshed Remesher::run() {
  take_part();
  find_lines();
  number_lines();
  add_triangles();
  find_nodes_that_stay();
  choose_length();
  refuse_too_many();
  const InputSurface surface(triangles_of_part_, segments_, positions_);
  shape_.places = positions_;
  for (Index node = 0; node < mesh_.node_count(); ++node) {
    shape_.normals.push_back(surface.normal_at(node));
    shape_.origins.push_back(
        {.place = local(node), .item = -1, .face = -1, .nodes = {node, node, node}, .shares = {1, 0, 0}});
  }
  const auto hold = [&](Index node, Index a, Index b) {
    held_.add_nodes(node + 1 - held_.node_count());
    hold_between(held_, node, a, b,
                 (shape_.places[static_cast<std::size_t>(a)] - shape_.places[static_cast<std::size_t>(b)]).norm() /
                     frame_.scale());
    return held_.position_fixed(node) || held_.support(node) != nullptr || held_.normal_fixed(node);
  };
  if (!triangles_of_part_.empty()) Evening(shape_, surface, result_.length * frame_.scale(), hold).run();
  held_.add_nodes(shape_.triangles.node_count() - held_.node_count());
  number_nodes();
  take_faces(surface);
  take_lines();
  return std::move(result_);
}

/// Scaled, so that no square overflows or vanishes: by a power of two, which costs no digits.
void Remesher::take_part() {
  in_part_ = moving_faces(mesh_, held_);
  kept_edges_ = edges_kept(mesh_, in_part_);
  Eigen::AlignedBox<double, 3> box;
  for (const Triangle& triangle : cut_into_triangles(mesh_)) {
    if (in_part_[static_cast<std::size_t>(triangle.face)] == 0) continue;
    triangles_of_part_.push_back(triangle);
    for (const Index node : triangle.nodes) box.extend(mesh_.position(node));
  }
  frame_ = Frame(box);
  for (const Vector3& position : mesh_.positions()) positions_.push_back(position * frame_.scale());
}

void Remesher::find_lines() {
  std::map<NodePair, Index> given;
  for (std::size_t k = 0; k < how_.lines.size(); ++k) {
    const auto [low, high] = std::minmax(how_.lines[k].first, how_.lines[k].second);
    if (low < 0 || high >= mesh_.node_count())
      throw Error(ErrorCode::invalid_argument,
                  fmt::format("line from node {} to node {}: there is no node {}", how_.lines[k].first,
                              how_.lines[k].second, low < 0 ? low : high));
    given.emplace(NodePair(low, high), static_cast<Index>(k));
  }
  FaceParcel parcel;
  for (const Triangle& triangle : triangles_of_part_) parcel.add(triangle.nodes, triangle.face);
  const EdgeTable edges(parcel, mesh_.node_count());
  for (Index e = 0; e < edges.count(); ++e) {
    const auto& [low, high, use] = edges.edge(e);
    const NodePair edge(low, high);
    const auto uses = edges.uses(e);
    const auto runs_up = [&](std::size_t k) { return parcel.corners[static_cast<std::size_t>(uses[k])] == edge.first; };
    const bool is_whole = uses.size() == 1 || (uses.size() == 2 && runs_up(0) != runs_up(1));
    const auto found = given.find(edge);
    if (!is_whole || std::binary_search(kept_edges_.begin(), kept_edges_.end(), edge))
      line_of_edge_[edge] = EditableTriangles::fixed_line;
    else if (uses.size() == 1 || found != given.end())
      lines_.push_back(
          {edge, parcel.from[static_cast<std::size_t>(uses[0]) / 3], found != given.end() ? found->second : -1});
  }
}

std::map<Index, std::vector<std::size_t>> Remesher::lines_at_nodes() const {
  std::map<Index, std::vector<std::size_t>> at;
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    at[lines_[k].nodes.first].push_back(k);
    at[lines_[k].nodes.second].push_back(k);
  }
  return at;
}

/// Whether two lines that meet at a node turn there, or are of different kinds.
bool Remesher::turns(Index node, const std::vector<std::size_t>& lines) const {
  const auto way = [&](std::size_t line) -> Vector3 {
    const NodePair& nodes = lines_[line].nodes;
    return local(nodes.first == node ? nodes.second : nodes.first) - local(node);
  };
  return (lines_[lines[0]].given < 0) != (lines_[lines[1]].given < 0) ||
         degrees_between(-way(lines[0]), way(lines[1])) > greatest_turn_of_line;
}

/// Lines that meet at a node that can move along them are one.
void Remesher::number_lines() {
  shape_.stays.assign(positions_.size(), 0);
  shape_.lines.assign(positions_.size(), EditableTriangles::no_line);
  const auto at_nodes = lines_at_nodes();
  for (const auto& [node, lines] : at_nodes) {
    if (lines.size() != 2 || turns(node, lines)) shape_.stays[static_cast<std::size_t>(node)] = 1;
  }
  for (Index node = 0; node < mesh_.node_count(); ++node) {
    if (held_.position_fixed(node) || held_.normal_fixed(node) || held_.support(node) != nullptr)
      shape_.stays[static_cast<std::size_t>(node)] = 1;
  }
  for (const auto& [edge, line] : line_of_edge_)
    shape_.stays[static_cast<std::size_t>(edge.first)] = shape_.stays[static_cast<std::size_t>(edge.second)] = 1;
  DisjointSets chains(lines_.size());
  for (const auto& [node, lines] : at_nodes) {
    if (shape_.stays[static_cast<std::size_t>(node)] == 0) chains.join(lines[0], lines[1]);
  }
  given_of_line_.assign(lines_.size(), -1);
  for (std::size_t k = 0; k < lines_.size(); ++k) {
    const std::size_t chain = chains.find(k);
    const auto line = static_cast<Index>(chain);
    const auto& [nodes, face, given] = lines_[k];
    Index& first = given_of_line_[chain];
    if (given >= 0 && (first < 0 || given < first)) first = given;
    segments_.push_back({nodes.first, nodes.second, face, line});
    line_of_edge_[nodes] = line;
    shape_.lines[static_cast<std::size_t>(nodes.first)] = shape_.lines[static_cast<std::size_t>(nodes.second)] = line;
  }
}

void Remesher::add_triangles() {
  for (const Triangle& triangle : triangles_of_part_) {
    EditableTriangles::Triangle own{.nodes = triangle.nodes};
    for (std::size_t k = 0; k < 3; ++k) {
      const auto found = line_of_edge_.find(std::minmax(own.node(k), own.node(k + 1)));
      if (found != line_of_edge_.end()) own.lines[k] = found->second;
    }
    shape_.triangles.add(own);
  }
}

/// Also nodes at which fans of triangles meet in a point.
void Remesher::find_nodes_that_stay() {
  for (Index node = 0; node < mesh_.node_count(); ++node) {
    if (!shape_.triangles.is_one_fan(node)) shape_.stays[static_cast<std::size_t>(node)] = 1;
  }
}

void Remesher::choose_length() {
  if (how_.length) {
    result_.length = *how_.length;
    return;
  }
  std::vector<double> lengths;
  for (const auto& [a, b] : shape_.triangles.edges()) lengths.push_back((local(a) - local(b)).norm());
  if (lengths.empty()) return;
  result_.length = median(lengths) / frame_.scale();
  if (!(result_.length > 0))
    throw Error(ErrorCode::invalid_argument, "most edges have no length, so that the median is no length to aim at");
}

void Remesher::refuse_too_many() const {
  if (triangles_of_part_.empty()) return;
  const double length = result_.length * frame_.scale();
  double twice = 0;
  for (const Triangle& triangle : triangles_of_part_)
    twice += twice_vector_area(std::span<const Index>(triangle.nodes), positions_).norm();
  double edges = 0;
  for (const LineSegment& segment : segments_) edges += (local(segment.first) - local(segment.second)).norm();
  // Two equilateral triangles to a node inside.
  const double nodes = twice / (std::sqrt(3.0) * length * length) + edges / length / 2;
  if (nodes > most_new_nodes)
    throw Error(ErrorCode::invalid_argument,
                fmt::format("edges of about {} would need about {:.2g} nodes, and more than {} are refused; choose "
                            "longer ones",
                            result_.length, nodes, most_new_nodes));
}

Vector3 Remesher::outside(Index node) const {
  if (node < mesh_.node_count() && shape_.places[static_cast<std::size_t>(node)] == local(node))
    return mesh_.position(node);
  return shape_.places[static_cast<std::size_t>(node)] / frame_.scale();
}

/// Nodes of the input at their places come first; those that moved are new.
void Remesher::number_nodes() {
  std::vector<std::uint8_t> of_part(positions_.size(), 0);
  for (const Triangle& triangle : triangles_of_part_) {
    for (const Index node : triangle.nodes) of_part[static_cast<std::size_t>(node)] = 1;
  }
  std::vector<Vector3> positions;
  std::vector<Index> order;
  number_.assign(shape_.places.size(), -1);
  const auto take = [&](Index node) {
    number_[static_cast<std::size_t>(node)] = static_cast<Index>(positions.size());
    positions.push_back(outside(node));
    order.push_back(node);
  };
  for (Index node = 0; node < mesh_.node_count(); ++node) {
    const auto i = static_cast<std::size_t>(node);
    const bool is_there = of_part[i] == 0 || !shape_.triangles.around(node).empty();
    if (is_there && (of_part[i] == 0 || shape_.places[i] == local(node)))
      take(node);
    else
      result_.removed.push_back(node);
  }
  for (Index node = 0; node < shape_.triangles.node_count(); ++node) {
    if (number_[static_cast<std::size_t>(node)] >= 0 || shape_.triangles.around(node).empty()) continue;
    take(node);
    add_mean(node);
  }
  result_.constraints = Constraints(static_cast<Index>(order.size()));
  for (std::size_t k = 0; k < order.size(); ++k) result_.constraints.hold_as(static_cast<Index>(k), held_, order[k]);
  result_.mesh = PolygonMesh(std::move(positions), {0}, {});
}

void Remesher::add_mean(Index node) {
  const SurfacePlace& origin = shape_.origins[static_cast<std::size_t>(node)];
  double sum = 0;
  for (const double share : origin.shares) sum += share > no_share ? share : 0;
  for (std::size_t k = 0; k < origin.nodes.size(); ++k) {
    if (!(origin.shares[k] > no_share)) continue;
    result_.mean_of.push_back(origin.nodes[k]);
    result_.shares.push_back(origin.shares[k] / sum);
  }
  result_.mean_begin.push_back(static_cast<Index>(result_.mean_of.size()));
  result_.mean_face.push_back(origin.face);
}

/// Each triangle comes from the face that has the place nearest to its middle.
void Remesher::take_faces(const InputSurface& surface) {
  struct Part {
    Index from;
    std::array<Index, 3> nodes;
  };
  std::vector<Part> parts;
  for (const EditableTriangles::Triangle& triangle : shape_.triangles.triangles()) {
    if (!triangle.is_there()) continue;
    end_if_cancelled_at(parts.size());
    Vector3 middle = Vector3::Zero();
    for (const Index node : triangle.nodes) middle += shape_.places[static_cast<std::size_t>(node)] / 3;
    const Vector3 area = twice_vector_area(std::span<const Index>(triangle.nodes), shape_.places);
    const Index nearest = surface.nearest(middle, area, -1).item;
    Part part{triangles_of_part_[static_cast<std::size_t>(nearest)].face, {}};
    for (std::size_t k = 0; k < 3; ++k) part.nodes[k] = number_[static_cast<std::size_t>(triangle.nodes[k])];
    parts.push_back(part);
  }
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.from < b.from; });
  std::vector<Index> face_begin = {0};
  std::vector<Index> corners;
  const auto end_face = [&](Index from) {
    face_begin.push_back(static_cast<Index>(corners.size()));
    result_.face_from.push_back(from);
  };
  auto part = parts.begin();
  for (Index f = 0; f < mesh_.face_count(); ++f) {
    if (in_part_[static_cast<std::size_t>(f)] == 0) {
      for (const Index node : mesh_.face(f)) corners.push_back(number_[static_cast<std::size_t>(node)]);
      end_face(f);
    }
    for (; part != parts.end() && part->from == f; ++part) {
      corners.insert(corners.end(), part->nodes.begin(), part->nodes.end());
      end_face(f);
    }
  }
  result_.mesh = PolygonMesh(result_.mesh.positions(), std::move(face_begin), std::move(corners));
}

void Remesher::take_lines() {
  std::map<NodePair, Index> lines;
  for (const auto& [a, b] : shape_.triangles.edges()) {
    const Index line = shape_.triangles.line_of(a, b);
    const Index given = line < 0 ? -1 : given_of_line_[static_cast<std::size_t>(line)];
    if (given < 0) continue;
    lines[std::minmax(number_[static_cast<std::size_t>(a)], number_[static_cast<std::size_t>(b)])] = given;
  }
  for (std::size_t k = 0; k < how_.lines.size(); ++k) {
    const auto& [a, b] = how_.lines[k];
    const auto found = line_of_edge_.find(std::minmax(a, b));
    if (found != line_of_edge_.end() && found->second != EditableTriangles::fixed_line) continue;
    const NodePair own = std::minmax(number_[static_cast<std::size_t>(a)], number_[static_cast<std::size_t>(b)]);
    if (own.first >= 0) lines.emplace(own, static_cast<Index>(k));
  }
  for (const auto& [edge, given] : lines) {
    result_.lines.push_back(edge);
    result_.line_from.push_back(given);
  }
}

}  // namespace

void Remeshing::validate() const {
  if (length && !(*length > 0 && std::isfinite(*length)))
    throw Error(ErrorCode::invalid_argument,
                fmt::format("length is {}, but has to be greater than 0 and finite", *length));
}

Remeshed remesh(const PolygonMesh& mesh, const Constraints& constraints, const Remeshing& how) {
  how.validate();
  if (constraints.node_count() != mesh.node_count())
    throw Error(ErrorCode::unusable_constraint, fmt::format("constraints of {} nodes given for a mesh of {}",
                                                            constraints.node_count(), mesh.node_count()));
  Remeshed remeshed = Remesher(mesh, constraints, how).run();
  remeshed.boundary_reach = boundary_reach_of(mesh);
  return remeshed;
}

}  // namespace vspring
