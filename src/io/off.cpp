// Object File Format (Geomview), with normals, colours and texture coordinates at the nodes. By definition it is a
// stream of words in which line ends mean nothing. But nearly all files have a line for each node and face, and many
// end lines with colours that the keyword does not announce. So the file is read by lines if they fit, else as a
// stream.
#include "io/off.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/face_list.hpp"
#include "io/file_normals.hpp"
#include "io/rewriter.hpp"
#include "io/surface_formats.hpp"
#include "shape/corner_items.hpp"
#include "vspring/error.hpp"

namespace vspring {
namespace {

/// An OFF file: where its nodes are. Throws Error(unusable_file) if the file is read as a stream and new numbers would
/// make it readable by lines.
class OffSource : public SurfaceSource {
 public:
  [[nodiscard]] std::string rewritten(Rewrite& rewrite) const override;
  [[nodiscard]] SurfaceFile refined(const RefinedMesh& refined) const override;

  std::vector<std::size_t> rows;  ///< offset of the first coordinate of each node
  bool in_stream = false;         ///< read as a stream: nodes may begin anywhere
  int normal_column = 0;          ///< of the normal's first component among the words of a node; 0: no normals
  std::size_t nodes_begin = 0;    ///< where the numbers of nodes and of faces stand
  std::size_t faces_begin = 0;

 private:
  [[nodiscard]] std::string added_nodes(const Rewrite& rewrite) const;
  /// The whole number that stands at `begin` becomes another one.
  void replace_count(TextRewriter& out, std::size_t begin, Index count) const;
  [[nodiscard]] std::string new_nodes(const RefinedMesh& refined) const;
  void divide_faces(TextRewriter& out, const RefinedMesh& refined) const;
};

enum class NodeLayout {
  by_line,
  in_stream,
  in_stream_behind_edges  ///< the number of edges stands on a line after that of faces
};

/// Tries interpretations of the same words; the first one that fits is taken.
class OffInterpretations {
 public:
  /// read(progress) may throw, and counts what it has read.
  template <typename Read>
  bool fits(const Read& read) {
    std::int64_t progress = 0;
    try {
      read(progress);
      return true;
    } catch (const Error& error) {
      if (!fault_ || progress > furthest_) fault_.emplace(error);
      furthest_ = std::max(furthest_, progress);
      return false;
    }
  }
  [[nodiscard]] std::int64_t furthest() const { return furthest_; }
  /// Throws the fault of the reading that came furthest.
  [[noreturn]] void refuse() const { throw *fault_; }

 private:
  std::optional<Error> fault_;
  std::int64_t furthest_ = -1;
};

/// The part of the file after the counts.
class OffBody {
 public:
  OffBody(const OffHeader& header, const OffCursor& cursor) : header_(header), cursor_(cursor) {}

  /// progress: nodes and faces that were read.
  void read(NodeLayout layout, std::int64_t& progress);
  SurfaceFile take(InputFile file);

 private:
  void require_node(std::int64_t node);
  void set_columns(int words);
  void read_node_lines();
  void read_node_stream();
  void add_node(std::size_t row, const std::array<Vector3, 2>& position_and_normal);
  void read_faces(bool by_line, std::int64_t& count);
  void read_corners(std::int64_t count, std::optional<OffCursor>& broken);

  OffHeader header_;
  OffCursor cursor_;
  std::vector<std::size_t> rows_;
  int normal_column_ = 0;
  std::vector<Vector3> positions_;
  std::vector<Vector3> normals_;
  FaceList faces_;
  bool in_stream_ = false;
  bool coloured_ = false;
};

void OffBody::require_node(std::int64_t node) {
  cursor_.skip_to_word();
  if (cursor_.at_end())
    cursor_.refuse(fmt::format("the file ends after {} of {} nodes; it is cut off", node, header_.nodes));
}

void OffBody::add_node(std::size_t row, const std::array<Vector3, 2>& position_and_normal) {
  rows_.push_back(row);
  positions_.push_back(position_and_normal[0]);
  if (header_.normals) normals_.push_back(unit_or_zero(position_and_normal[1]));
}

void OffBody::set_columns(int words) {
  const int wanted = 3 + (header_.normals ? 3 : 0) + (header_.colours ? 1 : 0) + (header_.textures ? 2 : 0);
  if (words < wanted)
    cursor_.refuse(fmt::format("a node needs {} numbers, this line has {}; correct it", wanted, words));
  if (header_.normals) normal_column_ = header_.colours_first ? words - 3 - (header_.textures ? 2 : 0) : 3;
  // Many files give colours without saying so in the first line.
  coloured_ = header_.colours || words > wanted;
}

void OffBody::read_node_lines() {
  int words = 0;
  for (std::int64_t node = 0; node < header_.nodes; ++node) {
    require_node(node);
    const std::size_t row = cursor_.offset();
    if (node == 0) set_columns(words = cursor_.count_words());
    std::array<Vector3, 2> vectors = {Vector3::Zero(), Vector3::Zero()};
    int column = 0;
    for (; !cursor_.skip_to_row_end(); ++column) {
      const double value = cursor_.number(column < 3 ? "a coordinate" : "a number");
      if (column < 3) vectors[0][column] = value;
      const int component = column - normal_column_;
      if (normal_column_ > 0 && component >= 0 && component < 3) vectors[1][component] = value;
    }
    // A line with a number too many or too few would silently shift all that follow.
    if (column != words)
      cursor_.refuse(
          fmt::format("node {} has {} numbers, those before it have {}; correct the line or the number of nodes", node,
                      column, words));
    add_node(row, vectors);
  }
}

void OffBody::read_node_stream() {
  constexpr int words_of_colour = 4;
  const int colours = header_.colours ? words_of_colour : 0;
  const int words = 3 + (header_.normals ? 3 : 0) + colours + (header_.textures ? 2 : 0);
  if (header_.normals) normal_column_ = header_.colours_first ? 3 + colours : 3;
  coloured_ = header_.colours;
  for (std::int64_t node = 0; node < header_.nodes; ++node) {
    require_node(node);
    const std::size_t row = cursor_.offset();
    std::array<Vector3, 2> vectors = {Vector3::Zero(), Vector3::Zero()};
    for (int column = 0; column < words; ++column) {
      cursor_.skip_to_word();
      const double value = cursor_.number(column < 3 ? "a coordinate" : "a number");
      if (column < 3) vectors[0][column] = value;
      const int component = column - normal_column_;
      if (normal_column_ > 0 && component >= 0 && component < 3) vectors[1][component] = value;
    }
    add_node(row, vectors);
  }
}

/// broken: gets the end of the first line after which the corners of a face go on.
void OffBody::read_corners(std::int64_t count, std::optional<OffCursor>& broken) {
  const char* const what = "the number of a node";
  for (std::int64_t k = 0; k < count; ++k) {
    if (cursor_.skip_to_row_end()) {
      const OffCursor line_end = cursor_;
      cursor_.skip_to_word();
      if (cursor_.at_end()) line_end.refuse_word(what);
      if (!broken) broken = line_end;
    }
    const std::size_t where = cursor_.offset();
    const std::int64_t node = cursor_.whole_word(what);
    if (node < 0 || node >= header_.nodes)
      cursor_.file().refuse_line(
          where,
          fmt::format(
              "node {} does not exist, nodes go from 0 to {}; correct the face{}", node, header_.nodes - 1,
              broken ? fmt::format(", which goes on from line {}", cursor_.file().line_of(broken->offset())) : ""));
    faces_.add_corner(node, where);
  }
}

/// by_line: words after a face on its last line are colours; else they are the next face.
void OffBody::read_faces(bool by_line, std::int64_t& count) {
  faces_ = {};
  faces_.reserve(static_cast<std::size_t>(header_.faces), static_cast<std::size_t>(header_.faces) * 3);
  // If a line ends inside a face by mistake, the next line has more words than its face takes.
  std::optional<OffCursor> cut_off;
  for (count = 0; count < header_.faces; ++count) {
    cursor_.skip_to_word();
    if (cursor_.at_end()) {
      if (cut_off) cut_off->refuse_word("the number of a node");
      cursor_.refuse(fmt::format("the file ends after {} of {} faces; it is cut off", count, header_.faces));
    }
    const std::int64_t corners = cursor_.whole_word("the number of nodes of a face");
    if (corners < 1) cursor_.refuse(fmt::format("face {} has {} nodes; correct it", count, corners));
    if (faces_.full()) cursor_.refuse("too many faces; split the file");
    std::optional<OffCursor> broken;
    read_corners(corners, broken);
    faces_.end_face();
    if (!by_line || cursor_.skip_to_row_end()) continue;
    coloured_ = true;
    if (!cut_off) cut_off = broken;
    cursor_.skip_comment();
  }
  cursor_.skip_to_word();
  if (!cursor_.at_end())
    cursor_.refuse(fmt::format(
        "the file goes on after its {} faces; correct the number of nodes or faces in its header", header_.faces));
}

void OffBody::read(NodeLayout layout, std::int64_t& progress) {
  positions_.reserve(static_cast<std::size_t>(header_.nodes));
  rows_.reserve(static_cast<std::size_t>(header_.nodes));
  // A line of another length is the fault, unless the stream gets to the second half of the faces.
  if (layout == NodeLayout::by_line) progress = header_.nodes + header_.faces / 2;
  if (layout == NodeLayout::in_stream_behind_edges) static_cast<void>(cursor_.count("the number of edges"));
  in_stream_ = layout != NodeLayout::by_line;
  if (in_stream_)
    read_node_stream();
  else
    read_node_lines();
  const OffCursor behind_nodes = cursor_;
  const bool coloured_nodes = coloured_;
  OffInterpretations readings;
  for (const bool by_line : {true, false}) {
    cursor_ = behind_nodes;
    coloured_ = coloured_nodes;
    if (readings.fits([&](std::int64_t& faces) { read_faces(by_line, faces); })) return;
  }
  progress = header_.nodes + readings.furthest();
  readings.refuse();
}

SurfaceFile OffBody::take(InputFile file) {
  std::set<std::string> carried;
  if (cursor_.saw_comments()) carried.insert("comments");
  if (header_.textures) carried.insert("texture coordinates");
  if (coloured_) carried.insert("colours");
  SurfaceFile surface;
  surface.format = SurfaceFormat::off;
  surface.normals = std::move(normals_);
  const auto source = std::make_shared<OffSource>();
  source->rows = std::move(rows_);
  source->in_stream = in_stream_;
  source->normal_column = normal_column_;
  source->nodes_begin = header_.nodes_begin;
  source->faces_begin = header_.faces_begin;
  source->carried.assign(carried.begin(), carried.end());
  surface.mesh = source->mesh = faces_.take(std::move(positions_));
  source->file = std::move(file);
  surface.source = source;
  return surface;
}

/// Bit by bit, as a coordinate may be NaN: nodes that do not move keep it.
bool same_places(const std::vector<Vector3>& some, const std::vector<Vector3>& others) {
  return std::equal(some.begin(), some.end(), others.begin(), others.end(), [](const Vector3& a, const Vector3& b) {
    return ((a.array() == b.array()) || (a.array().isNaN() && b.array().isNaN())).all();
  });
}

bool reads_as(const std::string& text, const PolygonMesh& mesh, const Rewrite& rewrite) {
  std::vector<Vector3> expected = mesh.positions();
  for (std::size_t node = 0; node < expected.size(); ++node)
    if (rewrite.moved[node] != 0) expected[node] = rewrite.positions[node];
  try {
    const PolygonMesh read = read_off({"", text}).mesh;
    return same_places(read.positions(), expected) && read.has_same_faces(mesh);
  } catch (const Error&) {
    return false;
  }
}

std::string OffSource::rewritten(Rewrite& rewrite) const {
  const SurfaceFile& surface = rewrite.surface;
  NewNormals fresh;
  if (normal_column > 0 && surface.normals.size() == rows.size())
    fresh = compute_normals(mesh, mesh.corners(), surface.normals, mesh.positions(), rewrite.positions, rewrite.moved);
  const bool is_longer = !surface.added.face_like.empty();
  if (is_longer && in_stream)
    file.refuse(
        "its lines do not say where nodes end, so that none can be added; write it in another format, such as "
        "PLY");
  TextRewriter out(file.bytes, /*commented=*/true);
  if (is_longer) {
    replace_count(out, nodes_begin, surface.mesh.node_count());
    replace_count(out, faces_begin, surface.mesh.face_count());
  }
  std::vector<NewNumber> numbers;
  for (std::size_t node = 0; node < rows.size(); ++node) {
    numbers.clear();
    if (rewrite.moved[node] != 0) {
      for (int k = 0; k < 3; ++k) numbers.push_back({k, rewrite.positions[node][k]});
    }
    if (!fresh.due.empty() && fresh.due[node] != 0) {
      for (int k = 0; k < 3; ++k) numbers.push_back({normal_column + k, fresh.normals[node][k]});
    }
    if (!numbers.empty()) out.replace_words(rows[node], numbers);
  }
  if (is_longer) {
    const std::size_t end = std::min(file.bytes.find_first_of("\r\n", rows.back()), file.bytes.size());
    out.replace(end, end, added_nodes(rewrite));
  }
  std::string text = out.finish();
  if (is_longer) {
    text += missing_line_end(text);
    for (Index f = mesh.face_count(); f < surface.mesh.face_count(); ++f) {
      const auto face = surface.mesh.face(f);
      append_whole(text, face.size());
      for (const Index node : face) append_whole(text += ' ', static_cast<std::size_t>(node));
      text += line_ending(file.bytes);
    }
  }
  if (in_stream && !reads_as(text, surface.mesh, rewrite))
    file.refuse(
        "with other coordinates its lines and numbers could be read in another way; write it in another format, such "
        "as "
        "PLY");
  return text;
}

void OffSource::replace_count(TextRewriter& out, std::size_t begin, Index count) const {
  const std::size_t digits = file.bytes.find_first_not_of("+0123456789", begin);
  out.replace(begin, std::min(digits, file.bytes.size()), std::to_string(count));
}

SurfaceFile OffSource::refined(const RefinedMesh& refined) const {
  if (in_stream)
    file.refuse("its lines do not say where nodes end, so that none can be added; convert it to PLY first");
  TextRewriter out(file.bytes);
  replace_count(out, nodes_begin, refined.mesh.node_count());
  replace_count(out, faces_begin, refined.mesh.face_count());
  const std::size_t end = std::min(file.bytes.find_first_of("\r\n", rows.back()), file.bytes.size());
  out.replace(end, end, new_nodes(refined));
  divide_faces(out, refined);
  return read_off({file.name, out.finish()});
}

/// Lines, each preceded by a line end. Whole numbers behind the coordinates, such as shares of colours, stay whole.
std::string OffSource::new_nodes(const RefinedMesh& refined) const {
  std::vector<std::vector<double>> more;
  std::vector<std::uint8_t> is_whole;  // per number of a row
  for (const std::size_t row : rows) {
    const InputFile rest = {file.name, std::string(behind_words(file.bytes, row, 3))};
    std::vector<double> numbers;
    TextCursor cursor(rest);
    for (cursor.skip_space(); !cursor.at_end(); cursor.skip_space()) {
      const std::size_t begin = cursor.offset();
      numbers.push_back(cursor.number("a number"));
      is_whole.resize(std::max(is_whole.size(), numbers.size()), 1);
      if (rest.bytes.find_first_of(".eE", begin) < cursor.offset()) is_whole[numbers.size() - 1] = 0;
    }
    more.push_back(std::move(numbers));
  }
  std::string text;
  for (Index node = refined.input_node_count(); node < refined.mesh.node_count(); ++node) {
    append_numbers(text += line_ending(file.bytes), refined.mesh.position(node));
    const auto of = refined.means(node);
    std::vector<double> numbers(more.front().size(), 0);
    for (const Index other : of) {
      for (std::size_t c = 0; c < numbers.size(); ++c) numbers[c] += more[static_cast<std::size_t>(other)][c];
    }
    for (double& number : numbers) number /= static_cast<double>(of.size());
    if (normal_column >= 3) {
      double* const normal = numbers.data() + normal_column - 3;
      const Vector3 unit = unit_or_zero({normal[0], normal[1], normal[2]});
      std::copy(unit.begin(), unit.end(), normal);
      std::fill_n(is_whole.begin() + normal_column - 3, 3, std::uint8_t{0});
    }
    for (std::size_t c = 0; c < numbers.size(); ++c)
      append_number(text += ' ', is_whole[c] != 0 ? std::round(numbers[c]) : numbers[c]);
    more.push_back(std::move(numbers));
  }
  return text;
}

void OffSource::divide_faces(TextRewriter& out, const RefinedMesh& refined) const {
  OffCursor cursor(file);
  cursor.skip(rows.back());
  cursor.skip_comment();
  const std::vector<FaceParts> all_parts = parts_of_faces(mesh, refined);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    cursor.skip_to_word();
    const std::size_t begin = cursor.offset();
    std::size_t end = begin;
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k <= face.size(); ++k) {
      const auto expected = k == 0 ? static_cast<std::int64_t>(face.size()) : std::int64_t{face[k - 1]};
      if (cursor.skip_to_row_end() || cursor.whole_word("a number") != expected)
        file.refuse("it has no line for each face, so that none can be divided; convert it to PLY first");
      end = cursor.offset();
    }
    cursor.skip_comment();
    const FaceParts& parts = all_parts[static_cast<std::size_t>(f)];
    if (!parts.is_divided) continue;
    const std::string_view colour = behind_words(file.bytes, end, 0);
    std::string text;
    for (Index part = parts.begin; part < parts.end; ++part) {
      const auto corners = refined.mesh.face(part);
      append_whole(text, corners.size());
      for (const Index node : corners) append_whole(text += ' ', static_cast<std::size_t>(node));
      if (part + 1 == parts.end) break;
      if (!colour.empty()) (text += ' ') += colour;
      text += line_ending(file.bytes);
    }
    out.replace(begin, end, text);
  }
}

/// Lines, each preceded by a line end.
std::string OffSource::added_nodes(const Rewrite& rewrite) const {
  const SurfaceFile& surface = rewrite.surface;
  const std::vector<Index>& like = surface.added.node_like;
  std::vector<Vector3> normals;
  if (normal_column > 0 && surface.normals.size() == rows.size())
    normals = normals_of_added(surface.mesh, surface.normals, rewrite.positions, like);
  std::string text;
  for (std::size_t k = 0; k < like.size(); ++k) {
    std::string row = "0 0 0 ";
    row += behind_words(file.bytes, rows[static_cast<std::size_t>(like[k])], 3);
    while (row.back() == ' ') row.pop_back();
    TextRewriter out(row);
    const auto place = row_of(rewrite.positions[rows.size() + k]);
    std::vector<NewNumber> numbers(place.begin(), place.end());
    for (int c = 0; c < 3 && !normals.empty(); ++c) numbers.push_back({normal_column + c, normals[k][c]});
    out.replace_words(0, numbers);
    (text += line_ending(file.bytes)) += out.finish();
  }
  return text;
}

}  // namespace

SurfaceFile read_off(InputFile file) {
  OffCursor cursor(file);
  const OffHeader header = read_off_header(cursor);
  std::vector<NodeLayout> layouts;
  if (cursor.skip_to_row_end()) layouts.push_back(NodeLayout::by_line);
  if (!header.edges) layouts.push_back(NodeLayout::in_stream_behind_edges);
  layouts.push_back(NodeLayout::in_stream);
  OffInterpretations readings;
  for (const NodeLayout layout : layouts) {
    OffBody body(header, cursor);
    if (readings.fits([&](std::int64_t& progress) { body.read(layout, progress); })) return body.take(std::move(file));
  }
  readings.refuse();
}

std::string fresh_off(const PolygonMesh& mesh, std::span<const Vector3> positions, std::span<const Vector3> normals) {
  std::string text = fmt::format("{}OFF\n{} {} 0\n", normals.empty() ? "" : "N", positions.size(), mesh.face_count());
  text.reserve(60 * (positions.size() + normals.size()) + 10 * mesh.corners().size());
  for (std::size_t node = 0; node < positions.size(); ++node) {
    append_numbers(text, positions[node]);
    if (!normals.empty()) {
      text += ' ';
      append_numbers(text, normals[node]);
    }
    text += '\n';
  }
  for (Index f = 0; f < mesh.face_count(); ++f) {
    append_whole(text, mesh.face(f).size());
    for (const Index node : mesh.face(f)) {
      text += ' ';
      append_whole(text, static_cast<std::size_t>(node));
    }
    text += '\n';
  }
  return text;
}

}  // namespace vspring
