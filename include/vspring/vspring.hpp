#pragma once

/// All of the library.
#include "vspring/constraints.hpp"
#include "vspring/context.hpp"
#include "vspring/curve_file.hpp"
#include "vspring/error.hpp"
#include "vspring/fair.hpp"
#include "vspring/fairness.hpp"
#include "vspring/generate.hpp"
#include "vspring/model.hpp"
#include "vspring/output_file.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"
#include "vspring/resample.hpp"
#include "vspring/surface_file.hpp"
#include "vspring/topology.hpp"
#include "vspring/types.hpp"
#include "vspring/version.hpp"
