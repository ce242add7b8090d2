#include "checks/result_check.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <vector>

#include "checks/bending_energy.hpp"
#include "checks/curve_crossings.hpp"
#include "shape/direction.hpp"
#include "spring/spacing.hpp"

namespace vspring {

namespace {

// In longest sides of the start, to all sides of its centre: between few held nodes a fair shape may be rounder than a
// flat input, and a given tangent or normal may make a wide loop.
constexpr double wide_box = 3;
constexpr double box_of_directions = 10;
// As a share of the longest side of the start, and of the geometric mean of its edges: a shape that is smaller by both
// has shrunk between held nodes that lie close together, such as the ends of an outline. The edges of a spike that
// becomes flat stay longer, and the straight line between the ends of a spiral has a wider box.
constexpr double shrunk = 0.2;
// If the rim is free to turn, springs may bend a shape more so that its curvature changes more gently. A turn of an
// edge by less than about this, in radians, is due to rounding or to a tolerance.
constexpr double risen_bending = 1.3;
constexpr double unseen_turn = 1e-3;
// In mean edges: shorter edges, and faces smaller than the square of that, count as collapsed.
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

/// κ² of an edge d at angle θ to the given direction at its end j: as between a chord and its tangent, κ = 2 θ/ℓ. 0
/// without a given direction.
double squared_curvature_to_given(const Net& net, std::size_t j, const Vector3& d) {
  if (net.given[j] == 0) return 0;
  const double length = d.norm();
  if (!(length > 0)) return 0;
  const double angle = net.is_curve && net.tangent_given(j)
                           ? std::atan2(net.tangents[j].cross(d).norm(), net.tangents[j].dot(d))
                           : std::asin(std::min(1.0, std::abs(d.dot(net.normals[j])) / length));
  return 4 * angle * angle / (length * length);
}

/// bending_over() of a node, and the bending of its edges to nodes with given normals, each over an equal part of its
/// share of the faces. spokes, faces: as find_faces() finds them; beside a rim there is no link all round.
double bending_at(const Net& net, const std::vector<Vector3>& positions, std::size_t i,
                  std::span<const std::size_t> spokes, std::span<const Vector3> faces) {
  const auto all = net.rings.links(i);
  Vector3 normal = Vector3::Zero();
  double share = 0;
  double to_given = 0;
  for (std::size_t s = 0; s < faces.size(); ++s) {
    const std::size_t next = spokes[place_after(s, spokes.size())];
    const std::size_t corners = (next > spokes[s] ? next : next + all.size()) - spokes[s] + 2;
    normal += faces[s];
    if (faces[s].allFinite()) share += 0.5 * faces[s].norm() / static_cast<double>(corners);
    const std::size_t j = all[spokes[s]].node();
    to_given += squared_curvature_to_given(net, j, positions[j] - positions[i]);
  }
  const auto plane = height_plane(net, positions, i, normal, share);
  return (plane ? bending_over(*plane, net, positions, i) : 0) +
         to_given * share / static_cast<double>(std::max<std::size_t>(1, spokes.size()));
}

/// θ²/ℓ at a node i of a curve between two edges, and the same of these and given directions, over half of each.
double bending_at(const Net& net, std::size_t i, const Vector3& before, const Vector3& after) {
  const double turn = std::atan2(before.cross(after).norm(), before.dot(after));
  const double length = (before.norm() + after.norm()) / 2;
  const auto links = net.rings.links(i);
  return (length > 0 ? turn * turn / length : 0) +
         (squared_curvature_to_given(net, links[0].node(), before) * before.norm() +
          squared_curvature_to_given(net, links[1].node(), after) * after.norm()) /
             2;
}

/// Of edges that have a length.
double geometric_mean_edge(const Net& net) {
  double sum = 0;
  double edges = 0;
  for (std::size_t i = 0; i < net.computed; ++i) {
    for (const Link link : net.rings.links(i)) {
      if (!link.spoke() || link.node() < i) continue;
      const double length = (net.positions[link.node()] - net.positions[i]).norm();
      if (!(length > 0)) continue;
      sum += std::log(length);
      edges += 1;
    }
  }
  return edges > 0 ? std::exp(sum / edges) : 0;
}

/// positions: of the nodes, those of the net or others. edge: the mean one. dragged: 1 for nodes that are held
/// elsewhere than in the input, as edges may turn beside them; or empty. bending: whether to find that.
ShapeDefects defects_of(const Net& net, const std::vector<Vector3>& positions, double edge, ThreadTeam& team,
                        bool bending, std::span<const std::uint8_t> dragged = {}) {
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
      if (bending) defects.bending += bending_at(net, i, before, after);
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
        const double cosine = faces[last].dot(faces[s]) / (faces[last].norm() * faces[s].norm());
        if (cosine < part.least_cosine) part.least_cosine = cosine;
      }
      if (bending && std::none_of(links.begin(), links.end(), [&](Link link) { return is_dragged(link.node()); }))
        part.bending += bending_at(net, positions, i, spokes, faces);
    }
  };
  ShapeDefects defects;
  for (const ShapeDefects& part : parallel_parts(team, net.computed, nodes_per_task, ShapeDefects(), look)) {
    defects.turned += part.turned;
    defects.collapsed += part.collapsed;
    defects.bending += part.bending;
    defects.least_cosine = std::min(defects.least_cosine, part.least_cosine);
  }
  return defects;
}

}  // namespace

std::size_t turned_edges(const Net& net, const std::vector<Vector3>& positions, ThreadTeam& team) {
  return defects_of(net, positions, 0, team, false).turned;
}

double bending_of_curve(const Net& net, const std::vector<Vector3>& positions) {
  ThreadTeam alone(1);
  return defects_of(net, positions, 0, alone, true).bending;
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

ResultCheck::ResultCheck(const Net& start, ThreadTeam& team) : team_(&team) {
  for (const Vector3& position : start.positions) box_.extend(position);
  for (const Vector3& position : start.points.positions) box_.extend(position);
  has_directions_ = std::any_of(start.given.begin(), start.given.end(), [](std::uint8_t given) { return given != 0; });
  has_points_ = !start.points.positions.empty();
  is_surface_ = !start.is_curve;
  edge_ = mean_edge(start);
  if (!has_points_) geometric_mean_edge_ = geometric_mean_edge(start);
  const std::vector<Vector3>& input = start.input.empty() ? start.positions : start.input;
  defects_ = defects_of(start, input, edge_, team, start.input.empty() && looks_at_bending());
  turned_without_noise_ = defects_.turned;
  if (is_surface_ && defects_.turned > 0)
    turned_without_noise_ = std::min(defects_.turned, turned_edges(start, rest_positions(start, team), team));
  held_.assign(input.begin() + static_cast<std::ptrdiff_t>(start.moving), input.end());
  if (looks_at_crossings(start)) input_ = input;
  if (!looks_at_bending()) return;
  if (!start.input.empty()) defects_.bending = defects_of(start, start.positions, edge_, team, true).bending;
  if (start.input.empty() && is_surface_ && !has_directions_) bending_without_noise_ = bending_without_noise(start);
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
  // Of faces without area it is not known how they are bent.
  return !has_points_ && (!is_surface_ || defects_.collapsed == 0);
}

bool ResultCheck::looks_at_crossings(const Net& net) const { return !has_directions_ && net.is_curve; }

double ResultCheck::bending_without_noise(const Net& net) const {
  return std::min(defects_of(net, net.positions, edge_, *team_, true).bending,
                  defects_of(net, rest_positions(net, *team_), edge_, *team_, true).bending);
}

bool ResultCheck::keeps_folds(const Net& now) const {
  if (turned_without_noise_ == defects_.turned) return false;
  return defects_of(now, now.positions, edge_, *team_, false, dragged(now)).turned > turned_without_noise_;
}

bool ResultCheck::turns_more(const Net& now) const {
  return defects_of(now, now.positions, edge_, *team_, false, dragged(now)).least_cosine < defects_.least_cosine;
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
  std::string more = more_of(defects_of(now, now.positions, edge_, *team_, false, dragged_nodes), !now.is_curve);
  return more.empty() ? more_crossings(now) : more;
}

std::string ResultCheck::more_crossings(const Net& now) const {
  if (!looks_at_crossings(now)) return {};
  const std::size_t crossings = curve_crossings(now, now.positions, *team_);
  std::size_t before = crossings > 0 ? curve_crossings(now, input_, *team_, Touching::counts) : 0;
  if (crossings > before && !dragged(now).empty()) {
    // Held nodes that move may by themselves make edges cross.
    std::vector<Vector3> start = input_;
    std::copy(now.positions.begin() + static_cast<std::ptrdiff_t>(now.moving), now.positions.end(),
              start.begin() + static_cast<std::ptrdiff_t>(now.moving));
    before = std::max(before, curve_crossings(now, start, *team_, Touching::counts));
  }
  if (crossings <= before) return {};
  return fmt::format("{} pairs of edges cross each other, {} did before", crossings, before);
}

std::string ResultCheck::shrinkage(const Net& now) const {
  const auto longest_side = [](std::span<const Vector3> positions) {
    Eigen::AlignedBox3d box;
    for (const Vector3& position : positions) box.extend(position);
    return box.isEmpty() ? 0 : box.sizes().maxCoeff();
  };
  const double held_before = longest_side(held_);
  const double held_now = longest_side(std::span(now.positions).subspan(now.moving));
  // What is dragged together makes the shape smaller.
  const double least = held_now < held_before ? shrunk * held_now / held_before : shrunk;
  const double size = longest_side(now.positions) / box_.sizes().maxCoeff();
  if (!(size < least) || !(geometric_mean_edge(now) < least * geometric_mean_edge_)) return {};
  return fmt::format("it shrinks to {:.2g} % of its size", 100 * size);
}

std::string ResultCheck::fault(const Net& now) const {
  std::string misplaced_node = misplaced(now);
  if (!misplaced_node.empty()) return misplaced_node;
  const std::vector<std::uint8_t> dragged_nodes = dragged(now);
  const ShapeDefects defects = defects_of(now, now.positions, edge_, *team_, looks_at_bending(), dragged_nodes);
  std::string more = more_of(defects, !now.is_curve);
  if (more.empty()) more = more_crossings(now);
  if (!more.empty() || !looks_at_bending()) return more;
  if (std::string less = shrinkage(now); !less.empty()) return less;
  const double unseen = unseen_turn * unseen_turn * static_cast<double>(now.rings.link_count());
  if (defects.bending > risen_bending * defects_.bending + unseen)
    return fmt::format("it is bent more, by {:.3g} in place of {:.3g}", defects.bending, defects_.bending);
  const double smooth = bending_without_noise_ ? bending_without_noise(now) : 0;
  if (smooth > risen_bending * bending_without_noise_.value_or(0) + unseen)
    return fmt::format("it is bent more, by {:.3g} in place of {:.3g} without the noise of either", smooth,
                       *bending_without_noise_);
  return {};
}

void warn_if_worse(const ResultCheck& check, const Net& found, FairReport& report) {
  const std::string fault = check.fault(found);
  if (fault.empty()) return;
  report.warnings.push_back({WarningCode::worse_than_input, "what was found is worse than the input: " + fault});
  if (report.outcome == Outcome::converged) report.outcome = Outcome::worse_than_input;
}

}  // namespace vspring
