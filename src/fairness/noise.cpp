#include "vspring/noise.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "base/cancellation.hpp"
#include "base/dense_algebra.hpp"
#include "base/threads.hpp"
#include "fairness/curve_runs.hpp"
#include "shape/face_geometry.hpp"
#include "shape/incidence.hpp"
#include "shape/node_graph.hpp"
#include "shape/planarity.hpp"

namespace vspring {

namespace {

/// A share of the places, and the normal distribution's quantile there.
struct Share {
  double of_places;
  double quantile;
};
// What a shape bends only adds to heights, so each of these bounds the noise from above, and the least counts. Below
// the first may be what somebody has smoothed or filled in.
constexpr Share shares[] = {{0.1, -1.2816}, {0.2, -0.8416}, {0.3, -0.5244}};
// In standard deviations of the noise: places that are narrower across have no direction that noise is seen along. At
// least this share of all is looked at, and in so many turns.
constexpr double least_extent = 2;
constexpr double least_share_wide = 0.2;
constexpr int most_turns = 5;
// Of the way to the neighbours' mean, before slopes are looked at; and the least cosine of them.
constexpr int steps_of_slopes = 5;
constexpr double least_cosine = 0.3;
constexpr std::size_t nodes_in_a_row = 7;
constexpr std::size_t most_in_a_row = 127;
// In standard deviations of the heights over it.
constexpr double long_way = 4;
constexpr double flatness = 1e-3;
// Least degrees of freedom that tell anything.
constexpr std::size_t least_freedom = 3;
// Of nodes, beyond which they are hubs that everybody is a neighbour of.
constexpr std::size_t most_faces = 100;
constexpr std::size_t most_neighbours = 2 * most_faces;
constexpr double least_pivot = 1e-5;
constexpr std::size_t places_per_task = 256;
constexpr double three_deviations = 0.0027;
// Of the greatest coordinate.
constexpr double last_digits = 16 * std::numeric_limits<double>::epsilon();
// A square over the variance of what is spread evenly over its side.
constexpr double deviations_of_step = 12;
// Beyond what any number of nodes leads to.
constexpr double most_deviations = 10;

/// What nodes around a place say of noise.
struct Place {
  double deviation = std::nan("");  ///< root mean square height over the best quadratic, over its degrees of freedom
  double freedom = 0;
  double extent = 0;  ///< root mean square, in the direction across in which it is less
  double along = 0;   ///< the same in the direction in which it is most
};

/// The mean square, over its degrees of freedom, that a share of samples of unit noise is below (E. B. Wilson, M. M.
/// Hilferty, "The distribution of chi-square", 1931).
double expected_square(double freedom, double quantile) {
  const double spread = 2 / (9 * freedom);
  const double root = 1 - spread + quantile * std::sqrt(spread);
  return root * root * root;
}

/// Heights of points over their best quadratic; none where they are too few, or one is no place. first_axes: in how
/// many directions that is a quadratic, 1 or 2; heights: in how many it is one.
std::optional<Place> place_of(std::span<const Vector3> points, int first_axes, int heights) {
  const auto count = static_cast<Eigen::Index>(points.size());
  const Eigen::Index unknowns = first_axes == 2 ? 6 : 3;
  if (count < unknowns + static_cast<Eigen::Index>(least_freedom)) return std::nullopt;
  Vector3 centre = Vector3::Zero();
  for (const Vector3& p : points) centre += p / static_cast<double>(count);
  if (!centre.allFinite()) return std::nullopt;
  double size = 0;
  for (const Vector3& p : points) size = std::max(size, (p - centre).lpNorm<Eigen::Infinity>());
  if (!(size > 0)) return std::nullopt;
  Eigen::Matrix3d spread = Eigen::Matrix3d::Zero();
  for (const Vector3& p : points) spread += (p - centre) / size * ((p - centre) / size).transpose();
  // Columns in the order of rising eigenvalues.
  const Eigen::Matrix3d axes = principal_axes(spread);
  Eigen::MatrixXd matrix(count, unknowns);
  for (Eigen::Index k = 0; k < count; ++k) {
    const Vector3 local = axes.transpose() * (points[static_cast<std::size_t>(k)] - centre) / size;
    const double u = local[2];
    const double v = local[1];
    if (first_axes == 2)
      matrix.row(k) << 1, u, v, u * u, u * v, v * v;
    else
      matrix.row(k) << 1, u, u * u;
  }
  double squares = 0;
  for (int height = 0; height < heights; ++height) {
    const auto axis = axes.col(first_axes == 2 ? 0 : 1 - height);
    Eigen::VectorXd right(count);
    for (Eigen::Index k = 0; k < count; ++k) right[k] = axis.dot(points[static_cast<std::size_t>(k)] - centre) / size;
    const auto solution = least_squares(matrix, right, least_pivot);
    if (!solution) return std::nullopt;
    squares += (matrix * *solution - right).squaredNorm();
  }
  const double freedom = static_cast<double>((count - unknowns) * heights);
  const auto extent = [&](int axis) {
    return size * std::sqrt(std::max(0.0, axes.col(axis).dot(spread * axes.col(axis))) / static_cast<double>(count));
  };
  return Place{size * std::sqrt(squares / freedom), freedom, extent(1), extent(2)};
}

double at_share(std::vector<double>& values, double part) {
  const auto place = values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), place, values.end());
  return *place;
}

/// What explains the heights at the shares.
double deviation_of(const std::vector<Place>& places) {
  double least = std::numeric_limits<double>::infinity();
  std::vector<double> deviations(places.size());
  for (const Share& one : shares) {
    end_if_cancelled();
    for (std::size_t k = 0; k < places.size(); ++k)
      deviations[k] = places[k].deviation / std::sqrt(expected_square(places[k].freedom, one.quantile));
    least = std::min(least, at_share(deviations, one.of_places));
  }
  return least;
}

NoiseEstimate summary(std::vector<Place> places, std::vector<double> edges, double widest) {
  std::erase_if(places, [](const Place& place) { return !std::isfinite(place.deviation); });
  std::erase_if(edges, [](double edge) { return !std::isfinite(edge); });
  NoiseEstimate result;
  if (places.empty() || edges.empty()) return result;
  result.nodes = static_cast<Index>(places.size());
  result.deviation = deviation_of(places);
  for (int turn = 0; turn < most_turns && widest > 0; ++turn) {
    std::vector<Place> wide;
    std::copy_if(places.begin(), places.end(), std::back_inserter(wide),
                 [&](const Place& place) { return place.extent >= widest * result.deviation; });
    if (static_cast<double>(wide.size()) < least_share_wide * static_cast<double>(places.size())) break;
    result.deviation = deviation_of(wide);
  }
  const double edge = at_share(edges, 0.5);
  result.edges = edge > 0 ? result.deviation / edge : 0;
  return result;
}

/// Unit normals of nodes, once steps to the mean of their neighbours have taken noise off.
std::vector<Vector3> smooth_normals(const PolygonMesh& mesh, const NodeGraph& graph, ThreadTeam& team) {
  const auto nodes = static_cast<std::size_t>(mesh.node_count());
  std::vector<Vector3> now = mesh.positions();
  std::vector<Vector3> next = now;
  for (int step = 0; step < steps_of_slopes; ++step) {
    parallel_ranges(team, nodes, nodes_per_task, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        Vector3 sum = now[i];
        double count = 1;
        graph.for_each_neighbour(static_cast<Index>(i), [&](Index j) {
          sum += now[static_cast<std::size_t>(j)];
          ++count;
        });
        next[i] = sum / count;
      }
    });
    now.swap(next);
  }
  std::vector<Vector3> normals(nodes, Vector3::Zero());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    end_if_cancelled_at(static_cast<std::size_t>(f));
    const auto face = mesh.face(f);
    const Vector3 area = twice_vector_area(face, now);
    for (const Index node : face) normals[static_cast<std::size_t>(node)] += area;
  }
  for (Vector3& normal : normals) normal.stableNormalize();
  return normals;
}

/// Heights above a slope have the noise along it too: how many times as much as across the surface.
double greater_by_slopes(std::span<const Index> nodes, const std::vector<Vector3>& normals) {
  Vector3 axis = Vector3::Zero();
  for (const Index j : nodes) axis += normals[static_cast<std::size_t>(j)];
  axis.stableNormalize();
  double squares = 0;
  for (const Index j : nodes) {
    const double cosine = std::max(least_cosine, std::abs(axis.dot(normals[static_cast<std::size_t>(j)])));
    squares += 1 / (cosine * cosine);
  }
  return std::sqrt(squares / static_cast<double>(nodes.size()));
}

std::vector<double> edges_of(const PolygonMesh& mesh, const NodeGraph& graph) {
  std::vector<double> edges;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    end_if_cancelled_at(static_cast<std::size_t>(i));
    graph.for_each_neighbour(i, [&](Index j) {
      if (j > i) edges.push_back((mesh.position(j) - mesh.position(i)).norm());
    });
  }
  return edges;
}

/// Nodes lie anywhere within half a voxel.
NoiseEstimate noise_of_steps(const Vector3& voxel, std::vector<double> edges, Index nodes) {
  NoiseEstimate result;
  result.voxel = voxel;
  result.nodes = nodes;
  result.deviation = voxel.norm() / std::sqrt(3 * deviations_of_step);
  result.edges = result.deviation / at_share(edges, 0.5);
  return result;
}

/// What is less than the last digits of coordinates tell is no noise.
void forget_rounding(NoiseEstimate& noise, const std::vector<Vector3>& positions) {
  double greatest = 0;
  for (const Vector3& position : positions) {
    if (position.allFinite()) greatest = std::max(greatest, position.cwiseAbs().maxCoeff());
  }
  if (noise.deviation < last_digits * greatest) noise.deviation = noise.edges = 0;
}

}  // namespace

NoiseEstimate estimate_noise(const PolygonMesh& mesh, const Context& context) {
  const Incidence incidence(mesh);
  const NodeGraph graph(mesh, incidence);
  const auto nodes = static_cast<std::size_t>(mesh.node_count());
  if (const auto voxel = voxel_size(mesh)) return noise_of_steps(*voxel, edges_of(mesh, graph), mesh.node_count());
  std::vector<Place> found(nodes);
  ThreadTeam team(context.thread_count());
  const std::vector<Vector3> normals = smooth_normals(mesh, graph, team);
  parallel_ranges(team, nodes, places_per_task, [&](std::size_t begin, std::size_t end) {
    std::vector<Index> around;
    std::vector<Vector3> places;
    for (std::size_t i = begin; i < end; ++i) {
      around.assign(1, static_cast<Index>(i));
      graph.for_each_neighbour(static_cast<Index>(i), [&](Index j) { around.push_back(j); });
      const std::size_t neighbours = around.size();
      if (neighbours > most_neighbours) continue;
      for (std::size_t k = 1; k < neighbours; ++k) {
        if (incidence.corners(around[k]).size() > most_faces) continue;
        graph.for_each_neighbour(around[k], [&](Index j) { around.push_back(j); });
      }
      std::sort(around.begin(), around.end());
      around.erase(std::unique(around.begin(), around.end()), around.end());
      places.clear();
      for (const Index j : around) places.push_back(mesh.position(j));
      const auto place = place_of(places, 2, 1);
      if (!place) continue;
      found[i] = *place;
      found[i].deviation /= greater_by_slopes(around, normals);
    }
  });
  NoiseEstimate noise = summary(std::move(found), edges_of(mesh, graph), least_extent);
  forget_rounding(noise, mesh.positions());
  return noise;
}

double greatest_of_noise(const NoiseEstimate& noise) {
  const double beyond = std::min(three_deviations, std::log(2) / std::max(1.0, static_cast<double>(noise.nodes)));
  if (noise.directions == 2) return std::sqrt(-2 * std::log(beyond)) * noise.deviation;
  double low = 0;
  double high = most_deviations;
  while (high - low > 1e-9) {
    const double middle = (low + high) / 2;
    (std::erfc(middle / std::sqrt(2)) > beyond ? low : high) = middle;
  }
  return high * noise.deviation;
}

NoiseEstimate estimate_noise(const PolygonCurve& whole_curve) {
  // Rows that are there twice say nothing twice.
  const PolygonCurve curve = visible_part(whole_curve);
  const int heights = plane_normal(curve.positions()) ? 1 : 2;
  std::vector<Place> found;
  std::vector<double> edges;
  std::vector<Vector3> places;
  for (const auto& chain : curve.chains()) {
    const std::size_t count = chain.nodes.size();
    const auto at = [&](std::size_t k) -> const Vector3& { return curve.position(chain.nodes[k % count]); };
    for (std::size_t k = 0; k + 1 < count + (chain.closed ? 1 : 0); ++k) edges.push_back((at(k + 1) - at(k)).norm());
    if (count < nodes_in_a_row) continue;
    for (std::size_t k = 0; k < (chain.closed ? count : count - nodes_in_a_row + 1); ++k) {
      std::optional<Place> best;
      places.clear();
      // As many in a row as it takes to see which way they go.
      for (std::size_t row = nodes_in_a_row; row <= most_in_a_row; row = 2 * row + 1) {
        if (chain.closed ? row > count : k + row > count) break;
        while (places.size() < row) places.push_back(at(k + places.size()));
        best = place_of(places, 1, heights);
        if (best && best->along >= long_way * best->deviation) break;
      }
      if (best) found.push_back(*best);
    }
  }
  NoiseEstimate estimate = summary(std::move(found), std::move(edges), 0);
  estimate.directions = heights;
  forget_rounding(estimate, curve.positions());
  return estimate;
}

NoiseEstimate estimate_noise(const PolygonCurve& curve, const std::array<bool, 3>& moving_axes) {
  if (moving_axes == std::array{true, true, true}) return estimate_noise(curve);
  // So flat that what is across it is what moves.
  std::vector<Vector3> flat(curve.positions().size(), Vector3::Zero());
  std::vector<PolygonCurve::Chain> chains = curve.chains();
  for (auto& chain : chains) {
    double way = 0;
    for (std::size_t k = 0; k < chain.nodes.size(); ++k) {
      const Vector3 step = curve.position(chain.nodes[k]) - curve.position(chain.nodes[k > 0 ? k - 1 : 0]);
      Vector3& place = flat[static_cast<std::size_t>(chain.nodes[k])];
      double squares = 0;
      int moving = 0;
      for (int axis = 0; axis < 3; ++axis) {
        if (moving_axes[static_cast<std::size_t>(axis)])
          place[1 + moving++ % 2] = flatness * curve.position(chain.nodes[k])[axis];
        else
          squares += step[axis] * step[axis];
      }
      way += std::sqrt(squares);
      place.x() = way;
    }
    chain.closed = false;
  }
  NoiseEstimate estimate = estimate_noise(PolygonCurve(std::move(flat), std::move(chains)));
  estimate.deviation /= flatness;
  estimate.edges /= flatness;
  return estimate;
}

}  // namespace vspring
