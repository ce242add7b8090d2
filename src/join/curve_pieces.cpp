#include "join/curve_pieces.hpp"

#include <algorithm>

namespace vspring {

namespace {

class ChainCutting {
 public:
  ChainCutting(const PolygonCurve::Chain& chain, const Constraints& constraints, const std::vector<Vector3>& places)
      : nodes_(chain.nodes), joins_(chain.closed), constraints_(constraints), places_(places) {}

  void cut(std::vector<CurvePiece>& pieces) {
    if (nodes_.size() < 2) return;
    if (joins_ && !opens()) {
      nodes_.push_back(nodes_.front());
      pieces.push_back(piece(0, nodes_.size() - 1));
      pieces.back().closed = true;
      return;
    }
    for (std::size_t k = 0; k + 1 < nodes_.size(); ++k) {
      if (!moves(k + 1)) continue;
      const std::size_t first = k;
      while (moves(k) || (k + 1 < nodes_.size() && moves(k + 1))) ++k;
      pieces.push_back(piece(first, k));
      pieces.back().beside = {beside(first, false), beside(k, true)};
    }
  }

 private:
  [[nodiscard]] bool moves(std::size_t k) const { return !constraints_.position_fixed(nodes_[k]); }

  /// Turns a closed chain so that it begins at a held node, and ends at one where two follow each other. False where
  /// none do.
  bool opens() {
    const auto begin_at = [&](std::size_t k) {
      std::rotate(nodes_.begin(), nodes_.begin() + static_cast<std::ptrdiff_t>(k), nodes_.end());
    };
    const std::size_t count = nodes_.size();
    std::size_t held = 0;
    for (std::size_t k = 0; k < count; ++k) {
      if (moves(k)) continue;
      held = k;
      if (moves((k + 1) % count)) continue;
      begin_at((k + 1) % count);
      return true;
    }
    begin_at(held);
    return false;
  }

  [[nodiscard]] CurvePiece piece(std::size_t first, std::size_t last) const {
    CurvePiece result;
    for (std::size_t k = first; k <= last; ++k) {
      if (!moves(k)) result.held.push_back(k - first);
      result.nodes.push_back(nodes_[k]);
    }
    return result;
  }

  [[nodiscard]] std::vector<Vector3> beside(std::size_t k, bool on) const {
    const std::size_t count = nodes_.size();
    std::vector<Vector3> places;
    while (!moves(k) && places.size() < count) {
      places.push_back(places_[static_cast<std::size_t>(nodes_[k])]);
      if (!joins_ && k == (on ? count - 1 : 0)) break;
      k = (k + (on ? 1 : count - 1)) % count;
    }
    return places;
  }

  std::vector<Index> nodes_;
  bool joins_;
  const Constraints& constraints_;
  const std::vector<Vector3>& places_;
};

}  // namespace

std::vector<CurvePiece> moving_pieces(const PolygonCurve& curve, const Constraints& constraints,
                                      const std::vector<Vector3>& places) {
  std::vector<CurvePiece> pieces;
  for (const PolygonCurve::Chain& chain : curve.chains()) ChainCutting(chain, constraints, places).cut(pieces);
  return pieces;
}

}  // namespace vspring
