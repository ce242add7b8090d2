#pragma once

#include <Eigen/SparseCore>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "base/threads.hpp"
#include "spring/net.hpp"

namespace vspring {

/// The plane over which the heights of the nodes near a node are taken, and lengths there.
struct HeightPlane {
  Vector3 origin;
  Vector3 normal;
  Vector3 aside;
  Vector3 ahead;
  double share;  ///< of the faces
  double unit;   ///< of lengths: so all unknowns have one
  bool tilts;    ///< whether a quadratic may have slopes

  /// The equation of a quadratic at a place, five numbers, over the square of the distance. Returns the weight of a
  /// height in it.
  double equation(const Vector3& place, double* row) const;
};

/// normal: of any length; none where it is 0 or not a number.
std::optional<HeightPlane> height_plane(const Net& net, const std::vector<Vector3>& positions, std::size_t i,
                                        const Vector3& normal, double share, bool tilts = true);

/// κ₁² + κ₂² of the quadratic fitted to the heights of the nodes near node i, times the share of the faces. If these
/// are few, nodes joined with them by links count, too. Angles between faces would depend on how long cells are: on one
/// sphere they gave 4.9 before nodes slid and 17.6 after, fits 6.8 both times. share_of_rest: the share of the mean
/// square of the residuals, over the squares of distances, that is added.
double bending_over(const HeightPlane& plane, const Net& net, const std::vector<Vector3>& positions, std::size_t i,
                    double share_of_rest = 0);

/// About ∫ κ₁² + κ₂² dA of a surface: the sum of that of a quadratic fitted around each node to the heights of the
/// nodes near it, times the node's share of the faces. It hardly changes where nodes slide. A rim that is free to turn
/// has none; at a held node of a rim with a given normal the quadratic has that one, so a surface that leaves it counts
/// as bent there. Residuals count, too: on smooth shapes they are small, and roughness shows in them. Nodes of very
/// many neighbours have none.
class BendingEnergy {
 public:
  /// net: of a surface; must outlive it. Cost: linear.
  explicit BendingEnergy(const Net& net);

  /// Of the surface with its nodes there. Cost: linear.
  [[nodiscard]] double of(const std::vector<Vector3>& positions, ThreadTeam& team) const;

  /// Its derivative for each moving node along its normal; by differences. Cost: linear, some thirty times that of the
  /// energy.
  [[nodiscard]] std::vector<double> slopes(const std::vector<Vector3>& positions, ThreadTeam& team) const;

  /// About its second derivative by these moves: that of quadratics with constant normals (Gauss and Newton). Of the
  /// moving nodes, symmetric, positive semidefinite; below the diagonal and on it. Cost: linear.
  [[nodiscard]] Eigen::SparseMatrix<double> second_derivative(const std::vector<Vector3>& positions) const;

  /// The factor that makes a node's displacement by springs times bending_factor() about half of the energy's
  /// derivative: 16 M/ρ⁴, M its share of the faces and ρ² its mean squared edge.
  [[nodiscard]] double weight(const std::vector<Vector3>& positions, std::size_t i) const;
  /// A node's share of the faces.
  [[nodiscard]] double area(const std::vector<Vector3>& positions, std::size_t i) const;

 private:
  /// None where it bends nothing.
  [[nodiscard]] std::optional<HeightPlane> plane_at(const std::vector<Vector3>& positions, std::size_t i) const;
  [[nodiscard]] double around(const std::vector<Vector3>& positions, std::size_t i) const;

  const Net* net_;
  // For each moving node the nodes whose quadratics depend on it.
  std::vector<std::size_t> begin_;
  std::vector<std::uint32_t> around_;
};

}  // namespace vspring
