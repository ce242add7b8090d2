#pragma once

#include <cstddef>
#include <span>

#include "base/threads.hpp"
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

/// Moves the moving nodes along the surface that they form, each by about its step, which may be many edges long, to
/// where the V-Springs to the nodes there balance. That is exact on spheres; elsewhere the error is of third order in
/// the spacing. Needs directions, and sets them. Cost: linear in the nodes and the edges on the way.
void slide(Net& net, std::span<const Vector3> steps, ThreadTeam& team);

}  // namespace vspring
