#include "checks/result_check.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "checks/bending_energy.hpp"
#include "checks/curve_crossings.hpp"
#include "checks/spring_energy.hpp"
#include "shape/direction.hpp"
#include "spring/spacing.hpp"

namespace vspring {

namespace {

// In the longest sides of the start, every way about its centre: between few held nodes a fair shape may be rounder
// than a flat one that it came from, and a tangent or normal may well ask for a wide loop.
constexpr double wide_box = 3;
constexpr double box_of_directions = 10;
// The energy of an exactly fair shape is rounding, a tolerance leaves some, and where nodes of a coarse shape slide it
// may rise though curvature changes more gently: what rises by less than this factor, or to less than about this turn
// (in radians) for an edge, tells nothing.
constexpr double noticed_rise = 3;
// Of a curve, that is bent more too.
constexpr double noticed_rise_of_curves = 1.5;
constexpr double unseen_turn = 1e-3;
// Where normals or tangents are held, which may ask for a shape that is bent more: of the energy, in which they count,
// of what is bent more too.
constexpr double risen_energy_if_bent = 1.3;
// Of the bending, of a surface or a curve, which hardly changes where nodes slide. Springs may ask for more of it than
// a fair shape has where a rim is free to turn.
constexpr double risen_bending = 1.3;
// Of the same without noise, of which an input may have more than the bending that a shape should not have.
constexpr double risen_smooth_bending = 2.5;
// Of mean edges: shorter ones, and faces of less than the square of that, are as good as nothing.
constexpr double collapsed_size = 1e-4;

/// The next place once around: a division, as for a remainder, takes as long as a face.
std::size_t place_after(std::size_t k, std::size_t count) { return k + 1 < count ? k + 1 : 0; }

std::size_t place_before(std::size_t k, std::size_t count) { return (k > 0 ? k : count) - 1; }

/// Vector areas, times two, of the faces that follow the spokes of a node; not a number where there is none.
void find_faces(const Net& net, const std::vector<Vector3>& positions, std::size_t i, std::vector<std::size_t>& spokes,
                std::vector<Vector3>& faces) {
  const auto links = net.rings.links(i);
  spokes.clear();
  faces.clear();
  for (std::size_t k = 0; k < links.size(); ++k) {
    if (!links[k].spoke()) continue;
    spokes.push_back(k);
    Vector3 area = Vector3::Zero();
    for (std::size_t at = k;;) {
      const std::size_t next = place_after(at, links.size());
      if (links[next].start() || links.size() < 2) {
        area.setConstant(std::numeric_limits<double>::quiet_NaN());
        break;
      }
      area += (positions[links[at].node()] - positions[i]).cross(positions[links[next].node()] - positions[i]);
      at = next;
      if (links[at].spoke()) break;
    }
    faces.push_back(area);
  }
}

/// bending_over() of a node. spokes, faces: as find_faces() finds them; beside a rim there is no link all round.
double bending_at(const Net& net, const std::vector<Vector3>& positions, std::size_t i,
                  std::span<const std::size_t> spokes, std::span<const Vector3> faces) {
  const std::size_t links = net.rings.links(i).size();
  Vector3 normal = Vector3::Zero();
  double share = 0;
  for (std::size_t s = 0; s < faces.size(); ++s) {
    const std::size_t next = spokes[place_after(s, spokes.size())];
    const std::size_t corners = (next > spokes[s] ? next : next + links) - spokes[s] + 2;
    normal += faces[s];
    share += 0.5 * faces[s].norm() / static_cast<double>(corners);
  }
  const auto plane = height_plane(net, positions, i, normal, share);
  return plane ? bending_over(*plane, net, positions, i) : 0;
}

/// θ²/ℓ at a node of a curve between two edges.
double bending_at(const Vector3& before, const Vector3& after) {
  const double turn = std::atan2(before.cross(after).norm(), before.dot(after));
  const double length = (before.norm() + after.norm()) / 2;
  return length > 0 ? turn * turn / length : 0;
}

/// What to find besides what is counted; the rest is 0.
struct Sums {
  bool bending = false;
  bool turns = false;
};

/// positions: of the nodes, those of the net or others. edge: the mean one. dragged: 1 for nodes that are held
/// elsewhere than the input has them: what turns beside them is wanted; or empty.
ShapeDefects defects_of(const Net& net, const std::vector<Vector3>& positions, double edge, ThreadTeam& team, Sums sums,
                        std::span<const std::uint8_t> dragged = {}) {
  const double tiny = collapsed_size * edge;
  const auto is_dragged = [&](std::size_t node) { return !dragged.empty() && dragged[node] != 0; };
  if (net.is_curve) {
    ShapeDefects defects;
    for (std::size_t i = 0; i < net.computed; ++i) {
      const auto links = net.rings.links(i);
      if (links.size() < 2 || is_dragged(i) || is_dragged(links[0].node()) || is_dragged(links[1].node())) continue;
      const Vector3 before = positions[i] - positions[links[0].node()];
      const Vector3 after = positions[links[1].node()] - positions[i];
      if (turns_back(before, after)) ++(i < net.moving ? defects.turned : defects.turned_at_held);
      defects.collapsed += after.squaredNorm() < tiny * tiny ? 1 : 0;
      if (sums.bending) defects.bending += bending_at(before, after);
    }
    return defects;
  }
  const auto look = [&](std::size_t begin, std::size_t end, ShapeDefects& part) {
    std::vector<std::size_t> spokes;
    std::vector<Vector3> faces;
    for (std::size_t i = begin; i < end; ++i) {
      if (is_dragged(i)) continue;
      find_faces(net, positions, i, spokes, faces);
      const auto links = net.rings.links(i);
      const auto neighbour = [&](std::size_t s) { return links[spokes[s]].node(); };
      const std::size_t count = spokes.size();
      for (std::size_t s = 0; s < count; ++s) {
        const std::size_t j = neighbour(s);
        if (is_dragged(j) || is_dragged(neighbour(place_after(s, count)))) continue;
        if (faces[s].norm() < 2 * tiny * tiny) ++part.collapsed;
        if (j < i && j < net.computed) continue;
        const std::size_t last = place_before(s, count);
        if (is_dragged(neighbour(last))) continue;
        if (turns_back(faces[last], faces[s])) ++part.turned;
        const double turn = sums.turns ? std::atan2(faces[last].cross(faces[s]).norm(), faces[last].dot(faces[s])) : 0;
        // Beside a rim there is one face.
        if (turn == turn) part.turns += turn * turn;
      }
      if (sums.bending && std::none_of(links.begin(), links.end(), [&](Link link) { return is_dragged(link.node()); }))
        part.bending += bending_at(net, positions, i, spokes, faces);
    }
  };
  ShapeDefects defects;
  for (const ShapeDefects& part : parallel_parts(team, net.computed, nodes_per_task, ShapeDefects(), look)) {
    defects.turned += part.turned;
    defects.collapsed += part.collapsed;
    defects.bending += part.bending;
    defects.turns += part.turns;
  }
  return defects;
}

}  // namespace

std::size_t turned_edges(const Net& net, const std::vector<Vector3>& positions, ThreadTeam& team) {
  return defects_of(net, positions, 0, team, {}).turned;
}

double bending_of_curve(const Net& net, const std::vector<Vector3>& positions) {
  ThreadTeam alone(1);
  return defects_of(net, positions, 0, alone, {.bending = true}).bending;
}

std::vector<std::size_t> nodes_at_turned_edges(const Net& net) {
  std::vector<std::size_t> nodes;
  std::vector<std::size_t> spokes;
  std::vector<Vector3> faces;
  for (std::size_t i = 0; i < net.computed; ++i) {
    find_faces(net, net.positions, i, spokes, faces);
    const auto neighbour = [&](std::size_t s) { return net.rings.links(i)[spokes[s]].node(); };
    for (std::size_t s = 0; s < spokes.size(); ++s) {
      const std::size_t last = place_before(s, spokes.size());
      if (turns_back(faces[last], faces[s]))
        nodes.insert(nodes.end(), {i, neighbour(s), neighbour(last), neighbour(place_after(s, spokes.size()))});
    }
  }
  return nodes;
}

ResultCheck::ResultCheck(Net& start, const Model& model, ThreadTeam& team, StartPlaces places)
    : model_(&model), team_(&team), start_(std::move(places)) {
  for (const Vector3& position : start.positions) box_.extend(position);
  for (const Vector3& position : start.points.positions) box_.extend(position);
  has_directions_ = std::any_of(start.given.begin(), start.given.end(), [](std::uint8_t given) { return given != 0; });
  has_points_ = !start.points.positions.empty();
  is_surface_ = !start.is_curve;
  edge_ = mean_edge(start);
  const std::vector<Vector3>& input = start.input.empty() ? start.positions : start.input;
  constexpr Sums all = {.bending = true, .turns = true};
  const bool at_once = start.input.empty() && looks_at_bending();
  defects_ = defects_of(start, input, edge_, team, at_once ? all : Sums());
  turned_without_noise_ = defects_.turned;
  if (is_surface_ && defects_.turned > 0)
    turned_without_noise_ = std::min(defects_.turned, turned_edges(start, rest_positions(start, team), team));
  held_.assign(input.begin() + static_cast<std::ptrdiff_t>(start.moving), input.end());
  if (looks_at_crossings(start)) input_ = input;
  if (looks_at_bending()) {
    const ShapeDefects held = at_once ? defects_ : defects_of(start, start.positions, edge_, team, all);
    bending_ = held.bending;
    turns_ = held.turns;
    if (start.input.empty() && !start.is_curve) smooth_bending_ = bending_without_noise(start);
  }
  const bool was_prepared = !start.curvatures.empty();
  model.prepare(start);
  update_directions(start, model, team);
  energy_ = spring_energy(start).sum;
  looks_at_agreement_ = has_directions_ && !has_points_ && defects_.collapsed == 0;
  if (looks_at_agreement_ && !start_) start_ = StartPlaces(start.positions);
  // Sweeps must do without: they move from the newest positions.
  if (!was_prepared) start.curvatures.clear();
}

std::vector<std::uint8_t> ResultCheck::dragged(const Net& now) const {
  std::vector<std::uint8_t> result(now.positions.size(), 0);
  bool some = false;
  for (std::size_t k = 0; k < held_.size(); ++k) {
    if ((now.positions[now.moving + k] - held_[k]).norm() < collapsed_size * edge_) continue;
    result[now.moving + k] = 1;
    some = true;
  }
  if (!some) result.clear();
  return result;
}

bool ResultCheck::looks_at_bending() const {
  // Of faces without area nobody knows how they are bent.
  return !has_directions_ && !has_points_ && (!is_surface_ || defects_.collapsed == 0);
}

bool ResultCheck::looks_at_crossings(const Net& net) const { return !has_directions_ && net.is_curve; }

double ResultCheck::bending_without_noise(const Net& net) const {
  return defects_of(net, rest_positions(net, *team_), edge_, *team_, {.bending = true}).bending;
}

bool ResultCheck::keeps_folds(const Net& now) const {
  if (turned_without_noise_ == defects_.turned) return false;
  return defects_of(now, now.positions, edge_, *team_, {}, dragged(now)).turned > turned_without_noise_;
}

std::string ResultCheck::misplaced(const Net& now) const {
  Eigen::AlignedBox3d box = box_;
  for (std::size_t i = now.moving; i < now.positions.size(); ++i) box.extend(now.positions[i]);
  const Vector3 half =
      Vector3::Constant(0.5 * (has_directions_ ? box_of_directions : wide_box) * box.sizes().maxCoeff());
  const Eigen::AlignedBox3d wide(box.center() - half, box.center() + half);
  for (std::size_t i = 0; i < now.moving; ++i) {
    if (!now.positions[i].allFinite()) return fmt::format("node {} has no place", now.node[i]);
    if (!wide.contains(now.positions[i]))
      return fmt::format("node {} is far outside the box of what was given", now.node[i]);
  }
  return {};
}

std::string ResultCheck::more_of(const ShapeDefects& defects, bool of_surface) const {
  if (defects.turned > defects_.turned)
    return fmt::format("{} edges turn by more than 90°, {} did before", defects.turned, defects_.turned);
  if (defects.turned_at_held > defects_.turned_at_held)
    return fmt::format("edges turn by more than 90° at {} held nodes, {} did before", defects.turned_at_held,
                       defects_.turned_at_held);
  if (defects.collapsed > defects_.collapsed)
    return fmt::format("{} {}, {} had before", defects.collapsed,
                       of_surface ? "corners of faces have no area" : "edges have no length", defects_.collapsed);
  return {};
}

std::string ResultCheck::fault_of_places(const Net& now) const {
  std::string misplaced_node = misplaced(now);
  if (!misplaced_node.empty()) return misplaced_node;
  const std::vector<std::uint8_t> dragged_nodes = dragged(now);
  std::string more = more_of(defects_of(now, now.positions, edge_, *team_, {}, dragged_nodes), !now.is_curve);
  return more.empty() && dragged_nodes.empty() ? more_crossings(now) : more;
}

std::string ResultCheck::more_crossings(const Net& now) const {
  if (!looks_at_crossings(now)) return {};
  const std::size_t crossings = curve_crossings(now, now.positions, *team_);
  const std::size_t before = crossings > 0 ? curve_crossings(now, input_, *team_, Touching::counts) : 0;
  if (crossings <= before) return {};
  return fmt::format("{} pairs of edges cross each other, {} did before", crossings, before);
}

std::string ResultCheck::disagreement_with_directions(Net& now, std::span<const std::uint8_t> dragged_nodes) const {
  if (!looks_at_agreement_ || !now.spheres.differences.empty()) return {};
  const double unseen = unseen_turn * unseen_turn * static_cast<double>(now.rings.link_count());
  model_->prepare(now);
  update_directions(now, *model_, *team_);
  const double energy = spring_energy(now).sum;
  if (energy <= risen_energy_if_bent * energy_ + unseen) return {};
  const auto bending_of = [&](const std::vector<Vector3>& positions) {
    return defects_of(now, positions, edge_, *team_, {.bending = true}, dragged_nodes).bending;
  };
  const double before = bending_of(start_.of(now));
  const double after = bending_of(now.positions);
  if (after <= risen_bending * before + unseen) return {};
  return fmt::format(
      "it is bent more, by {:.3g} in place of {:.3g}, and the V-Spring energy rose from {:.3g} to {:.3g}", after,
      before, energy_, energy);
}

std::string ResultCheck::fault(Net& now, bool in_haste) const {
  std::string misplaced_node = misplaced(now);
  if (!misplaced_node.empty()) return misplaced_node;
  const std::vector<std::uint8_t> dragged_nodes = dragged(now);
  const bool by_turns = in_haste && !now.is_curve;
  const Sums sums = {.bending = looks_at_bending() && !by_turns, .turns = looks_at_bending() && by_turns};
  const ShapeDefects defects = defects_of(now, now.positions, edge_, *team_, sums, dragged_nodes);
  std::string more = more_of(defects, !now.is_curve);
  if (!more.empty()) return more;
  if (has_directions_) return has_points_ ? std::string() : disagreement_with_directions(now, dragged_nodes);
  if (dragged_nodes.empty()) more = more_crossings(now);
  if (!more.empty()) return more;
  if (has_points_) return {};
  const double unseen = unseen_turn * unseen_turn * static_cast<double>(now.rings.link_count());
  const bool is_bent_more = defects.bending > risen_bending * bending_ + unseen;
  if (by_turns) {
    // Fair shapes may be bent more. One on the way that is may as well be crumpled.
    if (sums.turns && defects.turns > turns_ + unseen) return "its faces turn more from one to the next";
  } else if (!now.is_curve) {
    if (is_bent_more) return fmt::format("it is bent more, by {:.3g} in place of {:.3g}", defects.bending, bending_);
    const double smooth = smooth_bending_ ? bending_without_noise(now) : 0;
    if (smooth > risen_smooth_bending * smooth_bending_.value_or(0) + unseen)
      return fmt::format("it is bent more, by {:.3g} in place of {:.3g} without the noise of either", smooth,
                         *smooth_bending_);
  }
  // What bends less may have curvature that changes more.
  if (!now.spheres.differences.empty()) return {};
  model_->prepare(now);
  update_directions(now, *model_, *team_);
  const double energy = spring_energy(now).sum;
  const double rise = by_turns ? 1 : !is_surface_ && is_bent_more ? noticed_rise_of_curves : noticed_rise;
  if (!(energy <= rise * energy_ + unseen))
    return fmt::format("the V-Spring energy rose from {:.3g} to {:.3g}", energy_, energy);
  return {};
}

void warn_if_worse(const ResultCheck& check, Net& found, FairReport& report) {
  const std::string fault = check.fault(found, report.outcome == Outcome::cancelled);
  if (fault.empty()) return;
  report.warnings.push_back({WarningCode::worse_than_input, "what was found is worse than the input: " + fault});
  if (report.outcome == Outcome::converged) report.outcome = Outcome::worse_than_input;
}

}  // namespace vspring
