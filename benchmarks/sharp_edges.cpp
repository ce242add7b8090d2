// Takes noise off meshes with sharp edges, by vspring with these and without. Prints the table of docs/sharp-edges.md:
// for each mesh and each noise, in mean edges, how far nodes of the true sharp edges are from these, root mean square
// and 95th percentile, how far the true corners are off, and how far all nodes are from the true shape.

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <set>
#include <string>

#include "vspring/vspring.hpp"

namespace {

using namespace vspring;

constexpr double angle = 40;
constexpr std::uint64_t seed = 1;

double mean_edge(const PolygonMesh& mesh) {
  double sum = 0;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    const auto face = mesh.face(f);
    for (std::size_t k = 0; k < face.size(); ++k)
      sum += (mesh.position(face[(k + 1) % face.size()]) - mesh.position(face[k])).norm();
  }
  return sum / static_cast<double>(mesh.corners().size());
}

struct Truth {
  explicit Truth(PolygonMesh given)
      : mesh(std::move(given)), sharp(find_sharp_edges(mesh, angle)), edge(mean_edge(mesh)) {
    for (const auto& chain : sharp.chains.chains()) nodes.insert(chain.nodes.begin(), chain.nodes.end());
  }

  PolygonMesh mesh;
  SharpEdges sharp;
  double edge;
  std::set<Index> nodes = {};
};

void print(const std::string& name, const Truth& truth, const std::vector<Vector3>& positions,
           const std::string& more) {
  const auto at = [&](Index node) { return positions[static_cast<std::size_t>(node)]; };
  std::vector<Vector3> on_edges;
  for (const Index node : truth.nodes) on_edges.push_back(at(node));
  std::vector<double> off = point_distances(on_edges, truth.sharp.chains, {});
  std::sort(off.begin(), off.end());
  double corners = 0;
  for (const Index node : truth.sharp.corners) corners += (at(node) - truth.mesh.position(node)).squaredNorm();
  corners = std::sqrt(corners / std::max<double>(1, static_cast<double>(truth.sharp.corners.size())));
  fmt::print("| {} | {:.3f} | {:.3f} | {:.3f} | {:.3f} | {} |\n", name,
             distance(on_edges, truth.sharp.chains).rms / truth.edge, off[off.size() * 95 / 100] / truth.edge,
             corners / truth.edge, distance(positions, truth.mesh).rms / truth.edge, more);
}

void run(const std::string& path) {
  const Truth truth(read_surface(path).mesh);
  for (const double share : {0.05, 0.1, 0.25}) {
    const double noise = share * truth.edge;
    // In a ball: its radius over the deviation in each coordinate.
    const PolygonMesh mesh = generate::add_noise(truth.mesh, std::sqrt(5.0) * noise, seed, true);
    ScatteredPoints points;
    points.positions = mesh.positions();
    FitOptions options{.criterion = Noise{estimate_noise(mesh).deviation}};
    options.fair.distribution = Distribution::keep;
    Constraints constraints(mesh.node_count());
    fix_boundary_positions(constraints, mesh);
    const std::string name = fmt::format("{}, {:g}", std::filesystem::path(path).filename().string(), share);
    print(name + ", before", truth, mesh.positions(), "");
    print("without `--sharp`", truth, fit(mesh, constraints, points, options).positions, "");
    Context context;
    const SharpEdges found = find_sharp_edges(mesh, angle, *options.noise(), context);
    const auto is_true = [&](const auto& edge) {
      return std::binary_search(truth.sharp.edges.begin(), truth.sharp.edges.end(), edge);
    };
    const auto hits = std::count_if(found.edges.begin(), found.edges.end(), is_true);
    options.fair.sharp_edges = found.edges;
    const FitResult result = fit(mesh, constraints, points, options);
    print(
        "with it", truth, result.positions,
        fmt::format("{} of {}, {} others, {}", hits, truth.sharp.edges.size(),
                    static_cast<std::ptrdiff_t>(found.edges.size()) - hits, vspring::name(result.report.fair.outcome)));
  }
}

}  // namespace

int main(int count, char** arguments) {
  fmt::print("| mesh, noise | edges, rms | 95 % | corners | surface | edges found |\n|---|---|---|---|---|---|\n");
  for (int k = 1; k < count; ++k) run(arguments[k]);
}
