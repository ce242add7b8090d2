// PLY of which some faces are divided.
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
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
    std::vector<double> sum(width_, 0);
    for (const Index other : of) {
      const auto numbers = row(other, rows);
      for (std::size_t p = 0; p < width_; ++p) sum[p] += numbers[p];
    }
    for (double& value : sum) value /= static_cast<double>(of.size());
    numbers_.insert(numbers_.end(), sum.begin(), sum.end());
    like_.push_back(of.front() < refined_.input_node_count() ? of.front() : like(of.front()));
  }
  [[nodiscard]] std::span<const double> of(Index node) const {
    return std::span(numbers_).subspan(place(node), width_);
  }
  /// The node of the file from which a new node takes values of which there is no mean.
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
      : refined_(refined), width_(list.size() / face.size()) {
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
std::string new_node_rows(const RowMaker<Data>& rows, const PlyElement& nodes, const RefinedMesh& refined,
                          const std::array<int, 6>& fields, bool has_normals) {
  NodeNumbers numbers(refined, nodes.properties.size());
  std::string text;
  for (Index node = refined.input_node_count(); node < refined.mesh.node_count(); ++node) {
    numbers.add_mean(node, rows);
    std::vector<double> own(numbers.of(node).begin(), numbers.of(node).end());
    const auto set = [&](std::size_t first_field, const Vector3& vector) {
      for (std::size_t k = 0; k < 3; ++k)
        own[static_cast<std::size_t>(fields[first_field + k])] = vector[static_cast<Index>(k)];
    };
    set(0, refined.mesh.position(node));
    if (has_normals) {
      const auto component = [&](std::size_t k) { return own[static_cast<std::size_t>(fields[3 + k])]; };
      set(3, unit_or_zero({component(0), component(1), component(2)}));
    }
    std::vector<std::string> values = rows.like(numbers.like(node));
    for (std::size_t p = 0; p < values.size(); ++p) {
      const PlyProperty& property = nodes.properties[p];
      if (property.count_type) continue;
      if (!is_whole(property.type))
        values[p] = rows.number(property.type, own[p], static_cast<std::size_t>(node));
      else if (is_colour(property.name))
        values[p] = rows.whole(property.type, std::llround(own[p]));
    }
    (text += rows.separator()) += rows.row(values);
  }
  return text;
}

/// The rows of the parts of a face.
template <typename Data>
std::string rows_of_parts(const RowMaker<Data>& rows, const PlyElement& faces, std::span<const Index> face,
                          const FaceParts& parts, const RefinedMesh& refined) {
  const Index row = refined.face_from[static_cast<std::size_t>(parts.begin)];
  const auto corners = static_cast<std::size_t>(std::max(faces.find("vertex_indices"), faces.find("vertex_index")));
  const std::vector<std::string> whole = rows.like(row);
  std::vector<std::pair<std::size_t, CornerNumbers>> lists;
  for (std::size_t p = 0; p < whole.size(); ++p) {
    const PlyProperty& property = faces.properties[p];
    if (p == corners || !property.count_type || is_whole(property.type)) continue;
    const std::vector<double> list = rows.list(row, p);
    if (!list.empty() && list.size() % face.size() == 0) lists.emplace_back(p, CornerNumbers(refined, face, list));
  }
  std::string text;
  for (Index part = parts.begin; part < parts.end; ++part) {
    std::vector<std::string> values = whole;
    values[corners] = rows.list(faces.properties[corners], refined.mesh.face(part));
    for (auto& [p, numbers] : lists) values[p] = rows.list(faces.properties[p], numbers.of(refined.mesh.face(part)));
    if (part > parts.begin) text += rows.separator();
    text += rows.row(values);
  }
  return text;
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
  struct Change {
    std::size_t begin;
    std::size_t end;
    std::string text;
  };
  const RowMaker<Data> node_rows(file, header, nodes);
  const RowMaker<Data> face_rows(file, header, *faces);
  std::vector<Change> changes = {
      {nodes.count_begin, nodes.count_end, std::to_string(refined.mesh.node_count())},
      {faces->count_begin, faces->count_end, std::to_string(refined.mesh.face_count())},
      {node_rows.end(), node_rows.end(), new_node_rows(node_rows, nodes, refined, fields, has_normals)}};
  const std::vector<FaceParts> parts = parts_of_faces(mesh, refined);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const FaceParts& of = parts[static_cast<std::size_t>(f)];
    if (!of.is_divided) continue;
    std::size_t end = f + 1 < mesh.face_count() ? face_rows.begin(f + 1) : face_rows.end();
    if (!face_rows.separator().empty()) {
      while (is_space(file.bytes[end - 1])) --end;
    }
    changes.push_back({face_rows.begin(f), end, rows_of_parts(face_rows, *faces, mesh.face(f), of, refined)});
  }
  std::stable_sort(changes.begin(), changes.end(), [](const Change& a, const Change& b) { return a.begin < b.begin; });
  TextRewriter out(file.bytes);
  for (const Change& change : changes) out.replace(change.begin, change.end, change.text);
  return out.finish();
}

}  // namespace

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
