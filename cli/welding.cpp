#include "welding.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <iterator>
#include <utility>

#include "vspring/error.hpp"
#include "vspring/topology.hpp"

namespace vspring::cli {

namespace {

// Single precision resolves 1.2e-7 of a coordinate; STL in text mostly has seven digits, 1e-6 of it.
constexpr double rounding_of_stl = 1e-6;
// Nodes nearer than this share of the diagonal are probably meant to be one.
constexpr double suspiciously_near = 1e-6;

/// The distance, as a share of the diagonal, to which rounding may separate nodes; more if the shape lies far from the
/// origin.
double stl_tolerance(const PolygonMesh& mesh) {
  Eigen::AlignedBox<double, 3> box;
  for (const Vector3& position : mesh.positions()) {
    if (position.allFinite()) box.extend(position);
  }
  const double diagonal = box.isEmpty() ? 0 : box.sizes().stableNorm();
  if (!(diagonal > 0)) return 0;
  const double furthest = std::max(box.min().cwiseAbs().maxCoeff(), box.max().cwiseAbs().maxCoeff());
  return rounding_of_stl * std::max(1.0, furthest / diagonal);
}

}  // namespace

Welding::Welding(const SurfaceFile& file, const FairingArguments& arguments) {
  if (arguments.weld)
    weld_file(file, *arguments.weld);
  else if (file.format == SurfaceFormat::stl)
    weld_by_itself(file);
  look_for_seams(file, arguments);
  look_for_faces_without_area(shape(file));
}

Welding::Welding(const CurveFile& /*file*/, const FairingArguments& arguments) {
  if (arguments.weld)
    throw Error(ErrorCode::invalid_argument,
                "--weld is for surfaces; leave it out, or --closed joins the ends of a curve");
}

void Welding::weld_file(const SurfaceFile& file, double tolerance) {
  tolerance_ = tolerance;
  welded_ = weld(file.mesh, tolerance);
  file_ = file.mesh;
  if (welded_->collapsed.empty()) return;
  warnings_.push_back(fmt::format(
      "{} face{} vanished, face {} first: {} corners are no further apart than the {:.3g} that --weld {:g} comes to, "
      "and "
      "come out at one place; a smaller one keeps them",
      welded_->collapsed.size(), welded_->collapsed.size() == 1 ? " has" : "s have", welded_->collapsed.front(),
      welded_->collapsed.size() == 1 ? "its" : "their", welded_->tolerance, tolerance));
}

void Welding::weld_by_itself(const SurfaceFile& file) {
  const double tolerance = stl_tolerance(file.mesh);
  try {
    weld_file(file, tolerance);
  } catch (const Error& error) {
    if (error.code() != ErrorCode::unusable_shape) throw;
    warnings_.push_back(fmt::format("only corners at the same place are welded: {}", error.what()));
    return;
  }
  if (welded_->joined > 0) {
    warnings_.push_back(fmt::format(
        "{} node{} nearer to another than {:.3g}, about what rounding parts in STL, and {} one with it; --weld 0 keeps "
        "them apart",
        welded_->joined, welded_->joined == 1 ? " is" : "s are", welded_->tolerance,
        welded_->joined == 1 ? "is" : "are"));
    return;
  }
  welded_.reset();
  file_ = {};
}

void Welding::look_for_seams(const SurfaceFile& file, const FairingArguments& arguments) {
  const PolygonMesh& mesh = shape(file);
  Seams seams = find_seams(mesh, suspiciously_near);
  if (!arguments.region.empty()) {
    // Fixed faces do not matter.
    const std::vector<Index> region = select_region(mesh.positions(), parse_region(arguments.region), file.groups);
    const auto is_outside = [&](Index node) { return !std::binary_search(region.begin(), region.end(), node); };
    std::erase_if(seams.same, is_outside);
    std::erase_if(seams.near_nodes, is_outside);
  }
  const auto nodes = seams.near_nodes.size();
  const bool same = seams.same.size() == nodes;
  const std::string where =
      same ? "at the place of another one"
           : fmt::format("at the place of another one, or within {:g} of the size", suspiciously_near);
  const std::string way_out = fmt::format("--weld {:g} makes them one", same ? 0 : suspiciously_near);
  if (mesh.face_count() > 1 && 2 * seams.lone_faces > mesh.face_count()) {
    loose_faces_ = fmt::format(
        "{} of {} faces share no edge with another, so there is little to be fair: {}", seams.lone_faces,
        mesh.face_count(),
        nodes > 0 ? fmt::format("{} nodes are {}; {}", nodes, where, way_out)
                  : "if they are meant to meet, --weld EPS makes nodes one that are nearer than EPS times the size");
    warnings_.push_back(loose_faces_);
  } else if (nodes > 0) {
    warnings_.push_back(
        fmt::format("{} boundary nodes, node {} first, are {}, but their faces do not meet: the surface is "
                    "open there; {}",
                    nodes, seams.near_nodes.front(), where, way_out));
  }
}

void Welding::look_for_faces_without_area(const PolygonMesh& mesh) {
  const std::vector<Index> faces = faces_without_area(mesh);
  if (faces.empty()) return;
  const bool is_one = faces.size() == 1;
  warnings_.push_back(fmt::format("{} face{} no area, face {} first: {} no normal, and do{} not count", faces.size(),
                                  is_one ? " has" : "s have", faces.front(), is_one ? "it has" : "they have",
                                  is_one ? "es" : ""));
}

std::vector<Index> Welding::refine(const SurfaceFile& file, const RefinedMesh& of_file, const RefinedMesh& refined,
                                   const std::vector<Index>& joined) {
  if (!welded_) return {};
  file_ = file.mesh;
  std::vector<Index> first(static_cast<std::size_t>(refined.mesh.node_count()), -1);
  std::vector<Index> stays(static_cast<std::size_t>(of_file.input_node_count()), -1);
  const std::vector<Index> numbers = of_file.numbers_in_means();
  for (Index node = 0; node < of_file.kept_node_count(); ++node)
    stays[static_cast<std::size_t>(numbers[static_cast<std::size_t>(node)])] = node;
  std::vector<Index> representative;
  welded_->joined = 0;
  for (Index node = 0; node < file.mesh.node_count(); ++node) {
    const auto i = static_cast<std::size_t>(node);
    Index& of_new = first[static_cast<std::size_t>(joined[i])];
    if (of_new < 0) of_new = node;
    representative.push_back(
        node < of_file.kept_node_count()
            ? stays[static_cast<std::size_t>(welded_->representative[static_cast<std::size_t>(numbers[i])])]
            : of_new);
    welded_->joined += representative.back() != node ? 1 : 0;
  }
  welded_->representative = std::move(representative);
  std::vector<Index> corners = refined.mesh.corners();
  for (Index& corner : corners) corner = first[static_cast<std::size_t>(corner)];
  welded_->mesh = PolygonMesh(file.mesh.positions(), refined.mesh.face_begin(), std::move(corners));
  return first;
}

RuleInput Welding::rules(const SurfaceFile& file) const {
  return {.groups = &file.groups, .normals = &file.normals, .welded = welded_ ? &*welded_ : nullptr};
}

std::vector<Vector3> Welding::positions(const std::vector<Vector3>& of_shape) const {
  return welded_ ? welded_->positions(of_shape) : of_shape;
}

std::vector<double> Welding::weights() const {
  std::vector<double> weights;
  if (!welded_) return weights;
  for (std::size_t node = 0; node < welded_->representative.size(); ++node)
    weights.push_back(welded_->representative[node] == static_cast<Index>(node) ? 1 : 0);
  return weights;
}

std::vector<double> Welding::greatest(std::vector<double> values) const {
  for (std::size_t node = 0; welded_ && node < values.size(); ++node) {
    double& first = values[static_cast<std::size_t>(welded_->representative[node])];
    first = std::max(first, values[node]);
  }
  return values;
}

std::vector<std::string> Welding::with_warnings(std::vector<std::string> warnings) const {
  warnings.insert(warnings.end(), warnings_.begin(), warnings_.end());
  return warnings;
}

void Welding::write_scalars(const std::string& path, const PolygonMesh& shape, std::vector<NodeScalar> scalars) const {
  if (!welded_) return vspring::write_scalars(path, shape, scalars);
  for (NodeScalar& scalar : scalars) {
    std::vector<double> values;
    for (const Index first : welded_->representative) values.push_back(scalar.values[static_cast<std::size_t>(first)]);
    scalar.values = std::move(values);
  }
  PolygonMesh of_file = file_;
  of_file.set_positions(positions(shape.positions()));
  vspring::write_scalars(path, of_file, scalars);
}

void Welding::write_scalars(const std::string& path, const PolygonCurve& shape,
                            const std::vector<NodeScalar>& scalars) {
  vspring::write_scalars(path, shape, scalars);
}

nlohmann::ordered_json Welding::figures() const {
  if (!welded_) return nlohmann::ordered_json::object();
  return {{"weld",
           {{"share", tolerance_},
            {"distance", welded_->tolerance},
            {"joined_nodes", welded_->joined},
            {"vanished_faces", welded_->collapsed.size()}}}};
}

std::string Welding::lines() const {
  if (!welded_) return {};
  const std::size_t nodes = welded_->representative.size();
  return fmt::format("welded           {} nodes of the file to {}, {}\n", nodes,
                     nodes - static_cast<std::size_t>(welded_->joined),
                     tolerance_ > 0 ? fmt::format("within {:.3g} units", welded_->tolerance) : "at the same place");
}

}  // namespace vspring::cli
