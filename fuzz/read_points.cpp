// Feeds any bytes to the readers of points: what they take has to be whole.
//   fuzz_read_points -max_total_time=60 FOLDER     the first byte of an input modulo 4: OBJ, PLY, CSV, XYZ
#include <array>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "io/point_formats.hpp"
#include "vspring/error.hpp"

using namespace vspring;

namespace {

void require(bool held) {
  if (!held) std::abort();
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using Reader = ScatteredPoints (*)(const InputFile&);
  constexpr std::array<Reader, 4> readers = {read_obj_points, read_ply_points,
                                             [](const InputFile& file) { return read_csv_points(file, {}, {}); },
                                             [](const InputFile& file) { return read_xyz_points(file, {}, {}); }};
  if (size < 2) return 0;
  const InputFile file{"fuzz", std::string(reinterpret_cast<const char*>(data) + 1, size - 1)};
  try {
    const ScatteredPoints points = readers[data[0] % readers.size()](file);
    require(!points.positions.empty());
    require(points.weights.empty() || points.weights.size() == points.positions.size());
    for (const double weight : points.weights) require(is_point_weight(weight));
  } catch (const Error& error) {
    require(error.code() == ErrorCode::unusable_file && std::string(error.what()).find('\n') == std::string::npos);
  }
  return 0;
}
