#include "start/curve_noise.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

namespace vspring {

namespace {

// Sharper turns than this cosine, first to one side and then to the other, are noise: a coarse nose turns as sharply,
// but to one side.
constexpr double noisy_cosine = 0.5;
constexpr double noisy_cosine_beside = 0.7;
// Cosine of a turn: below it, at two nodes in a row or at one next to a node that stays, the curve runs back.
constexpr double reversing_cosine = -0.2;
// How many nodes on either side of a sharp turn are averaged with it.
constexpr int reach = 3;
constexpr int most_averages = 30;

}  // namespace

void smooth_noise(Net& net) {
  const auto stays = [&](std::size_t i) {
    return i >= net.moving || net.given[i] != 0 || net.rings.links(i).size() < 2;
  };
  struct Turn {
    Vector3 axis = Vector3::Zero();
    double cosine = 1;
  };
  std::vector<Turn> turns(net.positions.size());
  const auto find_turn = [&](std::size_t i) {
    const auto links = net.rings.links(i);
    const Vector3 before = net.positions[i] - net.positions[links[0].node()];
    const Vector3 after = net.positions[links[1].node()] - net.positions[i];
    const double lengths = std::sqrt(before.squaredNorm() * after.squaredNorm());
    turns[i] = {before.cross(after), lengths > 0 ? before.dot(after) / lengths : -1};
  };
  const auto is_noisy = [&](std::size_t i) {
    if (stays(i) || !(turns[i].cosine < noisy_cosine)) return false;
    const auto links = net.rings.links(i);
    return std::any_of(links.begin(), links.end(), [&](Link link) {
      const Turn& beside = turns[link.node()];
      return (turns[i].cosine < reversing_cosine && (beside.cosine < reversing_cosine || stays(link.node()))) ||
             (beside.cosine < noisy_cosine_beside && beside.axis.dot(turns[i].axis) <= 0);
    });
  };
  for (int round = 0; round < most_averages; ++round) {
    std::vector<std::uint8_t> rough(net.positions.size(), 0);
    bool any = false;
    for (std::size_t i = 0; i < net.moving; ++i) {
      if (!stays(i)) find_turn(i);
    }
    for (std::size_t i = 0; i < net.moving; ++i) {
      if (!is_noisy(i)) continue;
      any = true;
      rough[i] = 1;
    }
    if (!any) break;
    for (int step = 0; step < reach; ++step) {
      const std::vector<std::uint8_t> before = rough;
      for (std::size_t i = 0; i < net.moving; ++i) {
        if (before[i] == 0) continue;
        for (const Link link : net.rings.links(i)) rough[link.node()] = 1;
      }
    }
    const std::vector<Vector3> positions = net.positions;
    for (std::size_t i = 0; i < net.moving; ++i) {
      if (rough[i] == 0 || stays(i)) continue;
      const auto links = net.rings.links(i);
      net.positions[i] = 0.5 * positions[i] + 0.25 * (positions[links[0].node()] + positions[links[1].node()]);
    }
  }
}

}  // namespace vspring
