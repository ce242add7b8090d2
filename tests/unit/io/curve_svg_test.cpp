#include <algorithm>
#include <cmath>
#include <numbers>
#include <sstream>

#include "unit/io/curve_round_trip.hpp"

namespace vspring::curve_svg_test {
namespace {

class CurveSvg : public CurveScratch {
 protected:
  std::string picture(const CurveFile& file, const PolygonCurve* before = nullptr) const {
    EXPECT_TRUE(write_curve(path("out.svg"), file, file.curve.positions(), {}, {.before = before}).empty());
    return get("out.svg");
  }
};

/// Whether every tag is closed in its order and no value is without quotes.
testing::AssertionResult is_balanced(const std::string& xml) {
  std::vector<std::string> open;
  for (std::size_t at = xml.find('<'); at != std::string::npos; at = xml.find('<', at + 1)) {
    const std::size_t end = xml.find('>', at);
    if (end == std::string::npos) return testing::AssertionFailure() << "a tag does not end";
    const std::string tag = xml.substr(at + 1, end - at - 1);
    if (tag.starts_with("?")) continue;
    if (std::count(tag.begin(), tag.end(), '"') % 2 != 0) return testing::AssertionFailure() << "quotes: " << tag;
    if (tag.starts_with("/")) {
      if (open.empty() || open.back() != tag.substr(1)) return testing::AssertionFailure() << "closed early: " << tag;
      open.pop_back();
    } else if (!tag.ends_with("/")) {
      open.push_back(tag.substr(0, tag.find(' ')));
    }
  }
  if (!open.empty()) return testing::AssertionFailure() << "never closed: " << open.back();
  return testing::AssertionSuccess();
}

std::size_t count(const std::string& text, const std::string& part) {
  std::size_t found = 0;
  for (std::size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++found;
  return found;
}

struct Tooth {
  double root_x, root_y, tip_x, tip_y;
};

/// The teeth of the group that begins with `id`.
std::vector<Tooth> teeth_of(const std::string& text, const std::string& id) {
  const std::size_t path = text.find("<path d=\"", text.find("id=\"" + id + "\"")) + 9;
  std::string data = text.substr(path, text.find('"', path) - path);
  for (char& c : data) {
    if (c == 'M' || c == 'L') c = ' ';
  }
  std::istringstream stream(data);
  std::vector<Tooth> teeth;
  for (Tooth tooth{}; stream >> tooth.root_x >> tooth.root_y >> tooth.tip_x >> tooth.tip_y;) teeth.push_back(tooth);
  return teeth;
}

/// The points of the k-th line of the plot.
std::vector<std::pair<double, double>> plotted(const std::string& text, int k) {
  std::size_t at = text.find("id=\"plot\"");
  for (int n = 0; n <= k; ++n) at = text.find(" d=\"M0 0M", at) + 9;
  std::string data = text.substr(at, text.find('"', at) - at);
  for (char& c : data) {
    if (c == 'M' || c == 'L') c = ' ';
  }
  std::istringstream stream(data);
  std::vector<std::pair<double, double>> points;
  for (std::pair<double, double> point; stream >> point.first >> point.second;) points.push_back(point);
  return points;
}

PolygonCurve circle(int count, double radius, bool closed) {
  std::vector<Vector3> nodes;
  for (int k = 0; k < count; ++k) {
    const double turn = 2 * std::numbers::pi * k / count;
    nodes.emplace_back(5 + radius * std::cos(turn), radius * std::sin(turn), 0);
  }
  return PolygonCurve(nodes, closed);
}

TEST_F(CurveSvg, HasATitleNodesAndAComb) {
  CurveFile file;
  file.curve = circle(12, 2, true);
  file.name = "a < b & \"c\" \xC3\xA9\xFF";
  const std::string text = picture(file);
  EXPECT_TRUE(is_balanced(text));
  EXPECT_NE(text.find("<title>a &lt; b &amp; &quot;c&quot; \xC3\xA9?</title>"), std::string::npos);
  EXPECT_EQ(count(text, "<circle"), 12U);
  EXPECT_EQ(count(text, "<polygon"), 2U);
  EXPECT_EQ(teeth_of(text, "curve").size(), 12U);
}

// The comb of a circle is a larger circle; 15 % of the diagonal of the box around the nodes is a tooth.
TEST_F(CurveSvg, TheCombStandsOutsideAndIsAsLongAsItShould) {
  CurveFile file;
  file.curve = circle(40, 2, true);
  const std::string text = picture(file);
  double left = HUGE_VAL;
  double right = -HUGE_VAL;
  const std::vector<Tooth> teeth = teeth_of(text, "curve");
  for (const Tooth& tooth : teeth) {
    left = std::min(left, tooth.root_x);
    right = std::max(right, tooth.root_x);
  }
  const double centre = (left + right) / 2;
  const double radius = (right - left) / 2;
  for (const Tooth& tooth : teeth) {
    EXPECT_NEAR(std::hypot(tooth.root_x - centre, tooth.root_y - 500), radius, 0.05);
    EXPECT_NEAR(std::hypot(tooth.tip_x - centre, tooth.tip_y - 500), radius + 0.15 * std::sqrt(8) * radius, 0.05);
  }
}

TEST_F(CurveSvg, DrawsTheCurveBeforeBehindItWithItsTeethCutOff) {
  CurveFile file;
  file.curve = circle(20, 2, false);
  PolygonCurve before = file.curve;
  std::vector<Vector3> positions = before.positions();
  positions[10].x() += 0.6;
  before.set_positions(positions);
  const std::string text = picture(file, &before);
  EXPECT_TRUE(is_balanced(text));
  EXPECT_LT(text.find("id=\"before\""), text.find("id=\"curve\""));
  EXPECT_EQ(teeth_of(text, "before").size(), 18U);
  double after_longest = 0;
  for (const Tooth& t : teeth_of(text, "curve"))
    after_longest = std::max(after_longest, std::hypot(t.tip_x - t.root_x, t.tip_y - t.root_y));
  double longest = 0;
  for (const Tooth& t : teeth_of(text, "before"))
    longest = std::max(longest, std::hypot(t.tip_x - t.root_x, t.tip_y - t.root_y));
  EXPECT_NEAR(longest / after_longest, 0.4 / 0.15, 0.01);
}

TEST_F(CurveSvg, LeavesTheCombOfNoiseOut) {
  CurveFile file;
  file.curve = circle(60, 2, true);
  PolygonCurve before = file.curve;
  std::vector<Vector3> positions = before.positions();
  for (std::size_t k = 0; k < 60; k += 2) positions[k] += 0.05 * (positions[k] - Vector3(5, 0, 0));
  before.set_positions(positions);
  const std::string text = picture(file, &before);
  EXPECT_TRUE(is_balanced(text));
  EXPECT_EQ(count(text.substr(0, text.find("id=\"curve\"")), "<path"), 0U);
  // Nor has the plot a line of it; the key says so.
  EXPECT_EQ(count(text, " d=\"M0 0M"), 1U);
  EXPECT_NE(text.find("not drawn"), std::string::npos);
}

// A dent in a straight line of length 100, the box around it and the curve before: what is outside it is not drawn.
TEST_F(CurveSvg, DrawsAPart) {
  std::vector<Vector3> nodes;
  for (int k = 0; k <= 100; ++k) nodes.emplace_back(k, k == 30 ? 0.5 : 0, 0);
  CurveFile file;
  file.curve = PolygonCurve(nodes);
  const Eigen::AlignedBox<double, 3> part(Vector3(25.5, -1, 0), Vector3(34.5, 1, 0));
  const std::string text = draw_curve(file, nodes, {.part = part});
  EXPECT_TRUE(is_balanced(text));
  // Nodes 26 to 34, and one at either end for the line to go on to; the curvature of 29 to 31 is not zero.
  EXPECT_EQ(count(text, "<circle"), 11U);
  EXPECT_EQ(teeth_of(text, "curve").size(), 3U);
  EXPECT_EQ(plotted(text, 0).size(), 9U);
  EXPECT_NE(text.find(">30</text>"), std::string::npos);
  EXPECT_EQ(text.find(">60</text>"), std::string::npos);
  EXPECT_EQ(count(text, "clip-path=\"url(#part)\""), 2U);
}

// The part of a circle through which its numbering begins is one line, and its arc length goes on.
TEST_F(CurveSvg, DrawsAPartThroughTheBeginningOfAClosedCurve) {
  CurveFile file;
  file.curve = circle(40, 2, true);
  const Eigen::AlignedBox<double, 3> part(Vector3(6.5, -1, 0), Vector3(7.5, 1, 0));
  const std::string text = draw_curve(file, file.curve.positions(), {.part = part});
  EXPECT_EQ(count(text, "<polygon"), 0U);
  EXPECT_EQ(count(text, "<polyline"), 2U);
  const auto points = plotted(text, 0);
  EXPECT_EQ(points.size(), 7U);
  for (std::size_t k = 1; k < points.size(); ++k) EXPECT_GT(points[k].first, points[k - 1].first);
}

TEST_F(CurveSvg, DrawsPointsWhereTheCurveIs) {
  CurveFile file;
  file.curve = circle(20, 2, true);
  std::vector<Vector3> points = file.curve.positions();
  points.emplace_back(900, 0, 0);
  points.emplace_back(0, std::nan(""), 0);
  const std::string text = draw_curve(file, file.curve.positions(), {.points = points});
  EXPECT_TRUE(is_balanced(text));
  EXPECT_LT(text.find("id=\"points\""), text.find("id=\"curve\""));
  EXPECT_EQ(count(text, "h0"), 20U);
  const std::vector<Vector3> many(100'000, points.front());
  EXPECT_LE(count(draw_curve(file, file.curve.positions(), {.points = many}), "h0"), 20'000U);
  EXPECT_EQ(draw_curve(file, file.curve.positions()).find("id=\"points\""), std::string::npos);
}

TEST_F(CurveSvg, ShowsACurveInSpaceFromTheFront) {
  // A circle that stands upright and is turned; seen along its normal, it is as wide as high.
  std::vector<Vector3> nodes;
  const PolygonCurve lying = circle(36, 2, true);
  for (const Vector3& p : lying.positions())
    nodes.push_back(Vector3(3, 1, 7) + (p.x() - 5) * Vector3(0.6, 0, 0.8) + p.y() * Vector3(0, 1, 0));
  CurveFile file;
  file.curve = PolygonCurve(nodes, true);
  const std::string text = picture(file);
  double left = HUGE_VAL;
  double right = -HUGE_VAL;
  double top = HUGE_VAL;
  double bottom = -HUGE_VAL;
  for (const Tooth& tooth : teeth_of(text, "curve")) {
    left = std::min(left, tooth.tip_x);
    right = std::max(right, tooth.tip_x);
    top = std::min(top, tooth.tip_y);
    bottom = std::max(bottom, tooth.tip_y);
  }
  EXPECT_GT(right - left, 900);
  EXPECT_NEAR(right - left, bottom - top, 0.1);
}

// Around a circle of radius 2 the plot is level, at a curvature of a half: the tick of 0.5 is as high as the line.
TEST_F(CurveSvg, PlotsCurvatureAgainstArcLength) {
  for (const bool left : {true, false}) {
    CurveFile file;
    file.curve = circle(40, left ? 2 : -2, true);
    if (!left) {
      std::vector<Vector3> nodes = file.curve.positions();
      std::reverse(nodes.begin(), nodes.end());
      file.curve = PolygonCurve(nodes, true);
    }
    const std::string text = picture(file);
    const auto points = plotted(text, 0);
    ASSERT_EQ(points.size(), 40U);
    for (const auto& [x, y] : points) EXPECT_NEAR(y, points.front().second, 0.02);
    const std::size_t label = text.find(left ? ">0.5</text>" : ">-0.5</text>");
    ASSERT_NE(label, std::string::npos);
    const std::size_t y = text.rfind(" y=\"", label) + 4;
    EXPECT_NEAR(std::stod(text.substr(y)) - 5, points.front().second, 0.02);
    EXPECT_NE(text.find("curvature is positive to the left"), std::string::npos);
    for (std::size_t k = 1; k < points.size(); ++k)
      EXPECT_NEAR(points[k].first - points[k - 1].first, points[1].first - points[0].first, 0.02);
  }
}

// A helix has no side to bend to; its curvature is r / (r² + c²).
TEST_F(CurveSvg, PlotsBeforeAndAfterOfACurveInSpace) {
  std::vector<Vector3> nodes;
  for (int k = 0; k <= 60; ++k) nodes.emplace_back(std::cos(0.1 * k), std::sin(0.1 * k), 0.1 * k);
  CurveFile file;
  file.curve = PolygonCurve(nodes);
  nodes[30] *= 1.01;
  const PolygonCurve before(nodes);
  const std::string text = picture(file, &before);
  EXPECT_TRUE(is_balanced(text));
  EXPECT_EQ(text.find("positive to the left"), std::string::npos);
  const auto behind = plotted(text, 0);
  const auto after = plotted(text, 1);
  ASSERT_EQ(behind.size(), 59U);
  ASSERT_EQ(after.size(), 59U);
  for (const auto& [x, y] : after) EXPECT_NEAR(y, after.front().second, 0.05);
  double jump = 0;
  for (const auto& [x, y] : behind) jump = std::max(jump, std::abs(y - after.front().second));
  EXPECT_GT(jump, 20);
}

TEST_F(CurveSvg, DrawsWhateverTheNodesAre) {
  const std::vector<std::vector<Vector3>> shapes = {{{0, 0, 0}, {1, 0, 0}, {2, 0, 0}},
                                                    {{1, 1, 1}, {1, 1, 1}, {1, 1, 1}},
                                                    {{0, 0, 0}, {1, 0, 0}, {0, 0, 0}, {1, 1, 0}},
                                                    {{1e300, 0, 0}, {0, 1e300, 0}, {-1e300, 0, 5}},
                                                    {{1e-300, 0, 0}, {0, 1e-300, 0}, {-1e-300, 0, 0}},
                                                    {{0, 0, 0}},
                                                    {}};
  for (const auto& nodes : shapes) {
    CurveFile file;
    file.curve = PolygonCurve(nodes);
    const std::string text = picture(file, &file.curve);
    EXPECT_TRUE(is_balanced(text));
    EXPECT_EQ(text.find("nan"), std::string::npos);
    EXPECT_EQ(text.find("inf"), std::string::npos);
  }
  const CurveFile holed = read("0 0\n1 1\nnan 0\n2 0\n3 1\n4 0\n", "xyz");
  const std::string text = picture(holed);
  EXPECT_EQ(text.find("nan"), std::string::npos);
  EXPECT_EQ(count(text, "<circle"), 5U);
  EXPECT_NE(text.find("<title>in.xyz</title>"), std::string::npos);
}

TEST_F(CurveSvg, LeavesOutTheDotsOfManyNodes) {
  CurveFile file;
  file.curve = circle(400, 2, true);
  EXPECT_EQ(count(picture(file), "<circle"), 0U);
}

}  // namespace
}  // namespace vspring::curve_svg_test
