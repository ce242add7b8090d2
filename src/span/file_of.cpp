#include <fmt/format.h>

#include <string>
#include <vector>

#include "io/rewriter.hpp"
#include "vspring/span.hpp"

namespace vspring {

SurfaceFile file_of(const SpannedCurves& spanned) {
  std::string text;
  for (const Vector3& position : spanned.positions) {
    text += "v ";
    append_numbers(text, position);
    text += '\n';
  }
  const auto append_nodes = [&](char keyword, const auto& nodes) {
    text += keyword;
    for (const Index node : nodes) {
      text += ' ';
      append_whole(text, static_cast<std::size_t>(node) + 1);
    }
    text += '\n';
  };
  for (std::size_t l = 0; l < spanned.loops.size(); ++l) {
    const NetworkLoop& loop = spanned.loops[l];
    if (loop.state != LoopState::spanned) continue;
    text += fmt::format("g loop_{}\n", l);
    for (Index f = loop.first_face; f < loop.first_face + loop.face_count; ++f) append_nodes('f', spanned.mesh.face(f));
  }
  for (const NetworkCurve& curve : spanned.curves) {
    if (curve.is_sharp && curve.loops > 1) append_nodes('l', curve.nodes);
  }
  return read_surface_bytes(std::move(text), "span.obj", SurfaceFormat::obj);
}

}  // namespace vspring
