#include <fmt/format.h>

#include "unit/io/scratch.hpp"
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

}  // namespace
}  // namespace vspring::off_test
