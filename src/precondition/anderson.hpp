#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "base/threads.hpp"
#include "vspring/types.hpp"

namespace vspring {

/// Earlier iterates that are worth looking at.
constexpr std::size_t acceleration_depth = 6;

/// The same of surfaces: large ones arrive in a few iterations, half as many cost them none, and 4,000,000 nodes stay
/// within 3 GiB.
constexpr std::size_t surface_acceleration_depth(std::size_t moving) {
  return moving > 500'000 ? acceleration_depth / 2 : acceleration_depth;
}

/// Anderson acceleration (D. G. Anderson, "Iterative procedures for nonlinear integral equations", J. ACM 12(4), 1965;
/// H. Walker, P. Ni, SIAM J. Numer. Anal. 49(4), 2011): of an iteration x ← x + c(x) it takes the combination of the
/// last iterates whose c is smallest, so that for nearly linear c it converges as conjugate-residual methods do.
/// Scalar: of what is remembered. In single precision a step reduces c by no more than 1e-5, at half the memory.
template <typename Scalar>
class Anderson {
 public:
  /// depth: how many earlier iterates are looked at. size: number of vectors of x.
  Anderson(std::size_t depth, std::size_t size, ThreadTeam& team) : depth_(depth), size_(size), team_(&team) {}

  /// Turns correction, that is c(x), into the step to take from x; remembers both. The same bits for every team.
  /// Cost: linear in size and depth.
  void accelerate(std::vector<Vector3>& correction);

  /// The next correction is not of the last step: another place, or another c that is nearly the same but for a
  /// constant.
  void begin_anew() { last_step_.clear(); }

  /// The step was not taken as it was given, but this share of the correction: what was remembered does not fit any
  /// more.
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
