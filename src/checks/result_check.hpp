#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/threads.hpp"
#include "spring/net.hpp"
#include "vspring/fair.hpp"

namespace vspring {

/// How many edges turn by more than 90°, between two faces of a surface or along a curve; positions: of the nodes of
/// the net, those it has or others. Cost: linear.
std::size_t turned_edges(const Net& net, const std::vector<Vector3>& positions, ThreadTeam& team);
inline std::size_t turned_edges(const Net& net, ThreadTeam& team) { return turned_edges(net, net.positions, team); }

/// The bending of a curve, see ShapeDefects. Cost: linear.
double bending_of_curve(const Net& net, const std::vector<Vector3>& positions);

/// Of a surface: the ends of such edges, and for each a node of the face on each side. Some may be there more than
/// once. Cost: linear.
std::vector<std::size_t> nodes_at_turned_edges(const Net& net);

/// Defects and bending of a shape: the result should not have more, or not much more.
struct ShapeDefects {
  std::size_t turned =
      0;  ///< edges that turn by over 90°, of a surface between its two faces, of a curve from edge to edge
  std::size_t turned_at_held = 0;  ///< the same at held nodes of a curve, of which turned has none
  std::size_t collapsed = 0;       ///< edges of a curve without length; of a surface corners of faces without area
  double least_cosine = 1;         ///< of a surface: of what an edge turns by
  /// Of a surface: some ∫ κ₁² + κ₂² dA by quadratics fitted around its nodes. Of a curve: Σ θ²/ℓ over its nodes, ℓ half
  /// of both edges: some ∫ κ² ds. Edges that leave a given direction are bent, too.
  double bending = 0;
};

/// Tells a shape that came out worse than it went in.
class ResultCheck {
 public:
  /// start: the input with its constraints applied; points that pull at it belong to its box. Turned edges are those of
  /// the input without constraints. Cost: linear.
  ResultCheck(const Net& start, ThreadTeam& team);

  /// Describes for people why the shape is worse now; empty if it is not. It is worse if places are not finite or far
  /// outside the box; if it has more defects, except beside nodes that are held elsewhere than in the input; if edges
  /// of a plane curve without held tangents cross each other that did not after held nodes went to their places. Unless
  /// points pull, also if its box, and its edges by their geometric mean, are less than a fifth of those of the start,
  /// or of that times the factor by which the box of held nodes became smaller; and if its bending is over 1.3 times
  /// that of the start. Where no normals are held, bending is also compared without the noise of both, which may hide
  /// it. Bending is compared because every fair shape has little of it, and nodes that slide hardly change it. Cost:
  /// linear.
  [[nodiscard]] std::string fault(const Net& now) const;

  /// The same without the bending, which cannot be compared after held nodes have been moved.
  [[nodiscard]] std::string fault_of_places(const Net& now) const;

  /// Whether more edges of a surface turn by more than 90° than did at the start without its noise: an equilibrium in
  /// folds that noise has made is no result, although the start has as many folds.
  [[nodiscard]] bool keeps_folds(const Net& now) const;
  /// Whether some edge of a surface turns by more than any edge of the input, except at nodes that are held elsewhere.
  /// Cost: linear.
  [[nodiscard]] bool turns_more(const Net& now) const;

  /// Checks only for nodes whose places are not finite or far outside the box.
  [[nodiscard]] std::string misplaced(const Net& now) const;

 private:
  [[nodiscard]] std::vector<std::uint8_t> dragged(const Net& now) const;
  [[nodiscard]] bool looks_at_bending() const;
  /// Between held nodes that lie close together; in words, as fault().
  [[nodiscard]] std::string shrinkage(const Net& now) const;
  /// Tangents that are given may ask for a loop.
  [[nodiscard]] bool looks_at_crossings(const Net& net) const;
  /// Of a curve that is looked at for them; see fault().
  [[nodiscard]] std::string more_crossings(const Net& now) const;
  /// Of the shape, or of it after rest_positions(), whichever is less.
  [[nodiscard]] double bending_without_noise(const Net& net) const;
  [[nodiscard]] std::string more_of(const ShapeDefects& defects, bool of_surface) const;

  ThreadTeam* team_;
  Eigen::AlignedBox3d box_;
  bool has_directions_ = false;  ///< some are given
  bool has_points_ = false;
  bool is_surface_ = false;
  double edge_ = 0;                       ///< the mean one
  double geometric_mean_edge_ = 0;        ///< of the start; 0 if points pull
  ShapeDefects defects_;                  ///< of the input; the bending is that of the start
  std::size_t turned_without_noise_ = 0;  ///< edges of the start after rest_positions(), where they are fewer
  std::vector<Vector3> input_;            ///< of a curve that is checked for crossings: the nodes' places in the input
  std::vector<Vector3> held_;             ///< where the input has the nodes that are held
  std::optional<double> bending_without_noise_;  ///< none where it is not looked at
};

/// For a shape that is returned as it was found: warns where it is worse, and then does not call it converged.
void warn_if_worse(const ResultCheck& check, const Net& found, FairReport& report);

}  // namespace vspring
