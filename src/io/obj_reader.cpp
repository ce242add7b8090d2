// Wavefront OBJ: nodes, normals, faces and groups are understood; every other statement is kept as it stands.
#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "io/face_list.hpp"
#include "io/file_normals.hpp"
#include "io/obj_groups.hpp"
#include "io/obj_source.hpp"
#include "io/text_cursor.hpp"
#include "vspring/error.hpp"

namespace vspring {
namespace {

class ObjReader {
 public:
  explicit ObjReader(const InputFile& file) : file_(file), cursor_(file, 0, true) {}

  void read_statements();
  /// Hands over what was read; file becomes the source's.
  SurfaceFile take(InputFile file);

 private:
  void read_statement(std::string_view keyword);
  void read_node();
  void read_normal();
  void read_face();
  void read_groups();
  void read_object();
  void read_other(std::string_view keyword, std::size_t where);
  void skip_rest_of_numbers(int already);
  Index node_number(std::int64_t number, std::size_t count, std::size_t where, const char* kind);
  void check_numbers() const;
  bool normals_differ_at_a_node() const;

  const InputFile& file_;
  TextCursor cursor_;
  std::vector<Vector3> positions_;
  std::shared_ptr<ObjSource> source_ = std::make_shared<ObjSource>();
  FaceList faces_;
  ObjGroups groups_;
  std::int64_t highest_normal_ = -1;
  std::size_t highest_normal_where_ = 0;
  std::set<std::string> carried_;
  std::vector<std::string> warnings_;
  std::size_t unknown_count_ = 0;
  std::size_t unknown_where_ = 0;
  std::string unknown_word_;
};

void ObjReader::read_statements() {
  for (cursor_.skip_space(); !cursor_.at_end(); cursor_.skip_space()) {
    const std::size_t where = cursor_.offset();
    if (cursor_.peek() == '#') {
      carried_.insert("comments");
      cursor_.skip_comment();
      continue;
    }
    const std::string_view keyword = cursor_.word();
    // A lone backslash at a line end was skipped as a blank, so a word is never empty here.
    if (keyword == "v") {
      read_node();
    } else if (keyword == "f") {
      read_face();
    } else if (keyword == "vn") {
      read_normal();
    } else if (keyword == "vt") {
      carried_.insert("texture coordinates");
      cursor_.skip_to_line_end();
    } else if (keyword == "g") {
      read_groups();
    } else if (keyword == "o") {
      read_object();
    } else {
      read_other(keyword, where);
    }
    cursor_.skip_blanks();
    if (!cursor_.at_line_end() && cursor_.peek() != '#') cursor_.refuse_word("the end of the line");
    cursor_.skip_comment();
  }
  check_numbers();
}

void ObjReader::skip_rest_of_numbers(int already) {
  int count = already;
  for (cursor_.skip_blanks(); !cursor_.at_line_end() && cursor_.peek() != '#'; cursor_.skip_blanks()) {
    static_cast<void>(cursor_.number("a number"));
    ++count;
  }
  if (count == 4) carried_.insert("weights of nodes");
  if (count > 5) carried_.insert("colours");
}

void ObjReader::read_node() {
  if (static_cast<std::int64_t>(positions_.size()) == most_nodes)
    cursor_.refuse("more than 2^30 nodes; split the file");
  Vector3 position;
  cursor_.skip_blanks();
  source_->node_rows.push_back(cursor_.offset());
  for (int k = 0; k < 3; ++k) {
    cursor_.skip_blanks();
    position[k] = cursor_.number("a coordinate");
  }
  positions_.push_back(position);
  cursor_.skip_blanks();
  if (!cursor_.at_line_end()) skip_rest_of_numbers(3);
}

void ObjReader::read_normal() {
  if (static_cast<std::int64_t>(source_->normals.size()) == most_nodes)
    cursor_.refuse("more than 2^30 normals; split the file");
  Vector3 normal;
  cursor_.skip_blanks();
  source_->normal_rows.push_back(cursor_.offset());
  for (int k = 0; k < 3; ++k) {
    cursor_.skip_blanks();
    normal[k] = cursor_.number("a component of a normal");
  }
  source_->normals.push_back(normal);
}

/// OBJ counts from 1, or back from the latest with negative numbers.
Index ObjReader::node_number(std::int64_t number, std::size_t count, std::size_t where, const char* kind) {
  if (number == 0) file_.refuse_line(where, fmt::format("{} 0 does not exist; OBJ counts from 1", kind));
  if (number > 0) return static_cast<Index>(std::min(number - 1, most_nodes));
  const std::int64_t back = static_cast<std::int64_t>(count) + number;
  if (back < 0)
    file_.refuse_line(where,
                      fmt::format("{} {} does not exist, {} stand above; correct the face", kind, number, count));
  return static_cast<Index>(back);
}

void ObjReader::read_face() {
  if (faces_.full()) cursor_.refuse("too many faces; split the file");
  std::vector<Index>& corner_normals = source_->corner_normals;
  int corners = 0;
  for (cursor_.skip_blanks(); !cursor_.at_line_end() && cursor_.peek() != '#'; cursor_.skip_blanks(), ++corners) {
    const std::size_t where = cursor_.offset();
    faces_.add_corner(node_number(cursor_.integer("the number of a node"), positions_.size(), where, "node"), where);
    Index normal = -1;
    if (cursor_.peek() == '/') {
      cursor_.skip(1);
      if (cursor_.peek() != '/' && !cursor_.at_word_end())
        static_cast<void>(cursor_.integer("the number of a texture coordinate"));
      if (cursor_.peek() == '/') {
        cursor_.skip(1);
        if (!cursor_.at_word_end()) {
          normal = node_number(cursor_.integer("the number of a normal"), source_->normals.size(), where, "normal");
          if (normal > highest_normal_) {
            highest_normal_ = normal;
            highest_normal_where_ = where;
          }
        }
      }
    }
    if (!cursor_.at_word_end()) cursor_.refuse_word("the next node of the face");
    if (normal >= 0) corner_normals.resize(faces_.corner_count() - 1, -1);
    if (normal >= 0 || !corner_normals.empty()) corner_normals.push_back(normal);
  }
  if (corners == 0) cursor_.refuse_word("the number of a node");
  // Faces of one or two nodes are kept, but at the very end one is what a cut-off file looks like.
  if (corners < 3 && cursor_.at_end()) cursor_.refuse("the file ends inside a face; it is cut off");
  faces_.end_face();
}

void ObjReader::read_groups() {
  carried_.insert("groups");
  std::vector<std::string> names;
  for (cursor_.skip_blanks(); !cursor_.at_line_end(); cursor_.skip_blanks()) names.emplace_back(cursor_.word());
  groups_.start_groups(std::move(names), faces_.face_count());
}

void ObjReader::read_object() {
  carried_.insert("groups");
  cursor_.skip_blanks();
  const std::size_t begin = cursor_.offset();
  cursor_.skip_to_line_end();
  std::size_t end = cursor_.offset();
  while (end > begin && is_space(file_.bytes[end - 1])) --end;
  groups_.start_object(file_.bytes.substr(begin, end - begin), faces_.face_count());
}

void ObjReader::read_other(std::string_view keyword, std::size_t where) {
  static const std::set<std::string_view> free_form = {
      "vp", "cstype", "deg", "bmat",  "step",  "curv", "curv2", "surf", "parm", "trim", "hole", "scrv",
      "sp", "end",    "con", "ctech", "stech", "mg",   "bzp",   "bsp",  "cdc",  "cdp",  "res"};
  static const std::set<std::string_view> appearance = {"bevel",  "c_interp",   "d_interp",  "lod",  "maplib",
                                                        "usemap", "shadow_obj", "trace_obj", "call", "csh"};
  if (keyword == "usemtl" || keyword == "mtllib") {
    carried_.insert("materials");
  } else if (keyword == "s") {
    carried_.insert("smoothing groups");
  } else if (keyword == "l") {
    carried_.insert("lines");
  } else if (keyword == "p") {
    carried_.insert("points");
  } else if (free_form.count(keyword) > 0) {
    if (carried_.insert("free-form curves and surfaces").second)
      warnings_.push_back(fmt::format("{}:{}: free-form curves and surfaces are kept as they are, not made fair",
                                      file_.name, file_.line_of(where)));
  } else if (appearance.count(keyword) > 0) {
    carried_.insert("display attributes");
  } else {
    carried_.insert("statements that are not known");
    if (unknown_count_++ == 0) {
      unknown_where_ = where;
      unknown_word_ = in_quotes(keyword);
    }
  }
  cursor_.skip_to_line_end();
}

void ObjReader::check_numbers() const {
  if (positions_.empty()) file_.refuse("no node (a line that begins with v) is in it; choose an OBJ file of a surface");
  if (faces_.highest() >= static_cast<std::int64_t>(positions_.size()))
    file_.refuse_line(
        faces_.highest_where(),
        fmt::format("node {} does not exist, the file has {}; correct the face or restore what is missing",
                    faces_.highest() + 1, positions_.size()));
  if (highest_normal_ >= static_cast<std::int64_t>(source_->normals.size()))
    file_.refuse_line(
        highest_normal_where_,
        fmt::format("normal {} does not exist, the file has {}; correct the face or restore what is missing",
                    highest_normal_ + 1, source_->normals.size()));
}

/// Whether corners of one node name several normals, as at sharp edges.
bool ObjReader::normals_differ_at_a_node() const {
  std::vector<Index> first(positions_.size(), -1);
  for (std::size_t corner = 0; corner < source_->corner_normals.size(); ++corner) {
    Index& known = first[faces_.corners()[corner]];
    if (known < 0)
      known = source_->corner_normals[corner];
    else if (source_->corner_normals[corner] >= 0 && source_->corner_normals[corner] != known)
      return true;
  }
  return false;
}

SurfaceFile ObjReader::take(InputFile file) {
  if (unknown_count_ > 0)
    warnings_.push_back(unknown_count_ == 1
                            ? fmt::format("{}:{}: {} is not a known statement; it is kept as it is", file.name,
                                          file.line_of(unknown_where_), unknown_word_)
                            : fmt::format("{}:{}: {} and {} more are not known statements; they are kept as they are",
                                          file.name, file.line_of(unknown_where_), unknown_word_, unknown_count_ - 1));
  if (!source_->corner_normals.empty()) source_->corner_normals.resize(faces_.corner_count(), -1);
  if (normals_differ_at_a_node()) carried_.insert("normals that differ between the faces of a node");

  SurfaceFile surface;
  surface.format = SurfaceFormat::obj;
  source_->positions = positions_;
  source_->corner_count = faces_.corner_count();
  source_->carried.assign(carried_.begin(), carried_.end());
  surface.mesh = faces_.take(std::move(positions_));
  surface.groups = groups_.take(surface.mesh);
  if (!source_->corner_normals.empty())
    surface.normals = node_normals(surface.mesh, source_->corner_normals, source_->normals);
  surface.warnings = std::move(warnings_);
  source_->file = std::move(file);
  surface.source = std::move(source_);
  return surface;
}

}  // namespace

SurfaceFile read_obj(InputFile file) {
  ObjReader reader(file);
  reader.read_statements();
  return reader.take(std::move(file));
}

}  // namespace vspring
