#include "span/patches.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/disjoint_sets.hpp"
#include "fill/refinement.hpp"
#include "fill/rim_triangles.hpp"

namespace vspring {

namespace {

constexpr double cosine_of_corners = 0.866;  // of 30°
constexpr double most_ratio_of_opposite = 2.5;

/// Whether opposite sides of a loop of four may have the same numbers of edges.
bool are_opposite(const std::vector<Index>& a, const std::vector<Index>& b, const Arcs& arcs) {
  if (a.size() != b.size()) return false;
  for (std::size_t k = 0; k < a.size(); ++k) {
    const auto [least, most] = std::minmax(arcs.of(a[k]).length, arcs.of(b[b.size() - 1 - k]).length);
    if (!(most < most_ratio_of_opposite * least)) return false;
  }
  return true;
}

}  // namespace

Sides sides_of(const Loop& loop, const Arcs& arcs) {
  const std::vector<Index>& halves = loop.halves;
  const auto begins_side = [&](std::size_t k) {
    const Index before = halves[(k + halves.size() - 1) % halves.size()];
    if (arcs.goes_on(before, halves[k])) return false;
    return -arcs.leaving(Arcs::reversed(before)).dot(arcs.leaving(halves[k])) < cosine_of_corners;
  };
  std::size_t first = 0;
  while (first < halves.size() && !begins_side(first)) ++first;
  Sides result;
  for (std::size_t k = 0; k < halves.size(); ++k) {
    const std::size_t at = (first + k) % halves.size();
    if (k == 0 || begins_side(at)) result.sides.emplace_back();
    result.sides.back().push_back(halves[at]);
  }
  return result;
}

std::vector<Index> edges_of_arcs(const Arcs& arcs, const std::vector<Sides>& loops, double edge_length) {
  const std::size_t count = arcs.all().size();
  DisjointSets alike(count);
  for (const Sides& loop : loops) {
    if (loop.sides.size() != 4) continue;
    for (const std::size_t k : {std::size_t{0}, std::size_t{1}}) {
      const auto& a = loop.sides[k];
      const auto& b = loop.sides[k + 2];
      if (!are_opposite(a, b, arcs)) continue;
      for (std::size_t l = 0; l < a.size(); ++l)
        alike.join(static_cast<std::size_t>(a[l] / 2), static_cast<std::size_t>(b[b.size() - 1 - l] / 2));
    }
  }
  std::vector<double> sum(count, 0);
  std::vector<double> members(count, 0);
  std::vector<Index> least(count, 1);
  for (std::size_t a = 0; a < count; ++a) {
    const std::size_t set = alike.find(a);
    sum[set] += arcs.all()[a].length;
    members[set] += 1;
    if (arcs.all()[a].nodes.front() == arcs.all()[a].nodes.back()) least[set] = 3;
  }
  std::vector<Index> edges(count);
  for (std::size_t a = 0; a < count; ++a) {
    const std::size_t set = alike.find(a);
    edges[a] = std::max(least[set], static_cast<Index>(std::lround(sum[set] / members[set] / edge_length)));
  }
  return edges;
}

FaceMaker::FaceMaker(const CurveNodes& nodes) : nodes_(nodes), joined_(nodes.places.size()) {
  for (const auto& along : nodes.of_arc) {
    for (std::size_t k = 0; k + 1 < along.size(); ++k) {
      joined_[static_cast<std::size_t>(along[k])].push_back(along[k + 1]);
      joined_[static_cast<std::size_t>(along[k + 1])].push_back(along[k]);
    }
  }
}

std::vector<Index> FaceMaker::nodes_along(const std::vector<Index>& halves) const {
  std::vector<Index> nodes;
  for (const Index half : halves) {
    const std::vector<Index> along = nodes_.along(half);
    nodes.insert(nodes.end(), along.begin() + (nodes.empty() ? 0 : 1), along.end());
  }
  return nodes;
}

std::string FaceMaker::span(const Sides& loop, bool are_fine, LoopFaces& made) {
  std::vector<std::vector<Index>> sides;
  for (const auto& side : loop.sides) sides.push_back(nodes_along(side));
  made = {};
  made.is_grid = sides.size() == 4 && sides[0].size() == sides[2].size() && sides[1].size() == sides[3].size();
  if (made.is_grid) {
    make_grid(sides, made);
    return {};
  }
  std::vector<Index> rim;
  for (const auto& side : sides) rim.insert(rim.end(), side.begin(), side.end() - 1);
  return make_triangles(rim, are_fine, made);
}

// The sum of what rules between both pairs of sides give, less the bilinear surface through the corners (Coons 1967).
void FaceMaker::make_grid(const std::vector<std::vector<Index>>& sides, LoopFaces& made) const {
  const std::size_t n = sides[0].size() - 1;
  const std::size_t m = sides[1].size() - 1;
  std::vector<Index> grid((n + 1) * (m + 1), -1);
  const auto at = [&](std::size_t i, std::size_t j) -> Index& { return grid[j * (n + 1) + i]; };
  for (std::size_t i = 0; i <= n; ++i) {
    at(i, 0) = sides[0][i];
    at(i, m) = sides[2][n - i];
  }
  for (std::size_t j = 0; j <= m; ++j) {
    at(n, j) = sides[1][j];
    at(0, j) = sides[3][m - j];
  }
  for (std::size_t j = 1; j < m; ++j) {
    const double v = static_cast<double>(j) / static_cast<double>(m);
    for (std::size_t i = 1; i < n; ++i) {
      const double u = static_cast<double>(i) / static_cast<double>(n);
      const Vector3 ruled =
          (1 - v) * place(at(i, 0)) + v * place(at(i, m)) + (1 - u) * place(at(0, j)) + u * place(at(n, j));
      const Vector3 corners = (1 - v) * ((1 - u) * place(at(0, 0)) + u * place(at(n, 0))) +
                              v * ((1 - u) * place(at(0, m)) + u * place(at(n, m)));
      at(i, j) = static_cast<Index>(nodes_.places.size() + made.places.size());
      made.places.push_back(ruled - corners);
    }
  }
  for (std::size_t j = 0; j < m; ++j) {
    for (std::size_t i = 0; i < n; ++i)
      made.corners.insert(made.corners.end(), {at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
  }
}

std::string FaceMaker::make_triangles(const std::vector<Index>& nodes, bool are_fine, LoopFaces& made) {
  const std::size_t count = nodes.size();
  std::map<Index, Index> place_in_rim;
  for (std::size_t k = 0; k < count; ++k) {
    if (!place_in_rim.emplace(nodes[k], static_cast<Index>(k)).second) return "it comes to one node twice";
  }
  Rim rim;
  Patch patch;
  for (std::size_t k = 0; k < count; ++k) {
    const Index before = nodes[(k + count - 1) % count];
    const Index after = nodes[(k + 1) % count];
    rim.places.push_back(place(nodes[k]));
    patch.spacing.push_back(((place(before) - place(nodes[k])).norm() + (place(after) - place(nodes[k])).norm()) / 2);
    patch.like.push_back(static_cast<Index>(k));
    auto& others = rim.joined.emplace_back();
    for (const Index other : joined_[static_cast<std::size_t>(nodes[k])]) {
      const auto found = place_in_rim.find(other);
      if (found != place_in_rim.end() && other != before && other != after) others.push_back(found->second);
    }
    std::sort(others.begin(), others.end());
  }
  rim.normals.assign(count, Vector3::Zero());
  RimTriangles triangulation = triangulate(rim);
  if (triangulation.triangles.empty())
    return "no triangles fit in, as each set of them needs an edge that is there already";
  if (triangulation.is_folded) return "each set of triangles in it folds back onto itself";
  patch.places = patch.flat = std::move(rim.places);
  patch.triangles = std::move(triangulation.triangles);
  if (are_fine) refine(patch, rim.joined);
  made.places.assign(patch.places.begin() + static_cast<std::ptrdiff_t>(count), patch.places.end());
  const auto number = [&](Index k) {
    const auto within = static_cast<Index>(nodes_.places.size() - count);
    return static_cast<std::size_t>(k) < count ? nodes[static_cast<std::size_t>(k)] : within + k;
  };
  for (const auto& triangle : patch.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Index a = number(triangle[c]);
      made.corners.push_back(a);
      if (!are_fine) continue;
      const Index b = number(triangle[(c + 1) % 3]);
      if (a >= static_cast<Index>(joined_.size()) || b >= static_cast<Index>(joined_.size())) continue;
      joined_[static_cast<std::size_t>(a)].push_back(b);
      joined_[static_cast<std::size_t>(b)].push_back(a);
    }
  }
  return {};
}

PolygonMesh mesh_of(const CurveNodes& nodes, const std::vector<LoopFaces>& faces, std::vector<NetworkLoop>& loops) {
  std::vector<Vector3> places = nodes.places;
  std::vector<Index> face_begin = {0};
  std::vector<Index> corners;
  const auto on_curves = static_cast<Index>(nodes.places.size());
  for (std::size_t l = 0; l < loops.size(); ++l) {
    NetworkLoop& loop = loops[l];
    loop.is_grid = false;
    loop.first_node = loop.first_face = -1;
    loop.node_count = loop.face_count = 0;
    if (loop.state != LoopState::spanned) continue;
    loop.is_grid = faces[l].is_grid;
    loop.first_node = static_cast<Index>(places.size());
    loop.first_face = static_cast<Index>(face_begin.size()) - 1;
    const Index offset = loop.first_node - on_curves;
    places.insert(places.end(), faces[l].places.begin(), faces[l].places.end());
    for (std::size_t k = 0; k < faces[l].corners.size(); ++k) {
      const Index node = faces[l].corners[k];
      corners.push_back(node < on_curves ? node : node + offset);
      if ((k + 1) % faces[l].sides() == 0) face_begin.push_back(static_cast<Index>(corners.size()));
    }
    loop.node_count = static_cast<Index>(places.size()) - loop.first_node;
    loop.face_count = static_cast<Index>(face_begin.size()) - 1 - loop.first_face;
  }
  return {std::move(places), std::move(face_begin), std::move(corners)};
}

}  // namespace vspring
