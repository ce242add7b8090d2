#include "io/curve_drawing.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>

namespace vspring {
namespace {

/// Of the two senses of a direction the one whose largest component is positive.
Vector3 forward(const Vector3& direction) {
  Eigen::Index largest = 0;
  direction.cwiseAbs().maxCoeff(&largest);
  return direction[largest] < 0 ? -direction : direction;
}

/// Towards the centre of the circle through three points, seen from the second, and as long as its curvature.
Vector3 curvature_at(const Vector3& before, const Vector3& here, const Vector3& after) {
  const Vector3 back = before - here;
  const Vector3 forth = after - here;
  if (back.squaredNorm() == 0 || forth.squaredNorm() == 0) return Vector3::Zero();
  // Inversion makes the circle a line, half its curvature away.
  const Vector3 p = back / back.squaredNorm();
  const Vector3 along = forth / forth.squaredNorm() - p;
  if (along.squaredNorm() == 0) return Vector3::Zero();
  const Vector3 curvature = 2 * (p - along * (p.dot(along) / along.squaredNorm()));
  return curvature.allFinite() ? curvature : Vector3::Zero();
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
    run.nodes.push_back(view.flat(nodes[k]));
    run.curvatures.push_back(
        inner ? view.flat(curvature_at(nodes[(k + count - 1) % count], nodes[k], nodes[(k + 1) % count]))
              : Vector2(Vector2::Zero()));
  }
  return run;
}

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
  // What lies in a plane of x and y, but for rounding, is drawn as it lies.
  if (spread(2, 2) > 1e-24 * spread.trace()) turn(spread);
}

void CurveView::turn(const Eigen::Matrix3d& spread) {
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread);
  across_ = forward(solver.eigenvectors().col(2));
  up_ = forward(solver.eigenvectors().col(1));
}

Drawing drawing_of(const DrawnCurve& curve, const CurveView& view) {
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
      } else {
        whole = false;
        end_run();
      }
    }
    end_run();
  }
  for (const Drawing::Run& run : drawing.runs) {
    for (const Vector2& curvature : run.curvatures) drawing.sharpest = std::max(drawing.sharpest, curvature.norm());
  }
  return drawing;
}

}  // namespace vspring
