#include "measuring.hpp"

#include <fmt/format.h>

#include <nlohmann/json.hpp>
#include <type_traits>

namespace vspring::cli {

namespace {

using Json = nlohmann::ordered_json;

Json counts_of(const PolygonMesh& mesh) { return {{"nodes", mesh.node_count()}, {"faces", mesh.face_count()}}; }
Json counts_of(const PolygonCurve& curve) { return {{"nodes", curve.node_count()}, {"chains", curve.chains().size()}}; }

Json to_json(const Distance& distance) {
  return {{"greatest", distance.greatest}, {"rms", distance.rms}, {"node", distance.node}};
}

std::string distance_line(const std::string& name, const Distance& distance, const std::string& definition) {
  return fmt::format("{}  greatest {:.4g} at node {}, rms {:.4g} units  {}\n", name, distance.greatest, distance.node,
                     distance.rms, definition);
}

Json to_json(const Apart& apart) {
  return {{"nodes", apart.nodes ? to_json(*apart.nodes) : Json()},
          {"to_other", to_json(apart.to_other)},
          {"from_other", to_json(apart.from_other)}};
}

}  // namespace

template <typename Shape>
std::vector<Figure> figures_with_noise(const MeasuredShape<Shape>& shape, const std::optional<Constraints>& held,
                                       const NoiseEstimate& noise, bool shown, const Context& context) {
  const bool fits = held && held->node_count() == shape.shape().node_count();
  const Constraints* const constraints = fits ? &*held : nullptr;
  check_measurable(shape.shape(), constraints);
  std::vector<Figure> figures = figures_of(shape, constraints, shown, context);
  // Noise is not a measure of fairness, so list_figures() does not have it.
  figures.push_back(
      {"noise", "noise", "units",
       noise.voxel           ? "of steps of voxels, standard deviation in each coordinate; --noise auto removes them"
       : noise.deviation > 0 ? "estimated standard deviation in each coordinate: the value of --noise auto"
                             : "not known: the numbers show no noise, or there are too few nodes; auto is refused",
       noise.deviation, false});
  figures.push_back({"within_auto", "within auto", "units",
                     noise.voxel           ? "how far such noise goes; --within auto removes the steps"
                     : noise.deviation > 0 ? "the tolerance of --within auto"
                                           : "not known, for the same reason",
                     greatest_of_noise(noise), false});
  figures.push_back({"noise_in_edges", "noise in edges", "", "the noise in median edges", noise.edges, false});
  if constexpr (std::is_same_v<Shape, PolygonCurve>) {
    constexpr const char* keys[] = {"noise_x", "noise_y", "noise_z"};
    constexpr const char* names[] = {"noise in x", "noise in y", "noise in z"};
    for (std::size_t axis = 0; axis < 3; ++axis)
      figures.push_back({keys[axis], names[axis], "units",
                         noise.by_coordinate[axis] > 0 ? "standard deviation in this coordinate alone"
                                                       : "not known: the curve runs along it, or has too few nodes",
                         noise.by_coordinate[axis], false});
  }
  return figures;
}

template <typename Shape>
Json report_of(const std::array<std::string, 2>& names, std::span<const ShownShape<Shape>> shapes,
               const std::optional<Apart>& apart) {
  Json json = {{"shape", names[0]}, {"kind", std::is_same_v<Shape, PolygonMesh> ? "surface" : "curve"}};
  json.update(counts_of(shapes[0].shape()));
  json["figures"] = values_of(shapes[0].figures);
  if (apart) {
    json["compared_with"] = counts_of(shapes[1].shape());
    json["compared_with"]["shape"] = names[1];
    json["compared_with"]["figures"] = values_of(shapes[1].figures);
    json["distance"] = to_json(*apart);
  }
  json["definitions"] = definitions_of(shapes[0].figures);
  return json;
}

std::string distance_lines(const Apart& apart, const Terminal& terminal) {
  std::string text;
  if (apart.nodes) text += distance_line(terminal.bold("node by node   "), *apart.nodes, "between the same nodes");
  text += distance_line(terminal.bold("to the other   "), apart.to_other, "from the nodes of the first to the second");
  text +=
      distance_line(terminal.bold("from the other "), apart.from_other, "from the nodes of the second to the first");
  return text;
}

template std::vector<Figure> figures_with_noise(const MeasuredShape<PolygonMesh>&, const std::optional<Constraints>&,
                                                const NoiseEstimate&, bool, const Context&);
template std::vector<Figure> figures_with_noise(const MeasuredShape<PolygonCurve>&, const std::optional<Constraints>&,
                                                const NoiseEstimate&, bool, const Context&);
template nlohmann::ordered_json report_of(const std::array<std::string, 2>&, std::span<const ShownShape<PolygonMesh>>,
                                          const std::optional<Apart>&);
template nlohmann::ordered_json report_of(const std::array<std::string, 2>&, std::span<const ShownShape<PolygonCurve>>,
                                          const std::optional<Apart>&);

}  // namespace vspring::cli
