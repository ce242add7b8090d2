#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "io/input_file.hpp"
#include "vspring/surface_file.hpp"

namespace vspring {

/// What a file is to be written with.
struct Rewrite {
  const SurfaceFile& surface;
  const std::vector<Vector3>& positions;
  std::vector<std::uint8_t> moved;   ///< per node: its position is not the one that the file gave
  std::vector<std::string> remarks;  ///< what could not be written as it was
};

/// The bytes of a file and, in the formats that derive from it, where its coordinates and normals are.
class SurfaceSource {
 public:
  SurfaceSource() = default;
  virtual ~SurfaceSource() = default;
  SurfaceSource(const SurfaceSource&) = delete;
  SurfaceSource& operator=(const SurfaceSource&) = delete;

  /// The bytes with other positions, and with normals computed anew where nodes moved. Cost: linear.
  [[nodiscard]] virtual std::string rewritten(Rewrite& rewrite) const = 0;

  InputFile file;
  std::vector<Vector3> positions;    ///< as the file gives them
  std::size_t corner_count = 0;      ///< of the mesh
  std::vector<std::string> carried;  ///< what other formats are not given, one line each
};

/// Each reads the whole of a file that is said to be of its format. They throw Error(unusable_file).
SurfaceFile read_obj(InputFile file);
SurfaceFile read_off(InputFile file);
SurfaceFile read_ply(InputFile file);
SurfaceFile read_stl(InputFile file);

}  // namespace vspring
