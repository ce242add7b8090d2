#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <span>
#include <vector>

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
#include "shape/boundary.hpp"
#include "shape/fan.hpp"
#include "vspring/error.hpp"
#include "vspring/figures.hpp"

namespace vspring {

namespace {

constexpr std::size_t nodes_per_sum = 4096;

/// The area of each node; sums weighted by it integrate linear functions exactly over flat faces. A face is split into
/// triangles about the mean of its nodes, which gets the mean of their values.
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

/// A mesh in a frame of size 1; lengths go back to units of the input at the end.
struct Measured {
  /// known: curvatures of the mesh, or none.
  Measured(const PolygonMesh& given, std::span<const NodeCurvature> known, const std::vector<std::uint8_t>& faces)
      : mesh(&given), box(box_around(given, faces)), frame(box), positions(placed(given.positions(), frame)) {
    // For shapes too large or small, derivatives of curvature overflow in units of the input.
    constexpr int most_doublings = 300;
    if (std::abs(std::ilogb(frame.scale())) <= most_doublings) curvatures = known;
  }

  const PolygonMesh* mesh;
  std::span<const NodeCurvature> curvatures = {};
  Eigen::AlignedBox<double, 3> box;
  Frame frame;
  std::vector<Vector3> positions;
  double diagonal = 0;
  std::vector<double> mean_curvatures = {};
  std::vector<std::uint8_t> used = {};  ///< nodes that have a curvature
  SurfaceFigures figures = {};
};

/// Measures meshes that differ in their positions only and are finite at the same nodes.
class SurfaceMeasurement {
 public:
  SurfaceMeasurement(const PolygonMesh& mesh, const Constraints* constraints, const Context& context)
      : mesh_(mesh),
        constraints_(constraints),
        context_(context),
        team_(context.thread_count()),
        faces_(counted_faces(mesh, constraints)),
        nodes_(counted_nodes(mesh, faces_)) {}

  void add(const PolygonMesh& mesh, std::span<const NodeCurvature> known) { shapes_.emplace_back(mesh, known, faces_); }

  /// The figures of the added meshes, in their order.
  std::vector<SurfaceFigures> measure() {
    const CancellationScope cancellation(context_);
    {
      const FairnessMeter meter(mesh_, constraints_, team_);
      for (Measured& shape : shapes_)
        static_cast<Fairness&>(shape.figures) = meter.measure(shape.mesh->positions(), constraints_);
    }
    for (Measured& shape : shapes_) {
      const auto& box = shape.box;
      const Frame& frame = shape.frame;
      const Vector3 size =
          box.isEmpty() ? Vector3(Vector3::Zero()) : Vector3(frame.to_local(box.max()) - frame.to_local(box.min()));
      shape.diagonal = size.norm();
      shape.figures.diagonal = shape.diagonal / frame.scale();
    }
    ProgressReporter progress(context_);
    progress.report("measuring", 0.1);
    bend();
    progress.report("measuring", 0.6);
    for (Measured& shape : shapes_) inspect(shape);
    progress.report("measuring", 0.7);
    std::vector<SurfaceFigures> all;
    for (Measured& shape : shapes_) {
      shape.positions = std::vector<Vector3>();
      if (!context_.cancelled()) shape.figures.self_intersections = count_intersections(*shape.mesh);
      if (constraints_ != nullptr) shape.figures.normal_error = normal_error(*shape.mesh, *constraints_);
      all.push_back(shape.figures);
    }
    return all;
  }

 private:
  void bend() {
    const Incidence& incidence = incidence_.emplace(mesh_);
    std::vector<std::vector<Bending>> parts = add_up(incidence);
    std::optional<std::vector<std::uint8_t>> boundary;
    for (std::size_t s = 0; s < shapes_.size(); ++s) {
      Measured& shape = shapes_[s];
      Bending all;
      for (const Bending& part : parts[s]) all.add(part);
      SurfaceFigures& figures = shape.figures;
      figures.area = all.area / shape.frame.scale() / shape.frame.scale();
      figures.bending_energy = all.squares;
      figures.mean_curvature_variation = all.area * all.mean_rates;
      figures.curvature_variation = all.area * all.inline_rates;
      figures.curvature_variation_cross = all.area * (all.inline_rates + all.cross_rates);
      figures.nodes_without_curvature = all.without_curvature;
      figures.nodes_without_variation = all.without_variation;
      if (!(all.area > 0) || all.curvature.greatest < all.curvature.least) continue;
      const double diagonal = shape.diagonal;
      figures.greatest_curvature = diagonal * all.curvature.greatest;
      figures.least_curvature = diagonal * all.curvature.least;
      figures.greatest_mean_curvature = diagonal * all.mean.greatest;
      figures.least_mean_curvature = diagonal * all.mean.least;
      figures.greatest_gaussian_curvature = diagonal * diagonal * all.gaussian.greatest;
      figures.least_gaussian_curvature = diagonal * diagonal * all.gaussian.least;
      const double visible = std::max(visible_share * std::sqrt(all.squares / all.area), visible_curvature / diagonal);
      if (!(all.mean.greatest - all.mean.least > visible)) continue;
      if (!boundary) boundary = Boundary(mesh_, incidence).nodes();
      figures.mean_curvature_extrema = count_mean_extrema(shape, incidence, *boundary, visible);
    }
  }

  /// Per shape the sums over runs of nodes; sets oriented_. Finds the nodes around each node once for all shapes.
  std::vector<std::vector<Bending>> add_up(const Incidence& incidence) {
    const std::size_t count = nodes_.size();
    oriented_.assign(count, 0);
    std::vector<std::vector<Bending>> parts(shapes_.size());
    std::vector<std::vector<double>> areas;
    for (std::size_t s = 0; s < shapes_.size(); ++s) {
      parts[s].resize((count + nodes_per_sum - 1) / nodes_per_sum);
      areas.push_back(node_areas(mesh_, shapes_[s].positions, faces_));
      shapes_[s].mean_curvatures.resize(count);
      shapes_[s].used.resize(count);
    }
    const auto is_known = [](const Measured& shape) { return !shape.curvatures.empty(); };
    const bool all_known = std::all_of(shapes_.begin(), shapes_.end(), is_known);
    std::optional<FaceNeighbours> neighbours;
    if (!all_known) neighbours.emplace(mesh_, incidence, finite_nodes(mesh_), team_);
    parallel_ranges(team_, count, nodes_per_sum, [&](std::size_t begin, std::size_t end) {
      if (context_.cancelled()) return;
      FanWalker walker(mesh_, incidence);
      std::optional<CurvatureFitter> fitter;
      if (!all_known) fitter.emplace(*neighbours);
      for (std::size_t i = begin; i < end; ++i) {
        if (nodes_[i] == 0) continue;
        const Fan& fan = walker.walk(static_cast<Index>(i));
        oriented_[i] = fan.manifold() && fan.flipped_neighbour < 0 ? 1 : 0;
        if (fitter) fitter->go_to(static_cast<Index>(i), fan.links);
        for (std::size_t s = 0; s < shapes_.size(); ++s) {
          Measured& shape = shapes_[s];
          const double scale = shape.frame.scale();
          const NodeCurvature at = is_known(shape) ? scaled(shape.curvatures[i], scale)
                                                   : fitter->at(ScaledPositions(shape.mesh->positions(), scale));
          parts[s][begin / nodes_per_sum].add(at, areas[s][i]);
          shape.mean_curvatures[i] = at.mean();
          shape.used[i] = at.degree >= 2 ? 1 : 0;
        }
      }
    });
    return parts;
  }

  [[nodiscard]] Index count_mean_extrema(Measured& shape, const Incidence& incidence,
                                         const std::vector<std::uint8_t>& boundary, double visible) const {
    std::vector<std::uint8_t> inside = shape.used;
    for (std::size_t i = 0; i < inside.size(); ++i) {
      if (boundary[i] != 0) inside[i] = 0;
    }
    const NodeGraph graph(mesh_, incidence);
    std::vector<double>& mean = shape.mean_curvatures;
    const Index maxima = count_maxima(graph, mean, shape.used, inside, visible);
    for (double& value : mean) value = -value;
    return maxima + count_maxima(graph, mean, shape.used, inside, visible);
  }

  void inspect(Measured& shape) {
    const MeshQuality quality = mesh_quality(mesh_, *incidence_, shape.positions, faces_, oriented_, team_);
    SurfaceFigures& figures = shape.figures;
    if (quality.longest_edge > 0) {
      figures.edge_spread = quality.longest_edge / quality.shortest_edge;
      figures.neighbouring_edge_spread = quality.neighbouring_edge_spread;
    }
    if (quality.smallest_angle <= quality.greatest_angle) {
      figures.smallest_angle = degrees_per_radian * quality.smallest_angle;
      figures.greatest_angle = degrees_per_radian * quality.greatest_angle;
    }
    figures.flipped_faces = quality.flipped_faces;
    figures.zero_length_edges = quality.zero_length_edges;
    figures.zero_area_faces = quality.zero_area_faces;
  }

  /// Counts among the measured faces only.
  [[nodiscard]] Index count_intersections(const PolygonMesh& mesh) {
    const auto is_counted = [](std::uint8_t counted) { return counted != 0; };
    if (std::all_of(faces_.begin(), faces_.end(), is_counted))
      return static_cast<Index>(count_self_intersections(mesh, context_, team_));
    MeshBuilder builder;
    for (const Vector3& position : mesh.positions()) builder.add_node(position);
    for (Index f = 0; f < mesh.face_count(); ++f) {
      if (is_counted(faces_[static_cast<std::size_t>(f)])) builder.add_face(mesh.face(f));
    }
    return static_cast<Index>(count_self_intersections(builder.take(), context_, team_));
  }

  const PolygonMesh& mesh_;
  const Constraints* constraints_;
  const Context& context_;
  ThreadTeam team_;
  std::vector<std::uint8_t> faces_;
  std::vector<std::uint8_t> nodes_;
  std::vector<std::uint8_t> oriented_;  // nodes with consistently oriented faces around
  std::optional<Incidence> incidence_;
  std::vector<Measured> shapes_;
};

/// No figures if cancelled.
SurfaceFigures measure_one(const PolygonMesh& mesh, const Constraints* constraints,
                           std::span<const NodeCurvature> curvatures, const Context& context) {
  try {
    SurfaceMeasurement measurement(mesh, constraints, context);
    measurement.add(mesh, curvatures);
    return measurement.measure().front();
  } catch (const Cancelled&) {
    return {};
  }
}

}  // namespace

SurfaceFigures measure_surface(const PolygonMesh& mesh, const Constraints* constraints, const Context& context) {
  return measure_one(mesh, constraints, {}, context);
}

SurfaceFigures measure_surface(const PolygonMesh& mesh, const Constraints* constraints,
                               std::span<const NodeCurvature> curvatures, const Context& context) {
  if (curvatures.size() != mesh.positions().size())
    throw Error(ErrorCode::invalid_argument,
                fmt::format("{} curvatures for {} nodes: give one for each", curvatures.size(), mesh.node_count()));
  return measure_one(mesh, constraints, curvatures, context);
}

SurfaceFigures measure_surface(const PolygonMesh& mesh, const Constraints* constraints) {
  return measure_surface(mesh, constraints, Context());
}

std::array<SurfaceFigures, 2> measure_surfaces(const PolygonMesh& before, const PolygonMesh& after,
                                               const Constraints* constraints, const Context& context) {
  if (!before.has_same_faces(after))
    throw Error(ErrorCode::invalid_argument, "the two surfaces have other nodes or faces; measure each by itself");
  if (finite_nodes(before) != finite_nodes(after))
    return {measure_surface(before, constraints, context), measure_surface(after, constraints, context)};
  SurfaceMeasurement measurement(before, constraints, context);
  measurement.add(before, {});
  measurement.add(after, {});
  const std::vector<SurfaceFigures> figures = measurement.measure();
  return {figures[0], figures[1]};
}

}  // namespace vspring
