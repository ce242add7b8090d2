#pragma once

#include <functional>

namespace CLI {
class App;
}

namespace vspring::cli {

// Each adds its command to the program. The given command sets `run`, which runs it and returns the exit status.
void add_fair_command(CLI::App& app, std::function<int()>& run);
void add_curve_command(CLI::App& app, std::function<int()>& run);
void add_fit_command(CLI::App& app, std::function<int()>& run);
void add_fill_command(CLI::App& app, std::function<int()>& run);
void add_span_command(CLI::App& app, std::function<int()>& run);
void add_edit_command(CLI::App& app, std::function<int()>& run);
void add_generate_command(CLI::App& app, std::function<int()>& run);
void add_measure_command(CLI::App& app, std::function<int()>& run);

}  // namespace vspring::cli
