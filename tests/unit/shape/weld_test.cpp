#include "vspring/weld.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "vspring/error.hpp"
#include "vspring/generate.hpp"
#include "vspring/topology.hpp"

namespace vspring::weld_test {
namespace {

/// Corners of its own for every face, up to `off` from the node along each axis, and the node that each was.
struct Soup {
  PolygonMesh mesh;
  std::vector<Index> node;
};

Soup soup_of(const PolygonMesh& mesh, double off = 0, std::uint64_t seed = 1) {
  std::mt19937_64 random(seed);
  const auto some = [&] { return off * (2 * static_cast<double>(random() >> 11U) * 0x1p-53 - 1); };
  std::vector<Vector3> positions;
  for (const Index node : mesh.corners()) positions.push_back(mesh.position(node) + Vector3(some(), some(), some()));
  std::vector<Index> corners(positions.size());
  std::iota(corners.begin(), corners.end(), 0);
  return {PolygonMesh(std::move(positions), mesh.face_begin(), std::move(corners)), mesh.corners()};
}

/// Whether what stands for corners parts them as the nodes that they were do.
void expect_same_groups(const std::vector<Index>& representative, const std::vector<Index>& node) {
  std::map<Index, Index> first;
  for (std::size_t k = 0; k < node.size(); ++k)
    ASSERT_EQ(representative[k], first.try_emplace(node[k], static_cast<Index>(k)).first->second) << k;
}

std::string fault(const PolygonMesh& mesh, double tolerance) {
  try {
    (void)weld(mesh, tolerance);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

PolygonMesh scaled(const PolygonMesh& mesh, double scale, double offset = 0) {
  PolygonMesh copy = mesh;
  std::vector<Vector3> positions = mesh.positions();
  for (Vector3& position : positions) position = scale * position + Vector3::Constant(offset);
  copy.set_positions(std::move(positions));
  return copy;
}

TEST(Weld, SoupsOfEverySizeBecomeTheirMesh) {
  const PolygonMesh torus = generate::torus({.columns = 12, .rows = 9});
  for (const double scale : {1e-150, 1.0, 1e150}) {
    for (const double off : {0.0, 1e-7}) {
      const Soup soup = soup_of(torus, off);
      const Welded welded = weld(scaled(soup.mesh, scale), off > 0 ? 1e-6 : 0);
      expect_same_groups(welded.representative, soup.node);
      EXPECT_EQ(welded.joined, soup.mesh.node_count() - torus.node_count());
      EXPECT_EQ(welded.mesh.node_count(), soup.mesh.node_count());
      EXPECT_EQ(welded.mesh.face_begin(), torus.face_begin());
      EXPECT_TRUE(boundary_loops(welded.mesh).empty());
      EXPECT_TRUE(welded.collapsed.empty());
      EXPECT_EQ(welded.mesh.positions(), scaled(soup.mesh, scale).positions());
    }
  }
  expect_same_groups(weld(scaled(soup_of(torus).mesh, 1, 1e6), 1e-7).representative, torus.corners());
}

TEST(Weld, GroupsDoNotDependOnTheOrderOfNodes) {
  const PolygonMesh plane = generate::plane({.columns = 9, .rows = 9});
  // Distances between corners of a node are some less and some more than the tolerance.
  const Soup soup = soup_of(plane, 0.01);
  const auto groups = [](const Welded& welded, const std::vector<Index>& number) {
    std::map<Index, std::set<Index>> members;
    for (std::size_t k = 0; k < number.size(); ++k) members[welded.representative[k]].insert(number[k]);
    std::set<std::set<Index>> all;
    for (const auto& [first, those] : members) all.insert(those);
    return all;
  };
  std::vector<Index> same(soup.node.size());
  std::iota(same.begin(), same.end(), 0);
  const auto expected = groups(weld(soup.mesh, 0.011), same);
  EXPECT_GT(expected.size(), static_cast<std::size_t>(plane.node_count()));
  EXPECT_LT(expected.size(), same.size());
  std::mt19937_64 random(3);
  for (int k = 0; k < 3; ++k) {
    std::vector<Index> number = same;
    std::shuffle(number.begin(), number.end(), random);
    std::vector<Index> place(number.size());
    std::vector<Vector3> positions;
    for (std::size_t i = 0; i < number.size(); ++i) {
      place[static_cast<std::size_t>(number[i])] = static_cast<Index>(i);
      positions.push_back(soup.mesh.position(number[i]));
    }
    const PolygonMesh shuffled(positions, soup.mesh.face_begin(), place);
    EXPECT_EQ(groups(weld(shuffled, 0.011), number), expected);
  }
}

TEST(Weld, ToleranceIsAShareOfTheDiagonal) {
  // Two triangles across a gap of 1e-4, the diagonal of the box is 5.
  const PolygonMesh pair({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}, {3, 4, 0}, {0, 4 - 1e-4, 0}, {3 - 1e-4, 0, 0}}, {0, 3, 6},
                         {0, 1, 2, 3, 4, 5});
  EXPECT_EQ(weld(pair, 1.9e-5).joined, 0);
  EXPECT_EQ(weld(pair, 2.1e-5).joined, 2);
  EXPECT_NEAR(weld(pair, 2e-5).tolerance, 1e-4, 1e-15);
  EXPECT_NE(fault(pair, -1), "");
  EXPECT_NE(fault(pair, std::numeric_limits<double>::quiet_NaN()), "");
}

TEST(Weld, MovesWhatIsOneToOnePlaceAndKeepsTheBitsOfTheRest) {
  const PolygonMesh plane = generate::plane({.columns = 4, .rows = 4});
  const Soup soup = soup_of(plane, 1e-8);
  const Welded welded = weld(soup.mesh, 1e-6);
  std::vector<Vector3> moved = soup.mesh.positions();
  const auto first = static_cast<std::size_t>(welded.representative[20]);
  moved[first] = {7, 8, 9};
  const std::vector<Vector3> positions = welded.positions(moved);
  for (std::size_t k = 0; k < positions.size(); ++k) {
    const bool goes = soup.node[k] == soup.node[20];
    EXPECT_EQ(positions[k], goes ? Vector3(7, 8, 9) : soup.mesh.positions()[k]) << k;
  }
  EXPECT_THROW((void)welded.positions({}), Error);
}

TEST(Weld, FacesThatVanishAreNamedUnlessTheyWereNone) {
  MeshBuilder builder;
  for (const Vector3& place : {Vector3(0, 0, 0), Vector3(1, 0, 0), Vector3(0, 1, 0), Vector3(1e-5, 0, 0),
                               Vector3(0, 1, 0), Vector3(0, 0, 0), Vector3(1, 1, 0)})
    builder.add_node(place);
  builder.add_face({0, 1, 2});
  builder.add_face({0, 3, 2});     // an edge of 1e-5
  builder.add_face({0, 2, 4});     // two corners at one place
  builder.add_face({1, 6, 4, 2});  // a quad that is a triangle
  builder.add_face({5, 2});        // none in any case
  const Welded welded = weld(builder.take(), 1e-4);
  EXPECT_EQ(welded.collapsed, std::vector<Index>{1});
  EXPECT_EQ(welded.mesh.face_begin(), (std::vector<Index>{0, 3, 3, 3, 6, 8}));
  EXPECT_EQ(welded.mesh.corners(), (std::vector<Index>{0, 1, 2, 1, 6, 2, 0, 2}));
  EXPECT_EQ(welded.representative, (std::vector<Index>{0, 1, 2, 0, 2, 0, 6}));
}

TEST(Weld, ChainsThatLeadFarAreRefused) {
  // Nodes along a line, each 1 from the next.
  MeshBuilder builder;
  for (int k = 0; k < 6; ++k) builder.add_node({static_cast<double>(k), 0, 0});
  builder.add_node({0, 100, 0});
  for (Index k = 0; k + 1 < 6; ++k) builder.add_face({k, k + 1, 6});
  const PolygonMesh mesh = builder.take();
  EXPECT_NE(fault(mesh, 0.011).find("nodes 0 and "), std::string::npos) << fault(mesh, 0.011);
  EXPECT_EQ(fault(mesh, 0.009), "");
  EXPECT_NE(fault(generate::plane({.columns = 30, .rows = 30}), 0.1), "");
}

TEST(Weld, NodesWithoutFacesAndThoseThatAreNotFiniteStayAlone) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const PolygonMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 0}, {nan, 0, 0}, {nan, 0, 0}, {1, 1, 0}}, {0, 3, 6},
                         {0, 1, 2, 4, 5, 6});
  const Welded welded = weld(mesh, 1e-3);
  EXPECT_EQ(welded.joined, 0);
  EXPECT_EQ(welded.mesh.corners(), mesh.corners());
}

TEST(Weld, SeamsAreFoundOnTheBoundaryAlone) {
  const PolygonMesh plane = generate::plane({.columns = 5, .rows = 5});
  EXPECT_EQ(find_seams(plane).near_nodes.size(), 0U);
  EXPECT_EQ(find_seams(plane).lone_faces, 0);
  const Seams of_soup = find_seams(soup_of(plane).mesh);
  EXPECT_EQ(of_soup.lone_faces, plane.face_count());
  EXPECT_EQ(of_soup.same, of_soup.near_nodes);
  EXPECT_EQ(of_soup.same.size() + 2, plane.corners().size()) << "two corners of the plane have one face";
  const Seams of_rough = find_seams(soup_of(plane, 1e-8).mesh);
  EXPECT_EQ(of_rough.same.size(), 0U);
  EXPECT_EQ(of_rough.near_nodes, of_soup.near_nodes);
  EXPECT_EQ(find_seams(soup_of(generate::torus(), 0).mesh, 1).near_nodes.size(), generate::torus().corners().size())
      << "where chains lead too far those at the same place are named";
}

}  // namespace
}  // namespace vspring::weld_test
