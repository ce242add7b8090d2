#include "fairness/curve_runs.hpp"

#include <utility>

namespace vspring {

namespace {

class Cutting {
 public:
  Cutting(const PolygonCurve& curve, const Constraints* constraints) : curve_(curve), constraints_(constraints) {}

  void cut(const PolygonCurve::Chain& chain) {
    const std::size_t count = chain.nodes.size();
    const std::size_t edges = count < 2 ? 0 : count - (chain.closed ? 0 : 1);
    // Around a closed chain runs begin after the first edge left out, if any.
    std::size_t begin = 0;
    if (chain.closed) {
      while (begin < edges && counts(chain, begin)) ++begin;
      if (begin == edges) begin = 0;
    }
    bool whole = edges > 0;
    for (std::size_t step = 0; step < edges; ++step) {
      const std::size_t k = (begin + step) % count;
      if (counts(chain, k)) {
        add_edge(chain.nodes[k], chain.nodes[(k + 1) % count]);
      } else {
        whole = false;
        finish(false);
      }
    }
    finish(chain.closed && whole);
  }

  [[nodiscard]] std::vector<CurveRun> take() { return std::move(runs_); }

 private:
  [[nodiscard]] bool counts(const PolygonCurve::Chain& chain, std::size_t edge) const {
    const Index a = chain.nodes[edge];
    const Index b = chain.nodes[(edge + 1) % chain.nodes.size()];
    if (!curve_.position(a).allFinite() || !curve_.position(b).allFinite()) return false;
    return constraints_ == nullptr || !constraints_->position_fixed(a) || !constraints_->position_fixed(b);
  }

  void add_edge(Index from, Index to) {
    if (run_.nodes.empty()) run_.nodes.push_back(from);
    if (curve_.position(run_.nodes.back()) == curve_.position(to)) {
      ++run_.zero_length_edges;
    } else {
      run_.nodes.push_back(to);
    }
  }

  void finish(bool closed) {
    // The last edge of a closed run came back to its first node.
    if (closed && run_.nodes.size() > 1 && curve_.position(run_.nodes.front()) == curve_.position(run_.nodes.back()))
      run_.nodes.pop_back();
    run_.closed = closed;
    if (!run_.nodes.empty()) runs_.push_back(std::move(run_));
    run_ = {};
  }

  const PolygonCurve& curve_;
  const Constraints* constraints_;
  CurveRun run_;
  std::vector<CurveRun> runs_;
};

}  // namespace

std::vector<CurveRun> curve_runs(const PolygonCurve& curve, const Constraints* constraints) {
  Cutting cutting(curve, constraints);
  for (const auto& chain : curve.chains()) cutting.cut(chain);
  return cutting.take();
}

PolygonCurve visible_part(const PolygonCurve& curve) {
  std::vector<Vector3> positions = curve.positions();
  bool all = true;
  for (Vector3& position : positions) {
    if (position.allFinite()) continue;
    position.setZero();
    all = false;
  }
  std::vector<PolygonCurve::Chain> chains;
  for (CurveRun& run : curve_runs(curve, nullptr)) {
    all = all && run.zero_length_edges == 0;
    chains.push_back({.nodes = std::move(run.nodes), .closed = run.closed});
  }
  if (all) return curve;
  return {std::move(positions), std::move(chains)};
}

}  // namespace vspring
