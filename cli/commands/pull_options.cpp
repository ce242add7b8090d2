#include "commands/pull_options.hpp"

#include <CLI/CLI.hpp>

#include "fitting.hpp"

namespace vspring::cli {

void add_pull_options(CLI::App& command, PullArguments& arguments, const std::string& heading) {
  command
      .add_option("--weight", arguments.weight,
                  "The paper's k: how much a point counts against the springs of its node; 0.01 takes away waves of "
                  "some 12 edges, 0.00001 of some 66, large ones interpolate")
      ->type_name("K")
      ->check(CLI::NonNegativeNumber)
      ->group(heading);
  command
      .add_option("--smoothing-length", arguments.smoothing_length,
                  "Take away what is shorter than about 6 times this, whatever the mesh (units of the input)")
      ->type_name("L")
      ->check(CLI::PositiveNumber)
      ->group(heading);
  command
      .add_option("--within", arguments.within,
                  "The fairest shape from which no point is further away than this (units of the input)")
      ->type_name("D")
      ->check(CLI::PositiveNumber)
      ->group(heading);
  command
      .add_option("--rms", arguments.rms,
                  "The fairest shape from which points are this far away, root mean square (units of the input)")
      ->type_name("D")
      ->check(CLI::PositiveNumber)
      ->group(heading);
  command
      .add_option("--outliers", arguments.outliers,
                  "Leave this share of the points out, those furthest away: 0 to less than 1 (default: 0)")
      ->type_name("P")
      ->check(CLI::Range(0.0, 0.999999))
      ->group(heading);
}

}  // namespace vspring::cli
