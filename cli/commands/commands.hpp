#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace vspring::cli {

/// Adds `vspring fair`. The chosen command leaves what is to be run in `run`, which returns the exit status.
void add_fair_command(CLI::App& app, std::function<int()>& run);

}  // namespace vspring::cli
