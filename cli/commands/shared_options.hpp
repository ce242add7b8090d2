#pragma once

#include <string>
#include <vector>

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
  std::string rules;       ///< what rules speak of
};

// Options by their groups in the help text. `arguments` must outlive the command.
void add_files(CLI::App& command, FairingArguments& arguments, const FairingWords& words);
void add_constraint_options(CLI::App& command, FairingArguments& arguments, const FairingWords& words);
void add_weld_option(CLI::App& command, FairingArguments& arguments);
void add_stopping_options(CLI::App& command, FairingArguments& arguments, const std::string& default_step);
void add_shaping_options(CLI::App& command, FairingArguments& arguments, const FairingWords& words);
/// An option for the columns of tables. whose: of which files, and else.
void add_columns(CLI::App& command, const std::string& flag, std::vector<std::string>& columns,
                 const std::string& whose);
void add_run_options(CLI::App& command, FairingArguments& arguments);

inline const std::string columns_of_curves =
    "CSV and XYZ: the columns of x, y and, in space, z, by number from 1 or, in CSV, by the names in the header "
    "(default: those that the header names x, y, z, with units or without; else two or three of numbers)";
inline const std::string holding_group = "What holds the shape";
inline const std::string fairing_group = "How it is faired";
inline const std::string run_group = "The run";

}  // namespace vspring::cli
