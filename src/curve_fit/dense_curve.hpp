#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// A place on a curve: on the edge that begins at a node, and the share of it.
struct CurvePlace {
  std::uint32_t edge = 0;
  double share = 0;
};

/// A curve in the fit's own coordinates: nodes as dense as its bends need, and between them the quintic that has their
/// tangents and curvatures, so that curvature is continuous. Nodes where something is held are some of its nodes.
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
    /// Given before and after it, of unit length; zero: free. One and the same, unless it is a corner.
    std::array<Vector3, 2> tangents = {Vector3::Zero(), Vector3::Zero()};
    bool held = false;    ///< in place
    bool corner = false;  ///< curvature and direction may jump
    bool dense = true;    ///< put there by the fit, which may take it away again
    Index from = -1;      ///< the node of the file that it is
    double spacing = 0;   ///< how far from it the next nodes should be
  };

  /// straight: the curve is its chords, with no quintics over them. moving: 1 for coordinates that nodes move in, 0 for
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
  /// In the coordinates that move.
  void set_place(std::uint32_t i, const Vector3& place) {
    for (int k = 0; k < 3; ++k) {
      if (moving_[k] != 0) nodes_[i].place[k] = place[k];
    }
    ++version_;
  }
  [[nodiscard]] const Vector3& moving() const { return moving_; }
  [[nodiscard]] bool moves_freely() const { return moving_ == Vector3::Ones(); }
  /// What counts of a vector for where things lie along the curve: all of it, or the coordinates that do not move.
  [[nodiscard]] Vector3 station(const Vector3& v) const {
    return moves_freely() ? v : Vector3((Vector3::Ones() - moving_).cwiseProduct(v));
  }
  /// Where it is.
  void hold(std::uint32_t i) { nodes_[i].held = true; }
  void set_spacing(std::uint32_t i, double spacing) { nodes_[i].spacing = spacing; }
  [[nodiscard]] const Vector3& tangent(std::uint32_t i, bool after) const { return nodes_[i].tangents[after ? 1 : 0]; }
  /// Neighbours along the chain; none at its ends. An edge has the number of the node that it begins at.
  [[nodiscard]] std::uint32_t next(std::uint32_t i) const { return next_[i]; }
  [[nodiscard]] std::uint32_t before(std::uint32_t i) const { return before_[i]; }
  [[nodiscard]] bool is_edge(std::uint32_t i) const { return next_[i] != none; }
  /// Whether curvature goes on through the node: no end, no corner, no tangent given.
  [[nodiscard]] bool is_smooth(std::uint32_t i) const {
    return next_[i] != none && before_[i] != none && !nodes_[i].corner && tangent(i, true).isZero(0);
  }
  [[nodiscard]] double edge_length(std::uint32_t edge) const { return (place(next_[edge]) - place(edge)).norm(); }

  /// Direction and curvature vector at a node, beside the edge after or before it.
  struct Bend {
    Vector3 tangent;
    Vector3 curvature;
  };
  [[nodiscard]] Bend bend(std::uint32_t node, bool after) const;

  /// How the curvature beside a node changes with places. Exact on circles, however nodes are spaced.
  struct CurvatureRow {
    Vector3 curvature = Vector3::Zero();
    int count = 0;  ///< 0: it has none
    std::array<std::uint32_t, 3> nodes{};
    std::array<Eigen::Matrix3d, 3> slopes{};
  };
  [[nodiscard]] CurvatureRow curvature_row(std::uint32_t node, bool after) const;

  /// The greatest curvature beside a node; 0 where it has none.
  [[nodiscard]] double greatest_curvature(std::uint32_t node) const;

  [[nodiscard]] Vector3 at(const CurvePlace& at) const;
  /// How far a place is from a point, in the coordinates that move.
  [[nodiscard]] Vector3 offset(const CurvePlace& at, const Vector3& point) const {
    return moving_.cwiseProduct(this->at(at) - point);
  }
  [[nodiscard]] Vector3 direction(const CurvePlace& at) const;
  /// Whether a place is a node that does not move: nothing brings that nearer to a point.
  [[nodiscard]] bool is_at_held(const CurvePlace& at) const {
    return (at.share == 0 && node(at.edge).held) || (at.share == 1 && node(next(at.edge)).held);
  }

  /// Weights of the nodes before an edge, at its ends and after it, of a place on it, and what no node has a part in.
  struct PlaceRow {
    std::array<std::uint32_t, 4> nodes{};
    std::array<double, 4> weights{};
    Vector3 rest = Vector3::Zero();
  };
  [[nodiscard]] PlaceRow place_row(const CurvePlace& at) const;

  /// The place nearest to a point among those up to `reach` along the curve away from another; corners and held nodes
  /// do not stop it. Where some coordinates do not move, that with the point's values of these, or nearest to them.
  [[nodiscard]] CurvePlace nearest(const Vector3& point, const CurvePlace& about, double reach) const;

 private:
  struct Quintic {
    std::array<Vector3, 6> terms;
    [[nodiscard]] Vector3 at(double share) const;
    [[nodiscard]] Vector3 slope(double share) const;
  };
  /// The same where curvature changes along the curve.
  [[nodiscard]] Bend exact_bend(std::uint32_t node, bool after) const;
  /// Once for many places on it. Not for threads side by side.
  [[nodiscard]] const Quintic& quintic(std::uint32_t edge) const;
  [[nodiscard]] Quintic new_quintic(std::uint32_t edge) const;
  /// As lengths of vectors tell which place is nearest.
  [[nodiscard]] Vector3 sought(const Vector3& v) const;

  bool straight_;
  Vector3 moving_;
  std::vector<Chain> chains_;
  std::vector<Node> nodes_;
  std::vector<std::uint32_t> next_;
  std::vector<std::uint32_t> before_;
  std::uint64_t version_ = 1;  ///< of all places
  mutable std::vector<Quintic> quintics_;
  mutable std::vector<std::uint64_t> versions_;  ///< that quintics are of
};

/// The curvature vector at the origin of the circle through it and two other places, or none where they fall together.
Vector3 circle_curvature(const Vector3& to_next, const Vector3& to_before);

}  // namespace vspring
