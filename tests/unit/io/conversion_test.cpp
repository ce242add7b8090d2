#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "io/formats.hpp"
#include "unit/io/scratch.hpp"
#include "vspring/surface_file.hpp"

namespace vspring::conversion_test {
namespace {

class Conversion : public Scratch {};

constexpr std::array names = {"obj", "off", "ply", "stl"};

/// Triangles, a quadrilateral, a pentagon, a node that no face uses, and coordinates that need all their digits.
PolygonMesh mixed() {
  MeshBuilder builder;
  for (int k = 0; k < 8; ++k) builder.add_node({k / 3.0, std::sqrt(k + 1.0), -1e-5 * k * k});
  builder.add_node({7, 7, 7});
  builder.add_face({0, 1, 2});
  builder.add_face({2, 1, 3, 4});
  builder.add_face({4, 3, 5, 6, 7});
  return builder.take();
}

TEST_F(Conversion, KeepsNodesAndFacesBetweenAllFormats) {
  const PolygonMesh mesh = mixed();
  for (const std::string first : {"obj", "off", "ply"}) {
    write_surface(path("first." + first), mesh);
    for (const std::string second : {"obj", "off", "ply"}) {
      const SurfaceFile surface = read_surface(path("first." + first));
      EXPECT_TRUE(write_surface(path("second." + second), surface, surface.mesh.positions()).empty());
      const SurfaceFile again = read_surface(path("second." + second));
      EXPECT_EQ(again.mesh.positions(), mesh.positions());
      EXPECT_EQ(again.mesh.corners(), mesh.corners());
      EXPECT_EQ(again.mesh.face_begin(), mesh.face_begin());
      EXPECT_TRUE(again.warnings.empty());
    }
  }
}

TEST_F(Conversion, CutsFacesIntoTrianglesForStlAndSaysSo) {
  write_surface(path("in.obj"), mixed());
  const SurfaceFile surface = read_surface(path("in.obj"));
  const auto losses = write_surface(path("out.stl"), surface, surface.mesh.positions());
  EXPECT_EQ(losses, (std::vector<std::string>{
                        "faces of more than three nodes: they are cut into triangles from their first node",
                        "nodes that no face uses", "precision beyond single"}));
  const SurfaceFile again = read_surface(path("out.stl"));
  EXPECT_EQ(again.mesh.corners(), (std::vector<Index>{0, 1, 2, 2, 1, 3, 2, 3, 4, 4, 3, 5, 4, 5, 6, 4, 6, 7}));
  for (Index node = 0; node < 8; ++node)
    EXPECT_EQ(again.mesh.position(node), surface.mesh.position(node).cast<float>().cast<double>());
}

TEST_F(Conversion, RefusesStlWithoutTriangles) {
  const SurfaceFile points = read_surface(put("in.obj", "v 0 0 0\nv 1 0 0\nl 1 2\n"));
  EXPECT_EQ(
      message_of([&] { write_surface(path("out.stl"), points, points.mesh.positions()); }, ErrorCode::invalid_argument),
      "STL holds nothing but triangles, and the mesh has no face of three nodes; write another format");
  EXPECT_EQ(files(), std::set<std::string>{"in.obj"});
}

TEST_F(Conversion, NamesEverythingThatIsLost) {
  const SurfaceFile obj =
      read_surface(put("in.obj",
                       "# c\nmtllib a\ng a\nv 0 0 0 1 1 1\nv 1 0 0\nv 0 1 0\nvt 0 0\ns 1\nvn 0 0 1\nvn 0 1 0\nl 1 2\n"
                       "f 1//1 2//1 3//1\nf 1//2 2//1 3//1\n"));
  EXPECT_EQ(write_surface(path("out.off"), obj, obj.mesh.positions()),
            (std::vector<std::string>{"colours", "comments", "groups", "lines", "materials",
                                      "normals that differ between the faces of a node", "smoothing groups",
                                      "texture coordinates"}));
  const SurfaceFile ply = read_surface(
      put("in.ply",
          "ply\nformat ascii 1.0\ncomment c\nelement vertex 1\nproperty float x\nproperty float y\nproperty "
          "float z\nproperty uchar red\nproperty float s\nproperty float heat\nelement edge 0\nproperty int "
          "a\nend_header\n1 2 3 4 5 6\n"));
  EXPECT_EQ(write_surface(path("out.obj"), ply, ply.mesh.positions()),
            (std::vector<std::string>{"colours", "comments", "element edge", "property heat of vertex",
                                      "texture coordinates"}));
  const SurfaceFile off = read_surface(put("in.off", "STCOFF # c\n1 0 0\n0 0 0 1 0 0 0.5 0.5\n"));
  EXPECT_EQ(write_surface(path("out.ply"), off, off.mesh.positions()),
            (std::vector<std::string>{"colours", "comments", "texture coordinates"}));
  const SurfaceFile stl = read_surface(
      put("in.stl",
          "solid name\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n"
          "endsolid\n"));
  EXPECT_EQ(write_surface(path("out.ply"), stl, stl.mesh.positions()),
            (std::vector<std::string>{"names of solids", "normals of triangles"}));
}

/// Circles of latitude on a sphere, and the poles.
PolygonMesh sphere(Index circles, Index around, const Vector3& centre, double radius) {
  MeshBuilder builder;
  builder.add_node(centre + Vector3(0, 0, radius));
  for (Index i = 1; i <= circles; ++i) {
    for (Index k = 0; k < around; ++k) {
      const double polar = std::numbers::pi * i / (circles + 1);
      const double turn = 2 * std::numbers::pi * (k + 0.3 * i) / around;
      builder.add_node(centre + radius * Vector3(std::sin(polar) * std::cos(turn), std::sin(polar) * std::sin(turn),
                                                 std::cos(polar)));
    }
  }
  const Index last = builder.add_node(centre - Vector3(0, 0, radius));
  const auto node = [&](Index circle, Index k) { return 1 + circle * around + k % around; };
  for (Index k = 0; k < around; ++k) {
    builder.add_face({0, node(0, k), node(0, k + 1)});
    for (Index i = 0; i + 1 < circles; ++i) {
      builder.add_face({node(i, k), node(i + 1, k), node(i + 1, k + 1)});
      builder.add_face({node(i, k), node(i + 1, k + 1), node(i, k + 1)});
    }
    builder.add_face({last, node(circles - 1, k + 1), node(circles - 1, k)});
  }
  return builder.take();
}

// The weights are exact for nodes on a sphere, however they lie on it, so the normals of a file are known there.
TEST_F(Conversion, NormalsAreThoseOfTheSphereOnWhichTheNodesCameToLie) {
  for (const Index size : {3, 8, 20}) {
    for (const double radius : {1e-150, 2.0, 1e150}) {
      SurfaceFile ball;
      ball.mesh = sphere(size, size + 2, Vector3::Zero(), radius);
      for (const Vector3& position : ball.mesh.positions()) ball.normals.push_back(position / radius);
      for (const std::string name : {"obj", "off", "ply"}) {
        EXPECT_TRUE(write_surface(path("ball." + name), ball, ball.mesh.positions()).empty());
        SurfaceFile surface = read_surface(path("ball." + name));
        ASSERT_EQ(surface.normals.size(), ball.normals.size());
        // To a smaller sphere that touches the first at its north pole.
        std::vector<Vector3> positions = surface.mesh.positions();
        for (Vector3& position : positions) position = (position + Vector3(0, 0, radius)) / 2;
        for (const std::string other : {"obj", "off", "ply"}) {
          write_surface(path("out." + other), surface, positions);
          const SurfaceFile moved = read_surface(path("out." + other));
          ASSERT_EQ(moved.mesh.positions(), positions);
          for (std::size_t node = 0; node < positions.size(); ++node)
            EXPECT_LT((moved.normals[node] - ball.normals[node]).norm(), 1e-13) << name << other << node;
        }
      }
    }
  }
}

TEST_F(Conversion, TheContentTellsTheFormat) {
  const PolygonMesh mesh = mixed();
  for (const std::string name : names) {
    write_surface(path("in." + name), mesh);
    const SurfaceFormat format = surface_format(name).value();
    EXPECT_EQ(detect_format(get("in." + name)), format) << name;
    for (const std::string other : {"dat", "stl", "obj", "off", "ply"}) {
      const SurfaceFile surface = read_surface(put("as." + other, get("in." + name)));
      EXPECT_EQ(surface.format, format);
      const bool warned = !surface.warnings.empty() && surface.warnings[0].find("its content is") != std::string::npos;
      EXPECT_EQ(warned, other != name && other != "dat") << name << " as " << other;
    }
    EXPECT_NE(read_surface(path("as.dat"), name == "off" ? SurfaceFormat::ply : SurfaceFormat::off).warnings.size(),
              0U);
  }
  EXPECT_EQ(detect_format("# a\n\n  mtllib x\n"), SurfaceFormat::obj);
  EXPECT_EQ(detect_format("solid\nendsolid\n"), SurfaceFormat::stl);
  EXPECT_EQ(detect_format("STCNOFF\n"), SurfaceFormat::off);
  EXPECT_EQ(detect_format("1 2 3\n"), std::nullopt);
  EXPECT_EQ(detect_format("offer of the day\n"), std::nullopt);
  // Without its keyword OFF is told by its extension, or by who asks.
  EXPECT_EQ(read_surface(put("plain.off", "1 0 0\n1 2 3\n")).mesh.position(0), Vector3(1, 2, 3));
  EXPECT_EQ(read_surface(put("plain", "1 0 0\n1 2 3\n"), SurfaceFormat::off).mesh.position(0), Vector3(1, 2, 3));
}

TEST_F(Conversion, TheTargetTellsTheFormatToWrite) {
  EXPECT_EQ(surface_format(".PLY"), SurfaceFormat::ply);
  EXPECT_EQ(surface_format("Off"), SurfaceFormat::off);
  EXPECT_EQ(surface_format("step"), std::nullopt);
  EXPECT_EQ(surface_format(""), std::nullopt);
  const PolygonMesh mesh = mixed();
  write_surface(path("in.off"), mesh);
  const SurfaceFile surface = read_surface(path("in.off"));
  write_surface(path("none"), surface, mesh.positions());
  EXPECT_EQ(get("none"), get("in.off"));
  write_surface(path("asked.obj"), surface, mesh.positions(), SurfaceFormat::ply);
  EXPECT_EQ(get("asked.obj").substr(0, 4), "ply\n");
  EXPECT_EQ(message_of([&] { write_surface(path("a.step"), surface, mesh.positions()); }, ErrorCode::invalid_argument),
            "a.step: '.step' is no format; use .obj, .off, .ply or .stl, or name one of them");
  EXPECT_EQ(message_of([&] { write_surface(path("a"), mesh); }, ErrorCode::invalid_argument),
            "a: has no extension that shows the format; name OBJ, OFF, PLY or STL");
  EXPECT_EQ(files(), (std::set<std::string>{"asked.obj", "in.off", "none"}));
}

TEST_F(Conversion, RefusesPositionsThatDoNotFitTheMesh) {
  const PolygonMesh mesh = mixed();
  write_surface(path("in.off"), mesh);
  SurfaceFile surface = read_surface(path("in.off"));
  EXPECT_EQ(message_of([&] { write_surface(path("a.off"), surface, {Vector3(1, 2, 3)}); }, ErrorCode::invalid_argument),
            "1 positions given for 9 nodes");
  surface.mesh = sphere(3, 4, Vector3::Zero(), 1);
  EXPECT_EQ(
      message_of([&] { write_surface(path("a.off"), surface, surface.mesh.positions()); }, ErrorCode::invalid_argument),
      "the mesh is not the one that in.off gave; reset the source to write it on its own");
  surface.source.reset();
  write_surface(path("a.off"), surface, surface.mesh.positions());
  EXPECT_EQ(read_surface(path("a.off")).mesh.corners(), surface.mesh.corners());
}

TEST_F(Conversion, RefusesNodesThatAreNowhere) {
  PolygonMesh mesh = mixed();
  std::vector<Vector3> positions = mesh.positions();
  positions[3].y() = std::numeric_limits<double>::infinity();
  mesh.set_positions(positions);
  for (const char* name : {"a.obj", "a.off", "a.ply", "a.stl"}) {
    EXPECT_EQ(message_of([&] { write_surface(path(name), mesh); }, ErrorCode::invalid_argument),
              "node 3: its position is not finite");
  }
  EXPECT_TRUE(files().empty());
}

TEST_F(Conversion, KeepsFacesOfManySides) {
  MeshBuilder builder;
  std::vector<Index> face(300);
  for (Index& node : face) {
    const double angle = static_cast<double>(&node - face.data()) / 48;
    node = builder.add_node({std::cos(angle), std::sin(angle), 0});
  }
  builder.add_face(face);
  const PolygonMesh mesh = builder.take();
  for (const char* name : {"a.obj", "a.off", "a.ply"}) {
    write_surface(path(name), mesh);
    EXPECT_EQ(read_surface(path(name)).mesh.corners(), face) << name;
  }
}

TEST_F(Conversion, WritesWhatTheCallerPutIntoTheMesh) {
  write_surface(path("in.off"), mixed());
  SurfaceFile surface = read_surface(path("in.off"));
  std::vector<Vector3> positions = surface.mesh.positions();
  positions[4] = {1, 2, 3};
  surface.mesh.set_positions(positions);
  write_surface(path("out.off"), surface, surface.mesh.positions());
  EXPECT_EQ(read_surface(path("out.off")).mesh.positions(), positions);
}

}  // namespace
}  // namespace vspring::conversion_test
