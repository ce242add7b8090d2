#pragma once

#include <string>

#include "picture.hpp"
#include "terminal.hpp"
#include "vspring/fair.hpp"

namespace CLI {
class App;
}

namespace vspring::cli {

enum class Hold { boundary, none };

/// What all commands that fair a shape are told.
struct FairingArguments {
  std::string input;
  std::string output;
  std::string rules;
  Hold fix = Hold::boundary;
  Hold fix_directions = Hold::none;
  std::string region;
  FairOptions options;
  std::optional<Distribution> distribution;  ///< else what the command takes by itself
  bool paper = false;
  int threads = 0;
  std::string report;
  std::string html;
  PictureArguments picture;
  std::string scalars;
  std::string deviation;
  bool quiet = false;
  Colour colour = Colour::automatic;
};

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
void add_stopping_options(CLI::App& command, FairingArguments& arguments);
void add_shaping_options(CLI::App& command, FairingArguments& arguments, const FairingWords& words);
void add_run_options(CLI::App& command, FairingArguments& arguments);

inline const std::string holding_group = "What holds the shape";
inline const std::string fairing_group = "How it is faired";
inline const std::string run_group = "The run";

}  // namespace vspring::cli
