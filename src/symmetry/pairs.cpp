#include "symmetry/pairs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include "shape/incidence.hpp"
#include "shape/point_tree.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

[[noreturn]] void refuse_whole(const std::string& message) {
  throw Error(ErrorCode::unusable_shape, message + "; give the plane in which it is symmetric, or one half of it");
}

std::string words_of(const Vector3& place) {
  return fmt::format("({:.6g}, {:.6g}, {:.6g})", place.x(), place.y(), place.z());
}

/// Finds the node at the mirror image of each node with an edge.
class PairFinder {
 public:
  PairFinder(const std::vector<Vector3>& positions, const MirrorPlane& plane, const Reach& reach)
      : positions_(positions), plane_(plane), nodes_(nodes_with_edge(reach)), places_(places()), tree_(places_) {}

  [[nodiscard]] std::vector<Index> find(const std::vector<double>& tolerances) const {
    std::vector<Index> partner(positions_.size(), -1);
    for (const Index node : nodes_) {
      const auto i = static_cast<std::size_t>(node);
      partner[i] = nearest(node, tolerances);
      if (partner[i] < 0)
        refuse_whole(
            fmt::format("node {} has no mirror image in {}: no node is within half the mean length of its edges "
                        "of {}",
                        node, in_words(plane_), words_of(plane_.mirrored(positions_[i]))));
    }
    for (const Index node : nodes_) {
      const Index other = partner[static_cast<std::size_t>(node)];
      const Index back = partner[static_cast<std::size_t>(other)];
      if (back == node) continue;
      if (positions_[static_cast<std::size_t>(back)] == positions_[static_cast<std::size_t>(node)])
        throw Error(ErrorCode::unusable_shape,
                    fmt::format("nodes {} and {} are at the same place, and which of them is the mirror image of node "
                                "{} in {} is not known",
                                std::min(back, node), std::max(back, node), other, in_words(plane_)),
                    {{Remedy::weld, "weld within 0"}});
      refuse_whole(
          fmt::format("node {} has no mirror image of its own in {}: the nearest to it, node {}, is that of node {}",
                      node, in_words(plane_), other, back));
    }
    return partner;
  }

 private:
  static std::vector<Index> nodes_with_edge(const Reach& reach) {
    std::vector<Index> nodes;
    for (std::size_t i = 0; i < reach.has_edge.size(); ++i) {
      if (reach.has_edge[i] != 0) nodes.push_back(static_cast<Index>(i));
    }
    return nodes;
  }

  [[nodiscard]] std::vector<Vector3> places() const {
    std::vector<Vector3> places;
    places.reserve(nodes_.size());
    for (const Index node : nodes_) places.push_back(positions_[static_cast<std::size_t>(node)]);
    return places;
  }

  /// The node nearest to a node's mirror image; −1: none is within the tolerances of both.
  [[nodiscard]] Index nearest(Index node, const std::vector<double>& tolerances) const {
    const Vector3 place = plane_.mirrored(positions_[static_cast<std::size_t>(node)]);
    const auto tolerance_at = [&](Index i) { return tolerances[static_cast<std::size_t>(i)]; };
    std::vector<Index> near;
    tree_.within(place, tolerance_at(node), near);
    std::pair<double, Index> best(std::numeric_limits<double>::infinity(), -1);
    for (const Index k : near) {
      const auto other = static_cast<std::size_t>(k);
      best = std::min(best, std::pair((places_[other] - place).squaredNorm(), nodes_[other]));
    }
    return best.second >= 0 && std::sqrt(best.first) <= tolerance_at(best.second) ? best.second : -1;
  }

  const std::vector<Vector3>& positions_;
  const MirrorPlane& plane_;
  std::vector<Index> nodes_;
  std::vector<Vector3> places_;
  PointTree tree_;
};

std::vector<Index> images_of(std::span<const Index> nodes, const std::vector<Index>& partner) {
  std::vector<Index> images;
  for (const Index node : nodes) images.push_back(partner[static_cast<std::size_t>(node)]);
  return images;
}

std::vector<Index> ascending(std::span<const Index> nodes) {
  std::vector<Index> sorted(nodes.begin(), nodes.end());
  std::sort(sorted.begin(), sorted.end());
  return sorted;
}

/// Refuses faces without a mirror image.
void check_edges(const PolygonMesh& mesh, const std::vector<Index>& partner, const MirrorPlane& plane) {
  const Incidence incidence(mesh);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    if (mesh.face(f).size() < 3) continue;
    const std::vector<Index> images = images_of(mesh.face(f), partner);
    const std::vector<Index> sorted = ascending(images);
    const auto corners = incidence.corners(images.front());
    const auto is_image = [&](const Corner& corner) {
      return mesh.face(corner.face).size() == sorted.size() && ascending(mesh.face(corner.face)) == sorted;
    };
    if (std::none_of(corners.begin(), corners.end(), is_image))
      refuse_whole(fmt::format("face {} has no mirror image in {}: no face has the nodes {}", f, in_words(plane),
                               fmt::join(sorted, ", ")));
  }
}

/// Refuses edges of curves without a mirror image.
void check_edges(const PolygonCurve& curve, const std::vector<Index>& partner, const MirrorPlane& plane) {
  std::vector<std::pair<Index, Index>> edges;
  for_each_edge(curve, [&](Index a, Index b) { edges.emplace_back(std::minmax(a, b)); });
  std::sort(edges.begin(), edges.end());
  for (const auto& [a, b] : edges) {
    const std::pair<Index, Index> image =
        std::minmax(partner[static_cast<std::size_t>(a)], partner[static_cast<std::size_t>(b)]);
    if (!std::binary_search(edges.begin(), edges.end(), image))
      refuse_whole(
          fmt::format("the edge between nodes {} and {} has no mirror image in {}: none is between nodes {} and {}", a,
                      b, in_words(plane), image.first, image.second));
  }
}

template <typename Shape>
Symmetric<Shape> pair_nodes(const Shape& shape, const MirrorPlane& plane, const Reach& reach) {
  Symmetric<Shape> symmetric{.plane = plane, .given = shape, .whole = shape, .partner = {}};
  symmetric.partner = PairFinder(shape.positions(), plane, reach).find(pair_tolerances(shape));
  check_edges(shape, symmetric.partner, plane);
  for (Index i = 0; i < shape.node_count(); ++i) {
    symmetric.on_plane += symmetric.partner[static_cast<std::size_t>(i)] == i ? 1 : 0;
    symmetric.pairs += symmetric.partner[static_cast<std::size_t>(i)] > i ? 1 : 0;
  }
  std::vector<Vector3> positions = shape.positions();
  make_symmetric(symmetric, positions);
  symmetric.whole.set_positions(std::move(positions));
  return symmetric;
}

}  // namespace

Symmetric<PolygonMesh> symmetric_of_whole(const PolygonMesh& mesh, const MirrorPlane& plane, const Reach& reach) {
  return pair_nodes(mesh, plane, reach);
}

Symmetric<PolygonCurve> symmetric_of_whole(const PolygonCurve& curve, const MirrorPlane& plane, const Reach& reach) {
  return pair_nodes(curve, plane, reach);
}

}  // namespace vspring
