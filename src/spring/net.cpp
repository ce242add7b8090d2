#include "spring/net.hpp"

#include <algorithm>

#include "spring/node_order.hpp"

namespace vspring {

namespace {

/// Local numbers, given out in the order of asking.
class Numbering {
 public:
  Numbering(std::vector<Index> first, Index mesh_nodes)
      : node_(std::move(first)), local_(static_cast<std::size_t>(mesh_nodes), -1) {
    for (std::size_t i = 0; i < node_.size(); ++i) local_[static_cast<std::size_t>(node_[i])] = static_cast<Index>(i);
  }
  std::size_t operator()(Index node) {
    Index& local = local_[static_cast<std::size_t>(node)];
    if (local < 0) {
      local = static_cast<Index>(node_.size());
      node_.push_back(node);
    }
    return static_cast<std::size_t>(local);
  }
  [[nodiscard]] std::size_t count() const noexcept { return node_.size(); }
  [[nodiscard]] Index node(std::size_t local) const { return node_[local]; }
  [[nodiscard]] std::vector<Index> take() && { return std::move(node_); }

 private:
  std::vector<Index> node_;
  std::vector<Index> local_;
};

}  // namespace

Net gather_net(const PolygonMesh& mesh, const Constraints& constraints) {
  Net net;
  const Incidence incidence(mesh);
  FanWalker walker(mesh, incidence);
  std::vector<Index> moving;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (!constraints.position_fixed(i) && !incidence.corners(i).empty()) moving.push_back(i);
  }
  const NodeGraph graph(mesh, incidence);
  Numbering number(order_for_locality(graph, moving), mesh.node_count());
  net.moving = number.count();
  for (std::size_t i = 0; i < net.moving; ++i) {
    graph.for_each_neighbour(number.node(i), [&](Index j) {
      if (constraints.position_fixed(j) && !constraints.normal_fixed(j)) number(j);
    });
  }
  net.computed = number.count();

  net.rings.reserve(net.computed, 7 * net.computed);
  std::vector<Link> links;
  for (std::size_t i = 0; i < net.computed; ++i) {
    links.clear();
    for (const Link link : walker.walk(number.node(i)).links) {
      const auto local = static_cast<std::uint32_t>(number(static_cast<Index>(link.node())));
      links.push_back({local | (link.code & ~Link::node_mask)});
    }
    net.rings.add(links);
  }
  net.node = std::move(number).take();
  place_net(net, mesh.positions(), constraints);
  return net;
}

void place_net(Net& net, const std::vector<Vector3>& positions, const Constraints& constraints) {
  const auto position = [&](Index node) {
    return constraints.position_fixed(node) ? constraints.position(node) : positions[static_cast<std::size_t>(node)];
  };
  Eigen::AlignedBox<double, 3> box;
  for (const Index node : net.node) box.extend(position(node));
  net.frame = Frame(box);
  net.positions.reserve(net.node.size());
  for (const Index node : net.node) net.positions.push_back(net.frame.to_local(position(node)));

  net.normals.assign(net.node.size(), Vector3::Zero());
  net.given.assign(net.node.size(), 0);
  for (std::size_t i = 0; i < net.node.size(); ++i) {
    if (!constraints.normal_fixed(net.node[i])) continue;
    net.normals[i] = constraints.normal(net.node[i]);
    net.given[i] |= Net::given_normal;
  }
  double lengths = 0;
  std::size_t spokes = 0;
  for (std::size_t i = 0; i < net.computed; ++i) {
    for (const Link link : net.rings.links(i)) {
      if (!link.spoke()) continue;
      lengths += (net.positions[link.node()] - net.positions[i]).norm();
      ++spokes;
    }
  }
  // Far below any length that matters, far above what underflows when squared and inverted.
  const double shortest = spokes > 0 ? 1e-9 * lengths / static_cast<double>(spokes) : 0;
  net.tiny = std::max(shortest * shortest, 1e-280);
}

std::vector<Vector3> scatter_positions(const Net& net, std::vector<Vector3> positions, const Constraints& constraints,
                                       double strength) {
  for (Index i = 0; i < constraints.node_count(); ++i) {
    if (constraints.position_fixed(i)) positions[static_cast<std::size_t>(i)] = constraints.position(i);
  }
  const double share = strength / net.frame.scale();
  for (std::size_t i = 0; i < net.moving; ++i) {
    Vector3& position = positions[static_cast<std::size_t>(net.node[i])];
    position += share * (net.positions[i] - net.frame.to_local(position));
  }
  return positions;
}

}  // namespace vspring
