#include "join/curvature_arc.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstddef>

namespace vspring {

namespace {

// In radians: with it a step is exact to about 1e-10 of its length.
constexpr double turn_of_step = 0.1;
constexpr int fewest_steps = 8;
// Below it the terms left out are rounding.
constexpr double small_angle = 1e-2;

/// The place after going by `along` and turning by `turn` evenly, both in the frame of the start.
CurvePose screwed(const CurvePose& from, const Vector3& turn, const Vector3& along) {
  const double angle2 = turn.squaredNorm();
  const double angle = std::sqrt(angle2);
  const bool is_small = angle < small_angle;
  const double once = is_small ? 1.0 / 2 - angle2 / 24 : (1 - std::cos(angle)) / angle2;
  const double twice = is_small ? 1.0 / 6 - angle2 / 120 : (angle - std::sin(angle)) / (angle2 * angle);
  const Vector3 across = turn.cross(along);
  CurvePose to = from;
  to.place += from.axes * (along + once * across + twice * turn.cross(across));
  if (angle > 0) to.axes = from.axes * Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix();
  return to;
}

/// Turns the frame to a tangent without spin; returns by what, towards both normals.
Eigen::Vector2d turn_to(CurvePose& pose, const Vector3& tangent) {
  const Vector3 sideways = tangent - tangent.dot(pose.tangent()) * pose.tangent();
  const double sine = sideways.norm();
  if (!(sine > 0)) return Eigen::Vector2d::Zero();
  const double angle = std::atan2(sine, tangent.dot(pose.tangent()));
  Eigen::Vector2d turn = angle / sine * (pose.normals().transpose() * sideways);
  const Vector3 axis = pose.tangent().cross(sideways) / sine;
  pose.axes = Eigen::AngleAxisd(angle, axis).toRotationMatrix() * pose.axes;
  return turn;
}

}  // namespace

int CurvatureArc::steps() const {
  const double most = turns.colwise().norm().sum();
  return fewest_steps + static_cast<int>(std::min(most / turn_of_step, 1e6));
}

/// By what the frame turns per share of the length, in itself.
Vector3 CurvatureArc::spin(double u) const {
  const Eigen::Vector2d turn = turns.col(0) + u * (turns.col(1) + u * (turns.col(2) + u * turns.col(3)));
  return {0, -turn[1], turn[0]};
}

/// Magnus' series to fourth order, for places and frames together: exact on circles. A. Iserles, H. Z. Munthe-Kaas, S.
/// P. Nørsett, A. Zanna, "Lie-group methods", Acta Numerica 9, 2000.
CurvePose CurvatureArc::stepped(const CurvePose& from, double u, double step) const {
  const double off = step / std::sqrt(12.0);
  const Vector3 before = spin(u + step / 2 - off);
  const Vector3 after = spin(u + step / 2 + off);
  const Vector3 along(length, 0, 0);
  const double commuted = step * off / 2;
  return screwed(from, step / 2 * (before + after) + commuted * before.cross(after),
                 step * along + commuted * (before - after).cross(along));
}

/// The integrals by Simpson's rule.
CurvatureArc::Place CurvatureArc::advanced(const Place& from, double u, double step) const {
  Place to = from;
  const auto add = [&](const CurvePose& pose, double at, double weight) {
    const Vector3 way = pose.place - start.place;
    double power = weight * step / 6;
    for (Eigen::Index column = 0; column < to.turned.cols(); column += 2, power *= at) {
      const Vector3 first = power * pose.axes.col(2);
      const Vector3 second = -power * pose.axes.col(1);
      to.turned.col(column) += first;
      to.turned.col(column + 1) += second;
      to.lever.col(column) += first.cross(way);
      to.lever.col(column + 1) += second.cross(way);
    }
  };
  to.pose = stepped(from.pose, u, step);
  add(from.pose, u, 1);
  add(stepped(from.pose, u, step / 2), u + step / 2, 4);
  add(to.pose, u + step, 1);
  return to;
}

std::vector<CurvatureArc::Place> CurvatureArc::walk(int steps) const {
  std::vector<Place> places(1);
  places[0].pose = start;
  places.reserve(static_cast<std::size_t>(steps) + 1);
  for (int k = 0; k < steps; ++k)
    places.push_back(advanced(places.back(), static_cast<double>(k) / steps, 1.0 / steps));
  return places;
}

CurvatureArc::Place CurvatureArc::at(double u, const std::vector<Place>& walked) const {
  const auto steps = static_cast<double>(walked.size() - 1);
  const double step = std::clamp(std::floor(u * steps), 0.0, steps - 1);
  return advanced(walked[static_cast<std::size_t>(step)], step / steps, u - step / steps);
}

Vector3 tangent_at_first(const Vector3& first, const Vector3& next, const Vector3& last) {
  // The inversion about the first takes the circle to a line along its tangent.
  const Vector3 here = next - first;
  const Vector3 there = last - first;
  return (here / here.squaredNorm() - there / there.squaredNorm()).normalized();
}

CurvatureArc linear_arc_near(std::span<const Vector3> nodes, const std::optional<Vector3>& plane) {
  CurvatureArc arc;
  const std::size_t last = nodes.size() - 1;
  const Vector3 tangent = tangent_at_first(nodes[0], nodes[1], nodes[2]);
  arc.start.place = nodes[0];
  arc.start.axes.col(0) = tangent;
  arc.start.axes.col(2) =
      plane ? Vector3((*plane - plane->dot(tangent) * tangent).normalized()) : Vector3(tangent.unitOrthogonal());
  arc.start.axes.col(1) = arc.start.normals().col(1).cross(tangent);
  CurvePose pose = arc.start;
  Eigen::Vector2d whole = Eigen::Vector2d::Zero();
  Eigen::Vector2d moment = Eigen::Vector2d::Zero();
  const auto turn = [&](const Vector3& to) {
    const Eigen::Vector2d by = turn_to(pose, to);
    whole += by;
    moment += arc.length * by;
  };
  for (std::size_t k = 0; k < last; ++k) {
    const Vector3 edge = nodes[k + 1] - nodes[k];
    turn(edge.normalized());
    arc.length += edge.norm();
  }
  turn(-tangent_at_first(nodes[last], nodes[last - 1], nodes[last - 2]));
  const Eigen::Vector2d slope = 12 * (moment / arc.length - whole / 2);
  arc.turns.col(0) = whole - slope / 2;
  arc.turns.col(1) = slope;
  return arc;
}

}  // namespace vspring
