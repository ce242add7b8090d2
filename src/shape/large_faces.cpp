#include "shape/large_faces.hpp"

#include <algorithm>
#include <utility>
#include <vector>

#include "shape/incidence.hpp"

namespace vspring {

namespace {

constexpr std::size_t largest_piece = 16;
// Edges of a face between two nodes that a cut joins.
constexpr std::size_t edges_of_piece = 8;

class FaceCutter {
 public:
  explicit FaceCutter(const PolygonMesh& mesh) : mesh_(&mesh), incidence_(mesh) {}

  /// The pieces of a face; none if it must stay whole.
  std::vector<std::vector<Index>> cut(std::span<const Index> face) {
    std::vector<std::vector<Index>> pieces;
    std::vector<std::pair<Index, Index>> joined;
    std::vector<Index> rest(face.begin(), face.end());
    while (rest.size() > largest_piece) {
      std::vector<Index> inner;
      for (std::size_t begin = 0; begin < rest.size(); begin += edges_of_piece) {
        const std::size_t end = std::min(begin + edges_of_piece, rest.size());
        inner.push_back(rest[begin]);
        std::vector<Index> piece(rest.begin() + static_cast<std::ptrdiff_t>(begin),
                                 rest.begin() + static_cast<std::ptrdiff_t>(end));
        piece.push_back(rest[end % rest.size()]);
        // A single edge at the end stays in the inner polygon.
        if (piece.size() < 3) continue;
        if (!may_join(piece.front(), piece.back())) return {};
        joined.emplace_back(std::minmax(piece.front(), piece.back()));
        pieces.push_back(std::move(piece));
      }
      rest = std::move(inner);
    }
    pieces.push_back(std::move(rest));
    cuts_.insert(joined.begin(), joined.end());
    return pieces;
  }

  std::set<std::pair<Index, Index>> take() && { return std::move(cuts_); }

 private:
  [[nodiscard]] bool may_join(Index a, Index b) const {
    if (a == b || cuts_.contains(std::minmax(a, b))) return false;
    const auto corners = incidence_.corners(a);
    return std::none_of(corners.begin(), corners.end(), [&](Corner corner) {
      const auto face = mesh_->face(corner.face);
      const auto place = static_cast<std::size_t>(corner.place);
      return face[(place + 1) % face.size()] == b || face[(place + face.size() - 1) % face.size()] == b;
    });
  }

  const PolygonMesh* mesh_;
  Incidence incidence_;
  std::set<std::pair<Index, Index>> cuts_;
};

}  // namespace

std::optional<CutMesh> with_large_faces_cut(const PolygonMesh& mesh) {
  const auto is_large = [&](Index f) { return mesh.face(f).size() > largest_uncut_face; };
  bool any = false;
  for (Index f = 0; f < mesh.face_count() && !any; ++f) any = is_large(f);
  if (!any) return std::nullopt;
  FaceCutter cutter(mesh);
  MeshBuilder builder;
  for (const Vector3& position : mesh.positions()) builder.add_node(position);
  std::vector<std::vector<Index>> pieces;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    std::vector<std::vector<Index>> cut;
    if (is_large(f)) cut = cutter.cut(mesh.face(f));
    if (cut.empty()) builder.add_face(mesh.face(f));
    pieces.insert(pieces.end(), cut.begin(), cut.end());
  }
  for (const auto& piece : pieces) builder.add_face(piece);
  return CutMesh{builder.take(), std::move(cutter).take()};
}

}  // namespace vspring
