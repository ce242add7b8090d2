#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// A place on a curve: the edge that begins at a node, and a share of it.
struct CurvePlace {
  std::uint32_t edge = 0;
  double share = 0;
};

/// A curve in the fit's own coordinates. Nodes are as dense as bends need, with held nodes among them; between nodes
/// are quintics with their tangents and curvatures, so curvature is continuous.
class DenseCurve {
 public:
  static constexpr std::uint32_t none = std::numeric_limits<std::uint32_t>::max();

  struct Chain {
    std::uint32_t begin = 0;
    std::uint32_t count = 0;
    bool closed = false;
  };
  struct Node {
    Vector3 place = Vector3::Zero();
    /// Given tangents before and after it, of unit length; zero: free. They are equal unless it is a corner.
    std::array<Vector3, 2> tangents = {Vector3::Zero(), Vector3::Zero()};
    bool held = false;    ///< in place
    bool corner = false;  ///< curvature and direction may jump
    bool dense = true;    ///< added by the fit, which may remove it again
    Index from = -1;      ///< its number in the file; −1: none
    double spacing = 0;   ///< wanted distance of the next nodes
  };

  /// straight: the curve consists of its chords, without quintics. moving: 1 for coordinates that may change, 0 for
  /// others.
  explicit DenseCurve(bool straight = false, Vector3 moving = Vector3::Ones())
      : straight_(straight), moving_(std::move(moving)) {}

  void add_chain(const std::vector<Node>& nodes, bool closed);

  [[nodiscard]] const std::vector<Chain>& chains() const { return chains_; }
  /// The number of the chain that an edge belongs to. Cost: the logarithm of their number.
  [[nodiscard]] std::size_t chain_of(std::uint32_t edge) const;
  [[nodiscard]] std::uint32_t size() const { return static_cast<std::uint32_t>(nodes_.size()); }
  [[nodiscard]] const Node& node(std::uint32_t i) const { return nodes_[i]; }
  [[nodiscard]] const Vector3& place(std::uint32_t i) const { return nodes_[i].place; }
  /// Sets the moving coordinates.
  void set_place(std::uint32_t i, const Vector3& place) {
    for (int k = 0; k < 3; ++k) {
      if (moving_[k] != 0) nodes_[i].place[k] = place[k];
    }
    ++version_;
  }
  [[nodiscard]] const Vector3& moving() const { return moving_; }
  [[nodiscard]] bool moves_freely() const { return moving_ == Vector3::Ones(); }
  /// The part of a vector that determines places along the curve: all of it, or the coordinates that do not move.
  [[nodiscard]] Vector3 station(const Vector3& v) const {
    return moves_freely() ? v : Vector3((Vector3::Ones() - moving_).cwiseProduct(v));
  }
  /// Holds the node at its place.
  void hold(std::uint32_t i) { nodes_[i].held = true; }
  void set_spacing(std::uint32_t i, double spacing) { nodes_[i].spacing = spacing; }
  [[nodiscard]] const Vector3& tangent(std::uint32_t i, bool after) const { return nodes_[i].tangents[after ? 1 : 0]; }
  /// Neighbours along the chain; none at its ends. An edge has the number of its first node.
  [[nodiscard]] std::uint32_t next(std::uint32_t i) const { return next_[i]; }
  [[nodiscard]] std::uint32_t before(std::uint32_t i) const { return before_[i]; }
  [[nodiscard]] bool is_edge(std::uint32_t i) const { return next_[i] != none; }
  /// Whether curvature is continuous at the node: no end, no corner, no given tangent.
  [[nodiscard]] bool is_smooth(std::uint32_t i) const {
    return next_[i] != none && before_[i] != none && !nodes_[i].corner && tangent(i, true).isZero(0);
  }
  [[nodiscard]] double edge_length(std::uint32_t edge) const { return (place(next_[edge]) - place(edge)).norm(); }

  /// Direction and curvature vector at a node, on the side of the edge after or before it.
  struct Bend {
    Vector3 tangent;
    Vector3 curvature;
  };
  [[nodiscard]] Bend bend(std::uint32_t node, bool after) const;

  /// The derivative of the curvature on one side of a node by places. Exact on circles for any spacing.
  struct CurvatureRow {
    Vector3 curvature = Vector3::Zero();
    int count = 0;  ///< 0: no curvature
    std::array<std::uint32_t, 3> nodes{};
    std::array<Eigen::Matrix3d, 3> slopes{};
  };
  [[nodiscard]] CurvatureRow curvature_row(std::uint32_t node, bool after) const;

  /// The greatest curvature at a node, on either side; 0 if it has none.
  [[nodiscard]] double greatest_curvature(std::uint32_t node) const;

  [[nodiscard]] Vector3 at(const CurvePlace& at) const;
  /// The vector from a place to a point, in the coordinates that move.
  [[nodiscard]] Vector3 offset(const CurvePlace& at, const Vector3& point) const {
    return moving_.cwiseProduct(this->at(at) - point);
  }
  [[nodiscard]] Vector3 direction(const CurvePlace& at) const;
  /// Whether a place is a node that does not move, so that nothing brings it nearer to a point.
  [[nodiscard]] bool is_at_held(const CurvePlace& at) const {
    return (at.share == 0 && node(at.edge).held) || (at.share == 1 && node(next(at.edge)).held);
  }

  /// A place on an edge as a weighted sum of the nodes before the edge, at its ends and after it, plus a constant.
  struct PlaceRow {
    std::array<std::uint32_t, 4> nodes{};
    std::array<double, 4> weights{};
    Vector3 rest = Vector3::Zero();
  };
  [[nodiscard]] PlaceRow place_row(const CurvePlace& at) const;

  /// The place nearest to a point, at most `reach` along the curve away from `about`, across corners and held nodes. If
  /// some coordinates do not move, it has the point's values of these, or the nearest to them.
  [[nodiscard]] CurvePlace nearest(const Vector3& point, const CurvePlace& about, double reach) const;

 private:
  struct Quintic {
    std::array<Vector3, 6> terms;
    [[nodiscard]] Vector3 at(double share) const;
    [[nodiscard]] Vector3 slope(double share) const;
  };
  /// bend() where curvature changes along the curve.
  [[nodiscard]] Bend exact_bend(std::uint32_t node, bool after) const;
  /// Cached, for many places on an edge. Not thread-safe.
  [[nodiscard]] const Quintic& quintic(std::uint32_t edge) const;
  [[nodiscard]] Quintic new_quintic(std::uint32_t edge) const;
  /// A vector scaled so that its length tells which place is nearest.
  [[nodiscard]] Vector3 sought(const Vector3& v) const;

  bool straight_;
  Vector3 moving_;
  std::vector<Chain> chains_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> before_;
  std::uint64_t version_ = 1;  ///< of all places
  mutable std::vector<Quintic> quintics_;
  mutable std::vector<std::uint64_t> versions_;  ///< of cached quintics
};

/// The curvature vector, at the origin, of the circle through it and two other places; zero if they coincide.
Vector3 circle_curvature(const Vector3& to_next, const Vector3& to_before);

}  // namespace vspring
