#include "span/arcs.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <tuple>

#include "shape/direction.hpp"
#include "span/corner.hpp"
#include "vspring/constraints.hpp"

namespace vspring {

namespace {

// Curves that turn by more than this at a junction, in degrees, do not go on as one.
constexpr double most_turn_of_one = 30;
// What turns by more than this is not ahead.
constexpr double most_turn_ahead = 65;

/// How a curve that arrives over an edge turns at a node: there it goes on along the edge ahead, which need not be of
/// the same curve. 0 if none is ahead.
double turn_arriving(const Network& network, Index from, Index node) {
  double least = most_turn_ahead;
  for (const Index next : network.neighbours(node)) {
    if (next == from) continue;
    least = std::min(
        least, degrees_between(network.place(node) - network.place(from), network.place(next) - network.place(node)));
  }
  return least < most_turn_ahead ? least : 0;
}

bool is_corner_at(const Network& network, Index node) {
  const auto& beside = network.neighbours(node);
  if (beside.size() != 2) return false;
  const double turn =
      degrees_between(network.place(node) - network.place(beside[0]), network.place(beside[1]) - network.place(node));
  return is_corner(turn, std::max(turn_arriving(network, node, beside[0]), turn_arriving(network, node, beside[1])));
}

}  // namespace

Arcs::Arcs(const Network& network)
    : network_(network), ends_arcs_(network.places.size(), 0), leaving_at_(network.places.size()) {
  const auto count = static_cast<Index>(network.places.size());
  for (Index i = 0; i < count; ++i)
    ends_arcs_[static_cast<std::size_t>(i)] = network.neighbours(i).size() > 2 || is_corner_at(network, i) ? 1 : 0;
  std::vector<std::uint8_t> is_followed(network.places.size(), 0);
  const auto follow_all_from = [&](Index i) {
    for (const Index next : network.neighbours(i)) {
      const auto& there = leaving_at_[static_cast<std::size_t>(i)];
      // An arc that comes back along this edge is known.
      const bool is_known = std::any_of(there.begin(), there.end(), [&](Index half) { return node(half, 1) == next; });
      if (!is_known) follow(i, next);
    }
  };
  for (Index i = 0; i < count; ++i) {
    if (ends_arcs_[static_cast<std::size_t>(i)] != 0) follow_all_from(i);
  }
  for (const Arc& arc : arcs_) {
    for (const Index node : arc.nodes) is_followed[static_cast<std::size_t>(node)] = 1;
  }
  // What is left are closed curves that meet no other.
  for (Index i = 0; i < count; ++i) {
    if (is_followed[static_cast<std::size_t>(i)] != 0 || network.neighbours(i).empty()) continue;
    follow(i, network.neighbours(i).front());
    for (const Index node : arcs_.back().nodes) is_followed[static_cast<std::size_t>(node)] = 1;
  }
  find_tangents();
}

void Arcs::follow(Index from, Index next) {
  Arc arc{.nodes = {from, next}};
  while (arc.nodes.back() != from && ends_arcs_[static_cast<std::size_t>(arc.nodes.back())] == 0) {
    const auto& ends = network_.neighbours(arc.nodes.back());
    arc.nodes.push_back(ends[0] == arc.nodes[arc.nodes.size() - 2] ? ends[1] : ends[0]);
  }
  for (std::size_t k = 0; k + 1 < arc.nodes.size(); ++k)
    arc.length += (network_.place(arc.nodes[k + 1]) - network_.place(arc.nodes[k])).norm();
  const auto half = static_cast<Index>(2 * arcs_.size());
  leaving_at_[static_cast<std::size_t>(arc.nodes.front())].push_back(half);
  leaving_at_[static_cast<std::size_t>(arc.nodes.back())].push_back(half + 1);
  arcs_.push_back(std::move(arc));
}

std::vector<Index> Arcs::nodes_along(Index half) const {
  std::vector<Index> nodes = of(half).nodes;
  if (half % 2 != 0) std::reverse(nodes.begin(), nodes.end());
  return nodes;
}

Vector3 Arcs::leaving(Index half) const {
  constexpr double share = 0.1;
  const auto place = [&](std::size_t k) -> const Vector3& { return network_.place(node(half, k)); };
  const auto place_at = [&](double length) -> Vector3 {
    for (std::size_t k = 0; k + 1 < of(half).nodes.size(); ++k) {
      const double edge = (place(k + 1) - place(k)).norm();
      if (edge >= length) return place(k) + (place(k + 1) - place(k)) * (edge > 0 ? length / edge : 1);
      length -= edge;
    }
    return network_.place(last_node(half));
  };
  const double length = share * of(half).length;
  const Index first = 0;
  return estimate_tangents(PolygonCurve({place(0), place_at(length / 2), place_at(length)}), std::span(&first, 1))
      .front();
}

bool Arcs::is_sharp(Index half) const {
  const std::pair<Index, Index> edge = std::minmax(node(half, 0), node(half, 1));
  return std::binary_search(network_.sharp.begin(), network_.sharp.end(), edge);
}

void Arcs::find_tangents() {
  for (std::size_t n = 0; n < leaving_at_.size(); ++n) {
    const auto& halves = leaving_at_[n];
    const bool is_corner = halves.size() == 2 && ends_arcs_[n] != 0;
    if (is_corner) continue;
    const bool meets_sharp = std::any_of(halves.begin(), halves.end(), [&](Index half) { return is_sharp(half); });
    // The smoothest pairs of ends first.
    std::vector<std::tuple<double, Index, Index>> pairs;
    for (std::size_t i = 0; i < halves.size(); ++i) {
      for (std::size_t j = i + 1; j < halves.size(); ++j) {
        const double turn = degrees_between(-leaving(halves[i]), leaving(halves[j]));
        // A curve may have a corner where it crosses a sharp one.
        const bool crosses = meets_sharp && !(is_sharp(halves[i]) && is_sharp(halves[j]));
        if (turn < most_turn_of_one && !crosses) pairs.emplace_back(turn, halves[i], halves[j]);
      }
    }
    std::sort(pairs.begin(), pairs.end());
    for (const auto& [turn, a, b] : pairs) {
      Arc& first = arcs_[static_cast<std::size_t>(a / 2)];
      Arc& second = arcs_[static_cast<std::size_t>(b / 2)];
      Index& from_first = first.goes_on[static_cast<std::size_t>(a % 2)];
      Index& from_second = second.goes_on[static_cast<std::size_t>(b % 2)];
      if (from_first >= 0 || from_second >= 0) continue;
      from_first = b;
      from_second = a;
      const PolygonCurve around({network_.place(node(a, 1)), network_.places[n], network_.place(node(b, 1))});
      const Index middle = 1;
      const Vector3 tangent = estimate_tangents(around, std::span(&middle, 1)).front();
      first.tangents[static_cast<std::size_t>(a % 2)] = a % 2 == 0 ? -tangent : tangent;
      second.tangents[static_cast<std::size_t>(b % 2)] = b % 2 == 0 ? tangent : -tangent;
    }
  }
}

}  // namespace vspring
