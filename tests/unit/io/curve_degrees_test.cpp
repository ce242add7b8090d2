#include <fmt/format.h>

#include <cmath>

#include "unit/io/curve_round_trip.hpp"
#include "vspring/point_file.hpp"

namespace vspring::curve_degrees_test {
namespace {

class CurveDegrees : public CurveScratch {};

TEST_F(CurveDegrees, TakesNamedColumnsToAPlaneInMetres) {
  const std::vector<std::string> headers = {
      "time,lat,lon",           "t,Latitude,Longitude",        "n,LAT [deg],Lng [deg]",
      "n,lat_deg,long",         "n,Latitude (\u00b0),lng",     "n,\"lat\",\"lon\"",
      "time,latitude deg,lon.", "n,Lat [degrees],LON (degree)"};
  for (const std::string& header : headers) {
    SCOPED_TRACE(header);
    const std::string text = header + "\n0,47.0,8.0\n1,47.001,8.001\n2,47.002,8.000\n";
    const CurveFile file = read(text, "csv");
    ASSERT_TRUE(file.plane);
    EXPECT_NEAR(file.plane->origin().latitude, 47.001, 1e-12);
    EXPECT_NEAR(file.plane->origin().longitude, 8.0005, 1e-12);
    EXPECT_TRUE(file.planar);
    EXPECT_NEAR(file.curve.position(0).y(), -111.2, 0.1);
    EXPECT_NEAR(file.curve.position(0).x(), -38.1, 0.1);
    EXPECT_TRUE(file.warnings.empty());
    EXPECT_EQ(unmoved(text, "csv"), text);
  }
}

TEST_F(CurveDegrees, WritesDegreesBack) {
  const std::string text = "time,lat,lon,speed\n0,47.000000,8.0,1\n1,47.0010,8.0010,2\n2,47.002,8,3\n";
  const CurveFile file = read(text, "csv");
  const Vector3 place = file.plane->position({47.00125, 8.00075});
  const std::string written = moved(text, "csv", {{1, place}});
  EXPECT_EQ(written, replaced(text, "47.0010,8.0010", "47.00125,8.00075"));
  // To a micrometre, whatever the place.
  const Vector3 other(12.3456789, -23.456789, 0);
  const CurveFile again = read_curve(put("in.csv", moved(text, "csv", {{1, other}})), std::nullopt, {}, file.plane);
  EXPECT_LT((again.curve.position(1) - other).norm(), 1e-6);
  EXPECT_EQ(again.curve.position(0), file.curve.position(0));
}

TEST_F(CurveDegrees, WritesThemWithoutExponentsAndWithDecimalCommas) {
  const std::string text = "lat;lon\n0,5;0\n0,25;0,5\n-0,5;0\n";
  const CurveFile file = read(text, "csv");
  EXPECT_EQ(moved(text, "csv", {{1, file.plane->position({0.0000012, -0.00000345})}}),
            replaced(text, "0,25;0,5", "0,0000012;-0,00000345"));
}

TEST_F(CurveDegrees, GoBeforeOtherColumnsButNotBeforeXAndY) {
  EXPECT_FALSE(read("lat,lon,x,y\n47,8,1,2\n47,9,3,4\n", "csv").plane);
  EXPECT_FALSE(read("lat,height\n47,8\n47,9\n", "csv").plane);
  EXPECT_FALSE(read("lateral,long term\n47,8\n47,9\n", "csv").plane);
  EXPECT_FALSE(read("latitude_error,lon\n47,8\n47,9\n", "csv").plane);
  const CurveFile file = read("no,ele,speed,lat,lon\n1,400,7,47,8\n2,401,8,47.01,8\n3,402,8,47.02,8\n", "csv");
  ASSERT_TRUE(file.plane);
  EXPECT_TRUE(file.planar);
  EXPECT_TRUE(read_curve(put("in.txt", "lat lon\n47 8\n47.1 8\n")).plane);
}

TEST_F(CurveDegrees, AreThoseOfColumnsThatAreChosen) {
  const std::string text = "ele,lon,lat,east,north\n400,8,47,1,2\n410,8.001,47.001,3,5\n";
  const auto chosen = [&](const ColumnChoice& columns) {
    return read_curve(put("in.csv", text), std::nullopt, columns);
  };
  const CurveFile file = chosen({"lat", "lon"});
  ASSERT_TRUE(file.plane);
  for (const ColumnChoice& columns : {ColumnChoice{"lon", "lat"}, {"2", "3"}, {"Lat", "2"}}) {
    ASSERT_TRUE(chosen(columns).plane);
    EXPECT_EQ(chosen(columns).curve.positions(), file.curve.positions());
  }
  EXPECT_FALSE(chosen({"east", "north"}).plane);
  EXPECT_FALSE(chosen({"lat", "ele"}).plane);
  for (const ColumnChoice& columns : {ColumnChoice{"lat", "lon", "ele"}, {"ele", "lon", "lat"}}) {
    const CurveFile space = chosen(columns);
    ASSERT_TRUE(space.plane);
    EXPECT_FALSE(space.planar);
    EXPECT_EQ(space.curve.position(1), file.curve.position(1) + Vector3(0, 0, 410));
    std::vector<Vector3> positions = space.curve.positions();
    positions[1] = space.plane->position({47.0005, 8.0025}) + Vector3(0, 0, 405.5);
    write_curve(path("out.csv"), space, positions);
    EXPECT_EQ(get("out.csv"), replaced(text, "410,8.001,47.001", "405.5,8.0025,47.0005"));
  }
}

TEST_F(CurveDegrees, CrossTheDateLineAndCountAsTheFileDoes) {
  const std::string text = "lat,lon\n1,179.5\n1,-179.5\n";
  const CurveFile file = read(text, "csv");
  EXPECT_NEAR(std::abs(file.plane->origin().longitude), 180, 1e-12);
  EXPECT_NEAR(file.curve.position(1).x(), 55650, 10);
  EXPECT_EQ(moved(text, "csv", {{0, file.plane->position({1, -179.75})}}), replaced(text, "1,179.5", "1,-179.75"));
  const std::string round = "lat,lon\n1,179.5\n1,180.5\n";
  EXPECT_EQ(moved(round, "csv", {{0, file.plane->position({1, -179.75})}}), replaced(round, "1,179.5", "1,180.25"));
}

TEST_F(CurveDegrees, ConvertToOtherTables) {
  const CurveFile file = read("time,lat,lon\n0,47,8\n1,47.001,8.0010\n", "csv");
  CurveFile fresh = file;
  fresh.source = nullptr;
  EXPECT_EQ(write_curve(path("out.csv"), fresh, file.curve.positions()), std::vector<std::string>{});
  EXPECT_EQ(get("out.csv"), "lat,lon\n47,8\n47.001,8.001\n");
  EXPECT_EQ(write_curve(path("out.xyz"), fresh, {{0, 0, 0}, {1, 2, 0}}),
            std::vector<std::string>{"degrees: its x and y are metres east and north of 47.000500, 8.000500"});
  EXPECT_EQ(get("out.xyz"), "0 0\n1 2\n");
  fresh.planar = false;
  write_curve(path("out.csv"), fresh, {file.curve.position(0) + Vector3(0, 0, 1.5), file.curve.position(1)});
  EXPECT_EQ(get("out.csv"), "lat,lon,ele\n47,8,1.5\n47.001,8.001,0\n");
}

TEST_F(CurveDegrees, AreRefusedWhereTheyAreNone) {
  const auto refusal = [&](const std::string& rows) {
    return message_of([&] { std::ignore = read("lat,lon\n47,8\n" + rows, "csv"); });
  };
  EXPECT_EQ(refusal("91,8\n"), "in.csv:3: the latitude is 91; give degrees from -90 to 90");
  EXPECT_EQ(refusal("47,361\n"), "in.csv:3: the longitude is 361; give degrees from -180 to 180");
  EXPECT_EQ(refusal("nan,8\n"), "in.csv:3: the latitude is nan; give degrees from -90 to 90");
  EXPECT_EQ(refusal("47,none\n"), "in.csv:3: 'none' stands where the longitude belongs; repair the line");
}

TEST_F(CurveDegrees, FarFromTheMiddleAreWarnedOf) {
  const CurveFile file = read("lat,lon\n40,0\n50,0\n60,0\n", "csv");
  ASSERT_EQ(file.warnings.size(), 1U);
  EXPECT_NE(file.warnings[0].find(
                "in.csv: reaches 1116 km from 50.000000, 0.000000, and lengths there come out up to 0.76 % too long"),
            std::string::npos)
      << file.warnings[0];
}

TEST_F(CurveDegrees, OfPointsGoToThePlaneThatIsGiven) {
  const std::string text = "lat,lon,weight\n47,8,2\n47.001,8.001,1\n";
  const ScatteredPoints own = read_points(put("in.csv", text));
  ASSERT_TRUE(own.plane);
  EXPECT_EQ(own.positions, read(text, "csv").curve.positions());
  EXPECT_EQ(own.weights, (std::vector<double>{2, 1}));
  const LocalPlane plane({47.001, 8.001});
  const ScatteredPoints points = read_points(path("in.csv"), {}, plane);
  EXPECT_EQ(points.plane, plane);
  EXPECT_LT(points.positions[1].norm(), 1e-8);
  const std::string gpx =
      "<gpx><trk><trkseg><trkpt lat='47' lon='8'/><trkpt lat='47.001' lon='8.001'/></trkseg></trk></gpx>";
  EXPECT_EQ(read_points(put("in.gpx", gpx), {}, plane).positions, points.positions);
}

}  // namespace
}  // namespace vspring::curve_degrees_test
