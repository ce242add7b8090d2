#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// The faces that rings know in pieces only (with_large_faces_cut()), for normals that are means over whole faces.
class WholeFaces {
 public:
  /// A node of a face.
  struct Corner {
    std::optional<std::uint32_t> node;  ///< local; none where it takes no part, and so stays
    Vector3 place;                      ///< in the coordinates of the net
  };

  WholeFaces() = default;
  /// Of each face the corners in order around it.
  explicit WholeFaces(std::vector<std::vector<Corner>> faces);

  [[nodiscard]] bool empty() const noexcept { return faces_.empty(); }

  /// Of all faces with their nodes at these places, before area() is asked for. Cost: linear in their nodes.
  void measure(std::span<const Vector3> positions);

  /// Twice the vector area of the face that a node has between its neighbours `first` and `last`, in that sense around
  /// the node; none where that face is not one of these. in_sense: only where the face has that sense, too, as a node
  /// of two neighbours has two faces between them.
  [[nodiscard]] std::optional<Vector3> area(std::size_t node, std::size_t first, std::size_t last, bool in_sense) const;

 private:
  struct Wedge {
    std::uint32_t node;
    std::uint32_t face;
    std::uint32_t next;
    std::uint32_t previous;
  };

  std::vector<std::vector<Corner>> faces_;
  std::vector<Vector3> areas_;  // of faces_, twice
  std::vector<Wedge> wedges_;   // by node
};

}  // namespace vspring
