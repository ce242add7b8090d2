// Files in memory: the same bytes as on the disk.
#include <gtest/gtest.h>

#include <optional>
#include <string>
#include <vector>

#include "unit/io/scratch.hpp"
#include "vspring/curve_file.hpp"
#include "vspring/error.hpp"
#include "vspring/output_file.hpp"
#include "vspring/point_file.hpp"
#include "vspring/scalar_file.hpp"
#include "vspring/surface_file.hpp"

namespace vspring::bytes_test {
namespace {

class Bytes : public Scratch {
 protected:
  /// What a file holds before something fails to be written to it.
  static constexpr const char* older = "an older file";
};

const PolygonMesh triangle({{0, 0, 0}, {1, 0, 0.1}, {0, 1, 0}}, {0, 3}, {0, 1, 2});

std::vector<Vector3> moved(std::vector<Vector3> positions) {
  positions.back().x() += 0.125;
  return positions;
}

TEST_F(Bytes, OfSurfacesAreThoseOfFiles) {
  for (const std::string format : {"obj", "off", "ply", "stl"}) {
    write_surface(path("new." + format), triangle);
    const std::string bytes = surface_bytes("new." + format, triangle).bytes;
    EXPECT_EQ(bytes, get("new." + format));

    const SurfaceFile read = read_surface(path("new." + format));
    const SurfaceFile in_memory = read_surface_bytes(bytes, path("new." + format));
    EXPECT_EQ(in_memory.mesh.positions(), read.mesh.positions());
    EXPECT_EQ(in_memory.mesh.corners(), read.mesh.corners());
    EXPECT_EQ(in_memory.format, read.format);
    EXPECT_EQ(in_memory.warnings, read.warnings);
    EXPECT_EQ(surface_bytes("-", in_memory, in_memory.mesh.positions()).bytes, bytes);
    const std::vector<Vector3> positions = moved(read.mesh.positions());
    for (const std::string target : {"obj", "off", "ply", "stl"}) {
      const auto losses = write_surface(path("out." + target), read, positions);
      const FileBytes made = surface_bytes("out." + target, in_memory, positions);
      EXPECT_EQ(made.bytes, get("out." + target)) << format << " as " << target;
      EXPECT_EQ(made.losses, losses);
    }
  }
}

TEST_F(Bytes, OfCurvesAreThoseOfFiles) {
  const PolygonCurve curve({{1, 0, 0}, {0.5, 0.25, 0}, {0, 0, 0}}, false);
  for (const std::string format : {"obj", "csv", "dat", "xyz"}) {
    write_curve(path("new." + format), curve, std::nullopt, true);
    const std::string bytes = curve_bytes("new." + format, curve, std::nullopt, true).bytes;
    EXPECT_EQ(bytes, get("new." + format));

    const CurveFile read = read_curve(path("new." + format));
    const CurveFile in_memory = read_curve_bytes(bytes, path("new." + format));
    EXPECT_EQ(in_memory.curve.positions(), read.curve.positions());
    EXPECT_EQ(in_memory.name, read.name);
    EXPECT_EQ(in_memory.warnings, read.warnings);
    EXPECT_EQ(curve_bytes("-", in_memory, in_memory.curve.positions()).bytes, bytes);
    const std::vector<Vector3> positions = moved(read.curve.positions());
    for (const std::string target : {"obj", "csv", "dat", "xyz", "svg"}) {
      const auto losses = write_curve(path("out." + target), read, positions);
      const FileBytes made = curve_bytes("out." + target, in_memory, positions);
      EXPECT_EQ(made.bytes, get("out." + target)) << format << " as " << target;
      EXPECT_EQ(made.losses, losses);
    }
  }
}

TEST_F(Bytes, OfPointsAreReadAsFilesAre) {
  const std::string table = "x,y,z,weight\n1,2,3,4\n5,6,7,0.5\n";
  const ScatteredPoints points = read_points_bytes(table, "points.csv", {"3", "y"});
  EXPECT_EQ(points.positions, read_points(put("points.csv", table), {"3", "y"}).positions);
  EXPECT_EQ(points.positions.front(), Vector3(3, 2, 0));
  EXPECT_EQ(points.weights, (std::vector<double>{4, 0.5}));
  EXPECT_EQ(read_points_bytes(surface_bytes("p.ply", triangle).bytes, "p.ply").positions, triangle.positions());
}

TEST_F(Bytes, OfNumbersAtNodesAreThoseOfFiles) {
  const std::vector<NodeScalar> heights = {{"height", {0, 0.1, 0}}};
  for (const std::string name : {"s.vtp", "s.ply"}) {
    write_scalars(path(name), triangle, heights);
    EXPECT_EQ(scalar_bytes(name, triangle, heights).bytes, get(name));
  }
}

TEST_F(Bytes, AreRefusedByTheNameTheyAreGiven) {
  EXPECT_EQ(message_of([] { (void)read_surface_bytes("", "a.off"); }), "a.off: is empty; choose another file");
  EXPECT_EQ(message_of([] { (void)read_curve_bytes("x,y\n1,b\n", "a.csv"); }),
            message_of([&] { (void)read_curve(put("a.csv", "x,y\n1,b\n")); }));
  EXPECT_EQ(message_of([] { (void)read_points_bytes("1 2\n1 2 3\n", "a.xyz"); }),
            "a.xyz:2: this row has 3 numbers, the first row has 2; correct one of them");
  // The content goes before the name; what neither shows is the caller's to say.
  EXPECT_EQ(read_surface_bytes("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a.obj").warnings,
            (std::vector<std::string>{"a.obj: its content is OFF, not OBJ; it is read as OFF"}));
  EXPECT_EQ(read_surface_bytes("3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", "a", SurfaceFormat::off).mesh.node_count(), 3);
  EXPECT_EQ(message_of([] { (void)surface_bytes("a.step", triangle); }, ErrorCode::invalid_argument),
            "a.step: '.step' is no format; use .obj, .off, .ply or .stl, or name one of them");
}

TEST_F(Bytes, ThatCannotBeMadeLeaveTheFileAsItWas) {
  const SurfaceFile surface = read_surface_bytes(surface_bytes("a.off", triangle).bytes, "a.off");
  const CurveFile curve = read_curve_bytes("0 0\n1 0\n2 1\n", "a.xyz");
  const std::vector<Vector3> too_few(2, Vector3::Zero());
  const std::vector<Vector3> beyond(3, Vector3::Constant(1e300));
  const std::vector<Vector3> raised = {{0, 0, 1}, {1, 0, 0}, {2, 1, 0}};
  const auto refused = [&](const std::string& name, const auto& write) {
    put(name, older);
    (void)message_of([&] { write(path(name)); }, ErrorCode::invalid_argument);
    EXPECT_EQ(get(name), older);
  };
  refused("few.off", [&](const std::string& to) { (void)write_surface(to, surface, too_few); });
  refused("far.stl", [&](const std::string& to) { (void)write_surface(to, surface, beyond); });
  refused("few.xyz", [&](const std::string& to) { (void)write_curve(to, curve, too_few); });
  refused("out.xyz", [&](const std::string& to) { (void)write_curve(to, curve, raised); });
  refused("few.vtp", [&](const std::string& to) { write_scalars(to, triangle, std::vector<NodeScalar>{{"a", {1}}}); });
  EXPECT_EQ(files().size(), 5U);
}

}  // namespace
}  // namespace vspring::bytes_test
