#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>
#include <vector>

#include "base/degrees.hpp"
#include "symmetry/reach.hpp"
#include "vspring/error.hpp"
#include "vspring/symmetry.hpp"

namespace vspring {

namespace {

// Radians.
constexpr double same_direction = 0.01;

[[noreturn]] void refuse_constraint(const std::string& message) {
  throw Error(ErrorCode::unusable_constraint, message);
}

NodeSide other_side(NodeSide side) { return side == NodeSide::before ? NodeSide::after : NodeSide::before; }

/// Which way chains run at mirror images.
class Senses {
 public:
  /// Surfaces have no tangents.
  explicit Senses(const Symmetric<PolygonMesh>& /*shape*/) {}
  explicit Senses(const Symmetric<PolygonCurve>& shape) : partner_(&shape.partner) {
    next_.assign(shape.partner.size(), -1);
    for_each_edge(shape.whole, [&](Index a, Index b) { next_[static_cast<std::size_t>(a)] = b; });
    previous_.assign(shape.partner.size(), -1);
    for_each_edge(shape.whole, [&](Index a, Index b) { previous_[static_cast<std::size_t>(b)] = a; });
  }

  /// Whether the chain at the mirror image of a node runs against the mirror image of the node's own chain.
  [[nodiscard]] bool reversed(Index node) const {
    const Index image = (*partner_)[static_cast<std::size_t>(node)];
    const auto follows = [&](const std::vector<Index>& following) {
      const Index neighbour = following[static_cast<std::size_t>(node)];
      return neighbour >= 0 &&
             (*partner_)[static_cast<std::size_t>(neighbour)] == following[static_cast<std::size_t>(image)];
    };
    return !follows(next_) && !follows(previous_);
  }

 private:
  const std::vector<Index>* partner_ = nullptr;
  std::vector<Index> next_;
  std::vector<Index> previous_;
};

template <typename Shape>
class ConstraintMirror {
 public:
  ConstraintMirror(const Symmetric<Shape>& shape, Constraints held)
      : shape_(shape), senses_(shape), held_(std::move(held)), nearness_(nearness_on_plane(shape)) {}

  Constraints make_symmetric() {
    for (Index i = 0; i < held_.node_count(); ++i) {
      const Index image = shape_.partner[static_cast<std::size_t>(i)];
      if (image == i) {
        settle_on_plane(i);
      } else if (image > i) {
        if (!shape_.is_half) agree(i, image);
        mirror(i, image);
      }
    }
    return std::move(held_);
  }

 private:
  [[nodiscard]] Vector3 direction(const Vector3& given) const { return shape_.plane.mirrored_direction(given); }
  [[nodiscard]] Support mirrored(const Support& given) const {
    return given.mirrored(shape_.plane.point, shape_.plane.normal);
  }
  [[nodiscard]] double sense(Index node) const { return senses_.reversed(node) ? -1 : 1; }

  /// Holds the mirror image as the node is.
  void mirror(Index node, Index image) {
    held_.hold_as(image, held_, node);
    if (held_.position_fixed(node)) held_.fix_position(image, shape_.plane.mirrored(held_.position(node)));
    if (held_.support(node) != nullptr) held_.slide_on(image, mirrored(*held_.support(node)));
    if (held_.normal_fixed(node)) held_.fix_normal(image, direction(held_.normal(node)));
    if (held_.tangent_fixed(node)) held_.fix_tangent(image, sense(node) * direction(held_.tangent(node)));
    if (!held_.corner(node)) return;
    held_.free_tangent(image);
    for (const NodeSide side : node_sides) {
      if (held_.tangent_fixed(node, side)) held_.fix_tangent(image, image_of(node, side), side_at_image(node, side));
    }
  }

  [[nodiscard]] NodeSide side_at_image(Index node, NodeSide side) const {
    return senses_.reversed(node) ? other_side(side) : side;
  }
  [[nodiscard]] Vector3 image_of(Index node, NodeSide side) const {
    return sense(node) * direction(held_.tangent(node, side));
  }

  /// Gives the first node the mean of both.
  void agree(Index node, Index image) {
    require_both(node, image, held_.position_fixed(node), held_.position_fixed(image), "its position held");
    require_both(node, image, held_.normal_fixed(node), held_.normal_fixed(image), "its normal given");
    require_both(node, image, held_.tangent_fixed(node), held_.tangent_fixed(image), "its tangent given");
    require_both(node, image, held_.corner(node), held_.corner(image), "a corner");
    require_both(node, image, held_.support(node) != nullptr, held_.support(image) != nullptr, "something to slide on");
    if (held_.support(node) != nullptr)
      require_same_place(node, *held_.support(node), mirrored(*held_.support(image)), "that of its mirror image");
    if (held_.position_fixed(node)) {
      const Vector3 other = shape_.plane.mirrored(held_.position(image));
      const double apart = (held_.position(node) - other).norm();
      const double in_input = (given(node) - shape_.plane.mirrored(given(image))).norm();
      if (!(apart <= std::max(in_input, nearness_)))
        refuse_constraint(
            fmt::format("nodes {} and {} are mirror images in {}, but are held at places that are not: {:.4g} apart; "
                        "hold them at mirror images",
                        node, image, in_words(shape_.plane), apart));
      held_.fix_position(node, (held_.position(node) + other) / 2);
    }
    if (held_.normal_fixed(node)) {
      Vector3 other = direction(held_.normal(image));
      if (other.dot(held_.normal(node)) < 0) other = -other;
      held_.fix_normal(node, mean(node, image, held_.normal(node), other, "normals"));
    }
    if (held_.tangent_fixed(node))
      held_.fix_tangent(
          node, mean(node, image, held_.tangent(node), sense(node) * direction(held_.tangent(image)), "tangents"));
    if (held_.corner(node)) agree_at_corner(node, image);
  }

  void agree_at_corner(Index node, Index image) {
    for (const NodeSide side : node_sides) {
      const NodeSide of_image = side_at_image(node, side);
      require_both(node, image, held_.tangent_fixed(node, side), held_.tangent_fixed(image, of_image),
                   "a tangent on one side");
      if (held_.tangent_fixed(node, side))
        held_.fix_tangent(node,
                          mean(node, image, held_.tangent(node, side),
                               sense(node) * direction(held_.tangent(image, of_image)), "tangents"),
                          side);
    }
  }

  /// Of a node that slides: beside it, both supports are alike.
  void require_same_place(Index node, const Support& support, const Support& other, const char* which) const {
    const auto place = support.nearest(given(node));
    const auto there = other.nearest(given(node));
    const bool is_same = place && there && (*place - *there).norm() <= nearness_ &&
                         1 - std::abs(support.axis(*place).dot(other.axis(*place))) <= same_direction * same_direction;
    if (!is_same)
      refuse_constraint(
          fmt::format("node {} slides on something whose mirror image in {} is not {}; let both slide on "
                      "mirror images",
                      node, in_words(shape_.plane), which));
  }

  void require_both(Index node, Index image, bool has, bool image_has, const char* what) const {
    if (has == image_has) return;
    refuse_constraint(fmt::format("node {} has {}, and its mirror image in {}, node {}, has not: give both or neither",
                                  has ? node : image, what, in_words(shape_.plane), has ? image : node));
  }

  [[nodiscard]] Vector3 mean(Index node, Index image, const Vector3& a, const Vector3& b, const char* what) const {
    if (!((a - b).norm() <= same_direction))
      refuse_constraint(
          fmt::format("nodes {} and {} are mirror images in {}, but their {} are not: by {:.3g}°; give them mirror "
                      "images",
                      node, image, in_words(shape_.plane), what, degrees((a - b).norm())));
    return a + b;
  }

  /// Of the angle between unit vectors that far apart.
  static double degrees(double apart) { return 2 * std::asin(std::min(apart / 2, 1.0)) * degrees_per_radian; }

  void settle_on_plane(Index node) {
    const MirrorPlane& plane = shape_.plane;
    if (held_.position_fixed(node)) {
      const double off = std::abs(plane.distance(held_.position(node)));
      if (!(off <= std::max(std::abs(plane.distance(given(node))), nearness_)))
        refuse_constraint(fmt::format("node {} lies in {}, but is held {:.4g} away from it; hold it in the plane", node,
                                      in_words(plane), off));
      held_.fix_position(node, plane.projected(held_.position(node)));
    }
    if (held_.support(node) != nullptr)
      require_same_place(node, *held_.support(node), mirrored(*held_.support(node)), "that itself");
    if (held_.normal_fixed(node)) {
      const Vector3 normal = held_.normal(node);
      const Vector3 within = normal - normal.dot(plane.normal) * plane.normal;
      if (!(std::abs(normal.dot(plane.normal)) <= same_direction))
        refuse_constraint(
            fmt::format("node {} lies in {}, but its normal does not, so the shape and its mirror image would meet in "
                        "an edge; give it a normal in the plane",
                        node, in_words(plane)));
      held_.fix_normal(node, within);
    }
    if (held_.tangent_fixed(node)) held_.fix_tangent(node, across(node));
    if (held_.corner(node)) settle_corner(node);
  }

  /// The tangent of a node on the plane, through which the curve goes straight.
  [[nodiscard]] Vector3 across(Index node) const {
    const Vector3 image = sense(node) * direction(held_.tangent(node));
    if (!((held_.tangent(node) - image).norm() <= 2 * same_direction))
      refuse_constraint(
          fmt::format("node {} lies in {}, but its tangent does not go straight through it, so the curve and its "
                      "mirror image would meet in a corner; give it a tangent along the plane's normal",
                      node, in_words(shape_.plane)));
    return held_.tangent(node) + image;
  }

  void settle_corner(Index node) {
    for (const NodeSide side : node_sides) {
      if (!held_.tangent_fixed(node, side)) continue;
      const NodeSide other = side_at_image(node, side);
      const Vector3 image = image_of(node, side);
      held_.fix_tangent(
          node,
          held_.tangent_fixed(node, other) ? mean(node, node, held_.tangent(node, other), image, "tangents") : image,
          other);
    }
  }

  [[nodiscard]] const Vector3& given(Index node) const { return shape_.given.position(node); }

  const Symmetric<Shape>& shape_;
  Senses senses_;
  Constraints held_;
  double nearness_;
};

template <typename Shape>
Constraints mirror_constraints(const Symmetric<Shape>& shape, const Constraints& constraints) {
  const Index given = shape.given.node_count();
  const Index whole = shape.whole.node_count();
  if (constraints.node_count() != given && constraints.node_count() != whole)
    throw Error(ErrorCode::invalid_argument,
                fmt::format("constraints are for {} nodes; the shape has {}, and {} with its mirror image",
                            constraints.node_count(), given, whole));
  Constraints held = constraints;
  held.add_nodes(whole - constraints.node_count());
  return ConstraintMirror(shape, std::move(held)).make_symmetric();
}

}  // namespace

Constraints symmetric_constraints(const Symmetric<PolygonMesh>& shape, const Constraints& constraints) {
  return mirror_constraints(shape, constraints);
}

Constraints symmetric_constraints(const Symmetric<PolygonCurve>& shape, const Constraints& constraints) {
  return mirror_constraints(shape, constraints);
}

}  // namespace vspring
