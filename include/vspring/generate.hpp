#pragma once

#include <cstdint>
#include <vector>

#include "vspring/export.hpp"
#include "vspring/polygon_mesh.hpp"

namespace VSPRING_API vspring {

/// Shapes for examples, tests and benchmarks. Lengths are in the units of their arguments, between 1e-100 and 1e100;
/// angles are in degrees. Faces run counter-clockwise seen from outside (closed and tubular shapes) or from above (+z;
/// all others). Every node belongs to a face. The same arguments give the same bits in every run.
///
/// Every function throws Error(invalid_argument) naming the argument that is out of its range, and for more than
/// 100,000,000 nodes. Cost: linear in the nodes.
namespace generate {

/// How a grid of (columns × rows) cells is cut into faces.
enum class Faces {
  triangles,  ///< each cell cut along a diagonal, alternating, so that no direction is preferred
  quads,
  mixed,    ///< cells left whole, cut in two, and joined in pairs to hexagons; all three in every 4 × 4 cells
  hexagons  ///< bricks of two cells, shifted by one cell from row to row: six nodes a face, three edges a node
};

/// A grid of cells. Nodes are numbered row by row, within a row by column. Along a closed direction hexagons need an
/// even number of cells from 4, mixed faces a multiple of 4, others 3 or more; along an open one 1 or more, and single
/// cells left over at the ends of rows are quads.
struct Grid {
  int columns = 20;                ///< cells along a row
  int rows = 20;                   ///< of cells
  Faces faces = Faces::triangles;  ///< into which cells are cut
  /// 0 to 0.5: every inner node lies at random in a box of this share of a cell about its place in the grid, exactly on
  /// the shape. No face of a plane turns over. Boundary nodes keep their places.
  double jitter = 0;
  std::uint64_t seed = 1;  ///< of the jitter
};

/// The rectangle from (0, 0, 0) to (width, height, 0); columns along x.
[[nodiscard]] PolygonMesh plane(const Grid& grid = {}, double width = 1, double height = 1);

/// A four-sided patch of the sphere around the origin, about (0, 0, radius), without a singular point.
/// angle: from the middle of a side through the pole to the middle of the opposite side; more than 0, less than 180.
[[nodiscard]] PolygonMesh sphere_patch(const Grid& grid = {}, double radius = 1, double angle = 90);

/// A patch of the cylinder around the z axis, from z = 0 to height. Columns run around it, over `angle`, more than 0
/// and less than 360, centred on +x.
[[nodiscard]] PolygonMesh cylinder_patch(const Grid& grid = {}, double radius = 1, double angle = 120,
                                         double height = 1);

/// The saddle z = xy over the square of this size about the origin; columns along x.
[[nodiscard]] PolygonMesh saddle(const Grid& grid = {}, double size = 2);

/// A closed torus around the z axis. Columns run around the axis at major_radius, rows around the pipe.
/// minor_radius: less than major_radius.
[[nodiscard]] PolygonMesh torus(const Grid& grid = {}, double major_radius = 1, double minor_radius = 0.4);

/// A full cylinder around the z axis from z = 0 to height, open at both ends. Columns run around it.
[[nodiscard]] PolygonMesh tube(const Grid& grid = {}, double radius = 1, double height = 2);

/// Options of cap().
struct CapOptions {
  Index nodes = 1000;      ///< exactly; 4 or more
  double radius = 1;       ///< of the sphere
  double half_angle = 60;  ///< from the pole to the rim; more than 0, up to 170
  /// 0 to 0.5: every node but the pole and the rim lies at random in a disc of this share of the spacing about its
  /// place, exactly on the shape.
  double jitter = 0;
  std::uint64_t seed = 1;  ///< of the jitter
};

/// A triangulated cap of the sphere around the origin, of nearly even spacing. Node 0 is the pole (0, 0, radius);
/// rings follow outwards, the last of them on the rim.
[[nodiscard]] PolygonMesh cap(const CapOptions& options = {});

/// Options of flat_disc().
struct DiscOptions {
  Index nodes = 1000;      ///< exactly; 4 or more
  double radius = 1;       ///< of the rim
  double jitter = 0;       ///< as for a cap
  std::uint64_t seed = 1;  ///< of the jitter
};

/// A triangulated disc about the origin in the plane z = 0, of nearly even spacing. Node 0 is the centre; rings
/// follow outwards, the last of them on the rim.
[[nodiscard]] PolygonMesh flat_disc(const DiscOptions& options = {});

/// What lies between the two boundary circles of an annulus.
enum class Profile {
  steps,  ///< flat outer ring, steep wall, flat inner ring at `height`, with sharp corners, like the paper's Fig. 8(A)
  cone,   ///< straight from the outer to the inner circle
  flat    ///< all at z = 0
};

/// Options of annulus().
struct AnnulusOptions {
  Index nodes = 1610;          ///< exactly; 6 or more, 12 or more for steps
  Index boundary_nodes = 0;    ///< of both circles together, exactly; 6 or more; 0: as even spacing asks for
  double inner_radius = 0.35;  ///< more than 0
  double outer_radius = 1;     ///< more than inner_radius
  /// Of the inner circle over the outer one; 0 to a million times outer_radius − inner_radius. Without meaning for a
  /// flat profile.
  double height = 0.5;
  Profile profile = Profile::steps;  ///< what lies between the circles
  double jitter = 0;                 ///< as for a cap; nodes stay on the profile
  std::uint64_t seed = 1;            ///< of the jitter
};

/// A triangulated ring around the z axis with 2 · nodes − boundary_nodes faces. The outer circle lies at z = 0. Nodes
/// are numbered ring by ring, from the inner circle to the outer. The spacing is as even as boundary_nodes allow. Each
/// inner ring needs three nodes: if boundary_nodes are given, `nodes` must equal them or be at least 3 more, for steps
/// at least 6 more.
[[nodiscard]] PolygonMesh annulus(const AnnulusOptions& options = {});

/// The annulus with a cone between circles of radius 1 and 0.35, the inner one at z = 0.5.
[[nodiscard]] PolygonMesh funnel(Index nodes = 1610, Index boundary_nodes = 0);

/// A side of a cube.
enum class Side { plus_x, minus_x, plus_y, minus_y, plus_z, minus_z };

/// Options of pipe_blend().
struct PipeBlendOptions {
  std::vector<Side> pipes = {Side::plus_x, Side::minus_x, Side::plus_z};  ///< two or more, each once
  int cells = 8;                                                          ///< along an edge of the cube; 1 or more
  double side = 1;                                                        ///< of the cube
  double pipe_radius = 0.4;                                               ///< at most half a side
  double pipe_length = 1;                                                 ///< from the cube to the end of each pipe
  Faces faces = Faces::quads;                                             ///< quads or triangles
};

/// A cube about the origin with pipes in place of some sides: a start with sharp corners for a blend of pipes. In the
/// first half of its length each pipe changes from a square to a circle; it ends in an exact circle of 4 · cells nodes.
/// Closed elsewhere. Nodes of sides without a pipe come first, then those of the pipes from the cube outwards, in the
/// order of Side.
[[nodiscard]] PolygonMesh pipe_blend(const PipeBlendOptions& options = {});

/// Options of hull().
struct HullOptions {
  int columns = 60;    ///< cells along the hull; 4 or more
  int rows = 18;       ///< cells from the keel to the deck edge, a third of them on each strake; a multiple of 3
  double length = 10;  ///< from the transom to the head of the stem
  double beam = 3;     ///< greatest breadth, at the deck edge
  Faces faces = Faces::quads;  ///< quads or triangles
  bool whole = false;          ///< both sides, the mirror images of each other, in place of the one with y from 0 on
};

/// A planing hull with two chines, open at the transom and at the deck: x runs forward from the transom, y to port and
/// z upwards. Three strakes of straight sections lie between the keel, the inner and the outer chine and the deck edge,
/// and end on the stem. At the chines they meet at some 30° over the after half, and at less towards the stem,
/// where the chines run out. Keel and stem have y exactly 0. The deck edge lies in a plane that rises towards the bow.
/// Nodes of half a hull are numbered row by row from the keel up, within a row forward;
/// of a whole one the mirror images of those with y > 0 follow in the same order.
[[nodiscard]] PolygonMesh hull(const HullOptions& options = {});

/// Options of polygon_patch().
struct PolygonPatchOptions {
  int sides = 5;          ///< of the polygon; 3 or more
  int rings = 4;          ///< of quads around it; 1 or more
  double radius = 1;      ///< of the boundary circle
  double half_angle = 0;  ///< 0: flat; otherwise a cap of a sphere of this half angle, 0.001 to 170
};

/// One polygon amid rings of quads; the boundary is a circle about the origin at z = 0. Around a polygon of up to 8
/// sides rings grow as around a cell of a square grid, with four edges at every inner node and sides · (2 · rings + 1)
/// nodes on the boundary. Around one of more sides all rings have equally many nodes, and the polygon's nodes have
/// three edges. Nodes are numbered ring by ring outwards; face 0 is the polygon, of nodes 0 to sides − 1.
[[nodiscard]] PolygonMesh polygon_patch(const PolygonPatchOptions& options = {});

/// Options of genus().
struct GenusOptions {
  int holes = 3;    ///< 0 or more
  int cells = 4;    ///< along an edge of each cube; 1 or more
  double side = 1;  ///< of each cube
};

/// The closed surface of a block of (2 · holes + 1) × 3 × 1 cubes about the origin with that many holes through it
/// along z: quads, of that genus.
[[nodiscard]] PolygonMesh genus(const GenusOptions& options = {});

/// Moves every node by a random vector, uniformly distributed in the ball of radius `amplitude` (a length, 0 or more).
/// move_boundary: move boundary nodes, too.
[[nodiscard]] PolygonMesh add_noise(const PolygonMesh& mesh, double amplitude, std::uint64_t seed = 1,
                                    bool move_boundary = false);

/// A mesh with other numbers for its nodes and faces.
struct Shuffled {
  PolygonMesh mesh;                    ///< with the new numbers
  std::vector<Index> new_number;       ///< of each node of the original
  std::vector<Index> new_face_number;  ///< of each face of the original
};

/// Puts the nodes and faces of a mesh in random order. Each face begins at the same node as before.
[[nodiscard]] Shuffled shuffle(const PolygonMesh& mesh, std::uint64_t seed = 1);

}  // namespace generate
}  // namespace vspring
