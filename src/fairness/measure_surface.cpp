#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <span>

#include "base/cancellation.hpp"
#include "base/degrees.hpp"
#include "base/progress.hpp"
#include "fairness/counted.hpp"
#include "fairness/curvatures.hpp"
#include "fairness/extrema.hpp"
#include "fairness/measure.hpp"
#include "fairness/mesh_quality.hpp"
#include "fairness/normal_error.hpp"
#include "fairness/self_intersections.hpp"
#include "vspring/error.hpp"
#include "vspring/figures.hpp"
#include "vspring/topology.hpp"

namespace vspring {

namespace {

constexpr std::size_t nodes_per_sum = 4096;

/// The area that each node stands for: linear functions integrate exactly over flat faces. A face is taken as triangles
/// about the mean of its nodes, which has the mean of their values.
std::vector<double> node_areas(const PolygonMesh& mesh, const std::vector<Vector3>& positions,
                               const std::vector<std::uint8_t>& counted) {
  std::vector<double> areas(positions.size(), 0);
  const auto at = [&](Index node) -> const Vector3& { return positions[static_cast<std::size_t>(node)]; };
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (counted[static_cast<std::size_t>(f)] == 0) continue;
    const auto face = mesh.face(f);
    const auto size = static_cast<double>(face.size());
    Vector3 centre = Vector3::Zero();
    for (const Index i : face) centre += at(i) / size;
    double whole = 0;
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index a = face[k];
      const Index b = face[(k + 1) % face.size()];
      const double area = (at(a) - centre).cross(at(b) - centre).norm() / 2;
      areas[static_cast<std::size_t>(a)] += area / 3;
      areas[static_cast<std::size_t>(b)] += area / 3;
      whole += area;
    }
    for (const Index i : face) areas[static_cast<std::size_t>(i)] += whole / (3 * size);
  }
  return areas;
}

struct Extent {
  double least = std::numeric_limits<double>::infinity();
  double greatest = -std::numeric_limits<double>::infinity();
  void add(double value) {
    least = std::min(least, value);
    greatest = std::max(greatest, value);
  }
  void add(const Extent& other) {
    least = std::min(least, other.least);
    greatest = std::max(greatest, other.greatest);
  }
};

/// Sums and extremes over nodes.
struct Bending {
  double area = 0;
  double squares = 0;
  double mean_rates = 0;
  double inline_rates = 0;
  double cross_rates = 0;
  Extent curvature;
  Extent mean;
  Extent gaussian;
  Index without_curvature = 0;
  Index without_variation = 0;

  void add(const NodeCurvature& k, double node_area) {
    area += node_area;
    without_curvature += k.degree < 2 ? 1 : 0;
    without_variation += k.degree < 3 ? 1 : 0;
    if (k.degree < 2) return;
    squares += node_area * (k.k1 * k.k1 + k.k2 * k.k2);
    const double along1 = k.k1_along_1 + k.k2_along_1;
    const double along2 = k.k1_along_2 + k.k2_along_2;
    mean_rates += node_area * (along1 * along1 + along2 * along2) / 4;
    inline_rates += node_area * (k.k1_along_1 * k.k1_along_1 + k.k2_along_2 * k.k2_along_2);
    cross_rates += node_area * (k.k1_along_2 * k.k1_along_2 + k.k2_along_1 * k.k2_along_1);
    curvature.add(k.k1);
    curvature.add(k.k2);
    mean.add(k.mean());
    gaussian.add(k.gaussian());
  }

  void add(const Bending& other) {
    area += other.area;
    squares += other.squares;
    mean_rates += other.mean_rates;
    inline_rates += other.inline_rates;
    cross_rates += other.cross_rates;
    curvature.add(other.curvature);
    mean.add(other.mean);
    gaussian.add(other.gaussian);
    without_curvature += other.without_curvature;
    without_variation += other.without_variation;
  }
};

/// In a frame of size 1; lengths go back to units of the input at the end.
class SurfaceMeasurement {
 public:
  /// known: curvatures of the mesh, or none.
  SurfaceMeasurement(const PolygonMesh& mesh, const Constraints* constraints, std::span<const NodeCurvature> known,
                     const Context& context)
      : mesh_(mesh),
        constraints_(constraints),
        known_(known),
        context_(context),
        team_(context.thread_count()),
        incidence_(mesh),
        faces_(counted_faces(mesh, constraints)),
        nodes_(counted_nodes(mesh, faces_)),
        box_(box_around(mesh, faces_)),
        frame_(box_),
        positions_(placed(mesh.positions(), frame_)) {}

  SurfaceFigures measure() {
    const CancellationScope cancellation(context_);
    static_cast<Fairness&>(figures_) = vspring::measure(mesh_, constraints_, team_);
    const Vector3 size =
        box_.isEmpty() ? Vector3(Vector3::Zero()) : Vector3(frame_.to_local(box_.max()) - frame_.to_local(box_.min()));
    diagonal_ = size.norm();
    figures_.diagonal = diagonal_ / frame_.scale();
    ProgressReporter progress(context_);
    progress.report("measuring", 0.1);
    bend();
    progress.report("measuring", 0.6);
    inspect();
    progress.report("measuring", 0.7);
    if (!context_.cancelled())
      figures_.self_intersections = static_cast<Index>(self_intersections(counted_part(), context_, team_).size());
    if (constraints_ != nullptr) figures_.normal_error = normal_error(mesh_, *constraints_);
    return figures_;
  }

 private:
  void bend() {
    const std::vector<NodeCurvature> curvature = curvature_in_frame();
    const std::vector<double> areas = node_areas(mesh_, positions_, faces_);
    std::vector<Bending> parts((areas.size() + nodes_per_sum - 1) / nodes_per_sum);
    parallel_ranges(team_, areas.size(), nodes_per_sum, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) {
        if (nodes_[i] != 0) parts[begin / nodes_per_sum].add(curvature[i], areas[i]);
      }
    });
    Bending all;
    for (const Bending& part : parts) all.add(part);

    figures_.area = all.area / frame_.scale() / frame_.scale();
    figures_.bending_energy = all.squares;
    figures_.mean_curvature_variation = all.area * all.mean_rates;
    figures_.curvature_variation = all.area * all.inline_rates;
    figures_.curvature_variation_cross = all.area * (all.inline_rates + all.cross_rates);
    figures_.nodes_without_curvature = all.without_curvature;
    figures_.nodes_without_variation = all.without_variation;
    if (!(all.area > 0) || all.curvature.greatest < all.curvature.least) return;
    figures_.greatest_curvature = diagonal_ * all.curvature.greatest;
    figures_.least_curvature = diagonal_ * all.curvature.least;
    figures_.greatest_mean_curvature = diagonal_ * all.mean.greatest;
    figures_.least_mean_curvature = diagonal_ * all.mean.least;
    figures_.greatest_gaussian_curvature = diagonal_ * diagonal_ * all.gaussian.greatest;
    figures_.least_gaussian_curvature = diagonal_ * diagonal_ * all.gaussian.least;
    const double visible = std::max(visible_share * std::sqrt(all.squares / all.area), visible_curvature / diagonal_);
    figures_.mean_curvature_extrema = count_mean_extrema(curvature, visible);
  }

  /// Those that are known, but for shapes so large or small that derivatives of curvature are no numbers in their
  /// units.
  [[nodiscard]] std::vector<NodeCurvature> curvature_in_frame() {
    constexpr int most_doublings = 300;
    if (known_.empty() || std::abs(std::ilogb(frame_.scale())) > most_doublings)
      return curvatures(mesh_, incidence_, frame_.scale(), nodes_, context_, team_);
    return scaled(std::vector<NodeCurvature>(known_.begin(), known_.end()), frame_.scale());
  }

  [[nodiscard]] Index count_mean_extrema(const std::vector<NodeCurvature>& curvature, double visible) const {
    const auto boundary = boundary_nodes(mesh_);
    std::vector<std::uint8_t> used(curvature.size());
    std::vector<std::uint8_t> inside(curvature.size());
    std::vector<double> mean(curvature.size());
    for (std::size_t i = 0; i < curvature.size(); ++i) {
      used[i] = nodes_[i] != 0 && curvature[i].degree >= 2 ? 1 : 0;
      inside[i] = used[i] != 0 && boundary[i] == 0 ? 1 : 0;
      mean[i] = curvature[i].mean();
    }
    const NodeGraph graph(mesh_, incidence_);
    const Index maxima = count_maxima(graph, mean, used, inside, visible);
    for (double& value : mean) value = -value;
    return maxima + count_maxima(graph, mean, used, inside, visible);
  }

  void inspect() {
    const MeshQuality quality = mesh_quality(mesh_, incidence_, positions_, faces_, team_);
    if (quality.longest_edge > 0) {
      figures_.edge_spread = quality.longest_edge / quality.shortest_edge;
      figures_.neighbouring_edge_spread = quality.neighbouring_edge_spread;
    }
    if (quality.smallest_angle <= quality.greatest_angle) {
      figures_.smallest_angle = degrees_per_radian * quality.smallest_angle;
      figures_.greatest_angle = degrees_per_radian * quality.greatest_angle;
    }
    figures_.flipped_faces = quality.flipped_faces;
    figures_.zero_length_edges = quality.zero_length_edges;
    figures_.zero_area_faces = quality.zero_area_faces;
  }

  /// The mesh without the faces that are not measured.
  [[nodiscard]] PolygonMesh counted_part() const {
    if (constraints_ == nullptr) return mesh_;
    MeshBuilder builder;
    for (const Vector3& position : mesh_.positions()) builder.add_node(position);
    for (Index f = 0; f < mesh_.face_count(); ++f) {
      if (faces_[static_cast<std::size_t>(f)] != 0) builder.add_face(mesh_.face(f));
    }
    return builder.take();
  }

  const PolygonMesh& mesh_;
  const Constraints* constraints_;
  std::span<const NodeCurvature> known_;
  const Context& context_;
  ThreadTeam team_;
  Incidence incidence_;
  std::vector<std::uint8_t> faces_;
  std::vector<std::uint8_t> nodes_;
  Eigen::AlignedBox<double, 3> box_;
  Frame frame_;
  std::vector<Vector3> positions_;
  double diagonal_ = 0;
  SurfaceFigures figures_;
};

/// None where somebody cancels.
SurfaceFigures figures_of(const PolygonMesh& mesh, const Constraints* constraints,
                          std::span<const NodeCurvature> curvatures, const Context& context) {
  try {
    return SurfaceMeasurement(mesh, constraints, curvatures, context).measure();
  } catch (const Cancelled&) {
    return {};
  }
}

}  // namespace

SurfaceFigures measure_surface(const PolygonMesh& mesh, const Constraints* constraints, const Context& context) {
  return figures_of(mesh, constraints, {}, context);
}

SurfaceFigures measure_surface(const PolygonMesh& mesh, const Constraints* constraints,
                               std::span<const NodeCurvature> curvatures, const Context& context) {
  if (curvatures.size() != mesh.positions().size())
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} curvatures for {} nodes: give one for each", curvatures.size(), mesh.node_count()));
  return figures_of(mesh, constraints, curvatures, context);
}

SurfaceFigures measure_surface(const PolygonMesh& mesh, const Constraints* constraints) {
  return measure_surface(mesh, constraints, Context());
}

}  // namespace vspring
