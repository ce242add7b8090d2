// Steps of voxels taken off: a ball, a ring and boxes of voxels of 1 × 1 × 1 and 1 × 1 × 3, as the sides of their
// voxels (quads) and as marching cubes leave their masks (triangles), by vspring as fair with --noise auto does it, by
// VTK's windowed sinc and by the smoothing of surface nets. All get the same mesh; VTK takes quads as they are. Prints
// the figures of docs/peers.md, for each mask as it is and as each leaves it: the distance of the nodes from the
// true shape, root mean square and greatest; the change of volume; the share of nodes further than half a voxel, across
// the shape, from where they were; how far nodes inside flat sides of the upright box are from these; seconds on one
// thread. Lengths are in shorter sides of voxels.

#include <fmt/format.h>
#include <vtkFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "smoothers.hpp"
#include "support/masks.hpp"

namespace {

using namespace vspring;
using namespace bench;

namespace fs = std::filesystem;

// Of half a voxel: what counts as further.
constexpr double further = 1.01;
// Per cent of the volume: what is printed as none, without a sign.
constexpr double least_change = 0.005;
// Of cosines: faces that lie in one plane.
constexpr double in_plane = 1e-6;

/// Signed distances from a shape, and half the sides of a box around the origin with room for it.
struct Shape {
  std::string name;
  Vector3 box;
  std::function<double(const Vector3&)> distance;
};

double distance_from_box(const Vector3& place, const Vector3& half) {
  const Vector3 beyond = place.cwiseAbs() - half;
  return beyond.cwiseMax(0).norm() + std::min(beyond.maxCoeff(), 0.0);
}

/// Their middles are neither corners nor middles of voxels.
std::vector<Shape> shapes(const Vector3& size) {
  const Vector3 middle = 0.123 * size;
  const Vector3 half(10, 7, 6);  // whole voxels of both sizes
  const double cosine = std::cos(0.35);
  const double sine = std::sin(0.35);
  return {{"ball", Vector3::Constant(15), [=](const Vector3& place) { return (place - middle).norm() - 12; }},
          {"ring", Vector3(23, 23, 9),
           [=](const Vector3& place) {
             const Vector3 from = place - middle;
             return std::hypot(std::hypot(from.x(), from.y()) - 14, from.z()) - 6;
           }},
          {"box", Vector3(13, 10, 9), [=](const Vector3& place) { return distance_from_box(place - middle, half); }},
          {"tilted box", Vector3(15, 10, 12), [=](const Vector3& place) {
             const Vector3 from = place - middle;
             const Vector3 turned(cosine * from.x() + sine * from.z(), from.y(), cosine * from.z() - sine * from.x());
             return distance_from_box(turned, half);
           }}};
}

/// What marching cubes make of the mask of support::sides_of_voxels: nodes half way between middles of voxels.
PolygonMesh marching_cubes(const Vector3& size, const Vector3& box, const std::function<bool(const Vector3&)>& inside) {
  vtkNew<vtkImageData> mask;
  int most[3];
  double origin[3];
  for (int axis = 0; axis < 3; ++axis) {
    most[axis] = static_cast<int>(std::ceil(box[axis] / size[axis]));
    origin[axis] = (0.5 - most[axis]) * size[axis];
  }
  mask->SetDimensions(2 * most[0], 2 * most[1], 2 * most[2]);
  mask->SetSpacing(size.data());
  mask->SetOrigin(origin);
  mask->AllocateScalars(VTK_FLOAT, 1);
  for (vtkIdType i = 0; i < mask->GetNumberOfPoints(); ++i) {
    Vector3 place;
    mask->GetPoint(i, place.data());
    static_cast<float*>(mask->GetScalarPointer())[i] = inside(place) ? 1 : 0;
  }
  vtkNew<vtkFlyingEdges3D> cubes;
  cubes->SetInputData(mask);
  cubes->SetValue(0, 0.5);
  cubes->ComputeNormalsOff();
  cubes->Update();
  vtkPolyData* surface = cubes->GetOutput();
  std::vector<Vector3> places(static_cast<std::size_t>(surface->GetNumberOfPoints()));
  for (std::size_t i = 0; i < places.size(); ++i) surface->GetPoint(static_cast<vtkIdType>(i), places[i].data());
  std::vector<Index> begin = {0};
  std::vector<Index> corners;
  vtkNew<vtkIdList> face;
  for (vtkIdType f = 0; f < surface->GetNumberOfCells(); ++f) {
    surface->GetCellPoints(f, face);
    for (const vtkIdType node : *face) corners.push_back(static_cast<Index>(node));
    begin.push_back(static_cast<Index>(corners.size()));
  }
  return {std::move(places), std::move(begin), std::move(corners)};
}

/// Twice the area, along the normal.
Vector3 area_of(std::span<const Index> face, const std::vector<Vector3>& at) {
  const auto place = [&](std::size_t k) -> const Vector3& { return at[static_cast<std::size_t>(face[k])]; };
  Vector3 area = Vector3::Zero();
  for (std::size_t k = 2; k < face.size(); ++k) area += (place(k - 1) - place(0)).cross(place(k) - place(0));
  return area;
}

double volume(const PolygonMesh& mesh, const std::vector<Vector3>& at) {
  double sum = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    const auto place = [&](std::size_t k) -> const Vector3& { return at[static_cast<std::size_t>(face[k])]; };
    for (std::size_t k = 2; k < face.size(); ++k) sum += place(0).dot(place(k - 1).cross(place(k))) / 6;
  }
  return sum;
}

std::vector<Vector3> normals_of(const PolygonMesh& mesh, const std::vector<Vector3>& at) {
  std::vector<Vector3> sums(at.size(), Vector3::Zero());
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const Vector3 area = area_of(mesh.face(f), at);
    for (const Index node : mesh.face(f)) sums[static_cast<std::size_t>(node)] += area;
  }
  for (Vector3& sum : sums) sum.normalize();
  return sums;
}

/// What is told of a result.
struct Result {
  std::string variant;
  double rms = 0;
  double greatest = 0;
  double volume = 0;                ///< its change, per cent
  double beyond = 0;                ///< per cent of the nodes
  std::optional<double> flat = {};  ///< the greatest distance from flat sides, where there are any
  std::optional<double> seconds = {};
};

/// What measures results against the true shape and the mask.
class Ruler {
 public:
  Ruler(const PolygonMesh& mask, Vector3 size, const Shape& shape, bool has_flat_sides)
      : mask_(mask), size_(std::move(size)), shape_(shape), normals_(normals_of(mask, mask.positions())) {
    if (has_flat_sides) is_inside_.assign(normals_.size(), 1);
    for (Index f = 0; f < mask.face_count() && has_flat_sides; ++f) {
      const Vector3 normal = area_of(mask.face(f), mask.positions()).normalized();
      for (const Index node : mask.face(f)) {
        const auto i = static_cast<std::size_t>(node);
        if (normal.dot(normals_[i]) < 1 - in_plane) is_inside_[i] = 0;
      }
    }
  }

  [[nodiscard]] Result look(const std::string& variant, const std::vector<Vector3>& positions) const {
    Result result{.variant = variant};
    const std::vector<Vector3> across = normals_of(mask_, positions);
    for (std::size_t i = 0; i < positions.size(); ++i) {
      const double away = std::abs(shape_.distance(positions[i]));
      result.rms += away * away / static_cast<double>(positions.size());
      result.greatest = std::max(result.greatest, away);
      const Vector3 way = positions[i] - mask_.positions()[i];
      if (std::abs(way.dot(across[i])) > further * across[i].cwiseAbs().dot(size_) / 2)
        result.beyond += 100 / static_cast<double>(positions.size());
      if (!is_inside_.empty() && is_inside_[i] != 0)
        result.flat = std::max(result.flat.value_or(0), std::abs(way.dot(normals_[i])));
    }
    result.rms = std::sqrt(result.rms);
    const double change = 100 * (volume(mask_, positions) / volume(mask_, mask_.positions()) - 1);
    result.volume = std::abs(change) < least_change ? 0 : change;
    return result;
  }

 private:
  const PolygonMesh& mask_;
  Vector3 size_;
  const Shape& shape_;
  std::vector<Vector3> normals_;
  std::vector<std::uint8_t> is_inside_ = {};  // of flat sides
};

/// What fair does with --noise auto.
Result ours(const PolygonMesh& mask, const Ruler& ruler) {
  Context context;
  context.threads = 1;
  FitOptions options;
  options.fair.distribution = Distribution::keep;
  FitResult fitted;
  const Cost cost = measure([&] {
    const std::optional<Vector3> voxel = estimate_noise(mask, context).voxel;
    if (!voxel) throw std::runtime_error("no voxels are seen");
    options.criterion = Voxels{*voxel};
    fitted = fit(mask, Constraints(mask.node_count()), {.positions = mask.positions()}, options, context);
  });
  Result result = ruler.look(fitted.report.fair.outcome == Outcome::converged ? "" : " †", fitted.positions);
  result.seconds = cost.seconds;
  return result;
}

/// The variant of a driver without the size of the voxels.
std::string setting_of(const std::string& variant) { return variant.substr(0, variant.find(';')); }

void run(const Shape& shape, const Vector3& size, const std::string& kind, const PolygonMesh& mask,
         const fs::path& drivers) {
  const Ruler ruler(mask, size, shape, shape.name == "box");
  const auto row = [&](const std::string& by, const Result& result) {
    fmt::print("| {} | {:.0f} × {:.0f} × {:.0f} | {} | {} | {} | {:.3f} | {:.2f} | {:.2f} | {:.1f} | {} | {} |\n",
               shape.name, size.x(), size.y(), size.z(), kind, mask.node_count(), by, result.rms, result.greatest,
               result.volume, result.beyond, result.flat ? fmt::format("{:.3f}", *result.flat) : "",
               result.seconds ? fmt::format("{:.3f}", *result.seconds) : "");
    std::fflush(stdout);
  };
  row("as it is", ruler.look("", mask.positions()));
  const Result fitted = ours(mask, ruler);
  row("vspring" + fitted.variant, fitted);
  // Those of the settings named get rows of their own, and the best of all.
  const auto run_peer = [&](const std::string& by, const char* driver, const std::vector<std::string>& variants,
                            const std::vector<std::string>& usual) {
    std::optional<Result> best;
    for_each_variant(drivers / driver, mask, variants,
                     [&](const std::string& variant, const std::vector<Vector3>& positions, const Cost& cost) {
                       Result one = ruler.look(variant, positions);
                       one.seconds = cost.seconds;
                       if (std::find(usual.begin(), usual.end(), variant) != usual.end())
                         row(fmt::format("{}, {}", by, setting_of(variant)), one);
                       if (!best || one.rms < best->rms) best = one;
                     });
    if (best) row(fmt::format("{}, best ({})", by, setting_of(best->variant)), *best);
  };
  run_peer("sinc", "peer_vtk", {"20, 0.1", "20, 0.03", "20, 0.01", "20, 0.003", "20, 0.001"}, {"20, 0.1", "20, 0.01"});
  std::vector<std::string> steps;
  for (const int count : {4, 8, 16, 32, 64, 128, 256})
    steps.push_back(fmt::format("{}; {:.0f} {:.0f} {:.0f}", count, size.x(), size.y(), size.z()));
  run_peer("surface nets", "peer_surface_nets", steps, {steps[2]});
}

}  // namespace

int main(int /*argc*/, char** argv) {
  fmt::print(
      "| mask | voxels | mesh | nodes | by | root mean square | greatest | volume, % | beyond half a voxel, % | off "
      "flat "
      "sides | seconds |\n|---|---|---|---|---|---|---|---|---|---|---|\n");
  const fs::path drivers = fs::path(argv[0]).parent_path();
  for (const Vector3& size : {Vector3(1, 1, 1), Vector3(1, 1, 3)}) {
    for (const Shape& shape : shapes(size)) {
      const auto inside = [&](const Vector3& place) { return shape.distance(place) < 0; };
      run(shape, size, "sides", support::sides_of_voxels(size, shape.box, inside), drivers);
      run(shape, size, "marching cubes", marching_cubes(size, shape.box, inside), drivers);
    }
  }
  return 0;
}
