#include "io/off_source.hpp"

#include "io/file_normals.hpp"
#include "io/text_rewriter.hpp"
#include "vspring/error.hpp"

namespace vspring {
namespace {

bool reads_as(const std::string& text, const PolygonMesh& mesh, const Rewrite& rewrite) {
  std::vector<Vector3> expected = mesh.positions();
  for (std::size_t node = 0; node < expected.size(); ++node)
    if (rewrite.moved[node] != 0) expected[node] = rewrite.positions[node];
  try {
    const PolygonMesh read = read_off({"", text}).mesh;
    return read.positions() == expected && read.face_begin() == mesh.face_begin() && read.corners() == mesh.corners();
  } catch (const Error&) {
    return false;
  }
}

}  // namespace

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
  std::string text = out.finish();
  if (in_stream && !reads_as(text, surface.mesh, rewrite))
    file.refuse(
        "with other coordinates its lines and numbers could be read in another way; write it in another format, such "
        "as "
        "PLY");
  return text;
}

}  // namespace vspring
