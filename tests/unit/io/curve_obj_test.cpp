#include <cmath>

#include "unit/io/curve_round_trip.hpp"

namespace vspring::curve_obj_test {
namespace {

class CurveObj : public CurveScratch {};

const std::string rich =
    "# a wire \\\n"
    "o the wire\r\n"
    "v  0.10 0 0 1 0.5 0.25\n"
    "v\t1 0e0\t0   # right\n"
    "vt 0 0\n"
    "v +0 1 -0.0\r\n"
    "v 0 \\\n  0 \\\r\n  1.50\n"
    "g left\n"
    "l 1/1 2/1 3/\n"
    "g right loop\n"
    "l -2 \\\n -1 # on\n"
    "usemtl red\n"
    "f 1 2 3\n"
    "vn 0 0 1\n"
    "strange 1 2\n"
    "v 7 7 7";

TEST_F(CurveObj, ReadsLinesInAllTheirForms) {
  const CurveFile file = read(rich, "obj");
  ASSERT_EQ(file.curve.node_count(), 5);
  EXPECT_EQ(file.curve.position(0), Vector3(0.1, 0, 0));
  EXPECT_EQ(file.curve.position(3), Vector3(0, 0, 1.5));
  ASSERT_EQ(file.curve.chains().size(), 1U);
  EXPECT_EQ(chain_of(file), (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_FALSE(file.curve.chains()[0].closed);
  EXPECT_FALSE(file.planar);
  EXPECT_EQ(file.format, CurveFormat::obj);
  ASSERT_EQ(file.warnings.size(), 1U);
  EXPECT_NE(file.warnings[0].find(":18: 'strange' is not a known statement"), std::string::npos) << file.warnings[0];
}

TEST_F(CurveObj, GathersTheNodesOfGroups) {
  const auto groups = read(rich, "obj").groups;
  ASSERT_EQ(groups.size(), 4U);
  EXPECT_EQ(groups.at("the wire"), (std::vector<Index>{0, 1, 2, 3}));
  EXPECT_EQ(groups.at("left"), (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(groups.at("right"), (std::vector<Index>{2, 3}));
  EXPECT_EQ(groups.at("loop"), (std::vector<Index>{2, 3}));
}

TEST_F(CurveObj, ChangesNothingButMovedCoordinates) {
  for (const std::string& text :
       {rich, rich + "\n", rich + "\r\n\n", std::string("\xEF\xBB\xBFv 1 2 3\nv 1 2 4\nl 1 2")})
    EXPECT_EQ(unmoved(text, "obj"), text);
  EXPECT_EQ(moved(rich, "obj", {{0, {0.1, 0.1 + 0.2, -1e-7}}}),
            replaced(rich, "0.10 0 0 1", "0.1 0.30000000000000004 -1e-07 1"));
  EXPECT_EQ(moved(rich, "obj", {{3, {1, 2, 3}}}), replaced(rich, "v 0 \\\n  0 \\\r\n  1.50", "v 1 \\\n  2 \\\r\n  3"));
  EXPECT_EQ(moved(rich, "obj", {{4, {7, 7, 8}}}), replaced(rich, "v 7 7 7", "v 7 7 8"));
}

TEST_F(CurveObj, JoinsShuffledSegmentsIntoSeveralCurves) {
  std::string text;
  for (int k = 0; k < 8; ++k) text += "v " + std::to_string(k) + " 0 0\n";
  // A closed curve of 1 to 4, an open one of 5 to 8.
  const CurveFile file = read(text + "l 3 4\nl 6 5\nl 2 1\nl 7 8\nl 1 4\nl 3 2\nl 6 7\nl 3 4\nl 4 3\n", "obj");
  ASSERT_EQ(file.curve.chains().size(), 2U);
  EXPECT_TRUE(file.curve.chains()[0].closed);
  EXPECT_EQ(chain_of(file, 0), (std::vector<Index>{2, 3, 0, 1}));
  EXPECT_FALSE(file.curve.chains()[1].closed);
  EXPECT_EQ(chain_of(file, 1), (std::vector<Index>{7, 6, 5, 4}));
  ASSERT_EQ(file.warnings.size(), 1U);
  EXPECT_NE(file.warnings[0].find("segments given before: 2; each is taken once"), std::string::npos);
}

TEST_F(CurveObj, ClosesALineThatEndsWithTheNumberItBeganWith) {
  const std::string nodes = "v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 0\n";
  const CurveFile loop = read(nodes + "l 1 2 3 1\n", "obj");
  EXPECT_TRUE(loop.curve.chains()[0].closed);
  EXPECT_EQ(chain_of(loop), (std::vector<Index>{0, 1, 2}));
  // The same place under another number is another node.
  const CurveFile open = read(nodes + "l 1 2 3 4\n", "obj");
  EXPECT_FALSE(open.curve.chains()[0].closed);
  EXPECT_EQ(chain_of(open), (std::vector<Index>{0, 1, 2, 3}));
}

TEST_F(CurveObj, KeepsPositionsThatAreNotFinite) {
  const std::string text = "v 0 0 nan\nv 1 0 0\nl 1 2\n";
  EXPECT_EQ(moved(text, "obj", {{1, {2, 0, 0}}}), replaced(text, "v 1 0 0", "v 2 0 0"));
  EXPECT_EQ(message_of(
                [&] {
                  moved(text, "obj", {{1, {HUGE_VAL, 0, 0}}});
                },
                ErrorCode::invalid_argument),
            "node 1: its position is not finite; only a position that was read so may be");
}

}  // namespace
}  // namespace vspring::curve_obj_test
