#pragma once

#include <cstddef>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "fairing_arguments.hpp"
#include "holding.hpp"
#include "vspring/rules.hpp"
#include "vspring/symmetry.hpp"

namespace vspring::cli {

/// A line for people.
[[nodiscard]] std::string symmetry_line(const MirrorPlane& plane, bool is_half, Index pairs, Index on_plane);

/// A shape, and how it is symmetric with --symmetry.
template <typename Shape>
class MirroredShape {
 public:
  /// `shape` must outlive it. Throws what parse_plane() and find_symmetry() throw.
  MirroredShape(const FairingArguments& arguments, const Shape& shape) : shape_(&shape) {
    if (!arguments.symmetry.empty()) symmetric_ = find_symmetry(shape, parse_plane(plane_ = arguments.symmetry));
  }

  /// Constraints, with --symmetry those of the whole.
  [[nodiscard]] Constraints make_constraints(const FairingArguments& arguments, const RuleInput& input) const {
    return symmetric_ ? cli::make_constraints(arguments, *symmetric_, input)
                      : cli::make_constraints(arguments, *shape_, input);
  }

  /// The sharp edges that rules name, with --symmetry those of the whole.
  [[nodiscard]] MeshEdges sharp_edges_of_rules(const FairingArguments& arguments, RuleInput input) const {
    if (symmetric_) input.named_nodes = shape_->node_count();
    return with_images(cli::sharp_edges_of_rules(arguments, whole(), input));
  }
  /// With --symmetry the edges and their mirror images.
  [[nodiscard]] MeshEdges with_images(MeshEdges edges) const {
    const std::size_t count = symmetric_ ? edges.size() : 0;
    for (std::size_t k = 0; k < count; ++k) {
      const auto [a, b] = edges[k];
      edges.emplace_back(symmetric_->partner[static_cast<std::size_t>(a)],
                         symmetric_->partner[static_cast<std::size_t>(b)]);
    }
    return edges;
  }

  [[nodiscard]] FairResult fair(const Constraints& constraints, const FairOptions& options, Context& context) const {
    return symmetric_ ? vspring::fair(*symmetric_, constraints, options, context)
                      : vspring::fair(*shape_, constraints, options, context);
  }
  [[nodiscard]] FitResult fit(const Constraints& constraints, const ScatteredPoints& points, const FitOptions& options,
                              Context& context) const {
    return symmetric_ ? vspring::fit(*symmetric_, constraints, points, options, context)
                      : vspring::fit(*shape_, constraints, points, options, context);
  }

  [[nodiscard]] const Shape& shape() const { return *shape_; }
  /// With --symmetry the whole, whose first nodes are those of the shape.
  [[nodiscard]] const Shape& whole() const { return symmetric_ ? symmetric_->whole : *shape_; }

  /// The constraints of the shape itself; constraints: those of make_constraints().
  [[nodiscard]] Constraints of_shape(const Constraints& constraints) const {
    if (!symmetric_) return constraints;
    const Constraints whole = symmetric_constraints(*symmetric_, constraints);
    Constraints held(shape_->node_count());
    for (Index i = 0; i < held.node_count(); ++i) held.hold_as(i, whole, i);
    return held;
  }

  /// Figures for the report; empty without --symmetry.
  [[nodiscard]] nlohmann::ordered_json figures() const {
    if (!symmetric_) return nlohmann::ordered_json::object();
    return {{"symmetry",
             {{"plane", plane_},
              {"shape", symmetric_->is_half ? "half" : "whole"},
              {"pairs", symmetric_->pairs},
              {"nodes_on_plane", symmetric_->on_plane}}}};
  }
  /// Lines for people; empty without --symmetry.
  [[nodiscard]] std::string lines() const {
    return symmetric_ ? symmetry_line(symmetric_->plane, symmetric_->is_half, symmetric_->pairs, symmetric_->on_plane)
                      : "";
  }

 private:
  const Shape* shape_;
  std::string plane_;
  std::optional<Symmetric<Shape>> symmetric_;
};

/// Throws Error(invalid_argument) if an option is given that --symmetry does not go with.
void refuse_with_symmetry(const FairingArguments& arguments);

}  // namespace vspring::cli
