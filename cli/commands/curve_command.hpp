#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace vspring::cli {

/// Adds `vspring curve`; see add_fair_command().
void add_curve_command(CLI::App& app, std::function<int()>& run);

}  // namespace vspring::cli
