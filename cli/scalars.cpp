#include "scalars.hpp"

#include <filesystem>

#include "terminal.hpp"
#include "vspring/curvature.hpp"
#include "vspring/distance.hpp"
#include "vspring/error.hpp"

namespace vspring::cli {

namespace {

template <typename Shape>
NodeScalar deviation(const Shape& shape, const Shape& before, const Context& context) {
  NodeScalar scalar{.name = "deviation", .values = {}};
  const auto& positions = shape.positions();
  if (positions.size() != before.positions().size()) {
    scalar.values = point_distances(positions, before, context);
    return scalar;
  }
  for (std::size_t node = 0; node < positions.size(); ++node)
    scalar.values.push_back((positions[node] - before.positions()[node]).stableNorm());
  return scalar;
}

}  // namespace

void refuse_scalars(const std::string& path, bool curve) {
  if (path.empty()) return;
  const auto format = scalar_format(std::filesystem::path(path).extension().string());
  if (!format || (curve && format != ScalarFormat::vtp))
    throw Error(ErrorCode::invalid_argument,
                output_name(path) + (curve ? ": the numbers of a curve go to VTP; name a file .vtp"
                                           : ": numbers at nodes go to VTP or PLY; name a file .vtp or .ply"));
}

std::vector<NodeScalar> scalars_of(const MeasuredShape<PolygonMesh>& measured, const MeasuredShape<PolygonMesh>* before,
                                   const Context& context) {
  const PolygonMesh& mesh = measured.shape();
  std::vector<NodeScalar> scalars = {
      {"mean_curvature", {}}, {"gaussian_curvature", {}}, {"principal_curvature_1", {}}, {"principal_curvature_2", {}}};
  for (const NodeCurvature& at : measured.curvatures(context)) {
    const double values[] = {at.mean(), at.gaussian(), at.k1, at.k2};
    for (std::size_t k = 0; k < scalars.size(); ++k) scalars[k].values.push_back(values[k]);
  }
  if (before == nullptr) return scalars;
  scalars.push_back(deviation(mesh, before->shape(), context));
  if (!mesh.has_same_faces(before->shape())) return scalars;
  NodeScalar& along = scalars.emplace_back(NodeScalar{"deviation_along_normal", {}});
  const std::vector<NodeCurvature>& bent = before->curvatures(context);
  for (std::size_t node = 0; node < bent.size(); ++node)
    along.values.push_back((mesh.positions()[node] - before->shape().positions()[node]).dot(bent[node].normal));
  return scalars;
}

std::vector<NodeScalar> scalars_of(const MeasuredShape<PolygonCurve>& measured,
                                   const MeasuredShape<PolygonCurve>* before, const Context& context) {
  const PolygonCurve& curve = measured.shape();
  std::vector<NodeScalar> scalars = {{"curvature", measured.curvatures(context)}};
  NodeScalar& arc = scalars.emplace_back(
      NodeScalar{"arc_length", std::vector<double>(static_cast<std::size_t>(curve.node_count()), 0)});
  for (const PolygonCurve::Chain& chain : curve.chains()) {
    double length = 0;
    for (std::size_t k = 0; k < chain.nodes.size(); ++k) {
      if (k > 0) length += (curve.position(chain.nodes[k]) - curve.position(chain.nodes[k - 1])).stableNorm();
      arc.values[static_cast<std::size_t>(chain.nodes[k])] = length;
    }
  }
  if (before != nullptr) scalars.push_back(deviation(curve, before->shape(), context));
  return scalars;
}

}  // namespace vspring::cli
