#include "solve/soundness.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "solve/spring_energy.hpp"

namespace vspring {

namespace {

// Boxes about the centre, in sizes of that of the start; a tangent may well ask for a wide loop.
constexpr double wide_box = 3;
constexpr double box_of_directions = 20;
// The energy of an exactly fair shape is rounding, a tolerance leaves some, and where nodes of a coarse shape slide it
// may rise though curvature changes more gently: what rises by less than this factor, or to less than about this turn
// (in radians) for an edge, tells nothing.
constexpr double noticed_rise = 3;
constexpr double unseen_turn = 1e-3;
// Of the product of two vectors, what tells of an angle beyond 90° in spite of rounding.
constexpr double beyond_right = -1e-6;

bool turns_back(const Vector3& a, const Vector3& b) {
  return a.dot(b) < beyond_right * std::sqrt(a.squaredNorm() * b.squaredNorm());
}

/// Vector areas, times two, of the faces that follow the spokes of a node; zero where there is none.
void find_faces(const Net& net, std::size_t i, std::vector<std::size_t>& spokes, std::vector<Vector3>& faces) {
  const auto links = net.rings.links(i);
  spokes.clear();
  faces.clear();
  for (std::size_t k = 0; k < links.size(); ++k) {
    if (!links[k].spoke()) continue;
    spokes.push_back(k);
    Vector3 area = Vector3::Zero();
    for (std::size_t at = k;;) {
      const std::size_t next = (at + 1) % links.size();
      if (links[next].start() || links.size() < 2) {
        area.setZero();
        break;
      }
      area += (net.positions[links[at].node()] - net.positions[i])
                  .cross(net.positions[links[next].node()] - net.positions[i]);
      at = next;
      if (links[at].spoke()) break;
    }
    faces.push_back(area);
  }
}

std::size_t turned_edges(const Net& net) {
  std::size_t count = 0;
  if (!net.tangents.empty()) {
    for (std::size_t i = 0; i < net.moving; ++i) {
      const auto links = net.rings.links(i);
      if (links.size() < 2) continue;
      count += turns_back(net.positions[i] - net.positions[links[0].node()],
                          net.positions[links[1].node()] - net.positions[i])
                   ? 1
                   : 0;
    }
    return count;
  }
  std::vector<std::size_t> spokes;
  std::vector<Vector3> faces;
  for (std::size_t i = 0; i < net.computed; ++i) {
    find_faces(net, i, spokes, faces);
    for (std::size_t s = 0; s < spokes.size(); ++s) {
      const std::size_t j = net.rings.links(i)[spokes[s]].node();
      if (j < i && j < net.computed) continue;
      count += turns_back(faces[(s + faces.size() - 1) % faces.size()], faces[s]) ? 1 : 0;
    }
  }
  return count;
}

}  // namespace

Soundness::Soundness(Net& start, const Model& model, ThreadTeam& team) : model_(&model), team_(&team) {
  for (const Vector3& position : start.positions) box_.extend(position);
  for (const Vector3& position : start.points.positions) box_.extend(position);
  has_directions_ = std::any_of(start.given.begin(), start.given.end(), [](std::uint8_t given) { return given != 0; });
  has_points_ = !start.points.positions.empty();
  turned_ = turned_edges(start);
  const bool was_prepared = !start.curvatures.empty();
  model.prepare(start);
  update_directions(start, model, team);
  energy_ = spring_energy(start).sum;
  // Sweeps must do without: they move from the newest positions.
  if (!was_prepared) start.curvatures.clear();
}

std::string Soundness::fault(Net& now) const {
  const Vector3 half =
      0.5 * (has_directions_ ? box_of_directions : wide_box) * box_.diagonal().maxCoeff() * Vector3::Ones();
  const Eigen::AlignedBox3d wide(box_.center() - half, box_.center() + half);
  for (std::size_t i = 0; i < now.moving; ++i) {
    if (!now.positions[i].allFinite()) return fmt::format("node {} has no place", now.node[i]);
    if (!wide.contains(now.positions[i]))
      return fmt::format("node {} is far outside the box of what was given", now.node[i]);
  }
  const std::size_t turned = turned_edges(now);
  if (turned > turned_) return fmt::format("{} edges turn by more than 90°, {} did before", turned, turned_);
  if (has_directions_ || has_points_) return {};
  model_->prepare(now);
  update_directions(now, *model_, *team_);
  const double energy = spring_energy(now).sum;
  const double unseen = unseen_turn * unseen_turn * static_cast<double>(now.rings.link_count());
  if (!(energy <= noticed_rise * energy_ + unseen))
    return fmt::format("the V-Spring energy rose from {:.3g} to {:.3g}", energy_, energy);
  return {};
}

void say_if_worse(const Soundness& soundness, Net& found, FairReport& report) {
  const std::string fault = soundness.fault(found);
  if (fault.empty()) return;
  report.warnings.push_back("what was found is worse than the input: " + fault);
  if (report.outcome == Outcome::converged) report.outcome = Outcome::worse_than_input;
}

}  // namespace vspring
