#include "spring/spacing.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <complex>
#include <numbers>
#include <optional>
#include <utility>

#include "spring/pseudo_normal.hpp"
#include "spring/sliding.hpp"

namespace vspring {

namespace {

constexpr int sweeps = 10;
// If noise has flipped more than this share of all corners, it is about as long as edges, and these sweeps are too few.
constexpr double often_turned = 0.12;
constexpr int sweeps_where_turned = 160;
// If it has flipped more than this share, it is longer than two edges.
constexpr double about_all_turned = 0.21;
// Corners with a smaller sine of their angle do not count.
constexpr double turned_sine = 0.2;
constexpr int stretch_passes = 4;

/// The anisotropy of the mesh around a node: the logarithms of squared edges are a constant plus Re(s̄ exp 2iθ), θ
/// being the angle around the node if the mesh were regular there.
using Stretch = std::complex<double>;

/// A spoke around a node with faces all around, if the mesh were regular there.
struct RegularSpoke {
  double angle;
  Stretch turn;  ///< exp 2iθ
};

/// Keeps the regular spokes for each number of spokes, as sines and cosines are slow. Use one per thread.
class RegularSpokes {
 public:
  /// Valid until the next call.
  std::span<const RegularSpoke> of(std::size_t count) {
    if (count > most_kept) return fill(many_, count);
    std::vector<RegularSpoke>& spokes = few_[count];
    return spokes.empty() ? fill(spokes, count) : spokes;
  }

 private:
  // Hardly any node has more.
  static constexpr std::size_t most_kept = 16;

  static std::span<const RegularSpoke> fill(std::vector<RegularSpoke>& spokes, std::size_t count) {
    spokes.clear();
    const double step = 2 * std::numbers::pi / static_cast<double>(count);
    double angle = 0;
    for (std::size_t s = 0; s < count; ++s, angle += step) spokes.push_back({angle, std::polar(1.0, 2 * angle)});
    return spokes;
  }

  std::array<std::vector<RegularSpoke>, most_kept + 1> few_;
  std::vector<RegularSpoke> many_;
};

void find_spokes(std::span<const Link> links, std::vector<std::size_t>& spokes) {
  spokes.clear();
  for (std::size_t k = 0; k < links.size(); ++k) {
    if (links[k].spoke()) spokes.push_back(k);
  }
}

/// The stretch's part of the logarithm of a squared edge.
double stretched(const Stretch& stretch, const RegularSpoke& spoke) {
  return stretch.real() * spoke.turn.real() + stretch.imag() * spoke.turn.imag();
}

/// The spacing is that of the input, even if constraints put nodes elsewhere.
const std::vector<Vector3>& input_places(const Net& net) { return net.input.empty() ? net.positions : net.input; }

double log_square(const Net& net, std::size_t i, std::size_t j) {
  const std::vector<Vector3>& places = input_places(net);
  return std::log((places[j] - places[i]).squaredNorm() + net.tiny);
}

/// The stretch at a node with faces all around. spokes: the places of its spokes in its walk.
Stretch stretch_around(const Net& net, std::size_t i, std::span<const std::size_t> spokes,
                       std::span<const RegularSpoke> regular) {
  const auto links = net.rings.links(i);
  Stretch sum = 0;
  for (std::size_t s = 0; s < spokes.size(); ++s) sum += regular[s].turn * log_square(net, i, links[spokes[s]].node());
  const auto count = static_cast<double>(spokes.size());
  if (count < 3) return 0;
  // With four spokes all sines are zero and all squared cosines one.
  return sum * ((count == 4 ? 1 : 2) / count);
}

/// The stretch at every node with faces all around, its noise averaged over neighbours; else zero.
std::vector<Stretch> stretches(const Net& net, ThreadTeam& team) {
  std::vector<Stretch> stretch(net.computed);
  // Per link the factor that rotates a neighbour's stretch into the node's angles.
  std::vector<Stretch> turn(net.rings.link_count(), 0);
  std::vector<double> angle(net.rings.link_count(), 0);
  std::vector<std::uint8_t> open(net.computed, 0);
  parallel_ranges(team, net.computed, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    RegularSpokes regular_spokes;
    std::vector<std::size_t> spokes;
    for (std::size_t i = begin; i < end; ++i) {
      const auto links = net.rings.links(i);
      open[i] = on_boundary(links) ? 1 : 0;
      if (open[i] != 0) continue;
      find_spokes(links, spokes);
      const auto regular = regular_spokes.of(spokes.size());
      stretch[i] = stretch_around(net, i, spokes, regular);
      for (std::size_t s = 0; s < spokes.size(); ++s) angle[net.rings.begin(i) + spokes[s]] = regular[s].angle;
    }
  });
  parallel_ranges(team, net.computed, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    net.rings.for_spoke_pairs(begin, end, net.computed,
                              [&](std::size_t i, std::size_t k, std::size_t j, std::size_t back) {
                                if (open[i] != 0 || open[j] != 0) return;
                                turn[k] = std::polar(1.0, 2 * (angle[k] - angle[back]));
                                turn[back] = std::conj(turn[k]);
                              });
  });
  std::vector<Stretch> next(stretch.size());
  for (int pass = 0; pass < stretch_passes; ++pass) {
    parallel_ranges(team, net.computed, nodes_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto links = net.rings.links(i);
        Stretch sum = 0;
        double count = 0;
        for (std::size_t k = 0; k < links.size(); ++k) {
          const Stretch by = turn[net.rings.begin(i) + k];
          if (by == 0.0) continue;
          sum += by * stretch[links[k].node()];
          count += 1;
        }
        next[i] = count > 0 ? 0.5 * (stretch[i] + sum / count) : stretch[i];
      }
    });
    stretch.swap(next);
  }
  return stretch;
}

/// The logarithms of squared edges less the node's constant and the stretch's part.
void find_further(const Net& net, std::size_t i, std::span<const std::size_t> spokes,
                  std::span<const RegularSpoke> regular, std::vector<double>& further) {
  const auto links = net.rings.links(i);
  const Stretch own = stretch_around(net, i, spokes, regular);
  further.clear();
  double mean = 0;
  for (const std::size_t k : spokes) {
    further.push_back(log_square(net, i, links[k].node()));
    mean += further.back() / static_cast<double>(spokes.size());
  }
  for (std::size_t s = 0; s < further.size(); ++s) further[s] = further[s] - mean - stretched(own, regular[s]);
}

/// Weights of the links of moving nodes in a sweep, of sum 1 at each node: inverse squares of edge lengths without
/// noise.
std::vector<double> sweep_weights(const Net& net, ThreadTeam& team) {
  const std::vector<Stretch> stretch = stretches(net, team);
  std::vector<double> weights(net.rings.link_count(), 0);
  parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    RegularSpokes regular_spokes;
    std::vector<std::size_t> spokes;
    std::vector<double> further;
    for (std::size_t i = begin; i < end; ++i) {
      const auto links = net.rings.links(i);
      const auto of_node = std::span(weights).subspan(net.rings.begin(i), links.size());
      find_spokes(links, spokes);
      if (spokes.empty()) continue;
      if (on_boundary(links)) {
        // On a free boundary only along it, as on a curve: the mean of all would draw it in.
        of_node[spokes.front()] += 0.5;
        of_node[spokes.back()] += 0.5;
        continue;
      }
      const std::size_t count = spokes.size();
      const auto regular = regular_spokes.of(count);
      // Opposite edges may share more than the stretch: of eight, four may be diagonals.
      const bool has_more = count >= 8 && count % 2 == 0;
      if (has_more) find_further(net, i, spokes, regular, further);
      double sum = 0;
      for (std::size_t s = 0; s < count; ++s) {
        double square = stretched(stretch[i], regular[s]);
        if (has_more) square += 0.5 * (further[s] + further[(s + count / 2) % count]);
        sum += of_node[spokes[s]] = std::exp(-square);
      }
      for (const std::size_t k : spokes) of_node[k] /= sum;
    }
  });
  return weights;
}

/// Weights of a curve, which has no stretch.
std::vector<double> even_weights(const Net& net) {
  std::vector<double> weights(net.rings.link_count(), 0);
  for (std::size_t i = 0; i < net.moving; ++i) {
    const std::size_t count = net.rings.links(i).size();
    // An open end that moves would be drawn in.
    if (count > 1) std::fill_n(weights.begin() + static_cast<std::ptrdiff_t>(net.rings.begin(i)), count, 0.5);
  }
  return weights;
}

/// Nodes of bricks lie on a line with two of their three neighbours: shares that keep them there do not determine the
/// distance of rows. So nodes of three neighbours go half of the way to the mean of these, which does not change even
/// hexagons.
void turn_bricks_to_hexagons(const Net& net, std::vector<Vector3>& places) {
  std::vector<std::pair<std::size_t, Vector3>> moved;
  for (std::size_t i = 0; i < net.moving; ++i) {
    const auto links = net.rings.links(i);
    if (links.size() < 3 || on_boundary(links)) continue;
    Vector3 way = Vector3::Zero();
    int spokes = 0;
    for (const Link link : links) {
      if (!link.spoke()) continue;
      way += places[link.node()] - places[i];
      ++spokes;
    }
    if (spokes == 3) moved.emplace_back(i, places[i] + way / 6);
  }
  for (const auto& [i, place] : moved) places[i] = place;
}

/// Counts corners of faces, and those flipped against the sum of all corners at their node.
struct Corners {
  std::size_t count = 0;
  std::size_t turned = 0;
};

/// Counts the corners at a node with faces all around. sines: a buffer for the sines of its corners, along their
/// normals.
Corners corners_at(const Net& net, std::size_t i, std::vector<Vector3>& sines) {
  const auto links = net.rings.links(i);
  if (on_boundary(links)) return {};
  const std::vector<Vector3>& places = input_places(net);
  sines.clear();
  Vector3 sum = Vector3::Zero();
  const auto first = static_cast<std::size_t>(
      std::find_if(links.begin(), links.end(), [](Link link) { return link.spoke(); }) - links.begin());
  Vector3 before = Vector3::Zero();
  for (std::size_t k = first; k <= first + links.size(); ++k) {
    const Link link = links[k % links.size()];
    if (!link.spoke()) continue;
    const Vector3 way = places[link.node()] - places[i];
    if (k > first) {
      const Vector3 area = before.cross(way);
      sum += area;
      sines.emplace_back(area / (std::sqrt(before.squaredNorm() * way.squaredNorm()) + net.tiny));
    }
    before = way;
  }
  // Corners of bricks may be straight: the least noise flips them, which means nothing.
  const double least = -turned_sine * sum.norm();
  const auto turned =
      std::count_if(sines.begin(), sines.end(), [&](const Vector3& sine) { return sine.dot(sum) < least; });
  return {sines.size(), static_cast<std::size_t>(turned)};
}

/// The share of flipped corners in the input: a third to two fifths if places are pure noise.
double share_turned_over(const Net& net, ThreadTeam& team) {
  std::atomic<std::size_t> count = 0;
  std::atomic<std::size_t> turned = 0;
  parallel_ranges(team, net.moving, nodes_per_task, [&](std::size_t begin, std::size_t end) {
    std::vector<Vector3> sines;
    Corners all;
    for (std::size_t i = begin; i < end; ++i) {
      const Corners corners = corners_at(net, i, sines);
      all.count += corners.count;
      all.turned += corners.turned;
    }
    count += all.count;
    turned += all.turned;
  });
  return count > 0 ? static_cast<double>(turned) / static_cast<double>(count) : 0;
}

/// Moves nodes half of the way to the mean of their neighbours by `weights`, `times` times.
void sweep_places(const Net& net, std::span<const double> weights, int times, std::vector<Vector3>& places,
                  ThreadTeam& team) {
  std::vector<Vector3> next = places;
  for (int done = 0; done < times; ++done) {
    const std::span<const Vector3> from = places;
    const std::span<Vector3> to = next;
    parallel_ranges(team, net.moving, nodes_per_task, [=, &net](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        const auto links = net.rings.links(i);
        const auto of_node = weights.subspan(net.rings.begin(i), links.size());
        const Vector3& place = from[i];
        Vector3 way = Vector3::Zero();
        for (std::size_t k = 0; k < links.size(); ++k) way += of_node[k] * (from[links[k].node()] - place);
        to[i] = place + 0.5 * way;
      }
    });
    places.swap(next);
  }
}

/// rest_positions(), given the share of flipped corners.
std::vector<Vector3> swept(const Net& net, double turned, ThreadTeam& team) {
  const std::vector<double> weights = !net.is_curve ? sweep_weights(net, team) : even_weights(net);
  std::vector<Vector3> places = input_places(net);
  sweep_places(net, weights, turned > often_turned ? sweeps_where_turned : sweeps, places, team);
  if (!net.is_curve) turn_bricks_to_hexagons(net, places);
  put_on_supports(net, places);
  return places;
}

}  // namespace

std::vector<Vector3> rest_positions(const Net& net, ThreadTeam& team) {
  return swept(net, net.is_curve ? 0 : share_turned_over(net, team), team);
}

std::optional<std::vector<Vector3>> told_rest_positions(const Net& net, ThreadTeam& team) {
  const double turned = share_turned_over(net, team);
  if (turned > about_all_turned) return std::nullopt;
  return swept(net, turned, team);
}

}  // namespace vspring
