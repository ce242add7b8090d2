#include "figures.hpp"

#include <nlohmann/json.hpp>
#include <string>

namespace vspring::cli {

std::vector<Figure> figures_of(MeasuredShape<PolygonMesh>& mesh, const Constraints* constraints, bool shown,
                               const Context& context) {
  if (!shown) return list_figures(measure_surface(mesh.shape(), constraints, context));
  return list_figures(measure_surface(mesh.shape(), constraints, mesh.curvatures(context), context));
}

std::vector<Figure> figures_of(MeasuredShape<PolygonCurve>& curve, const Constraints* constraints, bool /*shown*/,
                               const Context& /*context*/) {
  return list_figures(measure_curve(curve.shape(), constraints));
}

nlohmann::ordered_json values_of(const std::vector<Figure>& figures) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const Figure& figure : figures) {
    if (figure.whole)
      json[std::string(figure.key)] = static_cast<Index>(figure.value);
    else
      json[std::string(figure.key)] = figure.value;
  }
  return json;
}

nlohmann::ordered_json definitions_of(const std::vector<Figure>& figures) {
  nlohmann::ordered_json json = nlohmann::ordered_json::object();
  for (const Figure& figure : figures)
    json[std::string(figure.key)] = {{"name", figure.name}, {"unit", figure.unit}, {"definition", figure.definition}};
  return json;
}

}  // namespace vspring::cli
