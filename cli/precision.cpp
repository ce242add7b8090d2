#include "precision.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "vspring/error.hpp"

namespace vspring::cli {

namespace {

// In mean edges: turns by less than about a degree.
constexpr double unseen = 0.01;
// In mean edges: turns by more than a few degrees.
constexpr double coarse = 0.05;

double mean_edge(const PolygonMesh& mesh) {
  double sum = 0;
  std::size_t count = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k, ++count)
      sum += (mesh.position(face[(k + 1) % face.size()]) - mesh.position(face[k])).norm();
  }
  return count > 0 ? sum / static_cast<double>(count) : 0;
}

}  // namespace

std::string warning_of_rounding(const PolygonMesh& shape, double rounding) {
  const double edge = mean_edge(shape);
  if (!(rounding > coarse * edge)) return {};
  return fmt::format(
      "single precision has rounded nodes by {:.3g} units so far from the origin (standard deviation in each "
      "coordinate), {:.2g} of the mean edge, and the shape is no better; subtract an offset before writing it so",
      rounding, rounding / edge);
}

void refuse_auto_of_rounded(const std::string& option, const PolygonMesh& shape, double rounding) {
  // Rounding to multiples of a number has a deviation of this number over √12.
  const double multiples = std::sqrt(12.0) * rounding;
  const double edge = mean_edge(shape);
  if (option.empty() || !(multiples > edge)) return;
  throw Error(
      ErrorCode::unusable_shape,
      fmt::format("{} auto: single precision has rounded nodes to multiples of about {:.3g} units so far from the "
                  "origin, and the mean edge is {:.3g}: the shape is lost; subtract an offset before writing it, or "
                  "write it in double precision",
                  option, multiples, edge));
}

void take_written(PolygonMesh& shape, std::vector<Vector3> written, std::vector<std::string>& warnings) {
  double greatest = 0;
  for (std::size_t i = 0; i < written.size(); ++i) {
    if (written[i] == shape.positions()[i]) continue;
    if (!written[i].allFinite()) return;
    greatest = std::max(greatest, (written[i] - shape.positions()[i]).norm());
  }
  shape.set_positions(std::move(written));
  const double edge = mean_edge(shape);
  if (!(greatest > unseen * edge)) return;
  warnings.push_back(
      fmt::format("the file has single precision, which moves nodes by up to {:.3g} units, {:.2g} of the mean edge; "
                  "write .obj, or subtract an offset from all coordinates first",
                  greatest, greatest / edge));
}

}  // namespace vspring::cli
