#include <fmt/format.h>

#include <cmath>

#include "unit/io/curve_round_trip.hpp"

namespace vspring::curve_table_test {
namespace {

class CurveTable : public CurveScratch {};

TEST_F(CurveTable, ReadsEveryDelimiter) {
  for (const std::string between : {",", ";", "\t", " ", " , ", "   "}) {
    const auto row = [&](const std::string& x, const std::string& y, const std::string& z) {
      return fmt::format("{1}{0}{2}{0}{3}\n", between, x, y, z);
    };
    const std::string text = row("x", "y", "z") + row("0.5", "1", "-2e1") + row("+3", "nan", "5");
    const CurveFile file = read(text, "csv");
    ASSERT_EQ(file.curve.node_count(), 2) << between;
    EXPECT_EQ(file.curve.position(0), Vector3(0.5, 1, -20));
    EXPECT_TRUE(std::isnan(file.curve.position(1).y()));
    EXPECT_FALSE(file.planar);
    EXPECT_EQ(file.format, CurveFormat::csv);
    EXPECT_EQ(unmoved(text, "csv"), text);
    EXPECT_EQ(moved(text, "csv", {{0, {0.5, 7, -20}}}),
              replaced(text, row("0.5", "1", "-2e1"), row("0.5", "7", "-20")));
  }
}

TEST_F(CurveTable, FindsTheColumnsThatTheHeaderNames) {
  const std::string text =
      "# probe 7\n"
      "\"id\",\"Z\", \"y\" ,x,note\n"
      "1,30,20,10,\"a, b\"\n"
      "# between\n"
      "2, \"31\" ,21,11,\"say \"\"x, y\"\"\"\n";
  const CurveFile file = read(text, "csv");
  ASSERT_EQ(file.curve.node_count(), 2);
  EXPECT_EQ(file.curve.position(0), Vector3(10, 20, 30));
  EXPECT_EQ(file.curve.position(1), Vector3(11, 21, 31));
  EXPECT_TRUE(file.warnings.empty());
  EXPECT_EQ(moved(text, "csv", {{1, {1.5, 2.5, 3.5}}}), replaced(text, "2, \"31\" ,21,11,", "2, \"3.5\" ,2.5,1.5,"));
}

TEST_F(CurveTable, TakesTheFirstColumnsOfNumbersWhereNoneAreNamed) {
  const CurveFile plain = read("P1,0,1,a\nP2,2,3,b\n", "csv");
  EXPECT_TRUE(plain.planar);
  EXPECT_EQ(plain.curve.position(1), Vector3(2, 3, 0));
  EXPECT_TRUE(plain.warnings.empty());
  const CurveFile headed = read("point,east,north\nP1,0,1\nP2,2,3\n", "csv");
  EXPECT_EQ(headed.curve.position(1), Vector3(2, 3, 0));
  ASSERT_EQ(headed.warnings.size(), 1U);
  EXPECT_NE(headed.warnings[0].find(":1: no columns are named x and y; taken are columns 2 and 3"), std::string::npos);
  // Of x and y named, nothing else is a coordinate.
  EXPECT_TRUE(read("x,y,speed\n0,1,2\n3,4,5\n", "csv").planar);
}

TEST_F(CurveTable, BeginsAChainBehindEmptyRows) {
  for (const std::string empty : {"\n", "\r\n", " \t\n", ",,\n", "\n# and\n\n"}) {
    const std::string text = "\nx,y\n\n0,0\n1,0\n" + empty + "2,0\n3,0\n4,0\n\n\n";
    const CurveFile file = read(text, "csv");
    ASSERT_EQ(file.curve.chains().size(), 2U);
    EXPECT_EQ(chain_of(file, 0), (std::vector<Index>{0, 1}));
    EXPECT_EQ(chain_of(file, 1), (std::vector<Index>{2, 3, 4}));
    EXPECT_EQ(unmoved(text, "csv"), text);
  }
}

TEST_F(CurveTable, StaysOpenWhereTheLastNodeRepeatsTheFirst) {
  const CurveFile file = read("0,0\n1,0\n0,1\n0,0\n", "csv");
  EXPECT_EQ(file.curve.node_count(), 4);
  EXPECT_FALSE(file.curve.chains()[0].closed);
}

TEST_F(CurveTable, TakesEveryLineEndAndTheMarkBeforeUtf8) {
  const std::string mark = "\xEF\xBB\xBF";
  for (const std::string end : {"\n", "\r\n", "\r"}) {
    for (const std::string& text :
         {fmt::format("{0}x,y{1}0,0{1}1,2", mark, end), fmt::format("0 0 \t{0}1 2  {0}", end)}) {
      for (const std::string extension : {"csv", "xyz"}) {
        if (extension == "xyz" && text.starts_with(mark)) continue;
        EXPECT_EQ(unmoved(text, extension), text);
        EXPECT_EQ(read(text, extension).curve.position(1), Vector3(1, 2, 0));
      }
    }
  }
  EXPECT_EQ(moved(mark + "x,y\r\n0,0\r\n1,2", "csv", {{1, {1, 3, 0}}}), mark + "x,y\r\n0,0\r\n1,3");
}

TEST_F(CurveTable, ReadsXyzWithAnythingBehindTheCoordinates) {
  const std::string text = "# scan\n 1.0 2 3.50 255 0 0 left\n\t4 5 6\n\n7 8 9 \"\n7 8 10\n";
  const CurveFile file = read(text, "xyz");
  EXPECT_EQ(file.format, CurveFormat::xyz);
  ASSERT_EQ(file.curve.chains().size(), 2U);
  EXPECT_EQ(file.curve.position(0), Vector3(1, 2, 3.5));
  EXPECT_EQ(moved(text, "xyz", {{0, {1, 2, 0.1}}, {3, {0, 0, 0}}}),
            replaced(replaced(text, "1.0 2 3.50", "1 2 0.1"), "7 8 10", "0 0 0"));
  const CurveFile flat = read("0 1 a\n2 3 b\n", "xyz");
  EXPECT_TRUE(flat.planar);
  EXPECT_EQ(flat.curve.position(1), Vector3(2, 3, 0));
}

TEST_F(CurveTable, RefusesToLeaveThePlaneOfTwoColumns) {
  EXPECT_EQ(message_of(
                [&] {
                  moved("0,0\n1,0\n", "csv", {{1, {1, 0, 0.5}}});
                },
                ErrorCode::invalid_argument),
            "node 1: it left the plane z = 0, and the file has only x and y; write another format");
}

}  // namespace
}  // namespace vspring::curve_table_test
