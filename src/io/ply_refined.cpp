// PLY of which some faces are divided.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/file_normals.hpp"
#include "io/ply.hpp"
#include "io/ply_data.hpp"
#include "io/ply_rows.hpp"
#include "io/rewriter.hpp"
#include "shape/corner_items.hpp"

namespace vspring {

namespace {

/// Whether a whole number is a share of a colour, which has means, and no label.
bool is_colour(std::string_view property) {
  constexpr std::array<std::string_view, 5> shares = {"red", "green", "blue", "alpha", "gray"};
  constexpr std::array<std::string_view, 4> letters = {"r", "g", "b", "a"};
  return std::any_of(shares.begin(), shares.end(), [&](auto share) { return property.ends_with(share); }) ||
         std::find(letters.begin(), letters.end(), property) != letters.end();
}

/// The numbers of all nodes, row by row: those of new ones are means.
class NodeNumbers {
 public:
  NodeNumbers(const RefinedMesh& refined, std::size_t width) : refined_(refined), width_(width) {}

  template <typename Rows>
  void add_mean(Index node, const Rows& rows) {
    const auto of = refined_.means(node);
    std::vector<std::vector<double>> given;
    for (const Index other : of) given.push_back(row(other, rows));
    for (std::size_t p = 0; p < width_; ++p) {
      auto next = given.begin();
      numbers_.push_back(refined_.mean(node, [&](Index /*other*/) { return (*next++)[p]; }));
    }
    like_.push_back(of.front() < refined_.input_node_count() ? of.front() : like(of.front()));
  }
  /// node: numbered as in means.
  [[nodiscard]] std::span<const double> of(Index node) const {
    return std::span(numbers_).subspan(place(node), width_);
  }
  /// The node of the file from which a new node, numbered as in means, takes values of which there is no mean.
  [[nodiscard]] Index like(Index node) const {
    return like_[static_cast<std::size_t>(node - refined_.input_node_count())];
  }

 private:
  [[nodiscard]] std::size_t place(Index node) const {
    return width_ * static_cast<std::size_t>(node - refined_.input_node_count());
  }
  template <typename Rows>
  std::vector<double> row(Index node, const Rows& rows) const {
    if (node < refined_.input_node_count()) return rows.numbers(node);
    const auto known = of(node);
    return {known.begin(), known.end()};
  }

  const RefinedMesh& refined_;
  std::size_t width_;
  std::vector<double> numbers_;
  std::vector<Index> like_;
};

/// Numbers at the corners of the parts of one face, given those at its corners.
class CornerNumbers {
 public:
  CornerNumbers(const RefinedMesh& refined, std::span<const Index> face, const std::vector<double>& list)
      : refined_(refined), width_(face.empty() ? 0 : list.size() / face.size()) {
    for (std::size_t k = 0; k < face.size(); ++k) {
      const auto first = list.begin() + static_cast<std::ptrdiff_t>(k * width_);
      known_[face[k]].assign(first, first + static_cast<std::ptrdiff_t>(width_));
    }
  }

  std::vector<double> of(std::span<const Index> part) {
    std::vector<double> list;
    for (const Index node : part) {
      const std::vector<double>& numbers = at(node);
      list.insert(list.end(), numbers.begin(), numbers.end());
    }
    return list;
  }

 private:
  const std::vector<double>& at(Index node) {
    if (const auto found = known_.find(node); found != known_.end()) return found->second;
    std::vector<double> sum(width_, 0);
    const auto means = refined_.means(node);
    for (const Index other : means) {
      const std::vector<double>& numbers = at(other);
      for (std::size_t c = 0; c < width_; ++c) sum[c] += numbers[c] / static_cast<double>(means.size());
    }
    return known_[node] = std::move(sum);
  }

  const RefinedMesh& refined_;
  std::size_t width_;
  std::map<Index, std::vector<double>> known_;
};

/// The rows of new nodes.
template <typename Data>
std::vector<std::string> new_node_rows(const RowMaker<Data>& rows, const PlyElement& nodes, const RefinedMesh& refined,
                                       const std::array<int, 6>& fields, bool has_normals) {
  NodeNumbers numbers(refined, nodes.properties.size());
  std::vector<std::string> made;
  for (Index node = refined.kept_node_count(); node < refined.mesh.node_count(); ++node) {
    numbers.add_mean(node, rows);
    const Index number = node + static_cast<Index>(refined.removed.size());
    std::vector<double> own(numbers.of(number).begin(), numbers.of(number).end());
    const auto set = [&](std::size_t first_field, const Vector3& vector) {
      for (std::size_t k = 0; k < 3; ++k)
        own[static_cast<std::size_t>(fields[first_field + k])] = vector[static_cast<Index>(k)];
    };
    set(0, refined.mesh.position(node));
    if (has_normals) {
      const auto component = [&](std::size_t k) { return own[static_cast<std::size_t>(fields[3 + k])]; };
      set(3, unit_or_zero({component(0), component(1), component(2)}));
    }
    std::vector<std::string> values = rows.like(numbers.like(number));
    for (std::size_t p = 0; p < values.size(); ++p) {
      const PlyProperty& property = nodes.properties[p];
      if (property.count_type) continue;
      if (!is_whole(property.type))
        values[p] = rows.number(property.type, own[p], static_cast<std::size_t>(node));
      else if (is_colour(property.name))
        values[p] = rows.whole(property.type, std::llround(own[p]));
    }
    made.push_back(rows.row(values));
  }
  return made;
}

/// The rows of the parts of a face.
template <typename Data>
std::vector<std::string> rows_of_parts(const RowMaker<Data>& rows, const PlyElement& faces, Index row,
                                       std::span<const Index> face, const FaceParts& parts,
                                       const RefinedMesh& refined) {
  const auto corners = static_cast<std::size_t>(std::max(faces.find("vertex_indices"), faces.find("vertex_index")));
  const std::vector<std::string> whole = rows.like(row);
  std::vector<std::pair<std::size_t, CornerNumbers>> lists;
  for (std::size_t p = 0; p < whole.size(); ++p) {
    const PlyProperty& property = faces.properties[p];
    if (p == corners || !property.count_type || is_whole(property.type)) continue;
    // Other triangles have nodes that are no corners of the face.
    const std::vector<double> list = rows.list(row, p);
    if (refined.is_remeshed() && parts.is_divided)
      lists.emplace_back(p, CornerNumbers(refined, {}, {}));
    else if (!list.empty() && list.size() % face.size() == 0)
      lists.emplace_back(p, CornerNumbers(refined, face, list));
  }
  std::vector<std::string> made;
  for (Index part = parts.begin; part < parts.end; ++part) {
    std::vector<std::string> values = whole;
    values[corners] = rows.list(faces.properties[corners], refined.mesh.face(part));
    for (auto& [p, numbers] : lists) values[p] = rows.list(faces.properties[p], numbers.of(refined.mesh.face(part)));
    made.push_back(rows.row(values));
  }
  return made;
}

/// A piece of the file that becomes another one.
struct PlyChange {
  std::size_t begin;
  std::size_t end;
  std::string text;
};

std::string joined(const std::vector<std::string>& rows, std::string_view separator) {
  std::string text;
  for (const std::string& row : rows) {
    if (!text.empty()) text += separator;
    text += row;
  }
  return text;
}

/// New rows behind those of all nodes.
template <typename Data>
PlyChange change_of_nodes(const RowMaker<Data>& rows, const RefinedMesh& refined,
                          const std::vector<std::string>& new_rows) {
  if (refined.removed.empty()) {
    std::string text;
    for (const std::string& row : new_rows) (text += rows.separator()) += row;
    return {rows.end(), rows.end(), std::move(text)};
  }
  std::vector<std::string> all;
  all.reserve(refined.mesh.positions().size());
  const std::vector<Index> numbers = refined.numbers_in_means();
  for (Index node = 0; node < refined.kept_node_count(); ++node)
    all.push_back(rows.text(numbers[static_cast<std::size_t>(node)]));
  all.insert(all.end(), new_rows.begin(), new_rows.end());
  return {rows.begin(0), rows.end(), joined(all, rows.separator())};
}

/// Parts in the place of each divided face.
template <typename Data>
std::vector<PlyChange> changes_of_faces(const RowMaker<Data>& rows, const PlyElement& faces, const PolygonMesh& mesh,
                                        const RefinedMesh& refined) {
  std::vector<PlyChange> changes;
  const std::vector<FaceParts> parts = parts_of_faces(mesh, refined);
  std::vector<std::string> all;  // of a mesh of which faces may be gone
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const FaceParts& of = parts[static_cast<std::size_t>(f)];
    if (of.is_divided || of.is_renumbered) {
      std::vector<std::string> made = rows_of_parts(rows, faces, f, mesh.face(f), of, refined);
      if (refined.is_remeshed())
        all.insert(all.end(), std::make_move_iterator(made.begin()), std::make_move_iterator(made.end()));
      else
        changes.push_back({rows.begin(f), rows.end_of(f), joined(made, rows.separator())});
    } else if (refined.is_remeshed()) {
      all.push_back(rows.text(f));
    }
  }
  if (refined.is_remeshed()) changes.push_back({rows.begin(0), rows.end(), joined(all, rows.separator())});
  return changes;
}

template <typename Data>
std::string refined_rows(const InputFile& file, const PolygonMesh& mesh, const RefinedMesh& refined,
                         const std::array<int, 6>& fields, bool has_normals) {
  const PlyHeader header = read_ply_header(file);
  const PlyElement& nodes = *header.find("vertex");
  const PlyElement* const faces = header.find("face");
  const PlyElement* const strips = header.find("tristrips");
  if (faces == nullptr || (strips != nullptr && strips->count > 0))
    file.refuse("it has faces in strips of triangles, which cannot be divided; convert it to another format first");
  const RowMaker<Data> node_rows(file, header, nodes);
  const RowMaker<Data> face_rows(file, header, *faces);
  std::vector<PlyChange> changes = {
      {nodes.count_begin, nodes.count_end, std::to_string(refined.mesh.node_count())},
      {faces->count_begin, faces->count_end, std::to_string(refined.mesh.face_count())},
      change_of_nodes(node_rows, refined, new_node_rows(node_rows, nodes, refined, fields, has_normals))};
  std::vector<PlyChange> of_faces = changes_of_faces(face_rows, *faces, mesh, refined);
  std::move(of_faces.begin(), of_faces.end(), std::back_inserter(changes));
  if (const PlyElement* const edges = header.find("edge"); edges != nullptr && !refined.removed.empty()) {
    const RowMaker<Data> edge_rows(file, header, *edges);
    changes.push_back({edges->count_begin, edges->count_end, "0"});
    changes.push_back({edge_rows.begin(0), edge_rows.end(), ""});
  }
  std::stable_sort(changes.begin(), changes.end(),
                   [](const PlyChange& a, const PlyChange& b) { return a.begin < b.begin; });
  TextRewriter out(file.bytes);
  for (const PlyChange& change : changes) out.replace(change.begin, change.end, change.text);
  return out.finish();
}

}  // namespace

std::string PlySource::left_out_by(const RefinedMesh& refined) const {
  if (!refined.is_remeshed()) return {};
  const PlyElement* const faces = is_plain ? nullptr : header.find("face");
  const bool has_edges = !is_plain && header.find("edge") != nullptr && !refined.removed.empty();
  const bool has_lists = faces != nullptr && std::count_if(faces->properties.begin(), faces->properties.end(),
                                                           [](const PlyProperty& property) {
                                                             return property.count_type && !is_whole(property.type);
                                                           }) > 0;
  if (!has_edges && !has_lists) return {};
  return fmt::format("{}: left out where nodes are others: {}", file.name,
                     has_edges && has_lists ? "the element edge, and lists of numbers at corners of new triangles"
                     : has_edges            ? "the element edge"
                                            : "lists of numbers at corners of new triangles");
}

SurfaceFile PlySource::refined(const RefinedMesh& refined) const {
  SurfaceFile surface;
  surface.mesh = mesh;
  const Rewrite unmoved{surface, mesh.positions(), std::vector<std::uint8_t>(mesh.positions().size(), 0), {}};
  InputFile whole = {file.name, {}};
  if (is_plain)
    whole.bytes = with_plain_data(mesh.positions());
  else
    // Between whole numbers new nodes would have no place.
    whole.bytes = any_whole(0) ? rebuilt(unmoved, {}) : file.bytes;
  const bool means_of_normals = has_normals() && !any_whole(3);
  std::string bytes = header.encoding == PlyEncoding::text
                          ? refined_rows<PlyText>(whole, mesh, refined, fields, means_of_normals)
                          : refined_rows<PlyBinary>(whole, mesh, refined, fields, means_of_normals);
  return read_ply({file.name, std::move(bytes)});
}

}  // namespace vspring
