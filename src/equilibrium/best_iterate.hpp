#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cstddef>
#include <limits>
#include <vector>

#include "spring/net.hpp"
#include "spring/sliding.hpp"

namespace vspring {

/// Keeps the shape of the smallest residual, in case later ones are worse; a large one in single precision, to 1e-7 of
/// its size, for half of the memory.
class BestIterate {
 public:
  /// lost_factor: a shape is lost while its residual is more than this much larger than the best, or than `small` where
  /// the best is below that.
  BestIterate(Net& net, double lost_factor, double small = 0) : net_(&net), lost_factor_(lost_factor), small_(small) {}

  void look(double residual) {
    lost_for_ = residual > lost_factor_ * std::max(residual_, small_) ? lost_for_ + 1 : 0;
    // Shapes hardly better than the one kept are not worth a copy.
    if (!(residual < 0.7 * residual_)) return;
    residual_ = residual;
    if (net_->moving > large) {
      rounded_.resize(net_->moving);
      for (std::size_t i = 0; i < net_->moving; ++i) rounded_[i] = net_->positions[i].cast<float>();
    } else {
      positions_ = net_->positions;
    }
    lost_for_ = 0;
  }

  /// For how many looks in a row the shape has been lost.
  [[nodiscard]] int lost_for() const noexcept { return lost_for_; }
  [[nodiscard]] double residual() const noexcept { return residual_; }

  /// Puts the shape back; returns its residual.
  double restore() {
    if (!positions_.empty()) net_->positions = positions_;
    for (std::size_t i = 0; i < rounded_.size(); ++i) net_->positions[i] = rounded_[i].cast<double>();
    put_on_supports(*net_, net_->positions);
    return residual_;
  }

 private:
  // Nodes.
  static constexpr std::size_t large = 500'000;

  Net* net_;
  double lost_factor_;
  double small_;
  double residual_ = std::numeric_limits<double>::infinity();
  std::vector<Vector3> positions_;
  std::vector<Eigen::Vector3f> rounded_;  // of moving nodes
  int lost_for_ = 0;
};

}  // namespace vspring
