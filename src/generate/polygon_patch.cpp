// One polygon amid loops of quads. Around a polygon of few sides the loops grow as those of a square grid around one of
// its cells, by two edges for each corner; around one of many sides, spokes go outwards from its nodes.

#include <cmath>
#include <numbers>

#include "generate/arguments.hpp"

namespace vspring::generate {

namespace {

constexpr int most_sides_with_corners = 8;

class PolygonGrid {
 public:
  explicit PolygonGrid(const PolygonPatchOptions& options)
      : sides_(options.sides), rings_(options.rings), corner_(options.sides <= most_sides_with_corners ? 1 : 0) {}

  /// 1 where a loop turns around a corner of the polygon with a quad of its own, 0 where it goes straight on.
  [[nodiscard]] int corner() const { return corner_; }

  /// Edges of a loop along one side of the polygon.
  [[nodiscard]] int edges(int loop) const { return 1 + 2 * corner_ * loop; }

  /// Node j of a loop from corner `side` on; j may be −1 and beyond the side.
  [[nodiscard]] Index node(int loop, int side, int j) const {
    const int count = sides_ * edges(loop);
    const int before = sides_ * (loop + corner_ * loop * (loop - 1));
    return before + (side * edges(loop) + j + count) % count;
  }

  /// A point of the unit disc: loops change gradually from polygons around the middle to the circle.
  [[nodiscard]] Vector3 place(int loop, int side, int j) const {
    const double sector = 2 * std::numbers::pi / sides_;
    const double share = static_cast<double>(j) / edges(loop);
    const double angle = sector * (side + share);
    Vector3 circle(std::cos(angle), std::sin(angle), 0);
    if (loop == rings_) return circle;
    const Vector3 from(std::cos(sector * side), std::sin(sector * side), 0);
    const Vector3 to(std::cos(sector * (side + 1)), std::sin(sector * (side + 1)), 0);
    const double roundness = static_cast<double>(loop) / rings_;
    return size(loop) * (roundness * circle + (1 - roundness) * ((1 - share) * from + share * to));
  }

 private:
  /// Radius of a loop: edges of a loop have one length, or spokes are cut so that quads are about square.
  [[nodiscard]] double size(int loop) const {
    if (corner_ == 1) return static_cast<double>(edges(loop)) / edges(rings_);
    return std::pow(1 + 2 * std::numbers::pi / sides_, loop - rings_);
  }

  int sides_;
  int rings_;
  int corner_;
};

/// A point of the unit disc on the patch: along a meridian of the sphere, or flat. The rim is an exact circle at z = 0.
Vector3 on_patch(const PolygonPatchOptions& options, const Vector3& flat, bool on_rim) {
  const double rim = options.half_angle * std::numbers::pi / 180;
  const double from_axis = std::hypot(flat.x(), flat.y());
  if (on_rim || rim == 0) return options.radius * flat;
  const double angle = rim * from_axis;
  const double sphere_radius = options.radius / std::sin(rim);
  const Vector3 direction = flat / from_axis;
  // cos(angle) − cos(rim), without cancellation.
  const double rise = 2 * std::sin((rim + angle) / 2) * std::sin((rim - angle) / 2);
  return sphere_radius * std::sin(angle) * direction + Vector3(0, 0, sphere_radius * rise);
}

}  // namespace

PolygonMesh polygon_patch(const PolygonPatchOptions& options) {
  require(options.sides >= 3, "sides", "3 or more", options.sides);
  require(options.rings >= 1, "rings", "1 or more", options.rings);
  require_length("radius", options.radius);
  require(options.half_angle == 0 || (options.half_angle >= 0.001 && options.half_angle <= 170), "half angle",
          "0 for a flat patch, or from 0.001 to 170 degrees", options.half_angle);
  require_node_count(options.sides * (options.rings + 1.0) * (options.rings + 1.0));

  const PolygonGrid grid(options);
  MeshBuilder builder;
  std::vector<Index> polygon;
  for (int loop = 0; loop <= options.rings; ++loop) {
    for (int side = 0; side < options.sides; ++side) {
      for (int j = 0; j < grid.edges(loop); ++j) {
        const Vector3 place = grid.place(loop, side, j);
        const Index node = builder.add_node(on_patch(options, place, loop == options.rings));
        if (loop == 0) polygon.push_back(node);
      }
    }
  }
  builder.add_face(polygon);
  for (int loop = 1; loop <= options.rings; ++loop) {
    for (int side = 0; side < options.sides; ++side) {
      if (grid.corner() == 1)
        builder.add_face({grid.node(loop - 1, side, 0), grid.node(loop, side, -1), grid.node(loop, side, 0),
                          grid.node(loop, side, 1)});
      for (int j = 0; j < grid.edges(loop - 1); ++j) {
        const int outer = j + grid.corner();
        builder.add_face({grid.node(loop - 1, side, j), grid.node(loop, side, outer), grid.node(loop, side, outer + 1),
                          grid.node(loop - 1, side, j + 1)});
      }
    }
  }
  return builder.take();
}

}  // namespace vspring::generate
