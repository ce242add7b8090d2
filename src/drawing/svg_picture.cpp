#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <string>
#include <string_view>

#include "drawing/svg.hpp"
#include "drawing/svg_drawing.hpp"

namespace vspring {
namespace {

constexpr double drawing_size = 1000;         ///< of the longer side, in pixels
constexpr double longest_tooth = 0.15;        ///< of the comb, in diagonals of the drawing
constexpr double longest_tooth_behind = 0.4;  ///< of the curve before: longer ones are cut off
constexpr double plot_height = 300;           ///< of the plot of curvature below, in pixels
constexpr double least_width = 600;           ///< in pixels, so the plot can be read
constexpr std::size_t most_dots = 400;        ///< more nodes than this would hide the curve
constexpr std::size_t most_points = 20'000;

/// Whether most teeth of the curve are longer than `longest`.
bool mostly_longer(const Drawing& drawing, double scale, double longest) {
  std::ptrdiff_t longer = 0;
  std::ptrdiff_t all = 0;
  for (const Drawing::Run& run : drawing.runs) {
    longer += std::count_if(run.curvatures.begin(), run.curvatures.end(),
                            [&](const Vector2& c) { return scale * c.norm() > longest; });
    all += std::ssize(run.curvatures);
  }
  return 2 * longer > all;
}

/// The tips of a run's teeth, cut off at `longest`.
std::vector<Vector2> tips_of(const Drawing::Run& run, double scale, double longest) {
  std::vector<Vector2> tips;
  tips.reserve(run.nodes.size());
  for (std::size_t k = 0; k < run.nodes.size(); ++k) {
    const Vector2 tooth = scale * run.curvatures[k];
    const double length = tooth.norm();
    tips.push_back(run.nodes[k] - (length > longest ? Vector2(tooth * (longest / length)) : tooth));
  }
  return tips;
}

/// The box around what is drawn.
class Box {
 public:
  void add(const std::vector<Vector2>& points) {
    for (const Vector2& p : points) {
      low_ = low_.cwiseMin(p);
      high_ = high_.cwiseMax(p);
    }
  }
  [[nodiscard]] bool empty() const { return !(low_.x() <= high_.x()); }
  [[nodiscard]] Vector2 size() const { return empty() ? Vector2(Vector2::Zero()) : Vector2(high_ - low_); }
  [[nodiscard]] bool contains(const Vector2& p) const {
    return (p.array() >= low_.array()).all() && (p.array() <= high_.array()).all();
  }
  [[nodiscard]] Vector2 upper_left() const { return empty() ? Vector2(Vector2::Zero()) : Vector2(low_.x(), high_.y()); }

 private:
  Vector2 low_ = Vector2::Constant(HUGE_VAL);
  Vector2 high_ = Vector2::Constant(-HUGE_VAL);
};

/// Writes shapes in the pixels of the picture.
class Pen {
 public:
  Pen(std::string& text, const Vector2& upper_left, double pixels)
      : text_(text), upper_left_(upper_left), pixels_(pixels) {}

  void line(const std::vector<Vector2>& points, bool closed) {
    if (points.size() < 2) return;
    text_ += closed ? "<polygon points=\"" : "<polyline points=\"";
    for (const Vector2& p : points) append("{:.2f},{:.2f} ", p);
    text_.back() = '"';
    text_ += "/>\n";
  }
  void teeth(const std::vector<Vector2>& roots, const std::vector<Vector2>& tips) {
    const std::size_t begin = text_.size();
    text_ += "<path d=\"";
    const std::size_t empty = text_.size();
    for (std::size_t k = 0; k < roots.size(); ++k) {
      if (roots[k] == tips[k]) continue;
      append("M{:.2f} {:.2f}", roots[k]);
      append("L{:.2f} {:.2f}", tips[k]);
    }
    if (text_.size() == empty)
      text_.resize(begin);
    else
      text_ += "\"/>\n";
  }
  /// Each point is a line without length, drawn with round ends.
  void points(const std::vector<Vector2>& points) {
    text_ += "<path d=\"";
    for (const Vector2& p : points) append("M{:.1f} {:.1f}h0", p);
    text_ += "\"/>\n";
  }
  void dots(const std::vector<Vector2>& points) {
    for (const Vector2& p : points) append("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"1.8\"/>\n", p);
  }

 private:
  void append(fmt::format_string<double, double> form, const Vector2& p) {
    text_ += fmt::format(form, pixels_ * (p.x() - upper_left_.x()), pixels_ * (upper_left_.y() - p.y()));
  }

  std::string& text_;
  Vector2 upper_left_;
  double pixels_;
};

/// A curve and its comb as they are drawn.
struct Layer {
  Drawing drawing;
  std::vector<std::vector<Vector2>> tips;

  void set_tips(double scale, double longest) {
    tips.reserve(drawing.runs.size());
    for (const Drawing::Run& run : drawing.runs) tips.push_back(tips_of(run, scale, longest));
  }
};

struct Style {
  const char* curve;
  const char* teeth;
  const char* tips;
};

constexpr Style strong = {"stroke=\"#1b3a6b\" stroke-width=\"1.8\"", "stroke=\"#e08a5b\" stroke-width=\"0.6\"",
                          "stroke=\"#c8461e\" stroke-width=\"1\""};
constexpr Style thin = {"stroke=\"#8a8a8a\" stroke-width=\"1\"", "stroke=\"#d4d4d4\" stroke-width=\"0.6\"",
                        "stroke=\"#bcbcbc\" stroke-width=\"0.8\""};

void draw(std::string& text, Pen& pen, const Layer& layer, const char* name, const Style& style) {
  const auto& runs = layer.drawing.runs;
  const auto group = [&](const char* look, const auto& draw_run) {
    text += fmt::format("<g {}>\n", look);
    for (std::size_t r = 0; r < runs.size(); ++r) draw_run(runs[r], layer.tips[r]);
    text += "</g>\n";
  };
  text += fmt::format("<g id=\"{}\">\n", name);
  group(style.teeth, [&](const auto& run, const auto& tips) { pen.teeth(run.nodes, tips); });
  group(style.tips, [&](const auto& run, const auto& tips) { pen.line(tips, run.closed); });
  group(style.curve, [&](const auto& run, const auto&) { pen.line(run.nodes, run.closed); });
  text += "</g>\n";
}

/// Where a box is in the picture.
Window window_of(const Eigen::AlignedBox<double, 3>& part, const CurveView& view) {
  Window window;
  for (int k = 0; k < 8; ++k) {
    const auto corner = static_cast<Eigen::AlignedBox<double, 3>::CornerType>(k);
    window.extend(view.flat(view.normalized(part.corner(corner))));
  }
  return window;
}

/// The length of the non-ASCII UTF-8 character at the front; 0 if there is none that XML may hold.
std::size_t character_length(std::string_view text) {
  const auto lead = static_cast<std::uint8_t>(text.front());
  const auto length = static_cast<std::size_t>(std::countl_one(lead));
  if (length < 2 || length > 4 || length > text.size()) return 0;
  std::uint32_t code = lead & (0xFFU >> (length + 1));
  for (std::size_t k = 1; k < length; ++k) {
    const auto next = static_cast<std::uint8_t>(text[k]);
    if ((next & 0xC0U) != 0x80U) return 0;
    code = code << 6U | (next & 0x3FU);
  }
  const std::uint32_t least = length == 2 ? 0x80 : length == 3 ? 0x800 : 0x10000;
  const bool surrogate = code >= 0xD800 && code < 0xE000;
  return code < least || code > 0x10FFFF || surrogate || code == 0xFFFE || code == 0xFFFF ? 0 : length;
}

std::string xml_text(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const char c = text.front();
    std::size_t length = 1;
    if (c == '&') {
      result += "&amp;";
    } else if (c == '<') {
      result += "&lt;";
    } else if (c == '>') {
      result += "&gt;";
    } else if (c == '"') {
      result += "&quot;";
    } else if (c == '\t' || (c >= ' ' && c <= '~')) {
      result += c;
    } else if (const std::size_t found = (c & 0x80) != 0 ? character_length(text) : 0; found > 0) {
      length = found;
      result += text.substr(0, length);
    } else {
      result += '?';
    }
    text.remove_prefix(length);
  }
  return result;
}

}  // namespace

std::string svg_picture(const DrawnCurve& curve, const DrawnCurve* before, std::span<const Vector3> points,
                        const Eigen::AlignedBox<double, 3>* part, const std::string& title) {
  const CurveView view(curve);
  Layer after{drawing_of(curve, view), {}};
  Layer behind{before != nullptr ? drawing_of(*before, view) : Drawing(), {}};
  Box box;
  Window window;
  if (part != nullptr) {
    window = window_of(*part, view);
    for (Layer* layer : {&after, &behind}) layer->drawing = part_inside(layer->drawing, window);
    box.add({window.min(), window.max()});
  } else {
    for (const Layer* layer : {&after, &behind}) {
      for (const Drawing::Run& run : layer->drawing.runs) box.add(run.nodes);
    }
  }
  std::size_t node_count = 0;
  for (const Drawing::Run& run : after.drawing.runs) node_count += run.nodes.size();
  const double diagonal = box.empty() || box.size().norm() == 0 ? 1 : box.size().norm();

  // A straight curve has no comb to take the scale from; then the curve before gives it.
  constexpr double straight = 1e-9;
  const double longest = longest_tooth_behind * diagonal;
  double scale = 0;
  if (after.drawing.sharpest * diagonal > straight)
    scale = longest_tooth * diagonal / after.drawing.sharpest;
  else if (behind.drawing.sharpest * diagonal > straight)
    scale = longest / behind.drawing.sharpest;
  for (Layer* layer : {&after, &behind}) {
    layer->set_tips(layer == &behind && mostly_longer(behind.drawing, scale, longest) ? 0 : scale, longest);
    for (std::size_t r = 0; r < layer->tips.size(); ++r) {
      std::vector<Vector2> tips = layer->tips[r];
      // Beyond a part, lines only leave the picture.
      const std::vector<Vector2>& nodes = layer->drawing.runs[r].nodes;
      for (std::size_t k = 0; part != nullptr && k < tips.size(); ++k) {
        if (!window.contains(nodes[k])) tips[k] = window.center();
      }
      box.add(tips);
    }
  }

  std::vector<Vector2> dots;
  for (std::size_t j = 0; j < points.size(); j += 1 + points.size() / most_points) {
    const Vector2 dot = view.flat(view.normalized(points[j]));
    if (box.contains(dot)) dots.push_back(dot);
  }

  const Vector2 margin = Vector2::Constant(0.03 * std::max(box.size().norm(), diagonal));
  const Vector2 size = box.size() + 2 * margin;
  const double pixels = drawing_size / size.maxCoeff();
  const double width = std::max(pixels * size.x(), least_width);
  const double height = pixels * size.y();
  constexpr double above_plot = 30;
  const std::string plot =
      curvature_plot(after.drawing, before != nullptr ? &behind.drawing : nullptr, view.unit(),
                     {.top = height + above_plot, .width = width, .height = plot_height, .points = !dots.empty()});
  std::string text = fmt::format(
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.0f}\" "
      "height=\"{1:.0f}\" viewBox=\"0 0 {0:.2f} {1:.2f}\">\n<title>{2}</title>\n"
      "<style>polyline, polygon, path {{ vector-effect: non-scaling-stroke }}</style>\n"
      "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n",
      width, height + (plot.empty() ? 0 : above_plot + plot_height), xml_text(title));
  if (part != nullptr)
    text += fmt::format("<clipPath id=\"part\"><rect width=\"{:.2f}\" height=\"{:.2f}\"/></clipPath>\n", width, height);
  const char* const cut_off = part != nullptr ? " clip-path=\"url(#part)\"" : "";
  text += fmt::format("<g fill=\"none\" stroke-linejoin=\"round\" stroke-linecap=\"round\"{}>\n", cut_off);
  const double aside = (width / pixels - size.x()) / 2;
  Pen pen(text, box.upper_left() + Vector2(-margin.x() - aside, margin.y()), pixels);
  if (before != nullptr) draw(text, pen, behind, "before", thin);
  if (!dots.empty()) {
    text += "<g id=\"points\" stroke=\"#6b6b6b\" stroke-width=\"3\">\n";
    pen.points(dots);
    text += "</g>\n";
  }
  draw(text, pen, after, "curve", strong);
  text += "</g>\n";
  if (node_count < most_dots) {
    text += fmt::format("<g id=\"nodes\" fill=\"#1b3a6b\"{}>\n", cut_off);
    for (const Drawing::Run& run : after.drawing.runs) pen.dots(run.nodes);
    text += "</g>\n";
  }
  text += plot + "</svg>\n";
  return text;
}

}  // namespace vspring
