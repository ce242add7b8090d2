#include "io/off_source.hpp"

#include "io/file_normals.hpp"
#include "io/text_rewriter.hpp"

namespace vspring {

std::string OffSource::rewritten(Rewrite& rewrite) const {
  const SurfaceFile& surface = rewrite.surface;
  NewNormals fresh;
  if (normal_column > 0 && surface.normals.size() == rows.size())
    fresh = compute_normals(surface.mesh, surface.mesh.corners(), surface.normals, positions, rewrite.positions,
                            rewrite.moved);
  TextRewriter out(file.bytes, /*commented=*/true);
  std::vector<NewNumber> numbers;
  for (std::size_t node = 0; node < rows.size(); ++node) {
    numbers.clear();
    if (rewrite.moved[node] != 0) {
      for (int k = 0; k < 3; ++k) numbers.push_back({k, rewrite.positions[node][k]});
    }
    if (!fresh.due.empty() && fresh.due[node] != 0) {
      for (int k = 0; k < 3; ++k) numbers.push_back({normal_column + k, fresh.normals[node][k]});
    }
    if (!numbers.empty()) out.replace_words(rows[node], numbers);
  }
  return out.finish();
}

}  // namespace vspring
