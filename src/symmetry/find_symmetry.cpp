#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <utility>

#include "shape/edges.hpp"
#include "shape/incidence.hpp"
#include "symmetry/pairs.hpp"
#include "symmetry/reach.hpp"
#include "vspring/error.hpp"
#include "vspring/symmetry.hpp"

namespace vspring {

namespace {

[[noreturn]] void refuse_half(const std::string& message) { throw Error(ErrorCode::unusable_shape, message); }

/// Makes all but the faces or chains of the whole: nodes with their partners, those of the mirror image after the given
/// ones.
template <typename Shape>
Symmetric<Shape> with_partners(const Shape& shape, const MirrorPlane& plane, const Reach& reach,
                               std::vector<Vector3>& positions) {
  Symmetric<Shape> symmetric{.plane = plane, .given = shape, .is_half = true, .whole = {}, .partner = {}};
  positions = shape.positions();
  symmetric.partner.assign(positions.size(), -1);
  for (Index i = 0; i < shape.node_count(); ++i) {
    const auto node = static_cast<std::size_t>(i);
    if (reach.has_edge[node] == 0) continue;
    if (reach.on_plane(i)) {
      positions[node] = plane.projected(positions[node]);
      symmetric.partner[node] = i;
      ++symmetric.on_plane;
      continue;
    }
    symmetric.partner[node] = static_cast<Index>(positions.size());
    symmetric.partner.push_back(i);
    positions.push_back(plane.mirrored(shape.position(i)));
    ++symmetric.pairs;
  }
  return symmetric;
}

/// Refuses nodes on the plane at which a half cannot be joined.
void check_seam(const PolygonMesh& mesh, const MirrorPlane& plane, const Reach& reach) {
  const Incidence incidence(mesh);
  EdgeFinder edges(mesh, incidence);
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (!reach.on_plane(i)) continue;
    bool is_seam = false;
    edges.at_node(i, [&](Index neighbour, std::span<const EdgeUse> uses) {
      if (!reach.on_plane(neighbour)) return;
      if (uses.size() != 1)
        refuse_half(
            fmt::format("the edge between nodes {} and {} lies in {}, but faces go on beyond it or in it: a half has "
                        "only boundary edges there; leave out the faces in the plane",
                        i, neighbour, in_words(plane)));
      is_seam = true;
    });
    if (!is_seam)
      refuse_half(
          fmt::format("node {} lies in {}, but no boundary edge there leads to it, so a half cannot be joined with its "
                      "mirror image at it; give another plane, or move the node off it",
                      i, in_words(plane)));
  }
}

/// Refuses nodes on the plane inside chains.
void check_seam(const PolygonCurve& curve, const MirrorPlane& plane, const Reach& reach) {
  for (const PolygonCurve::Chain& chain : curve.chains()) {
    const std::size_t count = chain.nodes.size();
    for (std::size_t k = 0; k < count; ++k) {
      const bool is_end = !chain.closed && (k == 0 || k + 1 == count);
      if (reach.on_plane(chain.nodes[k]) && !is_end)
        refuse_half(fmt::format("node {} lies in {}, but inside the curve: a half has only ends there", chain.nodes[k],
                                in_words(plane)));
    }
    if (count == 2 && reach.on_plane(chain.nodes[0]) && reach.on_plane(chain.nodes[1]))
      refuse_half(fmt::format("the edge between nodes {} and {} lies in {}: a half has only ends there", chain.nodes[0],
                              chain.nodes[1], in_words(plane)));
  }
}

// Joins halves with their mirror images.

Symmetric<PolygonMesh> symmetric_of_half(const PolygonMesh& mesh, const MirrorPlane& plane, const Reach& reach) {
  check_seam(mesh, plane, reach);
  std::vector<Vector3> positions;
  Symmetric<PolygonMesh> symmetric = with_partners(mesh, plane, reach, positions);
  std::vector<Index> corners = mesh.corners();
  std::vector<Index> face_begin = mesh.face_begin();
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    // In reverse order, so that both halves face to the same side. A face of fewer nodes has an empty image.
    for (std::size_t k = face.size(); face.size() >= 3 && k-- > 0;)
      corners.push_back(symmetric.partner[static_cast<std::size_t>(face[k])]);
    face_begin.push_back(static_cast<Index>(corners.size()));
  }
  symmetric.whole = PolygonMesh(std::move(positions), std::move(face_begin), std::move(corners));
  return symmetric;
}

Symmetric<PolygonCurve> symmetric_of_half(const PolygonCurve& curve, const MirrorPlane& plane, const Reach& reach) {
  check_seam(curve, plane, reach);
  std::vector<Vector3> positions;
  Symmetric<PolygonCurve> symmetric = with_partners(curve, plane, reach, positions);
  std::vector<PolygonCurve::Chain> chains;
  std::vector<PolygonCurve::Chain> images;
  for (const PolygonCurve::Chain& given : curve.chains()) {
    PolygonCurve::Chain chain = given;
    // It runs the other way, as it does where it goes on from the given one.
    std::vector<Index> image;
    for (auto node = given.nodes.rbegin(); node != given.nodes.rend(); ++node) {
      const Index partner = symmetric.partner[static_cast<std::size_t>(*node)];
      if (partner >= 0 && partner != *node) image.push_back(partner);
    }
    const bool has_edge = given.nodes.size() > 1;
    const bool begins = has_edge && reach.on_plane(given.nodes.front());
    const bool ends = has_edge && reach.on_plane(given.nodes.back());
    if (ends)
      chain.nodes.insert(chain.nodes.end(), image.begin(), image.end());
    else if (begins)
      chain.nodes.insert(chain.nodes.begin(), image.begin(), image.end());
    else if (has_edge)
      images.push_back({std::move(image), given.closed});
    chain.closed = given.closed || (begins && ends);
    chains.push_back(std::move(chain));
  }
  std::move(images.begin(), images.end(), std::back_inserter(chains));
  symmetric.whole = PolygonCurve(std::move(positions), std::move(chains));
  return symmetric;
}

template <typename Shape>
Symmetric<Shape> symmetry_of(const Shape& shape, const MirrorPlane& plane) {
  const Reach reach(shape, plane);
  return reach.is_half(plane) ? symmetric_of_half(shape, plane, reach) : symmetric_of_whole(shape, plane, reach);
}

}  // namespace

Symmetric<PolygonMesh> find_symmetry(const PolygonMesh& mesh, const MirrorPlane& plane) {
  return symmetry_of(mesh, plane);
}

Symmetric<PolygonCurve> find_symmetry(const PolygonCurve& curve, const MirrorPlane& plane) {
  return symmetry_of(curve, plane);
}

}  // namespace vspring
