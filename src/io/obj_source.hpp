#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "io/file_normals.hpp"
#include "io/surface_formats.hpp"

namespace vspring {

/// An OBJ file: where its `v` and `vn` lines are.
class ObjSource : public SurfaceSource {
 public:
  [[nodiscard]] std::string rewritten(Rewrite& rewrite) const override;
  [[nodiscard]] SurfaceFile refined(const RefinedMesh& refined) const override {
    return refined_obj(file, mesh, refined);
  }
  [[nodiscard]] std::string left_out_by(const RefinedMesh& refined) const override {
    return left_out_by_refined_obj(file, mesh, refined);
  }
  [[nodiscard]] MeshEdges marked_edges() const override { return marks_of_obj(file); }

  std::vector<std::size_t> node_rows;    ///< offset of the first coordinate of each node
  std::vector<std::size_t> normal_rows;  ///< offset of the first component of each `vn`
  std::vector<Vector3> normals;          ///< of each `vn`, as it is given
  std::vector<Index> corner_normals;     ///< the `vn` of each corner, −1 for none; empty if no face names any

 private:
  /// New values of `vn` lines, and new lines for corners that shared one and need different ones now.
  struct NewLines {
    NewNormals of_file;
    std::vector<Vector3> added;
    std::vector<Index> of_corner;  ///< per corner the line that it names; those added count behind those of the file
  };
  [[nodiscard]] NewLines new_lines(const Rewrite& rewrite) const;
  void append_added(std::string& text, const Rewrite& rewrite, const NewLines& lines) const;
};

}  // namespace vspring
