#include <cmath>

#include "unit/io/curve_round_trip.hpp"

namespace vspring::curve_conversion_test {
namespace {

class CurveConversion : public CurveScratch {
 protected:
  std::string as(const CurveFile& file, const std::string& extension,
                 const std::vector<std::string>& losses = {}) const {
    EXPECT_EQ(write_curve(path("as." + extension), file, file.curve.positions()), losses) << extension;
    return get("as." + extension);
  }
};

TEST_F(CurveConversion, KeepsPositionsAndChains) {
  const CurveFile flat = read("x,y\n0,0\n0.1,0.30000000000000004\n\n2,5\n3,-1e-7\n", "csv");
  const std::vector<std::string> names = {"names of columns"};
  EXPECT_EQ(as(flat, "obj", names), "v 0 0 0\nv 0.1 0.30000000000000004 0\nv 2 5 0\nv 3 -1e-07 0\nl 1 2\nl 3 4\n");
  EXPECT_EQ(as(flat, "xyz", names), "0 0\n0.1 0.30000000000000004\n\n2 5\n3 -1e-07\n");
  const CurveFile space = read("0 0 1\n1 2 3\n", "xyz");
  EXPECT_EQ(as(space, "csv"), "x,y,z\n0,0,1\n1,2,3\n");
  EXPECT_EQ(as(space, "obj"), "v 0 0 1\nv 1 2 3\nl 1 2\n");
  for (const std::string other : {"csv", "obj", "xyz"}) {
    write_curve(path("out." + other), space, space.curve.positions());
    EXPECT_EQ(read_curve(path("out." + other)).curve.positions(), space.curve.positions());
  }
}

TEST_F(CurveConversion, SaysWhatIsLost) {
  const CurveFile obj =
      read("# c\no wire\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 5 5 5\nv 6 6 6\nl 1 2 3 1\nl 4 1\nvn 0 0 1\nusemtl a\nf 1 2 3\n",
           "obj");
  EXPECT_EQ(as(obj, "csv",
               {"comments", "faces", "groups", "materials", "normals",
                "that chains share nodes: these are written once for each", "nodes that no chain uses"}),
            "x,y,z\n0,0,0\n1,0,0\n0,1,0\n0,0,0\n\n5,5,5\n0,0,0\n");
  const CurveFile dat = read("foil\n# c\n1 0 TE\n0 0\n", "dat");
  EXPECT_EQ(as(dat, "csv", {"comments", "other columns", "the name"}), "x,y\n1,0\n0,0\n");
  const CurveFile loop = read("v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3 1\n", "obj");
  const std::string closed = "that chains are closed: their first node is written again at their end";
  EXPECT_EQ(as(loop, "dat", {closed}), "curve\n0 0\n1 0\n0 1\n0 0\n");
  EXPECT_EQ(as(read("v 0 0 0\nv 1 0 0\nv 0 1 0\nl 2 3 1\n", "obj"), "dat"), "curve\n1 0\n0 1\n0 0\n");
}

TEST_F(CurveConversion, WritesAClosedChainOfObjWithItsFirstNumberAgain) {
  write_curve(path("out.obj"), PolygonCurve({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, true));
  EXPECT_EQ(get("out.obj"), "v 0 0 0\nv 1 0 0\nv 0 1 0\nl 1 2 3 1\n");
  EXPECT_TRUE(read_curve(path("out.obj")).curve.chains()[0].closed);
}

TEST_F(CurveConversion, TurnsLednicerRound) {
  const CurveFile file = read("foil\n2. 2.\n\n0 0\n1 0.1\n\n0 0\n1 -0.1\n", "dat");
  EXPECT_EQ(as(file, "csv", {"the name", "the order of nodes by sides"}), "x,y\n1,0.1\n0,0\n1,-0.1\n");
}

TEST_F(CurveConversion, AddsAColumnWhereThePlaneIsLeft) {
  const CurveFile file = read("0 0\n1 0\n", "xyz");
  EXPECT_TRUE(write_curve(path("out.csv"), file, {{0, 0, 0}, {1, 0, 2}}).empty());
  EXPECT_EQ(get("out.csv"), "x,y,z\n0,0,0\n1,0,2\n");
  const PolygonCurve space({{0, 0, 0}, {1, 0, 2}});
  EXPECT_EQ(message_of([&] { write_curve(path("a.csv"), space, std::nullopt, true); }, ErrorCode::invalid_argument),
            "node 1: it left the plane z = 0, and the file has only x and y; write another format");
  write_curve(path("a"), PolygonCurve({{0, 0, 0}, {1, 0, 0}}), CurveFormat::csv, true);
  EXPECT_EQ(get("a"), "x,y\n0,0\n1,0\n");
}

TEST_F(CurveConversion, TheContentTellsTheFormatWhereTheExtensionDoesNot) {
  const std::vector<std::pair<std::string, CurveFormat>> texts = {
      {"# c\nv 0 0 0\nv 1 0 0\nl 1 2\n", CurveFormat::obj},
      {"0,0\n1,0\n", CurveFormat::csv},
      {"x y\n0 0\n1 0\n", CurveFormat::csv},
      {"time;x;y\n1;0;0\n2;1;0\n", CurveFormat::csv},
      {"0 0\n1\t0\n", CurveFormat::xyz},
      {"foil\n 0 0\n 1 0\n", CurveFormat::dat},
      {"foil\n2. 2.\n\n0 0\n1 0\n\n0 0\n1 0\n", CurveFormat::dat}};
  for (const auto& [text, format] : texts) {
    for (const std::string extension : {"", ".txt"}) {
      const CurveFile file = read_curve(put("in" + extension, text));
      EXPECT_EQ(file.format, format) << text;
      write_curve(path("out"), file, file.curve.positions());
      EXPECT_EQ(get("out"), text);
    }
  }
  EXPECT_EQ(read_curve(put("in.txt", "0 0\n1 0\n"), CurveFormat::dat).format, CurveFormat::dat);
  EXPECT_EQ(read_curve(put("in.dat", "0 0 0\n1 0 0\n"), CurveFormat::xyz).format, CurveFormat::xyz);
}

TEST_F(CurveConversion, TheTargetTellsTheFormatToWrite) {
  EXPECT_EQ(curve_format(".CSV"), CurveFormat::csv);
  EXPECT_EQ(curve_format("Svg"), CurveFormat::svg);
  EXPECT_EQ(curve_format("txt"), std::nullopt);
  const CurveFile file = read("0 0\n1 0\n", "xyz");
  const auto& positions = file.curve.positions();
  EXPECT_EQ(message_of([&] { write_curve(path("a.step"), file, positions); }, ErrorCode::invalid_argument),
            "a.step: '.step' is no format; use .obj, .csv, .dat, .xyz, .gpx or .svg, or name one of them");
  EXPECT_EQ(message_of([&] { write_curve(path("a"), file.curve); }, ErrorCode::invalid_argument),
            "a: has no extension that shows the format; name OBJ, CSV, DAT, XYZ, GPX or SVG");
  EXPECT_EQ(files(), std::set<std::string>{"in.xyz"});
}

TEST_F(CurveConversion, RefusesPositionsThatDoNotFitTheCurve) {
  CurveFile file = read("0 0\n1 0\n", "xyz");
  EXPECT_EQ(message_of([&] { write_curve(path("a.xyz"), file, {Vector3(1, 2, 0)}); }, ErrorCode::invalid_argument),
            "1 positions given for 2 nodes");
  EXPECT_EQ(message_of(
                [&] {
                  write_curve(path("a.xyz"), PolygonCurve({{0, 0, 0}, {1, NAN, 0}}));
                },
                ErrorCode::invalid_argument),
            "node 1: its position is not finite");
  file.curve = PolygonCurve({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}});
  EXPECT_EQ(message_of([&] { write_curve(path("a.xyz"), file, file.curve.positions()); }, ErrorCode::invalid_argument),
            "the curve is not the one that in.xyz gave; reset the source to write it on its own");
}

}  // namespace
}  // namespace vspring::curve_conversion_test
