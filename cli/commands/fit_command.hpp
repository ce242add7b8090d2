#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace vspring::cli {

/// Adds `vspring fit`; see add_fair_command().
void add_fit_command(CLI::App& app, std::function<int()>& run);

}  // namespace vspring::cli
