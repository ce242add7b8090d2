#include <fmt/format.h>

#include <array>
#include <cmath>

#include "unit/io/curve_round_trip.hpp"
#include "vspring/point_file.hpp"

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
              replaced(text, row("0.5", "1", "-2e1"), row("0.5", "7", "-2e1")));
  }
}

TEST_F(CurveTable, AxesAreChosenByLettersAndByNamesOfColumns) {
  using Axes = std::array<bool, 3>;
  const CurveFile file =
      read_curve_bytes("no,dist_m,Ele [m]\n1,0,5\n2,1,6\n", "a.csv", std::nullopt, {"dist_m", "ele"});
  EXPECT_EQ(file.column_names, (std::vector<std::string>{"dist_m", "Ele [m]"}));
  for (const char* name : {"y", "ele", "ELE", "Ele [m]"})
    EXPECT_EQ(choose_axes(file, {name}), (Axes{false, true, false}));
  EXPECT_EQ(choose_axes(file, {"dist_m", "y"}), (Axes{true, true, false}));
  EXPECT_EQ(choose_axes(read("1 2 3\n4 5 6\n", "xyz"), {"yz"}), (Axes{false, true, true}));
  // A column may be called by another letter than the one that it is read as.
  const CurveFile side = read_curve_bytes("x,z\n1,0\n2,1\n", "a.csv", std::nullopt, {"x", "z"});
  EXPECT_EQ(choose_axes(side, {"z"}), (Axes{false, true, false}));
  const auto refusal = [](const CurveFile& of, const std::string& name) {
    try {
      (void)choose_axes(of, {name});
    } catch (const Error& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_NE(
      refusal(file, "height").find("'height' is no coordinate of this curve; it has x or 'dist_m', y or 'Ele [m]'"),
      std::string::npos);
  EXPECT_NE(refusal(file, "z").find("'z' is no coordinate"), std::string::npos);
  EXPECT_NE(refusal(file, "").find("'' is no coordinate"), std::string::npos);
  const CurveFile track = read("lat,lon\n47,8\n47.1,8\n", "csv");
  EXPECT_NE(refusal(track, "lat").find("move together"), std::string::npos);
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
  const CurveFile headed = read("point,right,up\nP1,0,1\nP2,2,3\n", "csv");
  EXPECT_EQ(headed.curve.position(1), Vector3(2, 3, 0));
  ASSERT_EQ(headed.warnings.size(), 1U);
  EXPECT_NE(headed.warnings[0].find(":1: no columns are named x and y; taken are columns 2 and 3"), std::string::npos);
  EXPECT_EQ(read("height,weight\n1,2\n3,4\n", "csv").curve.position(1), Vector3(3, 4, 0));
  // Of x and y named, nothing else is a coordinate.
  EXPECT_TRUE(read("x,y,speed\n0,1,2\n3,4,5\n", "csv").planar);
}

TEST_F(CurveTable, FindsNamesWithUnits) {
  // The header, and the columns of x, y and z in it.
  const std::vector<std::pair<std::string, std::vector<int>>> headers = {
      {"index,X [mm],Y [mm]", {1, 2}},
      {"index,X [mm],Y [mm],Z [mm]", {1, 2, 3}},
      {"n,\"y (m)\",\"x (m)\",t", {2, 1}},
      {"id,x_mm,y_mm,z_mm", {1, 2, 3}},
      {"id,X mm,Y mm", {1, 2}},
      {"id,x/c,y/c", {1, 2}},
      {"id,x / m, y/mm", {1, 2}},
      {"Y-coordinate [in],no,X-coordinate [in]", {2, 0}},
      {"label,X position,Y position,Z position,x_velocity", {1, 2, 3}},
      {"x,y,z [mm],x [m/s]", {0, 1, 2}},
      {"x [in],x,y,y [in]", {1, 2}},
      {"t,Points:0,Points:1,Points:2", {1, 2, 3}},
      {"no,Station [m],y [m],z [m]", {1, 2, 3}},
      {"station,x,y,note", {1, 2}},
      {"second,east_m,north_m", {1, 2}},
      {"no,Northing [m],Easting [m],Elevation [m]", {2, 1, 3}},
  };
  for (const auto& [header, columns] : headers) {
    const std::string text = header + "\n0,10,20,30,40\n1,11,21,31,41\n2,12,22,32,42\n3,13,23,33,43\n";
    const CurveFile file = read(text, "csv");
    SCOPED_TRACE(header);
    EXPECT_EQ(file.planar, columns.size() == 2);
    for (std::size_t k = 0; k < columns.size(); ++k)
      EXPECT_EQ(file.curve.position(2)[static_cast<int>(k)], columns[k] == 0 ? 2 : 10 * columns[k] + 2);
    EXPECT_TRUE(file.warnings.empty());
    EXPECT_EQ(unmoved(text, "csv"), text);
  }
  EXPECT_EQ(moved("index,X [mm],Y [mm]\n1,0.50,2\n2,3,4\n", "csv", {{1, {0.25, 4, 0}}}),
            "index,X [mm],Y [mm]\n1,0.50,2\n2,0.25,4\n");
  // A row of units below the names is part of the header.
  EXPECT_EQ(moved("id,x,y\n-,mm,mm\n1,2,3\n2,4,5\n", "csv", {{1, {0.25, 4, 0}}}), "id,x,y\n-,mm,mm\n1,2,3\n2,0.25,4\n");
  EXPECT_EQ(read_points(put("in.csv", "x,y,z\nmm,mm,mm\n1,2,3\n2,4,5\n")).positions.size(), 2U);
  // Between blanks a unit is no name of another column.
  EXPECT_EQ(read("index X [mm] Y (US ft)\n1 5 6\n2 7 8\n", "csv").curve.position(1), Vector3(7, 8, 0));
}

TEST_F(CurveTable, TakesTwoOfThreeNamesForAPlane) {
  const CurveFile file = read("id,x/c,z/c\n1,0.5,6\n2,7,8\n3,8,9\n", "csv");
  EXPECT_EQ(file.curve.position(1), Vector3(7, 8, 0));
  EXPECT_TRUE(file.planar);
  ASSERT_EQ(file.warnings.size(), 1U);
  EXPECT_NE(file.warnings[0].find(":1: the columns 'x/c' and 'z/c' are taken for x and y"), std::string::npos);
}

TEST_F(CurveTable, SaysWhereAColumnOfThreeCountsRows) {
  const CurveFile file = read("1,5,6\n2,7,8\n3,9,9\n", "csv");
  EXPECT_EQ(file.curve.position(1), Vector3(2, 7, 8));
  ASSERT_EQ(file.warnings.size(), 1U);
  EXPECT_NE(file.warnings[0].find(":1: column 1 counts rows and is taken for x; if it is none, choose columns 2,3"),
            std::string::npos);
  for (const std::string plain :
       {"0,5\n1,6\n2,7\n", "1,5,6\n2,7,8\n4,9,9\n", "2,5,6\n3,7,8\n4,9,9\n", "5,1,6\n7,2,8\n9,3,9\n"})
    EXPECT_TRUE(read(plain, "csv").warnings.empty()) << plain;
  // Of more columns than coordinates, the first ones, as ever.
  EXPECT_EQ(read("0.5,1,2,255\n1,3,4,255\n2,5,6,0\n", "csv").curve.position(1), Vector3(1, 3, 4));
}

TEST_F(CurveTable, TakesTheColumnsThatAreChosen) {
  const std::string text = "no,east [m],north [m],up [m]\n1,10,20,30\n2,11,21,31\n3,12,22,32\n";
  const auto chosen = [&](const ColumnChoice& columns) {
    return read_curve(put("in.csv", text), std::nullopt, columns);
  };
  EXPECT_EQ(chosen({"2", "3", "4"}).curve.position(2), Vector3(12, 22, 32));
  EXPECT_EQ(chosen({"East", "north [M]", "up"}).curve.position(0), Vector3(10, 20, 30));
  EXPECT_EQ(chosen({"up", "2"}).curve.position(0), Vector3(30, 10, 0));
  EXPECT_TRUE(chosen({"2", "3"}).warnings.empty());
  const CurveFile file = chosen({"north", "east"});
  std::vector<Vector3> positions = file.curve.positions();
  positions[1] = {0.5, 0.25, 0};
  write_curve(path("out.csv"), file, positions);
  EXPECT_EQ(get("out.csv"), replaced(text, "2,11,21,31", "2,0.25,0.5,31"));
  EXPECT_EQ(read_curve(put("in.csv", "0,5,6\n1,7,8\n"), std::nullopt, {"2", "3"}).curve.position(0), Vector3(5, 6, 0));
  EXPECT_EQ(read_curve(put("in.xyz", "0 5 6\n1 7 8\n"), std::nullopt, {"2", "3"}).curve.position(1), Vector3(7, 8, 0));
}

TEST_F(CurveTable, RefusesAChoiceThatIsNone) {
  const auto refusal = [&](const std::string& name, const std::string& text, const ColumnChoice& columns,
                           ErrorCode code = ErrorCode::unusable_file) {
    return message_of([&] { std::ignore = read_curve(put(name, text), std::nullopt, columns); }, code);
  };
  const std::string text = "no,a,b\n1,5,6\n2,7,8\n";
  EXPECT_EQ(refusal("a.csv", text, {"a", "c"}),
            "a.csv:1: no column is called 'c', this row has 'no', 'a', 'b'; correct the choice of columns");
  EXPECT_EQ(refusal("a.csv", text, {"2", "4"}),
            "a.csv:2: column 4 is chosen, this row has 3; correct the choice of columns");
  EXPECT_EQ(refusal("a.csv", "a [m],a [ft],b\n1,5,6\n2,7,8\n", {"a", "b"}),
            "a.csv:1: 'a [m]' and 'a [ft]' may both be a; choose columns by number");
  EXPECT_EQ(refusal("a.csv", "no,a,b\n1,5,none\n2,7,8\n", {"2", "3"}),
            "a.csv:2: 'none' stands where y belongs; repair the line");
  EXPECT_EQ(refusal("a.xyz", "0 5 6\n1 7 8\n", {"x", "y"}),
            "a.xyz:1: no column is called 'x', this row has '0', '5', '6'; correct the choice of columns");
  for (const ColumnChoice& columns :
       {ColumnChoice{"1"}, {"1", "2", "3", "2"}, {"2", "2"}, {"a", "2"}, {"0", "1"}, {"", "1"}})
    EXPECT_NE(refusal("a.csv", text, columns, ErrorCode::invalid_argument), "");
  EXPECT_EQ(
      refusal("a.dat", "0 1\n1 2\n", {"1", "2"}, ErrorCode::invalid_argument),
      "a.dat: columns can be chosen in CSV, XYZ and GPX only; leave the choice of columns out, or name the format");
}

TEST_F(CurveTable, ReadsDecimalCommasAndWritesThem) {
  for (const std::string between : {";", "\t", " ; "}) {
    const auto row = [&](const std::string& x, const std::string& y) {
      return fmt::format("{1}{0}{2}\n", between, x, y);
    };
    const std::string text = row("x", "y") + row("0", "1,50") + row("-12,5", "1e-2") + row("3", ",25");
    const CurveFile file = read(text, "csv");
    ASSERT_EQ(file.curve.node_count(), 3) << between;
    EXPECT_EQ(file.curve.position(0), Vector3(0, 1.5, 0));
    EXPECT_EQ(file.curve.position(1), Vector3(-12.5, 0.01, 0));
    EXPECT_EQ(file.curve.position(2), Vector3(3, 0.25, 0));
    EXPECT_TRUE(file.warnings.empty());
    EXPECT_EQ(unmoved(text, "csv"), text);
    EXPECT_EQ(moved(text, "csv", {{1, {0.125, -7, 0}}}), replaced(text, row("-12,5", "1e-2"), row("0,125", "-7")));
  }
  const std::string quoted = "\"x\",\"y\"\n\"0,5\",\"1,5\"\n\"2,5\",\"3\"\n";
  EXPECT_EQ(moved(quoted, "csv", {{0, {0.25, 1.5, 0}}}), replaced(quoted, "0,5", "0,25"));
  EXPECT_EQ(read_points(put("in.csv", "x;y;z;weight\n0,5;1;2,5;0,25\n")).weights, std::vector<double>{0.25});
}

TEST_F(CurveTable, FindsDecimalCommasBelowRowsOfWholeNumbers) {
  std::string text = "no;x;y\n";
  for (int k = 0; k < 40; ++k) text += fmt::format("{0};{0};7\n", k);
  const std::string below = "40;40,5;7\n";
  EXPECT_EQ(read(text + below, "csv").curve.position(40), Vector3(40.5, 7, 0));
  EXPECT_EQ(moved(text + below, "csv", {{0, {0.5, 7, 0}}}), replaced(text + below, "\n0;0;7", "\n0;0,5;7"));
  EXPECT_EQ(moved(text, "csv", {{0, {0.5, 7, 0}}}), replaced(text, "\n0;0;7", "\n0;0.5;7"));
  EXPECT_EQ(read(text + "40;40.5;7\n", "csv").curve.position(40), Vector3(40.5, 7, 0));
  // Names with numbers and commas between them part nothing.
  const std::string named = "x;y;a,7,b,7\n0;0\n0;0;,5\n";
  const std::string changed = moved(named, "csv", {{0, {0.75, 0.25, 0}}, {1, {0.5, 0.25, 0}}});
  EXPECT_EQ(changed, "x;y;a,7,b,7\n0,75;0,25\n0,5;0,25;,5\n");
  EXPECT_EQ(read(changed, "csv").curve.position(1), Vector3(0.5, 0.25, 0));
  // A text with a comma in it is no number.
  EXPECT_EQ(read("x;y;note\n0.5;1;2,5\n1.5;2;3,5\n2.5;3;no\n", "csv").curve.position(1), Vector3(1.5, 2, 0));
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

TEST_F(CurveTable, WarnsOfRowsThatRepeatTheOneAbove) {
  const auto warnings = [&](const std::string& text, const std::string& extension) {
    std::vector<std::string> said = read(text, extension).warnings;
    for (std::string& warning : said) warning = warning.substr(warning.rfind('/') + 1);
    return said;
  };
  const std::string rest = "; leave it out unless it is meant";
  EXPECT_EQ(warnings("foil\n1 0\n1.0 0.0 twice\n0 0\n", "dat"),
            std::vector<std::string>{"in.dat:3: this row is at the same place as the one above" + rest});
  EXPECT_EQ(warnings("x,y\n0,0\n1,0\n1,0\n# c\n1,0\n2,0\n2,0\n", "csv"),
            std::vector<std::string>{
                "in.csv:4: this row is at the same place as the one above, and so are 2 more below" + rest});
  // Chains may meet, and a curve may come back.
  EXPECT_TRUE(warnings("0 0\n1 0\n\n1 0\n1 1\n0 0\n", "xyz").empty());
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
            replaced(replaced(text, "1.0 2 3.50", "1.0 2 0.1"), "7 8 10", "0 0 0"));
  const CurveFile flat = read("0 1 a\n2 3 b\n", "xyz");
  EXPECT_TRUE(flat.planar);
  EXPECT_EQ(flat.curve.position(1), Vector3(2, 3, 0));
}

TEST_F(CurveTable, ReadsTheHeaderOfXyz) {
  const std::string text = "# log\nid X [m] Y [m]\n7 0 0\n7 1 0.5\n7 2 0\n";
  const CurveFile file = read(text, "xyz");
  EXPECT_EQ(file.format, CurveFormat::xyz);
  EXPECT_TRUE(file.planar);
  EXPECT_EQ(file.curve.position(1), Vector3(1, 0.5, 0));
  EXPECT_EQ(moved(text, "xyz", {{1, {1, 0.25, 0}}}), replaced(text, "1 0.5", "1 0.25"));
  EXPECT_EQ(read("x y z\n0 1 2\n3 4 5\n", "xyz").curve.position(1), Vector3(3, 4, 5));
}

TEST_F(CurveTable, TakesWholeNumbersBetweenCommas) {
  // Neither leading zeros nor names are against it.
  EXPECT_EQ(read("1,20,30\n4,50,60\n", "csv").curve.position(1), Vector3(4, 50, 60));
  EXPECT_EQ(read("x,y,a,b\n1,2,03,04\n5,6,07,08\n", "csv").curve.position(1), Vector3(5, 6, 0));
  const std::string commas = "1,20,30,05\n4,50,60,05\n";
  EXPECT_EQ(read_curve(put("in.csv", commas), CurveFormat::csv, {"2", "3"}).curve.position(1), Vector3(50, 60, 0));
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
