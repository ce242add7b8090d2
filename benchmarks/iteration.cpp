// Time of one iteration (normals and sweep) per node on 1 and 2 threads, beside the bytes that it has to move and the
// time that copying as many bytes takes on this machine; and peak memory per node.

#include <fmt/format.h>

#include <cstdlib>
#include <string>

#include "copy_bandwidth.hpp"
#include "seconds.hpp"
#include "spring/net.hpp"
#include "sweep/sweep.hpp"
#include "vspring/generate.hpp"
#include "vspring/version.hpp"

namespace {

using namespace vspring;
using bench::best_seconds;
using bench::copy_bandwidth;
using bench::seconds;

/// What one iteration cannot avoid moving if everything is read and written once in each of its two passes.
double bytes_per_node(const Net& net) {
  const auto nodes = static_cast<double>(net.moving);
  const double rings = static_cast<double>(net.rings.link_count() * sizeof(Link)) / nodes + sizeof(std::uint32_t);
  const double vector = sizeof(Vector3);
  const double normals_pass = vector + rings + sizeof(std::uint8_t) +
                              2 * vector;  // positions, rings, flags; normals written (and fetched to be)
  const double sweep_pass = 2 * vector + vector + rings;  // positions in and out, normals, rings
  return normals_pass + sweep_pass;
}

void print_iterations(const std::string& numbering, Net& net) {
  const auto model = surface_model(PseudoNormals::link);
  for (const int threads : {1, 2}) {
    ThreadTeam team(threads);
    const double bandwidth = copy_bandwidth(team);
    Sweep sweep(net, *model, team);
    sweep.iterate();
    const double normals = best_seconds(5, [&] { update_directions(net, *model, team); });
    const double iteration = best_seconds(10, [&] { sweep.iterate(); });
    const double per_node = 1e9 / static_cast<double>(net.moving);
    const double copying = 1e9 * bytes_per_node(net) / bandwidth;
    fmt::print("| {} | {} | {:.1f} | {:.1f} | {:.0f} | {:.1f} | {:.1f} |\n", numbering, threads, normals * per_node,
               iteration * per_node, bytes_per_node(net), copying, iteration * per_node / copying);
  }
}

Net net_of(const PolygonMesh& mesh) {
  Constraints constraints(mesh.node_count());
  fix_boundary_positions(constraints, mesh);
  return gather_net(mesh, constraints);
}

}  // namespace

int main(int argc, char** argv) {
  const auto nodes = static_cast<Index>(argc > 1 ? std::atoi(argv[1]) : 1000000);
  const long long memory_before = peak_memory_bytes();
  const PolygonMesh mesh = generate::cap({.nodes = nodes, .half_angle = 60, .jitter = 0.3});
  Net net;
  const double gathering = seconds([&] { net = net_of(mesh); });
  const auto memory = static_cast<double>(peak_memory_bytes() - memory_before) / nodes;
  const PolygonMesh shuffled = generate::shuffle(mesh).mesh;
  Net shuffled_net;
  const double gathering_shuffled = seconds([&] { shuffled_net = net_of(shuffled); });
  fmt::print("{} nodes, {} of them moving; gathering the net {:.0f} ns a node, {:.0f} where numbered at random\n",
             nodes, net.moving, 1e9 * gathering / nodes, 1e9 * gathering_shuffled / nodes);
  fmt::print("peak memory {:.0f} bytes a node, the input mesh among them\n\n", memory);
  fmt::print(
      "| numbering of the input | threads | normals, ns a node | iteration, ns a node | bytes moved a node | copying "
      "them, ns | ratio |\n|---|---|---|---|---|---|---|\n");
  print_iterations("ring by ring", net);
  print_iterations("at random", shuffled_net);
  return 0;
}
