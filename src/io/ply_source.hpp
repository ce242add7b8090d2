#pragma once

#include <array>
#include <vector>

#include "io/ply_header.hpp"
#include "io/surface_source.hpp"

namespace vspring {

class TextRewriter;
struct NewNormals;

/// A PLY file: its header and where its nodes are.
class PlySource : public SurfaceSource {
 public:
  [[nodiscard]] std::string rewritten(Rewrite& rewrite) const override;

  /// x y z nx ny nz: numbers of the properties of the node, −1 for none. Normals are all there or none.
  std::array<int, 6> fields = {-1, -1, -1, -1, -1, -1};
  [[nodiscard]] bool has_normals() const { return fields[3] >= 0; }
  [[nodiscard]] const PlyElement& node_element() const { return *header.find("vertex"); }

  PlyHeader header;
  std::size_t first_row = 0;      ///< where the first node begins
  std::vector<std::size_t> rows;  ///< where each begins; empty where all are of one length

 private:
  /// Where the fields of the row that begins here are: in text their columns, else their bytes from its beginning.
  [[nodiscard]] std::array<int, 6> places_in(std::size_t row) const;
  [[nodiscard]] bool any_whole(int first_field) const;
  void widen_header(TextRewriter& out) const;
  [[nodiscard]] std::string patched(const Rewrite& rewrite, const NewNormals& normals) const;
  [[nodiscard]] std::string rebuilt(const Rewrite& rewrite, const NewNormals& normals) const;
};

}  // namespace vspring
