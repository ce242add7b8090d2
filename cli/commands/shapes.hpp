#pragma once

#include <CLI/CLI.hpp>
#include <cstdint>
#include <functional>
#include <string>

#include "vspring/polygon_mesh.hpp"

namespace vspring::cli {

/// Makes a shape with the given options.
using MakeShape = std::function<PolygonMesh(std::uint64_t seed)>;

/// Adds the command of one shape. example: arguments for the help text.
using AddShape = std::function<CLI::App&(const std::string& name, const std::string& description,
                                         const std::string& example, MakeShape make)>;

/// Adds the commands of all shapes.
void add_shapes(const AddShape& add);

}  // namespace vspring::cli
