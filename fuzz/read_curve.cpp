// Feeds any bytes to the readers of curves. What they take is written again: as it is, it has to come out as it came
// in; with every node moved, it has to read back with the same nodes and chains.
//   fuzz_read_curve -max_total_time=60 FOLDER     the first byte of an input modulo 5: OBJ, CSV, DAT, XYZ, GPX
#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdlib>
#include <optional>
#include <string>
#include <utility>

#include "drawing/svg.hpp"
#include "io/curve_formats.hpp"
#include "io/formats.hpp"
#include "vspring/error.hpp"

using namespace vspring;

namespace {

void require(bool held) {
  if (!held) std::abort();
}

bool same_chains(const PolygonCurve& a, const PolygonCurve& b) {
  if (a.chains().size() != b.chains().size()) return false;
  for (std::size_t c = 0; c < a.chains().size(); ++c) {
    if (a.chains()[c].nodes != b.chains()[c].nodes || a.chains()[c].closed != b.chains()[c].closed) return false;
  }
  return true;
}

using Reader = CurveFile (*)(InputFile, const std::optional<LocalPlane>&);

/// To the bit; where they were degrees meanwhile, to a micrometre.
bool same_places(const std::vector<Vector3>& a, const std::vector<Vector3>& b, bool degrees) {
  if (!degrees || a.size() != b.size()) return a == b;
  for (std::size_t k = 0; k < a.size(); ++k) {
    if (!((a[k] - b[k]).norm() < 1e-6)) return false;
  }
  return true;
}

void write_again(const CurveFile& file, Reader reader) {
  const std::vector<Vector3>& read = file.curve.positions();
  const std::vector<std::uint8_t> none(read.size(), 0);
  const std::vector<std::uint8_t> all(read.size(), 1);
  require(file.source->rewritten({read, none, {}}) == file.source->file.bytes);

  // Rows in another order are the same bytes in another order.
  CurveFile ordered = file;
  const bool finite = std::all_of(read.begin(), read.end(), [](const Vector3& place) { return place.allFinite(); });
  if (file.source->has_rows && finite) {
    order_nodes(ordered, false);
    std::string bytes = file.source->rewritten({read, none, ordered.row_order});
    std::string as_read = file.source->file.bytes;
    std::sort(bytes.begin(), bytes.end());
    std::sort(as_read.begin(), as_read.end());
    require(bytes == as_read);
  }

  // Below 1, so that they are not counts of an aerofoil.
  std::vector<Vector3> places;
  for (std::size_t node = 0; node < read.size(); ++node)
    places.emplace_back(1 / (static_cast<double>(node) + 1.5), 0.25, file.planar ? 0 : 1);
  const CurveFile again = reader({"again", file.source->rewritten({places, all, {}})}, file.plane);
  require(same_places(again.curve.positions(), places, file.plane.has_value()));
  require(same_chains(again.curve, file.curve));
  std::vector<std::string> losses;
  const LocalPlane* const plane = file.plane ? &*file.plane : nullptr;
  for (const CurveFormat format : {CurveFormat::obj, CurveFormat::csv, CurveFormat::xyz, CurveFormat::gpx}) {
    if (format != CurveFormat::gpx || plane != nullptr)
      require(!fresh_curve(format, {file.curve.chains(), places, file.planar, file.name, plane}, losses).empty());
  }
  const DrawnCurve before{file.curve.chains(), read};
  Eigen::AlignedBox<double, 3> part(places.front());
  part.extend(places[places.size() / 2]);
  for (const bool of_part : {true, false})
    require(!svg_picture({file.curve.chains(), places}, &before, read, of_part ? &part : nullptr, file.name).empty());
}

/// False where the action refuses what it is given; it has to say why in one line.
template <typename Action>
bool is_taken(const Action& action) {
  try {
    action();
    return true;
  } catch (const Error& error) {
    require(error.code() == ErrorCode::unusable_file && std::string(error.what()).find('\n') == std::string::npos);
    return false;
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using Plane = std::optional<LocalPlane>;
  constexpr std::array<Reader, 5> readers = {
      [](InputFile file, const Plane&) { return read_obj_curve(std::move(file)); },
      [](InputFile file, const Plane& plane) { return read_csv_curve(std::move(file), {}, plane); },
      [](InputFile file, const Plane&) { return read_dat_curve(std::move(file)); },
      [](InputFile file, const Plane& plane) { return read_xyz_curve(std::move(file), {}, plane); },
      [](InputFile file, const Plane& plane) { return read_gpx_curve(std::move(file), {}, plane); }};
  if (size < 2) return 0;
  const auto reader = readers[data[0] % readers.size()];
  const std::string bytes(reinterpret_cast<const char*>(data) + 1, size - 1);
  CurveFile file;
  if (is_taken([&] { file = reader({"fuzz", bytes}, {}); })) write_again(file, reader);
  return 0;
}
