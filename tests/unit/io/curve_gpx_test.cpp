#include "unit/io/curve_round_trip.hpp"

namespace vspring::curve_gpx_test {
namespace {

class CurveGpx : public CurveScratch {};

const std::string logged =
    "\xEF\xBB\xBF<?xml version=\"1.0\" encoding=\"UTF-8\"?>\r\n"
    "<gpx version=\"1.1\" creator='a > b' xmlns=\"http://www.topografix.com/GPX/1/1\">\r\n"
    "<metadata><time>2024-05-01T08:00:00Z</time></metadata>\r\n"
    "<wpt lat=\"1\" lon=\"2\"><name>no node</name></wpt>\r\n"
    "<trk><name>a &amp; b</name>\r\n"
    "<trkseg>\r\n"
    "  <trkpt lat=\"47.000\" lon=\"8.0000\"><ele>430.5</ele><time>2024-05-01T08:00:00Z</time></trkpt>\r\n"
    "  <!-- <trkpt lat=\"0\" lon=\"0\"/> -->\r\n"
    "  <trkpt lon = ' 8.001' extra=\"7\"\n lat='47.001'></trkpt>\r\n"
    "  <trkpt lat=\"47.002\" lon=\"8.000\"><extensions><g:hr "
    "xmlns:g='u'>99</g:hr><![CDATA[<trkpt>]]></extensions></trkpt>\r\n"
    "</trkseg><trkseg/><trkseg>\r\n"
    "  <trkpt lat=\"47.003\" lon=\"8\"/><trkpt lat=\"47.004\" lon=\"8\"/>\r\n"
    "</trkseg></trk>\r\n"
    "<rte><rtept lat=\"47.01\" lon=\"8.01\"><name>A</name></rtept><rtept lat=\"47.02\" lon=\"8.01\"/></rte>\r\n"
    "</gpx>\r\n";

TEST_F(CurveGpx, ReadsSegmentsAndRoutesAsChains) {
  const CurveFile file = read(logged, "gpx");
  EXPECT_EQ(file.format, CurveFormat::gpx);
  ASSERT_TRUE(file.plane);
  EXPECT_TRUE(file.planar);
  ASSERT_EQ(file.curve.node_count(), 7);
  ASSERT_EQ(file.curve.chains().size(), 3U);
  EXPECT_EQ(chain_of(file, 0), (std::vector<Index>{0, 1, 2}));
  EXPECT_EQ(chain_of(file, 1), (std::vector<Index>{3, 4}));
  EXPECT_EQ(chain_of(file, 2), (std::vector<Index>{5, 6}));
  EXPECT_EQ(file.curve.position(1), file.plane->position({47.001, 8.001}));
  EXPECT_TRUE(file.warnings.empty());
}

TEST_F(CurveGpx, ElevationsAreACoordinateWhereTheyAreChosen) {
  const std::string text =
      "<gpx><trk><trkseg><trkpt lat=\"47\" lon=\"8\"><ele> 430.50 </ele><hr>9</hr></trkpt>"
      "<trkpt lat=\"47.0010\" lon=\"8\"><ele>431</ele></trkpt></trkseg></trk></gpx>";
  const CurveFile file = read_curve_bytes(text, "a.gpx", std::nullopt, {"lat", "lon", "ele"});
  EXPECT_FALSE(file.planar);
  EXPECT_EQ(file.curve.position(0).z(), 430.5);
  EXPECT_EQ(file.column_names, (std::vector<std::string>{"lon", "lat", "ele"}));
  std::vector<Vector3> positions = file.curve.positions();
  positions[0].z() = 430.25;
  EXPECT_EQ(curve_bytes("b.gpx", file, positions).bytes, replaced(text, " 430.50 ", "430.25"));
  const auto refusal = [](const std::string& of, const ColumnChoice& choice) {
    try {
      (void)read_curve_bytes(of, "a.gpx", std::nullopt, choice);
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(refusal(replaced(text, "<ele>431</ele>", ""), {"lon", "lat", "ele"}).find("no elevation"),
            std::string::npos);
  EXPECT_NE(refusal(replaced(text, "431", "high"), {"lon", "lat", "ele"}).find("'high' stands where"),
            std::string::npos);
  EXPECT_NE(refusal(text, {"lon", "ele"}).find("lon,lat or lon,lat,ele"), std::string::npos);
}

TEST_F(CurveGpx, ChangesNothingButDegreesOfWhatMoved) {
  EXPECT_EQ(unmoved(logged, "gpx"), logged);
  const LocalPlane plane = *read(logged, "gpx").plane;
  const auto at = [&](double latitude, double longitude) { return plane.position({latitude, longitude}); };
  const std::string written =
      moved(logged, "gpx", {{0, at(47.0005, 8.00025)}, {1, at(47.0015, 8.00125)}, {6, at(-0.000001, 8)}});
  std::string expected = replaced(logged, "lat=\"47.000\" lon=\"8.0000\"", "lat=\"47.0005\" lon=\"8.00025\"");
  expected =
      replaced(expected, "lon = ' 8.001' extra=\"7\"\n lat='47.001'", "lon = '8.00125' extra=\"7\"\n lat='47.0015'");
  EXPECT_EQ(written, replaced(expected, "lat=\"47.02\" lon=\"8.01\"", "lat=\"-0.000001\" lon=\"8\""));
}

TEST_F(CurveGpx, IsMadeNewOfWhatHasAPlane) {
  CurveFile file = read(logged, "gpx");
  file.source = nullptr;
  EXPECT_TRUE(write_curve(path("out.gpx"), file, file.curve.positions()).empty());
  EXPECT_EQ(get("out.gpx"),
            "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
            "<gpx version=\"1.1\" creator=\"vspring\" xmlns=\"http://www.topografix.com/GPX/1/1\">\n"
            "<trk>\n<trkseg>\n"
            "<trkpt lat=\"47\" lon=\"8\"/>\n<trkpt lat=\"47.001\" lon=\"8.001\"/>\n<trkpt lat=\"47.002\" lon=\"8\"/>\n"
            "</trkseg>\n<trkseg>\n<trkpt lat=\"47.003\" lon=\"8\"/>\n<trkpt lat=\"47.004\" lon=\"8\"/>\n"
            "</trkseg>\n<trkseg>\n<trkpt lat=\"47.01\" lon=\"8.01\"/>\n<trkpt lat=\"47.02\" lon=\"8.01\"/>\n"
            "</trkseg>\n</trk>\n</gpx>\n");
  const CurveFile again = read_curve(path("out.gpx"));
  EXPECT_EQ(again.curve.positions(), file.curve.positions());
  const CurveFile space =
      read_curve(put("in.csv", "lat,lon,ele\n47,8,430\n47.5,8,431.25\n"), std::nullopt, {"lat", "lon", "ele"});
  write_curve(path("out.gpx"), space, space.curve.positions());
  EXPECT_NE(get("out.gpx").find("<trkpt lat=\"47.5\" lon=\"8\"><ele>431.25</ele></trkpt>\n"), std::string::npos);
  EXPECT_EQ(message_of(
                [&] {
                  write_curve(path("a.gpx"), PolygonCurve({{0, 0, 0}, {1, 0, 0}}));
                },
                ErrorCode::invalid_argument),
            "GPX has its points in degrees, which this curve does not come from; write another format");
}

TEST_F(CurveGpx, SaysWhatOtherFormatsLose) {
  const CurveFile file = read(logged, "gpx");
  const std::vector<std::string> carried = {"elevations", "extensions", "names", "times", "waypoints"};
  EXPECT_EQ(write_curve(path("out.csv"), file, file.curve.positions()), carried);
  EXPECT_EQ(get("out.csv").substr(0, 37), "lat,lon\n47,8\n47.001,8.001\n47.002,8\n\n4");
}

TEST_F(CurveGpx, IsFoundByItsContent) {
  EXPECT_EQ(read_curve(put("in.txt", logged)).format, CurveFormat::gpx);
  EXPECT_EQ(
      read_curve(
          put("in", "<g:gpx xmlns:g='u'><g:rte><g:rtept lat='1' lon='2'/><g:rtept lat='1' lon='3'/></g:rte></g:gpx>"))
          .curve.node_count(),
      2);
}

TEST_F(CurveGpx, IsRefusedInOneLineThatSaysWhereAndWhat) {
  const std::string begin = "<gpx>\n<trk><trkseg>\n<trkpt lat='47' lon='8'/>\n";
  const std::string end = "</trkseg></trk></gpx>\n";
  const std::vector<std::pair<std::string, std::string>> cases = {
      {begin + "<trkpt lat='47'/>" + end, ":4: the point has no lon; repair or remove it"},
      {begin + "<trkpt lat='47' lon='east'/>" + end, ":4: 'east' stands where lon belongs; repair the point"},
      {begin + "<trkpt lat='47' lon=''/>" + end, ":4: '' stands where lon belongs; repair the point"},
      {begin + "<trkpt lat='147' lon='8'/>" + end, ":4: the latitude is 147; give degrees from -90 to 90"},
      {begin + "<trkpt lat='47' lat='8'/>" + end, ":4: the attribute 'lat' stands twice; remove one"},
      {begin + "<trkpt lat='47' lon=8/>" + end, ":4: the value of 'lon' is not in quotes; repair the XML"},
      {begin + "<trkpt lat='47' lon/>" + end, ":4: the attribute 'lon' has no value; repair the XML"},
      {begin + "<trkpt lat='47' lon='8/>\n" + end, ":4: the value of 'lon' has no closing quote; repair the XML"},
      {begin + "<trkpt lat='47'lon='8'/>" + end, ":4: 'l' follows without a blank; repair the XML"},
      {begin + "<trkpt lat='47' lon='9'>\n" + end,
       ":5: </trkseg> ends an element that is not open, <trkpt> is; repair the XML"},
      {begin + "<trkseg>" + end, ":4: a segment or route begins within another; repair the file"},
      {begin + "</trkseg><trkpt lat='1' lon='2'/></trk></gpx>",
       ":4: a point stands in <trk> and not in a segment or route"},
      {begin + end, ": no two of its points follow each other; choose another file"},
      {begin, ":2: the file ends within the element <trkseg> that begins here; it is cut off"},
      {begin + "<trkpt lat='1", ":4: the value of 'lat' has no closing quote; repair the XML"},
      {begin + "<!-- note", ":4: the file ends within a comment; it is cut off"},
      {begin + "<trk", ":4: the file ends within a tag; it is cut off"},
      {begin + end + "</gpx>", ":5: </gpx> ends an element that is not open; repair the XML"},
      {begin + end + "<gpx/>", ":5: a second outermost element begins; split the file"},
      {begin + end + "more", ":5: 'more' stands outside of all elements; repair the XML"},
      {"<gpx></gpx>", ": no track and no route with points is in it; choose another file"},
      {"<kml><Document/></kml>", ":1: the file holds <kml> where GPX has <gpx>; choose a GPX file"},
      {"<!DOCTYPE gpx [<!ENTITY a 'b'>]><gpx/>", ":1: the document type declares names of its own; remove them"},
      {"<?xml version='1.0'?>\n", ": no element is in it; choose another file"},
      {"47,8\n", ":1: '47,8?' stands outside of all elements; repair the XML"},
      {std::string("\xFF\xFE<\0g\0", 6), ": is in UTF-16; save it in UTF-8"},
  };
  for (const auto& [broken, message] : cases) {
    const std::string& text = broken;
    SCOPED_TRACE(text);
    const std::string said = message_of([&] { std::ignore = read(text, "gpx"); });
    EXPECT_EQ(said.substr(0, 6 + message.size()), "in.gpx" + message);
  }
}

TEST_F(CurveGpx, MayBeCutOffAnywhere) {
  for (std::size_t length = 0; length < logged.size(); ++length) {
    if (length + 2 < logged.size()) {
      const std::string said = message_of([&] { std::ignore = read(logged.substr(0, length), "gpx"); });
      EXPECT_NE(said.find(';'), std::string::npos) << said;
    } else {
      EXPECT_EQ(unmoved(logged.substr(0, length), "gpx"), logged.substr(0, length));
    }
  }
}

}  // namespace
}  // namespace vspring::curve_gpx_test
