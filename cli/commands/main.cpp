#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <csignal>
#include <exception>
#include <functional>
#include <new>
#include <numeric>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "advice.hpp"
#include "commands/commands.hpp"
#include "exit_status.hpp"
#include "terminal.hpp"
#include "vspring/error.hpp"
#include "vspring/version.hpp"

namespace {

using namespace vspring;
using namespace vspring::cli;

int fail(const std::string& message, int status) {
  const Terminal errors(2, Colour::automatic);
  (void)errors.write(fmt::format("{} {}\n", errors.red("vspring: error:"), message));
  return status;
}

[[noreturn]] void end_without_memory() {
  constexpr std::string_view message = "vspring: error: out of memory\n";
  (void)!::write(STDERR_FILENO, message.data(), message.size());
  ::_exit(exit_unusable);
}

int run_command(const std::function<int()>& run) {
  try {
    return run();
  } catch (const Error& error) {
    return fail(with_options(error), error.code() == ErrorCode::invalid_argument ? exit_wrong_use : exit_unusable);
  } catch (const std::bad_alloc&) {
    end_without_memory();
  } catch (const std::exception& error) {
    return fail(error.what(), exit_unusable);
  }
}

/// How many letters must be inserted, deleted or exchanged (V. I. Levenshtein 1966).
std::size_t letters_apart(std::string_view a, std::string_view b) {
  std::vector<std::size_t> row(b.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < a.size(); ++i) {
    std::size_t diagonal = std::exchange(row[0], i + 1);
    for (std::size_t j = 0; j < b.size(); ++j) {
      const std::size_t exchanged = diagonal + (a[i] == b[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min({exchanged, diagonal + 1, row[j] + 1});
    }
  }
  return row.back();
}

/// Lists the commands, or what a command may be followed by, and names the one nearest to a word.
std::string no_command(const CLI::App& app, const std::string& word) {
  const auto commands = app.get_subcommands([](const CLI::App*) { return true; });
  std::string names;
  std::string nearest;
  std::size_t least = 1 + word.size() / 2;
  for (const CLI::App* command : commands) {
    names += (names.empty() ? "" : ", ") + command->get_name();
    const std::size_t apart = letters_apart(word, command->get_name());
    if (apart >= least) continue;
    least = apart;
    nearest = command->get_name();
  }
  return fmt::format("\"{}\" is none of the {} {}{}", word, app.get_parent() == nullptr ? "commands" : "shapes", names,
                     nearest.empty() ? "" : "; did you mean " + nearest + "?");
}

/// Help and version are answers; anything else is wrong use, in one line. words: of the command line.
int answer_or_refuse(const CLI::App& app, const CLI::ParseError& outcome, const std::vector<std::string>& words) {
  if (outcome.get_exit_code() == 0) return app.exit(outcome);
  std::string command = "vspring";
  const CLI::App* last = &app;
  std::size_t depth = 1;
  for (auto used = app.get_subcommands(); !used.empty(); used = used.front()->get_subcommands()) {
    last = used.front();
    command += " " + last->get_name();
    ++depth;
  }
  const std::string word = depth < words.size() ? words[depth] : std::string();
  const bool names_no_command =
      !last->get_subcommands([](const CLI::App*) { return true; }).empty() && !word.empty() && word[0] != '-';
  std::string what = names_no_command ? no_command(*last, word) : outcome.what();
  for (char& c : what) c = c == '\n' ? ' ' : c;
  return fail(fmt::format("{}; see {} --help", what, command), exit_wrong_use);
}

int run_program(int argc, char** argv) {
  CLI::App app("vspring: fair curves and surfaces by a discrete spring model", "vspring");
  app.set_version_flag("--version", std::string("vspring ") + version());
  app.require_subcommand(1);
  app.footer(
      "Example:\n  vspring generate annulus -o annulus.obj && vspring fair annulus.obj -o fair.obj --fix-normals "
      "boundary\n\n"
      "vspring COMMAND --help explains every option with its default and unit.");
  std::function<int()> run;
  add_fair_command(app, run);
  add_curve_command(app, run);
  add_fit_command(app, run);
  add_fill_command(app, run);
  add_span_command(app, run);
  add_edit_command(app, run);
  add_generate_command(app, run);
  add_measure_command(app, run);
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& outcome) {
    return answer_or_refuse(app, outcome, {argv, argv + argc});
  }
  return run_command(run);
}

}  // namespace

int main(int argc, char** argv) {
  // At once, as the JSON library cannot unwind without memory.
  std::set_new_handler(end_without_memory);
  // A closed reader becomes a failed write, with a message, instead of a silent end.
  std::signal(SIGPIPE, SIG_IGN);
#ifdef M_ARENA_MAX
  // Threads share freed memory: on two threads large shapes take 4 to 8 % less memory, and no more time.
  mallopt(M_ARENA_MAX, 1);
#endif
  try {
    return run_program(argc, argv);
  } catch (...) {
    // For example, no memory for the message of an error.
    end_without_memory();
  }
}
