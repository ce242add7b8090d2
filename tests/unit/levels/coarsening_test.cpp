#include "levels/coarsening.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>

#include "levels/patch_mesh.hpp"
#include "unit/levels/zoo.hpp"
#include "vspring/topology.hpp"

namespace vspring::coarsening_test {
namespace {

using Kind = Triangulation::Kind;

/// All nodes of a mesh, free to move.
PolygonMesh triangulated(const PolygonMesh& mesh) {
  const Constraints constraints(mesh.node_count());
  const Net net = gather_net(mesh, constraints);
  return triangulated_patch(net);
}

struct Coarse {
  Triangulation triangulation;
  std::vector<std::uint8_t> kept;
  std::vector<Removals> removals;
};

Coarse coarsened(Triangulation triangulation, int threads = 1) {
  ThreadTeam team(threads);
  auto kept = choose_coarse_nodes(triangulation, std::vector<std::uint8_t>(triangulation.size(), 0));
  auto removals = coarsen(triangulation, kept, team);
  return {std::move(triangulation), std::move(kept), std::move(removals)};
}

Coarse coarsened(const PolygonMesh& triangles, int threads = 1) {
  ThreadTeam team(threads);
  return coarsened(Triangulation(triangles, team), threads);
}

/// The next level's own triangulation.
Triangulation compacted(const Coarse& coarse) {
  std::vector<std::uint32_t> nodes;
  std::vector<std::uint32_t> number(coarse.kept.size(), 0);
  for (std::uint32_t i = 0; i < coarse.kept.size(); ++i) {
    if (coarse.kept[i] == 0) continue;
    number[i] = static_cast<std::uint32_t>(nodes.size());
    nodes.push_back(i);
  }
  ThreadTeam team(1);
  return {coarse.triangulation, nodes, number, team};
}

/// Triangles as its rings tell them; each must be told by all three nodes.
PolygonMesh mesh_of(const Triangulation& triangulation) {
  std::map<std::set<std::size_t>, int> told;
  MeshBuilder builder;
  for (std::size_t i = 0; i < triangulation.size(); ++i) builder.add_node(Vector3::Zero());
  for (std::size_t i = 0; i < triangulation.size(); ++i) {
    const auto ring = triangulation.ring(i);
    const bool closed = triangulation.kind(i) == Kind::closed;
    for (std::size_t k = 0; k + (closed ? 0 : 1) < ring.size(); ++k) {
      const std::size_t a = ring[k];
      const std::size_t b = ring[(k + 1) % ring.size()];
      if (++told[{i, a, b}] == 1)
        builder.add_face({static_cast<Index>(i), static_cast<Index>(a), static_cast<Index>(b)});
    }
  }
  for (const auto& [nodes, times] : told) {
    EXPECT_EQ(nodes.size(), 3U);
    EXPECT_EQ(times, 3);
  }
  return builder.take();
}

struct Topology {
  Index characteristic = 0;
  std::size_t loops = 0;
  Index components = 0;
  std::vector<std::string> defects;
};

Topology topology(const PolygonMesh& mesh) {
  Topology result;
  std::set<std::pair<Index, Index>> edges;
  std::set<Index> used;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      const Index a = face[k];
      const Index b = face[(k + 1) % face.size()];
      edges.insert({std::min(a, b), std::max(a, b)});
      used.insert(a);
    }
  }
  result.characteristic = static_cast<Index>(used.size()) - static_cast<Index>(edges.size()) + mesh.face_count();
  result.loops = boundary_loops(mesh).size();
  const auto component = components(mesh);
  std::set<Index> different;
  for (const Index i : used) different.insert(component[static_cast<std::size_t>(i)]);
  result.components = static_cast<Index>(different.size());
  for (const Defect& defect : check(mesh)) {
    using DefectKind = Defect::Kind;
    // Positions are all the same here, and one-sided surfaces have no orientation.
    if (defect.kind == DefectKind::isolated_node || defect.kind == DefectKind::orientation ||
        defect.kind == DefectKind::zero_length_edge || defect.kind == DefectKind::zero_area_face)
      continue;
    result.defects.push_back(defect.message());
  }
  return result;
}

class EverySurface : public testing::TestWithParam<std::size_t> {
 protected:
  static const std::vector<zoo::Shape>& shapes() {
    static const std::vector<zoo::Shape> all = zoo::surfaces();
    return all;
  }
  [[nodiscard]] const zoo::Shape& shape() const { return shapes()[GetParam()]; }
};

INSTANTIATE_TEST_SUITE_P(Zoo, EverySurface, testing::Range<std::size_t>(0, zoo::surfaces().size()));

TEST_P(EverySurface, StaysASurfaceOfItsTopologyOnEveryLevel) {
  SCOPED_TRACE(shape().name);
  const Topology whole = topology(shape().mesh);
  const PolygonMesh triangles = triangulated(shape().mesh);
  ThreadTeam team(1);
  Triangulation level(triangles, team);
  for (int k = 0; k < 8; ++k) {
    const Topology now = topology(mesh_of(level));
    EXPECT_EQ(now.characteristic, whole.characteristic) << "level " << k;
    EXPECT_EQ(now.loops, whole.loops) << "level " << k;
    EXPECT_EQ(now.components, whole.components) << "level " << k;
    EXPECT_EQ(now.defects, std::vector<std::string>()) << "level " << k;
    level = compacted(coarsened(level));
  }
}

TEST_P(EverySurface, LosesAboutThreeOfFourNodesAndKeepsValencesNearSix) {
  SCOPED_TRACE(shape().name);
  ThreadTeam team(1);
  Triangulation level(triangulated(shape().mesh), team);
  while (level.size() > 400) {
    const Triangulation next = compacted(coarsened(level));
    const double factor = static_cast<double>(level.size()) / static_cast<double>(next.size());
    EXPECT_GT(factor, 2.5) << "from " << level.size();
    EXPECT_LT(factor, 5.5) << "from " << level.size();
    level = next;
    double irregular = 0;
    for (std::size_t i = 0; i < level.size(); ++i) {
      const std::size_t valence = level.ring(i).size();
      EXPECT_GE(valence, level.kind(i) == Kind::closed ? 3U : 2U);
      const std::size_t wanted = level.kind(i) == Kind::closed ? 6 : 4;
      irregular += valence + 1 < wanted || valence > wanted + 1 ? 1 : 0;
    }
    EXPECT_LT(irregular, 0.08 * static_cast<double>(level.size())) << "of " << level.size();
  }
}

TEST_P(EverySurface, BoundaryLoopsLoseEverySecondNodeDownToSix) {
  SCOPED_TRACE(shape().name);
  ThreadTeam team(1);
  const Triangulation fine(triangulated(shape().mesh), team);
  const Triangulation coarse = compacted(coarsened(fine));
  const auto before = boundary_loops(mesh_of(fine));
  const auto after = boundary_loops(mesh_of(coarse));
  ASSERT_EQ(before.size(), after.size());
  std::vector<std::size_t> expected;
  std::vector<std::size_t> found;
  expected.reserve(before.size());
  for (const auto& loop : before) expected.push_back(std::max(std::min<std::size_t>(loop.size(), 6), loop.size() / 2));
  found.reserve(after.size());
  for (const auto& loop : after) found.push_back(loop.size());
  std::sort(expected.begin(), expected.end());
  std::sort(found.begin(), found.end());
  for (std::size_t k = 0; k < found.size(); ++k) {
    EXPECT_GE(found[k], expected[k]);
    EXPECT_LE(found[k], expected[k] + 1);
  }
}

TEST_P(EverySurface, ParentsAreThereWhenTheyAreNeeded) {
  SCOPED_TRACE(shape().name);
  const Coarse coarse = coarsened(triangulated(shape().mesh));
  std::vector<std::uint8_t> there = coarse.kept;
  const auto restore = [&](const Removals& group) {
    for (std::size_t k = group.size(); k-- > 0;) {
      EXPECT_GE(group.parents_of(k).size(), 2U);
      for (const std::uint32_t parent : group.parents_of(k)) EXPECT_EQ(there[parent], 1);
      EXPECT_EQ(there[group.nodes[k]], 0);
      there[group.nodes[k]] = 1;
    }
  };
  restore(coarse.removals.back());
  for (std::size_t g = 0; g + 1 < coarse.removals.size(); ++g) restore(coarse.removals[g]);
  EXPECT_EQ(std::count(there.begin(), there.end(), 0), 0);
}

TEST(Coarsening, GoesOnInRowsOnARegularLattice) {
  // Hexagons cut from a brick wall make no lattice of triangles, but triangles of one diagonal do.
  MeshBuilder builder;
  constexpr Index size = 60;
  for (Index r = 0; r < size; ++r) {
    for (Index c = 0; c < size; ++c) builder.add_node({static_cast<double>(c), static_cast<double>(r), 0});
  }
  for (Index r = 0; r + 1 < size; ++r) {
    for (Index c = 0; c + 1 < size; ++c) {
      const Index corner = r * size + c;
      builder.add_face({corner, corner + 1, corner + size + 1});
      builder.add_face({corner, corner + size + 1, corner + size});
    }
  }
  const Triangulation coarse = compacted(coarsened(triangulated(builder.take())));
  std::size_t regular = 0;
  std::size_t inside = 0;
  for (std::size_t i = 0; i < coarse.size(); ++i) {
    if (coarse.kind(i) != Kind::closed) continue;
    ++inside;
    regular += coarse.ring(i).size() == 6 ? 1 : 0;
  }
  EXPECT_GT(static_cast<double>(regular), 0.9 * static_cast<double>(inside));
}

TEST(CoarseningThreads, GiveTheSameLevelsForEveryNumber) {
  const PolygonMesh triangles = triangulated(generate::annulus({.nodes = 40000}));
  const Coarse one = coarsened(triangles, 1);
  EXPECT_GT(one.removals.size(), 5U);
  for (const int threads : {2, 3}) {
    const Coarse more = coarsened(triangles, threads);
    EXPECT_EQ(one.kept, more.kept);
    ASSERT_EQ(one.removals.size(), more.removals.size());
    for (std::size_t g = 0; g < one.removals.size(); ++g) {
      EXPECT_EQ(one.removals[g].nodes, more.removals[g].nodes);
      EXPECT_EQ(one.removals[g].parents, more.removals[g].parents);
    }
    for (std::size_t i = 0; i < one.triangulation.size(); ++i) {
      const auto a = one.triangulation.ring(i);
      const auto b = more.triangulation.ring(i);
      EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end()));
    }
  }
}

TEST(Coarsening, LeavesSpotsThatAreNotManifoldAlone) {
  // Two discs that share one node, and a sheet standing on an edge of the first.
  const PolygonMesh disc = generate::flat_disc({.nodes = 500});
  MeshBuilder builder;
  for (const Vector3& position : disc.positions()) builder.add_node(position);
  for (const Vector3& position : disc.positions()) builder.add_node(position + Vector3(0, 0, 1));
  for (Index f = 0; f < disc.face_count(); ++f) {
    const auto face = disc.face(f);
    builder.add_face(face);
    std::vector<Index> other(face.begin(), face.end());
    for (Index& node : other) node = node == 0 ? 0 : node + disc.node_count();
    builder.add_face(other);
  }
  const Index standing = builder.add_node({0, 0, 2});
  const Index a = disc.face(300)[0];
  const Index b = disc.face(300)[1];
  builder.add_face({a, b, standing});
  const PolygonMesh mesh = builder.take();
  ThreadTeam team(1);
  const Triangulation fine(mesh, team);
  const Coarse coarse = coarsened(fine);
  for (const Index node : {Index{0}, a, b}) {
    const auto i = static_cast<std::size_t>(node);
    EXPECT_EQ(fine.kind(i), Kind::fixed);
    fine.for_each_neighbour(i, [&](std::size_t j) { EXPECT_EQ(coarse.kept[j], 1); });
    EXPECT_TRUE(std::equal(fine.ring(i).begin(), fine.ring(i).end(), coarse.triangulation.ring(i).begin(),
                           coarse.triangulation.ring(i).end()));
  }
  EXPECT_LT(std::count(coarse.kept.begin(), coarse.kept.end(), 1), 0.4 * static_cast<double>(fine.size()));
}

TEST(Coarsening, KeepsConstrainedNodesThatAreNotNeighbours) {
  const PolygonMesh triangles = triangulated(generate::torus({.columns = 40, .rows = 20}));
  ThreadTeam team(1);
  const Triangulation fine(triangles, team);
  std::vector<std::uint8_t> constrained(fine.size(), 0);
  for (std::size_t i = 0; i < fine.size(); i += 97) constrained[i] = 1;
  const auto kept = choose_coarse_nodes(fine, constrained);
  for (std::size_t i = 0; i < fine.size(); i += 97) EXPECT_EQ(kept[i], 1);
}

TEST(PatchMesh, CutsEveryPolygonIntoTrianglesOfFewEdgesANode) {
  for (const int sides : {4, 5, 8, 9, 31, 1000}) {
    MeshBuilder builder;
    std::vector<Index> face;
    face.reserve(static_cast<std::size_t>(sides));
    for (int k = 0; k < sides; ++k) face.push_back(builder.add_node({std::cos(k), std::sin(k), 0}));
    builder.add_face(face);
    const PolygonMesh triangles = triangulated(builder.take());
    EXPECT_EQ(triangles.face_count(), sides - 2);
    std::vector<int> edges(static_cast<std::size_t>(sides), 1);
    for (const Index node : triangles.corners()) ++edges[static_cast<std::size_t>(node)];
    EXPECT_LE(*std::max_element(edges.begin(), edges.end()), 18);
    EXPECT_EQ(topology(triangles).defects, std::vector<std::string>());
  }
}

TEST(PatchMesh, LeavesNoNodeInsideWithTwoEdges) {
  // Two quads that share two edges.
  MeshBuilder builder;
  for (int k = 0; k < 5; ++k) builder.add_node({std::cos(k), std::sin(k), 0});
  builder.add_face({0, 1, 2, 3});
  builder.add_face({0, 3, 2, 4});
  const PolygonMesh triangles = triangulated(builder.take());
  EXPECT_EQ(topology(triangles).defects, std::vector<std::string>());
  EXPECT_EQ(triangles.face_count(), 4);
}

}  // namespace
}  // namespace vspring::coarsening_test
