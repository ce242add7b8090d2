// Feeds any bytes to the readers. What they take is written again: as it is, it has to come out as it came in; with
// every node moved, it has to read back with the same nodes and faces.
//   fuzz_read_surface -max_total_time=60 FOLDER     the first byte of an input modulo 4: OBJ, OFF, PLY, STL
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "io/formats.hpp"
#include "io/surface_formats.hpp"
#include "vspring/error.hpp"

using namespace vspring;

namespace {

void require(bool held) {
  if (!held) std::abort();
}

void write_again(const SurfaceFile& surface, SurfaceFile (*reader)(InputFile)) {
  const std::vector<Vector3>& read = surface.mesh.positions();
  Rewrite same{surface, read, std::vector<std::uint8_t>(read.size(), 0), {}};
  require(surface.source->rewritten(same) == surface.source->file.bytes);

  // Far apart, so that corners are not welded.
  std::vector<Vector3> places;
  for (std::size_t node = 0; node < read.size(); ++node) places.emplace_back(static_cast<double>(node) + 0.5, 0.25, 1);
  Rewrite moved{surface, places, std::vector<std::uint8_t>(read.size(), 1), {}};
  std::string written;
  try {
    written = surface.source->rewritten(moved);
  } catch (const Error& error) {
    require(surface.format == SurfaceFormat::off && error.code() == ErrorCode::unusable_file);
    return;
  }
  const SurfaceFile again = reader({"again", written});
  require(again.mesh.node_count() == surface.mesh.node_count());
  require(again.mesh.positions() == places);
  require(again.mesh.corners() == surface.mesh.corners());
  std::vector<std::string> losses;
  for (const SurfaceFormat format : {SurfaceFormat::obj, SurfaceFormat::off, SurfaceFormat::ply})
    require(!fresh_surface(format, surface.mesh, places, surface.normals, losses).empty());
  bool any_triangle = false;
  for (Index face = 0; face < surface.mesh.face_count(); ++face)
    any_triangle = any_triangle || surface.mesh.face(face).size() > 2;
  if (any_triangle) require(!fresh_surface(SurfaceFormat::stl, surface.mesh, places, {}, losses).empty());
}

void read_marks(const SurfaceFile& surface) {
  try {
    for (const auto& [a, b] : marked_edges(surface))
      require(a >= 0 && b >= 0 && a < surface.mesh.node_count() && b < surface.mesh.node_count());
  } catch (const Error& error) {
    require(error.code() == ErrorCode::unusable_file && std::string(error.what()).find('\n') == std::string::npos);
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  constexpr std::array readers = {read_obj, read_off, read_ply, read_stl};
  if (size < 2) return 0;
  const auto reader = readers[data[0] % readers.size()];
  const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  static_cast<void>(detect_format(bytes));
  SurfaceFile surface;
  try {
    surface = reader({"fuzz", bytes});
  } catch (const Error& error) {
    require(error.code() == ErrorCode::unusable_file && std::string(error.what()).find('\n') == std::string::npos);
    return 0;
  }
  read_marks(surface);
  write_again(surface, reader);
  return 0;
}
