#include "regions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "figures.hpp"
#include "run_driver.hpp"
#include "support/surfaces.hpp"

namespace vspring::bench {

namespace {

constexpr std::uint64_t regions_of_each = 10;
constexpr double region_radius = 0.12;  // of the diagonal
// Of the least.
constexpr double near_bending = 1.02;
constexpr double near_variation = 1.1;

struct Program {
  const char* name;
  const char* driver;
  const char* variant;
  const char* file;
};

constexpr std::array programs = {Program{"by curvature", "vspring", "rings", "curvature"},
                                 Program{"by bending", "vspring", "rings,bending", "bending"},
                                 Program{"CGAL", "cgal", "cholmod", "cgal"}};
constexpr std::size_t ours = 2;  // the first ones
constexpr std::size_t cgal = 2;

using Results = std::array<std::optional<SurfaceFigures>, programs.size()>;

/// In what a result is next to the best.
struct Marks {
  bool bending = false;
  bool variation = false;
  bool extrema = false;
  bool no_fold = false;
  [[nodiscard]] bool all() const { return bending && variation && extrema && no_fold; }
};

/// Of a program's result beside those of others.
Marks marks_of(const SurfaceFigures& start, const Results& results, std::size_t program,
               std::span<const std::size_t> others) {
  if (!results[program]) return {};
  const SurfaceFigures& own = *results[program];
  const auto least = [&](const auto& figure) {
    auto value = figure(own);
    for (const std::size_t other : others) {
      if (results[other]) value = std::min(value, figure(*results[other]));
    }
    return value;
  };
  Marks marks;
  marks.bending = own.bending_energy <= near_bending * least([](const auto& one) { return one.bending_energy; });
  marks.variation =
      own.curvature_variation <= near_variation * least([](const auto& one) { return one.curvature_variation; });
  marks.extrema = own.mean_curvature_extrema <= least([](const auto& one) { return one.mean_curvature_extrema; });
  marks.no_fold = own.flipped_faces <= start.flipped_faces && own.self_intersections <= start.self_intersections;
  return marks;
}

PolygonMesh triangulated(const PolygonMesh& mesh) {
  MeshBuilder builder;
  for (const Vector3& p : mesh.positions()) builder.add_node(p);
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 2; k < face.size(); ++k) builder.add_face(std::array{face[0], face[k - 1], face[k]});
  }
  return builder.take();
}

struct Row {
  std::string mesh;
  Index seed = 0;
  Index moving = 0;
  SurfaceFigures start;
  Results results;
};

/// shapes: a folder that keeps the start and what each program makes of it, or empty.
Row run(const std::string& name, const PolygonMesh& mesh, std::uint64_t draw, const std::filesystem::path& drivers,
        const std::filesystem::path& shapes) {
  const RandomRegion region = random_region(mesh, region_radius * support::diagonal(mesh), draw);
  const PolygonMesh patch = triangulated(cut_out(mesh, region.nodes));
  const std::vector<std::uint8_t> held = two_outer_rings(patch);
  Row row{name, region.seed, static_cast<Index>(std::count(held.begin(), held.end(), 0)), measure_surface(patch), {}};
  const TemporaryFolder folder;
  const auto file = [&](const std::string& what) {
    if (shapes.empty()) return folder.file(what + ".ply");
    return (shapes / fmt::format("{}-{}-{}.ply", std::filesystem::path(name).stem().string(), region.seed, what))
        .string();
  };
  const std::string start = file("start");
  (void)write_surface(start, patch);
  for (std::size_t k = 0; k < programs.size(); ++k) {
    const std::filesystem::path driver = drivers / fmt::format("peer_{}", programs[k].driver);
    const std::string result = file(programs[k].file);
    if (run_driver(driver, start, result, 1, programs[k].variant))
      row.results[k] = measure_surface(read_surface(result).mesh);
  }
  return row;
}

/// The figures of all programs side by side.
template <typename Figure>
std::string beside(const Results& results, const Figure& figure) {
  std::string text;
  for (const auto& result : results)
    text +=
        (text.empty() ? "" : ", ") + (result ? fmt::format("{:.3g}", static_cast<double>(figure(*result))) : "none");
  return text;
}

/// In what vspring is not next to the best beside CGAL alone; empty where it is in all.
std::string lost_to_cgal(const Row& row, std::size_t program) {
  if (!row.results[program]) return row.results[cgal] ? "no answer" : "";
  const Marks marks = marks_of(row.start, row.results, program, std::array{cgal});
  std::string lost;
  const std::pair<bool, const char*> each[] = {
      {marks.bending, "bending"}, {marks.variation, "variation"}, {marks.extrema, "extrema"}, {marks.no_fold, "fold"}};
  for (const auto& [holds, word] : each) {
    if (!holds) lost += (lost.empty() ? "" : ", ") + std::string(word);
  }
  return lost;
}

void print_lost(const std::vector<Row>& rows) {
  fmt::print(
      "\nLost to CGAL alone; three figures: by curvature, by bending, CGAL:\n\n"
      "| mesh | seed node | moving nodes | bending before | turn before, ° | bending | variation | extrema | turn, ° | "
      "flipped faces | crossings | lost by curvature | by bending "
      "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const Row& row : rows) {
    const std::string by_curvature = lost_to_cgal(row, 0);
    const std::string by_bending = lost_to_cgal(row, 1);
    if (by_curvature.empty() && by_bending.empty()) continue;
    fmt::print("| {} | {} | {} | {:.3g} | {:.0f} | {} | {} | {} | {} | {} | {} | {} | {} |\n", row.mesh, row.seed,
               row.moving, row.start.bending_energy, row.start.greatest_turn,
               beside(row.results, [](const auto& one) { return one.bending_energy; }),
               beside(row.results, [](const auto& one) { return one.curvature_variation; }),
               beside(row.results, [](const auto& one) { return one.mean_curvature_extrema; }),
               beside(row.results, [](const auto& one) { return one.greatest_turn; }),
               beside(row.results, [](const auto& one) { return one.flipped_faces; }),
               beside(row.results, [](const auto& one) { return one.self_intersections; }), by_curvature, by_bending);
  }
}

/// In how many rows a program has an answer and is next to the best beside others.
void print_shares(const std::vector<Row>& rows, std::size_t program, std::span<const std::size_t> others,
                  const std::string& beside) {
  std::array<int, 6> counts{};
  for (const Row& row : rows) {
    const Marks marks = marks_of(row.start, row.results, program, others);
    const bool each[] = {
        row.results[program].has_value(), marks.bending, marks.variation, marks.extrema, marks.no_fold, marks.all()};
    for (std::size_t j = 0; j < counts.size(); ++j) counts[j] += each[j] ? 1 : 0;
  }
  fmt::print("| {} | {} |", programs[program].name, beside);
  for (const int count : counts) fmt::print(" {} |", count);
  fmt::print("\n");
}

}  // namespace

void compare_regions(const std::filesystem::path& drivers, const std::vector<std::string>& meshes,
                     const std::filesystem::path& shapes) {
  if (!shapes.empty()) std::filesystem::create_directories(shapes);
  std::vector<Row> rows;
  for (const std::string& path : meshes) {
    const PolygonMesh mesh = read_surface(path).mesh;
    for (std::uint64_t draw = 1; draw <= regions_of_each; ++draw)
      rows.push_back(run(std::filesystem::path(path).filename().string(), mesh, draw, drivers, shapes));
  }
  fmt::print(
      "Of {} regions:\n\n| | beside | an answer | bending within 2 % | variation within 10 % | no more extrema | no "
      "fold "
      "| all |\n|---|---|---|---|---|---|---|---|\n",
      rows.size());
  for (std::size_t k = 0; k < programs.size(); ++k)
    print_shares(rows, k, std::array{k == 0 ? cgal : 0, k == 1 ? cgal : 1}, "both others");
  for (std::size_t k = 0; k < ours; ++k) {
    print_shares(rows, k, std::array{cgal}, "CGAL");
    print_shares(rows, cgal, std::array{k}, programs[k].name);
  }
  print_lost(rows);
}

}  // namespace vspring::bench
