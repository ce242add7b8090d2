#include <fmt/format.h>

#include <array>
#include <bit>

#include "io/binary_numbers.hpp"
#include "unit/io/scratch.hpp"
#include "vspring/surface_file.hpp"

namespace vspring::ply_test {
namespace {

/// Writes the same PLY as text or in either byte order.
class Ply {
 public:
  enum Encoding { text, little, big };
  explicit Ply(Encoding encoding, const std::string& line_end = "\n") : encoding_(encoding), line_end_(line_end) {
    line("ply");
    line(encoding == text     ? "format ascii 1.0"
         : encoding == little ? "format binary_little_endian 1.0"
                              : "format binary_big_endian 1.0");
  }
  Ply& line(const std::string& words) {
    bytes += words + line_end_;
    return *this;
  }
  template <typename Number>
  Ply& put(Number number) {
    if (encoding_ == text) {
      bytes += fmt_number(number) + " ";
      return *this;
    }
    std::array<char, sizeof(Number)> room;
    store(room.data(), number, swapped_here(encoding_ == little ? std::endian::little : std::endian::big));
    bytes.append(room.data(), room.size());
    return *this;
  }
  Ply& end_row() {
    if (encoding_ == text) bytes += line_end_;
    return *this;
  }

  std::string bytes;

 private:
  template <typename Number>
  static std::string fmt_number(Number number) {
    std::string digits = std::to_string(number);
    if (digits.find('.') == std::string::npos) return digits;
    while (digits.back() == '0') digits.pop_back();
    if (digits.back() == '.') digits.pop_back();
    return digits;
  }

  Encoding encoding_;
  std::string line_end_;
};

constexpr std::array encodings = {Ply::text, Ply::little, Ply::big};

// Two triangles that bend along an edge, and what else a file may carry: properties of every type, lists among
// them before the coordinates, and other elements before, between and behind.
std::string rich(Ply::Encoding encoding, const std::string& line_end, const std::array<Vector3, 4>& places,
                 const std::array<Vector3, 4>& normals) {
  Ply ply(encoding, line_end);
  ply.line("comment made by hand").line("obj_info scanner 7");
  ply.line("element camera 1").line("property list uint8 double view").line("property int16 lens");
  ply.line("element vertex 4")
      .line("property uchar red")
      .line("property float nx")
      .line("property list ushort char tags");
  ply.line("property double y").line("property float x").line("property float32 ny").line("property double z");
  ply.line("property float nz").line("property int quality");
  ply.line("element edge 2").line("property int vertex1").line("property int vertex2");
  ply.line("element face 2").line("property uchar flags").line("property list uchar uint vertex_index");
  ply.line("property list uchar float texcoord").line("element nothing 5").line("end_header");
  ply.put(std::uint8_t{2}).put(0.5).put(0.25).put(std::int16_t{-300}).end_row();
  for (std::size_t node = 0; node < 4; ++node) {
    ply.put(static_cast<std::uint8_t>(200 + node)).put(static_cast<float>(normals[node].x()));
    ply.put(static_cast<std::uint16_t>(node));
    for (std::size_t k = 0; k < node; ++k) ply.put(static_cast<std::int8_t>(-5));
    ply.put(places[node].y()).put(static_cast<float>(places[node].x())).put(static_cast<float>(normals[node].y()));
    ply.put(places[node].z()).put(static_cast<float>(normals[node].z())).put(std::int32_t{-70000}).end_row();
  }
  ply.put(std::int32_t{0}).put(std::int32_t{1}).end_row().put(std::int32_t{1}).put(std::int32_t{2}).end_row();
  for (const std::array<std::uint32_t, 3>& face : {std::array<std::uint32_t, 3>{0, 1, 2}, {0, 2, 3}}) {
    ply.put(std::uint8_t{1}).put(std::uint8_t{3});
    for (const std::uint32_t node : face) ply.put(node);
    ply.put(std::uint8_t{2}).put(0.5F).put(0.75F).end_row();
  }
  return ply.bytes;
}

class PlyFile : public Scratch {
 protected:
  SurfaceFile read(const std::string& bytes) const { return read_surface(put("in.ply", bytes)); }
};

const std::array<Vector3, 4> places = {Vector3(0.5, 0.25, 0), Vector3(1.5, 0.25, 0), Vector3(1.5, 1.25, 0),
                                       Vector3(0.5, 1.25, 0)};
const std::array<Vector3, 4> up = {Vector3::UnitZ(), Vector3::UnitZ(), Vector3::UnitZ(), Vector3::UnitZ()};

TEST_F(PlyFile, ReadsAnyElementsAndPropertiesInEveryEncoding) {
  for (const Ply::Encoding encoding : encodings) {
    for (const std::string line_end : {"\n", "\r\n", "\r"}) {
      const SurfaceFile surface = read(rich(encoding, line_end, places, up));
      EXPECT_EQ(surface.mesh.positions(), std::vector<Vector3>(places.begin(), places.end()));
      EXPECT_EQ(surface.mesh.corners(), (std::vector<Index>{0, 1, 2, 0, 2, 3}));
      EXPECT_EQ(surface.mesh.face_begin(), (std::vector<Index>{0, 3, 6}));
      EXPECT_EQ(surface.normals, std::vector<Vector3>(up.begin(), up.end()));
      EXPECT_TRUE(surface.warnings.empty());
    }
  }
}

TEST_F(PlyFile, ComesOutByteForByteButForMovedNodesAndTheirNormals) {
  for (const Ply::Encoding encoding : encodings) {
    for (const std::string line_end : {"\n", "\r\n"}) {
      const std::string before = rich(encoding, line_end, places, up);
      const SurfaceFile surface = read(before);
      EXPECT_TRUE(write_surface(path("out.ply"), surface, surface.mesh.positions()).empty());
      EXPECT_EQ(get("out.ply"), before);

      // The whole is turned so that it stands upright: every coordinate and normal is known.
      std::array<Vector3, 4> turned;
      std::array<Vector3, 4> sideways;
      for (std::size_t node = 0; node < 4; ++node) {
        turned[node] = {places[node].z(), places[node].x(), places[node].y()};
        sideways[node] = Vector3::UnitX();
      }
      EXPECT_TRUE(write_surface(path("out.ply"), surface, {turned.begin(), turned.end()}).empty());
      EXPECT_EQ(get("out.ply"), rich(encoding, line_end, turned, sideways));

      // In its plane one node moves: only its coordinates change.
      std::array<Vector3, 4> stretched = places;
      stretched[1].y() = -3.75;
      write_surface(path("out.ply"), surface, {stretched.begin(), stretched.end()});
      EXPECT_EQ(get("out.ply"), rich(encoding, line_end, stretched, up));
    }
  }
}

std::string triangle(Ply::Encoding encoding, const std::string& type, const auto& x) {
  Ply ply(encoding);
  ply.line("element vertex 3");
  for (const std::string name : {"x", "y", "z"}) ply.line(fmt::format("property {} {}", type, name));
  ply.line("element face 1").line("property list uchar int vertex_indices").line("end_header");
  for (const auto& value : x) {
    ply.put(value);
    if ((&value - x.data()) % 3 == 2) ply.end_row();
  }
  return ply.put(std::uint8_t{3}).put(0).put(1).put(2).end_row().bytes;
}

TEST_F(PlyFile, SinglePrecisionStaysSingle) {
  std::array<float, 9> values = {0, 0, 0, 1, 0, 0, 0, 1, 0};
  for (const Ply::Encoding encoding : {Ply::little, Ply::big}) {
    const SurfaceFile surface = read(triangle(encoding, "float", values));
    std::vector<Vector3> positions = surface.mesh.positions();
    positions[1].x() = 1.0 / 3;
    write_surface(path("out.ply"), surface, positions);
    std::array<float, 9> after = values;
    after[3] = 1.0F / 3;
    EXPECT_EQ(get("out.ply"), triangle(encoding, "float", after));
  }
  const SurfaceFile surface = read(triangle(Ply::text, "float", values));
  std::vector<Vector3> positions = surface.mesh.positions();
  positions[1].x() = 1.0 / 3;
  write_surface(path("out.ply"), surface, positions);
  EXPECT_EQ(get("out.ply"), replaced(triangle(Ply::text, "float", values), "\n1 0 0", "\n0.33333334 0 0"));
  for (const Ply::Encoding encoding : encodings) {
    const SurfaceFile single = read(triangle(encoding, "float", values));
    positions[1].x() = 1e39;
    const auto message =
        message_of([&] { write_surface(path("none.ply"), single, positions); }, ErrorCode::invalid_argument);
    EXPECT_EQ(message, "node 1: 1e+39 does not fit single precision; write another format");
    EXPECT_EQ(files().count("none.ply"), 0U);
  }
}

/// Nothing but positions and faces, in types and an order of their own; after: what else may follow.
template <typename Real, typename Count, typename Node>
std::string plain(Ply::Encoding encoding, const std::array<std::string, 3>& types, const std::vector<Vector3>& nodes,
                  const std::vector<std::vector<int>>& faces, const std::string& after = "") {
  Ply ply(encoding);
  ply.line("comment made by hand").line(fmt::format("element vertex {}", nodes.size()));
  for (const std::string axis : {"z", "x", "y"}) ply.line(fmt::format("property {} {}", types[0], axis));
  ply.line(fmt::format("element face {}", faces.size()));
  ply.line(fmt::format("property list {} {} vertex_index", types[1], types[2])).line("end_header");
  for (const Vector3& node : nodes) {
    for (const double value : {node.z(), node.x(), node.y()}) ply.put(static_cast<Real>(value));
  }
  for (const auto& face : faces) {
    ply.put(static_cast<Count>(face.size()));
    for (const int node : face) ply.put(static_cast<Node>(node));
  }
  return ply.bytes + after;
}

TEST_F(PlyFile, OfNothingButAMeshComesOutByteForByte) {
  const std::vector<std::vector<int>> faces = {{0, 1, 2}, {3, 2, 1, 0}, {4, 3, 0}};
  const std::vector<Vector3> nodes = {{0, 0, -0.0}, {1, 0.5, 0}, {1, 2, 0.25}, {0, 1, 3}, {-1, 7, 0}};
  std::vector<Vector3> moved = nodes;
  moved[3].y() = 1.25;
  for (const Ply::Encoding encoding : {Ply::little, Ply::big}) {
    const auto check = [&](const auto& make) {
      const SurfaceFile surface = read(make(nodes));
      write_surface(path("out.ply"), surface, nodes);
      EXPECT_EQ(get("out.ply"), make(nodes));
      write_surface(path("out.ply"), surface, moved);
      EXPECT_EQ(get("out.ply"), make(moved));
    };
    check([&](const std::vector<Vector3>& at) {
      return plain<double, std::uint8_t, std::int32_t>(encoding, {"double", "uchar", "int"}, at, faces);
    });
    check([&](const std::vector<Vector3>& at) {
      return plain<float, std::int32_t, std::uint16_t>(encoding, {"float", "int", "ushort"}, at, faces);
    });
    // Something follows that no mesh has.
    check([&](const std::vector<Vector3>& at) {
      return plain<float, std::uint16_t, std::int8_t>(encoding, {"float", "ushort", "char"}, at, faces, "\n");
    });
  }
}

TEST_F(PlyFile, WholeNumbersBecomeDoublesWhenNodesMove) {
  for (const Ply::Encoding encoding : encodings) {
    const std::string before = triangle(encoding, "short", std::array<std::int16_t, 9>{0, 0, 0, 300, 0, 0, 0, -7, 0});
    const SurfaceFile surface = read(before);
    EXPECT_EQ(surface.mesh.position(1), Vector3(300, 0, 0));
    EXPECT_EQ(surface.mesh.position(2), Vector3(0, -7, 0));
    EXPECT_TRUE(write_surface(path("out.ply"), surface, surface.mesh.positions()).empty());
    EXPECT_EQ(get("out.ply"), before);
    std::vector<Vector3> positions = surface.mesh.positions();
    positions[1].z() = 0.5;
    EXPECT_EQ(write_surface(path("out.ply"), surface, positions).size(), 1U);
    EXPECT_EQ(get("out.ply"), triangle(encoding, "double", std::array<double, 9>{0, 0, 0, 300, 0, 0.5, 0, -7, 0}));
  }
}

TEST_F(PlyFile, SmallWholeNumbersAreCornersAndNormalsThatAreKept) {
  for (const Ply::Encoding encoding : encodings) {
    Ply ply(encoding);
    ply.line("element vertex 3");
    for (const char* name : {"x", "y", "z"}) ply.line(std::string("property double ") + name);
    for (const char* name : {"nx", "ny", "nz"}) ply.line(std::string("property char ") + name);
    ply.line("element face 1").line("property list char char vertex_indices").line("end_header");
    const auto number = [](int value) { return static_cast<std::int8_t>(value); };
    for (int node = 0; node < 3; ++node) {
      for (int k = 0; k < 3; ++k) ply.put(k + 1 == node ? 1.0 : 0.0);
      for (const int part : {0, 0, -1}) ply.put(number(part));
      ply.end_row();
    }
    for (const int entry : {3, 2, 1, 0}) ply.put(number(entry));
    ply.end_row();
    const SurfaceFile surface = read(ply.bytes);
    EXPECT_EQ(surface.mesh.corners(), (std::vector<Index>{2, 1, 0}));
    EXPECT_EQ(surface.normals, std::vector<Vector3>(3, Vector3(0, 0, -1)));
    std::vector<Vector3> positions = surface.mesh.positions();
    positions[1].z() = 0.5;
    EXPECT_EQ(write_surface(path("out.ply"), surface, positions),
              (std::vector<std::string>{
                  "normals that fit the moved nodes: the file holds whole numbers, kept as they were"}));
    const SurfaceFile again = read_surface(path("out.ply"));
    EXPECT_EQ(again.mesh.positions(), positions);
    EXPECT_EQ(again.normals, surface.normals);
  }
}

TEST_F(PlyFile, CutsStripsIntoTriangles) {
  for (const Ply::Encoding encoding : encodings) {
    Ply ply(encoding);
    ply.line("element tristrips 1").line("property list int int vertex_indices");
    ply.line("element vertex 5").line("property float x").line("property float y").line("property float z");
    ply.line("end_header").put(std::int32_t{10});
    for (const std::int32_t node : {0, 1, 2, 3, 3, 4, -1, 4, 3, 2}) ply.put(node);
    ply.end_row();
    for (int k = 0; k < 5; ++k) ply.put(static_cast<float>(k)).put(0.5F).put(0.5F).end_row();
    const SurfaceFile surface = read(ply.bytes);
    EXPECT_EQ(surface.mesh.corners(), (std::vector<Index>{0, 1, 2, 2, 1, 3, 4, 3, 2}));
    std::vector<Vector3> positions = surface.mesh.positions();
    positions[3].y() = 8;
    write_surface(path("out.ply"), surface, positions);
    EXPECT_EQ(read_surface(path("out.ply")).mesh.positions(), positions);
    EXPECT_EQ(get("out.ply").substr(0, 200), ply.bytes.substr(0, 200));
  }
}

TEST_F(PlyFile, ReadsPointsWithoutFaces) {
  const SurfaceFile surface = read(
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n"
      "1 2\n3 4 5 6");
  EXPECT_EQ(surface.mesh.face_count(), 0);
  EXPECT_EQ(surface.mesh.position(1), Vector3(4, 5, 6));
}

}  // namespace
}  // namespace vspring::ply_test
