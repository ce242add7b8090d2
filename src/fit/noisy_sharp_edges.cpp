#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>
#include <vector>

#include "base/disjoint_sets.hpp"
#include "shape/sharp_edges.hpp"
#include "vspring/fit.hpp"
#include "vspring/topology.hpp"

namespace vspring {

namespace {

// As a share of the angle: edges that turn by so much continue a chain.
constexpr double share_that_continues = 0.5;
// Cosine between edges of a chain that goes on.
constexpr double still_ahead = 0.5;
// Edges of chains that end inside the surface.
constexpr int fewest_edges = 3;
// Around which edges are no side's rim.
constexpr std::size_t fewest_faces = 6;

/// Finds chains of sharp edges in spite of noise.
class NoisyChains {
 public:
  NoisyChains(const PolygonMesh& mesh, double angle)
      : mesh_(mesh), turning_(turning_edges(mesh)), boundary_(boundary_nodes(mesh)) {
    for (std::size_t k = 0; k < turning_.size(); ++k) {
      if (turning_[k].turn > angle) mark(k);
      if (turning_[k].turn > share_that_continues * angle) {
        candidates_[turning_[k].first].push_back(k);
        candidates_[turning_[k].second].push_back(k);
      }
    }
    is_sharp_.resize(turning_.size(), 0);
  }

  MeshEdges find() {
    go_on();
    leave_out_spots();
    leave_out_short_chains();
    MeshEdges edges;
    for (std::size_t k = 0; k < turning_.size(); ++k) {
      if (is_sharp_[k] != 0) edges.emplace_back(turning_[k].first, turning_[k].second);
    }
    return edges;
  }

 private:
  void mark(std::size_t edge) {
    is_sharp_.resize(turning_.size(), 0);
    is_sharp_[edge] = 1;
    at_[turning_[edge].first].insert(edge);
    at_[turning_[edge].second].insert(edge);
  }
  void unmark(std::size_t edge) {
    is_sharp_[edge] = 0;
    for (const Index node : {turning_[edge].first, turning_[edge].second}) {
      const auto found = at_.find(node);
      found->second.erase(edge);
      if (found->second.empty()) at_.erase(found);
    }
  }
  [[nodiscard]] Index other_end(std::size_t edge, Index node) const {
    return turning_[edge].first == node ? turning_[edge].second : turning_[edge].first;
  }
  [[nodiscard]] bool is_tip(Index node) const {
    const auto found = at_.find(node);
    return found != at_.end() && found->second.size() == 1 && boundary_[static_cast<std::size_t>(node)] == 0;
  }

  /// Extends chains from each tip along that edge ahead which turns most, until there is none.
  void go_on() {
    std::vector<Index> tips;
    for (const auto& [node, edges] : at_) {
      if (is_tip(node)) tips.push_back(node);
    }
    for (Index tip : tips) {
      while (is_tip(tip)) {
        const std::size_t last = *at_[tip].begin();
        const Vector3 way = (mesh_.position(tip) - mesh_.position(other_end(last, tip))).stableNormalized();
        double most = 0;
        std::size_t next = turning_.size();
        for (const std::size_t k : candidates_[tip]) {
          const Vector3 ahead = (mesh_.position(other_end(k, tip)) - mesh_.position(tip)).stableNormalized();
          if (is_sharp_[k] != 0 || ahead.dot(way) < still_ahead || turning_[k].turn <= most) continue;
          most = turning_[k].turn;
          next = k;
        }
        if (next == turning_.size()) break;
        mark(next);
        tip = other_end(next, tip);
      }
    }
  }

  /// Finds edges around only a few faces, such as around a single node that stands out.
  void leave_out_spots() {
    DisjointSets sides(static_cast<std::size_t>(mesh_.face_count()));
    for (std::size_t k = 0; k < turning_.size(); ++k) {
      if (is_sharp_[k] == 0)
        (void)sides.join(static_cast<std::size_t>(turning_[k].face), static_cast<std::size_t>(turning_[k].other_face));
    }
    std::vector<std::size_t> size(static_cast<std::size_t>(mesh_.face_count()), 0);
    for (std::size_t f = 0; f < size.size(); ++f) ++size[sides.find(f)];
    for (std::size_t k = 0; k < turning_.size(); ++k) {
      if (is_sharp_[k] == 0) continue;
      for (const Index face : {turning_[k].face, turning_[k].other_face}) {
        if (is_sharp_[k] != 0 && size[sides.find(static_cast<std::size_t>(face))] < fewest_faces) unmark(k);
      }
    }
  }

  /// Follows the chain from each tip to where other edges meet it.
  void leave_out_short_chains() {
    for (bool found = true; found;) {
      found = false;
      std::vector<Index> tips;
      for (const auto& [node, edges] : at_) {
        if (is_tip(node)) tips.push_back(node);
      }
      for (const Index tip : tips) {
        if (!is_tip(tip)) continue;
        std::vector<std::size_t> chain = {*at_[tip].begin()};
        Index end = other_end(chain.back(), tip);
        while (chain.size() < fewest_edges && at_[end].size() == 2) {
          const auto& both = at_[end];
          chain.push_back(*both.begin() == chain.back() ? *both.rbegin() : *both.begin());
          end = other_end(chain.back(), end);
        }
        if (chain.size() >= fewest_edges) continue;
        for (const std::size_t k : chain) unmark(k);
        found = true;
      }
    }
  }

  const PolygonMesh& mesh_;
  const std::vector<TurningEdge> turning_;
  const std::vector<std::uint8_t> boundary_;
  std::vector<std::uint8_t> is_sharp_;
  std::map<Index, std::set<std::size_t>> at_;             ///< per node, its sharp edges
  std::map<Index, std::vector<std::size_t>> candidates_;  ///< per node, edges that turn enough to go on
};

}  // namespace

SharpEdges find_sharp_edges(const PolygonMesh& mesh, double angle, double noise, Context& context) {
  check_sharp_angle(angle);
  if (noise == 0) return find_sharp_edges(mesh, angle);
  FitOptions options;
  options.criterion = Noise{noise};
  options.fair.distribution = Distribution::keep;
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  ScatteredPoints nodes;
  nodes.positions = mesh.positions();
  PolygonMesh smooth = mesh;
  smooth.set_positions(fit(mesh, constraints, nodes, options, context).positions);
  return chains_of(mesh, NoisyChains(smooth, angle).find());
}

}  // namespace vspring
