#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/input_file.hpp"
#include "vspring/scalar_file.hpp"
#include "vspring/surface_file.hpp"

namespace vspring {

/// What to write into a file.
struct Rewrite {
  const SurfaceFile& surface;
  const std::vector<Vector3>& positions;
  std::vector<std::uint8_t> moved;   ///< per node: whether its position is not the file's
  std::vector<std::string> remarks;  ///< what could not be written unchanged
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
  /// The file with some of its faces divided. Cost: linear.
  [[nodiscard]] virtual SurfaceFile refined(const RefinedMesh& refined) const = 0;
  /// A warning for people of what refined() leaves out, or nothing.
  [[nodiscard]] virtual std::string left_out_by(const RefinedMesh& /*refined*/) const { return {}; }
  /// See vspring::marked_edges().
  [[nodiscard]] virtual MeshEdges marked_edges() const { return {}; }
  /// Whether new coordinates are written in single precision.
  [[nodiscard]] virtual bool has_single_precision() const { return false; }

  InputFile file;
  PolygonMesh mesh;                  ///< as the file gives it
  std::vector<std::string> carried;  ///< what is lost in other formats, one line each
};

/// Each reads a whole file of its format. They throw Error(unusable_file).
SurfaceFile read_obj(InputFile file);
SurfaceFile read_off(InputFile file);
SurfaceFile read_ply(InputFile file);
SurfaceFile read_stl(InputFile file);

/// An OBJ file with some of the faces of its mesh divided.
SurfaceFile refined_obj(const InputFile& file, const PolygonMesh& mesh, const RefinedMesh& refined);

/// See SurfaceSource::left_out_by().
std::string left_out_by_refined_obj(const InputFile& file, const PolygonMesh& mesh, const RefinedMesh& refined);

/// See marked_edges() of surface_file.hpp.
MeshEdges marks_of_obj(const InputFile& file);

/// Whether the size of a file fits its number of facets.
bool is_binary_stl(std::string_view bytes);

/// Makes a file from a mesh alone. normals: one per node, or none. losses: gets what the format cannot hold.
std::string fresh_surface(SurfaceFormat format, const PolygonMesh& mesh, std::span<const Vector3> positions,
                          std::span<const Vector3> normals, std::vector<std::string>& losses);

/// Make such files of one format each. PLY is binary, little-endian, in double precision, and may have more numbers at
/// nodes; STL is binary, its faces cut into triangles from their first node.
std::string fresh_surface_obj(const PolygonMesh& mesh, std::span<const Vector3> positions,
                              std::span<const Vector3> normals);
std::string fresh_off(const PolygonMesh& mesh, std::span<const Vector3> positions, std::span<const Vector3> normals);
std::string fresh_ply(const PolygonMesh& mesh, std::span<const Vector3> positions, std::span<const Vector3> normals,
                      std::span<const NodeScalar> scalars);
std::string fresh_stl(const PolygonMesh& mesh, std::span<const Vector3> positions, std::vector<std::string>& losses);

}  // namespace vspring
