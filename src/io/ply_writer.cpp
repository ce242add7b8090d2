// PLY with other positions, and PLY of a mesh that no file gave.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "io/binary_numbers.hpp"
#include "io/file_normals.hpp"
#include "io/ply.hpp"
#include "io/ply_data.hpp"
#include "io/rewriter.hpp"
#include "io/surface_formats.hpp"

namespace vspring {

std::array<int, 6> PlySource::places_in(std::size_t row) const {
  const PlyElement& element = node_element();
  const bool text = header.encoding == PlyEncoding::text;
  std::array<int, 6> places{};
  int place = 0;
  // Lists are not checked again: they were whole when the file was read.
  const auto list_length = [&](const PlyProperty& property) {
    PlyHeader here;
    here.encoding = header.encoding;
    const PlyPlace where{&element, 0};
    if (!text) {
      here.end = row + static_cast<std::size_t>(place);
      return static_cast<int>(PlyBinary(file, here).whole(*property.count_type, where));
    }
    here.end = row;
    PlyText words(file, here);
    words.skip(PlyType::float64, static_cast<std::uint64_t>(place), where);
    return static_cast<int>(words.whole(*property.count_type, where));
  };
  for (int k = 0; k < static_cast<int>(element.properties.size()); ++k) {
    const PlyProperty& property = element.properties[k];
    for (std::size_t field = 0; field < fields.size(); ++field) {
      if (fields[field] == k) places[field] = place;
    }
    const int size = text ? 1 : static_cast<int>(size_of(property.type));
    if (property.count_type)
      place += list_length(property) * size + (text ? 1 : static_cast<int>(size_of(*property.count_type)));
    else
      place += size;
  }
  return places;
}

bool PlySource::any_whole(int first_field) const {
  const auto& properties = node_element().properties;
  for (int field = first_field; field < first_field + 3; ++field) {
    if (fields[field] >= 0 && is_whole(properties[fields[field]].type)) return true;
  }
  return false;
}

bool PlySource::has_plain_elements() const {
  if (header.encoding == PlyEncoding::text || header.elements.size() != 2) return false;
  const PlyElement& nodes = header.elements[0];
  const PlyElement& faces = header.elements[1];
  return nodes.name == "vertex" && nodes.properties.size() == 3 && !nodes.has_lists() && !any_whole(0) &&
         faces.name == "face" && faces.properties.size() == 1 && faces.has_lists();
}

bool PlySource::swapped() const {
  return swapped_here(header.encoding == PlyEncoding::big_endian ? std::endian::big : std::endian::little);
}

void PlySource::forget_plain_data() {
  if (!has_plain_elements()) return;
  std::string header_alone = file.bytes.substr(0, header.end);
  std::swap(file.bytes, header_alone);
  is_plain = with_plain_data(mesh.positions()) == header_alone;
  if (!is_plain) std::swap(file.bytes, header_alone);
}

std::string PlySource::with_plain_data(std::span<const Vector3> new_positions) const {
  const bool is_swapped = swapped();
  const std::vector<PlyProperty>& coordinates = node_element().properties;
  const PlyProperty& list = header.elements[1].properties.front();
  std::size_t size = new_positions.size() * node_element().least_size(header.encoding);
  size += static_cast<std::size_t>(mesh.face_count()) * size_of(*list.count_type);
  size += mesh.corners().size() * size_of(list.type);
  std::string out;
  out.reserve(file.bytes.size() + size);
  out = file.bytes;
  std::array<int, 3> axis_of{};
  for (int k = 0; k < 3; ++k) axis_of[static_cast<std::size_t>(fields[static_cast<std::size_t>(k)])] = k;
  for (std::size_t node = 0; node < new_positions.size(); ++node) {
    for (std::size_t k = 0; k < coordinates.size(); ++k) {
      const double value = new_positions[node][axis_of[k]];
      if (coordinates[k].type == PlyType::float32)
        append_bytes(out, single(value, node), is_swapped);
      else
        append_bytes(out, value, is_swapped);
    }
  }
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const std::span<const Index> face = mesh.face(f);
    append_whole_number(out, *list.count_type, static_cast<std::int64_t>(face.size()), is_swapped);
    for (const Index node : face) append_whole_number(out, list.type, node, is_swapped);
  }
  return out;
}

bool PlySource::has_single_precision() const {
  return !any_whole(0) && node_element().properties[static_cast<std::size_t>(fields[0])].type == PlyType::float32;
}

std::string PlySource::rewritten(Rewrite& rewrite) const {
  std::string bytes = moved(rewrite);
  return rewrite.surface.added.face_like.empty() ? bytes : extended(std::move(bytes), rewrite);
}

std::string PlySource::moved(Rewrite& rewrite) const {
  if (is_plain) return with_plain_data(std::span(rewrite.positions).first(mesh.positions().size()));
  const SurfaceFile& surface = rewrite.surface;
  const bool any_moved = std::any_of(rewrite.moved.begin(), rewrite.moved.end(), [](auto moved) { return moved != 0; });
  if (!any_moved) return file.bytes;
  NewNormals normals;
  if (has_normals() && any_whole(3))
    rewrite.remarks.emplace_back("normals that fit the moved nodes: the file holds whole numbers, kept as they were");
  else if (has_normals() && surface.normals.size() == mesh.positions().size())
    normals =
        compute_normals(mesh, mesh.corners(), surface.normals, mesh.positions(), rewrite.positions, rewrite.moved);
  if (any_whole(0))
    rewrite.remarks.emplace_back("the whole-number type of the coordinates: they are written in double precision");
  return header.encoding == PlyEncoding::text || any_whole(0) ? rebuilt(rewrite, normals) : patched(rewrite, normals);
}

/// Binary with floating-point coordinates: every number keeps its place.
std::string PlySource::patched(const Rewrite& rewrite, const NewNormals& normals) const {
  const PlyElement& element = node_element();
  const bool is_swapped = swapped();
  std::string out = file.bytes;
  const auto put = [&](std::size_t at, int field, double value, std::size_t node) {
    if (element.properties[fields[field]].type == PlyType::float32)
      store(out.data() + at, single(value, node), is_swapped);
    else
      store(out.data() + at, value, is_swapped);
  };
  const std::size_t size = element.least_size(header.encoding);
  std::array<int, 6> places = places_in(first_row);
  for (std::size_t node = 0; node < mesh.positions().size(); ++node) {
    const bool moved = rewrite.moved[node] != 0;
    const bool turned = !normals.due.empty() && normals.due[node] != 0;
    if (!moved && !turned) continue;
    const std::size_t row = rows.empty() ? first_row + node * size : rows[node];
    if (element.has_lists()) places = places_in(row);
    for (int k = 0; k < 3; ++k) {
      if (moved) put(row + places[k], k, rewrite.positions[node][k], node);
      if (turned) put(row + places[k + 3], k + 3, normals.normals[node][k], node);
    }
  }
  return out;
}

/// Whole-number coordinates become doubles in the header.
void PlySource::widen_header(TextRewriter& out) const {
  std::array<int, 3> coordinates = {fields[0], fields[1], fields[2]};
  std::sort(coordinates.begin(), coordinates.end());
  for (const int k : coordinates) {
    const PlyProperty& property = node_element().properties[k];
    if (is_whole(property.type)) out.replace(property.type_begin, property.type_end, "double");
  }
}

/// Text, or binary in which coordinates change their type: numbers change their length.
std::string PlySource::rebuilt(const Rewrite& rewrite, const NewNormals& normals) const {
  const PlyElement& element = node_element();
  const bool text = header.encoding == PlyEncoding::text;
  const bool is_swapped = swapped();
  TextRewriter out(file.bytes);
  widen_header(out);
  std::vector<NewNumber> numbers;
  std::array<int, 6> places = places_in(rows.empty() ? first_row : rows.front());
  for (std::size_t node = 0; node < mesh.positions().size(); ++node) {
    const bool turned = !normals.due.empty() && normals.due[node] != 0;
    // In text only what changes is written; in binary every coordinate of the old type has to go.
    const bool moved = rewrite.moved[node] != 0 || !text;
    if (!moved && !turned) continue;
    const std::size_t row = rows.empty() ? first_row + node * element.least_size(header.encoding) : rows[node];
    if (element.has_lists()) places = places_in(row);
    numbers.clear();
    for (int field = moved ? 0 : 3; field < (turned ? 6 : 3); ++field) {
      const double value = field < 3 ? rewrite.positions[node][field] : normals.normals[node][field - 3];
      const bool narrow = element.properties[fields[field]].type == PlyType::float32;
      if (narrow) static_cast<void>(single(value, node));
      numbers.push_back({places[field], value, narrow});
    }
    std::sort(numbers.begin(), numbers.end(), [](const auto& a, const auto& b) { return a.column < b.column; });
    if (text) {
      out.replace_words(row, numbers);
      continue;
    }
    for (const NewNumber& number : numbers) {
      const std::size_t begin = row + static_cast<std::size_t>(number.column);
      const auto field =
          static_cast<std::size_t>(std::find(places.begin(), places.end(), number.column) - places.begin());
      const PlyType type = element.properties[fields[field]].type;
      std::array<char, sizeof(double)> bytes{};
      if (number.single)
        store(bytes.data(), static_cast<float>(number.value), is_swapped);
      else
        store(bytes.data(), number.value, is_swapped);
      out.replace(begin, begin + size_of(type), {bytes.data(), number.single ? sizeof(float) : sizeof(double)});
    }
  }
  return out.finish();
}

std::string fresh_ply(const PolygonMesh& mesh, std::span<const Vector3> positions, std::span<const Vector3> normals,
                      std::span<const NodeScalar> scalars) {
  std::size_t largest = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) largest = std::max(largest, mesh.face(f).size());
  const bool short_lists = largest <= 255;
  std::string bytes = fmt::format("ply\nformat binary_little_endian 1.0\nelement vertex {}\n", positions.size());
  bytes += "property double x\nproperty double y\nproperty double z\n";
  if (!normals.empty()) bytes += "property double nx\nproperty double ny\nproperty double nz\n";
  for (const NodeScalar& scalar : scalars) bytes += fmt::format("property double {}\n", scalar.name);
  bytes += fmt::format("element face {}\nproperty list {} int vertex_indices\nend_header\n", mesh.face_count(),
                       short_lists ? "uchar" : "int");
  bytes.reserve(bytes.size() + (24 + 8 * scalars.size()) * positions.size() + 24 * normals.size() +
                4 * static_cast<std::size_t>(mesh.face_count()) + 4 * mesh.corners().size());
  for (std::size_t node = 0; node < positions.size(); ++node) {
    for (const double value : positions[node]) append_bytes(bytes, value);
    if (!normals.empty()) {
      for (const double value : normals[node]) append_bytes(bytes, value);
    }
    for (const NodeScalar& scalar : scalars) append_bytes(bytes, scalar.values[node]);
  }
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const std::span<const Index> face = mesh.face(f);
    if (short_lists)
      append_bytes(bytes, static_cast<std::uint8_t>(face.size()));
    else
      append_bytes(bytes, static_cast<std::int32_t>(face.size()));
    for (const Index node : face) append_bytes(bytes, node);
  }
  return bytes;
}

}  // namespace vspring
