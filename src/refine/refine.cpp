#include "vspring/refine.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <numeric>
#include <queue>
#include <span>
#include <utility>
#include <vector>

#include "base/cancellation.hpp"
#include "base/degrees.hpp"
#include "refine/divided_face.hpp"
#include "refine/edge_table.hpp"
#include "refine/moving_part.hpp"
#include "shape/face_geometry.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

// How much longer edges may be nearer to a longer one that stays, per distance.
constexpr double grading = 0.5;
// The opposite side of a quad is halved with a long one if it exceeds this share of what is allowed.
constexpr double share_of_opposite = 0.5;
// Edges of a triangle whose lengths differ by less are equally long.
constexpr double equal_lengths = 1e-6;

class Division {
 public:
  Division(const PolygonMesh& mesh, const Constraints& constraints, const Refinement& how);

  Refined run();

 private:
  void take_part();
  void find_kept_edges();
  void find_sizes(const EdgeTable& edges);
  void refuse_too_many(const EdgeTable& edges) const;
  [[nodiscard]] double length(Index a, Index b) const {
    return (positions_[static_cast<std::size_t>(a)] - positions_[static_cast<std::size_t>(b)]).norm();
  }
  /// The length or the turn of an edge, as a share of what is allowed.
  [[nodiscard]] double excess(const Vector3& place_a, const Vector3& place_b, const Vector3& normal_a,
                              const Vector3& normal_b) const;
  [[nodiscard]] double excess(Index a, Index b) const;
  [[nodiscard]] double size_at(Index a, Index b) const {
    return std::max(sizes_[static_cast<std::size_t>(a)], sizes_[static_cast<std::size_t>(b)]);
  }
  [[nodiscard]] bool is_kept(const EdgeTable::Edge& edge) const;
  void mark(const EdgeTable& edges);
  void mark_also(Index face, Index corner, const EdgeTable& edges, std::vector<Index>& due);
  [[nodiscard]] bool is_too_wide(std::span<const Index> face) const;
  bool divide_once();
  Index add_mean(std::span<const Index> of);
  Refined take();

  const PolygonMesh& mesh_;
  const Refinement& how_;
  double turn_ = 0;                                  ///< allowed; radians
  std::vector<std::uint8_t> in_part_;                ///< per face of the input
  std::vector<std::pair<Index, Index>> kept_edges_;  ///< between the part and other faces, ascending
  std::vector<std::uint8_t> at_kept_edge_;           ///< per node of the input
  FaceParcel faces_;                                 ///< of the part
  std::vector<Vector3> positions_;
  std::vector<Vector3> normals_;  ///< to measure turns
  std::vector<double> sizes_;     ///< edges that are no longer stay, whatever is allowed
  Refined result_;
  // Of the present round, per edge.
  std::vector<double> lengths_;
  std::vector<double> excess_;
  std::vector<std::uint8_t> marked_;
  std::vector<Index> face_of_corner_;
};

Division::Division(const PolygonMesh& mesh, const Constraints& constraints, const Refinement& how)
    : mesh_(mesh), how_(how), positions_(mesh.positions()), sizes_(positions_.size(), 0), result_{{}, constraints} {
  if (how.turn) turn_ = *how.turn / degrees_per_radian;
}

void Division::take_part() {
  in_part_ = moving_faces(mesh_, result_.constraints);
  for (Index f = 0; f < mesh_.face_count(); ++f) {
    if (in_part_[static_cast<std::size_t>(f)] != 0) faces_.add(mesh_.face(f), f);
  }
}

void Division::find_kept_edges() {
  kept_edges_ = edges_kept(mesh_, in_part_);
  at_kept_edge_.assign(positions_.size(), 0);
  for (const auto& [low, high] : kept_edges_)
    at_kept_edge_[static_cast<std::size_t>(low)] = at_kept_edge_[static_cast<std::size_t>(high)] = 1;
}

bool Division::is_kept(const EdgeTable::Edge& edge) const {
  const auto flagged = [&](Index node) {
    return static_cast<std::size_t>(node) < at_kept_edge_.size() && at_kept_edge_[static_cast<std::size_t>(node)] != 0;
  };
  return flagged(edge.low) && flagged(edge.high) &&
         std::binary_search(kept_edges_.begin(), kept_edges_.end(), std::pair(edge.low, edge.high));
}

/// Refuses a length before the work, by the least number of new nodes that it needs.
void Division::refuse_too_many(const EdgeTable& edges) const {
  if (!how_.length) return;
  double nodes = 0;
  for (Index e = 0; e < edges.count(); ++e) {
    const auto& [low, high, use] = edges.edge(e);
    if (size_at(low, high) == 0) nodes += std::max(length(low, high) / *how_.length - 1, 0.0);
  }
  for (Index f = 0; f < faces_.count(); ++f) {
    const auto face = faces_.face(f);
    if (std::any_of(face.begin(), face.end(), [&](Index i) { return sizes_[static_cast<std::size_t>(i)] > 0; }))
      continue;
    // Quads of such sides are no larger than squares, and triangles, two to a node, cover less.
    const double squares = twice_vector_area(face, positions_).norm() / 2 / *how_.length / *how_.length;
    nodes += std::max(squares - 1, 0.0);
  }
  if (nodes > most_new_nodes)
    throw Error(ErrorCode::invalid_argument,
                fmt::format("edges of at most {} would need at least {:.2g} new nodes, and more than {} are refused; "
                            "allow longer ones",
                            *how_.length, nodes, most_new_nodes));
}

double Division::excess(const Vector3& place_a, const Vector3& place_b, const Vector3& normal_a,
                        const Vector3& normal_b) const {
  if (how_.length) return (place_a - place_b).norm() / *how_.length;
  return std::atan2(normal_a.cross(normal_b).norm(), normal_a.dot(normal_b)) / turn_;
}

double Division::excess(Index a, Index b) const {
  const auto i = static_cast<std::size_t>(a);
  const auto j = static_cast<std::size_t>(b);
  if (how_.length) return length(a, b) / *how_.length;
  return excess(positions_[i], positions_[j], normals_[i], normals_[j]);
}

/// Edges that stay though they are too long allow others near them to be longer than asked for: otherwise the faces
/// between would become slivers without end.
void Division::find_sizes(const EdgeTable& edges) {
  using Due = std::pair<double, Index>;
  std::priority_queue<Due> due;
  const auto raise = [&](Index node, double size) {
    double& known = sizes_[static_cast<std::size_t>(node)];
    if (size <= known) return;
    known = size;
    due.emplace(size, node);
  };
  for (Index e = 0; e < edges.count(); ++e) {
    const auto& [low, high, use] = edges.edge(e);
    if (!is_kept(edges.edge(e)) || excess(low, high) <= 1) continue;
    raise(low, length(low, high));
    raise(high, length(low, high));
  }
  if (due.empty()) return;
  std::vector<Index> begin(positions_.size() + 1, 0);
  for (Index e = 0; e < edges.count(); ++e) {
    ++begin[static_cast<std::size_t>(edges.edge(e).low) + 1];
    ++begin[static_cast<std::size_t>(edges.edge(e).high) + 1];
  }
  std::partial_sum(begin.begin(), begin.end(), begin.begin());
  std::vector<Index> neighbours(static_cast<std::size_t>(begin.back()));
  std::vector<Index> end(begin.begin(), begin.end() - 1);
  for (Index e = 0; e < edges.count(); ++e) {
    const auto& [low, high, use] = edges.edge(e);
    neighbours[static_cast<std::size_t>(end[static_cast<std::size_t>(low)]++)] = high;
    neighbours[static_cast<std::size_t>(end[static_cast<std::size_t>(high)]++)] = low;
  }
  while (!due.empty()) {
    const auto [size, node] = due.top();
    due.pop();
    if (size < sizes_[static_cast<std::size_t>(node)]) continue;
    for (Index k = begin[static_cast<std::size_t>(node)]; k < end[static_cast<std::size_t>(node)]; ++k) {
      const Index other = neighbours[static_cast<std::size_t>(k)];
      raise(other, size - grading * length(node, other));
    }
  }
}

/// Marks further edges of a face with a marked edge.
void Division::mark_also(Index face, Index corner, const EdgeTable& edges, std::vector<Index>& due) {
  const auto f = static_cast<std::size_t>(face);
  const Index first = faces_.begin[f];
  const Index sides = faces_.begin[f + 1] - first;
  const auto mark_edge = [&](Index edge) {
    if (marked_[static_cast<std::size_t>(edge)] != 0 || is_kept(edges.edge(edge))) return;
    marked_[static_cast<std::size_t>(edge)] = 1;
    due.push_back(edge);
  };
  if (sides == 3) {
    Index longest = edges.of_corner(corner);
    const double own = lengths_[static_cast<std::size_t>(longest)];
    for (Index k = 0; k < 3; ++k) {
      const Index other = edges.of_corner(first + k);
      if (lengths_[static_cast<std::size_t>(other)] > (1 + equal_lengths) * own &&
          lengths_[static_cast<std::size_t>(other)] > lengths_[static_cast<std::size_t>(longest)])
        longest = other;
    }
    mark_edge(longest);
  } else if (sides == 4) {
    const Index opposite = edges.of_corner(first + (corner - first + 2) % 4);
    const auto& [low, high, use] = edges.edge(opposite);
    if (excess_[static_cast<std::size_t>(opposite)] > share_of_opposite &&
        lengths_[static_cast<std::size_t>(opposite)] > share_of_opposite * size_at(low, high))
      mark_edge(opposite);
  }
}

void Division::mark(const EdgeTable& edges) {
  const auto count = static_cast<std::size_t>(edges.count());
  lengths_.resize(count);
  excess_.resize(count);
  marked_.assign(count, 0);
  std::vector<Index> due;
  for (Index e = 0; e < edges.count(); ++e) {
    end_if_cancelled_at(static_cast<std::size_t>(e));
    const auto& [low, high, use] = edges.edge(e);
    const double long_by = lengths_[static_cast<std::size_t>(e)] = length(low, high);
    const double much = excess_[static_cast<std::size_t>(e)] = excess(low, high);
    if (!(much > 1 && long_by > size_at(low, high)) || is_kept(edges.edge(e))) continue;
    marked_[static_cast<std::size_t>(e)] = 1;
    due.push_back(e);
  }
  while (!due.empty()) {
    const Index e = due.back();
    due.pop_back();
    for (const Index corner : edges.uses(e))
      mark_also(face_of_corner_[static_cast<std::size_t>(corner)], corner, edges, due);
  }
}

/// Whether a face of more than four nodes is too wide, though its edges need not be long.
bool Division::is_too_wide(std::span<const Index> face) const {
  if (face.size() < 5) return false;
  Vector3 middle = Vector3::Zero();
  Vector3 normal = Vector3::Zero();
  for (const Index node : face) {
    middle += positions_[static_cast<std::size_t>(node)];
    if (how_.turn) normal += normals_[static_cast<std::size_t>(node)];
  }
  middle /= static_cast<double>(face.size());
  return std::any_of(face.begin(), face.end(), [&](Index node) {
    const auto i = static_cast<std::size_t>(node);
    return excess(middle, positions_[i], normal, how_.turn ? normals_[i] : Vector3::Zero()) > 1 &&
           (middle - positions_[i]).norm() > sizes_[i];
  });
}

Index Division::add_mean(std::span<const Index> of) {
  Vector3 place = Vector3::Zero();
  double size = 0;
  Vector3 normal = Vector3::Zero();
  for (const Index node : of) {
    const auto i = static_cast<std::size_t>(node);
    // Halves before the sum, which could overflow.
    place += positions_[i] / static_cast<double>(of.size());
    size += sizes_[i] / static_cast<double>(of.size());
    if (how_.turn) normal += normals_[i];
  }
  const auto node = static_cast<Index>(positions_.size());
  positions_.push_back(place);
  sizes_.push_back(size);
  if (how_.turn) normals_.push_back(normal.stableNormalized());
  result_.mean_of.insert(result_.mean_of.end(), of.begin(), of.end());
  result_.mean_begin.push_back(static_cast<Index>(result_.mean_of.size()));
  return node;
}

/// Returns whether there was anything to divide.
bool Division::divide_once() {
  const EdgeTable edges(faces_, static_cast<Index>(positions_.size()));
  face_of_corner_.resize(faces_.corners.size());
  for (Index f = 0; f < faces_.count(); ++f)
    std::fill(face_of_corner_.begin() + faces_.begin[static_cast<std::size_t>(f)],
              face_of_corner_.begin() + faces_.begin[static_cast<std::size_t>(f) + 1], f);
  if (result_.new_node_count() == 0) {
    find_sizes(edges);
    refuse_too_many(edges);
  }
  mark(edges);

  const auto is_due = [&](Index f) {
    for (Index corner = faces_.begin[static_cast<std::size_t>(f)];
         corner < faces_.begin[static_cast<std::size_t>(f) + 1]; ++corner) {
      if (marked_[static_cast<std::size_t>(edges.of_corner(corner))] != 0) return true;
    }
    return is_too_wide(faces_.face(f)) && is_convex(faces_.face(f), positions_);
  };
  std::vector<std::uint8_t> due;
  std::int64_t count = result_.new_node_count() + std::count(marked_.begin(), marked_.end(), 1);
  for (Index f = 0; f < faces_.count(); ++f) {
    due.push_back(is_due(f) ? 1 : 0);
    // Some quads need no node inside; near the limit that makes no difference.
    if (due.back() != 0 && faces_.face(f).size() > 3) ++count;
  }
  if (std::find(due.begin(), due.end(), 1) == due.end()) return false;
  if (count > most_new_nodes)
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} would need more than {} new nodes, which are refused; allow {}",
                            how_.length ? fmt::format("edges of at most {}", *how_.length)
                                        : fmt::format("edges that turn by at most {}°", *how_.turn),
                            most_new_nodes, how_.length ? "longer ones" : "greater turns"));

  std::vector<Index> middle_of(marked_.size(), -1);
  const auto first = static_cast<Index>(positions_.size());
  for (Index e = 0; e < edges.count(); ++e) {
    const auto& [low, high, use] = edges.edge(e);
    if (marked_[static_cast<std::size_t>(e)] != 0)
      middle_of[static_cast<std::size_t>(e)] = add_mean(std::array{low, high});
  }
  DivisionContext context = {.positions = positions_,
                             .add_mean = [&](std::span<const Index> of) { return add_mean(of); },
                             .is_edge =
                                 [&](Index low, Index high) {
                                   return edges.joins(low, high) ||
                                          std::binary_search(kept_edges_.begin(), kept_edges_.end(),
                                                             std::pair(low, high));
                                 },
                             .new_edges = {}};
  FaceParcel parts;
  std::vector<Index> middles;
  for (Index f = 0; f < faces_.count(); ++f) {
    const auto face = faces_.face(f);
    const Index from = faces_.from[static_cast<std::size_t>(f)];
    if (due[static_cast<std::size_t>(f)] == 0) {
      parts.add(face, from);
      continue;
    }
    middles.clear();
    for (Index k = 0; k < static_cast<Index>(face.size()); ++k)
      middles.push_back(
          middle_of[static_cast<std::size_t>(edges.of_corner(faces_.begin[static_cast<std::size_t>(f)] + k))]);
    divide({face, middles, from, is_convex(face, positions_)}, context, parts);
  }
  result_.constraints.add_nodes(static_cast<Index>(positions_.size()) - first);
  for (Index e = 0; e < edges.count(); ++e) {
    if (marked_[static_cast<std::size_t>(e)] != 0 && edges.uses(e).size() == 1)
      hold_between(result_.constraints, middle_of[static_cast<std::size_t>(e)], edges.edge(e).low, edges.edge(e).high,
                   length(edges.edge(e).low, edges.edge(e).high));
  }
  faces_ = std::move(parts);
  return true;
}

Refined Division::take() {
  std::vector<Index> face_begin = {0};
  std::vector<Index> corners;
  const auto add = [&](std::span<const Index> face, Index from) {
    corners.insert(corners.end(), face.begin(), face.end());
    face_begin.push_back(static_cast<Index>(corners.size()));
    result_.face_from.push_back(from);
  };
  Index part = 0;
  for (Index f = 0; f < mesh_.face_count(); ++f) {
    if (in_part_[static_cast<std::size_t>(f)] == 0) add(mesh_.face(f), f);
    for (; part < faces_.count() && faces_.from[static_cast<std::size_t>(part)] == f; ++part) add(faces_.face(part), f);
  }
  result_.mesh = PolygonMesh(std::move(positions_), std::move(face_begin), std::move(corners));
  return std::move(result_);
}

Refined Division::run() {
  take_part();
  find_kept_edges();
  if (how_.turn) {
    std::vector<Index> nodes(positions_.size());
    std::iota(nodes.begin(), nodes.end(), 0);
    normals_ = estimate_normals(mesh_, nodes);
  }
  while (divide_once()) end_if_cancelled();
  return take();
}

}  // namespace

void Refinement::validate() const {
  if (length.has_value() == turn.has_value())
    throw Error(ErrorCode::invalid_argument, "exactly one of length and turn has to be given");
  if (length && !(*length > 0 && std::isfinite(*length)))
    throw Error(ErrorCode::invalid_argument,
                fmt::format("length is {}, but has to be greater than 0 and finite", *length));
  if (turn && !(*turn > 0 && *turn < 180))
    throw Error(ErrorCode::invalid_argument,
                fmt::format("turn is {}, but has to be more than 0 and less than 180 degrees", *turn));
}

Refined refine(const PolygonMesh& mesh, const Constraints& constraints, const Refinement& how) {
  how.validate();
  if (constraints.node_count() != mesh.node_count())
    throw Error(ErrorCode::unusable_constraint, fmt::format("constraints of {} nodes given for a mesh of {}",
                                                            constraints.node_count(), mesh.node_count()));
  Refined refined = Division(mesh, constraints, how).run();
  refined.boundary_reach = boundary_reach_of(mesh);
  return refined;
}

}  // namespace vspring
