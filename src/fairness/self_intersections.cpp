#include "fairness/self_intersections.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <limits>
#include <span>
#include <utility>
#include <vector>

#include "fairness/crossing_triangles.hpp"
#include "fairness/height_field.hpp"
#include "fairness/hubs.hpp"
#include "shape/box_tree.hpp"

namespace vspring {

namespace {

constexpr std::size_t leaves_per_task = 256;
constexpr std::size_t queries_per_task = 256;

/// Pairs of faces, the lower number first.
struct FacePairs {
  std::vector<std::pair<Index, Index>> list;

  [[nodiscard]] std::size_t size() const { return list.size(); }
  void add(Index a, Index b) { list.emplace_back(std::minmax(a, b)); }
  void add(const FacePairs& others) { list.insert(list.end(), others.list.begin(), others.list.end()); }
};

struct PairCount {
  std::size_t count = 0;

  [[nodiscard]] std::size_t size() const { return count; }
  void add(Index /*a*/, Index /*b*/) { ++count; }
  void add(const PairCount& others) { count += others.count; }
};

/// A triangle's box and a slab around its plane, with room for rounding. The boxes of oblique long thin triangles
/// mostly overlap, but few meet the slab.
class TriangleReach {
 public:
  TriangleReach(const Box& box, const Vector3& a, const Vector3& b, const Vector3& c) : box_(box), corner_(a) {
    constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();
    normal_ = (b - a).cross(c - a);
    unsure_ = rounding * (b - a).norm() * (c - a).norm();
  }

  [[nodiscard]] bool meets(const Box& other) const {
    if (!box_.intersects(other)) return false;
    const Vector3 half = 0.5 * other.sizes();
    const Vector3 way = other.center() - corner_;
    const double off = std::abs(normal_.dot(way));
    return off <= normal_.cwiseAbs().dot(half) + unsure_ * (way.lpNorm<1>() + half.sum());
  }

 private:
  Box box_;
  Vector3 corner_;
  Vector3 normal_;
  double unsure_ = 0;
};

/// Whether two faces share an edge, or have edges with ends at the same places, as where sheets meet. They may fold
/// there.
bool share_an_edge(const PolygonMesh& mesh, Index a, Index b) {
  const auto first = mesh.face(a);
  const auto second = mesh.face(b);
  const auto is_at = [&](Index one, Index other) { return mesh.position(one) == mesh.position(other); };
  for (std::size_t k = 0; k < first.size(); ++k) {
    for (std::size_t l = 0; l < second.size(); ++l) {
      if (!is_at(first[k], second[l])) continue;
      const Index next = first[(k + 1) % first.size()];
      if (is_at(next, second[(l + 1) % second.size()]) || is_at(next, second[(l + second.size() - 1) % second.size()]))
        return true;
    }
  }
  return false;
}

/// The triangles of a face: of a quad by either diagonal.
class Cuts {
 public:
  Cuts(const PolygonMesh& mesh, const std::vector<Triangle>& triangles, Index face) {
    const auto nodes = mesh.face(face);
    is_quad_ = nodes.size() == 4;
    if (!is_quad_) {
      const auto begin = std::lower_bound(triangles.begin(), triangles.end(), face,
                                          [](const Triangle& triangle, Index f) { return triangle.face < f; });
      given_ = std::span(triangles).subspan(static_cast<std::size_t>(begin - triangles.begin()), nodes.size() - 2);
      return;
    }
    for (std::size_t k = 0; k < 4; ++k)
      of_quad_[k % 2][k / 2] = {{nodes[k], nodes[(k + 1) % 4], nodes[(k + 2) % 4]}, face};
  }

  [[nodiscard]] std::size_t count() const { return is_quad_ ? 2 : 1; }
  [[nodiscard]] std::span<const Triangle> operator[](std::size_t k) const {
    return is_quad_ ? std::span<const Triangle>(of_quad_[k]) : given_;
  }

 private:
  bool is_quad_;
  std::array<std::array<Triangle, 2>, 2> of_quad_{};
  std::span<const Triangle> given_;
};

/// Finds triangles that cross. Around a node all boxes of triangles overlap. So triangles at one hub are separated by
/// their projections onto a sphere around it, others by their planes.
template <typename Pairs>
class CrossingSearch {
 public:
  CrossingSearch(const PolygonMesh& mesh, const CrossingTriangles& triangles, std::size_t most, const Context& context,
                 ThreadTeam& team)
      : mesh_(mesh), triangles_(triangles), most_(most), context_(context), team_(team) {}

  /// Returns the pairs of their faces, each as often as it has crossing triangles. Ends early once it has `most` or
  /// more.
  Pairs find() {
    const Hubs hubs = find_hubs(triangles_.triangles(), triangles_.positions().size());
    const Group others = group_of(hubs.others);
    within(others.tree, hubs.others);
    if (!hubs.hubs.empty()) look_at_hubs(hubs, others);
    return std::move(pairs_);
  }

 private:
  /// Triangles with a tree of their boxes; items of the tree are indices into the numbers.
  struct Group {
    const std::vector<Index>* numbers;
    BoxTree tree;
  };

  [[nodiscard]] const Triangle& triangle(Index number) const {
    return triangles_.triangles()[static_cast<std::size_t>(number)];
  }
  [[nodiscard]] const Vector3& at(Index node) const { return triangles_.positions()[static_cast<std::size_t>(node)]; }

  [[nodiscard]] Group group_of(const std::vector<Index>& numbers) const {
    std::vector<Box> boxes;
    boxes.reserve(numbers.size());
    for (const Index number : numbers) boxes.push_back(triangles_.box(triangle(number)));
    return {&numbers, BoxTree(std::move(boxes), team_)};
  }

  void test(const Triangle& a, const Triangle& b, Pairs& pairs) const {
    if (a.face != b.face && triangles_.cross(a, b) && faces_cross(a.face, b.face)) pairs.add(a.face, b.face);
  }

  /// Whether faces with crossing triangles cross: for all diagonals of quads, as a quad that is not flat may be split
  /// by either.
  [[nodiscard]] bool faces_cross(Index a, Index b) const {
    if (mesh_.face(a).size() == 3 && mesh_.face(b).size() == 3) return true;
    if (share_an_edge(mesh_, a, b)) return false;
    const Cuts first(mesh_, triangles_.triangles(), a);
    const Cuts second(mesh_, triangles_.triangles(), b);
    for (std::size_t s = 0; s < first.count(); ++s) {
      for (std::size_t t = 0; t < second.count(); ++t) {
        const auto others = second[t];
        if (std::none_of(first[s].begin(), first[s].end(), [&](const Triangle& one) {
              return std::any_of(others.begin(), others.end(),
                                 [&](const Triangle& other) { return triangles_.cross(one, other); });
            }))
          return false;
      }
    }
    return true;
  }

  [[nodiscard]] bool is_done() const { return context_.cancelled() || found_.load() >= most_; }

  void take(const std::vector<Pairs>& parts) {
    for (const Pairs& part : parts) pairs_.add(part);
  }

  /// Tests triangles of one tree whose boxes overlap.
  void within(const BoxTree& tree, const std::vector<Index>& numbers) {
    const auto number = [&](Index item) { return numbers[static_cast<std::size_t>(item)]; };
    const auto test_leaves = [&](std::size_t begin, std::size_t end, Pairs& pairs) {
      for (std::size_t leaf = begin; leaf < end && !is_done(); ++leaf) {
        const std::size_t before = pairs.size();
        const auto items = tree.leaf_items(leaf);
        tree.for_each_overlapping_leaf(tree.leaf_box(leaf), leaf, [&](std::size_t other_leaf) {
          const auto others = tree.leaf_items(other_leaf);
          for (std::size_t a = 0; a < items.size(); ++a) {
            for (std::size_t b = other_leaf == leaf ? a + 1 : 0; b < others.size(); ++b) {
              if (tree.box(items[a]).intersects(tree.box(others[b])))
                test(triangle(number(items[a])), triangle(number(others[b])), pairs);
            }
          }
        });
        found_ += pairs.size() - before;
      }
    };
    take(parallel_parts(team_, tree.leaf_count(), leaves_per_task, Pairs(), test_leaves));
  }

  void look_at_hubs(const Hubs& hubs, const Group& others) {
    std::vector<Group> groups;
    std::vector<Box> boxes;
    for (const Hubs::Hub& hub : hubs.hubs) {
      around(hub);
      groups.push_back(group_of(hub.triangles));
      boxes.push_back(groups.back().tree.whole());
    }
    const BoxTree top(std::move(boxes), team_);
    for (std::size_t k = 0; k < groups.size(); ++k) {
      const std::vector<Index>& own = hubs.hubs[k].triangles;
      const auto compare = [&](std::size_t begin, std::size_t end, Pairs& pairs) {
        for (std::size_t t = begin; t < end && !is_done(); ++t) {
          const std::size_t before = pairs.size();
          const Triangle& one = triangle(own[t]);
          const TriangleReach reach(triangles_.box(one), at(one.nodes[0]), at(one.nodes[1]), at(one.nodes[2]));
          between(one, reach, others, pairs);
          top.for_each_leaf([&](const Box& box) { return reach.meets(box); }, 0,
                            [&](std::size_t leaf) {
                              for (const Index item : top.leaf_items(leaf)) {
                                // Each pair of hubs once.
                                if (static_cast<std::size_t>(item) > k)
                                  between(one, reach, groups[static_cast<std::size_t>(item)], pairs);
                              }
                            });
          found_ += pairs.size() - before;
        }
      };
      take(parallel_parts(team_, own.size(), queries_per_task, Pairs(), compare));
    }
  }

  /// Tests triangles at one hub, by the edges opposite it.
  void around(const Hubs::Hub& hub) {
    std::vector<Box> boxes;
    boxes.reserve(hub.triangles.size());
    for (const Index number : hub.triangles) {
      const auto& nodes = triangle(number).nodes;
      const auto place = static_cast<std::size_t>(std::find(nodes.begin(), nodes.end(), hub.node) - nodes.begin());
      boxes.push_back(box_seen_from(at(hub.node), at(nodes[(place + 1) % 3]), at(nodes[(place + 2) % 3])));
    }
    within(BoxTree(std::move(boxes), team_), hub.triangles);
  }

  void between(const Triangle& one, const TriangleReach& reach, const Group& group, Pairs& pairs) const {
    group.tree.for_each_leaf([&](const Box& box) { return reach.meets(box); }, 0,
                             [&](std::size_t leaf) {
                               for (const Index item : group.tree.leaf_items(leaf)) {
                                 if (reach.meets(group.tree.box(item)))
                                   test(one, triangle((*group.numbers)[static_cast<std::size_t>(item)]), pairs);
                               }
                             });
  }

  const PolygonMesh& mesh_;
  const CrossingTriangles& triangles_;
  std::size_t most_;
  const Context& context_;
  ThreadTeam& team_;
  std::atomic<std::size_t> found_ = 0;
  Pairs pairs_;
};

constexpr auto unlimited = std::numeric_limits<std::size_t>::max();

template <typename Pairs>
Pairs crossings(const PolygonMesh& mesh, std::size_t most, const Context& context, ThreadTeam& team) {
  const CrossingTriangles triangles(mesh);
  if (is_height_field(triangles.triangles(), triangles.positions(), team)) return {};
  return CrossingSearch<Pairs>(mesh, triangles, most, context, team).find();
}

/// As the public function, but ends early once `most` or more pairs of triangles cross.
std::vector<std::pair<Index, Index>> face_pairs(const PolygonMesh& mesh, std::size_t most, const Context& context,
                                                ThreadTeam& team) {
  auto pairs = crossings<FacePairs>(mesh, most, context, team).list;
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

std::vector<std::pair<Index, Index>> self_intersections(const PolygonMesh& mesh, const Context& context,
                                                        ThreadTeam& team) {
  return face_pairs(mesh, unlimited, context, team);
}

std::size_t count_self_intersections(const PolygonMesh& mesh, const Context& context, ThreadTeam& team,
                                     std::size_t most) {
  std::size_t sides = 3;
  for (Index f = 0; f < mesh.face_count(); ++f) sides = std::max(sides, mesh.face(f).size());
  // The most pairs of triangles of two faces. With `most` times as many pairs found, at least `most` pairs of faces are
  // among them.
  const std::size_t of_two_faces = (sides - 2) * (sides - 2);
  const std::size_t of_triangles = most * of_two_faces;
  const std::size_t count = sides == 3 ? crossings<PairCount>(mesh, of_triangles, context, team).count
                                       : face_pairs(mesh, of_triangles, context, team).size();
  return std::min(count, most);
}

std::vector<std::pair<Index, Index>> self_intersections(const PolygonMesh& mesh, const Context& context) {
  ThreadTeam team(context.thread_count());
  return self_intersections(mesh, context, team);
}

std::vector<std::pair<Index, Index>> self_intersections(const PolygonMesh& mesh) {
  return self_intersections(mesh, Context());
}

}  // namespace vspring
