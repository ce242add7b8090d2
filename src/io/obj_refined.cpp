// OBJ of which some faces are divided.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/file_normals.hpp"
#include "io/obj_statements.hpp"
#include "io/rewriter.hpp"
#include "io/surface_formats.hpp"
#include "shape/corner_items.hpp"

namespace vspring {

namespace {

/// The rows of one keyword that faces refer to, and the numbers in them.
struct ObjRows {
  std::string keyword;
  std::vector<std::size_t> begin;
  std::vector<std::vector<double>> numbers;
  std::vector<Index> of_corner;  ///< −1 for none

  [[nodiscard]] Index count() const { return static_cast<Index>(begin.size()); }
};

/// The mean of rows, by mean(value) of the values of each: as many numbers as the shortest has.
template <typename Mean>
std::vector<double> mean_row(std::span<const Index> of, const std::vector<std::vector<double>>& rows,
                             const Mean& mean) {
  std::vector<double> numbers = rows[static_cast<std::size_t>(of.front())];
  for (const Index row : of) numbers.resize(std::min(numbers.size(), rows[static_cast<std::size_t>(row)].size()));
  for (std::size_t c = 0; c < numbers.size(); ++c)
    numbers[c] = mean([&](Index row) { return rows[static_cast<std::size_t>(row)][c]; });
  return numbers;
}

/// Finds the places of faces, and of the statements that they refer to, in the file.
class ObjPlaces : public ObjStatements {
 public:
  using ObjStatements::ObjStatements;

  struct Piece {
    std::size_t begin;
    std::size_t end;
  };
  std::vector<Piece> faces;  ///< from the keyword to the last corner
  std::array<ObjRows, 2> items = {ObjRows{"vt", {}, {}, {}}, ObjRows{"vn", {}, {}, {}}};
  std::vector<Piece> lines;  ///< other elements of nodes: `l` and `p`
  std::vector<std::vector<Index>> nodes_of_lines;
  bool counts_back = false;  ///< some statement numbers nodes from its place back

  [[nodiscard]] const std::vector<std::size_t>& node_rows() const { return node_rows_; }

 protected:
  bool read_element(std::string_view keyword) override;

 private:
  void read_face();
};

bool ObjPlaces::read_element(std::string_view keyword) {
  for (ObjRows& rows : items) {
    if (keyword != rows.keyword) continue;
    cursor_.skip_blanks();
    rows.begin.push_back(cursor_.offset());
    std::vector<double>& numbers = rows.numbers.emplace_back();
    for (; !cursor_.at_line_end() && cursor_.peek() != '#'; cursor_.skip_blanks())
      numbers.push_back(cursor_.number("a number"));
    return true;
  }
  if (keyword == "f") {
    read_face();
    return true;
  }
  if (keyword != "l" && keyword != "p") return false;
  Piece piece = {cursor_.offset() - 1, 0};
  std::vector<Index>& nodes = nodes_of_lines.emplace_back();
  for (cursor_.skip_blanks(); !cursor_.at_line_end() && cursor_.peek() != '#'; cursor_.skip_blanks()) {
    const std::size_t where = cursor_.offset();
    nodes.push_back(number_of(cursor_.integer("a node number"), node_rows_.size(), where, "node"));
    while (!cursor_.at_word_end()) cursor_.skip(1);
    piece.end = cursor_.offset();
    counts_back = counts_back || file_.bytes.substr(where, piece.end - where).find('-') != std::string::npos;
  }
  lines.push_back(piece);
  return true;
}

void ObjPlaces::read_face() {
  Piece piece = {cursor_.offset() - 1, 0};
  for (cursor_.skip_blanks(); !cursor_.at_line_end() && cursor_.peek() != '#'; cursor_.skip_blanks()) {
    std::array<Index, 2> refers_to = {-1, -1};
    const std::size_t where = cursor_.offset();
    read_node_number();
    for (std::size_t k = 0; k < 2 && cursor_.peek() == '/'; ++k) {
      cursor_.skip(1);
      if (cursor_.peek() != '/' && !cursor_.at_word_end())
        refers_to[k] = number_of(cursor_.integer("a number"), items[k].begin.size(), where, items[k].keyword.c_str());
    }
    piece.end = cursor_.offset();
    for (std::size_t k = 0; k < 2; ++k) items[k].of_corner.push_back(refers_to[k]);
    const std::string_view word = std::string_view(file_.bytes).substr(where, piece.end - where);
    counts_back = counts_back || word.find('-') != std::string_view::npos;
  }
  faces.push_back(piece);
  elements_.end_face();
}

/// Makes the rows and faces of a refined file.
class ObjRefiner {
 public:
  ObjRefiner(const InputFile& file, const PolygonMesh& mesh, const RefinedMesh& refined)
      : file_(file), mesh_(mesh), refined_(refined), places_(file), line_end_(line_ending(file.bytes)) {
    places_.read();
  }

  std::string bytes();

 private:
  struct Change {
    std::size_t begin;
    std::size_t end;
    std::string text;
  };
  /// New rows go behind the last of their kind, so that they stand above the faces; to the end of a file that numbers
  /// nodes backwards.
  void add_rows(std::size_t last_row, std::string rows);
  [[nodiscard]] std::string node_rows() const;
  [[nodiscard]] std::string item_rows(ObjRows& rows, const CornerItems& of) const;
  [[nodiscard]] std::string faces(const FaceParts& parts) const;
  void remove_nodes();
  void renumber_lines();

  const InputFile& file_;
  const PolygonMesh& mesh_;
  const RefinedMesh& refined_;
  ObjPlaces places_;
  std::string_view line_end_;
  std::array<CornerItems, 2> items_;
  std::vector<Change> changes_;
};

void ObjRefiner::add_rows(std::size_t last_row, std::string rows) {
  if (rows.empty()) return;
  const std::size_t place = places_.counts_back ? file_.bytes.size() : behind_line(file_.bytes, last_row);
  if (place == file_.bytes.size() && (changes_.empty() || changes_.back().begin != place))
    rows.insert(0, missing_line_end(file_.bytes));
  changes_.push_back({place, place, std::move(rows)});
}

/// Colours and weights behind coordinates are means, too.
std::string ObjRefiner::node_rows() const {
  std::vector<std::vector<double>> more;
  for (const std::size_t row : places_.node_rows()) {
    std::vector<double> numbers;
    const std::string words(behind_words(file_.bytes, row, 3));
    const InputFile rest = {file_.name, words};
    TextCursor cursor(rest);
    for (cursor.skip_space(); !cursor.at_end(); cursor.skip_space()) numbers.push_back(cursor.number("a number"));
    more.push_back(std::move(numbers));
  }
  std::string text;
  for (Index node = refined_.kept_node_count(); node < refined_.mesh.node_count(); ++node) {
    text += "v ";
    append_numbers(text, refined_.mesh.position(node));
    more.push_back(mean_row(refined_.means(node), more, [&](const auto& value) { return refined_.mean(node, value); }));
    for (const double number : more.back()) append_number(text += ' ', number);
    text += line_end_;
  }
  return text;
}

std::string ObjRefiner::item_rows(ObjRows& rows, const CornerItems& of) const {
  std::string text;
  for (std::size_t k = 0; k < of.new_count(); ++k) {
    std::vector<double> numbers =
        mean_row(of.means(k), rows.numbers, [&](const auto& value) { return of.mean(k, value); });
    if (rows.keyword == "vn" && numbers.size() == 3) {
      const Vector3 normal = unit_or_zero({numbers[0], numbers[1], numbers[2]});
      numbers.assign(normal.data(), normal.data() + 3);
    }
    text += rows.keyword;
    for (const double number : numbers) append_number(text += ' ', number);
    text += line_end_;
    rows.numbers.push_back(std::move(numbers));
  }
  return text;
}

std::string ObjRefiner::faces(const FaceParts& parts) const {
  std::string text;
  for (Index f = parts.begin; f < parts.end; ++f) {
    if (f > parts.begin) text += line_end_;
    text += 'f';
    const auto face = refined_.mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k) {
      append_whole(text += ' ', static_cast<std::size_t>(face[k]) + 1);
      const auto corner = static_cast<std::size_t>(refined_.mesh.face_begin(f)) + k;
      const Index vt = items_[0].items[corner];
      const Index vn = items_[1].items[corner];
      if (vt >= 0) append_whole(text += '/', static_cast<std::size_t>(vt) + 1);
      if (vn >= 0) append_whole(text += vt >= 0 ? "/" : "//", static_cast<std::size_t>(vn) + 1);
    }
  }
  return text;
}

void ObjRefiner::remove_nodes() {
  for (const Index node : refined_.removed) {
    const std::size_t row = places_.node_rows()[static_cast<std::size_t>(node)];
    const std::size_t before = file_.bytes.find_last_of("\r\n", row);
    changes_.push_back({before == std::string::npos ? 0 : before + 1, behind_line(file_.bytes, row), ""});
  }
}

/// Lines and points with a node that is gone are left out.
void ObjRefiner::renumber_lines() {
  std::vector<Index> number(mesh_.positions().size(), -1);
  const std::vector<Index> before = refined_.numbers_in_means();
  for (Index node = 0; node < refined_.kept_node_count(); ++node)
    number[static_cast<std::size_t>(before[static_cast<std::size_t>(node)])] = node;
  for (std::size_t k = 0; k < places_.lines.size(); ++k) {
    const auto& [begin, end] = places_.lines[k];
    std::string text(1, file_.bytes[begin]);
    for (const Index node : places_.nodes_of_lines[k]) {
      const Index now = number[static_cast<std::size_t>(node)];
      if (now < 0) {
        text.clear();
        break;
      }
      append_whole(text += ' ', static_cast<std::size_t>(now) + 1);
    }
    changes_.push_back({begin, end, std::move(text)});
  }
}

std::string ObjRefiner::bytes() {
  if (!refined_.removed.empty()) {
    remove_nodes();
    renumber_lines();
  }
  add_rows(places_.node_rows().back(), node_rows());
  for (std::size_t k = 0; k < items_.size(); ++k) {
    ObjRows& rows = places_.items[k];
    items_[k] = refined_items(mesh_, refined_, rows.of_corner, rows.count());
    if (items_[k].new_count() > 0) add_rows(rows.begin.back(), item_rows(rows, items_[k]));
  }
  const std::vector<FaceParts> parts = parts_of_faces(mesh_, refined_);
  for (std::size_t f = 0; f < parts.size(); ++f) {
    const bool is_gone = parts[f].begin == parts[f].end;
    const bool counts_anew = !refined_.removed.empty() && places_.counts_back;
    if (parts[f].is_divided || parts[f].is_renumbered || counts_anew)
      changes_.push_back({places_.faces[f].begin,
                          is_gone ? behind_line(file_.bytes, places_.faces[f].begin) : places_.faces[f].end,
                          faces(parts[f])});
  }
  // New rows before what changes at their place.
  std::stable_sort(changes_.begin(), changes_.end(), [](const Change& a, const Change& b) {
    return a.begin != b.begin ? a.begin < b.begin : a.end < b.end;
  });
  TextRewriter out(file_.bytes);
  for (const Change& change : changes_) out.replace(change.begin, change.end, change.text);
  return out.finish();
}

}  // namespace

std::string left_out_by_refined_obj(const InputFile& file, const PolygonMesh& mesh, const RefinedMesh& refined) {
  if (!refined.is_remeshed()) return {};
  ObjPlaces places(file);
  places.read();
  std::vector<std::string> what;
  for (const ObjRows& rows : places.items) {
    if (refined_items(mesh, refined, rows.of_corner, rows.count()).left_out) what.push_back(rows.keyword);
  }
  if (what.empty()) return {};
  return fmt::format("{}: new triangles have no {}, because it has a seam there", file.name,
                     what.size() == 2 ? "vt and no vn" : what.front());
}

SurfaceFile refined_obj(const InputFile& file, const PolygonMesh& mesh, const RefinedMesh& refined) {
  return read_obj({file.name, ObjRefiner(file, mesh, refined).bytes()});
}

}  // namespace vspring
