// What rules for surfaces mean, and what is said of wrong ones.

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "support/refusal.hpp"
#include "vspring/vspring.hpp"

namespace vspring::rules_test {
namespace {

using namespace support;

TEST(Rules, ApplyInOrderAndAllOrNone) {
  const PolygonMesh mesh = generate::plane({.columns = 4, .rows = 4});
  Constraints constraints(mesh.node_count());
  apply_rules(constraints, mesh, R"({"rules": [
      {"nodes": "all", "position": "fixed", "normal": [0, 0, 3]},
      {"nodes": "interior", "position": "free"},
      {"nodes": {"region": "box:0.4,0.4,0,0.6,0.6,0"}, "position": [1, 2, 3], "normal": "free"}]})");
  EXPECT_EQ(constraints.position(0), mesh.position(0));
  EXPECT_EQ(constraints.normal(0), Vector3(0, 0, 1));
  EXPECT_FALSE(constraints.position_fixed(6));
  EXPECT_EQ(constraints.position(12), Vector3(1, 2, 3));
  EXPECT_FALSE(constraints.normal_fixed(12));
  const std::string message = refusal(
      [&] {
        apply_rules(constraints, mesh,
                    R"({"rules": [{"nodes": "all", "position": "free"}, {"nodes": [77], "normal": "free"}]})");
      },
      ErrorCode::unusable_constraint);
  EXPECT_TRUE(says(message, "rule 2") && says(message, "77")) << message;
  EXPECT_TRUE(constraints.position_fixed(0)) << "the first rule must not have been applied";
}

TEST(Rules, NormalsOfTheInputAndOfTheFile) {
  const PolygonMesh sphere = generate::sphere_patch({.columns = 6, .rows = 6, .jitter = 0.3}, 2, 70);
  Constraints constraints(sphere.node_count());
  apply_rules(constraints, sphere, R"({"rules": [{"nodes": "all", "normal": "fixed"}]})");
  for (Index i = 0; i < sphere.node_count(); ++i)
    EXPECT_LT((constraints.normal(i) - sphere.position(i) / 2).norm(), 1e-12);
  const std::vector<Vector3> normals(static_cast<std::size_t>(sphere.node_count()), Vector3(0, 1, 0));
  apply_rules(constraints, sphere, R"({"rules": [{"nodes": [3], "normal": "file"}]})", {.normals = &normals});
  EXPECT_EQ(constraints.normal(3), Vector3(0, 1, 0));
}

TEST(Rules, LetNodesSlide) {
  const PolygonMesh mesh = generate::plane({.columns = 4, .rows = 4});
  Constraints constraints(mesh.node_count());
  apply_rules(constraints, mesh, R"({"rules": [
      {"nodes": "all", "position": "fixed"},
      {"nodes": [0, 1], "slide": {"plane": {"point": [0, 0, 1], "normal": [0, 0, 2]}}},
      {"nodes": [1], "slide": {"line": {"point": [0, 0, 1], "direction": [0, 1, 0]}}},
      {"nodes": [2, 3], "slide": [{"circle": {"centre": [0, 0, 0], "normal": [0, 0, 1], "radius": 2}},
                                  {"cylinder": {"point": [0, 0, 0], "direction": [1, 0, 0], "radius": 3}}]},
      {"nodes": [4], "slide": {"polyline": {"points": [[0, 0, 0], [1, 0, 0], [1, 1, 0]], "closed": true}}},
      {"nodes": [5], "slide": {"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}}},
      {"nodes": [5], "position": "free"}]})");
  const auto is = [&](Index node, const Support& support) {
    return constraints.support(node) != nullptr && *constraints.support(node) == support &&
           !constraints.position_fixed(node);
  };
  EXPECT_TRUE(is(0, Support::plane({0, 0, 1}, {0, 0, 1})));
  EXPECT_TRUE(is(1, Support::line({0, 0, 1}, {0, 1, 0})));
  EXPECT_TRUE(is(2, Support::circle({0, 0, 0}, {0, 0, 1}, 2)));
  EXPECT_TRUE(is(3, Support::cylinder({0, 0, 0}, {1, 0, 0}, 3)));
  EXPECT_TRUE(is(4, Support::polyline({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, true)));
  EXPECT_EQ(constraints.sliding_count(), 5);
  EXPECT_FALSE(constraints.position_fixed(5));
  EXPECT_TRUE(constraints.position_fixed(6));
  EXPECT_EQ(parse_support("plane:0,0,1,0,0,2"), Support::plane({0, 0, 1}, {0, 0, 1}));
  EXPECT_EQ(parse_support("cylinder:0,0,0,1,0,0,3"), Support::cylinder({0, 0, 0}, {1, 0, 0}, 3));
}

TEST(Rules, SaysWhatIsWrongWithASupport) {
  const PolygonMesh mesh = generate::plane({.columns = 4, .rows = 4});
  const auto refused = [&](const std::string& rule) {
    Constraints constraints(mesh.node_count());
    return refusal([&] { apply_rules(constraints, mesh, R"({"rules": [{"nodes": [7], )" + rule + "}]}"); },
                   ErrorCode::unusable_constraint);
  };
  const auto says_of = [&](const std::string& rule, const char* words) {
    const std::string message = refused(rule);
    EXPECT_TRUE(says(message, "rule 1: ") && says(message, words)) << message;
  };
  says_of(R"("slide": {"plane": {"point": [0, 0, 0], "normal": [0, 0, 0]}})",
          "a plane to slide on has a normal of zero");
  says_of(R"("slide": {"plane": {"point": [0, 0, 0]}})", "a plane to slide on has no \"normal\"");
  says_of(R"("slide": {"polyline": {"points": [[0, 0, 0]]}})", "a polyline to slide on has 1 point");
  says_of(R"("slide": {"circle": {"centre": [0, 0, 0], "normal": [0, 0, 1], "radius": 0}})", "has the radius 0");
  says_of(R"("slide": {"plane": {"point": [0, 0, 0], "normal": [0, 0, 1], "radius": 1}})", "\"radius\" means nothing");
  says_of(R"("slide": {"hill": {}})", "is nothing to slide on");
  says_of(R"("slide": [])", "0 supports are given for 1 nodes");
  says_of(R"("position": "fixed", "slide": {"plane": {"point": [0, 0, 0], "normal": [0, 0, 1]}})", "node 7: it either");
  for (const char* bad : {"plane:0,0,1", "plane", "hill:1,2,3,4,5,6", "line:0,0,0,0,0,x", "circle:0,0,0,0,0,1"})
    EXPECT_TRUE(says(refusal([&] { (void)parse_support(bad); }, ErrorCode::unusable_constraint), "write plane:px"));
}

/// Which nodes have a fixed position.
std::vector<Index> held(const Constraints& constraints) {
  std::vector<Index> nodes;
  for (Index i = 0; i < constraints.node_count(); ++i)
    if (constraints.position_fixed(i)) nodes.push_back(i);
  return nodes;
}

TEST(Rules, HoldNodesWhereNoneCanMove) {
  const char* const rules = R"({"rules": [{"nodes": "non-manifold", "position": "fixed"}]})";
  // Three faces at edge 0–1; two fans that meet at node 5 alone.
  MeshBuilder builder;
  for (int k = 0; k < 10; ++k) builder.add_node({1.0 * k, 1.0 * k * k, 1.0 * (k % 3)});
  for (const std::vector<Index>& face :
       std::vector<std::vector<Index>>{{0, 1, 2}, {0, 1, 3}, {1, 0, 4}, {5, 6, 7}, {5, 8, 9}})
    builder.add_face(face);
  const PolygonMesh mesh = builder.take();
  Constraints of_mesh(mesh.node_count());
  apply_rules(of_mesh, mesh, rules);
  EXPECT_EQ(held(of_mesh), (std::vector<Index>{0, 1, 5}));
  // Two chains through node 2, and one that comes by node 6 twice.
  const PolygonCurve curve(std::vector<Vector3>(8, Vector3::Zero()),
                           {{{0, 1, 2, 3}, false}, {{4, 2}, false}, {{5, 6, 7, 6}, false}});
  Constraints of_curve(curve.node_count());
  apply_rules(of_curve, curve, rules);
  EXPECT_EQ(held(of_curve), (std::vector<Index>{2, 6}));
}

TEST(Rules, NameSharpEdges) {
  const PolygonMesh mesh = generate::plane({.columns = 4, .rows = 4});
  const Groups groups = {{"left", {0, 1, 5, 6, 10, 11, 15, 16, 20, 21}}};
  const auto named = [&](const std::string& nodes, const std::string& sharp, RuleInput input = {}) {
    input.groups = &groups;
    Constraints constraints(mesh.node_count());
    MeshEdges edges =
        apply_rules(constraints, mesh, R"({"rules": [{"nodes": )" + nodes + R"(, "sharp": )" + sharp + "}]}", input);
    for (Index i = 0; i < mesh.node_count(); ++i) EXPECT_FALSE(constraints.position_fixed(i));
    return as_sharp_edges(mesh, edges).edges;
  };
  const MeshEdges column = {{1, 6}, {6, 11}, {11, 16}, {16, 21}};
  EXPECT_EQ(named("[21, 16, 11, 6, 1]", "true"), column);
  EXPECT_EQ(named("[21, 16, 11, 6, 1]", R"("path")"), column);
  EXPECT_EQ(named(R"({"region": "box:0.2,0,0,0.3,1,0"})", "true"), column);
  // Of a group the rim, where it is no boundary.
  EXPECT_EQ(named(R"({"group": "left"})", "true"), column);
  // Four nodes of one face: a way around three of its sides, and all of them.
  EXPECT_EQ(named("[6, 7, 12, 11]", R"("path")"), (MeshEdges{{6, 7}, {7, 12}, {11, 12}}));
  EXPECT_EQ(named("[6, 7, 12, 11]", "true"), (MeshEdges{{6, 7}, {6, 11}, {7, 12}, {11, 12}}));
  // Faces beyond the named nodes are mirror images, which are inside where the face beside them is.
  EXPECT_EQ(named("[5, 6, 7, 10, 11, 12]", "true", {.named_nodes = 13}), (MeshEdges{{5, 6}, {6, 7}, {7, 12}}));
}

TEST(Rules, NameSharpEdgesByTheNumbersBeforeWelding) {
  MeshBuilder builder;
  for (const double x : {0.0, 1.0}) {
    for (int row = 0; row < 3; ++row) {
      builder.add_node({x - 1, 1.0 * row, 0});
      builder.add_node({x, 1.0 * row, 0});
    }
  }
  for (const Index k : {0, 2, 6, 8}) builder.add_face({k, k + 1, k + 3, k + 2});
  const Welded welded = weld(builder.take(), 0);
  Constraints constraints(welded.mesh.node_count());
  const std::string rules = R"({"rules": [{"nodes": [6, 8, 10], "sharp": "path"}]})";
  EXPECT_EQ(apply_rules(constraints, welded.mesh, rules, {.welded = &welded}), (MeshEdges{{1, 3}, {3, 5}}));
  const std::string message = refusal(
      [&] {
        apply_rules(constraints, welded.mesh, R"({"rules": [{"nodes": [6, 10], "sharp": "path"}]})",
                    {.welded = &welded});
      },
      ErrorCode::unusable_constraint);
  EXPECT_TRUE(says(message, "from node 6 to node 10")) << message;
}

TEST(Rules, WrongOnesAreNamedInOneShortLine) {
  const PolygonMesh mesh = generate::plane({.columns = 4, .rows = 4});
  const Groups groups = {{"rim", {0}}, {"two\nlines", {1}}};
  Constraints constraints(mesh.node_count());
  const std::string endless(100'000, 'x');
  const std::vector<std::string> wrong = {
      R"("two\nlines": 1)",
      R"("nodes": {"group": "two\nlines, and more"}, "position": "fixed")",
      R"("nodes": {"region": "sphere:\n"}, "position": "fixed")",
      R"("nodes": {"region": "group:\n"}, "position": "fixed")",
      R"("nodes": {"region": "box:0,0,0,1,1,\u0007"}, "position": "fixed")",
      R"("nodes": {"region": "no\nfile"}, "position": "fixed")",
      "\"nodes\": \"" + endless + "\", \"position\": \"fixed\"",
      "\"nodes\": [0], \"position\": \"" + endless + "\"",
      "\"nodes\": [0], \"normal\": " + endless,
      "\"nodes\": [0], \"sharp\": \"" + endless + "\"",
  };
  for (const std::string& rule : wrong) {
    const std::string message =
        refusal([&] { apply_rules(constraints, mesh, "{\"rules\": [{" + rule + "}]}", {.groups = &groups}); },
                rule.find("file") == std::string::npos ? ErrorCode::unusable_constraint : ErrorCode::unusable_file);
    EXPECT_LT(message.size(), 500U) << message;
    for (const char c : message) EXPECT_GE(static_cast<unsigned char>(c), 0x20U) << message;
  }
}

}  // namespace
}  // namespace vspring::rules_test
