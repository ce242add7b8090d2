#include "fairness/crossing_triangles.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace vspring {

namespace {

/// On which side of the oriented plane abc lies d: 1, −1, or 0 if within rounding. Sizes are at most 2, so coordinates
/// are rounded by at most 2⁻⁵²; each moves the volume by no more than its share of the areas.
int side(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  const Vector3 u = a - d;
  const Vector3 v = b - d;
  const Vector3 w = c - d;
  const Vector3 vw = v.cross(w);
  const Vector3 wu = w.cross(u);
  const Vector3 uv = u.cross(v);
  const double volume = u.dot(vw);
  // Lengths are at most 2√3, so this bound, without roots, exceeds the rounding below.
  const double longest = std::max({u.squaredNorm(), v.squaredNorm(), w.squaredNorm()});
  if (std::abs(volume) > 7 * rounding * longest) return volume > 0 ? 1 : -1;
  const double areas = vw.norm() + wu.norm() + uv.norm();
  // The rounding of cross products goes with the product of the lengths, which matters for long thin triangles.
  const double lengths = u.norm() * v.norm() * w.norm();
  if (std::abs(volume) <= rounding * (areas + lengths)) return 0;
  return volume > 0 ? 1 : -1;
}

}  // namespace

CrossingTriangles::CrossingTriangles(const PolygonMesh& mesh) : triangles_(cut_into_triangles(mesh)) {
  double greatest = 0;
  for (const Triangle& triangle : triangles_) {
    for (const Index i : triangle.nodes) greatest = std::max(greatest, mesh.position(i).cwiseAbs().maxCoeff());
  }
  // By a power of two and without translation: no digit changes, so faces that touch still touch.
  const double scale = greatest > 0 ? std::ldexp(1.0, -std::max(std::ilogb(greatest), -1000)) : 1.0;
  positions_.reserve(mesh.positions().size());
  for (const Vector3& position : mesh.positions()) positions_.push_back(position * scale);
}

Box CrossingTriangles::box(const Triangle& triangle) const {
  Box box;
  for (const Index i : triangle.nodes) box.extend(at(i));
  return box;
}

// Each must straddle the other's plane, and their intervals on the line common to both planes must overlap by more than
// a point. Four signs of volumes decide that (P. Guigue, O. Devillers, "Fast and robust triangle-triangle overlap test
// using orientation predicates", Journal of Graphics Tools 8(1), 2003).
bool CrossingTriangles::cross(const Triangle& a, const Triangle& b) const {
  int shared = 0;
  for (const Index i : a.nodes) shared += std::count(b.nodes.begin(), b.nodes.end(), i) > 0 ? 1 : 0;
  if (shared > 1) return false;
  std::optional<Corners> one = straddling(a, b);
  if (!one) return false;
  std::optional<Corners> two = straddling(b, a);
  if (!two) return false;
  if (side(one->alone, one->second, one->third, two->alone) < 0) std::swap(one->second, one->third);
  if (side(two->alone, two->second, two->third, one->alone) > 0) std::swap(two->second, two->third);
  return side(one->alone, one->third, two->alone, two->second) > 0 &&
         side(one->alone, one->second, two->alone, two->third) < 0;
}

std::optional<CrossingTriangles::Corners> CrossingTriangles::straddling(const Triangle& triangle,
                                                                        const Triangle& other) const {
  std::array<int, 3> sides{};
  for (std::size_t k = 0; k < 3; ++k) {
    const Index node = triangle.nodes[k];
    const bool is_shared = std::find(other.nodes.begin(), other.nodes.end(), node) != other.nodes.end();
    sides[k] = is_shared ? 0 : side(at(other.nodes[0]), at(other.nodes[1]), at(other.nodes[2]), at(node));
  }
  const auto [least, greatest] = std::minmax({sides[0], sides[1], sides[2]});
  if (least >= 0 || greatest <= 0) return std::nullopt;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t next = (k + 1) % 3;
    const std::size_t last = (k + 2) % 3;
    if (sides[k] == 0 || sides[next] == sides[k] || sides[last] == sides[k]) continue;
    return Corners{at(triangle.nodes[k]), at(triangle.nodes[next]), at(triangle.nodes[last])};
  }
  return std::nullopt;
}

}  // namespace vspring
