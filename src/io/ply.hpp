#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/input_file.hpp"
#include "io/surface_formats.hpp"

namespace vspring {

enum class PlyType : std::uint8_t { int8, uint8, int16, uint16, int32, uint32, float32, float64 };
enum class PlyEncoding : std::uint8_t { text, little_endian, big_endian };

/// Bytes in a binary file.
constexpr std::size_t size_of(PlyType type) {
  constexpr std::size_t sizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
  return sizes[static_cast<std::size_t>(type)];
}
constexpr bool is_whole(PlyType type) { return type < PlyType::float32; }

struct PlyProperty {
  std::string name;
  PlyType type = PlyType::float32;
  std::optional<PlyType> count_type;  ///< of a list
  std::size_t type_begin = 0;         ///< where the name of the type stands in the header
  std::size_t type_end = 0;
};

struct PlyElement {
  std::string name;
  std::uint64_t count = 0;
  std::size_t count_begin = 0;  ///< where the count stands in the header
  std::size_t count_end = 0;
  std::vector<PlyProperty> properties;

  [[nodiscard]] bool has_lists() const;
  /// Least bytes of one row: lists are empty, and text has a digit and a blank for each number.
  [[nodiscard]] std::size_t least_size(PlyEncoding encoding) const;
  /// Number of a property, or −1.
  [[nodiscard]] int find(std::string_view property) const;
};

struct PlyHeader {
  PlyEncoding encoding = PlyEncoding::text;
  std::vector<PlyElement> elements;
  bool comments = false;
  std::size_t end = 0;  ///< where the data begins

  /// Null if there is none.
  [[nodiscard]] const PlyElement* find(std::string_view element) const;
};

/// Throws Error(unusable_file) naming the line.
PlyHeader read_ply_header(const InputFile& file);

/// The number of a property that is no list, or −1.
int find_number(const PlyElement& element, std::string_view property);

/// The element of the nodes. Throws Error(unusable_file) if there are none or too many, or x, y, z are not all there as
/// numbers.
const PlyElement& ply_nodes(const InputFile& file, const PlyHeader& header);

class TextRewriter;
struct NewNormals;

/// A PLY file: its header and where its nodes are.
class PlySource : public SurfaceSource {
 public:
  [[nodiscard]] std::string rewritten(Rewrite& rewrite) const override;
  [[nodiscard]] SurfaceFile refined(const RefinedMesh& refined) const override;
  [[nodiscard]] std::string left_out_by(const RefinedMesh& refined) const override;
  [[nodiscard]] MeshEdges marked_edges() const override;
  [[nodiscard]] bool has_single_precision() const override;

  /// x y z nx ny nz: numbers of the properties of the node, −1 for none. Normals are all there or none.
  std::array<int, 6> fields = {-1, -1, -1, -1, -1, -1};
  [[nodiscard]] bool has_normals() const { return fields[3] >= 0; }
  [[nodiscard]] const PlyElement& node_element() const { return *header.find("vertex"); }
  /// Frees data that can be made again to the byte.
  void forget_plain_data();

  PlyHeader header;
  std::size_t first_row = 0;  ///< where the first node begins
  /// The data are positions and faces only, which the mesh has, so `file` keeps just the header.
  bool is_plain = false;
  std::vector<std::size_t> rows;  ///< where each begins; empty if all have one length

 private:
  /// The places of the fields of the row that begins at `row`: columns in text, else bytes from its beginning.
  [[nodiscard]] std::array<int, 6> places_in(std::size_t row) const;
  [[nodiscard]] bool any_whole(int first_field) const;
  [[nodiscard]] bool has_plain_elements() const;
  /// Whether the byte order is not this machine's.
  [[nodiscard]] bool swapped() const;
  /// The header, and plain data with these positions.
  [[nodiscard]] std::string with_plain_data(std::span<const Vector3> new_positions) const;
  /// The bytes with new positions and normals of the file's own nodes.
  [[nodiscard]] std::string moved(Rewrite& rewrite) const;
  /// These bytes with added nodes and faces.
  [[nodiscard]] std::string extended(std::string bytes, const Rewrite& rewrite) const;
  template <typename Data>
  [[nodiscard]] std::string extended_by(const InputFile& grown, const Rewrite& rewrite) const;
  void widen_header(TextRewriter& out) const;
  [[nodiscard]] std::string patched(const Rewrite& rewrite, const NewNormals& normals) const;
  [[nodiscard]] std::string rebuilt(const Rewrite& rewrite, const NewNormals& normals) const;
};

}  // namespace vspring
