#include <array>

#include "io/binary_numbers.hpp"
#include "unit/io/scratch.hpp"
#include "vspring/surface_file.hpp"

namespace vspring::stl_test {
namespace {

using Facet = std::array<Vector3, 4>;  // normal and corners

std::string binary(const std::string& header, const std::vector<Facet>& facets) {
  std::string bytes = header;
  bytes.resize(80, '\0');
  const auto put = [&](auto number) {
    std::array<char, sizeof(number)> room;
    store(room.data(), number, swapped_here(std::endian::little));
    bytes.append(room.data(), room.size());
  };
  put(static_cast<std::uint32_t>(facets.size()));
  for (std::size_t facet = 0; facet < facets.size(); ++facet) {
    for (const Vector3& vector : facets[facet]) {
      for (const double value : vector) put(static_cast<float>(value));
    }
    put(static_cast<std::uint16_t>(1000 + facet));
  }
  return bytes;
}

const Vector3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0), d(0, 0, 1), zero(0, 0, 0);

/// A tetrahedron with its top anywhere, and behind its faces one that has collapsed at the top.
std::vector<Facet> tetrahedron(const Vector3& top) {
  const auto facet = [](const Vector3& p, const Vector3& q, const Vector3& r) {
    const Vector3 u = q - p;
    const Vector3 v = r - p;
    const Vector3 normal(u.y() * v.z() - u.z() * v.y(), u.z() * v.x() - u.x() * v.z(), u.x() * v.y() - u.y() * v.x());
    return Facet{normal.normalized(), p, q, r};
  };
  return {facet(a, c, b), facet(a, b, top), facet(b, c, top), facet(c, a, top), {zero, b, top, top}};
}

class StlFile : public Scratch {
 protected:
  SurfaceFile read(const std::string& bytes) const { return read_surface(put("in.stl", bytes)); }
};

TEST_F(StlFile, WeldsCornersAtTheSamePlace) {
  // The header of a binary file may begin like that of text.
  const SurfaceFile surface = read(binary("solid but binary", tetrahedron(d)));
  EXPECT_EQ(surface.mesh.positions(), (std::vector<Vector3>{a, c, b, d}));
  EXPECT_EQ(surface.mesh.corners(), (std::vector<Index>{0, 1, 2, 0, 2, 3, 2, 1, 3, 1, 0, 3}));
  ASSERT_EQ(surface.warnings.size(), 2U);
  EXPECT_NE(surface.warnings[0].find("15 corners of 5 triangles are welded to 4 nodes"), std::string::npos);
  EXPECT_NE(surface.warnings[1].find("1 triangles, the first of them number 4,"), std::string::npos);
}

TEST_F(StlFile, WeldsZeroOfEitherSign) {
  EXPECT_EQ(read(binary("", {{zero, a, b, c}, {zero, Vector3(-0.0, 0, -0.0), c, d}})).mesh.node_count(), 4);
}

TEST_F(StlFile, WritesAllCornersOfAMovedNodeAndTheNormalsThere) {
  const std::string before = binary("header", tetrahedron(d));
  const SurfaceFile surface = read(before);
  EXPECT_TRUE(write_surface(path("out.stl"), surface, surface.mesh.positions()).empty());
  EXPECT_EQ(get("out.stl"), before);
  std::vector<Vector3> positions = surface.mesh.positions();
  positions[3] = {0, 0, 2};
  EXPECT_TRUE(write_surface(path("out.stl"), surface, positions).empty());
  EXPECT_EQ(get("out.stl"), binary("header", tetrahedron({0, 0, 2})));
  positions[3] = {0, 0, 1e40};
  EXPECT_EQ(message_of([&] { write_surface(path("no.stl"), surface, positions); }, ErrorCode::invalid_argument),
            "node 3: 1e+40 does not fit single precision; write another format");
  EXPECT_EQ(files(), (std::set<std::string>{"in.stl", "out.stl"}));
}

TEST_F(StlFile, KeepsTextAsItIsButForMovedNodes) {
  const auto text = [](const std::string& normal, const std::string& top) {
    return "solid one thing\n"
           "  facet normal 0 0 -1\r\n outer loop\n  vertex 0 0 0\n vertex 0 1 0\n vertex 1.0 0 0\n endloop\nendfacet\n"
           "FACET NORMAL " +
           normal + "\nOUTER LOOP vertex 0 -0 0 vertex 1 0 0 vertex " + top +
           "\nENDLOOP ENDFACET\nendsolid one thing\nsolid other\nendsolid\n";
  };
  const std::string before = text("0 -1.0 0", "0 0 1");
  const SurfaceFile surface = read(before);
  EXPECT_EQ(surface.mesh.positions(), (std::vector<Vector3>{a, c, b, d}));
  EXPECT_EQ(surface.mesh.corners(), (std::vector<Index>{0, 1, 2, 0, 2, 3}));
  write_surface(path("out.stl"), surface, surface.mesh.positions());
  EXPECT_EQ(get("out.stl"), before);
  std::vector<Vector3> positions = surface.mesh.positions();
  positions[3] = {0, 2, 0};
  write_surface(path("out.stl"), surface, positions);
  EXPECT_EQ(get("out.stl"), text("0 0 1", "0 2 0"));
}

TEST_F(StlFile, TakesWordsThatStandApartAndColours) {
  const auto text = [](const std::string& top) {
    return "solid part\ncolor 0.5 0.5 0.5\nfacet normal 0 0 -1\nouter loop\nvertex 0 0 0\nvertex 0 1 0\nvertex 1 0 0\n"
           "end loop\nend facet\nCOLOR 1 0 0\nfacet normal 0 -1 0\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nvertex " +
           top + "\nendloop\ncolour 3\nendfacet\nend solid part\n";
  };
  const SurfaceFile surface = read(text("0 0 1"));
  EXPECT_EQ(surface.mesh.corners(), (std::vector<Index>{0, 1, 2, 0, 2, 3}));
  std::vector<Vector3> positions = surface.mesh.positions();
  positions[3] = {0, 0, 2};
  write_surface(path("out.stl"), surface, positions);
  EXPECT_EQ(get("out.stl"), text("0 0 2"));
}

TEST_F(StlFile, KeepsBytesBehindTheTriangles) {
  const std::string before = binary("header", tetrahedron(d)) + "made by somebody";
  const SurfaceFile surface = read(before);
  EXPECT_EQ(surface.mesh.face_count(), 4);
  EXPECT_NE(surface.warnings.back().find("16 bytes come behind the 5 triangles"), std::string::npos);
  std::vector<Vector3> positions = surface.mesh.positions();
  positions[3] = {0, 0, 2};
  write_surface(path("out.stl"), surface, positions);
  EXPECT_EQ(get("out.stl"), binary("header", tetrahedron({0, 0, 2})) + "made by somebody");
}

TEST_F(StlFile, WeldsAGridOfAnySize) {
  for (const Index side : {1, 7, 60}) {
    std::vector<Facet> facets;
    for (Index row = 0; row < side; ++row) {
      for (Index column = 0; column < side; ++column) {
        const Vector3 p(column, row, 0);
        facets.push_back({zero, p, p + b, p + b + c});
        facets.push_back({zero, p, p + b + c, p + c});
      }
    }
    const SurfaceFile surface = read(binary("", facets));
    EXPECT_EQ(surface.mesh.node_count(), (side + 1) * (side + 1));
    EXPECT_EQ(surface.mesh.face_count(), 2 * side * side);
  }
}

}  // namespace
}  // namespace vspring::stl_test
