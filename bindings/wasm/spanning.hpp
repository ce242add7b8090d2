// Surfaces from curves: options and reports.

#pragma once

#include "values.hpp"

namespace vspring {

/// Options from an object with some of `length`, `join`, `fairCurves`, `sharp`, `symmetry`, `loops`, `also`, `without`
/// and `flat`, as in SpanOptions.
SpanOptions span_options_of(const val& settings);

/// The report of fairing, plus `curves`, `loops`, `held`, `heldNormals`, `sharpEdges` and `surface`, the bytes of an
/// OBJ file.
val to_val(const SpannedCurves& spanned);

}  // namespace vspring
