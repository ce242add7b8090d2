#include <CLI/CLI.hpp>
#include <cmath>
#include <map>
#include <optional>
#include <sstream>
#include <string>

#include "commands/option_kinds.hpp"
#include "commands/shared_options.hpp"
#include "fitting.hpp"

namespace vspring::cli {

namespace {

const std::map<std::string, SharpCurves> sharp_curves = {{"fit", SharpCurves::fit}, {"hold", SharpCurves::hold}};

/// A number more than 0, or auto, which settle_by_noise() sets.
CLI::Option* add_amount(CLI::App& command, const std::string& name, std::optional<double>& value,
                        PullArguments& arguments, const std::string& text) {
  return command
      .add_option_function<std::string>(
          name,
          [&value, &arguments, name](const std::string& given) {
            double number = 1;
            if (given == "auto")
              arguments.automatic = name;
            else if (!CLI::detail::lexical_cast(given, number) || !(number > 0 && std::isfinite(number)))
              throw CLI::ValidationError(name, "a number greater than 0, or auto, is needed, not " + given);
            value = number;
          },
          text + "; auto: from the estimated noise of the nodes (surfaces of voxels: removes their steps)")
      ->type_name("D|auto");
}

/// --sharp of surfaces: an angle, marked, or both between a comma.
CLI::Option* add_sharp(CLI::App& command, PullArguments& arguments, const std::string& text) {
  return command
      .add_option_function<std::string>(
          "--sharp",
          [&arguments](const std::string& given) {
            std::istringstream rest(given + ",");
            for (std::string word; std::getline(rest, word, ',');) {
              word = CLI::detail::trim(word);
              if (word == "marked") {
                arguments.sharp_marks = true;
                continue;
              }
              const std::string fault = angle_of_corners()(word);
              if (!fault.empty() || !CLI::detail::lexical_cast(word, arguments.sharp))
                throw CLI::ValidationError("--sharp", fault + "; or marked, or both as in 40,marked");
            }
          },
          text +
              "; marked: edges that the file marks, by lines (l) of OBJ or the element edge of PLY (degrees, less "
              "than 180, or marked, or both) (default: none)")
      ->type_name("ANGLE|marked")
      ->group(fairing_group);
}

}  // namespace

void add_pull_options(CLI::App& command, PullArguments& arguments, const std::string& heading) {
  command
      .add_option("--weight", arguments.weight,
                  "The paper's k: the weight of a point against the springs of its node; 0.01 removes waves of about "
                  "12 edges, 0.00001 of about 66; large weights interpolate")
      ->type_name("K")
      ->check(non_negative_number())
      ->group(heading);
  command
      .add_option("--smoothing-length", arguments.smoothing_length,
                  "Remove details shorter than about 6 times this, on any mesh (units of the input)")
      ->type_name("L")
      ->check(positive_number())
      ->group(heading);
  add_amount(command, "--within", arguments.within, arguments,
             "The fairest shape with no point further away than this; nodes may slide further along it. Scans with "
             "noise of about a third of this lose noise and keep details (units of the input)")
      ->group(heading);
  add_amount(command, "--rms", arguments.rms, arguments,
             "The fairest shape whose root mean square distance from the points is this (units of the input)")
      ->group(heading);
  add_amount(command, "--noise", arguments.noise, arguments,
             "Remove noise of this standard deviation in each coordinate: surfaces fitted to their own nodes keep "
             "larger details, curves become the fairest as far from the points as such noise (units of the input)")
      ->group(heading);
  command
      .add_option("--outliers", arguments.outliers,
                  "Leave out points that are far off, at most this share of all: 0 to less than 1 (default: 0)")
      ->type_name("P")
      ->check(number_between(0, 0.999999))
      ->group(heading);
}

void add_sharp_edges(CLI::App& command, PullArguments& arguments) {
  add_sharp(command, arguments,
            "Keep edges sharp at which the surface turns by more than this: each side has its own tangent plane there. "
            "With the nodes of the input as points, edges of noise are left out");
}

void add_sharp_curves(CLI::App& command, FairingArguments& arguments) {
  add_choice(command, "--sharp-curves", arguments.options.sharp_curves, sharp_curves,
             "Surfaces: sharp edges stay where they are (hold), or are made fair as curves in space, with the nodes of "
             "the input as points drawn to these (fit) (default: fit if the nodes of the input are points, else hold)")
      ->group(fairing_group);
}

void add_curve_bounds(CLI::App& command, PullArguments& arguments, const std::string& heading, bool with_surfaces) {
  const std::string words =
      "Curves: keep corners where the curve turns by more than this, at a node or, fitted to points, within about "
      "eight tolerances; each side is fair by itself";
  if (with_surfaces)
    add_sharp(command, arguments,
              words + ". Surfaces: keep edges sharp that turn by more; each side has its own tangent plane there");
  else
    command.add_option("--sharp", arguments.sharp, words + " (degrees, less than 180) (default: none)")
        ->type_name("ANGLE")
        ->check(angle_of_corners())
        ->group(fairing_group);
  command
      .add_option("--min-radius", arguments.least_radius,
                  "Curves: the least radius of curvature, such as the turning radius of a vehicle or a tool (units of "
                  "the input) (default: any)")
      ->type_name("R")
      ->check(positive_number())
      ->group(heading);
}

}  // namespace vspring::cli
