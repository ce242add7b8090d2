#pragma once

#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

#include "io/input_file.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// More nodes than this are refused.
constexpr std::int64_t most_nodes = std::int64_t{1} << 30;

/// Collects faces, or lines of a curve, whose nodes may come later in the file. It remembers where the highest node
/// number stands, so a message can name it if there is no such node.
class FaceList {
 public:
  /// node: 0-based, not negative. where: its place for messages, such as an offset.
  void add_corner(std::int64_t node, std::size_t where) {
    if (node > highest_) {
      highest_ = node;
      highest_where_ = where;
    }
    // A number beyond all limits is refused later; until then 0 stands for it.
    corners_.push_back(node < most_nodes ? static_cast<Index>(node) : 0);
  }
  void end_face() { face_begin_.push_back(static_cast<Index>(corners_.size())); }

  void reserve(std::size_t faces, std::size_t corners) {
    face_begin_.reserve(faces + 1);
    corners_.reserve(corners);
  }
  [[nodiscard]] Index face_count() const { return static_cast<Index>(face_begin_.size()) - 1; }
  [[nodiscard]] std::size_t corner_count() const { return corners_.size(); }
  [[nodiscard]] bool full() const { return corners_.size() > std::numeric_limits<Index>::max() / 2; }
  [[nodiscard]] const std::vector<Index>& face_begin() const { return face_begin_; }
  [[nodiscard]] const std::vector<Index>& corners() const { return corners_; }
  [[nodiscard]] std::int64_t highest() const { return highest_; }
  [[nodiscard]] std::size_t highest_where() const { return highest_where_; }

  /// highest() must be a node.
  [[nodiscard]] PolygonMesh take(std::vector<Vector3> positions) {
    return {std::move(positions), std::move(face_begin_), std::move(corners_)};
  }

 private:
  std::vector<Index> face_begin_ = {0};
  std::vector<Index> corners_;
  std::int64_t highest_ = -1;
  std::size_t highest_where_ = 0;
};

}  // namespace vspring
