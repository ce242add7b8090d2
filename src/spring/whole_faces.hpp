#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// The faces that rings contain in pieces only (with_large_faces_cut()), for normals that are means over whole faces.
class WholeFaces {
 public:
  /// A node of a face.
  struct Corner {
    std::optional<std::uint32_t> node;  ///< local number; none if it takes no part, so it stays
    Vector3 place;                      ///< in the coordinates of the net
  };

  WholeFaces() = default;
  /// faces: the corners of each in order around it.
  explicit WholeFaces(std::vector<std::vector<Corner>> faces);

  [[nodiscard]] bool empty() const noexcept { return faces_.empty(); }

  /// Measures all faces with their nodes at these places; call it before area(). Cost: linear in their nodes.
  void measure(std::span<const Vector3> positions);

  /// Twice the vector area of the face of a node between its neighbours `first` and `last`, in that sense around the
  /// node; none if that is no whole face. in_sense: the face must have that sense, too, as a node of two neighbours has
  /// two faces between them.
  [[nodiscard]] std::optional<Vector3> area(std::size_t node, std::size_t first, std::size_t last, bool in_sense) const;

 private:
  struct Wedge {
    std::uint32_t node;
    std::uint32_t face;
    std::uint32_t next;
    std::uint32_t previous;
  };

  std::vector<std::vector<Corner>> faces_;
  std::vector<Vector3> areas_;  // twice the vector area of each of faces_
  std::vector<Wedge> wedges_;   // by node
};

}  // namespace vspring
