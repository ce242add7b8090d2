#pragma once

#include <optional>
#include <set>
#include <string>
#include <vector>

#include "picture.hpp"
#include "terminal.hpp"
#include "vspring/fair.hpp"
#include "vspring/refine.hpp"
#include "vspring/remesh.hpp"

namespace vspring::cli {

enum class Hold { boundary, none };

/// Arguments of all commands that fair a shape.
struct FairingArguments {
  std::string input;
  std::string output;
  std::string rules;      ///< the name of their file
  std::string rule_text;  ///< its content, see read_rules()
  Hold fix = Hold::boundary;
  Hold fix_directions = Hold::none;
  /// Nodes and what they slide on, NODES=SUPPORT each.
  std::vector<std::string> slides;
  std::string region;
  std::string symmetry;
  std::optional<Refinement> refine;
  std::optional<Remeshing> remesh;
  std::optional<double> weld;  ///< nodes nearer than this share of the diagonal are joined; empty: as the format needs
  /// Given values of options that depend on each other; settle_options() turns them into `options`.
  std::optional<Method> method;
  double tolerance = EquilibriumMethod().tolerance;
  std::optional<double> step_tolerance;
  std::optional<int> max_iterations;
  std::optional<int> levels;
  int pre_smoothing = MultigridMethod().pre_smoothing;
  bool fair_boundary = false;
  std::optional<Distribution> distribution;
  FairOptions options;
  bool paper = false;
  int threads = 0;
  std::optional<double> time_limit;  ///< seconds
  std::string report;
  std::string html;
  PictureArguments picture;
  std::string scalars;
  std::string deviation;
  bool quiet = false;
  Colour colour = Colour::automatic;
  std::set<std::string> given;  ///< given options, by their long names

  /// Whether a page, a picture or scalars are asked for.
  [[nodiscard]] bool shows_shapes() const { return !(html.empty() && picture.path.empty() && scalars.empty()); }
};

}  // namespace vspring::cli
