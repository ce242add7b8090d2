#include "symmetry.hpp"

#include <fmt/format.h>

#include "vspring/error.hpp"

namespace vspring::cli {

std::string symmetry_line(const MirrorPlane& plane, bool is_half, Index pairs, Index on_plane) {
  if (is_half) return fmt::format("symmetry         half, joined at {} nodes in the plane {}\n", on_plane, plane.name);
  return fmt::format("symmetry         whole, {} pairs of nodes, {} nodes in the plane {}\n", pairs, on_plane,
                     plane.name);
}

void refuse_with_symmetry(const FairingArguments& arguments) {
  if (arguments.symmetry.empty()) return;
  for (const char* option : {"--resample", "--spacing", "--move"}) {
    if (arguments.given.contains(option))
      throw Error(
          ErrorCode::invalid_argument,
          fmt::format("--symmetry keeps the nodes of the curve and moves them in all coordinates; leave {} out, "
                      "or give it in a run of its own",
                      option));
  }
}

}  // namespace vspring::cli
