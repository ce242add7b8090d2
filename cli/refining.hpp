#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "fairing_arguments.hpp"
#include "sharp.hpp"
#include "vspring/constraints.hpp"
#include "vspring/curve_file.hpp"
#include "vspring/refine.hpp"
#include "vspring/remesh.hpp"
#include "vspring/surface_file.hpp"
#include "welding.hpp"

namespace vspring::cli {

/// Refines or remeshes the moving part of the input, by --refine or --remesh.
class Refining {
 public:
  /// Replaces file, welding, constraints and sharp edges by those of the refined file. New nodes are joined
  /// where the nodes of their edge are, however near they are to others. Sharp edges of the options of `arguments` stay
  /// lines when remeshing. Does nothing without the option. Throws what refine(), remesh() and refined_file() throw.
  Refining(const FairingArguments& arguments, SurfaceFile& file, Welding& welding, Constraints& constraints,
           NamedSharpEdges& sharp);
  /// Throws Error(invalid_argument) if a curve is to be refined.
  Refining(const FairingArguments& arguments, const CurveFile& file, Welding& welding, Constraints& constraints,
           NamedSharpEdges& sharp);

  /// Figures for the report; empty without the option.
  [[nodiscard]] nlohmann::ordered_json figures() const;
  /// A line for people; empty without the option.
  [[nodiscard]] std::string lines() const;
  /// Whether --refine was given and nothing had to be divided.
  [[nodiscard]] bool refines_nothing() const { return how_ && is_idle_; }
  /// Whether --remesh was given and no face moves.
  [[nodiscard]] bool remeshes_nothing() const { return remesh_ && is_idle_; }
  /// Whether the shape is still that of the input.
  [[nodiscard]] bool is_idle() const { return is_idle_; }
  /// Of the surface before, for FitOptions; 0 without the option.
  [[nodiscard]] double boundary_reach() const { return boundary_reach_; }

 private:
  void take(SurfaceFile& file, Welding& welding, Constraints& constraints, NamedSharpEdges& sharp,
            const Refined& refined, const Remeshed* remeshed);

  std::optional<Refinement> how_;
  std::optional<Remeshing> remesh_;
  bool is_idle_ = true;
  Index new_nodes_ = 0;
  Index removed_nodes_ = 0;
  Index new_faces_ = 0;
  double boundary_reach_ = 0;
};

}  // namespace vspring::cli
