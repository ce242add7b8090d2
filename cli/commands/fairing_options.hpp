#pragma once

#include <string>

namespace CLI {
class App;
}

namespace vspring::cli {

struct FairingArguments;

/// How help texts call things.
struct FairingWords {
  std::string shape;       ///< "surface" or "curve"
  std::string input;       ///< what files the input may be
  std::string ends;        ///< "Boundary nodes" or "End nodes"
  std::string directions;  ///< what --fix-normals fixes
  std::string rim;         ///< what fixed neighbours of a region get
  std::string rules;       ///< what rules speak of
};

// Options by their groups in the help text. `arguments` must outlive the command.
void add_files(CLI::App& command, FairingArguments& arguments, const FairingWords& words);
void add_constraint_options(CLI::App& command, FairingArguments& arguments, const FairingWords& words);
void add_weld_option(CLI::App& command, FairingArguments& arguments);
void add_stopping_options(CLI::App& command, FairingArguments& arguments);
void add_shaping_options(CLI::App& command, FairingArguments& arguments, const FairingWords& words);
void add_run_options(CLI::App& command, FairingArguments& arguments);

inline const std::string holding_group = "What holds the shape";
inline const std::string fairing_group = "How it is faired";
inline const std::string run_group = "The run";

}  // namespace vspring::cli
