// Filling holes: options and reports, and patches as plain arrays.

#pragma once

#include "values.hpp"

namespace vspring {

/// Options from an object with some of `at`, `outerRims`, `maxSize`, `maxEdges` and `flat`, as in FillOptions.
FillOptions fill_options_of(const val& settings);

/// The report of fairing, plus `holes`.
val to_val(const FilledHoles& filled);

/// The patches that were added to a file: `positions` of their nodes, `corners` of their triangles, `nodeLike`,
/// `faceLike`, `groupBegin`, the first faces of groups, and `groupNames`.
val patches_of(const SurfaceFile& file);

/// Replaces the patches of a file by others, as of patches_of(), or by none where they are null.
void set_patches(SurfaceFile& file, const val& patches);

}  // namespace vspring
