#include "io/obj_source.hpp"

#include "io/file_normals.hpp"
#include "io/text_rewriter.hpp"

namespace vspring {
std::string ObjSource::rewritten(Rewrite& rewrite) const {
  NewNormals fresh;
  if (!corner_normals.empty())
    fresh = compute_normals(rewrite.surface.mesh, corner_normals, normals, positions, rewrite.positions, rewrite.moved);
  TextRewriter out(file.bytes);
  std::size_t normal = 0;
  const auto normals_before = [&](std::size_t offset) {
    for (; normal < fresh.due.size() && normal_rows[normal] < offset; ++normal) {
      if (fresh.due[normal] != 0) out.replace_words(normal_rows[normal], row_of(fresh.normals[normal]));
    }
  };
  for (std::size_t node = 0; node < node_rows.size(); ++node) {
    normals_before(node_rows[node]);
    if (rewrite.moved[node] != 0) out.replace_words(node_rows[node], row_of(rewrite.positions[node]));
  }
  normals_before(file.bytes.size());
  return out.finish();
}

}  // namespace vspring
