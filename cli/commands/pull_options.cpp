#include <CLI/CLI.hpp>
#include <cmath>
#include <optional>
#include <string>

#include "commands/option_kinds.hpp"
#include "commands/shared_options.hpp"
#include "fitting.hpp"

namespace vspring::cli {

namespace {

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
          text + "; auto: by the noise that the nodes seem to have (of voxels, on surfaces: their steps come off)")
      ->type_name("D|auto");
}

}  // namespace

void add_pull_options(CLI::App& command, PullArguments& arguments, const std::string& heading) {
  command
      .add_option("--weight", arguments.weight,
                  "The paper's k: how much a point counts against the springs of its node; 0.01 takes away waves of "
                  "some 12 edges, 0.00001 of some 66, large ones interpolate")
      ->type_name("K")
      ->check(non_negative_number())
      ->group(heading);
  command
      .add_option("--smoothing-length", arguments.smoothing_length,
                  "Take away what is shorter than about 6 times this, whatever the mesh (units of the input)")
      ->type_name("L")
      ->check(positive_number())
      ->group(heading);
  add_amount(
      command, "--within", arguments.within, arguments,
      "The fairest shape from which no point is further away than this (nodes may slide further along it); of scans "
      "whose noise is about a third of that: noise off, details kept (units of the input)")
      ->group(heading);
  add_amount(command, "--rms", arguments.rms, arguments,
             "The fairest shape from which points are this far away, root mean square (units of the input)")
      ->group(heading);
  add_amount(command, "--noise", arguments.noise, arguments,
             "Take noise of this standard deviation off: surfaces whose own nodes are the points keep what more than "
             "noise says, curves are the fairest that are as far from the points as that leaves (in each coordinate, "
             "units of the input)")
      ->group(heading);
  command
      .add_option("--outliers", arguments.outliers,
                  "Leave this share of the points out, those furthest away: 0 to less than 1 (default: 0)")
      ->type_name("P")
      ->check(number_between(0, 0.999999))
      ->group(heading);
}

void add_curve_bounds(CLI::App& command, PullArguments& arguments, const std::string& heading) {
  command
      .add_option(
          "--sharp", arguments.sharp,
          "Curves: where they turn by more than this, at a node or, drawn to points, within some eight tolerances, "
          "corners stay, and each side is fair by itself (degrees, less than 180) (default: none stay)")
      ->type_name("ANGLE")
      ->check(angle_of_corners())
      ->group(fairing_group);
  command
      .add_option(
          "--min-radius", arguments.least_radius,
          "Curves: nowhere bent by a smaller radius than this, as by what a vehicle or a tool can turn (units of "
          "the input) (default: any)")
      ->type_name("R")
      ->check(positive_number())
      ->group(heading);
}

}  // namespace vspring::cli
