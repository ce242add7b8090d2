#include "page_scene.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "framing.hpp"
#include "page_bytes.hpp"
#include "page_frame.hpp"
#include "scalars.hpp"
#include "vspring/curvature.hpp"
#include "vspring/distance.hpp"

namespace vspring::cli {

namespace {

using Json = nlohmann::ordered_json;

/// Key, texts, and the value of every shape; null if one lacks the figure.
template <typename Shape>
Json figures_of(std::span<const ShownShape<Shape>> shapes) {
  Json rows = Json::array();
  for (const Figure& figure : shapes.front().figures) {
    Json values = Json::array();
    for (const ShownShape<Shape>& shape : shapes) {
      const auto found = std::find_if(shape.figures.begin(), shape.figures.end(),
                                      [&](const Figure& other) { return other.key == figure.key; });
      values.push_back(found == shape.figures.end() ? Json() : Json(found->value));
    }
    rows.push_back({{"key", figure.key},
                    {"name", figure.name},
                    {"unit", figure.unit},
                    {"definition", figure.definition},
                    {"whole", figure.whole},
                    {"values", std::move(values)}});
  }
  return rows;
}

template <typename Shape>
Json frame_of(std::span<const ShownShape<Shape>> shapes, const PageRoles& roles, const Frame& frame) {
  Json json;
  json["figures"] = figures_of(shapes);
  json["columns"] = Json::array();
  for (const ShownShape<Shape>& shape : shapes) json["columns"].push_back(shape.title);
  json["leading"] = roles.leading;
  json["reference"] = roles.reference ? Json(*roles.reference) : Json();
  json["unit"] = frame.side();
  json["size"] = std::max(frame.diagonal(), 1e-3);
  return json;
}

/// The points in the box of the shapes and a little around it.
std::vector<Vector3> shown_points(std::span<const Vector3> points, const Frame& frame) {
  constexpr std::size_t most = 20'000;
  constexpr double around = 0.6;
  std::vector<Vector3> some;
  for (std::size_t j = 0; j < points.size(); j += 1 + points.size() / most) some.push_back(points[j]);
  some = frame.inside(some);
  std::erase_if(some, [](const Vector3& p) { return !(p.cwiseAbs().maxCoeff() <= around); });
  return some;
}

Json to_json(const Eigen::Matrix3d& rows) {
  Json json = Json::array();
  for (Eigen::Index r = 0; r < 3; ++r) json.push_back({rows(r, 0), rows(r, 1), rows(r, 2)});
  return json;
}

void add_framing(Json& json, const Framing& framing) {
  json["view"] = to_json(framing.view);
  Json& part = json["part"];
  if (!framing.part) return;
  const Vector3& middle = framing.part->middle;
  part = {{"middle", {middle.x(), middle.y(), middle.z()}},
          {"extents", {framing.part->width, framing.part->height}},
          {"radius", framing.part->radius}};
}

/// The number of nodes of every face; 0 if they differ.
std::size_t common_length(const PolygonMesh& mesh) {
  const std::size_t first = mesh.face_count() > 0 ? mesh.face(0).size() : 0;
  for (Index f = 1; f < mesh.face_count(); ++f) {
    if (mesh.face(f).size() != first) return 0;
  }
  return first;
}

/// Nodes of no face are not shown, and do not count in charts and colours.
std::vector<bool> seen_nodes(const PolygonMesh& mesh) {
  std::vector<bool> seen(static_cast<std::size_t>(mesh.node_count()), false);
  for (const Index node : mesh.corners()) seen[static_cast<std::size_t>(node)] = true;
  return seen;
}

Json shape_of(const MeasuredShape<PolygonMesh>& measured, const Frame& frame, double diagonal, const Context& context) {
  const PolygonMesh& mesh = measured.shape();
  const std::size_t length = common_length(mesh);
  const std::vector<bool> seen = seen_nodes(mesh);
  std::vector<Index> number(seen.size(), -1);
  std::vector<Vector3> positions;
  std::vector<double> mean;
  std::vector<double> gaussian;
  const auto finite = [](double value) { return std::isfinite(value) ? value : 0; };
  std::size_t next = 0;
  for (const NodeCurvature& bent : measured.curvatures(context)) {
    const std::size_t i = next++;
    if (!seen[i]) continue;
    number[i] = static_cast<Index>(positions.size());
    positions.push_back(mesh.positions()[i]);
    mean.push_back(finite(bent.mean() * diagonal));
    gaussian.push_back(finite(bent.gaussian() * diagonal * diagonal));
  }
  RunEncoder faces(length);
  std::vector<Index> renumbered;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto nodes = mesh.face(f);
    if (nodes.empty() ||
        !std::all_of(nodes.begin(), nodes.end(), [&](Index node) { return mesh.position(node).allFinite(); }))
      continue;
    renumbered.clear();
    for (const Index node : nodes) renumbered.push_back(number[static_cast<std::size_t>(node)]);
    faces.add(renumbered);
  }
  return {{"nodes", encode_coordinates(frame.inside(positions))},
          {"length", length},
          {"runs", faces.take()},
          {"mean", encode_halves(mean)},
          {"gaussian", encode_halves(gaussian)}};
}

/// Adds to both shapes, which have the same faces, the deviations at nodes: distances from the nearest place on the
/// other shape, as sliding along a shape is no deviation. Negative if the node moves to the back of `before`.
void add_deviations(Json& after_json, Json& before_json, const PolygonMesh& after,
                    const MeasuredShape<PolygonMesh>& before, double side, const Context& context) {
  const std::vector<NodeCurvature>& bent = before.curvatures(context);
  const auto& from = before.shape().positions();
  const auto& to = after.positions();
  const std::vector<bool> seen = seen_nodes(after);
  std::vector<std::size_t> moved;
  for (std::size_t node = 0; node < to.size(); ++node) {
    if (seen[node] && to[node].allFinite() && from[node].allFinite() && to[node] != from[node]) moved.push_back(node);
  }
  const auto encoded = [&](const std::vector<Vector3>& positions, const PolygonMesh& other) {
    std::vector<Vector3> points;
    points.reserve(moved.size());
    for (const std::size_t node : moved) points.push_back(positions[node]);
    std::vector<double> values(positions.size(), 0);
    const std::vector<double> distances =
        moved.empty() ? std::vector<double>() : point_distances(points, other, context);
    for (std::size_t k = 0; k < distances.size(); ++k)
      values[moved[k]] = std::copysign(distances[k] / side, (to[moved[k]] - from[moved[k]]).dot(bent[moved[k]].normal));
    std::vector<double> of_seen;
    for (std::size_t node = 0; node < values.size(); ++node) {
      if (seen[node]) of_seen.push_back(values[node]);
    }
    return encode_halves(of_seen);
  };
  after_json["deviation"] = encoded(to, before.shape());
  before_json["deviation"] = encoded(from, after);
}

Json shape_of(const PolygonCurve& curve, const Frame& frame) {
  RunEncoder chains;
  Json closed = Json::array();
  for (const PolygonCurve::Chain& chain : curve.chains()) {
    std::vector<Index> nodes = chain.nodes;
    std::erase_if(nodes, [&](Index node) { return !curve.position(node).allFinite(); });
    chains.add(nodes);
    closed.push_back(chain.closed);
  }
  return {{"nodes", encode_doubles(frame.inside(curve.positions()))},
          {"length", 0},
          {"runs", chains.take()},
          {"closed", std::move(closed)}};
}

}  // namespace

Json scene_of(std::span<const ShownShape<PolygonMesh>> shapes, const PageRoles& roles, const Context& context) {
  Frame frame;
  for (const auto& shape : shapes) frame.add(shape.shape());
  Json json = frame_of(shapes, roles, frame);
  json["kind"] = "surface";
  const auto leading_place = static_cast<std::size_t>(roles.leading);
  const auto reference_place = static_cast<std::size_t>(roles.reference.value_or(roles.leading));
  const PolygonMesh& leading = shapes[leading_place].shape();
  const PolygonMesh& reference = shapes[reference_place].shape();
  const bool alike = leading.has_same_faces(reference);
  add_framing(json, alike ? framing_of(leading, frame.inside(reference.positions()), frame.inside(leading.positions()),
                                       roles.view)
                          : Framing{roles.view.value_or(default_view()), std::nullopt});
  json["points"] = encode_doubles(shown_points(roles.points, frame));
  json["shapes"] = Json::array();
  for (const auto& shape : shapes) {
    if (context.cancelled()) return {};
    // D is that of the shape, as in its figures.
    Frame own;
    own.add(shape.shape());
    Json& entry =
        json["shapes"].emplace_back(shape_of(shape.measured, frame, own.diagonal() * own.half_side() * 2, context));
    entry["title"] = shape.title;
    // Faces or chains equal to those of the first shape are not repeated.
    if (json["shapes"].size() > 1 && entry["runs"] == json["shapes"][0]["runs"]) entry["runs"] = nullptr;
  }
  if (alike && roles.reference && roles.deviation && !context.cancelled())
    add_deviations(json["shapes"][leading_place], json["shapes"][reference_place], leading,
                   shapes[reference_place].measured, frame.side(), context);
  return json;
}

Json scene_of(std::span<const ShownShape<PolygonCurve>> shapes, const PageRoles& roles, const Context& /*context*/) {
  Frame frame;
  for (const auto& shape : shapes) frame.add(shape.shape());
  Json json = frame_of(shapes, roles, frame);
  json["kind"] = "curve";
  json["shapes"] = Json::array();
  std::vector<Vector3> points;
  for (const auto& shape : shapes) {
    json["shapes"].emplace_back(shape_of(shape.shape(), frame))["title"] = shape.title;
    const std::vector<Vector3> inside = frame.inside(shape.shape().positions());
    for (const PolygonCurve::Chain& chain : shape.shape().chains()) {
      for (const Index node : chain.nodes) points.push_back(inside[static_cast<std::size_t>(node)]);
    }
  }
  const Plane plane = plane_of(points);
  const PolygonCurve& leading = shapes[static_cast<std::size_t>(roles.leading)].shape();
  const PolygonCurve& reference = shapes[static_cast<std::size_t>(roles.reference.value_or(roles.leading))].shape();
  add_framing(json, same_chains(leading, reference) ? framing_of(leading.chains(), frame.inside(reference.positions()),
                                                                 frame.inside(leading.positions()), plane.rows)
                                                    : Framing{plane.rows, std::nullopt});
  json["planar"] = plane.planar;
  return json;
}

}  // namespace vspring::cli
