#include "support/holes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "figures.hpp"
#include "regions.hpp"
#include "run_driver.hpp"
#include "support/surfaces.hpp"

namespace vspring::bench {

namespace {

constexpr std::array radii = {0.05, 0.1};  // of the diagonal, a hole each
constexpr std::uint64_t most_draws = 100;
constexpr int turns = 3;  // of which the shortest counts

struct Program {
  const char* name;
  const char* driver;
  const char* options;
};

constexpr std::array programs = {Program{"by curvature", "vspring_fill", ""},
                                 Program{"by bending", "vspring_fill", ",bending"}, Program{"CGAL", "cgal_fill", ""}};

/// A mesh with one hole more.
struct Holed {
  PolygonMesh mesh;
  PolygonMesh removed;  ///< the faces that were there
  Hole hole;
};

/// What a program's patch is like.
struct Result {
  double bending = 0;
  double variation = 0;
  double greatest = 0;  ///< distance from what was removed, in mean edges of that
  double rms = 0;
  Index folds = 0;  ///< flipped and crossing faces of the patch and two rings around it
  double seconds = 0;
};
using Results = std::array<std::optional<Result>, programs.size()>;

/// Cuts out what lies in a ball; nothing where that does not make exactly one hole around it.
std::optional<Holed> cut(const PolygonMesh& mesh, const RandomRegion& ball) {
  const auto is_inside = [&](const Vector3& p) { return (p - ball.centre).norm() < ball.radius; };
  Holed holed{support::without(mesh, is_inside), {}, {}};
  const std::vector<Hole> holes = find_holes(holed.mesh);
  if (holes.size() != find_holes(mesh).size() + 1) return std::nullopt;
  const auto reach = [&](const Hole& hole) {
    double far = 0;
    for (const Index node : hole.rim) far = std::max(far, (holed.mesh.position(node) - ball.centre).norm());
    return far;
  };
  holed.hole =
      *std::min_element(holes.begin(), holes.end(), [&](const Hole& a, const Hole& b) { return reach(a) < reach(b); });
  if (reach(holed.hole) > 2 * ball.radius) return std::nullopt;
  MeshBuilder removed;
  for (const Vector3& p : mesh.positions()) removed.add_node(p);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    if (std::any_of(face.begin(), face.end(), [&](Index node) { return is_inside(mesh.position(node)); }))
      removed.add_face(face);
  }
  holed.removed = removed.take();
  return holed;
}

Holed random_hole(const PolygonMesh& mesh, double radius) {
  for (std::uint64_t draw = 1; draw <= most_draws; ++draw) {
    if (auto holed = cut(mesh, random_region(mesh, radius, draw))) return *std::move(holed);
  }
  throw std::runtime_error("no ball cuts exactly one hole");
}

double mean_edge(const PolygonMesh& mesh) {
  double sum = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k)
      sum += (mesh.position(face[k]) - mesh.position(face[(k + 1) % face.size()])).norm();
  }
  return sum / static_cast<double>(mesh.corners().size());
}

Result measured(const Holed& holed, const PolygonMesh& closed, double seconds) {
  const Index before = holed.mesh.node_count();
  std::vector<Index> nodes = holed.hole.rim;
  for (Index node = before; node < closed.node_count(); ++node) nodes.push_back(node);
  const SurfaceFigures figures = measure_surface(cut_out(closed, nodes));
  const std::span<const Vector3> added(closed.positions().begin() + before, closed.positions().end());
  const Distance off = distance(added, holed.removed);
  const double edge = mean_edge(holed.removed);
  return {figures.bending_energy,
          figures.curvature_variation,
          off.greatest / edge,
          off.rms / edge,
          figures.flipped_faces + figures.self_intersections,
          seconds};
}

Results fill(const Holed& holed, const std::filesystem::path& drivers) {
  const TemporaryFolder folder;
  const std::string start = folder.file("start.ply");
  const std::string result = folder.file("result.ply");
  write_surface(start, holed.mesh);
  Results results;
  for (int turn = 0; turn < turns; ++turn) {
    for (std::size_t k = 0; k < programs.size(); ++k) {
      const std::string variant = fmt::format("{}{}", holed.hole.rim.front(), programs[k].options);
      const auto cost = run_driver(drivers / fmt::format("peer_{}", programs[k].driver), start, result, 1, variant);
      if (!cost) continue;
      const double least = results[k] ? std::min(results[k]->seconds, cost->seconds) : cost->seconds;
      results[k] = measured(holed, read_surface(result).mesh, least);
    }
  }
  return results;
}

/// The figures of all programs side by side.
template <typename Figure>
std::string beside(const Results& results, const Figure& figure) {
  std::string text;
  for (const auto& result : results)
    text +=
        (text.empty() ? "" : ", ") + (result ? fmt::format("{:.2g}", static_cast<double>(figure(*result))) : "none");
  return text;
}

void print_row(const std::string& mesh, const Holed& holed, const Results& results) {
  fmt::print("| {} | {} | {} | {} | {} | {} | {} | {} |\n", mesh, holed.hole.rim.size(),
             beside(results, [](const Result& one) { return one.bending; }),
             beside(results, [](const Result& one) { return one.variation; }),
             beside(results, [](const Result& one) { return one.greatest; }),
             beside(results, [](const Result& one) { return one.rms; }),
             beside(results, [](const Result& one) { return one.folds; }),
             beside(results, [&](const Result& one) { return results[0] ? one.seconds / results[0]->seconds : NAN; }));
  std::fflush(stdout);
}

/// The geometric mean over the holes that both programs fill of a figure of one over that of the other.
template <typename Figure>
double ratio(const std::vector<Results>& all, std::size_t program, std::size_t other, const Figure& figure) {
  double sum = 0;
  int count = 0;
  for (const Results& results : all) {
    if (!results[program] || !results[other]) continue;
    sum += std::log(figure(*results[program]) / figure(*results[other]));
    ++count;
  }
  return std::exp(sum / count);
}

}  // namespace

void compare_holes(const std::filesystem::path& drivers, const std::vector<std::string>& meshes) {
  fmt::print(
      "Three figures: by curvature, by bending, CGAL.\n\n| mesh | edges of the rim | bending | variation | off by, "
      "edges | off by, rms | folds | time, of the first |\n|---|---|---|---|---|---|---|---|\n");
  std::vector<Results> all;
  for (const std::string& path : meshes) {
    const PolygonMesh mesh = read_surface(path).mesh;
    for (const double radius : radii) {
      const Holed holed = random_hole(mesh, radius * support::diagonal(mesh));
      all.push_back(fill(holed, drivers));
      print_row(std::filesystem::path(path).stem().string(), holed, all.back());
    }
  }
  constexpr std::size_t cgal = 2;
  fmt::print(
      "\nOver CGAL's, geometric means:\n\n| | bending | variation | off by, rms | time |\n|---|---|---|---|---|\n");
  for (std::size_t k = 0; k < cgal; ++k)
    fmt::print("| {} | {:.2f} | {:.2f} | {:.2f} | {:.1f} |\n", programs[k].name,
               ratio(all, k, cgal, [](const Result& one) { return one.bending; }),
               ratio(all, k, cgal, [](const Result& one) { return one.variation; }),
               ratio(all, k, cgal, [](const Result& one) { return one.rms; }),
               ratio(all, k, cgal, [](const Result& one) { return one.seconds; }));
}

}  // namespace vspring::bench
