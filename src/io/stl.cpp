// STL, text and binary. Corners at the same position become one node; the file stays a list of triangles.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <bit>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <memory>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/binary_numbers.hpp"
#include "io/face_list.hpp"
#include "io/file_normals.hpp"
#include "io/rewriter.hpp"
#include "io/surface_formats.hpp"
#include "io/text_cursor.hpp"
#include "shape/corner_items.hpp"
#include "vspring/error.hpp"

namespace vspring {
namespace {

// Binary STL: 80 bytes of any text, the number of facets, then for each twelve floats (normal, corners) and two bytes
// for attributes; all little-endian.
constexpr std::size_t header_size = 80;
constexpr std::size_t facets_begin = 84;
constexpr std::size_t facet_size = 50;

/// Bytes of a binary file according to its number of facets; 0 if it is too short to have one.
std::size_t promised_size(std::string_view bytes) {
  if (bytes.size() < facets_begin) return 0;
  return facets_begin + facet_size * std::size_t{load<std::uint32_t>(bytes.data() + header_size, little_swapped)};
}

/// The unit normal of a triangle, zero for one without area.
Vector3 facet_normal(const Vector3& a, const Vector3& b, const Vector3& c) {
  return unit_or_zero(unit_or_zero(b - a).cross(unit_or_zero(c - a)));
}

bool same_word(std::string_view word, std::string_view wanted) {
  return std::equal(word.begin(), word.end(), wanted.begin(), wanted.end(),
                    [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

/// An STL file: where its facets are and which node each of their corners is.
class StlSource : public SurfaceSource {
 public:
  [[nodiscard]] std::string rewritten(Rewrite& rewrite) const override;
  [[nodiscard]] SurfaceFile refined(const RefinedMesh& refined) const override;
  [[nodiscard]] bool has_single_precision() const override { return rows.empty(); }

  std::vector<Index> corner_nodes;  ///< three per facet, also of facets that are no faces
  std::vector<std::size_t> rows;    ///< text: offset of the first number of each facet's normal

 private:
  /// The corners of added facets.
  [[nodiscard]] static std::vector<std::array<Vector3, 3>> added_facets(const Rewrite& rewrite);
  [[nodiscard]] std::string rewritten_text(const Rewrite& rewrite) const;
  [[nodiscard]] std::string rewritten_binary(const Rewrite& rewrite) const;
  /// Where facet `facet` begins and ends in the file; in text, from its keyword on.
  [[nodiscard]] std::pair<std::size_t, std::size_t> place_of(std::size_t facet) const;
  /// One triangle, in the place of `facet`.
  [[nodiscard]] std::string facet_bytes(std::size_t facet, std::span<const Index> nodes,
                                        const std::vector<Vector3>& positions) const;
};

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
  if (rows.empty()) return {facets_begin + facet * facet_size, facets_begin + (facet + 1) * facet_size};
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
  TextRewriter out(file.bytes);
  std::vector<Index> nodes;
  std::size_t face = 0;
  for (std::size_t facet = 0; 3 * facet < corner_nodes.size(); ++facet) {
    const std::span<const Index> own = std::span(corner_nodes).subspan(3 * facet, 3);
    const bool is_face = own[0] != own[1] && own[1] != own[2] && own[0] != own[2];
    const FaceParts* const parts = is_face ? &all_parts[face++] : nullptr;
    if (parts == nullptr || !parts->is_divided) {
      nodes.insert(nodes.end(), own.begin(), own.end());
      continue;
    }
    std::string text;
    for (Index part = parts->begin; part < parts->end; ++part) {
      const auto triangle = refined.mesh.face(part);
      nodes.insert(nodes.end(), triangle.begin(), triangle.end());
      if (part > parts->begin && !rows.empty()) text += line_ending(file.bytes);
      text += facet_bytes(facet, triangle, refined.mesh.positions());
    }
    const auto [begin, end] = place_of(facet);
    out.replace(begin, end, text);
  }
  std::string bytes = out.finish();
  if (rows.empty()) store(bytes.data() + header_size, static_cast<std::uint32_t>(nodes.size() / 3), little_swapped);
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
    char* const record = out.data() + facets_begin + facet * facet_size;
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
    store(out.data() + header_size, static_cast<std::uint32_t>(count + facets.size()), little_swapped);
  out.insert(facets_begin + facet_size * count, added);
  return out;
}

/// Gives one number to all positions whose coordinates are the same bits; 0 and −0 are the same.
class Weld {
 public:
  /// corners: the number of positions to come.
  explicit Weld(std::size_t corners);

  /// The node at this position, a new one if there is none yet. Nodes are numbered as they come.
  Index node_at(const Vector3& position);

  /// Per node, as it first came.
  std::vector<Vector3> positions;

 private:
  void grow();

  std::vector<Index> slots_;  ///< open addressing; −1 is free
  std::size_t mask_;
};

using PositionBits = std::array<std::uint64_t, 3>;

PositionBits bits_of(const Vector3& position) {
  // Adding zero turns −0 into 0.
  return {Eigen::numext::bit_cast<std::uint64_t>(position.x() + 0.0),
          Eigen::numext::bit_cast<std::uint64_t>(position.y() + 0.0),
          Eigen::numext::bit_cast<std::uint64_t>(position.z() + 0.0)};
}

std::size_t hash_of(const PositionBits& bits) {
  std::uint64_t hash = 0;
  for (const std::uint64_t word : bits) {
    hash = (hash ^ word) * 0x9E3779B97F4A7C15U;
    hash ^= hash >> 32;
  }
  return static_cast<std::size_t>(hash);
}

// A closed surface of triangles has six corners to a node.
Weld::Weld(std::size_t corners) : slots_(std::bit_ceil(corners / 3 + 16), -1), mask_(slots_.size() - 1) {
  positions.reserve(corners / 6);
}

Index Weld::node_at(const Vector3& position) {
  const PositionBits bits = bits_of(position);
  std::size_t slot = hash_of(bits) & mask_;
  for (; slots_[slot] >= 0; slot = (slot + 1) & mask_) {
    if (bits_of(positions[slots_[slot]]) == bits) return slots_[slot];
  }
  const auto node = static_cast<Index>(positions.size());
  slots_[slot] = node;
  positions.push_back(position);
  if (2 * positions.size() > slots_.size()) grow();
  return node;
}

void Weld::grow() {
  slots_.assign(2 * slots_.size(), -1);
  mask_ = slots_.size() - 1;
  for (std::size_t node = 0; node < positions.size(); ++node) {
    std::size_t slot = hash_of(bits_of(positions[node])) & mask_;
    while (slots_[slot] >= 0) slot = (slot + 1) & mask_;
    slots_[slot] = static_cast<Index>(node);
  }
}

/// The corners of a file's facets, as nodes.
class Facets {
 public:
  explicit Facets(std::size_t facets) : weld_(3 * facets) { nodes_.reserve(3 * facets); }

  void add_corner(const Vector3& position) { nodes_.push_back(weld_.node_at(position)); }
  [[nodiscard]] std::size_t count() const { return nodes_.size() / 3; }
  [[nodiscard]] bool full() const { return nodes_.size() >= static_cast<std::size_t>(most_nodes); }

  SurfaceFile take(InputFile file, std::shared_ptr<StlSource> source);

 private:
  Weld weld_;
  std::vector<Index> nodes_;
};

SurfaceFile Facets::take(InputFile file, std::shared_ptr<StlSource> source) {
  SurfaceFile surface;
  surface.format = SurfaceFormat::stl;
  FaceList faces;
  faces.reserve(count(), nodes_.size());
  std::size_t collapsed = 0;
  std::size_t first_collapsed = 0;
  for (std::size_t facet = 0; facet < count(); ++facet) {
    const Index* nodes = nodes_.data() + 3 * facet;
    if (nodes[0] == nodes[1] || nodes[1] == nodes[2] || nodes[0] == nodes[2]) {
      if (collapsed++ == 0) first_collapsed = facet;
      continue;
    }
    for (int c = 0; c < 3; ++c) faces.add_corner(nodes[c], facet);
    faces.end_face();
  }
  surface.warnings.push_back(fmt::format("{}: {} corners of {} triangles are welded to {} nodes", file.name,
                                         nodes_.size(), count(), weld_.positions.size()));
  if (collapsed > 0)
    surface.warnings.push_back(fmt::format(
        "{}: {} triangles, the first of them number {}, have two corners at one place; they are no faces of the "
        "surface, and are written again with the others",
        file.name, collapsed, first_collapsed));
  surface.mesh = source->mesh = faces.take(std::move(weld_.positions));
  source->corner_nodes = std::move(nodes_);
  source->file = std::move(file);
  surface.source = std::move(source);
  return surface;
}

SurfaceFile read_binary(InputFile file) {
  const std::size_t promised = promised_size(file.bytes);
  if (promised == 0) file.refuse("it is too short for STL; choose another file");
  const std::size_t facets = (promised - facets_begin) / facet_size;
  if (promised > file.bytes.size())
    file.refuse(fmt::format("{} triangles are promised, which take {} bytes, but it has {}; it is cut off, or not STL",
                            facets, promised, file.bytes.size()));
  if (facets == 0) file.refuse("it has no triangles; choose the file of a surface");
  Facets list(facets);
  std::set<std::string> carried = {"normals of triangles"};
  for (std::size_t facet = 0; facet < facets; ++facet) {
    if (list.full()) file.refuse("too many triangles; split the file");
    const char* const record = file.bytes.data() + facets_begin + facet * facet_size;
    for (std::size_t c = 1; c <= 3; ++c) {
      Vector3 position;
      for (std::size_t k = 0; k < 3; ++k)
        position[static_cast<Index>(k)] = static_cast<double>(load<float>(record + 12 * c + 4 * k, little_swapped));
      list.add_corner(position);
    }
    if (record[48] != 0 || record[49] != 0) carried.insert("attributes of triangles");
  }
  const std::string_view header(file.bytes.data(), header_size);
  if (header.find_first_not_of(std::string_view("\0 ", 2)) != std::string_view::npos)
    carried.insert("the header's text");
  const std::size_t behind = file.bytes.size() - promised;
  if (behind > 0) carried.insert("bytes behind the triangles");
  auto source = std::make_shared<StlSource>();
  source->carried.assign(carried.begin(), carried.end());
  SurfaceFile surface = list.take(std::move(file), std::move(source));
  if (behind > 0)
    surface.warnings.push_back(fmt::format("{}: {} bytes come behind the {} triangles; they are kept and not looked at",
                                           surface.source->file.name, behind, facets));
  return surface;
}

/// Reads the words of a text file.
class StlText {
 public:
  explicit StlText(const InputFile& file)
      : cursor_(file), facets_(file.bytes.size() / bytes_per_facet), source_(std::make_shared<StlSource>()) {}

  void read();
  SurfaceFile take(InputFile file) { return facets_.take(std::move(file), std::move(source_)); }

 private:
  /// A guess, to reserve memory: a facet with short numbers and no indentation.
  static constexpr std::size_t bytes_per_facet = 120;

  void expect(const char* wanted);
  /// "endloop" or "end loop", and so on.
  void expect_end(const std::string& of);
  /// "color" and the rest of its line.
  void skip_colours();
  Vector3 vector();
  void read_facet();

  TextCursor cursor_;
  Facets facets_;
  std::shared_ptr<StlSource> source_;
  bool coloured_ = false;
};

void StlText::expect_end(const std::string& of) {
  cursor_.skip_space();
  TextCursor ahead = cursor_;
  if (!same_word(ahead.word(), "end")) {
    expect(("end" + of).c_str());
    return;
  }
  cursor_ = ahead;
  expect(of.c_str());
}

void StlText::skip_colours() {
  for (;;) {
    cursor_.skip_space();
    TextCursor ahead = cursor_;
    const std::string_view word = ahead.word();
    if (!same_word(word, "color") && !same_word(word, "colour")) return;
    coloured_ = true;
    cursor_.skip_to_line_end();
  }
}

void StlText::expect(const char* wanted) {
  cursor_.skip_space();
  TextCursor ahead = cursor_;
  if (!same_word(ahead.word(), wanted)) cursor_.refuse_word(fmt::format("'{}'", wanted).c_str());
  cursor_ = ahead;
}

Vector3 StlText::vector() {
  Vector3 result;
  for (int k = 0; k < 3; ++k) {
    cursor_.skip_space();
    result[k] = cursor_.number("a number");
  }
  return result;
}

void StlText::read_facet() {
  if (facets_.full()) cursor_.refuse("too many triangles; split the file");
  expect("normal");
  cursor_.skip_space();
  source_->rows.push_back(cursor_.offset());
  static_cast<void>(vector());
  expect("outer");
  expect("loop");
  for (int c = 0; c < 3; ++c) {
    expect("vertex");
    facets_.add_corner(vector());
  }
  expect_end("loop");
  skip_colours();
  expect_end("facet");
}

void StlText::read() {
  bool named = false;
  do {
    expect("solid");
    cursor_.skip_blanks();
    named = named || !cursor_.at_line_end();
    cursor_.skip_to_line_end();
    for (;;) {
      skip_colours();
      TextCursor ahead = cursor_;
      const std::string_view word = ahead.word();
      if (same_word(word, "endsolid") || same_word(word, "end")) break;
      if (!same_word(word, "facet")) cursor_.refuse_word("'facet' or 'endsolid'");
      cursor_ = ahead;
      read_facet();
    }
    cursor_.skip_to_line_end();
    cursor_.skip_space();
  } while (!cursor_.at_end());
  if (facets_.count() == 0) cursor_.file().refuse("it has no triangles; choose the file of a surface");
  if (named) source_->carried.emplace_back("names of solids");
  if (coloured_) source_->carried.emplace_back("colours");
  source_->carried.emplace_back("normals of triangles");
}

}  // namespace

bool is_binary_stl(std::string_view bytes) { return promised_size(bytes) == bytes.size(); }

SurfaceFile read_stl(InputFile file) {
  // Binary files may begin with `solid` too; the size tells.
  const bool binary = is_binary_stl(file.bytes);
  const std::string_view text = file.bytes;
  const std::size_t begin = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  if (binary || !same_word(text.substr(begin, 5), "solid") || text.find('\0') != std::string_view::npos)
    return read_binary(std::move(file));
  StlText reader(file);
  reader.read();
  return reader.take(std::move(file));
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

  std::string bytes(header_size, '\0');
  bytes.replace(0, 7, "vspring");
  bytes.reserve(facets_begin + facet_size * triangles);
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
