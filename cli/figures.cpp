#include "figures.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <nlohmann/json.hpp>
#include <span>
#include <string_view>

namespace vspring::cli {

namespace {

std::string value_of(const Figure& figure) {
  return figure.whole ? fmt::format("{:.0f}", figure.value) : fmt::format("{:.4g}", figure.value);
}

std::string value_of(const std::vector<Figure>& figures, std::string_view key) {
  const auto found = std::find_if(figures.begin(), figures.end(), [&](const Figure& f) { return f.key == key; });
  return found == figures.end() ? std::string() : value_of(*found);
}

/// Terminals count characters, not bytes.
std::size_t width_of(std::string_view text) {
  return static_cast<std::size_t>(
      std::count_if(text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0U) != 0x80U; }));
}

std::string spaces(std::size_t width, std::string_view text) {
  return std::string(width - std::min(width, width_of(text)), ' ');
}

std::string to_left(std::string_view text, std::size_t width) { return std::string(text) + spaces(width, text); }
std::string to_right(std::string_view text, std::size_t width) { return spaces(width, text) + std::string(text); }

/// The box around runs of neighbouring nodes with a moving node.
class MovingBox {
 public:
  MovingBox(const std::vector<Vector3>& positions, const Constraints& constraints)
      : positions_(positions), constraints_(constraints) {}

  void extend(std::span<const Index> nodes) {
    if (std::all_of(nodes.begin(), nodes.end(), [&](Index node) { return constraints_.position_fixed(node); })) return;
    for (const Index node : nodes) {
      const Vector3& position = positions_[static_cast<std::size_t>(node)];
      if (position.allFinite()) box_.extend(position);
    }
  }
  [[nodiscard]] double diagonal() const { return box_.isEmpty() ? 0 : box_.sizes().stableNorm(); }

 private:
  const std::vector<Vector3>& positions_;
  const Constraints& constraints_;
  Eigen::AlignedBox<double, 3> box_;
};

}  // namespace

double size_of_moving(const PolygonMesh& mesh, const Constraints& constraints) {
  MovingBox box(mesh.positions(), constraints);
  for (Index f = 0; f < mesh.face_count(); ++f) box.extend(mesh.face(f));
  return box.diagonal();
}

double size_of_moving(const PolygonCurve& curve, const Constraints& constraints) {
  MovingBox box(curve.positions(), constraints);
  for (const auto& chain : curve.chains()) {
    const std::size_t count = chain.nodes.size();
    for (std::size_t k = 0; k + (chain.closed ? 0 : 1) < count; ++k)
      box.extend(std::array{chain.nodes[k], chain.nodes[(k + 1) % count]});
  }
  return box.diagonal();
}

std::vector<Figure> figures_of(const MeasuredShape<PolygonMesh>& mesh, const Constraints* constraints, bool shown,
                               const Context& context) {
  if (!shown) return list_figures(measure_surface(mesh.shape(), constraints, context));
  return list_figures(measure_surface(mesh.shape(), constraints, mesh.curvatures(context), context));
}

std::vector<Figure> figures_of(const MeasuredShape<PolygonCurve>& curve, const Constraints* constraints, bool /*shown*/,
                               const Context& /*context*/) {
  return list_figures(measure_curve(curve.shape(), constraints));
}

std::array<std::vector<Figure>, 2> figures_of(const PolygonMesh& before, const PolygonMesh& after,
                                              const Constraints* constraints, const Context& context) {
  const std::array<SurfaceFigures, 2> figures = measure_surfaces(before, after, constraints, context);
  return {list_figures(figures[0]), list_figures(figures[1])};
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

std::string figure_table(const std::vector<FigureColumn>& columns, const Terminal& terminal) {
  const std::vector<Figure>& rows = columns.front().figures;
  std::size_t names = 0;
  std::size_t units = 0;
  for (const Figure& row : rows) {
    names = std::max(names, width_of(row.name));
    units = std::max(units, width_of(row.unit));
  }
  std::vector<std::size_t> widths;
  widths.reserve(columns.size());
  for (const FigureColumn& column : columns) {
    std::size_t& width = widths.emplace_back(width_of(column.title));
    for (const Figure& figure : column.figures) width = std::max(width, width_of(value_of(figure)));
  }

  std::string text;
  if (columns.size() > 1) {
    text += std::string(names, ' ');
    for (std::size_t c = 0; c < columns.size(); ++c)
      text += "  " + terminal.bold(to_right(columns[c].title, widths[c]));
    text += "\n";
  }
  for (const Figure& row : rows) {
    text += terminal.bold(to_left(row.name, names));
    for (std::size_t c = 0; c < columns.size(); ++c)
      text += "  " + to_right(value_of(columns[c].figures, row.key), widths[c]);
    text += fmt::format(" {}  {}\n", to_left(row.unit, units), row.definition);
  }
  return text;
}

}  // namespace vspring::cli
