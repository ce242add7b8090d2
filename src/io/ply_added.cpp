// PLY with added nodes and faces.
#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>
#include <string_view>
#include <vector>

#include "io/binary_numbers.hpp"
#include "io/file_normals.hpp"
#include "io/ply.hpp"
#include "io/ply_data.hpp"
#include "io/rewriter.hpp"

namespace vspring {
namespace {

std::int64_t greatest_of(PlyType type) {
  const std::size_t bits = 8 * size_of(type);
  const bool is_signed = type == PlyType::int8 || type == PlyType::int16 || type == PlyType::int32;
  return (std::int64_t{1} << (is_signed ? bits - 1 : bits)) - 1;
}

/// Where the rows of elements are, and what is in them.
template <typename Data>
class PlyRows : private PlyElements<Data> {
 public:
  using PlyElements<Data>::PlyElements;

  /// Where each row of an element of the header begins, and where the last one ends.
  std::vector<std::size_t> of(const PlyElement& wanted) {
    std::vector<std::size_t> rows;
    for (const PlyElement& element : this->header_.elements) {
      if (&element != &wanted) {
        this->skip_elements(element);
        continue;
      }
      for (PlyPlace place{&element, 0}; place.number < element.count; ++place.number) {
        this->data_.align();
        rows.push_back(this->data_.offset());
        for (const PlyProperty& property : element.properties) this->skip_property(property, place);
      }
      break;
    }
    rows.push_back(this->data_.offset());
    return rows;
  }

  /// The values of the row here, a piece of the file for each property.
  std::vector<std::string> values(const PlyElement& element) {
    std::vector<std::string> values;
    const PlyPlace place{&element, 0};
    for (const PlyProperty& property : element.properties) {
      this->data_.align();
      const std::size_t begin = this->data_.offset();
      this->skip_property(property, place);
      values.push_back(this->file_.bytes.substr(begin, this->data_.offset() - begin));
    }
    return values;
  }
};

/// Makes rows of new elements from those of others.
template <typename Data>
class RowMaker {
 public:
  RowMaker(const InputFile& file, const PlyHeader& header, const PlyElement& element)
      : file_(file),
        header_(header),
        element_(element),
        swapped_(swapped_here(header.encoding == PlyEncoding::big_endian ? std::endian::big : std::endian::little)),
        rows_(PlyRows<Data>(file, header).of(element)) {}

  [[nodiscard]] std::size_t end() const { return rows_.back(); }

  std::vector<std::string> like(Index row) const {
    PlyHeader here;
    here.encoding = header_.encoding;
    here.end = rows_[static_cast<std::size_t>(row)];
    return PlyRows<Data>(file_, here).values(element_);
  }
  [[nodiscard]] std::string number(PlyType type, double value, std::size_t node) const {
    std::string text;
    if (is_text()) {
      if (type == PlyType::float32)
        append_number(text, single(value, node));
      else
        append_number(text, value);
    } else if (type == PlyType::float32) {
      append_bytes(text, single(value, node), swapped_);
    } else {
      append_bytes(text, value, swapped_);
    }
    return text;
  }
  [[nodiscard]] std::string whole(PlyType type, std::int64_t value) const {
    if (value > greatest_of(type))
      file_.refuse(fmt::format(
          "its faces have no room for numbers of nodes up to {}; write it in another format, such as OBJ", value));
    if (is_text()) return std::to_string(value);
    std::string bytes;
    append_whole_number(bytes, type, value, swapped_);
    return bytes;
  }
  [[nodiscard]] std::string list(const PlyProperty& property, std::span<const Index> nodes) const {
    std::string text = whole(*property.count_type, static_cast<std::int64_t>(nodes.size()));
    for (const Index node : nodes) (text += is_text() ? " " : "") += whole(property.type, node);
    return text;
  }
  /// Appended to the rows that are there.
  [[nodiscard]] std::string row(const std::vector<std::string>& values) const {
    std::string text(is_text() ? line_ending(file_.bytes) : "");
    for (std::size_t k = 0; k < values.size(); ++k) (text += is_text() && k > 0 ? " " : "") += values[k];
    return text;
  }

 private:
  [[nodiscard]] bool is_text() const { return header_.encoding == PlyEncoding::text; }

  const InputFile& file_;
  const PlyHeader& header_;
  const PlyElement& element_;
  bool swapped_;
  std::vector<std::size_t> rows_;
};

}  // namespace

std::string PlySource::extended(std::string bytes, const Rewrite& rewrite) const {
  const InputFile grown = {file.name, std::move(bytes)};
  return header.encoding == PlyEncoding::text ? extended_by<PlyText>(grown, rewrite)
                                              : extended_by<PlyBinary>(grown, rewrite);
}

template <typename Data>
std::string PlySource::extended_by(const InputFile& grown, const Rewrite& rewrite) const {
  const PlyHeader now = read_ply_header(grown);
  const PlyElement& nodes = *now.find("vertex");
  const PlyElement* const faces = now.find("face");
  const PlyElement* const strips = now.find("tristrips");
  if (faces == nullptr || (strips != nullptr && strips->count > 0))
    file.refuse(
        "it has faces in strips of triangles, and no place for others; write it in another format, such as OBJ");
  const SurfaceFile& surface = rewrite.surface;
  const AddedElements& added = surface.added;
  std::vector<Vector3> normals;
  if (has_normals() && !any_whole(3))
    normals = normals_of_added(surface.mesh, surface.normals, rewrite.positions, added.node_like);

  const RowMaker<Data> node_rows(grown, now, nodes);
  std::string more_nodes;
  for (std::size_t k = 0; k < added.node_like.size(); ++k) {
    const std::size_t node = mesh.positions().size() + k;
    std::vector<std::string> values = node_rows.like(added.node_like[k]);
    for (std::size_t field = 0; field < (normals.empty() ? 3 : 6); ++field) {
      const auto property = static_cast<std::size_t>(fields[field]);
      const double value =
          field < 3 ? rewrite.positions[node][static_cast<Index>(field)] : normals[k][static_cast<Index>(field) - 3];
      values[property] = node_rows.number(nodes.properties[property].type, value, node);
    }
    more_nodes += node_rows.row(values);
  }
  const RowMaker<Data> face_rows(grown, now, *faces);
  const auto corners = static_cast<std::size_t>(std::max(faces->find("vertex_indices"), faces->find("vertex_index")));
  std::string more_faces;
  for (std::size_t k = 0; k < added.face_like.size(); ++k) {
    std::vector<std::string> values = face_rows.like(added.face_like[k]);
    for (std::size_t p = 0; p < values.size(); ++p) {
      const PlyProperty& property = faces->properties[p];
      const auto own = surface.mesh.face(mesh.face_count() + static_cast<Index>(k));
      if (property.count_type) values[p] = face_rows.list(property, p == corners ? own : std::span<const Index>());
    }
    more_faces += face_rows.row(values);
  }

  struct Change {
    std::size_t begin;
    std::size_t end;
    std::string text;
  };
  std::vector<Change> changes = {{nodes.count_begin, nodes.count_end, std::to_string(surface.mesh.node_count())},
                                 {faces->count_begin, faces->count_end, std::to_string(surface.mesh.face_count())},
                                 {node_rows.end(), node_rows.end(), std::move(more_nodes)},
                                 {face_rows.end(), face_rows.end(), std::move(more_faces)}};
  std::sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.begin < b.begin; });
  TextRewriter out(grown.bytes);
  for (const Change& change : changes) out.replace(change.begin, change.end, change.text);
  return out.finish();
}

}  // namespace vspring
