// Checks that a surface can be faired under its constraints, and whether these determine one result.

#include "constraints/holding.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <optional>
#include <string>
#include <utility>

#include "base/cancellation.hpp"
#include "base/dense_algebra.hpp"
#include "base/disjoint_sets.hpp"
#include "constraints/immovable_nodes_fixed.hpp"
#include "shape/boundary.hpp"
#include "shape/face_geometry.hpp"
#include "shape/fan.hpp"
#include "shape/frame.hpp"
#include "shape/node_graph.hpp"
#include "vspring/error.hpp"
#include "vspring/topology.hpp"

namespace vspring {

namespace {

constexpr std::size_t faults_named = 3;
constexpr Index fewest_held_of_a_loop = 3;
// Faces of an edge at which two solids touch.
constexpr std::size_t faces_of_two_solids = 4;
// The sine of about 6°, the least angle between a surface and the support of its nodes: at a smaller one nodes would
// slide more than ten times as far as the surface moves.
constexpr double least_slope = 0.1;
// In the system for the spheres through the data, a pivot below this share of the largest counts as zero.
constexpr double no_information = 1e-12;

class Holding {
 public:
  Holding(const PolygonMesh& mesh, const Constraints& constraints, std::span<const std::uint8_t> pulled)
      : mesh_(mesh),
        constraints_(constraints),
        pulled_(pulled),
        incidence_(mesh),
        graph_(mesh, incidence_),
        parts_(static_cast<std::size_t>(mesh.node_count())),
        inside_(static_cast<std::size_t>(mesh.node_count()), 0) {}

  void refuse_defects() {
    const bool are_lost = any_lost_nodes();
    // Held nodes next to moving ones: their normals and spheres follow from all faces around them.
    std::vector<std::uint8_t> is_rim(are_lost ? static_cast<std::size_t>(mesh_.node_count()) : 0, 0);
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      look(f);
      const auto face = mesh_.face(f);
      if (std::none_of(face.begin(), face.end(), [&](Index i) { return !constraints_.position_fixed(i); })) continue;
      if (face.size() < 3) add_fault(Defect{.kind = Defect::Kind::too_few_nodes, .face = f}, face[0]);
      if (!are_lost) continue;
      refuse_lost_nodes(face);
      for (const Index i : face) {
        if (constraints_.position_fixed(i)) is_rim[static_cast<std::size_t>(i)] = 1;
      }
    }
    for (Index f = 0; f < mesh_.face_count() && are_lost; ++f) {
      const auto face = mesh_.face(f);
      if (std::any_of(face.begin(), face.end(), [&](Index i) { return is_rim[static_cast<std::size_t>(i)] != 0; }))
        refuse_lost_nodes(face);
    }
    FanWalker walker(mesh_, incidence_);
    for (Index i = 0; i < mesh_.node_count(); ++i) {
      look(i);
      if (!moves(i)) continue;
      const Fan& fan = walker.walk(i);
      check_fan(i, fan);
      inside_[static_cast<std::size_t>(i)] = fan.closed ? 1 : 0;
    }
    check_sliding();
    if (faults_.empty()) return;
    std::string text;
    for (const std::string& fault : faults_) text += (text.empty() ? "" : "; ") + fault;
    if (fault_count_ > faults_.size()) text += fmt::format("; and {} more", fault_count_ - faults_.size());
    if (!broken_) throw ImmovableNodes(text, std::move(immovable_));
    throw Error(ErrorCode::unusable_shape, text + ". Such places cannot move",
                {{Remedy::input, "mend the mesh"},
                 {Remedy::rules,
                  fmt::format("hold them by a rule such as {{\"nodes\": [{}], \"position\": \"fixed\"}}", fault_node_)},
                 {Remedy::region, "let only a region move, one without them"}});
  }

  void refuse_unheld() {
    join_parts();
    const auto nodes = static_cast<std::size_t>(mesh_.node_count());
    std::vector<Index> held(nodes, 0);
    std::vector<Index> size(nodes, 0);
    for (Index i = 0; i < mesh_.node_count(); ++i) {
      look(i);
      if (!moves(i)) continue;
      ++size[static_cast<std::size_t>(find(i))];
      if (pulled(i)) held[static_cast<std::size_t>(find(i))] = 1;
      graph_.for_each_neighbour(i, [&](Index j) {
        if (constraints_.position_fixed(j)) held[static_cast<std::size_t>(find(i))] = 1;
      });
    }
    for (Index i = 0; i < mesh_.node_count(); ++i) {
      if (!moves(i) || find(i) != i || held[static_cast<std::size_t>(i)] != 0) continue;
      std::vector<Advice> advice = {{Remedy::rules, "hold some of its nodes by a rule"},
                                    {Remedy::region, "let only a region move"},
                                    {Remedy::noise, "only take its noise off"}};
      const bool is_open = has_boundary(i);
      if (is_open) advice.insert(advice.begin(), {Remedy::fix_boundary, "fix the boundary"});
      throw Error(ErrorCode::unusable_constraint,
                  fmt::format("nothing holds the component of node {} ({} nodes{}): it would shrink to a point", i,
                              size[static_cast<std::size_t>(i)], is_open ? "" : ", closed"),
                  std::move(advice));
    }
  }

  /// Whether a component, by its representative, has a boundary.
  bool has_boundary(Index component) {
    const auto loops = boundary().loops();
    return std::any_of(loops.begin(), loops.end(),
                       [&](const auto& loop) { return moves(loop.front()) && find(loop.front()) == component; });
  }

  void check_boundaries(std::vector<Warning>& warnings) {
    Index free_nodes = 0;
    Index first_free = -1;
    const auto loops = boundary().loops();
    for (const auto& loop : loops) {
      const auto held =
          static_cast<Index>(std::count_if(loop.begin(), loop.end(), [&](Index i) { return is_held_or_slides(i); }));
      const auto length = static_cast<Index>(loop.size());
      if (held == length) continue;
      const Index first = *std::find_if(loop.begin(), loop.end(), [&](Index i) { return !is_held_or_slides(i); });
      if (held < fewest_held_of_a_loop)
        throw Error(
            ErrorCode::unusable_constraint,
            fmt::format("the boundary loop through node {} is free: {} of its {} nodes are held, and it would shrink",
                        first, held, length),
            {{Remedy::fix_boundary, "fix the boundary"},
             {Remedy::fair_boundary, "make it fair by itself first"},
             {Remedy::rules, "hold nodes of it by a rule"},
             {Remedy::region, "let only a region move"}});
      free_nodes += length - held;
      if (first_free < 0) first_free = first;
    }
    if (free_nodes > 0)
      warnings.push_back({WarningCode::free_boundary,
                          fmt::format("{} boundary node{} free and will be drawn in, node {} first", free_nodes,
                                      free_nodes == 1 ? " is" : "s are", first_free),
                          {{Remedy::fix_boundary,
                            free_nodes == 1 ? "fix the boundary to hold it" : "fix the boundary to hold them"}}});
  }

  /// Spheres and planes a|x|² + b·x + c = 0 are fair. If more than one of them fits the positions, normals and
  /// adjoining faces that hold a part without boundary, a family of shapes is fair.
  void warn_of_families(std::vector<Warning>& warnings) {
    using System = Eigen::Matrix<double, 5, 5>;
    const auto& on_boundary = boundary().nodes();
    Eigen::AlignedBox<double, 3> box;
    for (Index i = 0; i < mesh_.node_count(); ++i) {
      if (constraints_.position_fixed(i) && constraints_.position(i).allFinite()) box.extend(constraints_.position(i));
      if (moves(i) && pulled(i)) box.extend(mesh_.position(i));
    }
    const Frame frame(box);
    std::vector<Index> system_of(static_cast<std::size_t>(mesh_.node_count()), -1);
    std::vector<System> systems;
    std::vector<Index> first_node;
    std::vector<std::uint8_t> bounded;
    const auto system = [&](Index i) {
      Index& number = system_of[static_cast<std::size_t>(find(i))];
      if (number < 0) {
        number = static_cast<Index>(systems.size());
        systems.emplace_back(System::Zero());
        first_node.push_back(i);
        bounded.push_back(0);
      }
      return static_cast<std::size_t>(number);
    };
    const auto add = [&](std::size_t k, double square, const Vector3& linear, double constant) {
      Eigen::Matrix<double, 5, 1> row;
      row << square, linear, constant;
      systems[k] += row * row.transpose();
    };
    const auto add_place = [&](std::size_t k, const Vector3& p) { add(k, p.dot(p), p, 1); };
    std::vector<std::size_t> met;
    for (Index j = 0; j < mesh_.node_count(); ++j) {
      look(j);
      met.clear();
      if (moves(j)) {
        if (on_boundary[static_cast<std::size_t>(j)] != 0) bounded[system(j)] = 1;
        const std::size_t k = system(j);
        // Points hold a node near its place.
        if (pulled(j)) add_place(k, frame.to_local(mesh_.position(j)));
        continue;
      }
      graph_.for_each_neighbour(j, [&](Index i) {
        if (moves(i) && std::find(met.begin(), met.end(), system(i)) == met.end()) met.push_back(system(i));
      });
      for (const std::size_t k : met) {
        if (on_boundary[static_cast<std::size_t>(j)] != 0) bounded[k] = 1;
        const Vector3 p = frame.to_local(constraints_.position(j));
        add_place(k, p);
        const Vector3 normal = constraints_.normal_fixed(j) ? constraints_.normal(j) : normal_of_held_faces(j);
        if (normal.isZero(0)) continue;
        // The gradient 2a p + b has the direction of the normal, so its components across vanish.
        const Vector3 across = normal.unitOrthogonal();
        for (const Vector3& t : {across, Vector3(normal.cross(across))}) add(k, 2 * p.dot(t), t, 0);
      }
    }
    std::size_t loose = 0;
    Index first = -1;
    for (std::size_t k = 0; k < systems.size(); ++k) {
      if (bounded[k] != 0) continue;
      if (PivotedCholesky(systems[k]).rank(no_information) >= 4) continue;
      if (loose++ == 0) first = first_node[k];
    }
    if (loose > 0)
      warnings.push_back(
          {WarningCode::family_of_shapes,
           fmt::format("what holds the component of node {}{} leaves a family of shapes, and the result is one of them",
                       first, loose > 1 ? fmt::format(" and {} more", loose - 1) : ""),
           {{Remedy::rules, "hold more nodes, or normals, to choose"}}});
  }

 private:
  /// The approximate normal of the held faces at a held node; zero if there are none.
  [[nodiscard]] Vector3 normal_of_held_faces(Index node) const {
    Vector3 sum = Vector3::Zero();
    for (const auto& corner : incidence_.corners(node)) {
      const auto face = mesh_.face(corner.face);
      if (std::all_of(face.begin(), face.end(), [&](Index i) { return constraints_.position_fixed(i); }))
        sum += twice_vector_area(face, mesh_.positions());
    }
    return sum.squaredNorm() > 0 && sum.allFinite() ? sum.normalized() : Vector3(Vector3::Zero());
  }

  static void look(Index step) { end_if_cancelled_at(static_cast<std::size_t>(step)); }

  [[nodiscard]] bool is_lost(Index i) const {
    return !(constraints_.position_fixed(i) ? constraints_.position(i) : mesh_.position(i)).allFinite();
  }

  /// Rarely true, which saves a search through the faces.
  [[nodiscard]] bool any_lost_nodes() const {
    for (Index i = 0; i < mesh_.node_count(); ++i) {
      if (is_lost(i)) return true;
    }
    return false;
  }

  void refuse_lost_nodes(std::span<const Index> face) {
    for (const Index i : face) {
      if (is_lost(i)) add_fault(Defect{.kind = Defect::Kind::not_finite, .node = i}, i);
    }
  }

  [[nodiscard]] bool moves(Index i) const { return !constraints_.position_fixed(i) && !incidence_.corners(i).empty(); }
  [[nodiscard]] bool pulled(Index i) const { return !pulled_.empty() && pulled_[static_cast<std::size_t>(i)] != 0; }

  void add_fault(const Defect& defect, Index node) {
    if (defect.kind == Defect::Kind::too_few_nodes || defect.kind == Defect::Kind::not_finite)
      broken_ = true;
    else
      immovable_.push_back(node);
    ++fault_count_;
    if (fault_node_ < 0) fault_node_ = node;
    const std::string message = defect.message();
    if (std::find(faults_.begin(), faults_.end(), message) != faults_.end()) {
      --fault_count_;
    } else if (faults_.size() < faults_named) {
      faults_.push_back(message);
    }
  }

  [[nodiscard]] bool is_held_or_slides(Index i) const {
    return constraints_.position_fixed(i) || constraints_.support(i) != nullptr;
  }

  /// Refuses sliding nodes at a boundary without a given normal, and those too far away from their support; finds those
  /// that cannot move across the surface along it.
  void check_sliding() {
    if (constraints_.sliding_count() == 0) return;
    std::vector<Index> nodes;
    for (Index i = 0; i < mesh_.node_count(); ++i) {
      if (moves(i) && constraints_.support(i) != nullptr && !is_lost(i)) nodes.push_back(i);
    }
    const PlacesOnSupports places(mesh_.positions(), constraints_);
    const std::vector<Vector3> normals = estimate_normals(mesh_, nodes);
    for (std::size_t k = 0; k < nodes.size(); ++k) {
      const Index i = nodes[k];
      if (inside_[static_cast<std::size_t>(i)] == 0 && !constraints_.normal_fixed(i))
        throw Error(
            ErrorCode::unusable_constraint,
            fmt::format("node {} slides at the boundary and has no given normal, so nothing says how the surface "
                        "ends there; give it one, or fix the normals of the boundary as they are",
                        i));
      const Vector3 place = places(i, mesh_.position(i));
      const Vector3& normal = constraints_.normal_fixed(i) ? constraints_.normal(i) : normals[k];
      const Support& support = *constraints_.support(i);
      const double lean = std::abs(support.axis(place).dot(normal));
      const bool lies_along = support.is_curve() ? lean < least_slope : 1 - lean * lean < least_slope * least_slope;
      if (!normal.isZero(0) && lies_along) add_stuck(i);
    }
  }

  void add_stuck(Index i) {
    immovable_.push_back(i);
    ++fault_count_;
    if (fault_node_ < 0) fault_node_ = i;
    if (faults_.size() < faults_named)
      faults_.push_back(fmt::format("node {} cannot slide, as the surface lies along its support there", i));
  }

  void check_fan(Index i, const Fan& fan) {
    if (fan.repeating_face >= 0)
      return add_fault({.kind = Defect::Kind::repeated_node, .node = i, .face = fan.repeating_face}, i);
    const auto corners = incidence_.corners(i);
    if (fan.crowded_neighbour >= 0 || (fan.closed && corners.size() == 2)) {
      for (std::size_t b = 1; b < corners.size(); ++b) {
        for (std::size_t a = 0; a < b; ++a) {
          if (same_nodes(corners[a].face, corners[b].face))
            return add_fault({.kind = Defect::Kind::duplicate_face, .other = corners[a].face, .face = corners[b].face},
                             i);
        }
      }
    }
    if (fan.crowded_neighbour >= 0) {
      const auto [low, high] = std::minmax(i, fan.crowded_neighbour);
      hold_touching_faces(i, fan.crowded_neighbour);
      return add_fault({.kind = Defect::Kind::non_manifold_edge, .node = low, .other = high}, i);
    }
    if (!fan.manifold()) add_fault({.kind = Defect::Kind::non_manifold_node, .node = i}, i);
  }

  /// Solids that touch at an edge shrink away from it: an edge held alone would stay as a spike with flipped faces.
  void hold_touching_faces(Index i, Index j) {
    std::vector<Index> nodes;
    std::size_t faces = 0;
    for (const Corner corner : incidence_.corners(i)) {
      const auto face = mesh_.face(corner.face);
      const auto at = static_cast<std::size_t>(corner.place);
      if (face[(at + 1) % face.size()] != j && face[(at + face.size() - 1) % face.size()] != j) continue;
      ++faces;
      std::copy_if(face.begin(), face.end(), std::back_inserter(nodes), [&](Index k) { return moves(k); });
    }
    if (faces >= faces_of_two_solids) immovable_.insert(immovable_.end(), nodes.begin(), nodes.end());
  }

  [[nodiscard]] bool same_nodes(Index a, Index b) const {
    const auto face_a = mesh_.face(a);
    const auto face_b = mesh_.face(b);
    return face_a.size() == face_b.size() && std::is_permutation(face_a.begin(), face_a.end(), face_b.begin());
  }

  void join_parts() {
    for (Index i = 0; i < mesh_.node_count(); ++i) {
      look(i);
      if (!moves(i)) continue;
      graph_.for_each_neighbour(i, [&](Index j) {
        // Each edge once: i < j.
        if (i < j && moves(j)) parts_.join(static_cast<std::size_t>(i), static_cast<std::size_t>(j));
      });
    }
  }

  /// Found once, on demand.
  const Boundary& boundary() {
    if (!boundary_) boundary_.emplace(mesh_, incidence_, inside_);
    return *boundary_;
  }

  Index find(Index i) { return static_cast<Index>(parts_.find(static_cast<std::size_t>(i))); }

  const PolygonMesh& mesh_;
  const Constraints& constraints_;
  std::span<const std::uint8_t> pulled_;
  Incidence incidence_;
  NodeGraph graph_;
  DisjointSets parts_;                // of moving nodes
  std::vector<std::uint8_t> inside_;  ///< moving nodes with faces all around
  std::optional<Boundary> boundary_;
  std::vector<std::string> faults_;
  std::size_t fault_count_ = 0;
  Index fault_node_ = -1;
  bool broken_ = false;  ///< by a defect that holding nodes does not mend
  std::vector<Index> immovable_;
};

}  // namespace

void refuse_sliding(const Constraints& constraints, const char* why) {
  for (Index node = 0; node < constraints.node_count() && constraints.sliding_count() > 0; ++node) {
    if (constraints.support(node) != nullptr)
      throw Error(ErrorCode::unusable_constraint, fmt::format("node {} cannot slide: {}", node, why));
  }
}

bool slides_at_boundary(const PolygonMesh& mesh, const Constraints& constraints) {
  if (constraints.sliding_count() == 0) return false;
  const std::vector<std::uint8_t> boundary = boundary_nodes(mesh);
  for (Index node = 0; node < std::min(mesh.node_count(), constraints.node_count()); ++node) {
    if (boundary[static_cast<std::size_t>(node)] != 0 && constraints.support(node) != nullptr) return true;
  }
  return false;
}

PlacesOnSupports::PlacesOnSupports(const std::vector<Vector3>& positions, const Constraints& constraints)
    : constraints_(constraints.sliding_count() > 0 ? constraints : Constraints(0)) {
  if (constraints.sliding_count() == 0) return;
  Eigen::AlignedBox<double, 3> box;
  for (const Vector3& position : positions) {
    if (position.allFinite()) box.extend(position);
  }
  if (!box.isEmpty()) size_ = box.diagonal().norm();
}

const Support* PlacesOnSupports::support(Index node) const {
  return constraints_.sliding_count() > 0 ? constraints_.support(node) : nullptr;
}

Vector3 PlacesOnSupports::operator()(Index node, const Vector3& position) const {
  if (support(node) == nullptr) return position;
  const auto place = support(node)->nearest(position);
  if (!place)
    throw Error(ErrorCode::unusable_constraint,
                fmt::format("node {} lies on the axis of its support, where no place of the support is the nearest; "
                            "move it off, or let it slide on something else",
                            node));
  const double distance = (*place - position).norm();
  if (!(distance <= size_))
    throw Error(ErrorCode::unusable_constraint,
                fmt::format("node {} lies {:.3g} away from what it slides on, and the shape is {:.3g} large; move it "
                            "there, or let it slide on something nearer",
                            node, distance, size_));
  return *place;
}

void refuse_corners(const Constraints& of_surface) {
  for (Index node = 0; node < of_surface.node_count() && of_surface.corner_count() > 0; ++node) {
    if (of_surface.corner(node))
      throw Error(ErrorCode::unusable_constraint,
                  fmt::format("node {} cannot be a corner: it is of a surface, and corners are of curves", node));
  }
}

std::vector<Warning> check_constraints(const PolygonMesh& mesh, const Constraints& constraints) {
  ImmovableNodesFixed immovable(mesh);
  std::vector<Warning> warnings = immovable.run(constraints, [](const PolygonMesh& sheets, const Constraints& held) {
    return check_constraints(sheets, held, {});
  });
  immovable.warn(constraints, warnings);
  return warnings;
}

std::vector<Warning> check_constraints(const PolygonMesh& mesh, const Constraints& constraints,
                                       std::span<const std::uint8_t> pulled) {
  if (constraints.node_count() != mesh.node_count())
    throw Error(ErrorCode::invalid_argument, fmt::format("constraints for {} nodes given with a mesh of {}",
                                                         constraints.node_count(), mesh.node_count()));
  refuse_corners(constraints);
  Holding holding(mesh, constraints, pulled);
  std::vector<Warning> warnings;
  holding.refuse_defects();
  holding.refuse_unheld();
  holding.check_boundaries(warnings);
  holding.warn_of_families(warnings);
  return warnings;
}

}  // namespace vspring
