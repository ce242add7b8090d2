#include <fmt/format.h>

#include "unit/io/scratch.hpp"
#include "vspring/surface_file.hpp"

namespace vspring::bad_file_test {
namespace {

class BadFile : public Scratch {};

struct Case {
  std::string name;
  std::string bytes;
  std::string message;  ///< how it begins, after the path
};

const std::string ply_head =
    "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n";
const std::string ply_face = "element face 1\nproperty list uchar int vertex_indices\nend_header\n";

std::string binary_ply(const std::string& faces, const std::string& data) {
  return "ply\nformat binary_little_endian 1.0\nelement vertex 1\nproperty double x\nproperty double y\nproperty "
         "double "
         "z\nelement face " +
         faces + "\nproperty list int int vertex_indices\nend_header\n" + std::string(24, '\0') + data;
}

std::vector<Case> cases() {
  const std::string header(80, 'x');
  const std::size_t size_of_one_node = binary_ply("1", "").size();
  return {
      {"a.obj", "v 0 0 0\nv 1 0 zero\n", ":2: 'zero' stands where a coordinate belongs"},
      {"a.obj", "v 0 0 0\nv 1 0\n", ":2: the line ends where a coordinate belongs"},
      {"a.obj", "v 0 0 0\nv 1 0", ":2: the file ends where a coordinate belongs; it is cut off"},
      {"a.obj", "v 0 0 0 1,5\n", ":1: '1,5' stands where a number belongs"},
      {"a.obj", "v 0 0 0\nf 1 0 1\n", ":2: node 0 does not exist; OBJ counts from 1"},
      {"a.obj", "v 0 0 0\nf 1 -2 1\n", ":2: node -2 does not exist, 1 stand above"},
      {"a.obj", "v 0 0 0\nf 1 1 2\nf 1 1 7\nf 1 3 1\n", ":3: node 7 does not exist, the file has 1"},
      {"a.obj", "v 0 0 0\nf 1 1 99999999999999\n", ":2: node 1073741825 does not exist"},
      {"a.obj", "v 0 0 0\nf 1 1 99999999999999999999\n",
       ":2: '99999999999999999999' stands where the number of a node"},
      {"a.obj", "v 0 0 0\nf 1 1//1 1\n", ":2: normal 1 does not exist, the file has 0"},
      {"a.obj", "v 0 0 0\nf 1 1x 1\n", ":2: 'x' stands where the next node"},
      {"a.obj", "v 0 0 0\nf 1 a/b 1\n", ":2: 'a/b' stands where the number of a node belongs"},
      {"a.obj", "v 0 0 0\nf\n", ":2: the line ends where the number of a node belongs"},
      {"a.obj", "v 0 0 0\nf 1 1", ":2: the file ends inside a face; it is cut off"},
      {"a.obj", "vn 0 0 1\n", ": no node"},
      {"a.obj", "hello\nworld\n", ": no node"},
      {"a.obj",
       std::string("\xff\xfe"
                   "v\0 \0",
                   6),
       ": is in UTF-16; save it in UTF-8"},
      {"a.off", "OFF\n", ":2: the file ends where the number of nodes belongs"},
      {"a.off", "OFF\nmany 1 0\n", ":2: 'many' stands where the number of nodes belongs"},
      {"a.off", "OFF\n-1 1 0\n", ":2: -1 stands where the number of nodes belongs"},
      {"a.off", "OFF\n0 0 0\n", ": it has no nodes"},
      {"a.off", "OFF\n1000000000000 1 0\n1 2 3\n",
       ":2: the header counts 1000000000000 nodes, but the file is too short"},
      {"a.off", "OFF\n1 1000000000000 0\n1 2 3\n",
       ":2: the header counts 1000000000000 faces, but the file is too short"},
      {"a.off", "OFF\n2 0 0\n1 2 3             \n", ":4: the file ends after 1 of 2 nodes; it is cut off"},
      {"a.off", "OFF\n1 2 0\n1 2 3\n3 0 0 0\n", ":5: the file ends after 1 of 2 faces; it is cut off"},
      {"a.off", "OFF\n1 1 0\n1 2 3\n3 0 0 0\n3 0 0 0\n", ":5: the file goes on after its 1 faces"},
      {"a.off", "OFF\n3 2 0\n0 0 0\n1 0\n0 1 0\n3 0 1 2\n3 0 2 1\n",
       ":4: node 1 has 2 numbers, those before it have 3"},
      {"a.off", "OFF\n3 2 0\n0 0 0\n1 0 0 0\n0 1 0\n3 0 1 2\n3 0 2 1\n",
       ":4: node 1 has 4 numbers, those before it have 3"},
      {"a.off", "OFF 3 2 0 0 0 0 1 0 0 0 1 0 3 0 1 2 3 0\n2 7", ":2: node 7 does not exist, nodes go from 0 to 2"},
      {"a.off", "OFF 3 2 0 0 0 0 1 0 0 0 1 0 3 0 1 2 3 0\n2", ":2: the file ends where the number of a node belongs"},
      {"a.off", "OFF 3 1 0 0 0 0 1 0 0 0 one\n0 3 0 1 2\n", ":1: 'one' stands where a coordinate belongs"},
      {"a.off", "OFF\n3 3 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 2 # 1\n3 0 1 2\n",
       ":8: node 3 does not exist, nodes go from 0 to 2; correct the face, which goes on from line 7"},
      {"a.off", "OFF\n4 3 0\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n3 0 1 2\n3 0 2 # 1\n3 0 1 2\n",
       ":8: the line ends where the number of a node belongs; repair the line"},
      {"a.off", "OFF\n3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 255 0 0\n3 0 2 9\n", ":7: node 9 does not exist"},
      {"a.off", "OFF\n1 1 0\n0 0\n3 0 0 0\n", ":3: a node needs 3 numbers, this line has 2"},
      {"a.off", "OFF\n1 1 0\n0 0 0\n3 0 1 0\n", ":4: node 1 does not exist, nodes go from 0 to 0"},
      {"a.off", "OFF\n1 1 0\n0 0 0\n3 0 -1 0\n", ":4: node -1 does not exist"},
      {"a.off", "OFF\n1 1 0\n0 0 0\n3 0 0\n", ":4: the line ends where the number of a node belongs"},
      {"a.off", "OFF\n1 1 0\n0 0 0\n0    \n", ":4: face 0 has 0 nodes"},
      {"a.off", "4OFF\n1 0 0\n0 0 0 0\n", ":1: '4OFF' has nodes in another space than three dimensions"},
      {"a.off", "nOFF\n3\n1 0 0\n0 0 0\n", ":1: 'nOFF' has nodes in another space than three dimensions"},
      {"a.off", "OFF BINARY\n....", ":1: binary OFF is not read"},
      {"a.off", "QOFF\n1 0 0\n", ":1: 'QOFF' is not a kind of OFF"},
      {"a.ply", "hello\n", ":1: a PLY file begins with a line 'ply'"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 2\n", ":4: the file ends inside its header; it is cut off"},
      {"a.ply", "ply\nelement vertex 1\nproperty float x\nproperty float y\nproperty float z\nend_header\n",
       ":6: the header has no line 'format'"},
      {"a.ply", "ply\nformat binary_middle_endian 1.0\n", ":2: 'binary_middle_endian' is not a format of PLY"},
      {"a.ply", "ply\nformat ascii 2.0\n", ":2: PLY of version '2.0' is not read"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex two\n", ":3: 'two' stands where the number of elements belongs"},
      {"a.ply", "ply\nformat ascii 1.0\nproperty float x\n", ":3: a property before the first element"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty real x\n", ":4: 'real' is not a type of PLY"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float\n", ":4: a property needs a type and a name"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty list float int x\n", ":4: the length of a list"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 2\nelement vertex 2\n", ":4: a second element 'vertex'"},
      {"a.ply", ply_head + "property int x\n", ":7: a second property 'x'"},
      {"a.ply", "ply\nformat ascii 1.0\nhello\n", ":3: 'hello' is not a line of a PLY header"},
      {"a.ply", "ply\nformat ascii 1.0\nelement face 0\nproperty list uchar int vertex_indices\nend_header\n",
       ": its header has no element 'vertex'"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nend_header\n",
       ": its nodes have no property z"},
      {"a.ply", "ply\nformat ascii 1.0\nelement vertex 0\nproperty float x\nend_header\n", ": it has no nodes"},
      {"a.ply", ply_head + "element face 1\nproperty float area\nend_header\n1 2 3 4 5 6 7\n",
       ": element 'face' has no list vertex_indices"},
      {"a.ply", ply_head + ply_face + "1 2 3\n4 5 x\n3 0 0 0\n", ":11: 'x' stands where a number belongs"},
      {"a.ply", ply_head + ply_face + "1 2 3\n4 5 6\n", ":12: the file ends where"},
      {"a.ply", ply_head + ply_face + "1 2 3\n4 5    ", ":11: the file ends where a number belongs; it is cut off"},
      {"a.ply", ply_head + ply_face + "1 2 3\n4 5 6\n3 0 1 2\n", ":12: node 2 does not exist, nodes go from 0 to 1"},
      {"a.ply", ply_head + ply_face + "1 2 3\n4 5 6\n3 0 1 -1\n", ":12: face 0 of 1: node -1 does not exist"},
      {"a.ply", ply_head + ply_face + "1 2 3\n4 5 6\n3 0 1 1.5\n", ":12: '1.5' stands where a whole number belongs"},
      {"a.ply", ply_head + ply_face + "1 2 3\n4 5 6\n-3 0 1 1\n", ":12: face 0 of 1: a list of -3 numbers"},
      {"a.ply", ply_head + ply_face + "1 2 3\n4 5 6\n4000000000 0 1 1\n",
       ":12: face 0 of 1: a list of 4000000000 numbers"},
      {"a.ply", ply_head + ply_face + "1 2 3\n4 5 6\n3 0 1 1\n3 0 1 0\n",
       ":13: the file goes on after its last element"},
      {"a.ply", replaced(ply_head, "vertex 2", "vertex 999999999999999") + ply_face + "1 2 3\n",
       ": more than 2^30 nodes"},
      {"a.ply", replaced(ply_head, "vertex 2", "vertex 1000000000") + ply_face + "1 2 3\n",
       ": the header counts 1000000000 elements 'vertex', but the file is too short"},
      {"a.ply", binary_ply("999999999999", ""),
       ": the header counts 999999999999 elements 'face', but the file is too short"},
      {"a.ply", binary_ply("1", std::string("\3\0\0\0\0\0\0\0", 8)),
       fmt::format(": byte {}: the file ends inside face 0 of 1", size_of_one_node + 4)},
      {"a.ply", binary_ply("1", std::string("\1\0\0\0\5\0\0\0", 8)),
       fmt::format(": byte {}: node 5 does not exist", size_of_one_node + 8)},
      {"a.ply", binary_ply("0", "more"),
       fmt::format(": byte {}: the file goes on after its last element", size_of_one_node)},
      {"a.stl", "short", ": it is too short for STL"},
      {"a.stl", header + std::string("\5\0\0\0", 4) + std::string(60, '\1'),
       ": its header counts 5 triangles, which take 334 bytes"},
      {"a.stl", header + std::string(4, '\0'), ": it has no triangles"},
      {"a.stl", "solid\nendsolid\n", ": it has no triangles"},
      {"a.stl", "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
       ":5: the file ends where 'vertex' belongs; it is cut off"},
      {"a.stl", "solid a\nfacet normal 0 0 one\n", ":2: 'one' stands where a number belongs"},
      {"a.stl", "solid a\nfacet normal 0 0 1\nendloop\n", ":3: 'endloop' stands where 'outer' belongs"},
      {"a.stl", "solid a\nfacet normal 0 0 1 outer loop vertex 0 0 0 vertex 1 0 0 vertex 0 1 0 endloop endfacet\n",
       ":3: the file ends where 'facet' or 'endsolid' belongs; it is cut off"},
      {"a.dat", "hello\n", ": its content is not OBJ, OFF, PLY or STL"},
      {"a.dat", "", ": is empty"},
      {"a.obj", "", ": is empty"},
  };
}

TEST_F(BadFile, IsRefusedInOneLineThatSaysWhereAndWhat) {
  for (const Case& bad : cases()) {
    SCOPED_TRACE(bad.bytes);
    const std::string message = message_of([&] { std::ignore = read_surface(put(bad.name, bad.bytes)); });
    EXPECT_EQ(message.substr(0, bad.name.size() + bad.message.size()), bad.name + bad.message);
    EXPECT_NE(message.find(';'), std::string::npos) << "says what to do: " << message;
  }
}

// Wherever a file is cut off, it is refused or what is left of it makes sense; nothing else happens.
TEST_F(BadFile, MayBeCutOffAnywhere) {
  MeshBuilder builder;
  for (int k = 0; k < 4; ++k) builder.add_node({k * 1.0, k * k * 1.0, 0.5});
  builder.add_face({0, 1, 2});
  builder.add_face({0, 2, 3});
  const PolygonMesh mesh = builder.take();
  for (const std::string name : {"a.obj", "a.off", "a.ply", "a.stl"}) {
    write_surface(path(name), mesh);
    const std::string whole = get(name);
    for (std::size_t length = 0; length < whole.size(); ++length) {
      put(name, whole.substr(0, length));
      // Lines of text are whole files too, in OBJ; OFF may lack its last line end.
      const bool may_pass = name == "a.obj" || (name == "a.off" && length + 1 == whole.size());
      try {
        std::ignore = read_surface(path(name));
        EXPECT_TRUE(may_pass) << name << " of " << length << " bytes";
      } catch (const Error& error) {
        EXPECT_EQ(error.code(), ErrorCode::unusable_file);
      }
    }
  }
}

TEST_F(BadFile, MayBeAMillionZeros) {
  std::string zeros;
  zeros.resize(1'000'000);
  for (const std::string name : {"a.obj", "a.off", "a.ply", "a.stl", "a.dat", "a"}) {
    const std::string message = message_of([&] { std::ignore = read_surface(put(name, zeros)); });
    EXPECT_LT(message.size(), 200U);
    EXPECT_EQ(message.find('\0'), std::string::npos);
  }
}

TEST_F(BadFile, MayBeMissingOrAFolderOrForbidden) {
  EXPECT_EQ(message_of([&] { std::ignore = read_surface(path("none.obj")); }).substr(0, 52),
            "none.obj: cannot be read: No such file or directory;");
  std::filesystem::create_directory(path("folder.obj"));
  EXPECT_EQ(message_of([&] { std::ignore = read_surface(path("folder.obj")); }).substr(0, 43),
            "folder.obj: cannot be read: Is a directory;");
  if (::geteuid() == 0) return;  // root may read everything
  std::filesystem::permissions(put("secret.obj", "v 0 0 0\n"), std::filesystem::perms::none);
  EXPECT_EQ(message_of([&] { std::ignore = read_surface(path("secret.obj")); }).substr(0, 46),
            "secret.obj: cannot be read: Permission denied;");
}

}  // namespace
}  // namespace vspring::bad_file_test
