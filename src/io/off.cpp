// Object File Format (Geomview), with normals, colours and texture coordinates at the nodes. By definition it is a
// stream of words in which line ends mean nothing. But nearly all files have a line for each node and face, and many
// end lines with colours that the keyword does not announce. So the file is read by lines if they fit, else as a
// stream.
#include "io/off.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "io/face_list.hpp"
#include "io/file_normals.hpp"
#include "vspring/error.hpp"

namespace vspring {
namespace {

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

}  // namespace vspring
