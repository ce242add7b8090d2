#include "fit/unfolding.hpp"

#include <utility>
#include <vector>

#include "checks/result_check.hpp"
#include "noise/denoise.hpp"
#include "noise/scan_mesh.hpp"
#include "vspring/noise.hpp"

namespace vspring {

namespace {

// Share of all edges: where fewer turn, they may belong to the shape.
constexpr double least_folded = 0.005;
// Share of those that turned: where more still do, it was no noise.
constexpr double most_left = 0.1;

}  // namespace

void unfold(Net& net, const PolygonMesh& mesh, const Context& context, ThreadTeam& team) {
  const auto links = static_cast<double>(net.rings.link_count());
  const auto turned = static_cast<double>(turned_edges(net, team));
  if (turned < 0.5 * least_folded * links || turned == 0) return;
  const double deviation = estimate_noise(mesh, context).deviation * net.frame.scale();
  if (!(deviation > 0)) return;
  std::vector<Vector3> smooth = without_noise(
      scan_mesh(net, mesh), net.positions, {}, deviation, [&] { return context.cancelled(); }, team);
  std::swap(net.positions, smooth);
  if (static_cast<double>(turned_edges(net, team)) > most_left * turned) std::swap(net.positions, smooth);
}

}  // namespace vspring
