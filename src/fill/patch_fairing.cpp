#include "fill/patch_fairing.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <string>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "base/message_text.hpp"
#include "solve/outcomes.hpp"
#include "vspring/constraints.hpp"
#include "vspring/self_intersections.hpp"

namespace vspring {

namespace {

// The solver needs the faces around the rim, and estimates of normals at boundaries there need those around them.
constexpr int rings_of_normals = 2;
// Estimates of curvature look as far, and their own boundary is to be beyond that.
constexpr int rings_of_curvature = 9;

using Holes = std::vector<std::size_t>;

/// While it lives, calls report their progress as part of a longer call.
class PartOfProgress {
 public:
  PartOfProgress(Context& context, double begin)
      : context_(&context), whole_(std::move(context.on_progress)), begin_(begin) {
    if (!whole_) return;
    context.on_progress = [this](Progress progress) {
      progress.fraction = begin_ + share_ * progress.fraction;
      whole_(progress);
    };
  }
  ~PartOfProgress() { context_->on_progress = std::move(whole_); }
  PartOfProgress(const PartOfProgress&) = delete;
  PartOfProgress& operator=(const PartOfProgress&) = delete;

  /// The next part, a share of the whole.
  void next(double share) {
    begin_ += share_;
    share_ = share;
  }

 private:
  Context* context_;
  std::function<void(const Progress&)> whole_;
  double begin_;
  double share_ = 0;
};

/// Patches and the faces around them.
struct Part {
  PolygonMesh mesh;
  std::vector<Index> node;    ///< per node its number in the whole mesh, ascending
  std::vector<Index> region;  ///< the new ones
};

void sort_and_unite(std::vector<Index>& numbers) {
  std::sort(numbers.begin(), numbers.end());
  numbers.erase(std::unique(numbers.begin(), numbers.end()), numbers.end());
}

/// rings: of faces.
Part part_around(const FilledHoles& filled, const Holes& group, const PolygonMesh& input, const Incidence& incidence,
                 int rings) {
  std::vector<Index> nodes;
  for (const std::size_t h : group) nodes.insert(nodes.end(), filled.holes[h].rim.begin(), filled.holes[h].rim.end());
  std::vector<Index> faces;
  for (int ring = 0; ring < rings; ++ring) {
    faces.clear();
    for (const Index node : nodes) {
      for (const Corner corner : incidence.corners(node)) faces.push_back(corner.face);
    }
    sort_and_unite(faces);
    for (const Index face : faces) {
      const auto corners = input.face(face);
      nodes.insert(nodes.end(), corners.begin(), corners.end());
    }
    sort_and_unite(nodes);
  }
  Part part;
  part.node = std::move(nodes);
  for (const std::size_t h : group) {
    const Hole& hole = filled.holes[h];
    for (Index k = 0; k < hole.face_count; ++k) faces.push_back(hole.first_face + k);
    for (Index k = 0; k < hole.node_count; ++k) {
      part.region.push_back(static_cast<Index>(part.node.size()));
      part.node.push_back(hole.first_node + k);
    }
  }
  MeshBuilder builder;
  for (const Index node : part.node) builder.add_node(filled.positions[static_cast<std::size_t>(node)]);
  std::vector<Index> corners;
  for (const Index face : faces) {
    corners.clear();
    for (const Index node : filled.mesh.face(face))
      corners.push_back(
          static_cast<Index>(std::lower_bound(part.node.begin(), part.node.end(), node) - part.node.begin()));
    builder.add_face(corners);
  }
  part.mesh = builder.take();
  return part;
}

std::string called(const FilledHoles& filled, const Holes& group) {
  std::vector<Index> nodes;
  nodes.reserve(group.size());
  for (const std::size_t h : group) nodes.push_back(filled.holes[h].rim.front());
  return (group.size() == 1 ? "the hole at " : "the holes at ") + nodes_in_words(nodes);
}

/// Adds work done before, or elsewhere.
void add_work(FairReport& all, const FairReport& other) {
  all.iterations += other.iterations;
  all.history.insert(all.history.begin(), other.history.begin(), other.history.end());
  all.levels.insert(all.levels.begin(), other.levels.begin(), other.levels.end());
  all.work += other.work;
  all.most_work += other.most_work;
}

/// Adds the report of some patches to that of all. most: number of moving nodes of the largest part so far.
void add(FairReport& all, const FairReport& part, const std::string& name, Index& most) {
  worsen(all.outcome, part.outcome);
  all.method = part.method;
  // What all have.
  if (most == 0 || part.continuity == Continuity::tangent) all.continuity = part.continuity;
  if (part.moving_nodes > most) {
    most = part.moving_nodes;
    all.springs = part.springs;
    all.fair_by = part.fair_by;
    all.curvature_jump = part.curvature_jump;
  }
  add_work(all, part);
  all.residual = std::max(all.residual, part.residual);
  if (part.expected_error) all.expected_error = std::max(all.expected_error.value_or(0), *part.expected_error);
  all.moving_nodes += part.moving_nodes;
  for (const Warning& warning : part.warnings)
    all.warnings.emplace_back(warning.code, fmt::format("{}: {}", name, warning.fault()), warning.advice);
}

/// Per group the pairs of crossing faces with a face of the group; other pairs are left out.
std::vector<std::vector<std::pair<Index, Index>>> crossings(const FilledHoles& filled, const PolygonMesh& mesh,
                                                            const std::vector<Holes>& groups, const Context& context) {
  std::vector<std::size_t> group_of(filled.face_like.size(), groups.size());
  const auto first = static_cast<std::size_t>(mesh.face_count()) - filled.face_like.size();
  for (std::size_t g = 0; g < groups.size(); ++g) {
    for (const std::size_t h : groups[g]) {
      const Hole& hole = filled.holes[h];
      for (Index k = 0; k < hole.face_count; ++k) group_of[static_cast<std::size_t>(hole.first_face + k) - first] = g;
    }
  }
  std::vector<std::vector<std::pair<Index, Index>>> result(groups.size());
  for (const auto& pair : self_intersections(mesh, context)) {
    std::size_t last = groups.size();
    for (const Index face : {pair.first, pair.second}) {
      if (static_cast<std::size_t>(face) < first) continue;
      const std::size_t g = group_of[static_cast<std::size_t>(face) - first];
      if (g == groups.size() || g == last) continue;
      result[g].push_back(pair);
      last = g;
    }
  }
  return result;
}

/// Undoes the fairing of patches that made them cross more faces, and warns of patches that cross any.
void look_for_crossings(FilledHoles& filled, const std::vector<Holes>& groups, Context& context) {
  PolygonMesh fair_mesh = filled.mesh;
  fair_mesh.set_positions(filled.positions);
  const auto now = crossings(filled, fair_mesh, groups, context);
  const bool any = std::any_of(now.begin(), now.end(), [](const auto& pairs) { return !pairs.empty(); });
  if (!any || context.cancelled()) return;
  const auto flat = crossings(filled, filled.mesh, groups, context);
  if (context.cancelled()) return;
  for (std::size_t g = 0; g < groups.size(); ++g) {
    const bool is_worse = now[g].size() > flat[g].size();
    const auto& left = is_worse ? flat[g] : now[g];
    const std::string name = called(filled, groups[g]);
    if (is_worse) {
      for (const std::size_t h : groups[g]) {
        Hole& hole = filled.holes[h];
        worsen(hole.outcome.emplace(hole.outcome.value_or(Outcome::converged)), Outcome::worse_than_input);
        std::copy_n(filled.mesh.positions().begin() + hole.first_node, hole.node_count,
                    filled.positions.begin() + hole.first_node);
      }
      worsen(filled.report.outcome, Outcome::worse_than_input);
      filled.report.warnings.emplace_back(
          WarningCode::worse_than_input,
          fmt::format("{}: a fair patch would cross {} faces or more ({} and {}, for one), so it stays flat", name,
                      now[g].size(), now[g].front().first, now[g].front().second));
    }
    if (left.empty()) continue;
    filled.report.warnings.emplace_back(
        WarningCode::patch_crosses,
        fmt::format("{}: its patch crosses other faces ({} and {}, for one); look at it there", name,
                    left.front().first, left.front().second));
  }
}

}  // namespace

std::vector<PatchFairing::Holes> PatchFairing::touching(const FilledHoles& filled) const {
  const std::size_t count = filled.holes.size();
  DisjointSets sets(count);
  std::vector<std::size_t> hole_at(input_.positions().size(), count);
  for (std::size_t h = 0; h < count; ++h) {
    if (filled.holes[h].state != HoleState::filled) continue;
    for (const Index node : filled.holes[h].rim) {
      for (const Corner corner : incidence_.corners(node)) {
        for (const Index other : input_.face(corner.face)) {
          if (const std::size_t there = hole_at[static_cast<std::size_t>(other)]; there != count) sets.join(h, there);
        }
      }
      hole_at[static_cast<std::size_t>(node)] = h;
    }
  }
  std::vector<Holes> groups(count);
  for (std::size_t h = 0; h < count; ++h) {
    if (filled.holes[h].node_count > 0) groups[sets.find(h)].push_back(h);
  }
  std::erase_if(groups, [](const Holes& group) { return group.empty(); });
  return groups;
}

void PatchFairing::run(FilledHoles& filled, const std::vector<std::uint8_t>& due, double begin, double share) {
  PartOfProgress progress(context_, begin);
  for (const Holes& group : touching(filled)) {
    if (std::none_of(group.begin(), group.end(), [&](std::size_t h) { return due[h] != 0; })) continue;
    const int rings = options_.continuity == Continuity::curvature ? rings_of_curvature : rings_of_normals;
    const Part part = part_around(filled, group, input_, incidence_, rings);
    progress.next(share * static_cast<double>(part.region.size()) / static_cast<double>(filled.node_like.size()));
    Constraints constraints(part.mesh.node_count());
    restrict_to_region(constraints, part.mesh, part.region);
    FairResult result = fair(part.mesh, constraints, options_, context_);
    for (const Index k : part.region) {
      const auto local = static_cast<std::size_t>(k);
      filled.positions[static_cast<std::size_t>(part.node[local])] = result.positions[local];
    }
    for (const std::size_t h : group) filled.holes[h].outcome = result.report.outcome;
    const auto [known, is_new] = reports_.emplace(group.front(), result.report);
    if (is_new) continue;
    const FairReport before = std::exchange(known->second, std::move(result.report));
    add_work(known->second, before);
  }
}

void PatchFairing::finish(FilledHoles& filled) {
  const std::vector<Holes> groups = touching(filled);
  Index most = 0;
  for (const Holes& group : groups) {
    const auto report = reports_.find(group.front());
    if (report != reports_.end()) add(filled.report, report->second, called(filled, group), most);
  }
  if (!groups.empty() && !context_.cancelled()) look_for_crossings(filled, groups, context_);
  double squares = 0;
  for (std::size_t k = input_.positions().size(); k < filled.positions.size(); ++k) {
    const double move = (filled.positions[k] - filled.mesh.positions()[k]).norm();
    filled.report.greatest_move = std::max(filled.report.greatest_move, move);
    squares += move * move;
  }
  if (!filled.node_like.empty())
    filled.report.rms_move = std::sqrt(squares / static_cast<double>(filled.node_like.size()));
}

}  // namespace vspring
