// STL, text and binary. Corners at the same position become one node; the file stays a list of triangles.
#include "io/stl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/binary_numbers.hpp"
#include "io/face_list.hpp"
#include "io/text_cursor.hpp"
#include "vspring/error.hpp"

namespace vspring {
namespace {

/// Bytes of a binary file according to its number of facets; 0 if it is too short to have one.
std::size_t promised_size(std::string_view bytes) {
  if (bytes.size() < stl_facets_begin) return 0;
  return stl_facets_begin +
         stl_facet_size * std::size_t{load<std::uint32_t>(bytes.data() + stl_header_size, little_swapped)};
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
  const std::size_t facets = (promised - stl_facets_begin) / stl_facet_size;
  if (promised > file.bytes.size())
    file.refuse(
        fmt::format("its header counts {} triangles, which take {} bytes, but it has {}; it is cut off, or not STL",
                    facets, promised, file.bytes.size()));
  if (facets == 0) file.refuse("it has no triangles; choose the file of a surface");
  Facets list(facets);
  std::set<std::string> carried = {"normals of triangles"};
  for (std::size_t facet = 0; facet < facets; ++facet) {
    if (list.full()) file.refuse("too many triangles; split the file");
    const char* const record = file.bytes.data() + stl_facets_begin + facet * stl_facet_size;
    for (std::size_t c = 1; c <= 3; ++c) {
      Vector3 position;
      for (std::size_t k = 0; k < 3; ++k)
        position[static_cast<Index>(k)] = static_cast<double>(load<float>(record + 12 * c + 4 * k, little_swapped));
      list.add_corner(position);
    }
    if (record[48] != 0 || record[49] != 0) carried.insert("attributes of triangles");
  }
  const std::string_view header(file.bytes.data(), stl_header_size);
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

}  // namespace vspring
