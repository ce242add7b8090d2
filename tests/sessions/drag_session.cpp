// Drags nodes of a mesh step by step, as an editor does, and writes where that leads: for checks from outside.
//
//   drag_session MESH CONSTRAINTS DRAG OUTPUT REPORT
//
// DRAG: {"nodes": [...], "moves": [[x, y, z], ...]}: the nodes are held where the mesh has them, moved by each in turn.
// Exit status 0 where the shape at the end is an equilibrium, 3 where it is not, 1 for errors.
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <ctime>
#include <exception>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>
#include <vspring/vspring.hpp>

namespace {

using namespace vspring;

// That of the editor's pictures.
constexpr double picture_tolerance = 2e-4;

std::string text_of(const char* path) {
  std::ifstream file(path);
  return {std::istreambuf_iterator<char>(file), {}};
}

double largest_distance(const std::vector<Vector3>& a, const std::vector<Vector3>& b) {
  double largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) largest = std::max(largest, (a[i] - b[i]).norm());
  return largest;
}

int drag(char** arguments) {
  const SurfaceFile file = read_surface(arguments[1]);
  const auto wanted = nlohmann::json::parse(text_of(arguments[3]));
  const auto nodes = wanted.at("nodes").get<std::vector<Index>>();
  const auto moves = wanted.at("moves").get<std::vector<std::vector<double>>>();
  Constraints constraints(file.mesh.node_count());
  fix_boundary_positions(constraints, file.mesh);
  apply_rules(constraints, file.mesh, text_of(arguments[2]));
  Context context;
  context.threads = 1;
  FairingSession session(file.mesh, {}, 1);
  nlohmann::ordered_json report;
  double work = 0;
  double seconds = 0;
  double longest = 0;
  // Processor time, which other work on the machine leaves alone.
  const auto take = [&](const auto& call) {
    const std::clock_t begin = std::clock();
    FairResult result = call();
    const double spent = static_cast<double>(std::clock() - begin) / CLOCKS_PER_SEC;
    work += result.report.work;
    seconds += spent;
    longest = std::max(longest, spent);
    return result;
  };
  report["steps"] = nlohmann::json::array();
  for (const auto& move : moves) {
    for (const Index node : nodes)
      constraints.fix_position(node, file.mesh.position(node) + Vector3(move[0], move[1], move[2]));
    const FairResult step = take([&] { return session.update(constraints, picture_tolerance, context); });
    report["steps"].push_back(name(step.report.outcome));
  }
  const FairResult last = take([&] { return session.fair(constraints, context); });
  const FairResult afresh = fair(file.mesh, constraints, {}, context);
  report["outcome"] = name(last.report.outcome);
  report["iterations"] = last.report.iterations;
  report["expected_error"] = last.report.expected_error.value_or(-1);
  report["moving_nodes"] = last.report.moving_nodes;
  report["node_iterations"] = work;
  report["seconds"] = seconds;
  report["longest_call_seconds"] = longest;
  for (const Warning& warning : last.report.warnings) report["warnings"].push_back(warning.text);
  report["energy"] = last.report.after.vspring_energy;
  report["afresh"] = {{"outcome", name(afresh.report.outcome)},
                      {"energy", afresh.report.after.vspring_energy},
                      {"distance", largest_distance(last.positions, afresh.positions)},
                      {"seconds", afresh.report.seconds}};
  write_surface(arguments[4], file, last.positions);
  std::ofstream(arguments[5]) << report.dump(1) << '\n';
  return last.report.outcome == Outcome::converged ? 0 : 3;
}

}  // namespace

int main(int count, char** arguments) {
  try {
    if (count != 6) throw std::runtime_error("usage: drag_session MESH CONSTRAINTS DRAG OUTPUT REPORT");
    return drag(arguments);
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
