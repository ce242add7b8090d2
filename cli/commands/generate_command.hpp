#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace vspring::cli {

/// Adds `vspring generate` with one command for each shape; see add_fair_command().
void add_generate_command(CLI::App& app, std::function<int()>& run);

}  // namespace vspring::cli
