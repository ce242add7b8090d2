#include "spring/sliding.hpp"

#include <Eigen/Geometry>
#include <algorithm>

namespace vspring {

namespace {

// Squared sine of the angle between surface and support: below, nodes go less far than asked.
constexpr double least_square = 0.01;

Vector3 on_support(const NetProblem& net, std::size_t i, const Vector3& place) {
  return net.supports[i]->nearest(place).value_or(place);
}

}  // namespace

Vector3 along_support(const Net& net, std::size_t i, const Vector3& displacement) {
  const Support& support = *net.supports[i];
  const Vector3& normal = net.normals[i];
  const Vector3 axis = support.axis(net.positions[i]);
  const Vector3 of_axis = normal.dot(axis) * axis;
  const Vector3 ahead = support.is_curve() ? of_axis : Vector3(normal - of_axis);
  const double square = std::max(ahead.squaredNorm(), least_square);
  const Vector3 aside = way_along(net, i, net.positions[i], normal);
  return displacement.dot(normal) / square * ahead + displacement.dot(aside) / square * aside;
}

void put_at(Net& net, std::size_t i, const Vector3& place) {
  net.positions[i] = net.slides(i) ? on_support(net, i, place) : place;
}

void put_on_supports(const NetProblem& net, std::span<Vector3> places) {
  for (std::size_t i = 0; i < net.supports.size(); ++i) {
    if (net.slides(i)) places[i] = on_support(net, i, places[i]);
  }
}

}  // namespace vspring
