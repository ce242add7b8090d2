#include "fairness/self_intersections.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include "fairness/height_field.hpp"
#include "shape/box_tree.hpp"
#include "shape/triangles.hpp"

namespace vspring {

namespace {

constexpr std::size_t leaves_per_task = 256;

class Crossings {
 public:
  explicit Crossings(const PolygonMesh& mesh) : triangles_(cut_into_triangles(mesh)) {
    double greatest = 0;
    for (const Triangle& triangle : triangles_) {
      for (const Index i : triangle.nodes) greatest = std::max(greatest, mesh.position(i).cwiseAbs().maxCoeff());
    }
    // By a power of two and without moving the shape: no digit changes, and what touches still touches.
    const double scale = greatest > 0 ? std::ldexp(1.0, -std::max(std::ilogb(greatest), -1000)) : 1.0;
    positions_.reserve(mesh.positions().size());
    for (const Vector3& position : mesh.positions()) positions_.push_back(position * scale);
  }

  [[nodiscard]] const std::vector<Triangle>& triangles() const noexcept { return triangles_; }
  [[nodiscard]] const std::vector<Vector3>& positions() const noexcept { return positions_; }

  [[nodiscard]] Box box(const Triangle& triangle) const {
    Box box;
    for (const Index i : triangle.nodes) box.extend(at(i));
    return box;
  }

  /// Both straddle the other's plane, and the stretches of the line between the planes that they cover overlap by more
  /// than a point: four signs of volumes tell, as in P. Guigue, O. Devillers, "Fast and robust triangle-triangle
  /// overlap test using orientation predicates", Journal of Graphics Tools 8(1), 2003.
  [[nodiscard]] bool cross(const Triangle& a, const Triangle& b) const {
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

 private:
  [[nodiscard]] const Vector3& at(Index node) const { return positions_[static_cast<std::size_t>(node)]; }

  /// On which side of the plane abc, seen along the way a → b → c, lies d: 1, −1, or 0 on it as far as coordinates of
  /// limited precision can tell. Sizes are at most 2, so rounding of the coordinates themselves is at most 2⁻⁵²; each
  /// moves the volume by no more than its share of the areas.
  static int side(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& d) {
    constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
    const Vector3 u = a - d;
    const Vector3 v = b - d;
    const Vector3 w = c - d;
    const Vector3 vw = v.cross(w);
    const Vector3 wu = w.cross(u);
    const Vector3 uv = u.cross(v);
    const double volume = u.dot(vw);
    // Lengths are at most twice the root of three, so this is more than what is rounded below, without roots.
    const double longest = std::max({u.squaredNorm(), v.squaredNorm(), w.squaredNorm()});
    if (std::abs(volume) > 7 * rounding * longest) return volume > 0 ? 1 : -1;
    const double areas = vw.norm() + wu.norm() + uv.norm();
    // The cross products round by the product of the lengths, which long thin triangles notice.
    const double lengths = u.norm() * v.norm() * w.norm();
    if (std::abs(volume) <= rounding * (areas + lengths)) return 0;
    return volume > 0 ? 1 : -1;
  }

  /// The corners of a triangle, first the one that is alone on its side of another's plane.
  struct Corners {
    Vector3 alone;
    Vector3 second;
    Vector3 third;
  };

  /// None unless it has corners on both sides of the plane of `other`.
  [[nodiscard]] std::optional<Corners> straddling(const Triangle& triangle, const Triangle& other) const {
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

  std::vector<Triangle> triangles_;
  std::vector<Vector3> positions_;
};

/// use(a, b, part) for every pair of faces of which two triangles cross, a < b, as often as they do. Returns parts.
template <typename Part, typename Use>
std::vector<Part> for_crossings(const PolygonMesh& mesh, const Context& context, ThreadTeam& team, const Use& use) {
  const Crossings crossings(mesh);
  const auto& triangles = crossings.triangles();
  if (is_height_field(triangles, crossings.positions(), team)) return {};
  std::vector<Box> boxes;
  boxes.reserve(triangles.size());
  for (const Triangle& triangle : triangles) boxes.push_back(crossings.box(triangle));
  const BoxTree tree(std::move(boxes), team);

  const auto test = [&](Index i, Index j, Part& part) {
    const Triangle& a = triangles[static_cast<std::size_t>(i)];
    const Triangle& b = triangles[static_cast<std::size_t>(j)];
    if (a.face == b.face || !tree.box(i).intersects(tree.box(j))) return;
    if (crossings.cross(a, b)) use(std::min(a.face, b.face), std::max(a.face, b.face), part);
  };
  const auto test_leaves = [&](std::size_t begin, std::size_t end, Part& part) {
    for (std::size_t leaf = begin; leaf < end && !context.cancelled(); ++leaf) {
      const auto items = tree.leaf_items(leaf);
      tree.for_each_overlapping_leaf(tree.leaf_box(leaf), leaf, [&](std::size_t other_leaf) {
        const auto others = tree.leaf_items(other_leaf);
        for (std::size_t a = 0; a < items.size(); ++a) {
          for (std::size_t b = other_leaf == leaf ? a + 1 : 0; b < others.size(); ++b) test(items[a], others[b], part);
        }
      });
    }
  };
  return parallel_parts(team, tree.leaf_count(), leaves_per_task, Part(), test_leaves);
}

}  // namespace

std::vector<std::pair<Index, Index>> self_intersections(const PolygonMesh& mesh, const Context& context,
                                                        ThreadTeam& team) {
  using Pairs = std::vector<std::pair<Index, Index>>;
  const auto add = [](Index a, Index b, Pairs& pairs) { pairs.emplace_back(a, b); };
  Pairs all;
  for (const Pairs& pairs : for_crossings<Pairs>(mesh, context, team, add))
    all.insert(all.end(), pairs.begin(), pairs.end());
  std::sort(all.begin(), all.end());
  all.erase(std::unique(all.begin(), all.end()), all.end());
  return all;
}

std::size_t count_self_intersections(const PolygonMesh& mesh, const Context& context, ThreadTeam& team) {
  const std::vector<Index>& begin = mesh.face_begin();
  const auto is_larger = [](Index first, Index next) { return next - first > 3; };
  if (std::adjacent_find(begin.begin(), begin.end(), is_larger) != begin.end())
    return self_intersections(mesh, context, team).size();
  std::size_t all = 0;
  const auto count = [](Index, Index, std::size_t& part) { ++part; };
  for (const std::size_t part : for_crossings<std::size_t>(mesh, context, team, count)) all += part;
  return all;
}

std::vector<std::pair<Index, Index>> self_intersections(const PolygonMesh& mesh, const Context& context) {
  ThreadTeam team(context.thread_count());
  return self_intersections(mesh, context, team);
}

std::vector<std::pair<Index, Index>> self_intersections(const PolygonMesh& mesh) {
  return self_intersections(mesh, Context());
}

}  // namespace vspring
