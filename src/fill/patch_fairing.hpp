#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "shape/incidence.hpp"
#include "vspring/fill.hpp"

namespace vspring {

/// Fairs the patches of a mesh whose holes are filled, with the faces around them. Patches that touch are faired
/// together, others separately: so the tolerance is relative to their own size, and a failure does not affect others.
class PatchFairing {
 public:
  /// incidence: of the input, which is the mesh without patches. All must outlive it.
  PatchFairing(const PolygonMesh& input, const Incidence& incidence, const FairOptions& options, Context& context)
      : input_(input), incidence_(incidence), options_(options), context_(context) {}

  /// Fairs the patches of `due` holes (one entry per hole), and those that touch them, from their present positions.
  /// Sets positions and outcomes. share: of the whole call, for progress. When cancelled, remaining patches stay.
  void run(FilledHoles& filled, const std::vector<std::uint8_t>& due, double begin, double share);

  /// Completes the report, and undoes the fairing of patches that made them cross more faces.
  void finish(FilledHoles& filled);

 private:
  using Holes = std::vector<std::size_t>;
  [[nodiscard]] std::vector<Holes> touching(const FilledHoles& filled) const;

  const PolygonMesh& input_;
  const Incidence& incidence_;
  const FairOptions& options_;
  Context& context_;
  std::map<std::size_t, FairReport> reports_;  ///< of groups of holes that touch, by their first hole
};

}  // namespace vspring
