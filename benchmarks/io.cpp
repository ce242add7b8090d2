// Reads and writes a grid of triangles in every format: seconds and MB/s, the best of several runs.
//   bench_io [NODES [RUNS]]       default: 1000000 nodes, 3 runs; files go to the current folder and are removed
#include <fmt/format.h>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <string>

#include "seconds.hpp"
#include "vspring/surface_file.hpp"

namespace {

using namespace vspring;

PolygonMesh grid(Index side) {
  MeshBuilder builder;
  for (Index row = 0; row < side; ++row) {
    for (Index column = 0; column < side; ++column) {
      const double x = static_cast<double>(column) / side;
      const double y = static_cast<double>(row) / side;
      builder.add_node({x, y, 0.1 * std::sin(7 * x) * std::cos(5 * y)});
    }
  }
  for (Index row = 0; row + 1 < side; ++row) {
    for (Index column = 0; column + 1 < side; ++column) {
      const Index node = row * side + column;
      builder.add_face({node, node + 1, node + side + 1});
      builder.add_face({node, node + side + 1, node + side});
    }
  }
  return builder.take();
}

/// The grid as a text PLY, which the library reads and rewrites but makes from no other format.
void write_text_ply(const std::string& path, const PolygonMesh& mesh) {
  std::FILE* const file = std::fopen(path.c_str(), "w");
  fmt::print(file, "ply\nformat ascii 1.0\nelement vertex {}\n", mesh.node_count());
  fmt::print(file, "property double x\nproperty double y\nproperty double z\n");
  fmt::print(file, "element face {}\nproperty list uchar int vertex_indices\nend_header\n", mesh.face_count());
  for (const Vector3& p : mesh.positions()) fmt::print(file, "{} {} {}\n", p.x(), p.y(), p.z());
  for (Index f = 0; f < mesh.face_count(); ++f)
    fmt::print(file, "3 {} {} {}\n", mesh.face(f)[0], mesh.face(f)[1], mesh.face(f)[2]);
  std::fclose(file);
}

}  // namespace

int main(int argc, char** argv) {
  const double nodes = argc > 1 ? std::stod(argv[1]) : 1e6;
  const int runs = argc > 2 ? std::stoi(argv[2]) : 3;
  const PolygonMesh mesh = grid(static_cast<Index>(std::lround(std::sqrt(nodes))));
  fmt::print("{} nodes, {} faces, best of {} runs; written with every node moved\n", mesh.node_count(),
             mesh.face_count(), runs);
  fmt::print("{:<12}{:>8}{:>10}{:>8}{:>10}{:>8}{:>10}\n", "format", "MB", "read s", "MB/s", "write s", "MB/s",
             "both s");
  for (const std::string name : {"obj", "off", "ply text", "ply", "stl"}) {
    const std::string path = "bench_io." + name.substr(0, 3);
    if (name == "ply text")
      write_text_ply(path, mesh);
    else
      write_surface(path, mesh);
    const double size = static_cast<double>(std::filesystem::file_size(path)) / 1e6;
    SurfaceFile surface;
    const double read = bench::best_seconds(runs, [&] { surface = read_surface(path); });
    std::vector<Vector3> positions = surface.mesh.positions();
    for (Vector3& position : positions) position *= 1.1;
    const double write = bench::best_seconds(runs, [&] { write_surface(path, surface, positions); });
    const double written = static_cast<double>(std::filesystem::file_size(path)) / 1e6;
    fmt::print("{:<12}{:>8.1f}{:>10.3f}{:>8.0f}{:>10.3f}{:>8.0f}{:>10.3f}\n", name, size, read, size / read, write,
               written / write, read + write);
    std::filesystem::remove(path);
  }
}
