#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "spring/net.hpp"

namespace vspring {

/// Sets the factors of a net's nodes (TiedPoints::factors) according to their points. Empty: no factors.
using PointFactors = std::function<void(Net&)>;

/// The ties between scattered points and the nodes of a net (§4.5, Fig. 5), renewed as nodes move.
class PointTies {
 public:
  /// Ties points to the nearest nodes of the shape and puts them into the net, which must outlive this object. Points
  /// whose node is not in the net, and points of weight 0, are left out. weights: k_j of every point. normals: of every
  /// point, or empty. Points do not pull at nodes that face away from them, as far as directions of the net are known.
  PointTies(Net& net, std::span<const Vector3> points, std::span<const double> weights, std::span<const Index> nearest,
            PointFactors factors = nullptr, std::span<const Vector3> normals = {});

  /// Ties each of these points, in the coordinates of the net, to the nearest of all nodes of the net.
  PointTies(Net& net, TiedPoints points, PointFactors factors, ThreadTeam& team);

  /// Ties each point to the nearest among its node and the neighbours of first and second order that face as it does.
  /// margin: a point changes node only if it lies beyond the middle between both by this share of their distance; a
  /// cosine changes sign only beyond this value. Returns whether anything changed; changes of factors below 0.1 % do
  /// not count. Cost: linear.
  bool renew(ThreadTeam& team, double margin = 0);

  /// Ties each point to the nearest of all nodes of the net that face as it does; points that are nodes
  /// (TiedPoints::are_nodes) stay with these, here and in renew(). Cost: n log n.
  void tie_anew(ThreadTeam& team);

 private:
  void find_same_nodes();
  void tie_to_nearest(ThreadTeam& team);
  /// Returns whether any point changed its node.
  bool reassign(ThreadTeam& team, double margin);
  /// Neighbours share a face, as across an n-gon the nearest node may be many edges away; on curves an edge. Found from
  /// both ends, since rings of held nodes are incomplete.
  void join_neighbours();
  [[nodiscard]] std::span<const std::uint32_t> neighbours(std::size_t node) const {
    return {neighbours_.data() + first_neighbour_[node], first_neighbour_[node + 1] - first_neighbour_[node]};
  }
  /// The node, its neighbours of first order, and those of second order not through hubs; ascending.
  void gather_around(std::size_t node, std::vector<std::uint32_t>& around) const;
  /// The normal of a node, if it has a sign; zero if it is given at a held node.
  [[nodiscard]] Vector3 side(std::size_t node) const;
  /// Whether the node faces the same way as point k.
  [[nodiscard]] bool may_pull(std::size_t k, std::size_t node, double margin) const;
  /// Finds which points face away from their nodes.
  void look_for_turned();
  /// Puts the points into the order of their nodes.
  void group();
  /// Returns false, and changes nothing, if no factor changes notably.
  bool renew_factors();

  Net* net_;
  PointFactors factors_;
  std::vector<std::uint32_t> node_;   // of every point
  std::vector<std::uint8_t> turned_;  // per point, 1 if its node faces away; empty if no point has a normal
  // A held node at which chains of a curve meet is several nodes of the net: the first represents all.
  std::vector<std::uint32_t> same_;
  std::vector<std::uint32_t> first_neighbour_;
  std::vector<std::uint32_t> neighbours_;
};

}  // namespace vspring
