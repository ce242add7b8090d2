// The curves of a Wavefront OBJ file: its `l` statements.
#include <fmt/format.h>

#include <algorithm>
#include <tuple>

#include "io/curve_source.hpp"
#include "io/obj_statements.hpp"
#include "io/text_rewriter.hpp"

namespace vspring {
namespace {

class ObjCurveSource : public CurveSource {
 public:
  [[nodiscard]] std::string rewritten(const std::vector<Vector3>& places,
                                      const std::vector<std::uint8_t>& moved) const override {
    TextRewriter out(file.bytes);
    for (std::size_t node = 0; node < rows.size(); ++node) {
      if (moved[node] != 0) out.replace_words(rows[node], row_of(places[node]));
    }
    return out.finish();
  }

  std::vector<std::size_t> rows;  ///< offset of the first coordinate of each node
};

class ObjCurveReader : public ObjStatements {
 public:
  using ObjStatements::ObjStatements;

  void check() const;
  /// Hands over what was read; file becomes the source's.
  CurveFile take(InputFile file);

 protected:
  bool read_element(std::string_view keyword) override;

 private:
  std::vector<PolygonCurve::Chain> chains(const InputFile& file);
};

bool ObjCurveReader::read_element(std::string_view keyword) {
  if (keyword != "l") return false;
  if (elements_.full()) cursor_.refuse("too many lines; split the file");
  int nodes = 0;
  for (cursor_.skip_blanks(); !cursor_.at_line_end() && cursor_.peek() != '#'; cursor_.skip_blanks(), ++nodes) {
    read_node_number();
    if (cursor_.peek() == '/') {
      cursor_.skip(1);
      carried_.insert("texture coordinates");
      if (!cursor_.at_word_end()) static_cast<void>(cursor_.integer("the number of a texture coordinate"));
    }
    if (!cursor_.at_word_end()) cursor_.refuse_word("the next node of the line");
  }
  if (nodes < 2) cursor_.refuse_word("the number of a node");
  elements_.end_face();
  return true;
}

void ObjCurveReader::check() const {
  if (elements_.face_count() == 0)
    file_.refuse(carried_.count("faces") > 0
                     ? "it has no lines (statements that begin with l) but faces; use `vspring fair` for a surface"
                     : "it has no lines (statements that begin with l); choose an OBJ file of a curve");
  check_node_numbers();
}

std::vector<PolygonCurve::Chain> ObjCurveReader::chains(const InputFile& file) {
  std::vector<std::pair<Index, Index>> segments;
  segments.reserve(elements_.corner_count());
  for (Index line = 0; line < elements_.face_count(); ++line) {
    for (Index k = elements_.face_begin()[line] + 1; k < elements_.face_begin()[line + 1]; ++k)
      segments.emplace_back(elements_.corners()[k - 1], elements_.corners()[k]);
  }
  // A segment given twice would make a closed curve of two nodes, or a branch where there is none.
  struct Known {
    std::pair<Index, Index> ends;
    std::size_t number;
  };
  std::vector<Known> known;
  known.reserve(segments.size());
  for (std::size_t s = 0; s < segments.size(); ++s)
    known.push_back({std::minmax(segments[s].first, segments[s].second), s});
  std::sort(known.begin(), known.end(),
            [](const Known& a, const Known& b) { return std::tie(a.ends, a.number) < std::tie(b.ends, b.number); });
  std::size_t repeated = 0;
  for (std::size_t k = 1; k < known.size(); ++k) {
    if (known[k].ends != known[k - 1].ends || known[k].ends.first == known[k].ends.second) continue;
    std::pair<Index, Index>& again = segments[known[k].number];
    again.second = again.first;
    ++repeated;
  }
  if (repeated > 0)
    warnings_.push_back(fmt::format("{}: segments given before: {}; each is taken once", file.name, repeated));
  return chains_of_segments(segments, static_cast<Index>(positions_.size()));
}

CurveFile ObjCurveReader::take(InputFile file) {
  CurveFile curve;
  curve.format = CurveFormat::obj;
  curve.groups = groups_.take(elements_.face_begin(), elements_.corners(), static_cast<Index>(positions_.size()));
  std::vector<PolygonCurve::Chain> runs = chains(file);
  if (runs.empty()) file.refuse("its lines lead from nodes to themselves; choose an OBJ file of a curve");
  curve.warnings = take_warnings(file);
  const auto source = std::make_shared<ObjCurveSource>();
  source->rows = std::move(node_rows_);
  source->positions = positions_;
  source->carried.assign(carried_.begin(), carried_.end());
  source->file = std::move(file);
  curve.curve = PolygonCurve(std::move(positions_), std::move(runs));
  curve.source = source;
  return curve;
}

}  // namespace

CurveFile read_obj_curve(InputFile file) {
  ObjCurveReader reader(file);
  reader.read();
  reader.check();
  return reader.take(std::move(file));
}

}  // namespace vspring
