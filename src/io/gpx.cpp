// GPX: tracks and routes as receivers log them, in degrees. Each segment of a track and each route is an open chain.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/message_text.hpp"
#include "io/column_names.hpp"
#include "io/curve_formats.hpp"
#include "io/degrees.hpp"
#include "io/face_list.hpp"
#include "io/rewriter.hpp"
#include "io/table.hpp"
#include "io/xml_scanner.hpp"

namespace vspring {
namespace {

/// Where a value or an element stands in the file.
struct Span {
  std::size_t begin;
  std::size_t end;
};

class GpxSource : public CurveSource {
 public:
  [[nodiscard]] std::string rewritten(const Rewriting& what) const override;

  struct Point {
    Span element;
    Span latitude;
    Span longitude;
    Span elevation = {0, 0};  ///< set if elevations are a coordinate
  };
  std::vector<Point> points;  ///< ascending
  std::optional<LocalPlane> plane;

 private:
  [[nodiscard]] std::string point_text(std::size_t node, const Rewriting& what) const;
};

std::string GpxSource::point_text(std::size_t node, const Rewriting& what) const {
  const auto& [element, latitude, longitude, elevation] = points[node];
  const std::string_view text = std::string_view(file.bytes).substr(element.begin, element.end - element.begin);
  if (what.moved[node] == 0) return std::string(text);
  const LocalPlane::Place place = plane->place(what.places[node]);
  std::array<std::pair<Span, double>, 2> values = {{{latitude, place.latitude}, {longitude, place.longitude}}};
  if (longitude.begin < latitude.begin) std::swap(values[0], values[1]);
  TextRewriter out(text);
  std::string number;
  if (what.places[node].head<2>() != positions[node].head<2>()) {
    for (const auto& [span, degrees] : values) {
      number.clear();
      append_degrees(number, degrees);
      out.replace(span.begin - element.begin, span.end - element.begin, number);
    }
  }
  if (what.places[node].z() != positions[node].z()) {
    number.clear();
    append_number(number, what.places[node].z());
    out.replace(elevation.begin - element.begin, elevation.end - element.begin, number);
  }
  return out.finish();
}

std::string GpxSource::rewritten(const Rewriting& what) const {
  TextRewriter out(file.bytes);
  for (std::size_t slot = 0; slot < points.size(); ++slot) {
    const std::size_t node = what.node_in(slot);
    if (node != slot || what.moved[node] != 0)
      out.replace(points[slot].element.begin, points[slot].element.end, point_text(node, what));
  }
  return out.finish();
}

class GpxReader {
 public:
  GpxReader(const InputFile& file, bool elevations) : file_(file), scanner_(file), elevations_(elevations) {}

  void read();
  CurveFile take(InputFile file, const std::optional<LocalPlane>& plane);

 private:
  void begin_element();
  void begin_chain();
  void begin_point();
  void end_point();
  void read_elevation();
  /// The span and value of a numeric attribute of the element that begins here.
  std::pair<Span, double> number_of_attribute(std::string_view name) const;

  const InputFile& file_;
  XmlScanner scanner_;
  bool elevations_;  ///< whether they are a coordinate
  std::shared_ptr<GpxSource> source_ = std::make_shared<GpxSource>();
  std::vector<PolygonCurve::Chain> chains_;
  bool in_chain_ = false;
  std::set<std::string> carried_;
};

void GpxReader::read() {
  using Event = XmlScanner::Event;
  for (Event event = scanner_.next(); event != Event::file_ends; event = scanner_.next()) {
    const std::string_view name = scanner_.name();
    const bool is_chain = name == "trkseg" || name == "rte";
    const bool is_point = name == "trkpt" || name == "rtept";
    if (event == Event::element_begins) {
      begin_element();
      if (is_chain) begin_chain();
      if (is_point) begin_point();
      if (name == "ele" && elevations_) read_elevation();
    } else if (is_chain) {
      in_chain_ = false;
      if (chains_.back().nodes.empty()) chains_.pop_back();
    } else if (is_point) {
      end_point();
    }
  }
}

/// Notes the contents that other formats cannot hold, and refuses files that are not GPX.
void GpxReader::begin_element() {
  constexpr std::array<std::pair<std::string_view, const char*>, 6> known = {{{"time", "times"},
                                                                              {"ele", "elevations"},
                                                                              {"name", "names"},
                                                                              {"desc", "descriptions"},
                                                                              {"wpt", "waypoints"},
                                                                              {"extensions", "extensions"}}};
  const std::string_view name = scanner_.name();
  if (scanner_.parent().empty() && name != "gpx")
    file_.refuse_line(scanner_.begin(),
                      fmt::format("the file holds <{}> where GPX has <gpx>; choose a GPX file", in_one_line(name, 24)));
  for (const auto& [element, what] : known) {
    if (name == element && !(elevations_ && name == "ele")) carried_.insert(what);
  }
}

std::pair<Span, double> GpxReader::number_of_attribute(std::string_view name) const {
  const auto& attributes = scanner_.attributes();
  const auto found = std::find_if(attributes.begin(), attributes.end(), [&](const auto& a) { return a.name == name; });
  if (found == attributes.end())
    file_.refuse_line(scanner_.begin(), fmt::format("the point has no {}; repair or remove it", name));
  const std::optional<double> number = number_of(trimmed(found->value));
  if (!number)
    file_.refuse_line(scanner_.begin(),
                      fmt::format("{} stands where {} belongs; repair the point", in_quotes(found->value), name));
  const auto begin = static_cast<std::size_t>(found->value.data() - file_.bytes.data());
  return {{begin, begin + found->value.size()}, *number};
}

void GpxReader::begin_chain() {
  if (in_chain_) file_.refuse_line(scanner_.begin(), "a segment or route begins within another; repair the file");
  chains_.emplace_back();
  in_chain_ = true;
}

void GpxReader::begin_point() {
  if (scanner_.parent() != "trkseg" && scanner_.parent() != "rte")
    file_.refuse_line(scanner_.begin(),
                      fmt::format("a point stands in <{}> and not in a segment or route; repair the file",
                                  in_one_line(scanner_.parent(), 24)));
  if (static_cast<std::int64_t>(source_->points.size()) == most_nodes)
    file_.refuse_line(scanner_.begin(), "more than 2^30 points; split the file");
  const auto [latitude_at, latitude] = number_of_attribute("lat");
  const auto [longitude_at, longitude] = number_of_attribute("lon");
  require_place(file_, scanner_.begin(), {latitude, longitude});
  chains_.back().nodes.push_back(static_cast<Index>(source_->points.size()));
  source_->points.push_back({{scanner_.begin(), scanner_.end()}, latitude_at, longitude_at});
  source_->positions.emplace_back(longitude, latitude, 0);
}

void GpxReader::read_elevation() {
  if (scanner_.parent() != "trkpt" && scanner_.parent() != "rtept") return;
  const std::size_t begin = scanner_.end();
  const std::size_t end = std::min(file_.bytes.find('<', begin), file_.bytes.size());
  const std::string_view text = trimmed(std::string_view(file_.bytes).substr(begin, end - begin));
  const std::optional<double> number = number_of(text);
  if (!number)
    file_.refuse_line(scanner_.begin(),
                      fmt::format("{} stands where an elevation belongs; repair the point", in_quotes(text)));
  source_->positions.back().z() = *number;
  source_->points.back().elevation = {begin, end};
}

void GpxReader::end_point() {
  auto& point = source_->points.back();
  point.element.end = scanner_.end();
  if (elevations_ && point.elevation.end == 0)
    file_.refuse_line(point.element.begin, "the point has no elevation",
                      {{Remedy::input, "add it"}, {Remedy::columns, "leave ele out of the choice of columns"}});
}

CurveFile GpxReader::take(InputFile file, const std::optional<LocalPlane>& plane) {
  if (source_->points.empty()) file.refuse("no track and no route with points is in it; choose another file");
  if (std::none_of(chains_.begin(), chains_.end(), [](const auto& chain) { return chain.nodes.size() > 1; }))
    file.refuse("no two of its points follow each other; choose another file");
  CurveFile curve;
  curve.format = CurveFormat::gpx;
  curve.planar = !elevations_;
  if (elevations_) curve.column_names = {"lon", "lat", "ele"};
  curve.plane = take_to_plane(source_->positions, plane);
  const std::string warning = stretch_warning(file, *curve.plane, source_->positions);
  if (!warning.empty()) curve.warnings.push_back(warning);
  curve.curve = PolygonCurve(source_->positions, std::move(chains_));
  source_->plane = curve.plane;
  source_->has_rows = true;
  source_->carried.assign(carried_.begin(), carried_.end());
  source_->file = std::move(file);
  curve.source = std::move(source_);
  return curve;
}

}  // namespace

CurveFile read_gpx_curve(InputFile file, const ColumnChoice& choice, const std::optional<LocalPlane>& plane) {
  GpxReader reader(file, chooses_elevations(file, choice));
  reader.read();
  return reader.take(std::move(file), plane);
}

std::string fresh_gpx(const FreshCurve& curve, std::vector<std::string>& losses) {
  name_losses_of_rows(curve, losses);
  std::string text =
      "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n"
      "<gpx version=\"1.1\" creator=\"vspring\" xmlns=\"http://www.topografix.com/GPX/1/1\">\n<trk>\n<trkseg>\n";
  walk_rows(
      curve,
      [&](const Vector3& position) {
        const LocalPlane::Place place = curve.plane->place(position);
        text += "<trkpt lat=\"";
        append_degrees(text, place.latitude);
        text += "\" lon=\"";
        append_degrees(text, place.longitude);
        text += "\"";
        if (!curve.planar) {
          text += "><ele>";
          append_degrees(text, position.z());
          text += "</ele></trkpt>\n";
        } else {
          text += "/>\n";
        }
      },
      [&] { text += "</trkseg>\n<trkseg>\n"; });
  return text + "</trkseg>\n</trk>\n</gpx>\n";
}

}  // namespace vspring
