#include "fairness/measure.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "fairness/counted.hpp"
#include "shape/face_geometry.hpp"
#include "shape/fan.hpp"
#include "spring/pseudo_normal.hpp"
#include "spring/v_spring.hpp"

namespace vspring {

namespace {

// Sums are taken task by task and then over the tasks in order, so that they do not depend on the number of threads.
constexpr std::size_t nodes_per_task = 2048;
constexpr std::size_t faces_per_task = 4096;

struct Sums {
  double energy = 0;
  double squared_turns = 0;
  double greatest_turn = 0;
  double turns = 0;

  void add(const Sums& other) {
    energy += other.energy;
    squared_turns += other.squared_turns;
    greatest_turn = std::max(greatest_turn, other.greatest_turn);
    turns += other.turns;
  }
};

class Measurement {
 public:
  Measurement(const PolygonMesh& mesh, const Constraints* constraints, ThreadTeam& team)
      : mesh_(mesh),
        constraints_(constraints),
        team_(team),
        incidence_(mesh),
        counted_(counted_faces(mesh, constraints)),
        positions_(placed(mesh, Frame(box_around(mesh, counted_)))) {
    compute_normals();
  }

  Fairness sum() {
    const auto nodes = static_cast<std::size_t>(mesh_.node_count());
    std::vector<Sums> sums((nodes + nodes_per_task - 1) / nodes_per_task);
    parallel_ranges(team_, nodes, nodes_per_task, [&](std::size_t begin, std::size_t end) {
      FanWalker walker(mesh_, incidence_);
      Sums& part = sums[begin / nodes_per_task];
      for (std::size_t i = begin; i < end; ++i) {
        add_edges(static_cast<Index>(i), walker, part);
        add_turns(static_cast<Index>(i), part);
      }
    });
    Sums all;
    for (const Sums& part : sums) all.add(part);
    constexpr double degrees = 180 / std::numbers::pi;
    Fairness fairness;
    fairness.vspring_energy = all.energy;
    fairness.greatest_turn = degrees * all.greatest_turn;
    fairness.mean_turn = all.turns > 0 ? degrees * std::sqrt(all.squared_turns / all.turns) : 0;
    return fairness;
  }

 private:
  [[nodiscard]] const Vector3& position(Index node) const { return positions_[static_cast<std::size_t>(node)]; }

  void compute_normals() {
    node_normals_.assign(static_cast<std::size_t>(mesh_.node_count()), Vector3::Zero());
    parallel_ranges(team_, node_normals_.size(), nodes_per_task, [&](std::size_t begin, std::size_t end) {
      FanWalker walker(mesh_, incidence_);
      for (std::size_t i = begin; i < end; ++i) {
        const auto node = static_cast<Index>(i);
        if (!touches_counted(node)) continue;
        node_normals_[i] = constraints_ != nullptr && constraints_->normal_fixed(node)
                               ? constraints_->normal(node)
                               : LinkNormal()(position(node), walker.walk(node).links, positions_);
      }
    });
    face_normals_.assign(static_cast<std::size_t>(mesh_.face_count()), Vector3::Zero());
    parallel_ranges(team_, face_normals_.size(), faces_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t f = begin; f < end; ++f) {
        if (counted_[f] != 0) face_normals_[f] = unit_normal(mesh_.face(static_cast<Index>(f)), positions_);
      }
    });
  }

  [[nodiscard]] bool touches_counted(Index node) const {
    const auto corners = incidence_.corners(node);
    return std::any_of(corners.begin(), corners.end(),
                       [&](Corner corner) { return counted_[static_cast<std::size_t>(corner.face)] != 0; });
  }

  void add_edges(Index i, FanWalker& walker, Sums& sums) const {
    if (!touches_counted(i)) return;
    for (const Link link : walker.walk(i).links) {
      const auto j = static_cast<Index>(link.node());
      if (!link.spoke() || j < i) continue;
      if (constraints_ != nullptr && constraints_->position_fixed(i) && constraints_->position_fixed(j)) continue;
      const Vector3 d = position(j) - position(i);
      const double length = d.norm();
      if (!(length > 0) || !std::isfinite(length)) continue;
      const double difference = spring_difference(d / length, node_normals_[static_cast<std::size_t>(i)],
                                                  node_normals_[static_cast<std::size_t>(j)]);
      sums.energy += difference * difference;
    }
  }

  // Turns across the edges from node i to nodes of a larger number.
  void add_turns(Index i, Sums& sums) const {
    const auto corners = incidence_.corners(i);
    for (std::size_t a = 0; a < corners.size(); ++a) {
      for (const bool forward_a : {true, false}) {
        const Index j = end_of(corners[a], forward_a);
        if (j < i) continue;
        std::size_t others = 0;
        std::size_t other = 0;
        bool same_sense = false;
        for (std::size_t b = 0; b < corners.size(); ++b) {
          for (const bool forward_b : {true, false}) {
            if ((b == a && forward_a == forward_b) || end_of(corners[b], forward_b) != j) continue;
            ++others;
            other = b;
            same_sense = forward_a == forward_b;
          }
        }
        if (others == 1 && other > a) add_turn(corners[a].face, corners[other].face, same_sense, sums);
      }
    }
  }

  [[nodiscard]] Index end_of(Corner corner, bool forward) const {
    const auto face = mesh_.face(corner.face);
    const auto place = static_cast<std::size_t>(corner.place);
    return forward ? face[(place + 1) % face.size()] : face[(place + face.size() - 1) % face.size()];
  }

  void add_turn(Index a, Index b, bool same_sense, Sums& sums) const {
    const Vector3& normal_a = face_normals_[static_cast<std::size_t>(a)];
    const Vector3 normal_b = (same_sense ? -1.0 : 1.0) * face_normals_[static_cast<std::size_t>(b)];
    if (normal_a.isZero(0) || normal_b.isZero(0)) return;
    const double turn = std::atan2(normal_a.cross(normal_b).norm(), normal_a.dot(normal_b));
    sums.greatest_turn = std::max(sums.greatest_turn, turn);
    sums.squared_turns += turn * turn;
    sums.turns += 1;
  }

  const PolygonMesh& mesh_;
  const Constraints* constraints_;
  ThreadTeam& team_;
  Incidence incidence_;
  std::vector<std::uint8_t> counted_;
  std::vector<Vector3> positions_;
  std::vector<Vector3> node_normals_;
  std::vector<Vector3> face_normals_;
};

}  // namespace

Fairness measure(const PolygonMesh& mesh, const Constraints* constraints, ThreadTeam& team) {
  return Measurement(mesh, constraints, team).sum();
}

Fairness measure(const PolygonMesh& mesh, const Constraints* constraints) {
  ThreadTeam alone(1);
  return measure(mesh, constraints, alone);
}

}  // namespace vspring
