#pragma once

#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/threads.hpp"
#include "checks/start_places.hpp"
#include "spring/model.hpp"
#include "vspring/fair.hpp"

namespace vspring {

/// How many edges turn by more than 90°, between two faces of a surface or along a curve; positions: of the nodes of
/// the net, those it has or others. Cost: linear.
std::size_t turned_edges(const Net& net, const std::vector<Vector3>& positions, ThreadTeam& team);
inline std::size_t turned_edges(const Net& net, ThreadTeam& team) { return turned_edges(net, net.positions, team); }

/// Some ∫ κ² ds of a curve, Σ θ²/ℓ over its nodes, θ the turn there and ℓ half of both edges. Cost: linear.
double bending_of_curve(const Net& net, const std::vector<Vector3>& positions);

/// Of a surface: the ends of such edges, and for each a node of the face on each side. Some may be there more than
/// once. Cost: linear.
std::vector<std::size_t> nodes_at_turned_edges(const Net& net);

/// What a shape may have, and should have no more of, or not much.
struct ShapeDefects {
  std::size_t turned =
      0;  ///< edges that turn by over 90°, of a surface between its two faces, of a curve from edge to edge
  std::size_t turned_at_held = 0;  ///< the same at held nodes of a curve, of which turned has none
  std::size_t collapsed = 0;       ///< edges of a curve without length; of a surface corners of faces without area
  /// Of a surface: some ∫ κ₁² + κ₂² dA by quadratics fitted around its nodes. Of a curve: Σ θ²/ℓ over its nodes, ℓ half
  /// of both edges: some ∫ κ² ds.
  double bending = 0;
  double turns = 0;  ///< of a surface: the squares of the angles between its faces, radians²
};

/// Tells a shape that came out worse than it went in.
class ResultCheck {
 public:
  /// start: the shape as it went in, with its constraints applied; points that pull at it belong to its box, and which
  /// edges turn is a matter of the input before that. places: its places, which are kept if not given and needed.
  /// Updates directions. Cost: linear.
  ResultCheck(Net& start, const Model& model, ThreadTeam& team, StartPlaces places = {});

  /// What is worse about the shape now, in words for people; empty where nothing is: places that are no numbers or far
  /// outside the box; more defects, but for those beside nodes that are held elsewhere than the input has them; edges
  /// of a curve in a plane that cross each other, where no tangent is held; where nothing but positions holds it, over
  /// three times the V-Spring energy (but where bending is to be least), 1.5 times that of a curve that is bent more,
  /// or of a surface over 1.3 times the bending, or 2.5 times that without noise; where directions hold it, over 1.3
  /// times of both. Updates directions. Cost: linear.
  /// in_haste: of a surface that is on its way, which nothing but positions holds: faces turn more from one to the
  /// next, root mean square, or the energy is more, which is seen in a fraction of the time.
  [[nodiscard]] std::string fault(Net& now, bool in_haste = false) const;

  /// The same where energies tell nothing, as where what is held has been moved since, or least bending is wanted.
  /// Updates nothing.
  [[nodiscard]] std::string fault_of_places(const Net& now) const;

  /// Whether more edges of a surface turn by more than 90° than did at the start without its noise: an equilibrium in
  /// folds that noise has made is no answer, though the start has no fewer.
  [[nodiscard]] bool keeps_folds(const Net& now) const;
  /// Only nodes whose places are no numbers or far outside the box.
  [[nodiscard]] std::string misplaced(const Net& now) const;

  /// As given, or where directions hold it; else they are not known.
  [[nodiscard]] const StartPlaces& start() const noexcept { return start_; }
  /// From now on fault() leaves out what it needs the start for: see StartPlaces, which may depend on the caller.
  void forget_start() {
    start_ = {};
    looks_at_agreement_ = false;
  }

 private:
  [[nodiscard]] std::vector<std::uint8_t> dragged(const Net& now) const;
  [[nodiscard]] bool looks_at_bending() const;
  /// Tangents that are given may ask for a loop.
  [[nodiscard]] bool looks_at_crossings(const Net& net) const;
  /// Of a curve that is looked at for them; see fault().
  [[nodiscard]] std::string more_crossings(const Net& now) const;
  [[nodiscard]] double bending_without_noise(const Net& net) const;
  /// Both that it is bent more and that its springs, by the given directions, are further from their rest.
  [[nodiscard]] std::string disagreement_with_directions(Net& now, std::span<const std::uint8_t> dragged_nodes) const;
  [[nodiscard]] std::string more_of(const ShapeDefects& defects, bool of_surface) const;

  const Model* model_;
  ThreadTeam* team_;
  Eigen::AlignedBox3d box_;
  bool has_directions_ = false;  ///< some are given
  bool has_points_ = false;
  bool is_surface_ = false;
  double edge_ = 0;  ///< the mean one
  ShapeDefects defects_;
  std::size_t turned_without_noise_ = 0;  ///< edges of the start after rest_positions(), where they are fewer
  std::vector<Vector3> input_;            ///< of a curve that is looked at for crossings: where the input has its nodes
  StartPlaces start_;
  bool looks_at_agreement_ = false;  ///< whether directions agree with the shape, see fault()
  std::vector<Vector3> held_;        ///< where the input has the nodes that are held
  double energy_ = 0;
  // Where nothing but positions holds it: with its constraints, and of a surface after rest_positions(); none where
  // constraints put nodes elsewhere than the input has them.
  double bending_ = 0;
  double turns_ = 0;
  std::optional<double> smooth_bending_;
};

/// Of a shape that is handed out as it was found: warns where it is worse, and does not call it converged.
void warn_if_worse(const ResultCheck& check, Net& found, FairReport& report);

}  // namespace vspring
