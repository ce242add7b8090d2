#include "levels/patch_mesh.hpp"

#include <algorithm>
#include <limits>
#include <utility>

#include "base/cancellation.hpp"

namespace vspring {

namespace {

// In polygons up to this size the best ear is cut; larger ones lose every second node at a time.
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
    // A closed chain repeats its first node without the mark of a spoke.
    const bool chain_ends = k + 1 == links.size() ? links.front().start() : links[k + 1].start();
    if (!links[k].spoke() && !links[k].cut() && !chain_ends) continue;
    use(face);
    face.assign({centre, node(k)});
  }
  if (links.front().start()) return;
  face.push_back(node(0));
  use(face);
}

/// Collects triangles, except those with a node twice.
class TriangleList {
 public:
  explicit TriangleList(std::size_t nodes) { corners_.reserve(3 * faces_per_node * nodes); }

  void add(Index a, Index b, Index c) {
    if (a != b && b != c && c != a) corners_.insert(corners_.end(), {a, b, c});
  }

  [[nodiscard]] PolygonMesh take(const std::vector<Vector3>& positions) && {
    std::vector<Index> face_begin(corners_.size() / 3 + 1);
    for (std::size_t f = 0; f < face_begin.size(); ++f) face_begin[f] = static_cast<Index>(3 * f);
    return {positions, std::move(face_begin), std::move(corners_)};
  }

 private:
  // About as many as closed surfaces have.
  static constexpr std::size_t faces_per_node = 2;

  std::vector<Index> corners_;
};

/// Cuts polygons into triangles, ear by ear.
class EarClipper {
 public:
  EarClipper(std::vector<std::uint32_t> edges, TriangleList& triangles)
      : edges_(std::move(edges)), triangles_(&triangles) {}

  /// Empties the face.
  void cut(std::vector<Index>& face) {
    while (face.size() > small_polygon) {
      // In pairs: the first node of each is kept, the second cut off.
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
    triangles_->add(face[0], face[1], face[2]);
    face.clear();
  }

 private:
  [[nodiscard]] long edges(Index node) const { return edges_[static_cast<std::size_t>(node)]; }
  /// Cuts off the ear at b by an edge from a to c.
  void add(Index a, Index b, Index c) {
    ++edges_[static_cast<std::size_t>(a)];
    ++edges_[static_cast<std::size_t>(c)];
    triangles_->add(a, b, c);
  }

  std::vector<std::uint32_t> edges_;
  TriangleList* triangles_;
};

bool has_triangles_alone(const Net& net) {
  for (std::size_t i = 0; i < net.computed; ++i) {
    end_if_cancelled_at(i);
    const auto links = net.rings.links(i);
    if (!std::all_of(links.begin(), links.end(), [](Link link) { return link.spoke(); })) return false;
  }
  return true;
}

// Each face is added at its node with the lowest number: that one has a ring, as nodes with rings have the lowest
// numbers.

void add_triangles(const Net& net, TriangleList& triangles) {
  for (std::size_t i = 0; i < net.computed; ++i) {
    end_if_cancelled_at(i);
    const auto links = net.rings.links(i);
    const auto add = [&](std::size_t a, std::size_t b) {
      if (i < a && i < b) triangles.add(static_cast<Index>(i), static_cast<Index>(a), static_cast<Index>(b));
    };
    for (std::size_t k = 1; k < links.size(); ++k) {
      if (!links[k].start()) add(links[k - 1].node(), links[k].node());
    }
    if (!links.empty() && !links.front().start()) add(links.back().node(), links.front().node());
  }
}

void cut_polygons(const Net& net, TriangleList& triangles) {
  std::vector<Index> face;
  std::vector<std::uint32_t> faces_at(net.positions.size(), 0);
  const auto for_each_own_face = [&](const auto& use) {
    for (std::size_t i = 0; i < net.computed; ++i) {
      end_if_cancelled_at(i);
      for_each_face(net, i, face, [&](std::vector<Index>& own) {
        if (own.size() >= 3 && *std::min_element(own.begin(), own.end()) == own.front()) use(own);
      });
    }
  };
  for_each_own_face([&](const std::vector<Index>& own) {
    for (const Index node : own) ++faces_at[static_cast<std::size_t>(node)];
  });
  EarClipper cutter(std::move(faces_at), triangles);
  for_each_own_face([&](std::vector<Index>& own) { cutter.cut(own); });
}

}  // namespace

PolygonMesh triangulated_patch(const Net& net) {
  TriangleList triangles(net.positions.size());
  if (has_triangles_alone(net))
    add_triangles(net, triangles);
  else
    cut_polygons(net, triangles);
  end_if_cancelled();
  return std::move(triangles).take(net.positions);
}

}  // namespace vspring
