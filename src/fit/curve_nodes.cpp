#include "fit/curve_nodes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "curve_fit/curve_lengths.hpp"
#include "curve_fit/node_spacing.hpp"

namespace vspring {

namespace {

// The least distance of nodes, as a share of the mean edge.
constexpr double least_edge = 1e-4;
// The cosine of 45°, for the turn within a spacing.
constexpr double cosine_of_tight_bend = 0.7;

class NodePlaces {
 public:
  NodePlaces(const PolygonCurve& file, const CurveFound& found, NodePlacing how, std::vector<Vector3>& places)
      : file_(file), found_(found), lengths_(found.curve), how_(how), input_(places), places_(places) {}

  void place_chain(std::size_t c) {
    const auto& nodes = file_.chains()[c].nodes;
    const bool closed = file_.chains()[c].closed;
    const auto& chain = found_.curve.chains()[c];
    const double whole = lengths_.whole(c);
    const double unknown = std::numeric_limits<double>::quiet_NaN();
    // Where each node wants to be; and whether it is one of the dense curve's own.
    std::vector<double> wanted(nodes.size(), unknown);
    std::vector<std::uint8_t> stays(nodes.size(), 0);
    std::vector<std::ptrdiff_t> order_of(places_.size(), -1);
    for (std::size_t k = 0; k < nodes.size(); ++k)
      order_of[static_cast<std::size_t>(nodes[k])] = static_cast<std::ptrdiff_t>(k);
    for (const CurvePoint& point : found_.points) {
      if (!how_.own_points || how_.even) break;
      if (point.at.edge < chain.begin || point.at.edge >= chain.begin + chain.count) continue;
      const std::ptrdiff_t k = order_of[static_cast<std::size_t>(point.number)];
      if (k < 0) continue;
      wanted[static_cast<std::size_t>(k)] = lengths_.at(point.at);
    }
    for (std::uint32_t e = 0; e < chain.count; ++e) {
      const Index from = found_.curve.node(chain.begin + e).from;
      if (from < 0) continue;
      const auto k = static_cast<std::size_t>(order_of[static_cast<std::size_t>(from)]);
      wanted[k] = lengths_.of(c)[e];
      stays[k] = 1;
    }
    // Free ends are where the curve ends.
    for (const std::size_t k : {std::size_t{0}, nodes.size() - 1}) {
      if (closed || stays[k] != 0) continue;
      wanted[k] = k == 0 ? 0 : whole;
      stays[k] = 1;
    }
    // Runs from one node that stays to the next; a closed chain without any is one run, from the first node with a
    // wanted place.
    auto first = static_cast<std::size_t>(std::find(stays.begin(), stays.end(), 1) - stays.begin());
    if (first == nodes.size()) {
      const auto wants = std::find_if(wanted.begin(), wanted.end(), [](double at) { return !std::isnan(at); });
      first = wants == wanted.end() ? 0 : static_cast<std::size_t>(wants - wanted.begin());
      if (wants == wanted.end()) wanted[first] = 0;
      stays[first] = 1;
    }
    const double apart = least_edge * whole / static_cast<double>(nodes.size());
    const auto put = [&](std::size_t k, double at) {
      if (closed) at -= whole * std::floor(at / whole);
      places_[static_cast<std::size_t>(nodes[k])] = found_.curve.at(lengths_.place(c, at));
    };
    std::vector<std::size_t> run;
    double begin = 0;
    const auto place_run = [&](double end) {
      if (run.empty()) return;
      // On a closed chain the place beside its first node may be one whole length away.
      double last = begin;
      for (const std::size_t k : run) {
        if (!closed || std::isnan(wanted[k])) continue;
        wanted[k] += whole * std::round((last - wanted[k]) / whole);
        last = wanted[k];
      }
      const std::vector<double> at = places_between(nodes, run, wanted, begin, end, apart);
      for (std::size_t n = 0; n < run.size(); ++n) put(run[n], at[n]);
      run.clear();
    };
    bool started = false;
    for (std::size_t n = 0; n < nodes.size(); ++n) {
      const std::size_t k = (first + n) % nodes.size();
      if (stays[k] == 0) {
        run.push_back(k);
        continue;
      }
      double here = wanted[k];
      if (closed && started && here <= begin) here += whole;
      if (started || !closed) place_run(here);
      put(k, here);
      begin = here;
      started = true;
    }
    place_run(closed ? wanted[first] + whole : whole);
  }

  /// Of nodes in a run between two lengths; those without a wanted place keep their shares of the input's way.
  [[nodiscard]] std::vector<double> places_between(const std::vector<Index>& nodes, const std::vector<std::size_t>& run,
                                                   const std::vector<double>& wanted, double begin, double end,
                                                   double apart) const {
    std::vector<double> at(run.size());
    for (std::size_t n = 0; n < run.size(); ++n) at[n] = wanted[run[n]];
    fill(at, begin, end, nodes, run);
    set_in_order(at, apart, begin, end);
    return at;
  }

  /// Unknown lengths are filled in evenly, or by the edges of the input where the distribution is kept.
  void fill(std::vector<double>& at, double begin, double end, const std::vector<Index>& nodes,
            const std::vector<std::size_t>& run) const {
    // The length in the input from the node before the n-th one of the run to that one.
    const auto edge = [&](std::size_t n) {
      if (how_.even) return 1.0;
      const std::size_t count = nodes.size();
      const std::size_t from = n > 0 ? run[n - 1] : (run.front() + count - 1) % count;
      const std::size_t to = n < run.size() ? run[n] : (run.back() + 1) % count;
      const Vector3 step = input_[static_cast<std::size_t>(nodes[to])] - input_[static_cast<std::size_t>(nodes[from])];
      return std::max(step.norm(), 1e-300);
    };
    for (std::size_t n = 0; n < at.size();) {
      if (!std::isnan(at[n])) {
        ++n;
        continue;
      }
      std::size_t last = n;
      while (last < at.size() && std::isnan(at[last])) ++last;
      const double from = n > 0 ? at[n - 1] : begin;
      const double to = last < at.size() ? at[last] : end;
      double sum = 0;
      for (std::size_t k = n; k <= last; ++k) sum += edge(k);
      double passed = 0;
      for (std::size_t k = n; k < last; ++k) {
        passed += edge(k);
        at[k] = from + (to - from) * passed / sum;
      }
      n = last;
    }
  }

  const PolygonCurve& file_;
  const CurveFound& found_;
  CurveLengths lengths_;
  NodePlacing how_;
  const std::vector<Vector3> input_;
  std::vector<Vector3>& places_;
};

}  // namespace

void place_nodes(const PolygonCurve& file, const CurveFound& found, NodePlacing how, std::vector<Vector3>& places) {
  NodePlaces nodes(file, found, how, places);
  for (std::size_t c = 0; c < file.chains().size(); ++c) nodes.place_chain(c);
}

std::vector<Index> tight_bends(const DenseCurve& curve, const Resampling& how, double unit) {
  const double spacing = how.spacing ? *how.spacing / unit : length_of(curve) / static_cast<double>(*how.nodes);
  std::vector<Index> bends;
  for (const auto& chain : curve.chains()) {
    double since = std::numeric_limits<double>::infinity();
    for (std::uint32_t k = 0; k < chain.count; ++k) {
      const std::uint32_t i = chain.begin + k;
      if (k > 0) since += curve.edge_length(i - 1);
      if (!curve.is_smooth(i) || curve.node(i).held || since < spacing) continue;
      const double bent = curve.bend(i, true).curvature.norm();
      // Half a spacing to either side.
      std::uint32_t first = i;
      std::uint32_t last = i;
      bool most = true;
      for (double way = 0; curve.before(first) != DenseCurve::none && way < spacing / 2;) {
        first = curve.before(first);
        way += curve.edge_length(first);
        most = most && !(curve.bend(first, true).curvature.norm() > bent);
      }
      for (double way = 0; curve.is_edge(last) && way < spacing / 2;) {
        way += curve.edge_length(last);
        last = curve.next(last);
        most = most && !(curve.bend(last, false).curvature.norm() > bent);
      }
      if (!most || !(curve.bend(first, true).tangent.dot(curve.bend(last, false).tangent) < cosine_of_tight_bend))
        continue;
      bends.push_back(static_cast<Index>(i));
      since = 0;
    }
  }
  return bends;
}

}  // namespace vspring
