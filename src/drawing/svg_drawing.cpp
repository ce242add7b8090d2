#include "drawing/svg_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <iterator>

#include "base/dense_algebra.hpp"
#include "shape/arcs.hpp"

namespace vspring {
namespace {

/// The sense of a direction in which its largest component is positive.
Vector3 forward(const Vector3& direction) {
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  return direction[largest] < 0 ? -direction : direction;
}

/// A run of finite nodes. chain: all of a closed chain, or a part of one.
Drawing::Run run_of(const std::vector<Vector3>& nodes, bool closed, const CurveView& view) {
  Drawing::Run run;
  run.closed = closed;
  const std::size_t count = nodes.size();
  run.nodes.reserve(count);
  run.curvatures.reserve(count);
  for (std::size_t k = 0; k < count; ++k) {
    const bool inner = closed || (k > 0 && k + 1 < count);
    const Vector3& before = nodes[(k + count - 1) % count];
    const Vector3& after = nodes[(k + 1) % count];
    const Vector3 curvature = inner ? circle_curvature(before, nodes[k], after) : Vector3(Vector3::Zero());
    const bool right = view.normal().dot((after - before).cross(curvature)) < 0;
    if (k > 0) run.length += (nodes[k] - before).norm();
    run.nodes.push_back(view.flat(nodes[k]));
    run.curvatures.push_back(view.flat(curvature));
    run.arc.push_back(run.length);
    run.bends.push_back(right ? -curvature.norm() : curvature.norm());
  }
  if (closed) run.length += (nodes.front() - nodes.back()).norm();
  return run;
}

/// Adds a run's stretches. Nodes beyond the last continue a closed run from its beginning.
class Cutter {
 public:
  Cutter(const Drawing::Run& run, const Window& window, Drawing& part) : run_(run), window_(window), part_(part) {}

  void cut() {
    const auto outside = std::find_if(run_.nodes.begin(), run_.nodes.end(),
                                      [&](const Vector2& node) { return !window_.contains(node); });
    if (outside == run_.nodes.end()) {
      part_.runs.push_back(run_);
      return;
    }
    // A closed run is cut outside the window, so no stretch is divided.
    const auto count = run_.nodes.size();
    const auto first = run_.closed ? static_cast<std::size_t>(std::distance(run_.nodes.begin(), outside)) : 0;
    const std::size_t last = run_.closed ? first + count : count - 1;
    for (std::size_t k = first; k <= last; ++k) {
      const bool beside = (k > first && inside(k - 1)) || (k < last && inside(k + 1));
      if (inside(k) || beside)
        add(k);
      else
        stretch_ = false;
    }
  }

 private:
  [[nodiscard]] bool inside(std::size_t k) const { return window_.contains(run_.nodes[k % run_.nodes.size()]); }

  void add(std::size_t k) {
    if (!stretch_) {
      Drawing::Run& stretch = part_.runs.emplace_back();
      stretch.begin = run_.begin;
      stretch.length = run_.length;
      stretch_ = true;
    }
    Drawing::Run& stretch = part_.runs.back();
    const std::size_t node = k % run_.nodes.size();
    stretch.nodes.push_back(run_.nodes[node]);
    stretch.curvatures.push_back(run_.curvatures[node]);
    stretch.arc.push_back(run_.arc[node] + (k == node ? 0 : run_.length));
    stretch.bends.push_back(run_.bends[node]);
  }

  const Drawing::Run& run_;
  const Window& window_;
  Drawing& part_;
  bool stretch_ = false;
};

}  // namespace

CurveView::CurveView(const DrawnCurve& curve) {
  for (const Vector3& p : curve.positions) {
    if (p.allFinite()) size_ = std::max(size_, p.cwiseAbs().maxCoeff());
  }
  if (size_ == 0) size_ = 1;
  const auto for_each = [&](const auto& action) {
    for (const PolygonCurve::Chain& chain : curve.chains) {
      for (const Index node : chain.nodes) {
        const Vector3& position = curve.positions[static_cast<std::size_t>(node)];
        if (position.allFinite()) action(position / size_);
      }
    }
  };
  double count = 0;
  for_each([&](const Vector3& p) { centre_ += p, ++count; });
  if (count > 0) centre_ /= count;
  double extent = 0;
  for_each([&](const Vector3& p) { extent = std::max(extent, (p - centre_).cwiseAbs().maxCoeff()); });
  if (extent > 0) extent_ = extent;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for_each([&](const Vector3& p) { spread += (p - centre_) * (p - centre_).transpose() / (extent_ * extent_); });
  // A curve in a plane parallel to x and y, to rounding, is not turned.
  if (spread(2, 2) > 1e-24 * spread.trace()) turn(spread);
}

void CurveView::turn(const Eigen::Matrix3d& spread) {
  const Eigen::Matrix3d axes = principal_axes(spread);
  across_ = forward(axes.col(2));
  up_ = forward(axes.col(1));
}

Drawing drawing_of(const DrawnCurve& curve, const CurveView& view) {
  constexpr double level = 1e-9;  // more than rounding, less than visible
  Drawing drawing;
  for (const PolygonCurve::Chain& chain : curve.chains) {
    std::vector<Vector3> nodes;
    nodes.reserve(chain.nodes.size());
    bool whole = true;
    const auto end_run = [&] {
      if (!nodes.empty()) drawing.runs.push_back(run_of(nodes, chain.closed && whole, view));
      nodes.clear();
    };
    for (const Index node : chain.nodes) {
      const Vector3 position = view.normalized(curve.positions[static_cast<std::size_t>(node)]);
      if (position.allFinite()) {
        nodes.push_back(position);
        if (std::abs(view.normal().dot(position)) > level) drawing.planar = false;
      } else {
        whole = false;
        end_run();
      }
    }
    end_run();
  }
  double begin = 0;
  for (Drawing::Run& run : drawing.runs) {
    run.begin = begin;
    begin += run.length;
    for (const Vector2& curvature : run.curvatures) drawing.sharpest = std::max(drawing.sharpest, curvature.norm());
  }
  return drawing;
}

Drawing part_inside(const Drawing& drawing, const Window& window) {
  Drawing part;
  part.planar = drawing.planar;
  for (const Drawing::Run& run : drawing.runs) Cutter(run, window, part).cut();
  for (const Drawing::Run& run : part.runs) {
    for (std::size_t k = 0; k < run.nodes.size(); ++k) {
      if (window.contains(run.nodes[k])) part.sharpest = std::max(part.sharpest, run.curvatures[k].norm());
    }
  }
  return part;
}

}  // namespace vspring
