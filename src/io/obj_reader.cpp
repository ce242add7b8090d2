// Wavefront OBJ: nodes, normals, faces and groups are understood; every other statement is kept as it stands.
#include <fmt/format.h>

#include "io/file_normals.hpp"
#include "io/obj_source.hpp"
#include "io/obj_statements.hpp"

namespace vspring {
namespace {

class ObjReader : public ObjStatements {
 public:
  using ObjStatements::ObjStatements;

  void check_numbers() const;
  /// Hands over what was read; file becomes the source's.
  SurfaceFile take(InputFile file);

 protected:
  bool read_element(std::string_view keyword) override;

 private:
  void read_normal();
  void read_face();
  bool normals_differ_at_a_node() const;

  std::shared_ptr<ObjSource> source_ = std::make_shared<ObjSource>();
  std::int64_t highest_normal_ = -1;
  std::size_t highest_normal_where_ = 0;
};

bool ObjReader::read_element(std::string_view keyword) {
  if (keyword == "f") {
    read_face();
  } else if (keyword == "vn") {
    read_normal();
  } else {
    return false;
  }
  return true;
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

void ObjReader::read_face() {
  if (elements_.full()) cursor_.refuse("too many faces; split the file");
  std::vector<Index>& corner_normals = source_->corner_normals;
  int corners = 0;
  for (cursor_.skip_blanks(); !cursor_.at_line_end() && cursor_.peek() != '#'; cursor_.skip_blanks(), ++corners) {
    const std::size_t where = cursor_.offset();
    read_node_number();
    Index normal = -1;
    if (cursor_.peek() == '/') {
      cursor_.skip(1);
      if (cursor_.peek() != '/' && !cursor_.at_word_end())
        static_cast<void>(cursor_.integer("the number of a texture coordinate"));
      if (cursor_.peek() == '/') {
        cursor_.skip(1);
        if (!cursor_.at_word_end()) {
          normal = number_of(cursor_.integer("the number of a normal"), source_->normals.size(), where, "normal");
          if (normal > highest_normal_) {
            highest_normal_ = normal;
            highest_normal_where_ = where;
          }
        }
      }
    }
    if (!cursor_.at_word_end()) cursor_.refuse_word("the next node of the face");
    if (normal >= 0) corner_normals.resize(elements_.corner_count() - 1, -1);
    if (normal >= 0 || !corner_normals.empty()) corner_normals.push_back(normal);
  }
  if (corners == 0) cursor_.refuse_word("the number of a node");
  // Faces of one or two nodes are kept, but at the very end one is what a cut-off file looks like.
  if (corners < 3 && cursor_.at_end()) cursor_.refuse("the file ends inside a face; it is cut off");
  elements_.end_face();
}

void ObjReader::check_numbers() const {
  if (positions_.empty()) file_.refuse("no node (a line that begins with v) is in it; choose an OBJ file of a surface");
  check_node_numbers();
  if (highest_normal_ >= static_cast<std::int64_t>(source_->normals.size()))
    file_.refuse_line(highest_normal_where_,
                      fmt::format("normal {} does not exist, the file has {}; correct it or restore what is missing",
                                  highest_normal_ + 1, source_->normals.size()));
}

/// Whether corners of one node name several normals, as at sharp edges.
bool ObjReader::normals_differ_at_a_node() const {
  std::vector<Index> first(positions_.size(), -1);
  for (std::size_t corner = 0; corner < source_->corner_normals.size(); ++corner) {
    Index& known = first[elements_.corners()[corner]];
    if (known < 0)
      known = source_->corner_normals[corner];
    else if (source_->corner_normals[corner] >= 0 && source_->corner_normals[corner] != known)
      return true;
  }
  return false;
}

SurfaceFile ObjReader::take(InputFile file) {
  if (!source_->corner_normals.empty()) source_->corner_normals.resize(elements_.corner_count(), -1);
  if (normals_differ_at_a_node()) carried_.insert("normals that differ between the faces of a node");

  SurfaceFile surface;
  surface.format = SurfaceFormat::obj;
  surface.warnings = take_warnings(file);
  source_->node_rows = std::move(node_rows_);
  source_->positions = positions_;
  source_->corner_count = elements_.corner_count();
  source_->carried.assign(carried_.begin(), carried_.end());
  surface.mesh = elements_.take(std::move(positions_));
  surface.groups = groups_.take(surface.mesh.face_begin(), surface.mesh.corners(), surface.mesh.node_count());
  if (!source_->corner_normals.empty())
    surface.normals = node_normals(surface.mesh, source_->corner_normals, source_->normals);
  source_->file = std::move(file);
  surface.source = std::move(source_);
  return surface;
}

}  // namespace

SurfaceFile read_obj(InputFile file) {
  ObjReader reader(file);
  reader.read();
  reader.check_numbers();
  return reader.take(std::move(file));
}

}  // namespace vspring
