// Object File Format (Geomview), with normals, colours and texture coordinates at the nodes: one line per node.
#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <utility>

#include "io/face_list.hpp"
#include "io/file_normals.hpp"
#include "io/off_source.hpp"
#include "io/text_cursor.hpp"
#include "vspring/error.hpp"

namespace vspring {
namespace {

struct OffHeader {
  bool normals = false;
  bool colours = false;
  bool textures = false;
  bool colours_first = false;  ///< NCOFF as MeshLab writes it has them before the normals, CNOFF behind
  std::int64_t nodes = 0;
  std::int64_t faces = 0;
};

class OffReader {
 public:
  explicit OffReader(const InputFile& file) : file_(file), cursor_(file) {}

  void read();
  SurfaceFile take(InputFile file);

 private:
  void skip_to_word();
  void read_keyword();
  std::int64_t count(const char* what);
  void read_counts();
  void read_nodes();
  int count_words() const;
  void set_columns(int words);
  void read_faces();

  const InputFile& file_;
  TextCursor cursor_;
  OffHeader header_;
  std::shared_ptr<OffSource> source_ = std::make_shared<OffSource>();
  std::vector<Vector3> positions_;
  std::vector<Vector3> normals_;
  FaceList faces_;
  std::set<std::string> carried_;
};

/// To the next word that is not in a comment.
void OffReader::skip_to_word() {
  for (cursor_.skip_space(); cursor_.peek() == '#'; cursor_.skip_space()) {
    carried_.insert("comments");
    cursor_.skip_comment();
  }
}

void OffReader::read_keyword() {
  skip_to_word();
  const std::size_t begin = cursor_.offset();
  TextCursor ahead = cursor_;
  const std::string_view word = ahead.word();
  const std::size_t end = word.find("OFF");
  // Without the keyword the counts come first.
  if (end == std::string_view::npos) return;
  std::string_view letters = word.substr(0, end);
  const auto take = [&](std::string_view prefix) {
    if (!letters.starts_with(prefix)) return false;
    letters.remove_prefix(prefix.size());
    return true;
  };
  while (!letters.empty()) {
    if (take("ST")) {
      header_.textures = true;
    } else if (take("C")) {
      header_.colours = true;
      header_.colours_first = header_.normals;
    } else if (take("N")) {
      header_.normals = true;
    } else if (take("4") || take("n")) {
      cursor_.refuse(
          fmt::format("{} has nodes in another space than three dimensions; convert it to OFF", in_quotes(word)));
    } else {
      cursor_.refuse(fmt::format("{} is not a kind of OFF; correct the first line", in_quotes(word)));
    }
  }
  // Some files have the counts right behind the keyword, without a blank.
  cursor_.skip(end + 3);
  if (!cursor_.at_word_end() && !(cursor_.peek() >= '0' && cursor_.peek() <= '9'))
    file_.refuse_line(begin, fmt::format("{} is not a kind of OFF; correct the first line", in_quotes(word)));
  cursor_.skip_blanks();
  ahead = cursor_;
  if (ahead.word() == "BINARY") cursor_.refuse("binary OFF is not read; convert it to text or to PLY");
}

std::int64_t OffReader::count(const char* what) {
  skip_to_word();
  const std::size_t where = cursor_.offset();
  const std::int64_t number = cursor_.whole_word(what);
  if (number < 0) file_.refuse_line(where, fmt::format("{} stands where {} belongs; correct it", number, what));
  return number;
}

void OffReader::read_counts() {
  header_.nodes = count("the number of nodes");
  header_.faces = count("the number of faces");
  cursor_.skip_blanks();
  if (!cursor_.at_line_end() && cursor_.peek() != '#') static_cast<void>(count("the number of edges"));
  cursor_.skip_blanks();
  if (cursor_.peek() == '#') {
    carried_.insert("comments");
    cursor_.skip_comment();
  }
  if (!cursor_.at_line_end()) cursor_.refuse_word("the end of the line");
  if (header_.nodes == 0) file_.refuse("it has no nodes; choose the file of a surface");
  // A node takes three digits and three blanks, a face two of each; the last blank may be missing.
  const auto left = static_cast<std::int64_t>(cursor_.bytes_left()) + 1;
  if (header_.nodes > most_nodes || header_.nodes > left / 6)
    cursor_.refuse(
        fmt::format("{} nodes are promised, but the file is too short for them; correct the count or restore "
                    "what is missing",
                    header_.nodes));
  if (header_.faces > most_nodes || header_.faces > left / 4)
    cursor_.refuse(
        fmt::format("{} faces are promised, but the file is too short for them; correct the count or restore "
                    "what is missing",
                    header_.faces));
}

/// Words from here to the end of the line or to a comment.
int OffReader::count_words() const {
  TextCursor ahead = cursor_;
  int words = 0;
  for (; !ahead.at_line_end() && ahead.peek() != '#'; ahead.skip_blanks(), ++words) static_cast<void>(ahead.word());
  return words;
}

void OffReader::set_columns(int words) {
  const int wanted = 3 + (header_.normals ? 3 : 0) + (header_.colours ? 1 : 0) + (header_.textures ? 2 : 0);
  if (words < wanted)
    cursor_.refuse(fmt::format("a node needs {} numbers, this line has {}; correct it", wanted, words));
  if (header_.normals) source_->normal_column = header_.colours_first ? words - 3 - (header_.textures ? 2 : 0) : 3;
  if (header_.textures) carried_.insert("texture coordinates");
  // Many files give colours without saying so in the first line.
  if (header_.colours || words > wanted) carried_.insert("colours");
}

void OffReader::read_nodes() {
  positions_.reserve(static_cast<std::size_t>(header_.nodes));
  source_->rows.reserve(static_cast<std::size_t>(header_.nodes));
  int words = 0;
  for (std::int64_t node = 0; node < header_.nodes; ++node) {
    skip_to_word();
    if (cursor_.at_end())
      cursor_.refuse(fmt::format("the file ends after {} of {} nodes; it is cut off", node, header_.nodes));
    source_->rows.push_back(cursor_.offset());
    if (node == 0) set_columns(words = count_words());
    Vector3 position = Vector3::Zero();
    Vector3 normal = Vector3::Zero();
    int column = 0;
    for (; !cursor_.at_line_end() && cursor_.peek() != '#'; cursor_.skip_blanks(), ++column) {
      const double value = cursor_.number(column < 3 ? "a coordinate" : "a number");
      if (column < 3) position[column] = value;
      const int component = column - source_->normal_column;
      if (source_->normal_column > 0 && component >= 0 && component < 3) normal[component] = value;
    }
    // A file with several nodes on a line, or with too few, would be misread from here on without a word.
    if (column != words)
      cursor_.refuse(
          fmt::format("node {} has {} numbers, those before it have {}; correct the line or the number of nodes", node,
                      column, words));
    positions_.push_back(position);
    if (header_.normals) normals_.push_back(unit_or_zero(normal));
  }
}

void OffReader::read_faces() {
  faces_.reserve(static_cast<std::size_t>(header_.faces), static_cast<std::size_t>(header_.faces) * 3);
  for (std::int64_t face = 0; face < header_.faces; ++face) {
    skip_to_word();
    if (cursor_.at_end())
      cursor_.refuse(fmt::format("the file ends after {} of {} faces; it is cut off", face, header_.faces));
    const std::int64_t corners = cursor_.whole_word("the number of nodes of a face");
    if (corners < 1) cursor_.refuse(fmt::format("face {} has {} nodes; correct it", face, corners));
    if (faces_.full()) cursor_.refuse("too many faces; split the file");
    for (std::int64_t k = 0; k < corners; ++k) {
      cursor_.skip_blanks();
      const std::size_t where = cursor_.offset();
      const std::int64_t node = cursor_.whole_word("the number of a node");
      if (node < 0 || node >= header_.nodes)
        file_.refuse_line(where, fmt::format("node {} does not exist, nodes go from 0 to {}; correct the face", node,
                                             header_.nodes - 1));
      faces_.add_corner(node, where);
    }
    faces_.end_face();
    cursor_.skip_blanks();
    if (!cursor_.at_line_end() && cursor_.peek() != '#') {
      carried_.insert("colours");
      cursor_.skip_comment();
    }
  }
  skip_to_word();
  if (!cursor_.at_end())
    cursor_.refuse(fmt::format(
        "the file goes on after its {} faces; correct the number of nodes or faces in its header", header_.faces));
}

void OffReader::read() {
  read_keyword();
  read_counts();
  read_nodes();
  read_faces();
}

SurfaceFile OffReader::take(InputFile file) {
  SurfaceFile surface;
  surface.format = SurfaceFormat::off;
  surface.normals = std::move(normals_);
  source_->positions = positions_;
  source_->corner_count = faces_.corner_count();
  source_->carried.assign(carried_.begin(), carried_.end());
  surface.mesh = faces_.take(std::move(positions_));
  source_->file = std::move(file);
  surface.source = std::move(source_);
  return surface;
}

}  // namespace

SurfaceFile read_off(InputFile file) {
  OffReader reader(file);
  reader.read();
  return reader.take(std::move(file));
}

}  // namespace vspring
