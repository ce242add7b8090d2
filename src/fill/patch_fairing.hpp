#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "shape/incidence.hpp"
#include "vspring/fill.hpp"

namespace vspring {

/// Fairs the patches of a mesh whose holes are filled: those that touch together, others one by one, each with the
/// faces around it, so that its tolerance is a share of its own size and one that fails leaves the others alone.
class PatchFairing {
 public:
  /// incidence: of the input, which is the mesh without patches. All must outlive it.
  PatchFairing(const PolygonMesh& input, const Incidence& incidence, const FairOptions& options, Context& context)
      : input_(input), incidence_(incidence), options_(options), context_(context) {}

  /// Fairs patches from where their nodes are, those of `due` holes (one entry each) and those that touch them. Sets
  /// positions and outcomes. share: of the whole call, for progress. When cancelled, patches that are left stay.
  void run(FilledHoles& filled, const std::vector<std::uint8_t>& due, double begin, double share);

  /// Fills the report with all that was done, and makes patches flat again that cross more faces than flat ones.
  void finish(FilledHoles& filled);

 private:
  using Holes = std::vector<std::size_t>;
  [[nodiscard]] std::vector<Holes> touching(const FilledHoles& filled) const;

  const PolygonMesh& input_;
  const Incidence& incidence_;
  const FairOptions& options_;
  Context& context_;
  std::map<std::size_t, FairReport> reports_;  ///< of holes that touch, by the first of them
};

}  // namespace vspring
