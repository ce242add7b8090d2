#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "base/threads.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// The number of earlier iterates to use.
constexpr std::size_t acceleration_depth = 6;

/// That of surfaces. Large ones converge in a few iterations: half the depth costs none, and keeps 4,000,000 nodes
/// within 3 GiB.
constexpr std::size_t surface_acceleration_depth(std::size_t moving) {
  return moving > 500'000 ? acceleration_depth / 2 : acceleration_depth;
}

/// Anderson acceleration (D. G. Anderson, "Iterative procedures for nonlinear integral equations", J. ACM 12(4), 1965;
/// H. Walker, P. Ni, SIAM J. Numer. Anal. 49(4), 2011): in an iteration x ← x + c(x) it takes the combination of the
/// last iterates whose c is smallest. For nearly linear c it converges as conjugate-residual methods do. Scalar: of the
/// stored vectors. In single precision a step reduces c by no more than 1e-5, at half the memory.
template <typename Scalar>
class Anderson {
 public:
  /// depth: number of earlier iterates used. size: number of vectors of x.
  Anderson(std::size_t depth, std::size_t size, ThreadTeam& team) : depth_(depth), size_(size), team_(&team) {}

  /// Turns `correction`, c(x), into the step to take from x; stores both. The same bits for every team. Cost: linear in
  /// size and depth.
  void accelerate(std::vector<Vector3>& correction);

  /// Call it when the next correction does not belong to the last step: x changed otherwise, or c changed by about a
  /// constant.
  void begin_anew() { last_step_.clear(); }

  /// Call it when this share of the correction was taken instead of the step: stored vectors do not fit any more.
  void forget() {
    used_ = 0;
    next_ = 0;
    last_step_.clear();
  }

 private:
  std::size_t depth_;
  std::size_t size_;
  ThreadTeam* team_;
  std::size_t used_ = 0;  // columns in use
  std::size_t next_ = 0;  // the column to be overwritten
  using Vector = Eigen::Matrix<Scalar, 3, 1>;
  std::vector<std::vector<Vector>> corrections_;  // differences of successive corrections
  std::vector<std::vector<Vector>> steps_;        // differences of successive iterates
  std::vector<Vector> last_correction_;
  std::vector<Vector> last_step_;
};

}  // namespace vspring
