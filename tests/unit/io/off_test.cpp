#include <fmt/format.h>

#include "unit/io/scratch.hpp"
#include "vspring/error.hpp"
#include "vspring/surface_file.hpp"

namespace vspring::off_test {
namespace {

class OffFile : public Scratch {
 protected:
  SurfaceFile read(const std::string& text) const { return read_surface(put("in.off", text)); }
};

struct Kind {
  std::string head;
  std::string first_node;  ///< without its coordinates, which are 0 0 0
  bool normals;
};

// A tetrahedron's corner, written in every kind of OFF.
const Kind kinds[] = {
    {"OFF\n3 1 0\n", "", false},
    {"OFF 3 1 0\n", "", false},
    {"# first\nOFF # second\n# third\n\n3 1 # no edges\n", "", false},
    {"3 1 3\n", "", false},
    {"OFF3 1 3\n", "", false},
    {"OFF\r\n3 1 0\r\n", " 255 0 0 255", false},
    {"COFF\n3 1 0\n", " 0.5 1 0 1", false},
    {"NOFF\n3 1 0\n", " 0 0 4", true},
    {"STOFF\n3 1 0\n", " 0.25 0.75", false},
    {"CNOFF\n3 1 0\n", " 0 0 4 255 0 7", true},
    {"NCOFF\n3 1 0\n", " 255 0 7 9 0 0 4", true},
    {"STCNOFF\n3 1 0\n", " 0 0 4 255 0 7 0.5 0.5", true},
    {"NCSTOFF\n3 1 0\n", " 255 0 7 9 0 0 4 0.5 0.5", true},
};

TEST_F(OffFile, WhatOtherCoordinatesWouldMakeAnotherFileIsRefused) {
  // Nodes 0 0 1 and 0 0 0 and the face 1 1, with a colour, since the lines fit no face.
  const std::string text = "OFF\n2 1#0\n0 0 0\n1 0 0\n0 1 1 2\n";
  const SurfaceFile surface = read(text);
  ASSERT_EQ(surface.mesh.position(0), Vector3(0, 0, 1));
  EXPECT_TRUE(write_surface(path("out.off"), surface, surface.mesh.positions()).empty());
  EXPECT_EQ(get("out.off"), text);
  // Then lines would do: nodes 0 0.5 0 and 1 1 0, face 1.
  const std::vector<Vector3> moved = {{0.5, 0, 1}, {1, 0, 1}};
  try {
    write_surface(path("out.off"), surface, moved);
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::unusable_file);
    EXPECT_NE(std::string(error.what()).find("in.off: with other coordinates"), std::string::npos) << error.what();
  }
  EXPECT_EQ(get("out.off"), text);
  write_surface(path("out.ply"), surface, moved);
  EXPECT_EQ(read_surface(path("out.ply")).mesh.positions(), moved);
}

TEST_F(OffFile, AStreamOfNumbersKeepsItsLines) {
  const SurfaceFile surface = read("OFF\n3 1\n0\n0 0\n0 1 0\n0 0 1 0 3\n0 1\n2\n");
  ASSERT_EQ(surface.mesh.node_count(), 3);
  write_surface(path("out.off"), surface, {{0, 0, 7}, {1, 0, 0}, {0, 1, 0}});
  EXPECT_EQ(get("out.off"), "OFF\n3 1\n0\n0 0\n7 1 0\n0 0 1 0 3\n0 1\n2\n");
}

TEST_F(OffFile, AStreamOfNumbersKeepsNodesThatAreNowhere) {
  const SurfaceFile surface = read("OFF 4 1\n0\n0 0\n0 1 0\n0 0 1 0 5 nan 5 3\n0 1\n2\n");
  ASSERT_EQ(surface.mesh.node_count(), 4);
  std::vector<Vector3> places = surface.mesh.positions();
  write_surface(path("same.off"), surface, places);
  EXPECT_EQ(get("same.off"), get("in.off"));
  places[0] = {0, 0, 7};
  write_surface(path("out.off"), surface, places);
  EXPECT_EQ(get("out.off"), "OFF 4 1\n0\n0 0\n7 1 0\n0 0 1 0 5 nan 5 3\n0 1\n2\n");
}

TEST_F(OffFile, EveryKindKeepsItsBytesButThoseOfMovedNodes) {
  for (const Kind& kind : kinds) {
    const auto text = [&](const std::string& place, const std::string& more) {
      return fmt::format("{0}{1}{2}  # of node 0\n1 0 0{3}\n0 1\t0{3}\n3 0 1 2  1 0.5 0\n# end\n", kind.head, place,
                         more, kind.first_node);
    };
    const std::string before = text("0 0 0", kind.first_node);
    SCOPED_TRACE(before);
    const SurfaceFile surface = read(before);
    EXPECT_EQ(surface.format, SurfaceFormat::off);
    ASSERT_EQ(surface.mesh.node_count(), 3);
    EXPECT_EQ(surface.mesh.position(2), Vector3(0, 1, 0));
    EXPECT_EQ(surface.mesh.corners(), (std::vector<Index>{0, 1, 2}));
    EXPECT_EQ(surface.normals.size(), kind.normals ? 3U : 0U);
    for (const Vector3& normal : surface.normals) EXPECT_EQ(normal, Vector3(0, 0, 1));
    EXPECT_TRUE(write_surface(path("out.off"), surface, surface.mesh.positions()).empty());
    EXPECT_EQ(get("out.off"), before);

    // A normal that still holds is written again as 0 0 1 instead of 0 0 4, at all three nodes.
    std::vector<Vector3> positions = surface.mesh.positions();
    positions[0] = {-0.5, 0, 0};
    write_surface(path("out.off"), surface, positions);
    std::string after = text("-0.5 0 0", kind.first_node);
    for (std::size_t at; kind.normals && (at = after.find("0 0 4")) != std::string::npos;)
      after.replace(at, 5, "0 0 1");
    EXPECT_EQ(get("out.off"), after);
  }
}

// A square of two triangles, with the words where Geomview allows them. {0} and {1}: x and y of node 2.
const std::string streams[] = {
    "OFF 4 2 5 0 0 0 1 0 0 {0} {1} 0 0 1 0 3 0 1 2 3 0 2 3\n",
    "OFF\n4 2 5\n0 0 0 1 0 0\n{0} {1} 0 0 1 0\n3 0 1 2 3 0 2 3\n",
    "OFF\n4 2 5\n0 0 0 1 0 0 {0}\n{1} 0 0 1 0 3 0\n1 2 3 0 2 3",
    "OFF\n4\n2\n5\n0\n0\n0\n1\n0\n0\n{0}\n{1}\n0\n0\n1\n0\n3\n0\n1\n2\n3\n0\n2\n3\n",
    "OFF # a square\n4 2 # counts\n5\n0 0 # of node\n0\n1 0 0# and\n{0} {1} 0\n0 1 0\n3 # corners\n0 1 2\n3 0 2 3# end",
    "OFF\n4 2 5\n0 0 0\n1 0 0\n{0} {1} 0\n0 1 0\n3 0\n1 2 255 0 0\n3\n0\n2 3\t0.5 0.5 0.5\n",
    "OFF\r4 2\r0 0 0\r1 0 0\r{0} {1} 0\r0 1 0\r3 0 1 2 3 0 2 3\r",
    // What could be another face is a colour where every line has a face.
    "OFF\n4 2 5\n\n0 0 0\n1 0 0\n{0} {1} 0\n0 1 0\n\n3 0 1 2 3 0 2 3\n3 0 2 3 9\n",
    "COFF 4 2 5 0 0 0 9 9 9 9 1 0 0 9 9 9 9\n{0} {1} 0 9 9 9 9 0 1 0 9 9 9 9 3 0 1 2 3 0 2 3\n",
    "STOFF 4 2 5 0 0 0 9 9 1 0 0 9 9\n{0} {1} 0 9 9 0 1 0 9 9\n3 0 1 2 3 0 2 3\n",
};

TEST_F(OffFile, IsAStreamOfWords) {
  for (const std::string& stream : streams) {
    const std::string text = fmt::format(fmt::runtime(stream), "1", "1");
    SCOPED_TRACE(text);
    const SurfaceFile surface = read(text);
    ASSERT_EQ(surface.mesh.positions(), (std::vector<Vector3>{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}));
    EXPECT_EQ(surface.mesh.corners(), (std::vector<Index>{0, 1, 2, 0, 2, 3}));
    std::vector<Vector3> positions = surface.mesh.positions();
    EXPECT_TRUE(write_surface(path("out.off"), surface, positions).empty());
    EXPECT_EQ(get("out.off"), text);
    positions[2] = {1.5, 1.25, 0};
    write_surface(path("out.off"), surface, positions);
    EXPECT_EQ(get("out.off"), fmt::format(fmt::runtime(stream), "1.5", "1.25"));
  }
}

TEST_F(OffFile, KeepsCommentsInsideNodes) {
  const std::string text = "OFF 3 1 0\n0 # x\n0 0 1 0 0# y\n0 1\n# z\n0 3 0 1 2\n";
  const SurfaceFile surface = read(text);
  write_surface(path("out.off"), surface, {{7, 8, 9}, {1, 0, 5}, {0, 1, 6}});
  EXPECT_EQ(get("out.off"), "OFF 3 1 0\n7 # x\n8 9 1 0 5# y\n0 1\n# z\n6 3 0 1 2\n");
}

TEST_F(OffFile, WritesNormalsIntoAStream) {
  for (const std::string kind : {"NOFF", "NCOFF", "CNOFF"}) {
    const auto text = [&](const std::string& x, const std::string& normal) {
      const std::string more = kind == "NOFF" ? normal : kind == "NCOFF" ? "9 9\n9 9 " + normal : normal + " 9 9 9\n9";
      return fmt::format("{0} 3 1 0 {1} 0 0 {2} 1 0 0 {2}\n0 1 0 {2} 3 0 1 2\n", kind, x, more);
    };
    const SurfaceFile surface = read(text("0", "0 0 4"));
    ASSERT_EQ(surface.normals.size(), 3U);
    EXPECT_EQ(surface.normals[2], Vector3(0, 0, 1));
    write_surface(path("out.off"), surface, {{-0.5, 0, 0}, {1, 0, 0}, {0, 1, 0}});
    EXPECT_EQ(get("out.off"), text("-0.5", "0 0 1"));
  }
}

}  // namespace
}  // namespace vspring::off_test
