#include "unit/io/curve_round_trip.hpp"

namespace vspring::curve_dat_test {
namespace {

class CurveDat : public CurveScratch {};

const std::string selig = "SD 7003-085-88\n  1.00000  0.00130\n 0.5 0.06\n 0.000 0.0\n .5 -0.02\n 1.00000 -0.0013\n";

TEST_F(CurveDat, ReadsSelig) {
  const CurveFile file = read(selig, "dat");
  EXPECT_EQ(file.name, "SD 7003-085-88");
  EXPECT_TRUE(file.planar);
  EXPECT_EQ(file.format, CurveFormat::dat);
  EXPECT_EQ(chain_of(file), (std::vector<Index>{0, 1, 2, 3, 4}));
  EXPECT_FALSE(file.curve.chains()[0].closed);
  EXPECT_EQ(file.curve.position(3), Vector3(0.5, -0.02, 0));
  EXPECT_EQ(unmoved(selig, "dat"), selig);
  EXPECT_EQ(moved(selig, "dat", {{3, {0.5, -0.03, 0}}}), replaced(selig, " .5 -0.02", " .5 -0.03"));
  // Many files have no name.
  EXPECT_EQ(read(selig.substr(15), "dat").curve.node_count(), 5);
  EXPECT_EQ(read("0012\n1 0\n0 0\n", "dat").name, "0012");
}

TEST_F(CurveDat, ReadsANameOfTwoNumbers) {
  const std::string text = "0012 64\n1 0\n0.5 0.06\n0 0\n0.5 -0.06\n1 0\n";
  const CurveFile file = read(text, "dat");
  EXPECT_EQ(file.name, "0012 64");
  EXPECT_EQ(file.curve.node_count(), 5);
  ASSERT_EQ(file.warnings.size(), 1U);
  EXPECT_NE(file.warnings[0].find(":1: these two numbers lie far from all others"), std::string::npos);
  EXPECT_EQ(moved(text, "dat", {{1, {0.5, 0.07, 0}}}), replaced(text, "0.5 0.06", "0.5 0.07"));
  // Not if they count the rows, or may be a place.
  EXPECT_EQ(read("3 2\n0 0\n0.5 .1\n1 0\n0 0\n1 0\n", "dat").name, "");
  EXPECT_EQ(read("90 40\n1 0\n50 9\n0 0\n", "dat").curve.node_count(), 4);
}

TEST_F(CurveDat, PassesOverWordsBelowTheName) {
  const std::string text = "FOIL\nfrom UIUC, 1999\n\nof two\n1 0\n.5 .1\n1 0\n\x1a";
  const CurveFile file = read(text, "dat");
  EXPECT_EQ(file.name, "FOIL");
  EXPECT_EQ(file.curve.node_count(), 3);
  ASSERT_EQ(file.warnings.size(), 1U);
  EXPECT_NE(file.warnings[0].find(":2: this line of words"), std::string::npos);
  EXPECT_EQ(moved(text, "dat", {{1, {.5, .2, 0}}}), replaced(text, ".5 .1", ".5 0.2"));
  EXPECT_EQ(read("A\nwords\n2. 3.\n0 0.01\n1 0\n0 -0.01\n.5 -.1\n1 0\n", "dat").curve.node_count(), 5);
}

TEST_F(CurveDat, EndsWhereDosMarkedTheEnd) {
  for (const std::string& end : {"\x1a", "\r\n\x1a", "\r\n\x1a\r\n"}) {
    const std::string text = "FOIL\r\n1 0\r\n.5 .1\r\n1 0" + end;
    EXPECT_EQ(read(text, "dat").curve.node_count(), 3);
    EXPECT_EQ(unmoved(text, "dat"), text);
  }
}

const std::string lednicer =
    "  NACA 0006 \r\n 3.  3.0\r\n\r\n 0.0 0.0\r\n 0.5 0.03\r\n 1.0 0.001\r\n\r\n 0 0.000\r\n 0.5 -0.03\r\n 1.0 "
    "-0.001\r\n";

TEST_F(CurveDat, ReadsLednicerAsOneChainFromTheTrailingEdge) {
  const CurveFile file = read(lednicer, "dat");
  EXPECT_EQ(file.name, "NACA 0006");
  ASSERT_EQ(file.curve.node_count(), 5);
  EXPECT_EQ(chain_of(file), (std::vector<Index>{2, 1, 0, 3, 4}));
  EXPECT_EQ(file.curve.position(3), Vector3(0.5, -0.03, 0));
  EXPECT_EQ(unmoved(lednicer, "dat"), lednicer);
}

TEST_F(CurveDat, MovesTheLeadingEdgeOfBothSides) {
  EXPECT_EQ(moved(lednicer, "dat", {{0, {-0.01, 0, 0}}, {4, {1, -0.002, 0}}}),
            replaced(replaced(replaced(lednicer, " 0.0 0.0\r", " -0.01 0.0\r"), " 0 0.000\r", " -0.01 0.000\r"),
                     "1.0 -0.001", "1.0 -0.002"));
}

TEST_F(CurveDat, ReadsLednicerWithoutEmptyLinesAndWithTwoLeadingEdges) {
  const CurveFile file = read("A\n2. 3.\n0 0.01\n1 0\n0 -0.01\n.5 -.1\n1 0\n", "dat");
  ASSERT_EQ(file.curve.node_count(), 5);
  EXPECT_EQ(chain_of(file), (std::vector<Index>{1, 0, 2, 3, 4}));
}

TEST_F(CurveDat, TakesLargeCoordinatesForASeligFile) {
  const CurveFile file = read("in millimetres\n100 2\n50 9\n1 2\n50 -1\n100 0\n", "dat");
  EXPECT_EQ(file.curve.node_count(), 5);
  EXPECT_EQ(file.curve.position(0), Vector3(100, 2, 0));
}

TEST_F(CurveDat, WritesOneChainOfThePlaneOnly) {
  PolygonCurve space({{0, 0, 0}, {1, 0, 0.25}});
  EXPECT_EQ(message_of([&] { write_curve(path("out.dat"), space); }, ErrorCode::invalid_argument),
            "node 1: it is not in the plane z = 0, where DAT has its nodes; write another format");
  PolygonCurve two({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}},
                   std::vector<PolygonCurve::Chain>{{{0, 1}, false}, {{2, 3}, false}});
  EXPECT_EQ(message_of([&] { write_curve(path("out.dat"), two); }, ErrorCode::invalid_argument),
            "DAT holds one chain, and the curve has 2; write another format");
  write_curve(path("out.dat"), PolygonCurve({{1, 0, 0}, {0, 0.5, 0}}));
  EXPECT_EQ(get("out.dat"), "curve\n1 0\n0 0.5\n");
}

}  // namespace
}  // namespace vspring::curve_dat_test
