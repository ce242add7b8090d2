// Scans smoothed: made shapes, and every mesh of the folder that is named, get Gaussian noise of three levels, and it
// is taken off by fair with FitOptions::noise as estimated, or told the noise with rms of it or within three times as
// much, or by the smoothing length that does, by VTK's windowed sinc, by Taubin's filter and by OpenMesh's smoother,
// which are told nothing and of whose settings the best counts. Boundaries and non-manifold spots
// stay. Prints a table, which docs/notes/fit.md sums up: root mean square distances between result and true shape, of
// the nodes of either from the other, the greater of both, in per cent of the median edge; the greatest turn; how far
// the noisy nodes are from the result, in noise; processor time on one thread, also in plain iterations of the same
// mesh.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <filesystem>
#include <limits>
#include <random>
#include <string>
#include <vector>

#include "smoothers.hpp"

namespace {

using namespace vspring;
using namespace bench;

namespace fs = std::filesystem;

constexpr double levels[] = {0.1, 0.25, 0.5};  ///< standard deviations in each coordinate, in median edges
constexpr int iterations_timed = 20;
// Of deviations that are called the same.
constexpr double alike = 0.1;

double median_edge(const PolygonMesh& mesh) {
  std::vector<double> lengths;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k)
      lengths.push_back((mesh.position(face[k]) - mesh.position(face[(k + 1) % face.size()])).norm());
  }
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

PolygonMesh with_noise(PolygonMesh mesh, double deviation, unsigned seed) {
  std::mt19937 generator(seed);
  std::normal_distribution<double> normal(0, deviation);
  std::vector<Vector3> positions = mesh.positions();
  for (Vector3& p : positions) {
    for (int c = 0; c < 3; ++c) p[c] += normal(generator);
  }
  mesh.set_positions(std::move(positions));
  return mesh;
}

/// What is told of a result.
struct Result {
  double off = std::numeric_limits<double>::infinity();
  double turn = 0;
  double deviation = 0;
  std::string variant = {};
};

std::string cell(const Result& result) {
  return std::isfinite(result.off) ? fmt::format("{:.1f}, {:.0f}°", result.off, result.turn) : "none";
}

/// What our own fit is told of the noise.
enum class Told { nothing, rms, within, length };

/// The smoothing length, of a ladder in median edges, that leaves the nodes about as far away as the noise has put
/// them.
double length_for(const PolygonMesh& noisy, const Constraints& held, FitOptions options, double edge, double deviation,
                  Context& context) {
  double best = edge;
  double nearest = std::numeric_limits<double>::infinity();
  for (const double length : {0.35, 0.5, 0.7, 1.0, 1.4, 2.0, 2.8}) {
    options.criterion = SmoothingLength{length * edge};
    const double rms = fit(noisy, held, {noisy.positions()}, options, context).report.after.all.rms;
    const double off = std::abs(std::log(rms / deviation));
    if (off > nearest) break;
    nearest = off;
    best = length * edge;
  }
  return best;
}

double processor_time() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

void run(const std::string& name, const PolygonMesh& mesh, const fs::path& drivers, unsigned seed, Told told) {
  if (mesh.face_count() == 0) return;  // a curve
  const double edge = median_edge(mesh);
  for (const double level : levels) {
    const PolygonMesh noisy = with_noise(mesh, level * edge, seed);
    const auto look = [&](const std::vector<Vector3>& positions) {
      PolygonMesh shape = mesh;
      shape.set_positions(positions);
      Result result;
      result.off = 100 * std::max(distance(positions, mesh).rms, distance(mesh.positions(), shape).rms) / edge;
      result.turn = measure(shape).greatest_turn;
      result.deviation = distance(noisy.positions(), shape).rms / (level * edge);
      return result;
    };
    Constraints held(mesh.node_count());
    fix_boundary_positions(held, noisy);
    Context context;
    context.threads = 1;
    FitOptions options;
    options.fair.distribution = Distribution::keep;
    if (told == Told::nothing) options.criterion = Noise{estimate_noise(noisy, context).deviation};
    if (told == Told::rms) options.criterion = RootMeanSquare{level * edge};
    if (told == Told::within) options.criterion = Within{3 * level * edge};
    if (told == Told::length)
      options.criterion = SmoothingLength{length_for(noisy, held, options, edge, level * edge, context)};
    double seconds = -processor_time();
    const FitResult fitted = fit(noisy, held, {noisy.positions()}, options, context);
    seconds += processor_time();
    const Result ours = look(fitted.positions);
    FitOptions plain = options;
    plain.criterion = Weight{0.1};
    plain.fair.method = SweepMethod{.step_tolerance = 1e-12, .max_iterations = iterations_timed};
    plain.fair.distribution = Distribution::even;  // else folds are taken out first
    double iteration = -processor_time();
    (void)fit(noisy, held, {noisy.positions()}, plain, context);
    iteration = (iteration + processor_time()) / iterations_timed;
    Result best;
    Result same;
    for_each_variant(drivers / "peer_vtk", noisy, sinc_variants(),
                     [&](const std::string& variant, const std::vector<Vector3>& positions, const Cost& /*cost*/) {
                       Result one = look(positions);
                       one.variant = variant;
                       if (one.off < best.off) best = one;
                       if (std::abs(one.deviation / ours.deviation - 1) < alike && one.off < same.off) same = one;
                     });
    const auto best_of = [&](const char* driver, const std::vector<std::string>& variants) {
      Result nearest;
      for_each_variant(drivers / driver, noisy, variants,
                       [&](const std::string& variant, const std::vector<Vector3>& positions, const Cost& /*cost*/) {
                         Result one = look(positions);
                         one.variant = variant;
                         if (one.off < nearest.off) nearest = one;
                       });
      return nearest;
    };
    const Result taubin = best_of("peer_taubin", {"3", "5", "10", "20", "40", "80"});
    const Result openmesh = best_of("peer_openmesh", {"C0, 1", "C0, 2", "C0, 3", "C0, 5", "C0, 10", "C0, 20", "C0, 40",
                                                      "3", "5", "10", "20", "40", "80", "160"});
    fmt::print("| {} | {} | {} | {} | {}{} | {:.2f} | {:.2f} | {:.0f} | {} | {} ({}) | {} | {} ({}) |\n", name,
               mesh.node_count(), level, cell(look(noisy.positions())), cell(ours),
               fitted.report.fair.outcome == Outcome::converged ? "" : " †", ours.deviation, seconds,
               seconds / iteration, cell(same), cell(best), best.variant, cell(taubin), cell(openmesh),
               openmesh.variant);
    std::fflush(stdout);
  }
}

}  // namespace

int main(int argc, char** argv) {
  fmt::print(
      "| mesh | nodes | noise | noisy | ours | deviation | seconds | iterations' worth | sinc, same "
      "deviation | sinc "
      "at its best | Taubin at its best | OpenMesh at its best |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  const fs::path drivers = fs::path(argv[0]).parent_path();
  const unsigned seed = argc > 2 ? static_cast<unsigned>(std::stoul(argv[2])) : 1;
  const std::string way = argc > 3 ? argv[3] : "";
  const Told told = way == "rms"      ? Told::rms
                    : way == "within" ? Told::within
                    : way == "length" ? Told::length
                                      : Told::nothing;
  const auto run_one = [&](const std::string& name, const PolygonMesh& mesh) { run(name, mesh, drivers, seed, told); };
  run_one("torus", generate::torus({.columns = 64, .rows = 48, .jitter = 0.2}, 1, 0.5));
  run_one("block", generate::genus({.holes = 1, .cells = 8}));
  run_one("blend of pipes", generate::pipe_blend());
  if (argc > 1) for_each_surface(argv[1], run_one);
  return 0;
}
