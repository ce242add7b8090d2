// Any text as a file of constraints: it applies as a whole or not at all.
#include "shapes.hpp"

using namespace vspring;
using namespace vspring::fuzz;

namespace {

bool same(const Constraints& a, const Constraints& b) {
  for (Index i = 0; i < a.node_count(); ++i) {
    if (a.position_fixed(i) != b.position_fixed(i) || a.normal_fixed(i) != b.normal_fixed(i) ||
        a.position(i) != b.position(i) || a.normal(i) != b.normal(i))
      return false;
  }
  return true;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* bytes, std::size_t size) {
  static const PolygonMesh shape = [] {
    MeshBuilder builder;
    for (int row = 0; row < 3; ++row) {
      for (int column = 0; column < 3; ++column) builder.add_node({1.0 * column, 1.0 * row, 0.3 * row + 0.1 * column});
    }
    for (const Index k : {0, 1, 3, 4}) builder.add_face({k, k + 1, k + 4, k + 3});
    return builder.take();
  }();
  static const Groups groups = {{"rim", {0, 1, 2}}, {"", {4}}};
  Constraints before(shape.node_count());
  before.fix_position(4, shape.position(4));
  Constraints held = before;
  try {
    const MeshEdges sharp =
        apply_rules(held, shape, std::string_view(reinterpret_cast<const char*>(bytes), size), {.groups = &groups});
    std::vector<LeftOutEdge> left_out;
    (void)as_sharp_edges(shape, sharp, left_out);
    require(left_out.empty());
  } catch (const Error& error) {
    require(std::string_view(error.what()).find('\n') == std::string_view::npos);
    require(same(held, before));
  }
  return 0;
}
