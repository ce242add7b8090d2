#pragma once

#include <functional>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "spring/net.hpp"

namespace vspring {

/// Sets the factors of a net's nodes (TiedPoints::factors) for the points that they have. Empty where there are none.
using PointFactors = std::function<void(Net&)>;

/// The ties between scattered points and the nodes of a net (§4.5, Fig. 5), which go with the nodes as these move.
class PointTies {
 public:
  /// Ties points to the nodes of the shape that are nearest to them, where these belong to the net, and puts them into
  /// the net, which must outlive this. Others, and those of weight 0, are left out. weights: k_j of every point.
  /// normals: of every point, or empty. Points do not pull at nodes that face away from them, so far as directions of
  /// the net are known.
  PointTies(Net& net, std::span<const Vector3> points, std::span<const double> weights, std::span<const Index> nearest,
            PointFactors factors = nullptr, std::span<const Vector3> normals = {});

  /// Ties each of the points that the net has got, in its coordinates, to the nearest of all its nodes.
  PointTies(Net& net, TiedPoints points, PointFactors factors, ThreadTeam& team);

  /// Ties each point to the nearest of its node and the neighbours of first and second order that face as it does.
  /// margin: by how much of the distance between both nodes the point must lie beyond the middle between them to change
  /// over, and by how much a cosine must be off a right angle to count as of another sign than before. True where
  /// anything changed, but for factors by under 0.1 %. Cost: linear.
  bool renew(ThreadTeam& team, double margin = 0);

  /// Ties each point to the nearest of all nodes of the net that face as it does; points that are nodes
  /// (TiedPoints::are_nodes) stay with these, here and in renew(). Cost: n log n.
  void tie_anew(ThreadTeam& team);

 private:
  void find_same_nodes();
  void tie_to_nearest(ThreadTeam& team);
  /// True where any point has changed over.
  bool reassign(ThreadTeam& team, double margin);
  /// Neighbours share a face, as across an n-gon the nearest node may be many edges away; on curves an edge. Looked at
  /// from both ends, since rings of held nodes know less.
  void join_neighbours();
  [[nodiscard]] std::span<const std::uint32_t> neighbours(std::size_t node) const {
    return {neighbours_.data() + first_neighbour_[node], first_neighbour_[node + 1] - first_neighbour_[node]};
  }
  /// The node and its neighbours of first order, and of second order but through hubs; ascending.
  void gather_around(std::size_t node, std::vector<std::uint32_t>& around) const;
  /// The normal of a node, where it has a sign: not where it is given at a held one.
  [[nodiscard]] Vector3 side(std::size_t node) const;
  /// Whether the node faces as point k does.
  [[nodiscard]] bool may_pull(std::size_t k, std::size_t node, double margin) const;
  /// Finds which points face away from their nodes.
  void look_for_turned();
  /// Puts the points into the order of their nodes.
  void group();
  /// False where that changes no factor notably, and leaves them as they are.
  bool renew_factors();

  Net* net_;
  PointFactors factors_;
  std::vector<std::uint32_t> node_;   // of every point
  std::vector<std::uint8_t> turned_;  // 1 for those whose node faces away; empty where no point has a normal
  // A held node at which chains of a curve meet is several of the net: the first stands for all.
  std::vector<std::uint32_t> same_;
  std::vector<std::uint32_t> first_neighbour_;
  std::vector<std::uint32_t> neighbours_;
};

}  // namespace vspring
