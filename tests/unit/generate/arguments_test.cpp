#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <string>

#include "unit/generate/counted.hpp"
#include "vspring/error.hpp"
#include "vspring/generate.hpp"

namespace vspring::arguments_test {
namespace {

using namespace generate;

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

/// The message of the refusal, which must be one of an invalid argument.
std::string refusal(const std::function<PolygonMesh()>& make) {
  try {
    (void)make();
  } catch (const Error& error) {
    EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
    return error.what();
  }
  return "accepted";
}

#define EXPECT_REFUSED(name, shape)                                                 \
  EXPECT_EQ(refusal([&]() -> PolygonMesh { return shape; }).rfind(name " ", 0), 0U) \
      << refusal([&]() -> PolygonMesh { return shape; })

TEST(Arguments, AreNamedWhenOutOfRange) {
  EXPECT_EQ(refusal([] { return cap({.nodes = 3}); }), "nodes must be 4 or more, not 3");
  EXPECT_REFUSED("columns", plane({.columns = 0}));
  EXPECT_REFUSED("rows", plane({.rows = -3}));
  EXPECT_REFUSED("faces", plane({.faces = static_cast<Faces>(4)}));
  EXPECT_REFUSED("jitter", plane({.jitter = 0.51}));
  EXPECT_REFUSED("jitter", plane({.jitter = -0.1}));
  EXPECT_REFUSED("jitter", plane({.jitter = not_a_number}));
  EXPECT_REFUSED("the number of nodes", plane({.columns = 20000, .rows = 20000}));
  for (const double length : {0.0, -1.0, infinity, not_a_number, 1e101, 1e-101}) {
    EXPECT_REFUSED("width", plane({}, length));
    EXPECT_REFUSED("height", plane({}, 1, length));
    EXPECT_REFUSED("radius", sphere_patch({}, length));
    EXPECT_REFUSED("radius", cylinder_patch({}, length));
    EXPECT_REFUSED("height", cylinder_patch({}, 1, 90, length));
    EXPECT_REFUSED("size", saddle({}, length));
    EXPECT_REFUSED("major radius", torus({}, length, 0.4));
    EXPECT_REFUSED("minor radius", torus({}, 1, length));
    EXPECT_REFUSED("radius", tube({}, length));
    EXPECT_REFUSED("height", tube({}, 1, length));
    EXPECT_REFUSED("radius", cap({.radius = length}));
    EXPECT_REFUSED("radius", flat_disc({.radius = length}));
    EXPECT_REFUSED("inner radius", annulus({.inner_radius = length}));
    EXPECT_REFUSED("outer radius", annulus({.outer_radius = length}));
    EXPECT_REFUSED("side", pipe_blend({.side = length}));
    EXPECT_REFUSED("pipe radius", pipe_blend({.pipe_radius = length}));
    EXPECT_REFUSED("pipe length", pipe_blend({.pipe_length = length}));
    EXPECT_REFUSED("radius", polygon_patch({.radius = length}));
    EXPECT_REFUSED("side", genus({.side = length}));
  }
  EXPECT_REFUSED("angle", sphere_patch({}, 1, 180));
  EXPECT_REFUSED("angle", sphere_patch({}, 1, 0));
  EXPECT_REFUSED("angle", cylinder_patch({}, 1, 360));
  EXPECT_REFUSED("minor radius", torus({}, 1, 1));
}

TEST(Arguments, OfPeriodicGridsMustCloseThePattern) {
  EXPECT_REFUSED("columns", torus({.columns = 2}));
  EXPECT_REFUSED("rows", torus({.rows = 2}));
  EXPECT_REFUSED("columns", torus({.columns = 13, .faces = Faces::hexagons}));
  EXPECT_REFUSED("rows", torus({.rows = 7, .faces = Faces::hexagons}));
  EXPECT_REFUSED("columns", tube({.columns = 2, .faces = Faces::hexagons}));
  EXPECT_REFUSED("columns", tube({.columns = 10, .faces = Faces::mixed}));
  EXPECT_REFUSED("rows", torus({.rows = 6, .faces = Faces::mixed}));
  EXPECT_EQ(tube({.columns = 8, .rows = 1, .faces = Faces::mixed}).node_count(), 16);
}

TEST(Arguments, OfRoundShapesAreNamedWhenOutOfRange) {
  EXPECT_REFUSED("half angle", cap({.half_angle = 171}));
  EXPECT_REFUSED("half angle", cap({.half_angle = 0}));
  EXPECT_REFUSED("half angle", cap({.half_angle = not_a_number}));
  EXPECT_REFUSED("jitter", cap({.jitter = 0.6}));
  EXPECT_REFUSED("nodes", flat_disc({.nodes = 3}));
  EXPECT_REFUSED("nodes", flat_disc({.nodes = std::numeric_limits<Index>::min()}));
  EXPECT_REFUSED("the number of nodes", flat_disc({.nodes = 200'000'000}));
  EXPECT_REFUSED("nodes", annulus({.nodes = 5, .profile = Profile::flat}));
  EXPECT_REFUSED("nodes", annulus({.nodes = 11}));
  EXPECT_REFUSED("boundary nodes", annulus({.boundary_nodes = 5}));
  EXPECT_REFUSED("boundary nodes", annulus({.boundary_nodes = -1}));
  EXPECT_REFUSED("nodes inside", annulus({.nodes = 100, .boundary_nodes = 101}));
  EXPECT_REFUSED("nodes inside", annulus({.nodes = 100, .boundary_nodes = 95}));
  EXPECT_REFUSED("nodes inside", annulus({.nodes = 100, .boundary_nodes = 98, .profile = Profile::flat}));
  EXPECT_REFUSED("inner radius", annulus({.inner_radius = 1, .outer_radius = 1}));
  EXPECT_REFUSED("height", annulus({.height = -1}));
  EXPECT_REFUSED("height", annulus({.height = 1e7}));
  EXPECT_REFUSED("profile", annulus({.profile = static_cast<Profile>(3)}));
  EXPECT_REFUSED("sides", polygon_patch({.sides = 2}));
  EXPECT_REFUSED("rings", polygon_patch({.rings = 0}));
  EXPECT_REFUSED("half angle", polygon_patch({.half_angle = -1}));
  EXPECT_REFUSED("half angle", polygon_patch({.half_angle = 175}));
  EXPECT_REFUSED("the number of nodes", polygon_patch({.sides = 1'000'000, .rings = 1000}));
}

TEST(Arguments, OfSolidsAndNoiseAreNamedWhenOutOfRange) {
  EXPECT_REFUSED("number of pipes", pipe_blend({.pipes = {Side::plus_x}}));
  EXPECT_REFUSED("pipes", pipe_blend({.pipes = {Side::plus_x, Side::plus_x}}));
  EXPECT_REFUSED("side", pipe_blend({.pipes = {Side::plus_x, static_cast<Side>(6)}}));
  EXPECT_REFUSED("cells", pipe_blend({.cells = 0}));
  EXPECT_REFUSED("pipe radius", pipe_blend({.side = 1, .pipe_radius = 0.6}));
  EXPECT_REFUSED("faces", pipe_blend({.faces = Faces::hexagons}));
  EXPECT_REFUSED("the number of nodes", pipe_blend({.pipe_length = 1e9}));
  EXPECT_REFUSED("columns", hull({.columns = 3}));
  EXPECT_REFUSED("rows", hull({.rows = 8}));
  EXPECT_REFUSED("beam", hull({.beam = 0}));
  EXPECT_REFUSED("faces", hull({.faces = Faces::mixed}));
  EXPECT_REFUSED("holes", genus({.holes = -1}));
  EXPECT_REFUSED("cells", genus({.cells = 0}));
  EXPECT_REFUSED("amplitude", add_noise(plane(), -1));
  EXPECT_REFUSED("amplitude", add_noise(plane(), not_a_number));
}

TEST(Arguments, AtTheEndsOfTheirRangesGiveFiniteShapes) {
  for (const double length : {1e-99, 1e100}) {
    const PolygonMesh meshes[] = {
        sphere_patch({.jitter = 0.5}, length, 179.9),
        saddle({}, length),
        torus({}, length, length / 2),
        cap({.nodes = 50, .radius = length, .half_angle = 1e-6}),
        annulus({.nodes = 50, .inner_radius = length / 3, .outer_radius = length, .height = length / 2, .jitter = 0.5}),
        annulus({.nodes = 500, .inner_radius = 1e-100, .outer_radius = 1, .height = 1e6, .jitter = 0.5}),
        annulus({.nodes = 500, .inner_radius = 1, .outer_radius = 1 + 1e-15, .height = 1e-10, .jitter = 0.5}),
        pipe_blend({.side = length, .pipe_radius = length / 2, .pipe_length = length}),
        polygon_patch({.radius = length, .half_angle = 0.001}),
        genus({.side = length})};
    for (const PolygonMesh& mesh : meshes) {
      for (const Vector3& p : mesh.positions()) EXPECT_TRUE(p.allFinite());
    }
  }
}

}  // namespace
}  // namespace vspring::arguments_test
