#include "io/svg_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

namespace vspring {
namespace {

constexpr double left_edge = 90;
constexpr double right_edge = 25;
constexpr double bottom_edge = 55;
/// By how much more than that of the curve after it the curvature of the one before is shown.
constexpr double most_behind = 2.5;

struct Range {
  double low = 0;
  double high = 0;

  void add(double value) {
    low = std::min(low, value);
    high = std::max(high, value);
  }
  [[nodiscard]] double size() const { return high - low; }
};

/// Round numbers within a range, some six of them.
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

  void axes(std::string& text, const char* upward) const {
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
    label(text, {(left_edge + right) / 2, bottom + 45}, "middle", "arc length, units of the input");
    const double middle = (place_.top + bottom) / 2;
    text += fmt::format("<text transform=\"translate(18 {:.2f}) rotate(-90)\" text-anchor=\"middle\">{}</text>\n",
                        middle, upward);
    text += fmt::format(
        "<clipPath id=\"plot-area\"><rect x=\"{:.2f}\" y=\"{:.2f}\" width=\"{:.2f}\" height=\"{:.2f}\"/></clipPath>\n",
        left_edge, place_.top, right - left_edge, bottom - place_.top);
  }

  /// Name and line in the corner, the k-th from the right.
  void key(std::string& text, int k, const char* name, const char* colour) const {
    const double at = place_.width - right_edge - 85 * (k + 1);
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
};

struct Series {
  struct Line {
    std::vector<Vector2> points;
  };
  std::vector<Line> lines;
  Range across;
  Range up;
};

/// Runs follow each other.
Series series_of(const Drawing& drawing, double unit, bool planar) {
  Series series;
  double begin = 0;
  for (const Drawing::Run& run : drawing.runs) {
    Series::Line& line = series.lines.emplace_back();
    for (std::size_t k = 0; k < run.nodes.size(); ++k) {
      const double arc = (begin + run.arc[k]) * unit;
      series.across.add(arc);
      if (!run.closed && (k == 0 || k + 1 == run.nodes.size())) continue;
      const double curvature = (planar ? run.bends[k] : std::abs(run.bends[k])) / unit;
      line.points.emplace_back(arc, curvature);
      series.up.add(curvature);
    }
    begin += run.length;
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
  const double unit = std::clamp(length_unit, 1e-250, 1e250);  // no picture has an infinity in it
  const bool planar = curve.planar && (before == nullptr || before->planar);
  const Series after = series_of(curve, unit, planar);
  if (after.lines.empty()) return {};
  Range across = after.across;
  Range up = after.up;
  Series behind;
  if (before != nullptr) {
    behind = series_of(*before, unit, planar);
    across.add(behind.across.high);
    // A straight curve has no curvature to take the range from, then the one before it gives it.
    const double most = after.up.size() > 0 ? most_behind * std::max(-after.up.low, after.up.high)
                                            : std::numeric_limits<double>::infinity();
    up.add(std::max(behind.up.low, -most));
    up.add(std::min(behind.up.high, most));
  }
  const double space = 0.05 * up.size();
  up = {up.low < 0 ? up.low - space : 0, up.high > 0 ? up.high + space : 0};

  const Plot plot(across, up, place);
  std::string text =
      "<g id=\"plot\" font-family=\"DejaVu Sans, Arial, sans-serif\" font-size=\"15\" fill=\"#333333\">\n";
  plot.axes(text, planar ? "curvature, left is positive" : "curvature");
  if (before != nullptr) {
    draw(text, plot, behind, "#b0b0b0");
    plot.key(text, 1, "before", "#b0b0b0");
    plot.key(text, 0, "after", "#1b3a6b");
  }
  draw(text, plot, after, "#1b3a6b");
  text += "</g>\n";
  return text;
}

}  // namespace vspring
