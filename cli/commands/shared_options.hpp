#pragma once

#include <map>
#include <string>
#include <vector>

#include "vspring/fair.hpp"
#include "vspring/surface_file.hpp"

namespace CLI {
class App;
class Option;
}  // namespace CLI

namespace vspring::cli {

struct FairingArguments;
struct PictureArguments;
struct PullArguments;

/// Words of help texts.
struct FairingWords {
  std::string shape;          ///< "surface" or "curve"
  std::string input;          ///< kinds of input files
  std::string ends;           ///< "Boundary nodes" or "End nodes"
  std::string unfixed = "";   ///< what happens to nodes that are not fixed
  std::string directions;     ///< what --fix-normals fixes
  std::string rules;          ///< what rules are about
  std::string to = "fair";    ///< the verb of the command
  std::string done = "fair";  ///< the adjective of the result
};

// Options by their groups in the help text. `arguments` must outlive the command.
void add_files(CLI::App& command, FairingArguments& arguments, const FairingWords& words);
void add_constraint_options(CLI::App& command, FairingArguments& arguments, const FairingWords& words);
void add_slide_option(CLI::App& command, FairingArguments& arguments);
void add_symmetry_option(CLI::App& command, FairingArguments& arguments, const FairingWords& words);
void add_weld_option(CLI::App& command, FairingArguments& arguments);
/// --refine and --remesh.
void add_refine_options(CLI::App& command, FairingArguments& arguments);
CLI::Option* add_tolerance_option(CLI::App& command, FairingArguments& arguments);
CLI::Option* add_fair_by_option(CLI::App& command, FairingArguments& arguments);
CLI::Option* add_continuity_option(CLI::App& command, FairingArguments& arguments, bool of_curve = false);
void add_stopping_options(CLI::App& command, FairingArguments& arguments, const std::string& default_step);
void add_shaping_options(CLI::App& command, FairingArguments& arguments, const FairingWords& words);
/// An option for the columns of tables. whose: of which files, and the default.
void add_columns(CLI::App& command, const std::string& flag, std::vector<std::string>& columns,
                 const std::string& whose);
/// An option for names between commas, at least one.
CLI::Option* add_names(CLI::App& command, const std::string& flag, std::vector<std::string>& names,
                       const std::string& text);
/// --move of a curve. text: what happens to the named coordinates.
CLI::Option* add_moving(CLI::App& command, std::vector<std::string>& names, const std::string& text);
void add_run_options(CLI::App& command, FairingArguments& arguments);

/// How points pull. heading: of the options in the help text.
void add_pull_options(CLI::App& command, PullArguments& arguments, const std::string& heading);
/// --sharp-curves of a surface, and --sharp of a surface alone.
void add_sharp_curves(CLI::App& command, FairingArguments& arguments);
void add_sharp_edges(CLI::App& command, PullArguments& arguments);
/// Further bounds of a curve drawn to points. with_surfaces: --sharp is for these, too.
void add_curve_bounds(CLI::App& command, PullArguments& arguments, const std::string& heading,
                      bool with_surfaces = false);
/// --picture and --picture-size, and with `surfaces` --picture-style and --view.
void add_picture_options(CLI::App& command, PictureArguments& arguments, bool surfaces);

inline const std::string columns_of_curves =
    "CSV and XYZ: the columns of x, y and, in space, z, by number from 1 or, in CSV, by the names in the header "
    "(default: those that the header names x, y, z, with units or without, or lat and lon; else two or three of "
    "numbers). Named lat or latitude and lon, lng, long or longitude, they are degrees, and "
    "all lengths metres, as of .gpx, of which lon,lat,ele has the elevations for z";
inline const std::string pull_of_own_nodes = "How the nodes of the input pull as points: none or one of";
inline const std::string holding_group = "What holds the shape";
inline const std::string mesh_group = "How fine the mesh is";
inline const std::string fairing_group = "How it is faired";
inline const std::string run_group = "The run";

/// Values of --method and, of surfaces, of --format.
inline const std::map<std::string, Method> methods = {
    {"equilibrium", Method::equilibrium}, {"multigrid", Method::multigrid}, {"sweep", Method::sweep}};
inline const std::map<std::string, SurfaceFormat> surface_formats = {
    {"obj", SurfaceFormat::obj}, {"off", SurfaceFormat::off}, {"ply", SurfaceFormat::ply}, {"stl", SurfaceFormat::stl}};

}  // namespace vspring::cli
