// Runs a case of cases.py by the library's public headers alone: library_cases CASE.json, which names the shape, the
// options and where the result goes.

#include <cstdlib>
#include <exception>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "vspring/vspring.hpp"

namespace {

using nlohmann::json;

void settle(vspring::FairOptions& options, const json& given) {
  vspring::EquilibriumMethod method;
  method.tolerance = given.value("tolerance", method.tolerance);
  options.method = method;
  if (given.value("fair_by", "") == "bending") options.fair_by = vspring::FairBy::bending;
  if (const std::string name = given.value("distribution", ""); !name.empty()) {
    options.distribution = name == "even" ? vspring::Distribution::even : vspring::Distribution::keep;
    options.accept_worse = true;
  }
  if (given.value("fair_boundary", false)) options.fair_boundary = method;
}

vspring::Constraints constraints_of(const vspring::PolygonMesh& mesh, const json& given) {
  vspring::Constraints held(mesh.node_count());
  if (!given.value("fair_boundary", false)) vspring::fix_boundary_positions(held, mesh);
  if (given.contains("fix_normals")) vspring::fix_boundary_normals(held, mesh);
  if (given.contains("constraints")) vspring::apply_rules(held, mesh, given["constraints"].dump());
  if (given.contains("region"))
    vspring::restrict_to_region(held, mesh, given["region"].get<std::vector<vspring::Index>>());
  return held;
}

vspring::Constraints constraints_of(const vspring::PolygonCurve& curve, const json& given) {
  vspring::Constraints held(curve.node_count());
  vspring::fix_boundary_positions(held, curve);
  if (given.contains("fix_normals")) vspring::fix_boundary_tangents(held, curve);
  if (given.contains("constraints")) vspring::apply_rules(held, curve, given["constraints"].dump());
  return held;
}

double noise_of(const vspring::PolygonMesh& mesh, const json& given) {
  if (!given.contains("region")) return vspring::estimate_noise(mesh).deviation;
  return vspring::estimate_noise(mesh, given["region"].get<std::vector<vspring::Index>>()).deviation;
}
double noise_of(const vspring::PolygonCurve& curve, const json& /*given*/) {
  return vspring::estimate_noise(curve).deviation;
}

template <typename Shape>
std::vector<vspring::Vector3> result_of(const Shape& shape, const json& given) {
  const vspring::Constraints held = constraints_of(shape, given);
  const bool is_drawn = given.contains("within") || given.contains("noise") || given.contains("smoothing_length");
  if (!is_drawn) {
    vspring::FairOptions options;
    settle(options, given);
    return vspring::fair(shape, held, options).positions;
  }
  vspring::FitOptions options;
  settle(options.fair, given);
  if (given.contains("within")) options.criterion = vspring::Within{given["within"]};
  if (given.contains("noise")) options.criterion = vspring::Noise{noise_of(shape, given)};
  if (given.contains("smoothing_length")) options.criterion = vspring::SmoothingLength{given["smoothing_length"]};
  if (given.contains("points"))
    return vspring::fit(shape, held, vspring::read_points(given["points"].get<std::string>()), options).positions;
  options.fair.distribution = vspring::Distribution::keep;
  return vspring::fit(shape, held, {.positions = shape.positions()}, options).positions;
}

void run(const json& one) {
  const std::string shape = one["shape"];
  const json& options = one["options"];
  const auto places = one["call"] == "fair_curve" ? result_of(vspring::read_curve(shape).curve, options)
                                                  : result_of(vspring::read_surface(shape).mesh, options);
  json rows = json::array();
  for (const vspring::Vector3& place : places) rows.push_back({place.x(), place.y(), place.z()});
  std::ofstream(one["result"].get<std::string>()) << rows;
}

}  // namespace

int main(int count, char** words) {
  try {
    for (int k = 1; k < count; ++k) run(json::parse(std::ifstream(words[k])));
  } catch (const std::exception& error) {
    std::cerr << error.what() << '\n';
    return EXIT_FAILURE;
  }
  return EXIT_SUCCESS;
}
