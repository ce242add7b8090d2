#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "commands/commands.hpp"
#include "commands/option_kinds.hpp"
#include "commands/shapes.hpp"
#include "exit_status.hpp"
#include "idle_options.hpp"
#include "interruption.hpp"
#include "terminal.hpp"
#include "vspring/generate.hpp"
#include "vspring/surface_file.hpp"
#include "vspring/topology.hpp"

namespace vspring::cli {

namespace {

/// Arguments of all shapes, besides their own.
struct GenerateArguments {
  std::string output;
  std::optional<SurfaceFormat> format;
  double noise = 0;
  bool noise_on_boundary = false;
  bool shuffle = false;
  std::uint64_t seed = 1;
};

int run_generate(const GenerateArguments& arguments, const MakeShape& make, RunFacts facts) {
  PolygonMesh mesh = make(arguments.seed);
  facts.has_noise = arguments.noise != 0;
  facts.draws_numbers = facts.draws_numbers || facts.has_noise || arguments.shuffle;
  const std::vector<std::uint8_t> boundary = boundary_nodes(mesh);
  facts.boundary_moves = std::ranges::find(boundary, 1) != boundary.end();
  // Seeds differ from the jitter's, so that no random numbers are used twice.
  if (arguments.noise != 0)
    mesh = generate::add_noise(mesh, arguments.noise, arguments.seed + 1, arguments.noise_on_boundary);
  if (arguments.shuffle) mesh = generate::shuffle(mesh, arguments.seed + 2).mesh;
  const UninterruptedWhileWriting guard;
  write_surface(arguments.output, mesh, arguments.format);
  Terminal(2, Colour::automatic).warn(idle_options(facts));
  return exit_converged;
}

/// Facts from the options of any shape.
RunFacts facts_of(const CLI::App& command) {
  RunFacts facts;
  facts.given = given_options(command);
  facts.draws_numbers = facts.given.contains("--jitter") && command["--jitter"]->as<double>() > 0;
  facts.is_flat = facts.given.contains("--profile") && command["--profile"]->as<std::string>() == "flat";
  return facts;
}

void add_common_options(CLI::App& command, GenerateArguments& arguments) {
  command
      .add_option("-o,--output", arguments.output, "Where the shape goes, format by extension; - for standard output")
      ->required()
      ->type_name("OUT");
  add_choice(command, "--format", arguments.format, surface_formats, "Format of - (default: the extension's)");
  const std::string group = "Disorder";
  command
      .add_option("--noise", arguments.noise,
                  "Move every inner node by a random vector within a ball of this radius, a length (default: 0)")
      ->type_name("LENGTH")
      ->check(non_negative_number())
      ->group(group);
  command.add_flag("--noise-on-boundary", arguments.noise_on_boundary, "Move boundary nodes, too (default: off)")
      ->group(group);
  command.add_flag("--shuffle", arguments.shuffle, "Nodes and faces in random order (default: off)")->group(group);
  command
      .add_option("--seed", arguments.seed,
                  "Seed of all random numbers: the same seed gives the same shape (default: 1)")
      ->type_name("N")
      ->check(any_number<std::uint64_t>())
      ->group(group);
}

}  // namespace

void add_generate_command(CLI::App& app, std::function<int()>& run) {
  CLI::App& generate = *app.add_subcommand("generate", "Make a shape for trials");
  generate.require_subcommand(1);
  generate.footer(
      "Example: the start shape of the paper's Fig. 8, with noise\n"
      "  vspring generate annulus --nodes 3644 --boundary-nodes 305 --noise 0.01 -o annulus.obj\n\n"
      "vspring generate SHAPE --help explains the options of a shape with their defaults and units. Lengths are in the "
      "units of the output.");
  add_shapes([&](const std::string& name, const std::string& description, const std::string& example,
                 MakeShape make) -> CLI::App& {
    const auto arguments = std::make_shared<GenerateArguments>();
    CLI::App& command = *generate.add_subcommand(name, description);
    add_common_options(command, *arguments);
    command.footer(fmt::format("Example:\n  vspring generate {} {}", name, example));
    command.callback([arguments, make = std::move(make), &run, &command] {
      run = [arguments, make, facts = facts_of(command)] { return run_generate(*arguments, make, facts); };
    });
    return command;
  });
}

}  // namespace vspring::cli
