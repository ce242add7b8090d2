#include "curve_fit/scattered_way.hpp"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "curve_fit/curve_lengths.hpp"

namespace vspring {

namespace {

/// The way along one chain.
class ChainWay {
  struct Known {
    double length = 0;  // along the chain
    Vector3 offset = Vector3::Zero();
    CurvePoint row;
  };

 public:
  ChainWay(const DenseCurve& curve, const DenseCurve::Chain& chain, std::span<const double> length, double gap)
      : curve_(curve), chain_(chain), gap_(gap), length_(length) {
    for (std::uint32_t k = 0; k < chain.count; ++k) {
      const std::uint32_t i = chain.begin + k;
      if (curve.node(i).held) known_.push_back({length_[k], Vector3::Zero(), {curve.place(i), 0, place_of(i)}});
    }
  }

  void add(const CurvePoint& point) {
    const std::uint32_t k = point.at.edge - chain_.begin;
    CurvePoint row = point;
    row.number = -1;
    row.bound = 0;
    known_.push_back({length_[k] + point.at.share * (length_[k + 1] - length_[k]),
                      curve_.moving().cwiseProduct(point.place - curve_.at(point.at)), row});
  }

  void add_to(std::vector<CurvePoint>& way) {
    if (known_.empty()) return;
    std::stable_sort(known_.begin(), known_.end(), [](const Known& a, const Known& b) { return a.length < b.length; });
    const double whole = length_.back();
    if (chain_.closed) {
      // Across the seam: first the part after it.
      Known last = known_.back();
      last.length -= whole;
      add_between(last, known_.front(), way);
    } else {
      if (known_.front().length > gap_) known_.insert(known_.begin(), moved(chain_.begin, 0, known_.front().offset));
      if (whole - known_.back().length > gap_)
        known_.push_back(moved(chain_.begin + chain_.count - 1, whole, known_.back().offset));
    }
    for (std::size_t k = 0; k < known_.size(); ++k) {
      way.push_back(known_[k].row);
      if (k + 1 < known_.size()) add_between(known_[k], known_[k + 1], way);
    }
    if (!chain_.closed) return;
    Known first = known_.front();
    first.length += whole;
    add_between(known_.back(), first, way);
  }

 private:
  [[nodiscard]] CurvePlace place_of(std::uint32_t node) const {
    return curve_.is_edge(node) ? CurvePlace{node, 0} : CurvePlace{curve_.before(node), 1};
  }

  [[nodiscard]] Known moved(std::uint32_t node, double length, const Vector3& offset) const {
    return {length, offset, {curve_.place(node) + offset, 0, place_of(node)}};
  }

  /// Adds the chain's own nodes between two known ones.
  void add_between(const Known& from, const Known& to, std::vector<CurvePoint>& way) const {
    double last = from.length;
    for (auto at = std::upper_bound(length_.begin(), length_.end() - 1, from.length);
         at != length_.end() - 1 && *at < to.length; ++at) {
      if (*at - last <= gap_ || to.length - *at <= gap_) continue;
      last = *at;
      const double share = (*at - from.length) / (to.length - from.length);
      way.push_back(moved(chain_.begin + static_cast<std::uint32_t>(at - length_.begin()), *at,
                          from.offset + share * (to.offset - from.offset))
                        .row);
    }
  }

  const DenseCurve& curve_;
  DenseCurve::Chain chain_;
  double gap_;
  std::span<const double> length_;  // up to each node
  std::vector<Known> known_;
};

}  // namespace

std::vector<CurvePoint> way_of_scattered(const DenseCurve& curve, std::span<const CurvePoint> points, double gap) {
  const CurveLengths lengths(curve);
  std::vector<ChainWay> ways;
  for (const DenseCurve::Chain& chain : curve.chains()) ways.emplace_back(curve, chain, lengths.of(ways.size()), gap);
  for (const CurvePoint& point : points) ways[curve.chain_of(point.at.edge)].add(point);
  std::vector<CurvePoint> way;
  for (ChainWay& one : ways) one.add_to(way);
  return way;
}

}  // namespace vspring
