#include "curve_fit/curve_lengths.hpp"

#include <algorithm>

namespace vspring {

CurveLengths::CurveLengths(const DenseCurve& curve) : curve_(curve) {
  for (const auto& chain : curve.chains()) {
    std::vector<double>& sum = sums_.emplace_back(chain.count + 1, 0);
    for (std::uint32_t k = 0; k < chain.count; ++k) {
      const std::uint32_t i = chain.begin + k;
      sum[k + 1] = sum[k] + (curve.is_edge(i) ? curve.edge_length(i) : 0);
    }
  }
}

double CurveLengths::at(const CurvePlace& place) const {
  const std::size_t chain = curve_.chain_of(place.edge);
  const std::uint32_t k = place.edge - curve_.chains()[chain].begin;
  return sums_[chain][k] + place.share * (sums_[chain][k + 1] - sums_[chain][k]);
}

CurvePlace CurveLengths::place(std::size_t chain, double length) const {
  const auto& [begin, count, closed] = curve_.chains()[chain];
  const std::vector<double>& sum = sums_[chain];
  const std::uint32_t edges = count - (closed ? 0 : 1);
  const auto above = std::upper_bound(sum.begin(), sum.begin() + edges, length);
  const auto k = static_cast<std::uint32_t>(std::clamp<std::ptrdiff_t>(above - sum.begin() - 1, 0, edges - 1));
  const double edge = sum[k + 1] - sum[k];
  return {begin + k, edge > 0 ? std::clamp((length - sum[k]) / edge, 0.0, 1.0) : 0};
}

double length_of(const DenseCurve& curve) {
  double length = 0;
  for (std::uint32_t i = 0; i < curve.size(); ++i) length += curve.is_edge(i) ? curve.edge_length(i) : 0;
  return length;
}

}  // namespace vspring
