// STL, text and binary. Corners at the same position become one node; the file stays a list of triangles.
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <set>
#include <utility>

#include "io/byte_order.hpp"
#include "io/face_list.hpp"
#include "io/stl_source.hpp"
#include "io/stl_weld.hpp"
#include "io/text_cursor.hpp"
#include "vspring/error.hpp"

namespace vspring {
namespace {

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
  source->positions = weld_.positions;
  source->corner_count = faces.corner_count();
  surface.mesh = faces.take(std::move(weld_.positions));
  source->corner_nodes = std::move(nodes_);
  source->file = std::move(file);
  surface.source = std::move(source);
  return surface;
}

SurfaceFile read_binary(InputFile file) {
  const std::size_t promised = stl::promised_size(file.bytes);
  if (promised == 0) file.refuse("it is too short for STL; choose another file");
  const std::size_t facets = (promised - stl::facets_begin) / stl::facet_size;
  if (promised != file.bytes.size())
    file.refuse(fmt::format("{} triangles are promised, which take {} bytes, but it has {}; it is cut off, or not STL",
                            facets, promised, file.bytes.size()));
  if (facets == 0) file.refuse("it has no triangles; choose the file of a surface");
  Facets list(facets);
  std::set<std::string> carried = {"normals of triangles"};
  for (std::size_t facet = 0; facet < facets; ++facet) {
    if (list.full()) file.refuse("too many triangles; split the file");
    const char* const record = file.bytes.data() + stl::facets_begin + facet * stl::facet_size;
    for (std::size_t c = 1; c <= 3; ++c) {
      Vector3 position;
      for (std::size_t k = 0; k < 3; ++k)
        position[static_cast<Index>(k)] = static_cast<double>(load<float>(record + 12 * c + 4 * k, little_swapped));
      list.add_corner(position);
    }
    if (record[48] != 0 || record[49] != 0) carried.insert("attributes of triangles");
  }
  const std::string_view header(file.bytes.data(), stl::header_size);
  if (header.find_first_not_of(std::string_view("\0 ", 2)) != std::string_view::npos)
    carried.insert("the header's text");
  auto source = std::make_shared<StlSource>();
  source->carried.assign(carried.begin(), carried.end());
  return list.take(std::move(file), std::move(source));
}

bool same_word(std::string_view word, std::string_view wanted) {
  return std::equal(word.begin(), word.end(), wanted.begin(), wanted.end(),
                    [](char a, char b) { return std::tolower(static_cast<unsigned char>(a)) == b; });
}

class StlText {
 public:
  explicit StlText(const InputFile& file)
      : cursor_(file), facets_(file.bytes.size() / bytes_per_facet), source_(std::make_shared<StlSource>()) {}

  void read();
  SurfaceFile take(InputFile file) { return facets_.take(std::move(file), std::move(source_)); }

 private:
  /// Of a facet with short numbers and no indentation; a guess to reserve room by.
  static constexpr std::size_t bytes_per_facet = 120;

  void expect(const char* wanted);
  Vector3 vector();
  void read_facet();

  TextCursor cursor_;
  Facets facets_;
  std::shared_ptr<StlSource> source_;
};

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
  expect("endloop");
  expect("endfacet");
}

void StlText::read() {
  bool named = false;
  do {
    expect("solid");
    cursor_.skip_blanks();
    named = named || !cursor_.at_line_end();
    cursor_.skip_to_line_end();
    for (;;) {
      cursor_.skip_space();
      TextCursor ahead = cursor_;
      const std::string_view word = ahead.word();
      if (same_word(word, "endsolid")) break;
      if (!same_word(word, "facet")) cursor_.refuse_word("'facet' or 'endsolid'");
      cursor_ = ahead;
      read_facet();
    }
    cursor_.skip_to_line_end();
    cursor_.skip_space();
  } while (!cursor_.at_end());
  if (facets_.count() == 0) cursor_.file().refuse("it has no triangles; choose the file of a surface");
  if (named) source_->carried.emplace_back("names of solids");
  source_->carried.emplace_back("normals of triangles");
}

}  // namespace

SurfaceFile read_stl(InputFile file) {
  // Binary files may begin with `solid` too; the size tells.
  const bool binary = stl::promised_size(file.bytes) == file.bytes.size();
  const std::string_view text = file.bytes;
  const std::size_t begin = std::min(text.find_first_not_of(" \t\r\n"), text.size());
  if (binary || !same_word(text.substr(begin, 5), "solid") || text.find('\0') != std::string_view::npos)
    return read_binary(std::move(file));
  StlText reader(file);
  reader.read();
  return reader.take(std::move(file));
}

}  // namespace vspring
