// Closes the two holes of a sphere without its poles: the patches are fair with what is around, so it is a sphere
// again. build/examples/07_hole OUT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>
#include <vector>
#include <vspring/vspring.hpp>

using namespace vspring;

int main(int argc, char** argv) {
  const std::string out = argc > 1 ? argv[1] : ".";
  // A tube, bent to the sphere of radius 1: from 20 degrees below the one pole to 20 degrees above the other.
  PolygonMesh band = generate::tube({.columns = 48, .rows = 24, .faces = generate::Faces::quads}, 1, 2);
  std::vector<Vector3> nodes = band.positions();
  for (Vector3& p : nodes) {
    const double latitude = 70 * (p.z() - 1) * std::numbers::pi / 180;
    p = {p.x() * std::cos(latitude), p.y() * std::cos(latitude), std::sin(latitude)};
  }
  band.set_positions(nodes);

  const FilledHoles filled = fill_holes(band);
  PolygonMesh sphere = filled.mesh;
  sphere.set_positions(filled.positions);
  write_surface(out + "/07_hole.obj", sphere);

  double off = 0;
  for (const Vector3& p : filled.positions) off = std::max(off, std::abs(p.norm() - 1));
  std::printf(
      "%s: %zu holes, filled with %zu nodes and %zu faces; at most %.1e off the sphere; %zu boundaries are left\n",
      name(filled.report.outcome), filled.holes.size(), filled.node_like.size(), filled.face_like.size(), off,
      boundary_loops(sphere).size());
  return filled.usable() ? 0 : 1;
}
