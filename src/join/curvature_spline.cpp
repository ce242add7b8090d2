#include "join/curvature_spline.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "base/cancellation.hpp"
#include "linear/lu_factor.hpp"

namespace vspring {

namespace {

constexpr int most_newton_steps = 40;
constexpr int most_times_halved = 10;
// Newton's next step would be its square.
constexpr double small_step = 1e-8;
// Of an arc: the turn of its start about both normals, its turns, and the logarithm of its length.
constexpr int turn_unknowns = 2 * (CurvatureArc::degree + 1);
constexpr int unknowns = 2 + turn_unknowns + 1;
// Derivatives of the curvature from 0 up to the degree.
constexpr int orders = CurvatureArc::degree + 1;

using OfUnknowns = Eigen::Matrix<double, 3, unknowns>;

/// A vector, and how it follows the unknowns of an arc.
struct Followed {
  Vector3 value = Vector3::Zero();
  OfUnknowns by = OfUnknowns::Zero();
};

/// One end of an arc.
struct ArcEnd {
  Eigen::Index arc = 0;
  CurvePose pose;
  Followed place;
  Followed tangent;
  std::array<Followed, orders> curvature;  ///< and its derivatives, each in a unit of length
};

/// The factor of u^j in the derivative of the power `power`.
double falling(int power, int order) {
  double product = 1;
  for (int k = 0; k < order; ++k) product *= power - k;
  return product;
}

/// unit: of length. at: 0 or 1.
ArcEnd end_of(const CurvatureArc& arc, Eigen::Index number, const CurvatureArc::Place& here, int at, double unit) {
  ArcEnd end;
  end.arc = number;
  end.pose = here.pose;
  OfUnknowns turned = OfUnknowns::Zero();
  turned.leftCols<2>() = arc.start.normals();
  turned.middleCols<turn_unknowns>(2) = here.turned;
  const Vector3 way = here.pose.place - arc.start.place;
  end.place.value = here.pose.place / unit;
  end.place.by.leftCols<2>() = arc.start.normals().colwise().cross(way);
  end.place.by.middleCols<turn_unknowns>(2) = here.moved(arc.start.place);
  end.place.by.rightCols<1>() = way;
  end.place.by /= unit;
  end.tangent = {here.pose.tangent(), turned.colwise().cross(here.pose.tangent())};
  for (int order = 0; order < orders; ++order) {
    const double scale = std::pow(unit / arc.length, order + 1);
    Followed& derivative = end.curvature[static_cast<std::size_t>(order)];
    Eigen::Vector2d turn = Eigen::Vector2d::Zero();
    for (int power = order; power < orders; ++power) {
      if (power > order && at == 0) break;
      const double factor = falling(power, order) * scale;
      turn += factor * arc.turns.col(power);
      derivative.by.middleCols<2>(2 + 2 * power) = factor * here.pose.normals();
    }
    derivative.value = here.pose.normals() * turn;
    derivative.by += turned.colwise().cross(derivative.value);
    derivative.by.rightCols<1>() -= (order + 1) * derivative.value;
  }
  return end;
}

class SplineEquations {
 public:
  SplineEquations(const std::vector<CurveJoint>& joints, bool closed, const std::vector<CurvatureArc>& arcs)
      : joints_(joints), closed_(closed) {
    // A row keeps its scale, so that steps can be compared.
    for (const CurvatureArc& arc : arcs) units_.push_back(arc.length);
    const auto size = static_cast<Eigen::Index>(arcs.size()) * unknowns;
    matrix_.resize(size, size);
    left_.resize(size);
  }

  /// What is left of the equations, which are met where it is zero.
  const Eigen::VectorXd& left(const std::vector<CurvatureArc>& arcs) {
    entries_.clear();
    row_ = 0;
    std::vector<ArcEnd> starts;
    std::vector<ArcEnd> ends;
    for (std::size_t k = 0; k < arcs.size(); ++k) {
      end_if_cancelled();
      const auto number = static_cast<Eigen::Index>(k);
      CurvatureArc::Place start;
      start.pose = arcs[k].start;
      // The joint after an arc measures in its unit.
      const std::size_t before = k > 0 ? k - 1 : closed_ ? arcs.size() - 1 : 0;
      starts.push_back(end_of(arcs[k], number, start, 0, units_[before]));
      ends.push_back(end_of(arcs[k], number, arcs[k].walk(arcs[k].steps()).back(), 1, units_[k]));
    }
    if (!closed_) add_end(joints_.front(), starts.front(), joints_.back().curvature.has_value());
    for (std::size_t k = 0; k < arcs.size(); ++k) {
      const std::size_t next = k + 1 < arcs.size() ? k + 1 : 0;
      const CurveJoint& joint = joints_[(k + 1) % joints_.size()];
      for (int axis = 0; axis < 3; ++axis)
        add(ends[k].arc, ends[k].place, Vector3::Unit(axis), joint.place / units_[k]);
      if (next > 0 || closed_)
        add_joint(joint, ends[k], starts[next]);
      else
        add_end(joint, ends[k], joints_.front().curvature.has_value());
    }
    return left_;
  }

  /// The step to where the equations would be met, were they linear; none if there are many.
  [[nodiscard]] std::optional<Eigen::VectorXd> step() {
    matrix_.setFromTriplets(entries_.begin(), entries_.end());
    factor_.analyzePattern(matrix_);
    factor_.factorize(matrix_);
    if (factor_.info() != Eigen::Success) return std::nullopt;
    Eigen::VectorXd step = -factor_.solve(left_);
    if (!step.allFinite()) return std::nullopt;
    return step;
  }

 private:
  /// The next row: the part along an axis is to be that of a vector.
  void add(Eigen::Index arc, const Followed& followed, const Vector3& axis, const Vector3& wanted) {
    put(arc, followed.by.transpose() * axis);
    left_[row_++] = axis.dot(followed.value - wanted);
  }
  /// The next row: the part along an axis is to be the same.
  void add_same(const ArcEnd& end, const Followed& of_end, const ArcEnd& start, const Followed& of_start,
                const Vector3& axis) {
    put(end.arc, of_end.by.transpose() * axis);
    put(start.arc, -of_start.by.transpose() * axis);
    left_[row_++] = axis.dot(of_end.value - of_start.value);
  }
  void put(Eigen::Index arc, const Eigen::Matrix<double, unknowns, 1>& row) {
    for (int k = 0; k < unknowns; ++k) {
      if (row[k] != 0) entries_.emplace_back(static_cast<int>(row_), static_cast<int>(arc) * unknowns + k, row[k]);
    }
  }

  struct Axis {
    Vector3 along;
    bool held;  ///< whether the tangent along it is given
  };
  /// Two axes across the curve.
  static std::array<Axis, 2> axes_at(const CurveJoint& joint, const CurvePose& pose) {
    const bool held = joint.tangent.has_value();
    if (held || !joint.normal) return {{{pose.axes.col(1), held}, {pose.axes.col(2), held}}};
    return {{{*joint.normal, true}, {joint.normal->cross(pose.tangent()).normalized(), false}}};
  }

  void add_end(const CurveJoint& joint, const ArcEnd& end, bool other_has_curvature) {
    const Vector3 none = Vector3::Zero();
    for (const Axis& axis : axes_at(joint, end.pose)) {
      if (axis.held) {
        add(end.arc, end.tangent, axis.along, joint.tangent.value_or(none));
        if (joint.curvature)
          add(end.arc, end.curvature[0], axis.along, *joint.curvature * unit_at(end));
        else
          add(end.arc, end.curvature[other_has_curvature ? 3 : 2], axis.along, none);
      } else {
        add(end.arc, end.curvature[0], axis.along, none);
        add(end.arc, end.curvature[2], axis.along, none);
      }
    }
  }

  void add_joint(const CurveJoint& joint, const ArcEnd& end, const ArcEnd& start) {
    for (const Axis& axis : axes_at(joint, start.pose)) {
      add_same(end, end.tangent, start, start.tangent, axis.along);
      for (const std::size_t order : {0, 1})
        add_same(end, end.curvature[order], start, start.curvature[order], axis.along);
      if (axis.held)
        add(start.arc, start.tangent, axis.along, joint.tangent.value_or(Vector3::Zero()));
      else
        add_same(end, end.curvature[2], start, start.curvature[2], axis.along);
    }
  }

  [[nodiscard]] double unit_at(const ArcEnd& end) const { return units_[static_cast<std::size_t>(end.arc)]; }

  const std::vector<CurveJoint>& joints_;
  bool closed_;
  std::vector<double> units_;
  Eigen::SparseMatrix<double> matrix_;
  Eigen::VectorXd left_;
  std::vector<Eigen::Triplet<double>> entries_;
  Eigen::Index row_ = 0;
  LuFactor factor_;
};

std::vector<CurvatureArc> moved(std::vector<CurvatureArc> arcs, const Eigen::VectorXd& step, double share) {
  for (std::size_t k = 0; k < arcs.size(); ++k) {
    CurvatureArc& arc = arcs[k];
    const auto own = share * step.segment<unknowns>(static_cast<Eigen::Index>(k) * unknowns);
    const Vector3 turn = arc.start.normals() * own.head<2>();
    const double angle = turn.norm();
    if (angle > 0) arc.start.axes = Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() * arc.start.axes;
    for (int j = 0; j < turn_unknowns; ++j) arc.turns(j % 2, j / 2) += own[2 + j];
    arc.length *= std::exp(own[unknowns - 1]);
  }
  return arcs;
}

}  // namespace

std::optional<CurvatureSpline> curvature_spline(const std::vector<CurveJoint>& joints, bool closed,
                                                std::vector<CurvatureArc> start) {
  CurvatureSpline found;
  found.arcs = std::move(start);
  SplineEquations equations(joints, closed, found.arcs);
  double left = equations.left(found.arcs).norm();
  for (; found.steps < most_newton_steps; ++found.steps) {
    const std::optional<Eigen::VectorXd> step = equations.step();
    if (!step) return std::nullopt;
    found.last_step = step->cwiseAbs().maxCoeff();
    const bool is_last = found.last_step < small_step;
    double share = 1;
    for (int halving = 0;; ++halving, share /= 2) {
      if (halving == most_times_halved) return std::nullopt;
      std::vector<CurvatureArc> next = moved(found.arcs, *step, share);
      const double left_there = equations.left(next).norm();
      if (!(left_there < left) && !is_last) continue;
      found.arcs = std::move(next);
      left = left_there;
      break;
    }
    if (is_last) return found;
  }
  return std::nullopt;
}

}  // namespace vspring
