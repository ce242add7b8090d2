#include <fmt/format.h>

#include <cmath>
#include <functional>

#include "unit/io/scratch.hpp"
#include "vspring/surface_file.hpp"

namespace vspring::obj_test {
namespace {

class ObjFile : public Scratch {
 protected:
  SurfaceFile read(const std::string& text) const { return read_surface(put("in.obj", text)); }

  /// The text after one node went to a place.
  std::string moved(const std::string& text, Index node, const Vector3& place) const {
    const SurfaceFile surface = read(text);
    std::vector<Vector3> positions = surface.mesh.positions();
    positions[static_cast<std::size_t>(node)] = place;
    EXPECT_TRUE(write_surface(path("out.obj"), surface, positions).empty());
    return get("out.obj");
  }
};

std::vector<Index> face_of(const SurfaceFile& surface, Index face) {
  const auto nodes = surface.mesh.face(face);
  return {nodes.begin(), nodes.end()};
}

// Everything that a file may carry, lines ending in CR LF here and there.
const std::string rich =
    "# made by hand \\\n"
    "mtllib things.mtl\n"
    "o the roof\r\n"
    "v  0.10 0 0 1 0.5 0.25\n"
    "v\t1 0e0\t0   # right\n"
    "vt 0 0\nvt 1 0.50\n"
    "v +0 1 -0.0\r\n"
    "v 0 \\\n  0 \\\r\n  1.50\n"
    "g left wall\n"
    "usemtl red\ns 1\n"
    "f 1/1 2/2 3/1\n"
    "g\n"
    "f -4 -2 \\\n -1 # back\n"
    "l 1 2 3\n"
    "p 4\n"
    "vp 0.5\n"
    "strange 1 2 3\n"
    "g wall\n"
    "f 2/2/ 3// 4/1\n"
    "\n"
    "f 1 2";

TEST_F(ObjFile, ReadsNodesAndFacesInTheirOrder) {
  const SurfaceFile surface = read(rich + "\n");
  ASSERT_EQ(surface.mesh.node_count(), 4);
  EXPECT_EQ(surface.mesh.position(0), Vector3(0.1, 0, 0));
  EXPECT_EQ(surface.mesh.position(1), Vector3(1, 0, 0));
  EXPECT_EQ(surface.mesh.position(2), Vector3(0, 1, 0));
  EXPECT_TRUE(std::signbit(surface.mesh.position(2).z()));
  EXPECT_EQ(surface.mesh.position(3), Vector3(0, 0, 1.5));
  ASSERT_EQ(surface.mesh.face_count(), 4);
  EXPECT_EQ(face_of(surface, 0), (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(face_of(surface, 1), (std::vector<Index>{0, 2, 3}));
  EXPECT_EQ(face_of(surface, 2), (std::vector<Index>{1, 2, 3}));
  EXPECT_EQ(face_of(surface, 3), (std::vector<Index>{0, 1}));
  EXPECT_TRUE(surface.normals.empty());
  EXPECT_EQ(surface.format, SurfaceFormat::obj);
}

TEST_F(ObjFile, GathersTheNodesOfGroupsAndObjects) {
  const auto groups = read(rich + "\n").groups;
  ASSERT_EQ(groups.size(), 3U);
  EXPECT_EQ(groups.at("left"), (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(groups.at("wall"), (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(groups.at("the roof"), (std::vector<Index>{0, 1, 2, 3}));
}

TEST_F(ObjFile, WarnsOfWhatItDoesNotKnow) {
  const auto warnings = read(rich + "\n").warnings;
  ASSERT_EQ(warnings.size(), 2U);
  EXPECT_NE(warnings[0].find("free-form"), std::string::npos) << warnings[0];
  EXPECT_NE(warnings[1].find(":22: 'strange'"), std::string::npos) << warnings[1];
}

TEST_F(ObjFile, WarnsOnceOfManyStatementsThatItDoesNotKnow) {
  const SurfaceFile surface = read("v 0 0 0\nodd 1\nv 1 0 0\nv 0 1 0\nlod 3\nf 1 2 3\nodder\nodd 2\n");
  ASSERT_EQ(surface.warnings.size(), 1U);
  EXPECT_NE(surface.warnings[0].find(":2: 'odd' and 2 more are not known statements; they are kept as they are"),
            std::string::npos)
      << surface.warnings[0];
  const std::vector<std::string> losses = write_surface(path("out.off"), surface, surface.mesh.positions());
  EXPECT_EQ(losses, (std::vector<std::string>{"display attributes", "statements that are not known"}));
}

TEST_F(ObjFile, ComesOutByteForByteWhenNothingMoves) {
  for (const std::string& text : {rich + "\n", rich + " 3", rich + "\r\n\n"}) {
    const SurfaceFile surface = read(text);
    EXPECT_TRUE(write_surface(path("out.obj"), surface, surface.mesh.positions()).empty());
    EXPECT_EQ(get("out.obj"), text);
  }
}

TEST_F(ObjFile, ChangesTheCoordinatesOfMovedNodesAndNothingElse) {
  const std::string text = rich + "\n";
  EXPECT_EQ(moved(text, 0, {0.1, 0.1 + 0.2, -1e-7}), replaced(text, "0.10 0 0 1", "0.1 0.30000000000000004 -1e-07 1"));
  EXPECT_EQ(moved(text, 1, {2, 0, 0}), replaced(text, "1 0e0\t0   #", "2 0\t0   #"));
  EXPECT_EQ(moved(text, 2, {0, 1, 0.0}), replaced(text, "+0 1 -0.0", "0 1 0"));
  EXPECT_EQ(moved(text, 3, {1, 2, 3}), replaced(text, "v 0 \\\n  0 \\\r\n  1.50", "v 1 \\\n  2 \\\r\n  3"));
}

TEST_F(ObjFile, ReadsBackWhatItWrote) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  for (const double value : {1.0 / 3, 1e300, 5e-324, -1.7976931348623157e308, 123456789012345680.0, 0.1 + 0.7}) {
    moved(text, 1, {value, -value, value});
    EXPECT_EQ(read_surface(path("out.obj")).mesh.position(1), Vector3(value, -value, value));
  }
}

TEST_F(ObjFile, TakesFacesBeforeTheirNodesAndOldLineEnds) {
  const SurfaceFile surface = read("f 1 2 3\rv 0 0 0\rv 1 0 0\rv 0 1 0\r");
  EXPECT_EQ(face_of(surface, 0), (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(surface.mesh.position(1), Vector3(1, 0, 0));
  const std::string crlf = "v 0 0 0\r\nv 1 0 0\r\nv 0 1 0\r\nf 1 2 3\r\n";
  EXPECT_EQ(moved(crlf, 2, {0, 3, 0}), replaced(crlf, "0 1 0", "0 3 0"));
}

TEST_F(ObjFile, KeepsPositionsThatAreNotFinite) {
  const std::string text = "v 0 0 nan\nv 1 0 -inf\nv 0 1 1e999\nv 0 0 0\nf 1 2 4\n";
  const SurfaceFile surface = read(text);
  EXPECT_TRUE(std::isnan(surface.mesh.position(0).z()));
  EXPECT_EQ(surface.mesh.position(1).z(), -HUGE_VAL);
  EXPECT_EQ(surface.mesh.position(2).z(), HUGE_VAL);
  EXPECT_EQ(moved(text, 3, {0, 0, 5}), replaced(text, "v 0 0 0", "v 0 0 5"));
  EXPECT_EQ(message_of(
                [&] {
                  moved(text, 3, {0, 0, HUGE_VAL});
                },
                ErrorCode::invalid_argument),
            "node 3: its position is not finite; only a position that was read so may be");
}

// A roof: the ridge (nodes 1 and 2) is sharp, so its nodes have a normal on each side.
const std::string roof =
    "vn 0 -0.6 0.8\nvn 0 0.6 0.8\n"
    "v 0 0 3\nv 4 0 3\nv 0 4 0\nv 4 4 0\nv 0 -4 0\nv 4 -4 0\n"
    "vn 0 0 1 # of nobody\n"
    "f 1//2 2//2 4//2 3//2\n"
    "f 2//1 1//1 5//1 6//1\n";

TEST_F(ObjFile, SumsTheNormalsOfANodesCorners) {
  const SurfaceFile surface = read(roof);
  ASSERT_EQ(surface.normals.size(), 6U);
  EXPECT_LT((surface.normals[0] - Vector3(0, 0, 1)).norm(), 1e-15);
  EXPECT_LT((surface.normals[2] - Vector3(0, 0.6, 0.8)).norm(), 1e-15);
  const SurfaceFile some = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nvn 0 0 2\nf 1 2 3\nf 1//1 2 3//1\n");
  EXPECT_EQ(some.normals[0], Vector3(0, 0, 1));
  EXPECT_EQ(some.normals[1], Vector3(0, 0, 0));
}

TEST_F(ObjFile, ComputesNormalsOfFacesAnewOnEachSideOfASharpEdge) {
  const SurfaceFile surface = read(roof);
  std::vector<Vector3> positions = surface.mesh.positions();
  // One side goes up until it is level with the ridge.
  positions[2].z() = positions[3].z() = 3;
  write_surface(path("out.obj"), surface, positions);
  std::string expected = replaced(replaced(roof, "v 0 4 0", "v 0 4 3"), "v 4 4 0", "v 4 4 3");
  EXPECT_EQ(get("out.obj"), replaced(expected, "vn 0 0.6 0.8", "vn 0 0 1"));
}

// Two faces that meet in a seam: each has its own nodes there, at the same places, and names normals of its own.
std::string two_faces(const std::string& left, const std::string& right) {
  return "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 0\nv 2 0 0\nv 2 1 0\nv 1 1 0\n"
         "vn " +
         left + "\nvn " + left + "\nvn " + left + "\nvn " + left +
         "\n"
         "vn " +
         right + "\nvn " + right + "\nvn " + right + "\nvn " + right +
         "\n"
         "f 1//1 2//2 3//3 4//4\nf 5//5 6//6 7//7 8//8\n";
}

TEST_F(ObjFile, KeepsNormalsEqualThatWereAcrossASeam) {
  const auto normals_after = [&](const std::string& text) {
    const SurfaceFile surface = read(text);
    std::vector<Vector3> positions = surface.mesh.positions();
    positions[5].z() = positions[6].z() = 1;
    write_surface(path("out.obj"), surface, positions);
    return read_surface(path("out.obj")).normals;
  };
  const std::vector<Vector3> smooth = normals_after(two_faces("0 0 1", "0 0 1"));
  const Vector3 mean = Vector3(-1, 0, 1 + 2 * std::sqrt(2)).normalized();
  for (const std::size_t node : {1U, 2U, 4U, 7U}) EXPECT_LT((smooth[node] - smooth[1]).norm(), 1e-15) << node;
  EXPECT_GT(smooth[1].dot(mean), 0.9);
  EXPECT_LT(smooth[1].x(), -0.2);
  EXPECT_LT((smooth[0] - Vector3(0, 0, 1)).norm(), 1e-15);
  // A crease stays one.
  const std::vector<Vector3> sharp = normals_after(two_faces("0 0 1", "0 0.6 0.8"));
  for (const std::size_t node : {1U, 2U}) {
    EXPECT_LT((sharp[node] - Vector3(0, 0, 1)).norm(), 1e-15);
    EXPECT_LT((sharp[node == 1 ? 4 : 7] - Vector3(-1, 0, 1).normalized()).norm(), 1e-15);
  }
}

TEST_F(ObjFile, KeepsOneNormalAtANodeWhoseCornersEachNameTheirOwn) {
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 0 1 0\nv -1 0 0\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\nvn 0 0 1\n"
      "f 1//1 2//2 3//3\nf 1//4 3//5 4//6\n";
  const std::string after = moved(text, 1, {1, 0, 1});
  const SurfaceFile read_back = read(after);
  std::vector<std::string> normals;
  for (std::size_t at = after.find("vn "); at != std::string::npos; at = after.find("vn ", at + 1))
    normals.push_back(after.substr(at, after.find('\n', at) - at));
  ASSERT_EQ(normals.size(), 6U);
  EXPECT_EQ(normals[0], normals[3]);
  EXPECT_EQ(normals[2], normals[4]);
  EXPECT_NE(normals[1], normals[0]);
  EXPECT_EQ(normals[5], "vn 0 0 1");
}

// Four faces of nine nodes in a plane. normal: of a node, from 1.
std::string window(const std::function<int(int)>& normal, const std::string& normals) {
  std::string text;
  for (int node = 0; node < 9; ++node) text += fmt::format("v {} {} 0\n", node % 3, node / 3);
  text += normals;
  for (const int first : {1, 2, 4, 5}) {
    text += "f";
    for (const int node : {first, first + 1, first + 4, first + 3}) text += fmt::format(" {}//{}", node, normal(node));
    text += "\n";
  }
  return text;
}

TEST_F(ObjFile, GivesNodesThatShareANormalTheirOwn) {
  std::string nine;
  for (int node = 0; node < 9; ++node) nine += "vn 0 0 1\n";
  // Nodes 6 and 8 go up: the normals of all but the first stay those that they have by themselves.
  const auto after = [&](const std::string& text) {
    const SurfaceFile surface = read(text);
    std::vector<Vector3> positions = surface.mesh.positions();
    positions[4].z() = positions[8].z() = 0.5;
    EXPECT_TRUE(write_surface(path("out.obj"), surface, positions).empty());
    return get("out.obj");
  };
  const std::vector<Vector3> expected = read(after(window([](int node) { return node; }, nine))).normals;
  const std::string shared = window([](int /*node*/) { return 1; }, "vn 0 0 1 # up\n");
  const std::string text = after(shared);
  const SurfaceFile surface = read(text);
  ASSERT_EQ(surface.normals.size(), 9U);
  for (std::size_t node = 0; node < 9; ++node)
    EXPECT_LT((surface.normals[node] - expected[node]).norm(), 1e-15) << node;
  // The new lines follow the last one, and nothing else changes.
  EXPECT_LT(text.rfind("vn "), text.find("f "));
  EXPECT_NE(text.find(" # up\nvn "), std::string::npos);
  EXPECT_EQ(text.find(" # up\n\n"), std::string::npos);
  // Where numbers count back the new lines come last.
  const std::string last = after(replaced(shared, "f 1//1 2//1", "f 1//-1 -8//-1"));
  EXPECT_GT(last.rfind("vn "), last.rfind("f "));
  const std::vector<Vector3> same = read(last).normals;
  for (std::size_t node = 0; node < 9; ++node) EXPECT_LT((same[node] - expected[node]).norm(), 1e-15) << node;
}

TEST_F(ObjFile, KeepsASharedNormalWhereNoFaceMoves) {
  // Of a row of faces the last one bends.
  std::string text = "vn 0 0 1\n";
  for (int node = 0; node < 8; ++node) text += fmt::format("v {} {} 0\n", node / 2, node % 2);
  for (const int first : {1, 3, 5})
    text += fmt::format("f {0}//1 {2}//1 {3}//1 {1}//1\n", first, first + 1, first + 2, first + 3);
  const SurfaceFile surface = read(moved(text, 7, {3, 1, 1}));
  for (const std::size_t node : {0U, 1U, 2U, 3U}) EXPECT_EQ(surface.normals[node], Vector3(0, 0, 1)) << node;
  for (const std::size_t node : {5U, 6U, 7U}) EXPECT_NE(surface.normals[node], Vector3(0, 0, 1)) << node;
  EXPECT_NE(get("out.obj").find("f 1//1 3//1 4//1 2//1\n"), std::string::npos);
}

TEST_F(ObjFile, KeepsOneNormalOfEachFaceThatIsFlatByItself) {
  // Two faces that do not meet share a normal; one of them turns over its edge.
  const std::string text =
      "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 5 0 0\nv 6 0 0\nv 6 1 0\nv 5 1 0\nvn 0 0 1\n"
      "f 1//1 2//1 3//1 4//1\nf 5//1 6//1 7//1 8//1\n";
  EXPECT_TRUE(moved(text, 6, {6, 1, 0.5}).ends_with("\nf 1//1 2//1 3//1 4//1\nf 5//2 6//2 7//2 8//2\n"));
}

TEST_F(ObjFile, KeepsTheSideOfNormalsThatPointInward) {
  std::string inward = replaced(replaced(roof, "vn 0 -0.6 0.8", "vn 0 0.6 -0.8"), "\nvn 0 0.6 0.8", "\nvn 0 -0.6 -0.8");
  const SurfaceFile surface = read(inward);
  std::vector<Vector3> positions = surface.mesh.positions();
  positions[2].z() = positions[3].z() = 3;
  write_surface(path("out.obj"), surface, positions);
  EXPECT_LT((read_surface(path("out.obj")).normals[2] - Vector3(0, 0, -1)).norm(), 1e-15);
}

TEST_F(ObjFile, LeavesNormalsThatNoMovedFaceTouches) {
  const std::string text = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nvn 0 0 9\nf 1//1 2//1 3//1\n";
  EXPECT_EQ(moved(text, 3, {6, 6, 6}), replaced(text, "v 5 5 5", "v 6 6 6"));
  // A face that collapses gives no direction.
  EXPECT_EQ(moved(text, 2, {2, 0, 0}), replaced(text, "v 0 1 0", "v 2 0 0"));
}

}  // namespace
}  // namespace vspring::obj_test
