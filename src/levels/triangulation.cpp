#include "levels/triangulation.hpp"

#include <algorithm>

#include "base/cancellation.hpp"

namespace vspring {

namespace {

// Space for neighbours: a node into which several others collapse may have so many for a while.
constexpr std::uint32_t least_room = 14;

}  // namespace

void Triangulation::make_room(const std::vector<std::uint32_t>& needed) {
  begin_.resize(needed.size() + 1);
  begin_[0] = 0;
  for (std::size_t i = 0; i < needed.size(); ++i) begin_[i + 1] = begin_[i] + std::max(needed[i], least_room);
  count_.resize(needed.size());
  kind_.resize(needed.size());
  rings_.resize(begin_.back());
}

Triangulation::Triangulation(const PolygonMesh& mesh, ThreadTeam& team) {
  const Incidence incidence(mesh);
  const auto nodes = static_cast<std::size_t>(mesh.node_count());
  std::vector<std::uint32_t> needed(nodes);
  // Every chain of faces has one more link than it has faces.
  for (std::size_t i = 0; i < nodes; ++i)
    needed[i] = 2 * static_cast<std::uint32_t>(incidence.corners(static_cast<Index>(i)).size());
  end_if_cancelled();
  make_room(needed);
  parallel_ranges(team, nodes, light_nodes_per_task, [&](std::size_t begin, std::size_t end) {
    FanWalker walker(mesh, incidence);
    for (std::size_t i = begin; i < end; ++i) {
      const Fan& fan = walker.walk(static_cast<Index>(i));
      const std::size_t fewest_links = fan.closed ? fewest(Kind::closed) : fewest(Kind::open);
      const bool plain = fan.manifold() && fan.links.size() >= fewest_links;
      kind_[i] = !plain ? Kind::fixed : fan.closed ? Kind::closed : Kind::open;
      count_[i] = static_cast<std::uint32_t>(fan.links.size());
      for (std::size_t k = 0; k < fan.links.size(); ++k)
        first(i)[k] = plain ? static_cast<std::uint32_t>(fan.links[k].node()) : fan.links[k].code;
    }
  });
}

Triangulation::Triangulation(const Triangulation& finer, std::span<const std::uint32_t> kept,
                             std::span<const std::uint32_t> number, ThreadTeam& team) {
  std::vector<std::uint32_t> needed(kept.size());
  for (const std::uint32_t node : kept) needed[number[node]] = finer.count_[node];
  make_room(needed);
  parallel_ranges(team, kept.size(), light_nodes_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t k = begin; k < end; ++k) {
      const std::size_t i = number[kept[k]];
      kind_[i] = finer.kind_[kept[k]];
      count_[i] = finer.count_[kept[k]];
      std::uint32_t* to = first(i);
      for (const std::uint32_t code : finer.ring(kept[k]))
        *to++ = number[code & Link::node_mask] | (code & ~Link::node_mask);
    }
  });
}

bool Triangulation::joined(std::size_t node, std::uint32_t other) const {
  const auto neighbours = ring(node);
  return std::find(neighbours.begin(), neighbours.end(), other) != neighbours.end();
}

void Triangulation::add_links(std::size_t node, std::vector<Link>& buffer, Rings& rings) const {
  buffer.clear();
  for (const std::uint32_t code : ring(node))
    buffer.push_back({kind_[node] == Kind::fixed ? code : code | Link::spoke_bit});
  if (kind_[node] == Kind::open) buffer.front().code |= Link::start_bit;
  rings.add(buffer);
}

bool Triangulation::can_collapse(std::size_t node, std::size_t place) const {
  const auto around = ring(node);
  const std::size_t size = around.size();
  const std::uint32_t target = around[place];
  const auto can_lose_one = [&](std::uint32_t i) { return count_[i] > fewest(kind_[i]); };
  const std::size_t left = place > 0 ? place - 1 : size - 1;
  const std::size_t right = place + 1 < size ? place + 1 : 0;
  if (kind_[node] == Kind::closed) {
    if (!can_lose_one(around[left]) || !can_lose_one(around[right])) return false;
  } else {
    if (place != 0 && place + 1 != size) return false;
    if (!can_lose_one(around[place == 0 ? 1 : size - 2])) return false;
  }
  // The target gets the neighbours that it does not have yet, and loses `node`.
  const std::size_t gained = size - (kind_[node] == Kind::closed ? 3 : 2);
  const std::size_t neighbours = count_[target] + gained - 1;
  if (neighbours > room(target) || neighbours < fewest(kind_[target])) return false;
  for (std::size_t k = 0; k < size; ++k) {
    if (k == place) continue;
    const bool beside = kind_[node] == Kind::closed ? k == left || k == right : k + 1 == place || k == place + 1;
    if (!beside && joined(target, around[k])) return false;
  }
  return true;
}

void Triangulation::collapse(std::size_t node, std::size_t place) {
  const auto around = ring(node);
  const std::size_t size = around.size();
  const auto gone = static_cast<std::uint32_t>(node);
  const std::uint32_t target = around[place];
  std::uint32_t* const to = first(target);
  const std::size_t at = place_of(target, gone);
  if (kind_[node] == Kind::closed) {
    const auto along = [&](std::size_t steps) { return around[(place + steps) % size]; };
    erase(along(1), gone);
    erase(along(size - 1), gone);
    for (std::size_t k = 2; k + 1 < size; ++k) replace(along(k), gone, target);
    // In place of `node`, the target gets the nodes between its two neighbours there, in its own sense.
    const bool same_sense = to[at > 0 ? at - 1 : count_[target] - 1] == along(1);
    const std::size_t gained = size - 3;
    widen(target, at, gained);
    for (std::size_t k = 0; k < gained; ++k) to[at + k] = along(same_sense ? 2 + k : gained + 1 - k);
  } else {
    const auto along = [&](std::size_t steps) { return around[place == 0 ? steps : size - 1 - steps]; };
    const std::size_t gained = size - 2;
    widen(target, at, gained);
    for (std::size_t k = 0; k < gained; ++k) to[at + k] = along(at == 0 ? gained + 1 - k : 2 + k);
    erase(along(1), gone);
    for (std::size_t k = 2; k < size; ++k) replace(along(k), gone, target);
  }
  count_[node] = 0;
}

void Triangulation::flip(std::size_t node, std::size_t place) {
  const auto around = ring(node);
  const std::size_t size = around.size();
  const auto a = static_cast<std::uint32_t>(node);
  const std::uint32_t b = around[place];
  const std::uint32_t c = around[place > 0 ? place - 1 : size - 1];
  const std::uint32_t d = around[place + 1 < size ? place + 1 : 0];
  erase(a, b);
  erase(b, a);
  insert_between(c, a, b, d);
  insert_between(d, a, b, c);
}

std::size_t Triangulation::place_of(std::size_t node, std::uint32_t neighbour) const {
  const auto neighbours = ring(node);
  return static_cast<std::size_t>(std::find(neighbours.begin(), neighbours.end(), neighbour) - neighbours.begin());
}

void Triangulation::erase(std::size_t node, std::uint32_t neighbour) {
  std::uint32_t* const to = first(node);
  std::copy(to + place_of(node, neighbour) + 1, to + count_[node], to + place_of(node, neighbour));
  --count_[node];
}

void Triangulation::widen(std::size_t node, std::size_t at, std::size_t places) {
  std::uint32_t* const to = first(node);
  if (places > 1) std::copy_backward(to + at + 1, to + count_[node], to + count_[node] + places - 1);
  if (places == 0) std::copy(to + at + 1, to + count_[node], to + at);
  count_[node] += static_cast<std::uint32_t>(places) - 1;
}

void Triangulation::replace(std::size_t node, std::uint32_t neighbour, std::uint32_t by) {
  first(node)[place_of(node, neighbour)] = by;
}

void Triangulation::insert_between(std::size_t node, std::uint32_t a, std::uint32_t b, std::uint32_t inserted) {
  std::uint32_t* const to = first(node);
  const std::size_t one = place_of(node, a);
  const std::size_t other = place_of(node, b);
  // The first and last neighbours meet where the ring closes.
  const std::size_t at = one + 1 == other ? other : other + 1 == one ? one : count_[node];
  std::copy_backward(to + at, to + count_[node], to + count_[node] + 1);
  to[at] = inserted;
  ++count_[node];
}

}  // namespace vspring
