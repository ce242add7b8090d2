#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "drawing/svg.hpp"

namespace vspring {
namespace {

constexpr double left_edge = 90;
constexpr double right_edge = 25;
constexpr double bottom_edge = 55;
constexpr double letter = 8;  ///< the width of one, about
/// How far the range of curvature may be widened, as a factor, for the curve before.
constexpr double most_behind = 2.5;
constexpr double nearly_straight = 1e-9;  ///< less than visible, in radians along the curve

struct Range {
  double low;
  double high;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] double size() const { return high - low; }
};

/// About six round numbers within a range.
std::vector<double> ticks_of(const Range& range) {
  std::vector<double> ticks;
  const double rough = range.size() / 6;
  const double power = std::pow(10.0, std::floor(std::log10(rough)));
  double step = 10 * power;
  for (const double factor : {5.0, 2.0, 1.0}) {
    if (factor * power >= rough) step = factor * power;
  }
  if (!(step > 0) || !std::isfinite(step)) return ticks;
  for (double k = std::ceil(range.low / step - 1e-9); k * step <= range.high + 1e-9 * step; ++k)
    ticks.push_back(k == 0 ? 0 : k * step);
  return ticks;
}

class Plot {
 public:
  Plot(Range across, Range up, const PlotPlace& place) : across_(across), up_(up), place_(place) {
    for (Range* range : {&across_, &up_}) {
      if (!(range->size() > 0)) *range = {range->low - 0.5, range->high + 0.5};
    }
  }

  [[nodiscard]] double x(double arc) const {
    return left_edge + (place_.width - left_edge - right_edge) * ((arc - across_.low) / across_.size());
  }
  [[nodiscard]] double y(double curvature) const {
    return place_.top + (place_.height - bottom_edge) * ((up_.high - curvature) / up_.size());
  }

  void axes(std::string& text, bool planar) const {
    const double bottom = place_.top + place_.height - bottom_edge;
    const double right = place_.width - right_edge;
    for (const double tick : ticks_of(across_)) {
      line(text, {x(tick), place_.top}, {x(tick), bottom}, "#dddddd");
      label(text, {x(tick), bottom + 20}, "middle", fmt::format("{:.4g}", tick));
    }
    for (const double tick : ticks_of(up_)) {
      line(text, {left_edge, y(tick)}, {right, y(tick)}, tick == 0 ? "#888888" : "#dddddd");
      label(text, {left_edge - 8, y(tick) + 5}, "end", fmt::format("{:.4g}", tick));
    }
    label(text, {(left_edge + right) / 2, bottom + 45}, "middle",
          planar ? "arc length, units of the input; curvature is positive to the left"
                 : "arc length, units of the input");
    const double middle = (place_.top + bottom) / 2;
    text += fmt::format(
        "<text transform=\"translate(18 {:.2f}) rotate(-90)\" text-anchor=\"middle\">curvature, 1/unit</text>\n",
        middle);
    text += fmt::format(
        "<clipPath id=\"plot-area\"><rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"/></clipPath>\n",
        left_edge, place_.top, right - left_edge, bottom - place_.top);
  }

  /// A name and a sample line above the plot, to the left of the last key.
  void key(std::string& text, const std::string& name, const char* colour) {
    keys_ += 50 + letter * static_cast<double>(name.size());
    const double at = place_.width - right_edge - keys_;
    line(text, {at, place_.top - 12}, {at + 24, place_.top - 12}, colour);
    label(text, {at + 30, place_.top - 7}, "start", name);
  }

 private:
  static void line(std::string& text, const Vector2& from, const Vector2& to, const char* colour) {
    text += fmt::format("<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\"/>\n", from.x(),
                        from.y(), to.x(), to.y(), colour);
  }
  static void label(std::string& text, const Vector2& at, const char* anchor, const std::string& what) {
    text += fmt::format("<text x=\"{:.2f}\" y=\"{:.2f}\" text-anchor=\"{}\">{}</text>\n", at.x(), at.y(), anchor, what);
  }

  Range across_;
  Range up_;
  PlotPlace place_;
  double keys_ = 0;  ///< the width of the keys so far
};

struct Series {
  struct Line {
    std::vector<Vector2> points;
  };
  std::vector<Line> lines;
  Range across = {.low = HUGE_VAL, .high = -HUGE_VAL};
  Range up = {.low = 0, .high = 0};

  /// Whether most of the series lies beyond a curvature.
  [[nodiscard]] bool mostly_beyond(double curvature) const {
    std::ptrdiff_t beyond = 0;
    std::ptrdiff_t all = 0;
    for (const Line& line : lines) {
      beyond += std::count_if(line.points.begin(), line.points.end(),
                              [&](const Vector2& p) { return std::abs(p.y()) > curvature; });
      all += std::ssize(line.points);
    }
    return 2 * beyond > all;
  }
};

/// The place along a run at which the circle through a node and its neighbours has the curve's curvature to second
/// order: the mean of the three.
double middle_of_circle(const Drawing::Run& run, std::size_t k) {
  const std::size_t last = run.nodes.size() - 1;
  const double before = k > 0 ? run.arc[k - 1] : run.closed ? run.arc[last] - run.length : run.arc[k];
  const double after = k < last ? run.arc[k + 1] : run.closed ? run.length : run.arc[k];
  return (before + run.arc[k] + after) / 3;
}

/// Runs follow each other.
Series series_of(const Drawing& drawing, double unit, bool planar) {
  Series series;
  for (const Drawing::Run& run : drawing.runs) {
    Series::Line& line = series.lines.emplace_back();
    for (std::size_t k = 0; k < run.nodes.size(); ++k) {
      const double arc = (run.begin + run.arc[k]) * unit;
      series.across.add(arc);
      if (!run.closed && (k == 0 || k + 1 == run.nodes.size())) continue;
      const double curvature = (planar ? run.bends[k] : std::abs(run.bends[k])) / unit;
      line.points.emplace_back((run.begin + middle_of_circle(run, k)) * unit, curvature);
      series.up.add(curvature);
    }
  }
  return series;
}

void draw(std::string& text, const Plot& plot, const Series& series, const char* colour) {
  text += fmt::format(
      "<path clip-path=\"url(#plot-area)\" fill=\"none\" stroke=\"{}\" stroke-width=\"1.5\" "
      "stroke-linejoin=\"round\" d=\"M0 0",
      colour);
  for (const Series::Line& line : series.lines) {
    for (std::size_t k = 0; k < line.points.size(); ++k)
      text +=
          fmt::format("{}{:.2f} {:.2f}", k == 0 ? 'M' : 'L', plot.x(line.points[k].x()), plot.y(line.points[k].y()));
  }
  text += "\"/>\n";
}

}  // namespace

std::string curvature_plot(const Drawing& curve, const Drawing* before, double length_unit, const PlotPlace& place) {
  const double unit = std::clamp(length_unit, 1e-250, 1e250);  // keeps infinities out of the picture
  const bool planar = curve.planar && (before == nullptr || before->planar);
  const Series after = series_of(curve, unit, planar);
  if (after.lines.empty()) return {};
  Range across = after.across;
  Range up = after.up;
  Series behind;
  bool noise = false;
  if (before != nullptr) {
    behind = series_of(*before, unit, planar);
    // A straight curve gives no range of curvature; then the curve before gives it.
    const bool bent = after.up.size() * after.across.size() > nearly_straight;
    const double most =
        bent ? most_behind * std::max(-after.up.low, after.up.high) : std::numeric_limits<double>::infinity();
    noise = behind.mostly_beyond(most);
    if (!noise) {
      for (const double end : {behind.across.low, behind.across.high}) across.add(end);
      up.add(std::max(behind.up.low, -most));
      up.add(std::min(behind.up.high, most));
    }
  }
  const double space = 0.05 * up.size();
  up = {up.low < 0 ? up.low - space : 0, up.high > 0 ? up.high + space : 0};

  Plot plot(across, up, place);
  std::string text =
      "<g id=\"plot\" font-family=\"DejaVu Sans, Arial, sans-serif\" font-size=\"15\" fill=\"#333333\">\n";
  plot.axes(text, planar);
  if (place.points) plot.key(text, "points", "#6b6b6b");
  plot.key(text, "curvature comb", "#c8461e");
  if (before != nullptr) {
    if (!noise) draw(text, plot, behind, "#b0b0b0");
    plot.key(text, "after", "#1b3a6b");
    // A noisy curve before would hide the result.
    const double greatest = std::max(-behind.up.low, behind.up.high);
    plot.key(text, noise ? fmt::format("before (curvature up to {:.2g}, not drawn)", greatest) : "before", "#b0b0b0");
  }
  draw(text, plot, after, "#1b3a6b");
  text += "</g>\n";
  return text;
}

}  // namespace vspring
