#include "levels/patch_mesh.hpp"

#include <algorithm>
#include <limits>

namespace vspring {

namespace {

// Up to here the best of all ears is looked for; larger polygons lose every second node as an ear at a time.
constexpr std::size_t small_polygon = 8;

/// Calls use(face) for every face around node i, nodes in order, i first.
template <typename Use>
void for_each_face(const Net& net, std::size_t i, std::vector<Index>& face, const Use& use) {
  const auto links = net.rings.links(i);
  if (links.empty()) return;
  const auto node = [&](std::size_t k) { return static_cast<Index>(links[k].node()); };
  const auto centre = static_cast<Index>(i);
  face.assign({centre, node(0)});
  for (std::size_t k = 1; k < links.size(); ++k) {
    if (links[k].start()) {
      face.assign({centre, node(k)});
      continue;
    }
    face.push_back(node(k));
    // A chain that closes on itself repeats its first node without the mark of a spoke.
    const bool chain_ends = k + 1 == links.size() ? links.front().start() : links[k + 1].start();
    if (!links[k].spoke() && !links[k].cut() && !chain_ends) continue;
    use(face);
    face.assign({centre, node(k)});
  }
  if (links.front().start()) return;
  face.push_back(node(0));
  use(face);
}

/// Cuts polygons into triangles, ear by ear.
class EarClipper {
 public:
  EarClipper(std::vector<std::uint32_t> edges, MeshBuilder& builder) : edges_(std::move(edges)), builder_(&builder) {}

  /// Empties the face.
  void cut(std::vector<Index>& face) {
    while (face.size() > small_polygon) {
      // In pairs: the first node of each is left, the second cut off.
      std::size_t left = 0;
      for (std::size_t k = 0; k + 1 < face.size(); k += 2) {
        add(face[k], face[k + 1], face[k + 2 < face.size() ? k + 2 : 0]);
        face[left++] = face[k];
      }
      if (face.size() % 2 != 0) face[left++] = face.back();
      face.resize(left);
    }
    while (face.size() > 3) {
      const std::size_t last = face.size() - 1;
      const auto before = [&](std::size_t k) { return face[k > 0 ? k - 1 : last]; };
      const auto after = [&](std::size_t k) { return face[k < last ? k + 1 : 0]; };
      std::size_t best = 0;
      long lowest = std::numeric_limits<long>::max();
      for (std::size_t k = 0; k <= last; ++k) {
        const long cost = edges(before(k)) + edges(after(k)) - edges(face[k]);
        if (cost >= lowest) continue;
        lowest = cost;
        best = k;
      }
      add(before(best), face[best], after(best));
      face.erase(face.begin() + static_cast<std::ptrdiff_t>(best));
    }
    add_triangle(face[0], face[1], face[2]);
    face.clear();
  }

 private:
  [[nodiscard]] long edges(Index node) const { return edges_[static_cast<std::size_t>(node)]; }
  /// Cuts off the ear at b by an edge from a to c.
  void add(Index a, Index b, Index c) {
    ++edges_[static_cast<std::size_t>(a)];
    ++edges_[static_cast<std::size_t>(c)];
    add_triangle(a, b, c);
  }
  void add_triangle(Index a, Index b, Index c) {
    if (a != b && b != c && c != a) builder_->add_face({a, b, c});
  }

  std::vector<std::uint32_t> edges_;
  MeshBuilder* builder_;
};

}  // namespace

PolygonMesh triangulated_patch(const Net& net) {
  std::vector<Index> face;
  std::vector<std::uint32_t> faces_at(net.positions.size(), 0);
  // Nodes with rings have the lowest numbers, so the node of a face with the lowest one has it in its ring.
  const auto for_each_own_face = [&](const auto& use) {
    for (std::size_t i = 0; i < net.computed; ++i) {
      for_each_face(net, i, face, [&](std::vector<Index>& own) {
        if (own.size() >= 3 && *std::min_element(own.begin(), own.end()) == own.front()) use(own);
      });
    }
  };
  for_each_own_face([&](const std::vector<Index>& own) {
    for (const Index node : own) ++faces_at[static_cast<std::size_t>(node)];
  });
  MeshBuilder builder;
  for (const Vector3& position : net.positions) builder.add_node(position);
  EarClipper cutter(std::move(faces_at), builder);
  for_each_own_face([&](std::vector<Index>& own) { cutter.cut(own); });
  return builder.take();
}

}  // namespace vspring
