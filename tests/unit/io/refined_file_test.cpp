#include <Eigen/Geometry>
#include <string>

#include "support/refusal.hpp"
#include "unit/io/scratch.hpp"
#include "vspring/refine.hpp"
#include "vspring/remesh.hpp"
#include "vspring/surface_file.hpp"

namespace vspring::refined_file_test {
namespace {

using support::refusal;
using support::says;

// Three triangles, two of them in a group. Normals at the corners.
const std::string fan =
    "v 0 0 0\nv 4 0 0\nv 4 4 0\nv 0 4 0\nv 9 9 9\n"
    "vn 0 0 1\nvn 0 1 0\nvn 1 0 0\n"
    "g roof\nf 1//1 2//1 3//2\nf 1//1 3//1 4//1\ng wall\nf 3//3 2//3 5//3\n";

SurfaceFile file_of(const std::string& text) { return read_surface_bytes(text, "fan.obj"); }

Refined refined_fan(const SurfaceFile& file) {
  Constraints constraints(5);
  for (const Index node : {1, 2, 4}) constraints.fix_position(node, file.mesh.position(node));
  return refine(file.mesh, constraints, {.length = 3});
}

TEST(RefinedFile, IsTheRefinedMeshAndIsWrittenAsItWasRead) {
  for (const char* const format : {"obj", "off", "ply", "stl"}) {
    const std::string name = std::string("fan.") + format;
    PolygonMesh mesh = file_of(fan).mesh;
    const SurfaceFile file = read_surface_bytes(surface_bytes(name, mesh).bytes, name);
    const Refined refined = refined_fan(file);
    ASSERT_GT(refined.new_node_count(), 0);
    const SurfaceFile now = refined_file(file, refined);
    EXPECT_EQ(now.format, file.format);
    EXPECT_TRUE(now.mesh.has_same_faces(refined.mesh)) << format;
    EXPECT_EQ(now.mesh.positions(), refined.mesh.positions()) << format;
    // Without moves its bytes are those that it would be read from.
    const std::string bytes = surface_bytes(name, now, now.mesh.positions()).bytes;
    EXPECT_EQ(read_surface_bytes(bytes, name).mesh.face_count(), refined.mesh.face_count()) << format;
  }
}

TEST(RefinedFile, GroupsAndNormalsHaveNewNodes) {
  const SurfaceFile file = file_of(fan);
  const Refined refined = refined_fan(file);
  const SurfaceFile by_text = refined_file(file, refined);
  SurfaceFile alone = file;
  alone.source.reset();
  const SurfaceFile by_mesh = refined_file(alone, refined);
  ASSERT_EQ(by_text.normals.size(), static_cast<std::size_t>(refined.mesh.node_count()));
  ASSERT_EQ(by_mesh.normals.size(), by_text.normals.size());
  EXPECT_EQ(by_mesh.mesh.positions(), by_text.mesh.positions());
  EXPECT_GT(by_text.groups.at("roof").size(), file.groups.at("roof").size());
  EXPECT_EQ(by_mesh.groups.at("roof"), by_text.groups.at("roof"));
  for (const Vector3& normal : by_text.normals) EXPECT_NEAR(normal.norm(), 1, 1e-12);
  for (const Vector3& normal : by_mesh.normals) EXPECT_NEAR(normal.norm(), 1, 1e-12);
}

TEST(RefinedFile, AnotherMeshIsRefused) {
  SurfaceFile file = file_of(fan);
  const Refined refined = refined_fan(file);
  const SurfaceFile other = file_of("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
  EXPECT_TRUE(says(refusal([&] { (void)refined_file(other, refined); }, ErrorCode::invalid_argument), "3 and 1"));
  file.added.node_like = {0};
  EXPECT_TRUE(says(refusal([&] { (void)refined_file(file, refined); }, ErrorCode::invalid_argument), "added"));
}

TEST(RefinedFile, TypesThatAreTooSmallAreRefused) {
  const std::string head =
      "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 2\nproperty list uchar uchar vertex_indices\nend_header\n";
  const SurfaceFile file = read_surface_bytes(head + "0 0 0\n40 0 0\n40 40 0\n0 40 0\n3 0 1 2\n3 0 2 3\n", "small.ply");
  const Refined refined = refine(file.mesh, Constraints(4), {.length = 2});
  EXPECT_TRUE(says(refusal([&] { (void)refined_file(file, refined); }, ErrorCode::unusable_file), "no room"));
}

/// A sheet of 4 × 4 quads, and a triangle in the air.
PolygonMesh sheet() {
  MeshBuilder builder;
  for (Index i = 0; i < 5; ++i) {
    for (Index j = 0; j < 5; ++j) builder.add_node({1.0 * i, 1.0 * j, 0.125 * i * j});
  }
  for (Index k = 0; k < 3; ++k) builder.add_node({10.0 + k, 1.0 * k * k, 0});
  builder.add_face({25, 26, 27});
  for (Index i = 0; i < 4; ++i) {
    for (Index j = 0; j < 4; ++j) builder.add_face({5 * i + j, 5 * i + j + 5, 5 * i + j + 6, 5 * i + j + 1});
  }
  return builder.take();
}

Remeshed remeshed_sheet(const PolygonMesh& mesh, double length) {
  Constraints constraints(mesh.node_count());
  for (Index node = 0; node < mesh.node_count(); ++node) {
    const Vector3& place = mesh.position(node);
    const bool moves = place.x() > 0 && place.x() < 4 && place.y() > 0 && place.y() < 4;
    if (!moves) constraints.fix_position(node, place);
  }
  return remesh(mesh, constraints, {.length = length});
}

TEST(RemeshedFile, IsTheRemeshedMeshWithoutTheNodesThatAreGone) {
  for (const char* const format : {"obj", "off", "ply", "stl"}) {
    for (const double length : {0.5, 2.0}) {
      const std::string name = std::string("sheet.") + format;
      const SurfaceFile file = read_surface_bytes(surface_bytes(name, sheet()).bytes, name);
      const Remeshed remeshed = remeshed_sheet(file.mesh, length);
      ASSERT_GT(remeshed.removed.size(), 0U);
      const SurfaceFile now = refined_file(file, remeshed);
      EXPECT_EQ(now.format, file.format);
      EXPECT_TRUE(now.mesh.has_same_faces(remeshed.mesh)) << format;
      ASSERT_EQ(now.mesh.node_count(), remeshed.mesh.node_count()) << format;
      for (Index node = 0; node < now.mesh.node_count(); ++node)
        EXPECT_LT((now.mesh.position(node) - remeshed.mesh.position(node)).norm(), 1e-6) << format;
      const std::string bytes = surface_bytes(name, now, now.mesh.positions()).bytes;
      const PolygonMesh again = read_surface_bytes(bytes, name).mesh;
      EXPECT_EQ(again.face_count(), remeshed.mesh.face_count()) << format;
      EXPECT_EQ(again.node_count(), remeshed.mesh.node_count()) << format;
    }
  }
}

TEST(RemeshedFile, GroupsAndNormalsHaveNewNodes) {
  SurfaceFile file;
  file.mesh = sheet();
  for (Index node = 0; node < 28; ++node) file.normals.push_back(Vector3(0, 0.6, 0.8));
  for (Index node = 0; node < 25; ++node) file.groups["sheet"].push_back(node);
  file.groups["air"] = {25, 26, 27};
  const Remeshed remeshed = remeshed_sheet(file.mesh, 0.5);
  const SurfaceFile now = refined_file(file, remeshed);
  ASSERT_EQ(now.normals.size(), static_cast<std::size_t>(remeshed.mesh.node_count()));
  for (const Vector3& normal : now.normals) EXPECT_LT((normal - Vector3(0, 0.6, 0.8)).norm(), 1e-12);
  EXPECT_EQ(static_cast<Index>(now.groups.at("sheet").size()), remeshed.mesh.node_count() - 3);
  for (const Index node : now.groups.at("air")) EXPECT_GE(now.mesh.position(node).x(), 10);
  EXPECT_EQ(now.groups.at("air").size(), 3U);
}

}  // namespace
}  // namespace vspring::refined_file_test
