#include "equilibrium/spring_energy.hpp"

#include <algorithm>
#include <cmath>

#include "spring/curve_force.hpp"
#include "spring/v_spring.hpp"

namespace vspring {

SpringEnergy spring_energy(const Net& net) {
  SpringEnergy energy;
  if (net.is_curve) {
    for_each_curve_spring(net, [&](const Vector3& spring, const Vector3& d) {
      energy.sum += spring.squaredNorm() / (d.squaredNorm() + net.tiny);
    });
    return energy;
  }
  for (std::size_t i = 0; i < net.computed; ++i) {
    for (const Link link : net.rings.links(i)) {
      const std::size_t j = link.node();
      if (!link.spoke() || j < i || (i >= net.moving && j >= net.computed)) continue;
      const Vector3 d = net.positions[j] - net.positions[i];
      const double difference = steady_difference(d, net.normals[i], net.normals[j]);
      energy.sum += difference * difference / (d.squaredNorm() + net.tiny);
      if (i >= net.moving || net.normals[i].isZero(0) || net.normals[j].isZero(0)) continue;
      const double cosine = net.normals[i].dot(net.normals[j]);
      // The sense of a given normal means nothing.
      const bool given = net.normal_given(i) || net.normal_given(j);
      energy.least_cosine = std::min(energy.least_cosine, given ? std::abs(cosine) : cosine);
    }
  }
  return energy;
}

}  // namespace vspring
