#pragma once

#include <cstddef>

#include "shape/direction.hpp"
#include "spring/net.hpp"
#include "spring/v_spring.hpp"

namespace vspring {

struct Place {
  Vector3 position;
  Vector3 normal;
};

/// The place at which the V-Springs (Eq. 4) to other nodes j balance. for_each(use) calls use(j, weight), weights of
/// sum 1. On a sphere, the weighted means q of positions and n of normals lie on one ray from the centre, and each
/// V-Spring from q along n ends on the sphere: d·(n + N) / (1 + n·N) is the same for all nodes. On other surfaces the
/// error of n matters little, because the weighted mean of all d is zero.
template <typename ForEach>
Place balance(const Net& net, const ForEach& for_each) {
  Place place = {Vector3::Zero(), Vector3::Zero()};
  for_each([&](std::size_t j, double weight) {
    place.position += weight * net.positions[j];
    place.normal += (place.normal.dot(net.normals[j]) < 0 ? -weight : weight) * net.normals[j];
  });
  place.normal = direction(place.normal, 1);
  double lift = 0;
  for_each([&](std::size_t j, double weight) {
    lift += weight * steady_difference(net.positions[j] - place.position, place.normal, net.normals[j]);
  });
  place.position += lift * place.normal;
  return place;
}

}  // namespace vspring
