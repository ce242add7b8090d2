#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "terminal.hpp"
#include "vspring/fair.hpp"

namespace vspring::cli {

/// The report of a run for scripts, with the keys that docs/command-line.md promises.
[[nodiscard]] nlohmann::ordered_json to_json(const FairReport& report);

/// What a person wants to know of a run, some lines. diagonal: of the box around the shape, for moves relative to it.
/// options: that it was given.
[[nodiscard]] std::string summary(const FairReport& report, double diagonal, const FairOptions& options,
                                  const Terminal& terminal);

}  // namespace vspring::cli
