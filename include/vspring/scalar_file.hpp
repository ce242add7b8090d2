#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "vspring/export.hpp"
#include "vspring/output_file.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"

namespace VSPRING_API vspring {

/// A number for every node.
struct NodeScalar {
  std::string name;            ///< of letters, digits and underscores
  std::vector<double> values;  ///< one per node
};

/// Formats of shapes with numbers at their nodes.
enum class ScalarFormat { vtp, ply };

/// "vtp" or "ply" in any case, with or without a dot before it; empty for anything else.
[[nodiscard]] std::optional<ScalarFormat> scalar_format(std::string_view extension);

/// Writes a shape with numbers at its nodes, for ParaView and the like. path: a file, whose extension gives the format.
/// VTP: VTK's XML of polygonal data, version 1.0, in text; faces as polygons, chains as lines. PLY: binary, surfaces
/// only; numbers as vertex properties in double precision. Nodes keep their order. The file appears whole or not at
/// all, see write_file().
///
/// Throws Error(unusable_file) when it cannot be written; Error(invalid_argument) for another extension, for a curve as
/// PLY, unless there is one value per node, for values or positions that are not finite, and for a name with anything
/// but letters, digits and underscores. Cost: linear.
void write_scalars(const std::string& path, const PolygonMesh& mesh, std::span<const NodeScalar> scalars);
void write_scalars(const std::string& path, const PolygonCurve& curve, std::span<const NodeScalar> scalars);

/// Returns the bytes that write_scalars() would write to a file named `name`. Throws Error(invalid_argument) as it
/// does. Cost: linear.
[[nodiscard]] FileBytes scalar_bytes(const std::string& name, const PolygonMesh& mesh,
                                     std::span<const NodeScalar> scalars);
[[nodiscard]] FileBytes scalar_bytes(const std::string& name, const PolygonCurve& curve,
                                     std::span<const NodeScalar> scalars);

}  // namespace vspring
