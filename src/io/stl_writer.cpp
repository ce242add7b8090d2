// STL with other positions, with added or divided facets, and made anew.
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/binary_numbers.hpp"
#include "io/file_normals.hpp"
#include "io/rewriter.hpp"
#include "io/stl.hpp"
#include "shape/corner_items.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

/// The unit normal of a triangle, zero for one without area.
Vector3 facet_normal(const Vector3& a, const Vector3& b, const Vector3& c) {
  return unit_or_zero(unit_or_zero(b - a).cross(unit_or_zero(c - a)));
}

}  // namespace

std::string StlSource::rewritten(Rewrite& rewrite) const {
  return rows.empty() ? rewritten_binary(rewrite) : rewritten_text(rewrite);
}

std::string StlSource::rewritten_text(const Rewrite& rewrite) const {
  // Words of a facet: three of the normal, `outer loop`, and four for each `vertex` line.
  constexpr std::array<int, 3> columns = {6, 10, 14};
  TextRewriter out(file.bytes);
  std::vector<NewNumber> numbers;
  for (std::size_t facet = 0; facet < rows.size(); ++facet) {
    numbers.clear();
    std::array<Vector3, 3> corners;
    for (int c = 0; c < 3; ++c) {
      const Index node = corner_nodes[3 * facet + c];
      corners[c] = rewrite.positions[node];
      if (rewrite.moved[node] == 0) continue;
      for (int k = 0; k < 3; ++k) numbers.push_back({columns[c] + k, corners[c][k]});
    }
    if (numbers.empty()) continue;
    const Vector3 normal = facet_normal(corners[0], corners[1], corners[2]);
    numbers.insert(numbers.begin(), {{0, normal.x()}, {1, normal.y()}, {2, normal.z()}});
    out.replace_words(rows[facet], numbers);
  }
  // After the last facet, which ends with this word.
  const std::string_view text = file.bytes;
  constexpr std::string_view word = "facet";
  std::size_t end = rows.back();
  while (!same_word(text.substr(end, word.size()), word)) ++end;
  end += word.size();
  std::string added;
  const auto line = [&](const char* keyword, const Vector3& vector) {
    ((added += line_ending(text)) += keyword) += ' ';
    append_numbers(added, vector);
  };
  for (const auto& [a, b, c] : added_facets(rewrite)) {
    line("facet normal", facet_normal(a, b, c));
    (added += line_ending(text)) += "outer loop";
    for (const Vector3& corner : {a, b, c}) line("vertex", corner);
    (added += line_ending(text)) += "endloop";
    (added += line_ending(text)) += "endfacet";
  }
  out.replace(end, end, added);
  return out.finish();
}

std::pair<std::size_t, std::size_t> StlSource::place_of(std::size_t facet) const {
  if (rows.empty()) return {stl_facets_begin + facet * stl_facet_size, stl_facets_begin + (facet + 1) * stl_facet_size};
  // The normal stands behind `facet normal`; the facet ends with `endfacet` or `end facet`.
  const std::string_view text = file.bytes;
  constexpr std::string_view word = "facet";
  std::size_t begin = rows[facet];
  while (!same_word(text.substr(begin, word.size()), word)) --begin;
  std::size_t end = rows[facet];
  while (!same_word(text.substr(end, word.size()), word)) ++end;
  return {begin, end + word.size()};
}

std::string StlSource::facet_bytes(std::size_t facet, std::span<const Index> nodes,
                                   const std::vector<Vector3>& positions) const {
  std::array<Vector3, 3> corners;
  for (std::size_t k = 0; k < 3; ++k) corners[k] = positions[static_cast<std::size_t>(nodes[k])];
  const Vector3 normal = facet_normal(corners[0], corners[1], corners[2]);
  std::string out;
  if (rows.empty()) {
    for (const double value : normal) append_bytes(out, static_cast<float>(value));
    for (std::size_t k = 0; k < 3; ++k) {
      for (const double value : corners[k]) append_bytes(out, single(value, static_cast<std::size_t>(nodes[k])));
    }
    return out += std::string_view(file.bytes).substr(place_of(facet).second - 2, 2);
  }
  const std::string_view line_end = line_ending(file.bytes);
  append_numbers(out += "facet normal ", normal);
  ((out += line_end) += "outer loop") += line_end;
  for (const Vector3& corner : corners) {
    append_numbers(out += "vertex ", corner);
    out += line_end;
  }
  return ((out += "endloop") += line_end) += "endfacet";
}

SurfaceFile StlSource::refined(const RefinedMesh& refined) const {
  const std::vector<FaceParts> all_parts = parts_of_faces(mesh, refined);
  std::vector<Index> number(mesh.positions().size(), -1);  // of nodes that stay
  const std::vector<Index> before = refined.numbers_in_means();
  for (Index node = 0; node < refined.kept_node_count(); ++node)
    number[static_cast<std::size_t>(before[static_cast<std::size_t>(node)])] = node;
  const auto stays = [&](Index node) { return number[static_cast<std::size_t>(node)] >= 0; };
  TextRewriter out(file.bytes);
  std::vector<Index> nodes;
  std::size_t face = 0;
  for (std::size_t facet = 0; 3 * facet < corner_nodes.size(); ++facet) {
    const std::span<const Index> own = std::span(corner_nodes).subspan(3 * facet, 3);
    const bool is_face = own[0] != own[1] && own[1] != own[2] && own[0] != own[2];
    const FaceParts* const parts = is_face ? &all_parts[face++] : nullptr;
    const bool is_same = parts == nullptr || !parts->is_divided;
    if (is_same && std::all_of(own.begin(), own.end(), stays)) {
      for (const Index node : own) nodes.push_back(number[static_cast<std::size_t>(node)]);
      continue;
    }
    std::string text;
    // Of a facet without area whose nodes are gone nothing is left.
    for (Index part = is_same ? 0 : parts->begin; part < (is_same ? 0 : parts->end); ++part) {
      const auto triangle = refined.mesh.face(part);
      nodes.insert(nodes.end(), triangle.begin(), triangle.end());
      if (part > parts->begin && !rows.empty()) text += line_ending(file.bytes);
      text += facet_bytes(facet, triangle, refined.mesh.positions());
    }
    const auto [begin, end] = place_of(facet);
    out.replace(begin, end, text);
  }
  std::string bytes = out.finish();
  if (rows.empty()) store(bytes.data() + stl_header_size, static_cast<std::uint32_t>(nodes.size() / 3), little_swapped);
  // Reading numbers nodes as they come; they keep the numbers of the refined mesh.
  SurfaceFile surface = read_stl({file.name, std::move(bytes)});
  auto source = std::make_shared<StlSource>();
  const auto& read = dynamic_cast<const StlSource&>(*surface.source);
  std::vector<Vector3> positions = refined.mesh.positions();
  for (std::size_t k = 0; k < nodes.size(); ++k)
    positions[static_cast<std::size_t>(nodes[k])] = read.mesh.position(read.corner_nodes[k]);
  source->file = read.file;
  source->carried = read.carried;
  source->rows = read.rows;
  source->corner_nodes = std::move(nodes);
  surface.mesh = refined.mesh;
  surface.mesh.set_positions(std::move(positions));
  source->mesh = surface.mesh;
  surface.source = std::move(source);
  return surface;
}

std::vector<std::array<Vector3, 3>> StlSource::added_facets(const Rewrite& rewrite) {
  const PolygonMesh& mesh = rewrite.surface.mesh;
  std::vector<std::array<Vector3, 3>> facets;
  for (auto f = mesh.face_count() - static_cast<Index>(rewrite.surface.added.face_like.size()); f < mesh.face_count();
       ++f) {
    const auto face = mesh.face(f);
    const auto corner = [&](std::size_t k) { return rewrite.positions[static_cast<std::size_t>(face[k])]; };
    for (std::size_t k = 2; k < face.size(); ++k) facets.push_back({corner(0), corner(k - 1), corner(k)});
  }
  return facets;
}

std::string StlSource::rewritten_binary(const Rewrite& rewrite) const {
  std::string out = file.bytes;
  for (std::size_t facet = 0; 3 * facet < corner_nodes.size(); ++facet) {
    char* const record = out.data() + stl_facets_begin + facet * stl_facet_size;
    const auto put = [&](std::size_t vector, const Vector3& value, Index node) {
      for (std::size_t k = 0; k < 3; ++k)
        store(record + 12 * vector + 4 * k, single(value[k], static_cast<std::size_t>(node)), little_swapped);
    };
    std::array<Vector3, 3> corners;
    bool any_moved = false;
    for (std::size_t c = 0; c < 3; ++c) {
      const Index node = corner_nodes[3 * facet + c];
      corners[c] = rewrite.positions[node];
      if (rewrite.moved[node] == 0) continue;
      put(c + 1, corners[c], node);
      any_moved = true;
    }
    if (any_moved) put(0, facet_normal(corners[0], corners[1], corners[2]), 0);
  }
  std::string added;
  const auto append = [&](const Vector3& vector) {
    for (const double value : vector) append_bytes(added, single(value, 0), little_swapped);
  };
  const auto facets = added_facets(rewrite);
  for (const auto& [a, b, c] : facets) {
    append(facet_normal(a, b, c));
    for (const Vector3& corner : {a, b, c}) append(corner);
    added.append(2, '\0');
  }
  const std::size_t count = corner_nodes.size() / 3;
  if (!facets.empty())
    store(out.data() + stl_header_size, static_cast<std::uint32_t>(count + facets.size()), little_swapped);
  out.insert(stl_facets_begin + stl_facet_size * count, added);
  return out;
}

std::string fresh_stl(const PolygonMesh& mesh, std::span<const Vector3> positions, std::vector<std::string>& losses) {
  std::size_t triangles = 0;
  bool larger = false;
  bool smaller = false;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const std::size_t size = mesh.face(f).size();
    triangles += size < 3 ? 0 : size - 2;
    larger = larger || size > 3;
    smaller = smaller || size < 3;
  }
  if (triangles == 0)
    throw Error(ErrorCode::invalid_argument,
                "STL holds nothing but triangles, and the mesh has no face of three nodes; write another format");
  if (larger) losses.emplace_back("faces of more than three nodes: they are cut into triangles from their first node");
  if (smaller) losses.emplace_back("faces of fewer than three nodes");
  std::vector<std::uint8_t> used(positions.size(), 0);
  for (const Index node : mesh.corners()) used[node] = 1;
  if (std::find(used.begin(), used.end(), 0) != used.end()) losses.emplace_back("nodes that no face uses");
  const auto is_single = [](double value) { return !std::isfinite(value) || value == as_single(value); };
  if (!std::all_of(positions.begin(), positions.end(), [&](const Vector3& position) {
        return is_single(position.x()) && is_single(position.y()) && is_single(position.z());
      }))
    losses.emplace_back("precision beyond single");

  std::string bytes(stl_header_size, '\0');
  bytes.replace(0, 7, "vspring");
  bytes.reserve(stl_facets_begin + stl_facet_size * triangles);
  append_bytes(bytes, static_cast<std::uint32_t>(triangles));
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const std::span<const Index> face = mesh.face(f);
    for (std::size_t k = 1; k + 1 < face.size(); ++k) {
      const std::array<Index, 3> nodes = {face[0], face[k], face[k + 1]};
      for (const double value : facet_normal(positions[nodes[0]], positions[nodes[1]], positions[nodes[2]]))
        append_bytes(bytes, static_cast<float>(value));
      for (const Index node : nodes) {
        for (const double value : positions[node]) append_bytes(bytes, single(value, static_cast<std::size_t>(node)));
      }
      append_bytes(bytes, std::uint16_t{0});
    }
  }
  return bytes;
}

}  // namespace vspring
