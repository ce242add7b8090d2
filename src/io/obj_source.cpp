// Writes an OBJ file again: coordinates, normals, and new nodes and faces.
#include "io/obj_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <map>
#include <string_view>
#include <tuple>
#include <utility>

#include "io/obj_statements.hpp"
#include "io/rewriter.hpp"

namespace vspring {

namespace {

/// Where the corners of faces name their normals.
class ObjNormalWords : public ObjStatements {
 public:
  explicit ObjNormalWords(const InputFile& file) : ObjStatements(file) { read(); }

  struct Word {
    std::size_t begin;
    std::size_t end;
  };
  std::vector<Word> of_corner;  ///< empty for a corner without a normal
  bool counts_back = false;     ///< some number counts back from its place

 protected:
  bool read_element(std::string_view keyword) override {
    if (keyword != "f") return false;
    for (cursor_.skip_blanks(); !cursor_.at_line_end() && cursor_.peek() != '#'; cursor_.skip_blanks()) {
      const std::size_t begin = cursor_.offset();
      const std::string_view corner = cursor_.word();
      const bool has_normal = std::count(corner.begin(), corner.end(), '/') == 2;
      const std::size_t end = begin + corner.size();
      const Word& word = of_corner.emplace_back(Word{has_normal ? begin + corner.rfind('/') + 1 : end, end});
      counts_back = counts_back || (word.begin < end && file_.bytes[word.begin] == '-');
    }
    return true;
  }
};

}  // namespace

ObjSource::NewLines ObjSource::new_lines(const Rewrite& rewrite) const {
  NewLines lines;
  if (corner_normals.empty()) return lines;
  PartedNormals parts = part_normals(mesh, corner_normals, normals.size());
  std::vector<Vector3> before;
  before.reserve(parts.of_file.size());
  for (const Index normal : parts.of_file) before.push_back(normals[static_cast<std::size_t>(normal)]);
  NewNormals fresh = compute_normals(mesh, parts.of_corner, before, mesh.positions(), rewrite.positions, rewrite.moved);
  if (before.size() == normals.size()) {
    lines.of_file = std::move(fresh);
    lines.of_corner = corner_normals;
    return lines;
  }
  lines.of_file = {std::vector<std::uint8_t>(normals.size(), 0), std::vector<Vector3>(normals.size(), Vector3::Zero())};
  std::vector<std::uint8_t> stays(normals.size(), 0);
  for (std::size_t part = 0; part < before.size(); ++part) {
    if (fresh.due[part] == 0) stays[static_cast<std::size_t>(parts.of_file[part])] = 1;
  }
  using Value = std::tuple<Index, double, double, double>;
  std::map<Value, Index> known;
  std::vector<Index> line_of(before.size());
  for (std::size_t part = 0; part < before.size(); ++part) {
    const Index normal = parts.of_file[part];
    const auto line = static_cast<std::size_t>(normal);
    line_of[part] = normal;
    if (fresh.due[part] == 0) continue;
    const Vector3& value = fresh.normals[part];
    if (stays[line] == 0 && lines.of_file.due[line] == 0) {
      lines.of_file.due[line] = 1;
      lines.of_file.normals[line] = value;
    }
    const Vector3& in_file = stays[line] != 0 ? normals[line] : lines.of_file.normals[line];
    if (value == in_file) continue;
    const auto [found, is_new] = known.try_emplace(Value(normal, value.x(), value.y(), value.z()),
                                                   static_cast<Index>(normals.size() + lines.added.size()));
    if (is_new) lines.added.push_back(value);
    line_of[part] = found->second;
  }
  lines.of_corner = std::move(parts.of_corner);
  for (Index& corner : lines.of_corner) corner = corner < 0 ? -1 : line_of[static_cast<std::size_t>(corner)];
  return lines;
}

std::string ObjSource::rewritten(Rewrite& rewrite) const {
  const NewLines lines = new_lines(rewrite);
  const NewNormals& fresh = lines.of_file;
  std::string rows;
  for (const Vector3& normal : lines.added) {
    rows += "vn ";
    append_numbers(rows, normal);
    rows += line_ending(file.bytes);
  }
  std::vector<ObjNormalWords::Word> words;
  std::size_t place = std::string::npos;
  if (!rows.empty()) {
    ObjNormalWords found(file);
    words = std::move(found.of_corner);
    // Behind the last one, so that they stand above the faces; at the end where numbers count back.
    place = found.counts_back ? file.bytes.size() : behind_line(file.bytes, normal_rows.back());
    if (place == file.bytes.size()) rows.insert(0, missing_line_end(file.bytes));
  }
  TextRewriter out(file.bytes);
  std::size_t normal = 0;
  std::size_t corner = 0;
  const auto skip_unchanged = [&] {
    while (normal < fresh.due.size() && fresh.due[normal] == 0) ++normal;
    while (corner < words.size() && lines.of_corner[corner] == corner_normals[corner]) ++corner;
  };
  /// All changes that stand before a place, but for those of nodes.
  const auto change_before = [&](std::size_t offset) {
    for (skip_unchanged();; skip_unchanged()) {
      const std::size_t at_normal = normal < fresh.due.size() ? normal_rows[normal] : std::string::npos;
      const std::size_t at_corner = corner < words.size() ? words[corner].begin : std::string::npos;
      const std::size_t least = std::min({at_normal, at_corner, place});
      if (least >= offset) return;
      if (least == at_normal) {
        out.replace_words(at_normal, row_of(fresh.normals[normal++]));
      } else if (least == at_corner) {
        out.replace(at_corner, words[corner].end, fmt::to_string(lines.of_corner[corner] + 1));
        ++corner;
      } else {
        out.replace(place, place, rows);
        place = std::string::npos;
      }
    }
  };
  for (std::size_t node = 0; node < node_rows.size(); ++node) {
    change_before(node_rows[node]);
    if (rewrite.moved[node] != 0) out.replace_words(node_rows[node], row_of(rewrite.positions[node]));
  }
  change_before(std::string::npos);
  std::string text = out.finish();
  append_added(text, rewrite, lines);
  return text;
}

void ObjSource::append_added(std::string& text, const Rewrite& rewrite, const NewLines& lines) const {
  const AddedElements& added = rewrite.surface.added;
  if (added.face_like.empty()) return;
  text += missing_line_end(text);
  const std::string_view line_end = line_ending(text);
  const auto append_row = [&](const char* keyword, const Vector3& row, std::string_view rest) {
    text += keyword;
    append_numbers(text, row);
    if (!rest.empty()) (text += ' ') += rest;
    text += line_end;
  };
  for (std::size_t k = 0; k < added.node_like.size(); ++k)
    append_row("v ", rewrite.positions[node_rows.size() + k],
               behind_words(file.bytes, node_rows[static_cast<std::size_t>(added.node_like[k])], 3));
  // Per node of the file one of its `vn`.
  std::vector<Index> normal_of(rewrite.positions.size(), -1);
  for (std::size_t corner = corner_normals.size(); corner-- > 0;) {
    if (lines.of_corner[corner] >= 0)
      normal_of[static_cast<std::size_t>(mesh.corners()[corner])] = lines.of_corner[corner];
  }
  if (!corner_normals.empty()) {
    const std::vector<Vector3> more =
        normals_of_added(rewrite.surface.mesh, rewrite.surface.normals, rewrite.positions, added.node_like);
    for (std::size_t k = 0; k < more.size(); ++k) {
      append_row("vn ", more[k], {});
      normal_of[node_rows.size() + k] = static_cast<Index>(normals.size() + lines.added.size() + k);
    }
  }
  auto group = added.groups.begin();
  for (Index f = mesh.face_count(); f < rewrite.surface.mesh.face_count(); ++f) {
    for (; group != added.groups.end() && group->first == f; ++group) ((text += "g ") += group->second) += line_end;
    const auto face = rewrite.surface.mesh.face(f);
    const bool has_normals = std::all_of(face.begin(), face.end(),
                                         [&](Index node) { return normal_of[static_cast<std::size_t>(node)] >= 0; });
    text += 'f';
    for (const Index node : face) {
      text += ' ';
      append_whole(text, static_cast<std::size_t>(node) + 1);
      if (!has_normals) continue;
      text += "//";
      append_whole(text, static_cast<std::size_t>(normal_of[static_cast<std::size_t>(node)]) + 1);
    }
    text += line_end;
  }
}

}  // namespace vspring
