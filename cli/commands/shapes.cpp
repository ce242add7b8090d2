#include "commands/shapes.hpp"

#include <fmt/format.h>

#include <memory>

#include "commands/option_kinds.hpp"
#include "vspring/generate.hpp"

namespace vspring::cli {

namespace {

using namespace generate;

const std::map<std::string, Faces> all_faces = {
    {"triangles", Faces::triangles}, {"quads", Faces::quads}, {"mixed", Faces::mixed}, {"hexagons", Faces::hexagons}};
const std::map<std::string, Faces> pipe_faces = {{"triangles", Faces::triangles}, {"quads", Faces::quads}};
const std::map<std::string, Profile> profiles = {
    {"steps", Profile::steps}, {"cone", Profile::cone}, {"flat", Profile::flat}};
const std::map<std::string, Side> sides = {{"+x", Side::plus_x},  {"-x", Side::minus_x}, {"+y", Side::plus_y},
                                           {"-y", Side::minus_y}, {"+z", Side::plus_z},  {"-z", Side::minus_z}};

template <typename Value>
void add_value(CLI::App& command, const std::string& flag, Value& target, const std::string& type,
               const std::string& help) {
  command.add_option(flag, target, fmt::format("{} (default: {})", help, target))
      ->type_name(type)
      ->check(any_number<Value>());
}

void add_length(CLI::App& command, const std::string& flag, double& target, const std::string& help) {
  add_value(command, flag, target, "LENGTH", help);
}

void add_degrees(CLI::App& command, const std::string& flag, double& target, const std::string& help) {
  add_value(command, flag, target, "DEGREES", help);
}

void add_jitter(CLI::App& command, double& target) {
  add_value(command, "--jitter", target, "SHARE",
            "Shift the nodes inside at random within the shape, by this share of the spacing, 0 to 0.5");
}

void add_grid(CLI::App& command, Grid& grid, const std::string& columns, const std::string& rows) {
  add_value(command, "--columns", grid.columns, "N", "Cells " + columns);
  add_value(command, "--rows", grid.rows, "N", "Cells " + rows);
  add_choice(command, "--faces", grid.faces, all_faces,
             "What cells become; mixed: triangles, quads and hexagons (default: triangles)");
  add_jitter(command, grid.jitter);
}

/// A command and its options, which live equally long.
template <typename Options>
struct Shape {
  CLI::App& command;
  Options& options;
};

template <typename Options, typename Make>
Shape<Options> add_shape(const AddShape& add, const std::string& name, const std::string& description,
                         const std::string& example, Make make) {
  const auto options = std::make_shared<Options>();
  CLI::App& command = add(name, description, example, [options, make](std::uint64_t seed) -> PolygonMesh {
    if constexpr (requires { options->seed; }) options->seed = seed;
    if constexpr (requires { options->grid; }) options->grid.seed = seed;
    return make(*options);
  });
  return {command, *options};
}

struct PlaneOptions {
  Grid grid;
  double width = 1;
  double height = 1;
};

struct SpherePatchOptions {
  Grid grid;
  double radius = 1;
  double angle = 90;
};

struct CylinderPatchOptions {
  Grid grid;
  double radius = 1;
  double angle = 120;
  double height = 1;
};

struct SaddleOptions {
  Grid grid;
  double size = 2;
};

struct TorusOptions {
  Grid grid;
  double major_radius = 1;
  double minor_radius = 0.4;
};

struct TubeOptions {
  Grid grid;
  double radius = 1;
  double height = 2;
};

void add_flat_patches(const AddShape& add) {
  const auto [plane, flat] = add_shape<PlaneOptions>(
      add, "plane", "A flat rectangle", "--columns 40 --rows 30 --faces mixed --jitter 0.3 -o plane.obj",
      [](const PlaneOptions& o) { return generate::plane(o.grid, o.width, o.height); });
  add_grid(plane, flat.grid, "along the width", "along the height");
  add_length(plane, "--width", flat.width, "Along x");
  add_length(plane, "--height", flat.height, "Along y");

  const auto [saddle, hyperbolic] = add_shape<SaddleOptions>(
      add, "saddle", "The saddle z = xy over a square about the origin", "--columns 40 --rows 40 -o saddle.ply",
      [](const SaddleOptions& o) { return generate::saddle(o.grid, o.size); });
  add_grid(saddle, hyperbolic.grid, "along x", "along y");
  add_length(saddle, "--size", hyperbolic.size, "Side of the square");
}

void add_round_patches(const AddShape& add) {
  const auto [sphere, ball] = add_shape<SpherePatchOptions>(
      add, "sphere-patch", "A four-sided patch of a sphere", "--faces hexagons --angle 120 -o patch.off",
      [](const SpherePatchOptions& o) { return generate::sphere_patch(o.grid, o.radius, o.angle); });
  add_grid(sphere, ball.grid, "along one side", "along the other side");
  add_length(sphere, "--radius", ball.radius, "Of the sphere");
  add_degrees(sphere, "--angle", ball.angle, "From the middle of a side to the middle of the one across, below 180");

  const auto [cylinder, pipe] = add_shape<CylinderPatchOptions>(
      add, "cylinder-patch", "A patch of a cylinder", "--faces quads --angle 90 -o patch.obj",
      [](const CylinderPatchOptions& o) { return generate::cylinder_patch(o.grid, o.radius, o.angle, o.height); });
  add_grid(cylinder, pipe.grid, "around the axis", "along the axis");
  add_length(cylinder, "--radius", pipe.radius, "Of the cylinder");
  add_degrees(cylinder, "--angle", pipe.angle, "Around the axis, below 360");
  add_length(cylinder, "--height", pipe.height, "Along the axis");
}

void add_periodic(const AddShape& add) {
  const std::string numbers = "; 3 or more, for hexagons even from 4, for mixed a multiple of 4";
  const auto [torus, ring] = add_shape<TorusOptions>(
      add, "torus", "A closed torus", "--columns 64 --rows 24 --faces quads -o torus.obj",
      [](const TorusOptions& o) { return generate::torus(o.grid, o.major_radius, o.minor_radius); });
  add_grid(torus, ring.grid, "around the axis" + numbers, "around the pipe" + numbers);
  add_length(torus, "--major-radius", ring.major_radius, "From the axis to the middle of the pipe");
  add_length(torus, "--minor-radius", ring.minor_radius, "Of the pipe");

  const auto [tube, pipe] = add_shape<TubeOptions>(
      add, "tube", "A full cylinder, open at both ends", "--columns 32 --rows 16 --faces hexagons -o tube.ply",
      [](const TubeOptions& o) { return generate::tube(o.grid, o.radius, o.height); });
  add_grid(tube, pipe.grid, "around the axis" + numbers, "along the axis");
  add_length(tube, "--radius", pipe.radius, "Of the cylinder");
  add_length(tube, "--height", pipe.height, "Along the axis");
}

void add_discs(const AddShape& add) {
  const auto [cap, round] = add_shape<CapOptions>(add, "cap", "A cap of a sphere, of even triangles",
                                                  "--nodes 5000 --half-angle 80 -o cap.ply", generate::cap);
  add_value(cap, "--nodes", round.nodes, "N", "Nodes, exactly; 4 or more");
  add_length(cap, "--radius", round.radius, "Of the sphere");
  add_degrees(cap, "--half-angle", round.half_angle, "From the pole to the rim, up to 170");
  add_jitter(cap, round.jitter);

  const auto [disc, flat] = add_shape<DiscOptions>(add, "flat-disc", "A flat disc of even triangles",
                                                   "--nodes 2000 --jitter 0.3 -o disc.obj", generate::flat_disc);
  add_value(disc, "--nodes", flat.nodes, "N", "Nodes, exactly; 4 or more");
  add_length(disc, "--radius", flat.radius, "Of the rim");
  add_jitter(disc, flat.jitter);
}

void add_annulus(const AddShape& add, const std::string& name, const std::string& description,
                 const std::string& example, Profile profile) {
  const auto [command, options] = add_shape<AnnulusOptions>(add, name, description, example, generate::annulus);
  options.profile = profile;
  add_value(command, "--nodes", options.nodes, "N", "Nodes, exactly; 6 or more, 12 or more for steps");
  add_value(command, "--boundary-nodes", options.boundary_nodes, "N",
            "Those of both circles together, exactly; there are 2 nodes - boundary nodes faces; 0: for even spacing");
  add_length(command, "--inner-radius", options.inner_radius, "Of the inner circle");
  add_length(command, "--outer-radius", options.outer_radius, "Of the outer circle, at z = 0");
  add_length(command, "--height", options.height, "Of the inner circle over the outer one");
  if (profile == Profile::steps)
    add_choice(command, "--profile", options.profile, profiles,
               "Flat rings and a steep wall with sharp corners; straight; all at z = 0 (default: steps)");
  add_jitter(command, options.jitter);
}

std::vector<Side> parse_sides(const std::string& text) {
  std::vector<Side> parsed;
  for (const std::string& word : CLI::detail::split(text, ',')) {
    const auto side = sides.find(word);
    if (side == sides.end())
      throw CLI::ValidationError("--pipes", "\"" + word + "\" is not one of +x, -x, +y, -y, +z, -z");
    parsed.push_back(side->second);
  }
  return parsed;
}

void add_pipe_blend(const AddShape& add) {
  const auto [command, options] = add_shape<PipeBlendOptions>(
      add, "pipe-blend", "A cube with pipes in place of some sides, sharp-cornered, to be faired to a blend",
      "--pipes=+x,-x,+y,+z --cells 12 -o blend.obj", generate::pipe_blend);
  command
      .add_option_function<std::string>(
          "--pipes", [&pipes = options.pipes](const std::string& text) { pipes = parse_sides(text); },
          "Sides of the cube with pipes, two to six of +x, -x, +y, -y, +z, -z (default: +x,-x,+z)")
      ->type_name("SIDES");
  add_value(command, "--cells", options.cells, "N", "Along an edge of the cube; pipes have four times as many around");
  add_length(command, "--side", options.side, "Of the cube");
  add_length(command, "--pipe-radius", options.pipe_radius, "Of the pipes, at most half a side");
  add_length(command, "--pipe-length", options.pipe_length, "From the cube to the end of each pipe");
  add_choice(command, "--faces", options.faces, pipe_faces, "What cells become (default: quads)");
}

void add_hull(const AddShape& add) {
  const auto [command, options] =
      add_shape<HullOptions>(add, "hull", "Half of a planing hull with two chines, or all of it",
                             "--columns 80 --rows 24 -o hull.obj", generate::hull);
  add_value(command, "--columns", options.columns, "N", "Cells along the hull; 4 or more");
  add_value(command, "--rows", options.rows, "N", "Cells from the keel to the deck edge; a multiple of 3");
  add_length(command, "--length", options.length, "From the transom to the head of the stem");
  add_length(command, "--beam", options.beam, "Greatest breadth, at the deck edge");
  add_choice(command, "--faces", options.faces, pipe_faces, "What cells become (default: quads)");
  command.add_flag("--whole", options.whole, "Both sides, not only the one with y from 0 on (default: off)");
}

void add_polygon_patch(const AddShape& add) {
  const auto [command, options] =
      add_shape<PolygonPatchOptions>(add, "polygon-patch", "One polygon of any number of sides amid rings of quads",
                                     "--sides 5 --rings 6 --half-angle 60 -o pentagon.obj", generate::polygon_patch);
  add_value(command, "--sides", options.sides, "N", "Of the polygon; 3 or more");
  add_value(command, "--rings", options.rings, "N", "Of quads around it; 1 or more");
  add_length(command, "--radius", options.radius, "Of the boundary circle");
  add_degrees(command, "--half-angle", options.half_angle,
              "0: flat; otherwise a cap of a sphere of this half angle, up to 170");
}

void add_genus(const AddShape& add) {
  const auto [command, options] =
      add_shape<GenusOptions>(add, "genus", "A closed block of cubes with holes through it, of quads",
                              "--holes 3 --cells 6 -o genus-3.off", generate::genus);
  add_value(command, "--holes", options.holes, "N", "Holes: the genus; 0 or more");
  add_value(command, "--cells", options.cells, "N", "Along an edge of each cube");
  add_length(command, "--side", options.side, "Of each cube");
}

}  // namespace

void add_shapes(const AddShape& add) {
  add_flat_patches(add);
  add_round_patches(add);
  add_periodic(add);
  add_discs(add);
  add_annulus(add, "annulus", "A ring between two circles, of even triangles, like the paper's Fig. 8(A)",
              "--nodes 3644 --boundary-nodes 305 -o annulus.obj", Profile::steps);
  add_annulus(add, "funnel", "A straight funnel between two circles, of even triangles", "--nodes 2000 -o funnel.ply",
              Profile::cone);
  add_pipe_blend(add);
  add_hull(add);
  add_polygon_patch(add);
  add_genus(add);
}

}  // namespace vspring::cli
