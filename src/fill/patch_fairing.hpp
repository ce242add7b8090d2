#pragma once

#include "shape/incidence.hpp"
#include "vspring/fill.hpp"

namespace vspring {

/// Fairs the patches of a mesh whose holes are filled: those that touch together, others one by one, each with the
/// faces around it, so that its tolerance is a share of its own size and one that fails leaves the others alone. Fills
/// positions, the report and the outcomes of holes. input, incidence: without the patches. When cancelled, patches that
/// are left stay flat.
void fair_patches(FilledHoles& filled, const PolygonMesh& input, const Incidence& incidence, const FairOptions& options,
                  Context& context);

}  // namespace vspring
