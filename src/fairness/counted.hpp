#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "shape/frame.hpp"
#include "vspring/constraints.hpp"

namespace vspring {

/// Marks the faces to measure with 1: faces of three or more nodes with finite coordinates; with constraints only those
/// at moving nodes, as the rest did not change.
std::vector<std::uint8_t> counted_faces(const PolygonMesh& mesh, const Constraints* constraints);

/// Marks the nodes of these faces with 1.
std::vector<std::uint8_t> counted_nodes(const PolygonMesh& mesh, const std::vector<std::uint8_t>& faces);

/// Marks the nodes with finite coordinates with 1.
std::vector<std::uint8_t> finite_nodes(const PolygonMesh& mesh);

/// The box around these faces.
Eigen::AlignedBox<double, 3> box_around(const PolygonMesh& mesh, const std::vector<std::uint8_t>& faces);

/// All positions in a frame.
std::vector<Vector3> placed(std::span<const Vector3> positions, const Frame& frame);

}  // namespace vspring
