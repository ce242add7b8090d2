#pragma once

#include <algorithm>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "any_shape.hpp"
#include "closed_chains.hpp"
#include "fairing_arguments.hpp"
#include "fitting.hpp"
#include "holding.hpp"
#include "idle_options.hpp"
#include "refining.hpp"
#include "sharp.hpp"
#include "symmetry.hpp"
#include "vspring/constraints.hpp"
#include "vspring/context.hpp"
#include "welding.hpp"

namespace vspring::cli {

/// The shape of a file that is to be faired or fitted, after --symmetry, --refine and --sharp, and its constraints.
template <typename File>
class PreparedShape {
 public:
  using Shape = ShapeOf<File>;

  /// Replaces file and welding by those of the refined file; both must outlive it. Gives the options of `arguments` the
  /// sharp edges. own_nodes_pull: see SharpEdgesOfRun. Throws what the options' own classes throw.
  PreparedShape(File& file, Welding& welding, const ClosedChains& closed, FairingArguments& arguments,
                const PullArguments& pull, bool own_nodes_pull, Context& context)
      : welding_(welding),
        mirrored_(arguments, welding.shape(file)),
        named_(with_rules_read(arguments), pull, file, welding, mirrored_),
        sharp_(mirrored_.whole(), named_, arguments, pull, own_nodes_pull, context),
        held_(made_constraints(file, closed, arguments)),
        refining_(arguments, file, welding, held_, named_) {
    if (refining_.is_idle()) return;
    mirrored_ = MirroredShape<Shape>(arguments, welding.shape(file));
    sharp_ = SharpEdgesOfRun(mirrored_.whole(), named_, arguments, pull, own_nodes_pull, context);
    arguments.options = sharp_.with_edges(arguments.options);
  }

  [[nodiscard]] const Shape& shape() const { return mirrored_.shape(); }
  [[nodiscard]] const MirroredShape<Shape>& mirrored() const { return mirrored_; }
  /// For MirroredShape::fair() and fit().
  [[nodiscard]] const Constraints& constraints() const { return held_; }

  /// For FitOptions; 0 where nothing was refined.
  [[nodiscard]] double boundary_reach() const { return refining_.boundary_reach(); }

  /// Takes from the sharp edges those that a fit has rounded.
  void leave_out(const MeshEdges& rounded) {
    if (!rounded.empty()) sharp_.leave_out(mirrored_.whole(), rounded);
  }

  /// Figures for the report.
  [[nodiscard]] nlohmann::ordered_json figures() const {
    auto figures = welding_.figures();
    figures.update(refining_.figures());
    figures.update(mirrored_.figures());
    figures.update(sharp_.figures());
    return figures;
  }
  /// Lines for people.
  [[nodiscard]] std::string lines() const {
    return welding_.lines() + refining_.lines() + mirrored_.lines() + sharp_.lines();
  }
  /// Warnings for people.
  [[nodiscard]] std::vector<std::string> warnings() const {
    std::vector<std::string> warnings = named_.warnings();
    std::ranges::move(sharp_.warnings(), std::back_inserter(warnings));
    return warnings;
  }
  /// The facts of a run that it knows.
  [[nodiscard]] RunFacts facts() const {
    return {.refines_nothing = refining_.refines_nothing(),
            .remeshes_nothing = refining_.remeshes_nothing(),
            .sharp_edges = sharp_.count(),
            .takes_marks = named_.takes_marks(),
            .sharp_option_is_idle = sharp_.option_is_idle()};
  }

 private:
  static const FairingArguments& with_rules_read(FairingArguments& arguments) {
    read_rules(arguments);
    return arguments;
  }
  /// Also gives the options the sharp edges: normals at the boundary are those of each side.
  Constraints made_constraints(const File& file, const ClosedChains& closed, FairingArguments& arguments) const {
    arguments.options = sharp_.with_edges(arguments.options);
    Constraints held = mirrored_.make_constraints(arguments, welding_.rules(file));
    closed.hold(held);
    return held;
  }

  const Welding& welding_;
  MirroredShape<Shape> mirrored_;
  NamedSharpEdges named_;
  SharpEdgesOfRun sharp_;
  Constraints held_;
  Refining refining_;
};

}  // namespace vspring::cli
