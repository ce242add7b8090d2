// Wavefront OBJ of surfaces, of curves (its `l` statements) and of points: nodes, normals, elements and groups are
// understood; every other statement is kept as it stands.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <memory>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "io/curve_formats.hpp"
#include "io/file_normals.hpp"
#include "io/obj_source.hpp"
#include "io/obj_statements.hpp"
#include "io/point_formats.hpp"
#include "io/rewriter.hpp"
#include "io/surface_formats.hpp"

namespace vspring {
namespace {

/// Reads a surface.
class ObjReader : public ObjStatements {
 public:
  using ObjStatements::ObjStatements;

  void check_numbers() const;
  /// Returns the surface; `file` becomes the source's.
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
  // Faces of one or two nodes are kept, but at the very end one means a truncated file.
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

/// Whether corners of one node have different normals, as at sharp edges.
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
  source_->carried.assign(carried_.begin(), carried_.end());
  surface.mesh = source_->mesh = elements_.take(std::move(positions_));
  surface.groups = groups_.take(surface.mesh.face_begin(), surface.mesh.corners(), surface.mesh.node_count());
  if (!source_->corner_normals.empty())
    surface.normals = node_normals(surface.mesh, source_->corner_normals, source_->normals);
  source_->file = std::move(file);
  surface.source = std::move(source_);
  return surface;
}

/// An OBJ file of curves: where its nodes are.
class ObjCurveSource : public CurveSource {
 public:
  [[nodiscard]] std::string rewritten(const Rewriting& what) const override {
    TextRewriter out(file.bytes);
    for (std::size_t node = 0; node < rows.size(); ++node) {
      if (what.moved[node] != 0) out.replace_words(rows[node], row_of(what.places[node]));
    }
    return out.finish();
  }

  std::vector<std::size_t> rows;  ///< offset of the first coordinate of each node
};

/// Reads curves.
class ObjCurveReader : public ObjStatements {
 public:
  using ObjStatements::ObjStatements;

  void check() const;
  /// Returns the curve; `file` becomes the source's.
  CurveFile take(InputFile file);

 protected:
  bool read_element(std::string_view keyword) override;

 private:
  std::vector<PolygonCurve::Chain> chains(const InputFile& file);
};

bool ObjCurveReader::read_element(std::string_view keyword) {
  if (keyword != "l") return false;
  read_line();
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
  std::vector<std::pair<Index, Index>> segments = segments_of_lines();
  // A segment given twice would make a closed curve of two nodes, or a false branch.
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

/// Reads the lines of a surface.
class ObjMarks : public ObjStatements {
 public:
  using ObjStatements::ObjStatements;

  MeshEdges take() {
    read();
    check_node_numbers();
    return segments_of_lines();
  }

 protected:
  bool read_element(std::string_view keyword) override {
    if (keyword != "l") return false;
    read_line();
    return true;
  }
};

/// Reads the nodes, and the normals where each node has one.
class ObjPoints : public ObjStatements {
 public:
  explicit ObjPoints(const InputFile& file) : ObjStatements(file) {
    const auto lines = static_cast<std::size_t>(std::count(file.bytes.begin(), file.bytes.end(), '\n')) + 1;
    // Reserved memory that stays unused is never touched.
    positions_.reserve(lines);
    node_rows_.reserve(lines);
  }

  ScatteredPoints take() {
    read();
    if (positions_.empty()) file_.refuse("no node (a line that begins with v) is in it; choose another file");
    // Normals in another order than the nodes cannot be assigned.
    if (normals_.size() != positions_.size() || mixed_) normals_.clear();
    return {.positions = std::move(positions_), .normals = std::move(normals_)};
  }

 protected:
  bool read_element(std::string_view keyword) override {
    if (keyword == "vn") {
      Vector3& normal = normals_.emplace_back();
      for (double& component : normal) {
        cursor_.skip_blanks();
        component = cursor_.number("a component of a normal");
      }
      return true;
    }
    if (keyword != "f") return false;
    for (cursor_.skip_blanks(); !cursor_.at_line_end() && cursor_.peek() != '#'; cursor_.skip_blanks()) {
      const std::string_view corner = cursor_.word();
      const std::size_t normal = corner.rfind('/');
      if (std::count(corner.begin(), corner.end(), '/') == 2)
        mixed_ = mixed_ || corner.substr(0, corner.find('/')) != corner.substr(normal + 1);
    }
    return true;
  }

 private:
  std::vector<Vector3> normals_;
  bool mixed_ = false;
};

}  // namespace

SurfaceFile read_obj(InputFile file) {
  ObjReader reader(file);
  reader.read();
  reader.check_numbers();
  return reader.take(std::move(file));
}

CurveFile read_obj_curve(InputFile file) {
  ObjCurveReader reader(file);
  reader.read();
  reader.check();
  return reader.take(std::move(file));
}

MeshEdges marks_of_obj(const InputFile& file) { return ObjMarks(file).take(); }

ScatteredPoints read_obj_points(const InputFile& file) { return ObjPoints(file).take(); }

std::string fresh_surface_obj(const PolygonMesh& mesh, std::span<const Vector3> positions,
                              std::span<const Vector3> normals) {
  std::string text;
  text.reserve(60 * (positions.size() + normals.size()) + 20 * mesh.corners().size());
  for (const Vector3& position : positions) {
    text += "v ";
    append_numbers(text, position);
    text += '\n';
  }
  for (const Vector3& normal : normals) {
    text += "vn ";
    append_numbers(text, normal);
    text += '\n';
  }
  for (Index f = 0; f < mesh.face_count(); ++f) {
    text += 'f';
    for (const Index node : mesh.face(f)) {
      text += ' ';
      append_whole(text, static_cast<std::size_t>(node) + 1);
      if (normals.empty()) continue;
      text += "//";
      append_whole(text, static_cast<std::size_t>(node) + 1);
    }
    text += '\n';
  }
  return text;
}

std::string fresh_curve_obj(const FreshCurve& curve) {
  std::string text;
  text.reserve(70 * curve.positions.size());
  for (const Vector3& position : curve.positions) {
    text += "v ";
    append_numbers(text, position);
    text += '\n';
  }
  for (const PolygonCurve::Chain& chain : curve.chains) {
    if (chain.nodes.size() < 2) continue;
    text += 'l';
    const auto append_node = [&](Index node) {
      text += ' ';
      append_whole(text, static_cast<std::size_t>(node) + 1);
    };
    for (const Index node : chain.nodes) append_node(node);
    if (chain.closed) append_node(chain.nodes.front());
    text += '\n';
  }
  return text;
}

}  // namespace vspring
