#include "unit/io/curve_round_trip.hpp"

namespace vspring::row_order_test {
namespace {

class RowOrder : public CurveScratch {
 protected:
  /// The text with its rows in order, and some nodes elsewhere.
  std::string ordered(const std::string& text, const std::string& extension, Index changed, bool closed = false,
                      const std::vector<std::pair<std::size_t, Vector3>>& places = {}) const {
    CurveFile file = read(text, extension);
    EXPECT_EQ(order_nodes(file, closed), changed);
    std::vector<Vector3> positions = file.curve.positions();
    for (const auto& [node, place] : places) positions.at(node) = place;
    EXPECT_TRUE(write_curve(path("out." + extension), file, positions).empty());
    return get("out." + extension);
  }
};

TEST_F(RowOrder, MovesRowsWithAllThatIsInThem) {
  const std::string text =
      "# c\nid;x;y;note\na;0;0;first\nc;2,0;0;\"third; \"\n# between\nb;1;0;second  \r\nd;3;0;last";
  EXPECT_EQ(ordered(text, "csv", 2),
            "# c\nid;x;y;note\na;0;0;first\nb;1;0;second\n# between\nc;2,0;0;\"third; \"  \r\nd;3;0;last");
  EXPECT_EQ(ordered(text, "csv", 2, false, {{1, {2, 0.5, 0}}}),
            "# c\nid;x;y;note\na;0;0;first\nb;1;0;second\n# between\nc;2,0;0,5;\"third; \"  \r\nd;3;0;last");
  EXPECT_EQ(ordered("0 0 a\n2 0 c\n1 0 b\n", "xyz", 2), "0 0 a\n1 0 b\n2 0 c\n");
  EXPECT_EQ(ordered("name\n1 0\n0 0\n0.5 0\n", "dat", 2), "name\n1 0\n0.5 0\n0 0\n");
}

TEST_F(RowOrder, KeepsNumbersOfNodesAndChains) {
  CurveFile file = read("0,0\n2,0\n1,0\n\n0,1\n3,1\n1,1\n2,1\n", "csv");
  EXPECT_EQ(order_nodes(file, false), 5);
  EXPECT_EQ(file.curve.position(1), Vector3(2, 0, 0));
  EXPECT_EQ(chain_of(file, 0), (std::vector<Index>{0, 2, 1}));
  EXPECT_EQ(chain_of(file, 1), (std::vector<Index>{3, 5, 6, 4}));
  write_curve(path("out.csv"), file, file.curve.positions());
  EXPECT_EQ(get("out.csv"), "0,0\n1,0\n2,0\n\n0,1\n1,1\n2,1\n3,1\n");
  // Without what the file carried, too.
  write_curve(path("out.xyz"), file, file.curve.positions());
  EXPECT_EQ(get("out.xyz"), "0 0\n1 0\n2 0\n\n0 1\n1 1\n2 1\n3 1\n");
}

TEST_F(RowOrder, MovesPointsOfTracks) {
  const std::string text =
      "<gpx><trk><trkseg>\n<trkpt lat='0' lon='0'><time>a</time></trkpt> <trkpt lat='2' lon='0'/>\n"
      "<trkpt lat='1' lon='0'><time>b</time></trkpt>\n</trkseg></trk></gpx>";
  EXPECT_EQ(ordered(text, "gpx", 2),
            "<gpx><trk><trkseg>\n<trkpt lat='0' lon='0'><time>a</time></trkpt> <trkpt lat='1' "
            "lon='0'><time>b</time></trkpt>\n"
            "<trkpt lat='2' lon='0'/>\n</trkseg></trk></gpx>");
}

TEST_F(RowOrder, EndsAClosedCurveWithTheRowThatClosesIt) {
  EXPECT_EQ(ordered("0,0\n1,1\n1,0\n0,1\n0,0\n", "csv", 2, true), "0,0\n1,0\n1,1\n0,1\n0,0\n");
}

TEST_F(RowOrder, IsRefusedWhereTheFileHasOne) {
  for (const auto& [name, text] : {std::pair<std::string, std::string>{"a.obj", "v 0 0 0\nv 2 0 0\nv 1 0 0\nl 1 2 3\n"},
                                   {"a.dat", "foil\n2. 2.\n\n0 0\n1 0.1\n\n0 0\n1 -0.1\n"}}) {
    CurveFile file = read_curve(put(name, text));
    EXPECT_EQ(message_of([&] { order_nodes(file, false); }, ErrorCode::invalid_argument),
              name + ": the file says itself in which order its nodes come; leave the order along the curve out");
  }
  CurveFile file = read("0,0\nnan,0\n1,0\n", "csv");
  EXPECT_EQ(message_of([&] { order_nodes(file, false); }, ErrorCode::unusable_shape).substr(0, 8), "node 1: ");
  file.row_order = {0, 1, 1};
  EXPECT_EQ(
      message_of([&] { write_curve(path("out.csv"), file, file.curve.positions()); }, ErrorCode::invalid_argument),
      "in.csv: the order of its rows is not one of all its nodes; leave it out");
}

}  // namespace
}  // namespace vspring::row_order_test
