// OFF with other positions, with added nodes and faces, with divided faces, and made anew.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "io/file_normals.hpp"
#include "io/off.hpp"
#include "io/rewriter.hpp"
#include "shape/corner_items.hpp"
#include "vspring/error.hpp"

namespace vspring {

namespace {

/// Bit by bit, as a coordinate may be NaN: nodes that do not move keep it.
bool same_places(const std::vector<Vector3>& some, const std::vector<Vector3>& others) {
  return std::equal(some.begin(), some.end(), others.begin(), others.end(), [](const Vector3& a, const Vector3& b) {
    return ((a.array() == b.array()) || (a.array().isNaN() && b.array().isNaN())).all();
  });
}

bool reads_as(const std::string& text, const PolygonMesh& mesh, const Rewrite& rewrite) {
  std::vector<Vector3> expected = mesh.positions();
  for (std::size_t node = 0; node < expected.size(); ++node)
    if (rewrite.moved[node] != 0) expected[node] = rewrite.positions[node];
  try {
    const PolygonMesh read = read_off({"", text}).mesh;
    return same_places(read.positions(), expected) && read.has_same_faces(mesh);
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

std::string OffSource::rewritten(Rewrite& rewrite) const {
  const SurfaceFile& surface = rewrite.surface;
  NewNormals fresh;
  if (normal_column > 0 && surface.normals.size() == rows.size())
    fresh = compute_normals(mesh, mesh.corners(), surface.normals, mesh.positions(), rewrite.positions, rewrite.moved);
  const bool is_longer = !surface.added.face_like.empty();
  if (is_longer && in_stream)
    file.refuse(
        "its lines do not say where nodes end, so that none can be added; write it in another format, such as "
        "PLY");
  TextRewriter out(file.bytes, /*commented=*/true);
  if (is_longer) {
    replace_count(out, nodes_begin, surface.mesh.node_count());
    replace_count(out, faces_begin, surface.mesh.face_count());
  }
  std::vector<NewNumber> numbers;
  for (std::size_t node = 0; node < rows.size(); ++node) {
    numbers.clear();
    if (rewrite.moved[node] != 0) {
      for (int k = 0; k < 3; ++k) numbers.push_back({k, rewrite.positions[node][k]});
    }
    if (!fresh.due.empty() && fresh.due[node] != 0) {
      for (int k = 0; k < 3; ++k) numbers.push_back({normal_column + k, fresh.normals[node][k]});
    }
    if (!numbers.empty()) out.replace_words(rows[node], numbers);
  }
  if (is_longer) {
    const std::size_t end = std::min(file.bytes.find_first_of("\r\n", rows.back()), file.bytes.size());
    out.replace(end, end, added_nodes(rewrite));
  }
  std::string text = out.finish();
  if (is_longer) {
    text += missing_line_end(text);
    for (Index f = mesh.face_count(); f < surface.mesh.face_count(); ++f) {
      const auto face = surface.mesh.face(f);
      append_whole(text, face.size());
      for (const Index node : face) append_whole(text += ' ', static_cast<std::size_t>(node));
      text += line_ending(file.bytes);
    }
  }
  if (in_stream && !reads_as(text, surface.mesh, rewrite))
    file.refuse(
        "with other coordinates its lines and numbers could be read in another way; write it in another format, such "
        "as "
        "PLY");
  return text;
}

void OffSource::replace_count(TextRewriter& out, std::size_t begin, Index count) const {
  const std::size_t digits = file.bytes.find_first_not_of("+0123456789", begin);
  out.replace(begin, std::min(digits, file.bytes.size()), std::to_string(count));
}

SurfaceFile OffSource::refined(const RefinedMesh& refined) const {
  if (in_stream)
    file.refuse("its lines do not say where nodes end, so that none can be added; convert it to PLY first");
  TextRewriter out(file.bytes);
  replace_count(out, nodes_begin, refined.mesh.node_count());
  replace_count(out, faces_begin, refined.mesh.face_count());
  const std::size_t end = std::min(file.bytes.find_first_of("\r\n", rows.back()), file.bytes.size());
  for (const Index node : refined.removed) {
    const auto i = static_cast<std::size_t>(node);
    out.replace(rows[i], i + 1 < rows.size() ? rows[i + 1] : end, "");
  }
  out.replace(end, end, new_nodes(refined));
  divide_faces(out, refined);
  return read_off({file.name, out.finish()});
}

/// Lines, each preceded by a line end. Whole numbers behind the coordinates, such as shares of colours, stay whole.
std::string OffSource::new_nodes(const RefinedMesh& refined) const {
  std::vector<std::vector<double>> more;
  std::vector<std::uint8_t> is_whole;  // per number of a row
  for (const std::size_t row : rows) {
    const InputFile rest = {file.name, std::string(behind_words(file.bytes, row, 3))};
    std::vector<double> numbers;
    TextCursor cursor(rest);
    for (cursor.skip_space(); !cursor.at_end(); cursor.skip_space()) {
      const std::size_t begin = cursor.offset();
      numbers.push_back(cursor.number("a number"));
      is_whole.resize(std::max(is_whole.size(), numbers.size()), 1);
      if (rest.bytes.find_first_of(".eE", begin) < cursor.offset()) is_whole[numbers.size() - 1] = 0;
    }
    more.push_back(std::move(numbers));
  }
  std::string text;
  for (Index node = refined.kept_node_count(); node < refined.mesh.node_count(); ++node) {
    append_numbers(text += line_ending(file.bytes), refined.mesh.position(node));
    std::vector<double> numbers;
    for (std::size_t c = 0; c < more.front().size(); ++c)
      numbers.push_back(refined.mean(node, [&](Index other) { return more[static_cast<std::size_t>(other)][c]; }));
    if (normal_column >= 3) {
      double* const normal = numbers.data() + normal_column - 3;
      const Vector3 unit = unit_or_zero({normal[0], normal[1], normal[2]});
      std::copy(unit.begin(), unit.end(), normal);
      std::fill_n(is_whole.begin() + normal_column - 3, 3, std::uint8_t{0});
    }
    for (std::size_t c = 0; c < numbers.size(); ++c)
      append_number(text += ' ', is_whole[c] != 0 ? std::round(numbers[c]) : numbers[c]);
    more.push_back(std::move(numbers));
  }
  return text;
}

void OffSource::divide_faces(TextRewriter& out, const RefinedMesh& refined) const {
  OffCursor cursor(file);
  cursor.skip(rows.back());
  cursor.skip_comment();
  const std::vector<FaceParts> all_parts = parts_of_faces(mesh, refined);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    cursor.skip_to_word();
    const std::size_t begin = cursor.offset();
    std::size_t end = begin;
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k <= face.size(); ++k) {
      const auto expected = k == 0 ? static_cast<std::int64_t>(face.size()) : std::int64_t{face[k - 1]};
      if (cursor.skip_to_row_end() || cursor.whole_word("a number") != expected)
        file.refuse("it has no line for each face, so that none can be divided; convert it to PLY first");
      end = cursor.offset();
    }
    cursor.skip_comment();
    const FaceParts& parts = all_parts[static_cast<std::size_t>(f)];
    if (!parts.is_divided && !parts.is_renumbered) continue;
    const std::string_view colour = behind_words(file.bytes, end, 0);
    std::string text;
    for (Index part = parts.begin; part < parts.end; ++part) {
      const auto corners = refined.mesh.face(part);
      append_whole(text, corners.size());
      for (const Index node : corners) append_whole(text += ' ', static_cast<std::size_t>(node));
      if (part + 1 == parts.end) break;
      if (!colour.empty()) (text += ' ') += colour;
      text += line_ending(file.bytes);
    }
    out.replace(begin, end, text);
  }
}

/// Lines, each preceded by a line end.
std::string OffSource::added_nodes(const Rewrite& rewrite) const {
  const SurfaceFile& surface = rewrite.surface;
  const std::vector<Index>& like = surface.added.node_like;
  std::vector<Vector3> normals;
  if (normal_column > 0 && surface.normals.size() == rows.size())
    normals = normals_of_added(surface.mesh, surface.normals, rewrite.positions, like);
  std::string text;
  for (std::size_t k = 0; k < like.size(); ++k) {
    std::string row = "0 0 0 ";
    row += behind_words(file.bytes, rows[static_cast<std::size_t>(like[k])], 3);
    while (row.back() == ' ') row.pop_back();
    TextRewriter out(row);
    const auto place = row_of(rewrite.positions[rows.size() + k]);
    std::vector<NewNumber> numbers(place.begin(), place.end());
    for (int c = 0; c < 3 && !normals.empty(); ++c) numbers.push_back({normal_column + c, normals[k][c]});
    out.replace_words(0, numbers);
    (text += line_ending(file.bytes)) += out.finish();
  }
  return text;
}

std::string fresh_off(const PolygonMesh& mesh, std::span<const Vector3> positions, std::span<const Vector3> normals) {
  std::string text = fmt::format("{}OFF\n{} {} 0\n", normals.empty() ? "" : "N", positions.size(), mesh.face_count());
  text.reserve(60 * (positions.size() + normals.size()) + 10 * mesh.corners().size());
  for (std::size_t node = 0; node < positions.size(); ++node) {
    append_numbers(text, positions[node]);
    if (!normals.empty()) {
      text += ' ';
      append_numbers(text, normals[node]);
    }
    text += '\n';
  }
  for (Index f = 0; f < mesh.face_count(); ++f) {
    append_whole(text, mesh.face(f).size());
    for (const Index node : mesh.face(f)) {
      text += ' ';
      append_whole(text, static_cast<std::size_t>(node));
    }
    text += '\n';
  }
  return text;
}

}  // namespace vspring
