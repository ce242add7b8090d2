#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <string>

#include "base/threads.hpp"
#include "spring/model.hpp"
#include "vspring/fair.hpp"

namespace vspring {

/// Tells a shape that came out worse than it went in.
class Soundness {
 public:
  /// start: the shape as it went in, with its constraints applied; points that pull at it belong to its box. Updates
  /// directions. Cost: linear.
  Soundness(Net& start, const Model& model, ThreadTeam& team);

  /// What is worse about the shape now, in words for people; empty where nothing is: places that are no numbers or far
  /// outside the box; more edges that turn by over 90°, of a surface between its two faces, of a curve from edge to
  /// edge; where nothing but positions holds it, over three times the
  /// V-Spring energy. Updates directions. Cost: linear.
  [[nodiscard]] std::string fault(Net& now) const;

 private:
  const Model* model_;
  ThreadTeam* team_;
  Eigen::AlignedBox3d box_;
  bool has_directions_ = false;  ///< some are given
  bool has_points_ = false;
  std::size_t turned_ = 0;
  double energy_ = 0;
};

/// Of a shape that is handed out as it was found: warns where it is worse, and does not call it converged.
void say_if_worse(const Soundness& soundness, Net& found, FairReport& report);

}  // namespace vspring
