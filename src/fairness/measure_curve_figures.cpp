#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "fairness/curve_bending.hpp"
#include "fairness/curve_runs.hpp"
#include "fairness/extrema.hpp"
#include "fairness/normal_error.hpp"
#include "shape/frame.hpp"
#include "vspring/figures.hpp"

namespace vspring {

namespace {

/// In a frame of size 1; lengths go back to units of the input at the end.
class CurveMeasurement {
 public:
  CurveMeasurement(const PolygonCurve& curve, const Constraints* constraints) {
    const std::vector<CurveRun> runs = curve_runs(curve, constraints);
    for (const CurveRun& run : runs) {
      for (const Index i : run.nodes) box_.extend(curve.position(i));
    }
    frame_ = Frame(box_);
    for (const CurveRun& run : runs) {
      closed_.push_back(run.closed);
      figures_.zero_length_edges += run.zero_length_edges;
      std::vector<Vector3>& positions = positions_.emplace_back();
      positions.reserve(run.nodes.size());
      for (const Index i : run.nodes) positions.push_back(frame_.to_local(curve.position(i)));
    }
  }

  CurveFigures measure() {
    if (box_.isEmpty()) return figures_;
    measure_edges();
    measure_bending();
    figures_.length = length_ / frame_.scale();
    figures_.diagonal = (frame_.to_local(box_.max()) - frame_.to_local(box_.min())).norm() / frame_.scale();
    return figures_;
  }

 private:
  void measure_edges() {
    double shortest = std::numeric_limits<double>::infinity();
    double longest = 0;
    for (std::size_t r = 0; r < positions_.size(); ++r) {
      const auto& positions = positions_[r];
      const std::size_t count = positions.size();
      if (count < 2) continue;
      const auto edge = [&](std::size_t k) { return (positions[(k + 1) % count] - positions[k % count]).norm(); };
      const std::size_t edges = closed_[r] ? count : count - 1;
      for (std::size_t k = 0; k < edges; ++k) {
        length_ += edge(k);
        shortest = std::min(shortest, edge(k));
        longest = std::max(longest, edge(k));
        if (k + 1 == edges && !closed_[r]) continue;
        const double ratio = edge(k) / edge(k + 1);
        figures_.neighbouring_edge_spread = std::max({figures_.neighbouring_edge_spread, ratio, 1 / ratio});
      }
    }
    if (longest > 0) figures_.edge_spread = longest / shortest;
  }

  void measure_bending() {
    if (!(length_ > 0)) return;
    const double least_visible = visible_curvature / length_;
    double squares = 0;
    double rates = 0;
    double greatest = 0;
    std::vector<CurveBending> bent;
    bent.reserve(positions_.size());
    for (std::size_t r = 0; r < positions_.size(); ++r) {
      bent.push_back(curve_bending(positions_[r], closed_[r], least_visible));
      squares += bent[r].squares;
      rates += bent[r].rates;
      for (const double curvature : bent[r].signed_curvature) greatest = std::max(greatest, std::abs(curvature));
    }
    figures_.bending_energy = length_ * squares;
    figures_.curvature_variation = length_ * length_ * length_ * rates;
    figures_.greatest_curvature = length_ * greatest;
    const double visible = std::max(visible_share * std::sqrt(squares / length_), least_visible);
    for (std::size_t r = 0; r < positions_.size(); ++r) {
      figures_.curvature_extrema += count_extrema(bent[r].signed_curvature, closed_[r], visible);
      figures_.inflections += count_sign_changes(bent[r].signed_curvature, closed_[r], visible);
    }
  }

  Eigen::AlignedBox<double, 3> box_;
  Frame frame_;
  std::vector<std::vector<Vector3>> positions_;  // of each run
  std::vector<bool> closed_;
  double length_ = 0;
  CurveFigures figures_;
};

}  // namespace

CurveFigures measure_curve(const PolygonCurve& curve, const Constraints* constraints) {
  CurveFigures figures = CurveMeasurement(curve, constraints).measure();
  static_cast<Fairness&>(figures) = measure(curve, constraints);
  if (constraints != nullptr) figures.normal_error = normal_error(curve, *constraints);
  return figures;
}

}  // namespace vspring
