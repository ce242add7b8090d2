#include "fairness/measure.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "base/degrees.hpp"
#include "fairness/counted.hpp"
#include "shape/face_geometry.hpp"
#include "shape/fan.hpp"
#include "shape/large_faces.hpp"
#include "spring/pseudo_normal.hpp"
#include "spring/v_spring.hpp"

namespace vspring {

namespace {

constexpr std::size_t edges_per_task = 8192;

struct Turns {
  double squares = 0;
  double greatest = 0;
  double count = 0;

  void add(const Turns& other) {
    squares += other.squares;
    greatest = std::max(greatest, other.greatest);
    count += other.count;
  }
};

/// The other end of the edge that leaves a corner forward or backward.
Index end_of(const PolygonMesh& mesh, Corner corner, bool forward) {
  const auto face = mesh.face(corner.face);
  const auto place = static_cast<std::size_t>(corner.place);
  return forward ? face[(place + 1) % face.size()] : face[(place + face.size() - 1) % face.size()];
}

/// Gathers the pairs of faces at a node's edges; one object serves one node after the other.
class NeighbouringFaces {
 public:
  explicit NeighbouringFaces(const PolygonMesh& mesh) : mesh_(&mesh) {}

  /// Calls use(face a, face b, same sense) for every edge of two faces from node i to a node of a larger number. Cost:
  /// d log d for d faces.
  template <typename Use>
  void for_each(Index i, std::span<const Corner> corners, const Use& use) {
    ends_.clear();
    for (std::size_t k = 0; k < 2 * corners.size(); ++k) {
      const Index j = end_of(*mesh_, corners[k / 2], is_forward(k));
      if (j >= i) ends_.push_back({j, k});
    }
    std::sort(ends_.begin(), ends_.end());
    pairs_.clear();
    for (auto first = ends_.begin(); first != ends_.end();) {
      const auto last = std::find_if(first, ends_.end(), [&](const End& end) { return end.first != first->first; });
      if (last - first == 2 && first->second / 2 != first[1].second / 2)
        pairs_.emplace_back(first->second, first[1].second);
      first = last;
    }
    // In the order of the faces.
    std::sort(pairs_.begin(), pairs_.end());
    for (const auto& [a, b] : pairs_) use(corners[a / 2].face, corners[b / 2].face, is_forward(a) == is_forward(b));
  }

 private:
  using End = std::pair<Index, std::size_t>;
  static bool is_forward(std::size_t k) { return k % 2 == 0; }

  const PolygonMesh* mesh_;
  std::vector<End> ends_;
  std::vector<std::pair<std::size_t, std::size_t>> pairs_;
};

}  // namespace

FairnessMeter::FairnessMeter(const PolygonMesh& mesh, const Constraints* constraints, ThreadTeam& team)
    : mesh_(&mesh), team_(&team), counted_(counted_faces(mesh, constraints)) {
  const std::vector<std::uint8_t> nodes = counted_nodes(mesh, counted_);
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (nodes[static_cast<std::size_t>(i)] != 0) node_.push_back(i);
  }
  const Incidence incidence(mesh);
  const std::optional<CutMesh> cut = with_large_faces_cut(mesh);
  std::optional<Incidence> incidence_of_cut;
  if (cut) incidence_of_cut.emplace(cut->mesh);
  struct Run {
    Rings rings;
    std::vector<Neighbours> neighbours;
  };
  const auto look = [&](std::size_t begin, std::size_t end, Run& run) {
    FanWalker walker(cut ? cut->mesh : mesh, cut ? *incidence_of_cut : incidence);
    std::vector<Link> links;
    NeighbouringFaces neighbouring(mesh);
    for (std::size_t k = begin; k < end; ++k) {
      links = walker.walk(node_[k]).links;
      if (cut) cut->mark(node_[k], links);
      run.rings.add(links);
      neighbouring.for_each(node_[k], incidence.corners(node_[k]), [&](Index a, Index b, bool same_sense) {
        if (counted_[static_cast<std::size_t>(a)] != 0 && counted_[static_cast<std::size_t>(b)] != 0)
          run.neighbours.push_back({a, b, same_sense});
      });
    }
  };
  std::vector<Run> runs = parallel_parts(team, node_.size(), nodes_per_task, Run(), look);
  rings_.reserve(node_.size(), 7 * node_.size());
  for (Run& run : runs) {
    for (std::size_t k = 0; k < run.rings.size(); ++k) rings_.add(run.rings.links(k));
    neighbours_.insert(neighbours_.end(), run.neighbours.begin(), run.neighbours.end());
    run = {};
  }
}

Fairness FairnessMeter::measure(const std::vector<Vector3>& positions, const Constraints* constraints) const {
  Eigen::AlignedBox<double, 3> box;
  for (const Index i : node_) box.extend(positions[static_cast<std::size_t>(i)]);
  const std::vector<Vector3> places = placed(positions, Frame(box));
  const auto place = [&](Index i) -> const Vector3& { return places[static_cast<std::size_t>(i)]; };

  std::vector<Vector3> node_normals(places.size(), Vector3::Zero());
  parallel_ranges(*team_, node_.size(), nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const Index i = node_[k];
      node_normals[static_cast<std::size_t>(i)] = constraints != nullptr && constraints->normal_fixed(i)
                                                      ? constraints->normal(i)
                                                      : LinkNormal()(place(i), rings_.links(k), places);
    }
  });
  std::vector<Vector3> face_normals(counted_.size(), Vector3::Zero());
  parallel_ranges(*team_, counted_.size(), faces_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t f = begin; f < end; ++f) {
      if (counted_[f] != 0) face_normals[f] = unit_normal(mesh_->face(static_cast<Index>(f)), places);
    }
  });

  const auto add_energy = [&](std::size_t begin, std::size_t end, double& energy) {
    for (std::size_t k = begin; k < end; ++k) {
      const Index i = node_[k];
      const bool held = constraints != nullptr && constraints->position_fixed(i);
      for (const Link link : rings_.links(k)) {
        const auto j = static_cast<Index>(link.node());
        if (!link.spoke() || j < i || (held && constraints->position_fixed(j))) continue;
        const Vector3 d = place(j) - place(i);
        const double length = d.norm();
        if (!(length > 0) || !std::isfinite(length)) continue;
        const double difference = spring_difference(d / length, node_normals[static_cast<std::size_t>(i)],
                                                    node_normals[static_cast<std::size_t>(j)]);
        energy += difference * difference;
      }
    }
  };
  const auto add_turns = [&](std::size_t begin, std::size_t end, Turns& part) {
    for (std::size_t k = begin; k < end; ++k) {
      const Vector3& a = face_normals[static_cast<std::size_t>(neighbours_[k].a)];
      const Vector3& b = face_normals[static_cast<std::size_t>(neighbours_[k].b)];
      if (a.isZero(0) || b.isZero(0)) continue;
      const double turn = std::atan2(a.cross(b).norm(), neighbours_[k].same_sense ? -a.dot(b) : a.dot(b));
      part.add({.squares = turn * turn, .greatest = turn, .count = 1});
    }
  };

  Fairness fairness;
  for (const double energy : parallel_parts(*team_, node_.size(), nodes_per_task, 0.0, add_energy))
    fairness.vspring_energy += energy;
  Turns turns;
  for (const Turns& part : parallel_parts(*team_, neighbours_.size(), edges_per_task, Turns(), add_turns))
    turns.add(part);
  fairness.greatest_turn = degrees_per_radian * turns.greatest;
  fairness.rms_turn = turns.count > 0 ? degrees_per_radian * std::sqrt(turns.squares / turns.count) : 0;
  return fairness;
}

Fairness measure(const PolygonMesh& mesh, const Constraints* constraints, ThreadTeam& team) {
  return FairnessMeter(mesh, constraints, team).measure(mesh.positions(), constraints);
}

Fairness measure(const PolygonMesh& mesh, const Constraints* constraints, const Context& context) {
  ThreadTeam team(context.thread_count());
  return measure(mesh, constraints, team);
}

Fairness measure(const PolygonMesh& mesh, const Constraints* constraints) {
  ThreadTeam alone(1);
  return measure(mesh, constraints, alone);
}

}  // namespace vspring
