#include "spring/net.hpp"

#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <utility>

#include "base/cancellation.hpp"
#include "shape/large_faces.hpp"
#include "shape/node_graph.hpp"
#include "spring/pseudo_normal.hpp"

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

constexpr auto nowhere = static_cast<std::size_t>(-1);

/// The place of the next spoke after, or before, place k of a walk; nowhere at the end of a chain.
std::size_t next_spoke(std::span<const Link> links, std::size_t k, bool after) {
  for (std::size_t steps = 0; steps < links.size(); ++steps) {
    if (!after && links[k].start()) return nowhere;
    k = after ? (k + 1) % links.size() : (k + links.size() - 1) % links.size();
    if (after && links[k].start()) return nowhere;
    if (links[k].spoke()) return k;
  }
  return nowhere;
}

bool of_one_chain(std::span<const Link> links) {
  return std::count_if(links.begin(), links.end(), [](Link link) { return link.start(); }) <= 1;
}

/// Whether the walks around i and its neighbour j, at place k of i's walk, go round the face between them in opposite
/// senses.
bool disagree(const Rings& rings, std::size_t i, std::size_t k) {
  const auto here = rings.links(i);
  const auto there = rings.links(here[k].node());
  const auto back =
      std::find_if(there.begin(), there.end(), [&](Link link) { return link.spoke() && link.node() == i; });
  if (back == there.end()) return false;
  const auto place = static_cast<std::size_t>(back - there.begin());
  // The node that comes after j around i comes before i around j.
  for (const bool after : {true, false}) {
    const std::size_t next = (k + (after ? 1 : here.size() - 1)) % here.size();
    if (after ? here[next].start() : here[k].start()) continue;
    const std::size_t third = here[next].node();
    const std::size_t same = next_spoke(there, place, !after);
    const std::size_t other = next_spoke(there, place, after);
    const bool agrees = same != nowhere && there[same].node() == third;
    const bool opposes = other != nowhere && there[other].node() == third;
    if (agrees != opposes) return opposes;
  }
  return false;
}

/// Reverses walks until neighbours go round their faces in one sense, as far as the surface has two sides.
void agree_on_sides(Net& net) {
  std::vector<std::uint8_t> reached(net.computed, 0);
  std::vector<std::size_t> queue;
  for (std::size_t first = 0; first < net.computed; ++first) {
    if (reached[first] != 0) continue;
    reached[first] = 1;
    queue.assign(1, first);
    for (std::size_t head = 0; head < queue.size(); ++head) {
      end_if_cancelled_at(head);
      const std::size_t i = queue[head];
      const auto links = net.rings.links(i);
      for (std::size_t k = 0; k < links.size(); ++k) {
        const std::size_t j = links[k].node();
        if (!links[k].spoke() || j >= net.computed || reached[j] != 0) continue;
        reached[j] = 1;
        if (of_one_chain(net.rings.links(j)) && disagree(net.rings, i, k)) net.rings.turn_over(j);
        queue.push_back(j);
      }
    }
  }
}

/// Points given normals of moving nodes to the side of the walks: else their linear equations would have the wrong
/// sign.
void agree_on_given_normals(Net& net) {
  for (std::size_t i = 0; i < net.moving; ++i) {
    end_if_cancelled_at(i);
    if (!net.normal_given(i)) continue;
    const Vector3 normal = AreaNormal()(net.positions[i], net.rings.links(i), net.positions);
    if (net.normals[i].dot(normal) < 0) net.normals[i] = -net.normals[i];
  }
}

/// Adds the rings of the nodes numbered so far, which move, and of held nodes whose direction is computed; with the
/// numbers of the mesh. Returns whether faces there are inconsistently oriented.
bool add_rings(Net& net, const NodeGraph& graph, FanWalker& walker, Numbering& number, const Constraints& constraints,
               bool for_spheres) {
  bool flipped = false;
  const auto add_ring = [&](Index node) {
    end_if_cancelled_at(static_cast<std::size_t>(node));
    const Fan& fan = walker.walk(node);
    flipped = flipped || fan.flipped_neighbour >= 0;
    net.rings.add(fan.links);
  };
  net.moving = number.count();
  net.rings.reserve(net.moving, 7 * net.moving);
  for (std::size_t i = 0; i < net.moving; ++i) {
    add_ring(number.node(i));
    if (!for_spheres) continue;
    for (const Link link : net.rings.links(i)) number(static_cast<Index>(link.node()));
  }
  for (std::size_t i = 0; i < net.moving && !for_spheres; ++i) {
    end_if_cancelled_at(i);
    graph.for_each_neighbour(number.node(i), [&](Index j) {
      if (constraints.position_fixed(j) && !constraints.normal_fixed(j)) number(j);
    });
  }
  net.computed = number.count();
  net.rings.reserve(net.computed, 0);
  for (std::size_t i = net.moving; i < net.computed; ++i) add_ring(number.node(i));
  return flipped;
}

/// cut: set if the mesh was cut.
Net gather_net_of(const PolygonMesh& mesh, const CutMesh* cut, const Constraints& constraints, bool for_spheres) {
  Net net;
  const Incidence incidence(mesh);
  FanWalker walker(mesh, incidence);
  std::vector<Index> moving;
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (!constraints.position_fixed(i) && !incidence.corners(i).empty()) moving.push_back(i);
  }
  end_if_cancelled();
  const NodeGraph graph(mesh, incidence);
  Numbering number(order_for_locality(graph, moving), mesh.node_count());
  const bool flipped = add_rings(net, graph, walker, number, constraints, for_spheres);
  for (std::size_t i = 0; i < net.computed; ++i) {
    end_if_cancelled_at(i);
    const auto links = net.rings.mutable_links(i);
    if (cut) cut->mark(number.node(i), links);
    for (Link& link : links) {
      const auto local = static_cast<std::uint32_t>(number(static_cast<Index>(link.node())));
      link = {local | (link.code & ~Link::node_mask)};
    }
  }
  net.node = std::move(number).take();
  if (flipped) agree_on_sides(net);
  end_if_cancelled();
  place_net(net, mesh.positions(), constraints);
  agree_on_given_normals(net);
  if (for_spheres) use_sphere_springs(net);
  return net;
}

Vector3 position_as_held(const std::vector<Vector3>& positions, const Constraints& constraints, Index node) {
  const Vector3& position = positions[static_cast<std::size_t>(node)];
  if (constraints.position_fixed(node)) return constraints.position(node);
  const Support* const support = constraints.support(node);
  return support != nullptr ? support->nearest(position).value_or(position) : position;
}

/// The supports of the moving nodes, in the coordinates of the net. A given normal belongs to its place along the
/// boundary: with one a node goes straight ahead only.
std::vector<std::shared_ptr<const Support>> supports_of(const Net& net, const Constraints& constraints) {
  std::vector<std::shared_ptr<const Support>> supports;
  if (constraints.sliding_count() == 0) return supports;
  std::map<const Support*, std::shared_ptr<const Support>> in_frame = {{nullptr, nullptr}};
  for (std::size_t i = 0; i < net.moving; ++i) {
    const Support* const support = constraints.support(net.node[i]);
    auto& local = in_frame[support];
    if (support != nullptr && !local)
      local = std::make_shared<const Support>(support->in_frame(net.frame.centre(), net.frame.scale()));
    supports.push_back(local);
    if (support == nullptr || !constraints.normal_fixed(net.node[i])) continue;
    supports.back() =
        std::make_shared<const Support>(local->straight_ahead(net.positions[i], constraints.normal(net.node[i])));
  }
  return supports;
}

/// The faces that were cut, in the coordinates of the net.
WholeFaces whole_faces(const Net& net, const PolygonMesh& mesh, const Constraints& constraints) {
  std::vector<std::optional<std::uint32_t>> local(static_cast<std::size_t>(mesh.node_count()));
  for (std::size_t i = 0; i < net.node.size(); ++i)
    local[static_cast<std::size_t>(net.node[i])] = static_cast<std::uint32_t>(i);
  std::vector<std::vector<WholeFaces::Corner>> faces;
  for (Index f = 0; f < mesh.face_count(); ++f) {
    end_if_cancelled_at(static_cast<std::size_t>(f));
    const auto face = mesh.face(f);
    if (face.size() <= largest_uncut_face) continue;
    std::vector<WholeFaces::Corner>& corners = faces.emplace_back();
    corners.reserve(face.size());
    for (const Index node : face)
      corners.push_back({local[static_cast<std::size_t>(node)],
                         net.frame.to_local(position_as_held(mesh.positions(), constraints, node))});
  }
  return WholeFaces(std::move(faces));
}

}  // namespace

Net gather_net(const PolygonMesh& mesh, const Constraints& constraints, bool for_spheres) {
  const auto cut = with_large_faces_cut(mesh);
  if (!cut) return gather_net_of(mesh, nullptr, constraints, for_spheres);
  Net net = gather_net_of(cut->mesh, &*cut, constraints, for_spheres);
  net.whole_faces = whole_faces(net, mesh, constraints);
  return net;
}

void place_net(Net& net, const std::vector<Vector3>& positions, const Constraints& constraints) {
  Eigen::AlignedBox<double, 3> box;
  for (const Index node : net.node) box.extend(position_as_held(positions, constraints, node));
  net.frame = Frame(box);
  net.positions = start_places(net, positions, constraints);
  net.supports = supports_of(net, constraints);
  const bool displaced = std::any_of(net.node.begin(), net.node.end(), [&](Index node) {
    const Vector3& input = positions[static_cast<std::size_t>(node)];
    return input.allFinite() && position_as_held(positions, constraints, node) != input;
  });
  if (displaced) {
    net.input = net.positions;
    for (std::size_t i = 0; i < net.node.size(); ++i) {
      const Vector3& input = positions[static_cast<std::size_t>(net.node[i])];
      if (input.allFinite()) net.input[i] = net.frame.to_local(input);
    }
  }

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
    end_if_cancelled_at(i);
    for (const Link link : net.rings.links(i)) {
      if (!link.spoke()) continue;
      lengths += (net.positions[link.node()] - net.positions[i]).norm();
      ++spokes;
    }
  }
  // Far below any length that matters, and far above those whose squares or inverses underflow.
  const double shortest = spokes > 0 ? 1e-9 * lengths / static_cast<double>(spokes) : 0;
  net.tiny = std::max(shortest * shortest, 1e-280);
}

std::vector<Vector3> start_places(const Net& net, const std::vector<Vector3>& positions,
                                  const Constraints& constraints) {
  std::vector<Vector3> places;
  places.reserve(net.node.size());
  for (const Index node : net.node)
    places.push_back(net.frame.to_local(position_as_held(positions, constraints, node)));
  return places;
}

std::vector<Vector3> positions_as_held(std::vector<Vector3> positions, const Constraints& constraints) {
  for (Index i = 0; i < constraints.node_count(); ++i) {
    positions[static_cast<std::size_t>(i)] = position_as_held(positions, constraints, i);
  }
  return positions;
}

std::vector<Vector3> scatter_positions(const Net& net, std::vector<Vector3> positions, const Constraints& constraints,
                                       double strength) {
  return scatter_places(net, net.positions, std::move(positions), constraints, strength);
}

std::vector<Vector3> scatter_places(const Net& net, std::span<const Vector3> places, std::vector<Vector3> positions,
                                    const Constraints& constraints, double strength) {
  positions = positions_as_held(std::move(positions), constraints);
  const double share = strength / net.frame.scale();
  for (std::size_t i = 0; i < net.moving; ++i) {
    Vector3& position = positions[static_cast<std::size_t>(net.node[i])];
    position += share * (places[i] - net.frame.to_local(position));
    if (net.slides(i)) position = constraints.support(net.node[i])->nearest(position).value_or(position);
  }
  return positions;
}

Vector3 mean_of_neighbours(const Net& net, std::size_t node) {
  Vector3 mean = Vector3::Zero();
  double spokes = 0;
  for (const Link link : net.rings.links(node)) {
    if (!link.spoke()) continue;
    mean += net.positions[link.node()];
    spokes += 1;
  }
  return spokes > 0 ? Vector3(mean / spokes) : net.positions[node];
}

namespace {

double mean_edge_of(const Net& net, std::size_t begin, std::size_t end) {
  double sum = 0;
  double edges = 0;
  for (std::size_t i = begin; i < end; ++i) {
    for (const Link link : net.rings.links(i)) {
      if (!link.spoke()) continue;
      sum += (net.positions[link.node()] - net.positions[i]).norm();
      edges += 1;
    }
  }
  return edges > 0 ? sum / edges : 0;
}

}  // namespace

double mean_edge(const Net& net) { return mean_edge_of(net, 0, net.moving); }

double mean_edge(const Net& net, std::size_t node) { return mean_edge_of(net, node, node + 1); }

}  // namespace vspring
