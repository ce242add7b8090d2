#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shape/frame.hpp"
#include "vspring/constraints.hpp"

namespace vspring {

/// The faces that are measured, 1, and the others, 0: faces of three or more nodes with finite coordinates; with
/// constraints only those at moving nodes, as the rest of the shape says nothing about what was done.
std::vector<std::uint8_t> counted_faces(const PolygonMesh& mesh, const Constraints* constraints);

/// The nodes of these faces: 1, else 0.
std::vector<std::uint8_t> counted_nodes(const PolygonMesh& mesh, const std::vector<std::uint8_t>& faces);

/// The nodes with finite coordinates: 1, else 0.
std::vector<std::uint8_t> finite_nodes(const PolygonMesh& mesh);

/// The box around these faces.
Eigen::AlignedBox<double, 3> box_around(const PolygonMesh& mesh, const std::vector<std::uint8_t>& faces);

/// All positions in a frame.
std::vector<Vector3> placed(std::span<const Vector3> positions, const Frame& frame);

}  // namespace vspring
