#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <memory>
#include <new>
#include <string>
#include <system_error>

#include "browser.hpp"
#include "commands/commands.hpp"
#include "commands/option_kinds.hpp"
#include "editor_server.hpp"
#include "exit_status.hpp"
#include "interruption.hpp"
#include "terminal.hpp"
#include "vspring/curve_file.hpp"
#include "vspring/error.hpp"
#include "vspring/output_file.hpp"
#include "vspring/surface_file.hpp"

namespace vspring::cli {

namespace {

struct EditArguments {
  std::string input;
  std::string output;
  int port = 0;
  bool no_browser = false;
  bool quiet = false;
};

namespace fs = std::filesystem;

/// The folder of the built page: VSPRING_EDITOR, else where it is installed with the program or built next to it.
std::string page_folder() {
  const auto whole = [](const fs::path& folder) {
    return fs::is_regular_file(folder / "index.html") && fs::is_regular_file(folder / "vspring_core.wasm");
  };
  if (const char* given = std::getenv("VSPRING_EDITOR"); given != nullptr && *given != '\0') {
    if (whole(given)) return given;
    throw Error(ErrorCode::unusable_file, fmt::format("{}, which VSPRING_EDITOR names: not the built editor", given));
  }
  std::error_code none;
  const fs::path program = fs::read_symlink("/proc/self/exe", none).parent_path();
  for (const char* place : {VSPRING_INSTALLED_EDITOR, "../editor"})
    if (const fs::path folder = program / place; whole(folder)) return folder.lexically_normal().string();
  throw Error(ErrorCode::unusable_file,
              "the editor's page is not built: run ./edit in the source folder, or name its folder in VSPRING_EDITOR");
}

void check_format(const std::string& path) {
  const std::string extension = fs::path(path).extension().string();
  if (surface_format(extension) || curve_format(extension)) return;
  throw Error(
      ErrorCode::unusable_file,
      fmt::format("{}: not a surface's or curve's file; name one that ends in .obj, .off, .ply, .stl, .csv, .dat, "
                  ".xyz or .gpx",
                  path));
}

void check_input(const std::string& path) {
  check_format(path);
  const bool readable = access(path.c_str(), R_OK) == 0;
  if (readable && fs::is_regular_file(path)) return;
  throw Error(ErrorCode::unusable_file, fmt::format("{}: cannot be read: {}; check its name and permissions", path,
                                                    readable ? "not a regular file" : std::strerror(errno)));
}

int run_edit(const EditArguments& arguments) {
  // A request that needs too much memory fails without ending the program.
  std::set_new_handler(nullptr);
  EditedFile file = {arguments.input, arguments.output.empty() ? arguments.input : arguments.output};
  if (!file.input.empty()) {
    check_input(file.input);
    check_format(file.output);
    check_writable(file.output);
  }
  const std::string page = page_folder();
  const Terminal errors(2, Colour::automatic);
  const auto say = [&](const std::string& line) {
    if (!arguments.quiet) (void)errors.write(line + "\n");
  };
  const AwaitedSignals signals;  // before any thread, as threads inherit it
  const EditorServer server(page, file, arguments.port, [&] { say("Saved " + file.output); });
  if (!Terminal(1, Colour::automatic).write(server.address() + "\n"))
    throw Error(ErrorCode::unusable_file, "standard output: takes no more");
  if (!arguments.no_browser && !open_in_browser(server.address()))
    say("There is no xdg-open: open this address in a browser.");
  say("Ctrl-C ends it.");
  signals.wait();
  return exit_converged;
}

}  // namespace

void add_edit_command(CLI::App& app, std::function<int()>& run) {
  const auto arguments = std::make_shared<EditArguments>();
  CLI::App& command = *app.add_subcommand("edit", "Pull a shape in the browser while it stays fair");
  CLI::Option* shape = command
                           .add_option("shape", arguments->input,
                                       "The surface (.obj, .off, .ply, .stl) or curve (.obj with l elements and no "
                                       "faces, .csv, .dat, .xyz, .gpx) to open (default: an example)")
                           ->type_name("SHAPE");
  command
      .add_option("-o,--output", arguments->output,
                  "Where Save writes the result, format by extension (default: SHAPE itself). Nothing is written until "
                  "Save is used")
      ->needs(shape)
      ->type_name("OUT");
  command.add_option("--port", arguments->port, "Port of 127.0.0.1 that the page is served on (default: a free one)")
      ->check(whole_number(1, 65535))
      ->type_name("PORT");
  command.add_flag("--no-browser", arguments->no_browser, "Only print the address, open no browser (default: off)");
  command.add_flag("--quiet", arguments->quiet, "Only errors on standard error (default: off)");
  command.footer(
      "The page is served to this machine alone; its address, on standard output, has a random word without which "
      "nothing is answered. Ctrl-C ends it.\n\n"
      "Example:\n  vspring edit hull.obj -o fair-hull.obj\n\n"
      "Exit status: 0 ended by Ctrl-C; 1 wrong use; 2 unusable input or output, a port that is taken, or no built "
      "page.");
  command.callback([arguments, &run] { run = [arguments] { return run_edit(*arguments); }; });
}

}  // namespace vspring::cli
