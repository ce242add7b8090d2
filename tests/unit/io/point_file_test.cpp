#include "vspring/point_file.hpp"

#include <fmt/format.h>

#include "unit/io/scratch.hpp"
#include "vspring/generate.hpp"
#include "vspring/surface_file.hpp"

namespace vspring::point_file_test {
namespace {

using Weights = std::vector<double>;

class PointFile : public Scratch {
 protected:
  ScatteredPoints read(const std::string& name, const std::string& text) { return read_points(put(name, text)); }
  std::string refusal(const std::string& name, const std::string& text) {
    return message_of([&] { std::ignore = read(name, text); });
  }
};

TEST_F(PointFile, IsTheNodesOfEverySurface) {
  const PolygonMesh mesh = generate::plane({.columns = 3, .rows = 2, .faces = generate::Faces::triangles});
  for (const char* name : {"a.obj", "a.off", "a.ply"}) {
    write_surface(path(name), mesh);
    const ScatteredPoints points = read_points(path(name));
    EXPECT_EQ(points.positions, mesh.positions()) << name;
    EXPECT_TRUE(points.weights.empty());
  }
  write_surface(path("a.stl"), mesh);
  EXPECT_EQ(read_points(path("a.stl")).positions.size(), mesh.positions().size());
}

TEST_F(PointFile, PlyHasWeightsAmongAllElseThatItHas) {
  const std::string text =
      "ply\nformat ascii 1.0\nelement camera 1\nproperty list uchar int id\nelement vertex 2\nproperty float "
      "confidence\n"
      "property double z\nproperty list uchar int seen\nproperty double x\nproperty float y\nproperty uchar weight\n"
      "element face 1\nproperty list uchar int vertex_indices\nend_header\n"
      "2 8 9\n0.5 3 1 7 1 2 200\n0.25 6 0 4 5 0\n3 0 1 99\n";
  const ScatteredPoints points = read("a.ply", text);
  EXPECT_EQ(points.positions, (std::vector<Vector3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(points.weights, (Weights{200, 0}));
  EXPECT_EQ(read("a.ply", replaced(text, "uchar weight", "uchar height")).weights, (Weights{0.5, 0.25}));
  EXPECT_EQ(refusal("a.ply", replaced(text, "4 5 0\n", "4 5 -1\n")),
            "a.ply:17: vertex 1 of 2: its weight is -1; give 0 or more");
  EXPECT_NE(refusal("a.ply", replaced(text, "200", "nan")).find("vertex 0 of 2: its weight is nan"), std::string::npos);
  EXPECT_NE(refusal("a.ply", replaced(text, "double x", "double a")).find("no property x"), std::string::npos);
  EXPECT_NE(refusal("a.ply", text.substr(0, text.size() - 19)).find("a.ply"), std::string::npos);
}

TEST_F(PointFile, BinaryPlyOfSingles) {
  std::string bytes =
      "ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\n"
      "property float weight\nend_header\n";
  for (const float value : {1.0F, 2.0F, 3.0F, 0.5F, 4.0F, 5.0F, 6.0F, 2.0F})
    bytes.append(reinterpret_cast<const char*>(&value), sizeof(value));
  const ScatteredPoints points = read("a.ply", bytes);
  EXPECT_EQ(points.positions, (std::vector<Vector3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(points.weights, (Weights{0.5, 2}));
  EXPECT_NE(refusal("a.ply", bytes.substr(0, bytes.size() - 2)).find("too short"), std::string::npos);
}

TEST_F(PointFile, CsvHasTheColumnsThatTheHeaderNames) {
  const std::string text = "# scan\nid;Weight;z;y;x\n1;0.5;3;2;1\n\n# more\n2;0;6;5;4\n";
  const ScatteredPoints points = read("a.csv", text);
  EXPECT_EQ(points.positions, (std::vector<Vector3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(points.weights, (Weights{0.5, 0}));
  EXPECT_EQ(read("a.csv", "x,y,confidence\n1,2,3\n").weights, Weights{3});
  EXPECT_TRUE(read("a.csv", "1,2,3,4\n").weights.empty());  // nobody says that 4 is a weight
  EXPECT_EQ(refusal("a.csv", replaced(text, "1;0.5", "1;inf")), "a.csv:3: the weight is inf; give 0 or more");
  EXPECT_EQ(refusal("a.csv", replaced(text, "2;0;", "2;light;")),
            "a.csv:6: 'light' stands where the weight belongs; repair the line");
}

TEST_F(PointFile, IsNotInUtf16) {
  const std::string text(
      "\xff\xfe"
      "1\0 \0"
      "2\0",
      8);
  for (const std::string name : {"a.csv", "a.xyz", "a.txt"})
    EXPECT_EQ(refusal(name, text), name + ": is in UTF-16; save it in UTF-8");
}

TEST_F(PointFile, XyzMayHaveAHeader) {
  const ScatteredPoints points = read("a.xyz", "weight x y z\n2 1 2 3\n0.5 4 5 6\n");
  EXPECT_EQ(points.positions, (std::vector<Vector3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(points.weights, (Weights{2, 0.5}));
}

TEST_F(PointFile, CsvColumnsAreNamedWithUnitsOrChosen) {
  const std::vector<Vector3> expected = {{1, 2, 3}, {4, 5, 6}};
  const ScatteredPoints named = read("a.csv", "no,weight,X [mm],Y [mm],Z [mm]\n1,2,1,2,3\n2,2,4,5,6\n");
  EXPECT_EQ(named.positions, expected);
  EXPECT_EQ(named.weights, (Weights{2, 2}));
  EXPECT_TRUE(named.warnings.empty());
  const std::string text = "0,1,2,3\n1,4,5,6\n2,7,8,9\n";
  EXPECT_EQ(refusal("a.csv", text),
            "a.csv:1: column 1 counts rows, so columns 1, 2, 3, 4 cannot be told apart; choose columns, such as "
            "2,3,4");
  for (const std::string name : {"a.csv", "a.xyz"}) {
    const std::string rows = name == "a.csv" ? text : "0 1 2 3\n1 4 5 6\n2 7 8 9\n";
    const ScatteredPoints chosen = read_points(put(name, rows), {"2", "3", "4"});
    EXPECT_EQ(chosen.positions[1], expected[1]);
    EXPECT_TRUE(chosen.weights.empty());
  }
  // What is no coordinate by its name is not guessed to be one.
  const ScatteredPoints guessed = read("a.csv", "right,weight,forward,height\n1,7,2,3\n4,7,5,6\n");
  EXPECT_EQ(guessed.positions, expected);
  ASSERT_EQ(guessed.warnings.size(), 1U);
  EXPECT_NE(guessed.warnings[0].find("taken are columns 1 and 3 and 4"), std::string::npos);
  for (const std::string name : {"a.obj", "a.dat"}) {
    const std::string message = message_of(
        [&] {
          std::ignore = read_points(put(name, name == "a.obj" ? "v 1 2 3\n" : "0 1\n1 2\n"), {"1", "2"});
        },
        ErrorCode::invalid_argument);
    EXPECT_EQ(message.substr(0, 40), name + ": columns can be chosen in CSV, XYZ");
  }
}

TEST_F(PointFile, XyzHasWeightsInRowsOfFourOrSevenNumbers) {
  EXPECT_EQ(read("a.xyz", "1 2 3 0.5\n4 5 6 2\n").weights, (Weights{0.5, 2}));
  EXPECT_EQ(read("a.xyz", "1 2 3 0 0 1 0.5\n").weights, Weights{0.5});
  for (const std::string row : {"1 2", "1 2 3", "1 2 3 wall", "1 2 3 4 5", "1 2 3 0 0 1", "1 2 3 0 0 1 0.5 8"}) {
    const ScatteredPoints points = read("a.xyz", fmt::format("{0}\n# and\n{0}\n", row));
    EXPECT_TRUE(points.weights.empty()) << row;
    ASSERT_EQ(points.positions.size(), 2U);
    EXPECT_EQ(points.positions[1], Vector3(1, 2, row.size() > 3 ? 3 : 0));
  }
  EXPECT_EQ(refusal("a.xyz", "1 2 3 1\n1 2 3\n"),
            "a.xyz:2: this row has 3 numbers, the first row has 4; correct one of them");
  EXPECT_EQ(refusal("a.xyz", "1 2\n1 2 3\n"),
            "a.xyz:2: this row has 3 numbers, the first row has 2; correct one of them");
  EXPECT_EQ(refusal("a.xyz", "1 2 3 -1\n"), "a.xyz:1: the weight is -1; give 0 or more");
  EXPECT_NE(refusal("a.xyz", "# nothing\n").find("no row"), std::string::npos);
}

TEST_F(PointFile, NormalsOfEveryFormat) {
  const std::vector<Vector3> normals = {{0, 0, 1}, {0.6, 0, -0.8}};
  const std::string ply =
      "ply\nformat ascii 1.0\nelement vertex 2\nproperty double nx\nproperty double x\nproperty double y\nproperty "
      "double z\nproperty double ny\nproperty double nz\nend_header\n0 1 2 3 0 1\n0.6 4 5 6 0 -0.8\n";
  const ScatteredPoints points = read("a.ply", ply);
  EXPECT_EQ(points.positions, (std::vector<Vector3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(points.normals, normals);
  EXPECT_TRUE(read("a.ply", replaced(ply, "double ny", "double na")).normals.empty());
  EXPECT_EQ(read("a.xyz", "1 2 3 0 0 1\n4 5 6 0.6 0 -0.8\n").normals, normals);
  EXPECT_EQ(read("a.xyz", "1 2 3 0 0 1 0.5\n4 5 6 0.6 0 -0.8 2\n").normals, normals);
  EXPECT_TRUE(read("a.xyz", "1 2 3 255 0 17\n").normals.empty());  // a colour
  EXPECT_EQ(refusal("a.xyz", "1 2 3 0 0 1\n1 2 3\n"),
            "a.xyz:2: this row has 3 numbers, the first row has 6; correct one of them");
  EXPECT_EQ(read("a.csv", "NX,ny,nz,x,y,z\n0,0,1,1,2,3\n0.6,0,-0.8,4,5,6\n").normals, normals);
  EXPECT_TRUE(read("a.csv", "nx,ny,x,y,z\n0,0,1,2,3\n").normals.empty());
  const std::string obj = "v 1 2 3\nvn 0 0 1\nv 4 5 6\nvn 0.6 0 -0.8\nf 1//1 2/7/2 -1//-1\n";
  EXPECT_EQ(read("a.obj", obj).normals, normals);
  // In another order, or of something else.
  EXPECT_TRUE(read("a.obj", replaced(obj, "1//1", "1//2")).normals.empty());
  EXPECT_TRUE(read("a.obj", obj + "vn 1 0 0\n").normals.empty());
}

TEST_F(PointFile, OfOtherKinds) {
  EXPECT_EQ(read("a.obj", "v 1 2 3 1\nl 1 1\nv 4 5 6\nvn 0 0 1\nf 1 2 77\n").positions,
            (std::vector<Vector3>{{1, 2, 3}, {4, 5, 6}}));
  EXPECT_EQ(read("a.dat", "aerofoil\n1 0\n0.5 0.1\n0 0\n").positions.size(), 3U);
  // Without an extension that says something, by the content.
  EXPECT_EQ(read("scan", "1 2 3 0.5\n").weights, Weights{0.5});
  EXPECT_EQ(read("scan", "x,y,weight\n1,2,3\n").weights, Weights{3});
  EXPECT_EQ(read("scan", "OFF\n1 0 0\n1 2 3\n").positions, std::vector<Vector3>{Vector3(1, 2, 3)});
  EXPECT_NE(refusal("a.svg", "<svg/>\n").find("picture"), std::string::npos);
  EXPECT_NE(refusal("a.obj", "vn 0 0 1\n").find("no node"), std::string::npos);
}

}  // namespace
}  // namespace vspring::point_file_test
