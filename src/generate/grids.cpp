// Shapes that are images of a grid.

#include <cmath>

#include "base/degrees.hpp"
#include "base/random.hpp"
#include "generate/arguments.hpp"
#include "generate/grid_faces.hpp"

namespace vspring::generate {

namespace {

/// The place on a shape of the shares s of the columns and t of the rows, 0 to 1.
using Map = std::function<Vector3(double s, double t)>;

PolygonMesh image_of_grid(const Grid& grid, Wrapping wrapping, const Map& map) {
  const int node_columns = grid.columns + (wrapping.columns ? 0 : 1);
  const int node_rows = grid.rows + (wrapping.rows ? 0 : 1);
  Random random(grid.seed);
  MeshBuilder builder;
  for (int row = 0; row < node_rows; ++row) {
    for (int column = 0; column < node_columns; ++column) {
      const bool inside = (wrapping.columns || (column > 0 && column < grid.columns)) &&
                          (wrapping.rows || (row > 0 && row < grid.rows));
      double c = column;
      double r = row;
      if (inside && grid.jitter > 0) {
        c += grid.jitter * random.uniform(-0.5, 0.5);
        r += grid.jitter * random.uniform(-0.5, 0.5);
      }
      builder.add_node(map(c / grid.columns, r / grid.rows));
    }
  }
  const Cells cells{grid.columns, grid.rows, grid.faces, wrapping.columns};
  add_grid_faces(builder, cells, [&](int column, int row) {
    return static_cast<Index>((row % node_rows) * node_columns + column % node_columns);
  });
  return builder.take();
}

}  // namespace

PolygonMesh plane(const Grid& grid, double width, double height) {
  require_grid(grid, {});
  require_length("width", width);
  require_length("height", height);
  return image_of_grid(grid, {}, [&](double s, double t) { return Vector3(width * s, height * t, 0); });
}

PolygonMesh sphere_patch(const Grid& grid, double radius, double angle) {
  require_grid(grid, {});
  require_length("radius", radius);
  require(angle > 0 && angle < 180, "angle", "greater than 0 and less than 180 degrees", angle);
  // Equal steps of the angles whose tangents are x/z and y/z: a side of the cubed sphere.
  return image_of_grid(grid, {}, [&](double s, double t) {
    const double a = angle / degrees_per_radian * (s - 0.5);
    const double b = angle / degrees_per_radian * (t - 0.5);
    const Vector3 direction(std::sin(a) * std::cos(b), std::cos(a) * std::sin(b), std::cos(a) * std::cos(b));
    return Vector3(radius * direction.normalized());
  });
}

PolygonMesh cylinder_patch(const Grid& grid, double radius, double angle, double height) {
  require_grid(grid, {});
  require_length("radius", radius);
  require_length("height", height);
  require(angle > 0 && angle < 360, "angle", "greater than 0 and less than 360 degrees", angle);
  return image_of_grid(grid, {}, [&](double s, double t) {
    const double a = angle / degrees_per_radian * (s - 0.5);
    return Vector3(radius * std::cos(a), radius * std::sin(a), height * t);
  });
}

PolygonMesh saddle(const Grid& grid, double size) {
  require_grid(grid, {});
  require_length("size", size);
  return image_of_grid(grid, {}, [&](double s, double t) {
    const double x = size * (s - 0.5);
    const double y = size * (t - 0.5);
    return Vector3(x, y, x * y);
  });
}

PolygonMesh torus(const Grid& grid, double major_radius, double minor_radius) {
  require_grid(grid, {.columns = true, .rows = true});
  require_length("major radius", major_radius);
  require_length("minor radius", minor_radius);
  require(minor_radius < major_radius, "minor radius", "less than the major radius", minor_radius);
  return image_of_grid(grid, {.columns = true, .rows = true}, [&](double s, double t) {
    const double around_axis = 2 * std::numbers::pi * s;
    const double around_pipe = 2 * std::numbers::pi * t;
    const double from_axis = major_radius + minor_radius * std::cos(around_pipe);
    return Vector3(from_axis * std::cos(around_axis), from_axis * std::sin(around_axis),
                   minor_radius * std::sin(around_pipe));
  });
}

PolygonMesh tube(const Grid& grid, double radius, double height) {
  require_grid(grid, {.columns = true});
  require_length("radius", radius);
  require_length("height", height);
  return image_of_grid(grid, {.columns = true}, [&](double s, double t) {
    const double a = 2 * std::numbers::pi * s;
    return Vector3(radius * std::cos(a), radius * std::sin(a), height * t);
  });
}

}  // namespace vspring::generate
