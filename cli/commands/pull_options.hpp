#pragma once

#include <string>

namespace CLI {
class App;
}

namespace vspring::cli {

struct PullArguments;

inline const std::string pull_of_own_nodes = "How the nodes of the input pull as points: none or one of";

/// How points pull. heading: of the options in the help text. for_surfaces: also what curves cannot have. `arguments`
/// must outlive the command.
void add_pull_options(CLI::App& command, PullArguments& arguments, const std::string& heading, bool for_surfaces);

}  // namespace vspring::cli
