#include "refine/editable_triangles.hpp"

#include <cstddef>
#include <cstdint>

namespace vspring {

void EditableTriangles::add(const Triangle& triangle) {
  for (const Index node : triangle.nodes)
    around_[static_cast<std::size_t>(node)].push_back(static_cast<Index>(triangles_.size()));
  triangles_.push_back(triangle);
}

Index EditableTriangles::add_node() {
  around_.emplace_back();
  return node_count() - 1;
}

EditableTriangles::Sides EditableTriangles::sides(Index a, Index b) const {
  Sides found;
  for (const Index number : around(a)) {
    const Triangle& triangle = this->triangle(number);
    const std::size_t k = triangle.place_of(a);
    const bool runs_from_a = triangle.node(k + 1) == b;
    if (!runs_from_a && triangle.node(k + 2) != b) continue;
    if (found.count < 2) {
      found.triangle[found.count] = number;
      found.corner[found.count] = runs_from_a ? k : (k + 2) % 3;
    }
    ++found.count;
  }
  return found;
}

Index EditableTriangles::line_of(Index a, Index b) const {
  const Sides at_edge = sides(a, b);
  return triangle(at_edge.triangle[0]).line(at_edge.corner[0]);
}

std::vector<Index> EditableTriangles::neighbours(Index node) const {
  std::vector<Index> found;
  for (const Index number : around(node)) {
    for (const Index other : triangle(number).nodes) {
      if (other != node) found.push_back(other);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

bool EditableTriangles::is_one_fan(Index node) const {
  const auto all = around(node);
  std::vector<std::uint8_t> reached(all.size(), 0);
  std::vector<std::size_t> due;
  const auto reach = [&](std::size_t k) {
    reached[k] = 1;
    due.push_back(k);
  };
  if (!all.empty()) reach(0);
  while (!due.empty()) {
    const Triangle& triangle = this->triangle(all[due.back()]);
    due.pop_back();
    const std::size_t corner = triangle.place_of(node);
    for (const Index other : {triangle.node(corner + 1), triangle.node(corner + 2)}) {
      for (std::size_t k = 0; k < all.size(); ++k) {
        if (reached[k] == 0 && this->triangle(all[k]).place_of(other) < 3) reach(k);
      }
    }
  }
  return std::find(reached.begin(), reached.end(), 0) == reached.end();
}

std::vector<NodePair> EditableTriangles::edges() const {
  std::vector<NodePair> found;
  found.reserve(3 * triangles_.size());
  for (const Triangle& triangle : triangles_) {
    if (!triangle.is_there()) continue;
    for (std::size_t k = 0; k < 3; ++k) found.emplace_back(std::minmax(triangle.node(k), triangle.node(k + 1)));
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());
  return found;
}

void EditableTriangles::split(Index a, Index b, Index middle) {
  const Sides at_edge = sides(a, b);
  for (std::size_t side = 0; side < at_edge.count; ++side) {
    const Index number = at_edge.triangle[side];
    const std::size_t k = at_edge.corner[side];
    const Triangle whole = triangle(number);
    const Index first = whole.node(k);
    const Index second = whole.node(k + 1);
    const Index opposite = whole.node(k + 2);
    at(number) = {{first, middle, opposite}, {whole.line(k), no_line, whole.line(k + 2)}};
    std::erase(around_[static_cast<std::size_t>(second)], number);
    around_[static_cast<std::size_t>(middle)].push_back(number);
    add({{middle, second, opposite}, {whole.line(k), whole.line(k + 1), no_line}});
  }
}

bool EditableTriangles::can_collapse(Index a, Index b) const {
  const Sides at_edge = sides(a, b);
  if (at_edge.count == 0 || at_edge.count > 2) return false;
  const std::vector<Index> at_a = neighbours(a);
  const std::vector<Index> at_b = neighbours(b);
  std::size_t common = 0;
  for (const Index node : at_a) common += std::binary_search(at_b.begin(), at_b.end(), node) ? 1 : 0;
  if (common != at_edge.count) return false;
  // Nor do two boundaries, or two places of one, come together.
  if (at_edge.count == 2 && at_a.size() != around(a).size() && at_b.size() != around(b).size()) return false;
  for (std::size_t side = 0; side < at_edge.count; ++side) {
    const Triangle& triangle = this->triangle(at_edge.triangle[side]);
    const std::size_t k = at_edge.corner[side];
    if (triangle.line(k + 1) != no_line && triangle.line(k + 2) != no_line) return false;
    // Inside the surface at least three triangles stay around a node, elsewhere two edges.
    if (neighbours(triangle.node(k + 2)).size() <= (around(triangle.node(k + 2)).size() < 3 ? 2 : 3)) return false;
  }
  return true;
}

void EditableTriangles::collapse(Index from, Index to) {
  const Sides at_edge = sides(from, to);
  std::array<std::pair<Index, Index>, 2> lines;  // of the edges from `to` to the nodes opposite
  for (std::size_t side = 0; side < at_edge.count; ++side) {
    const Triangle& triangle = this->triangle(at_edge.triangle[side]);
    const std::size_t k = at_edge.corner[side];
    const Index line = triangle.line(k + 1) != no_line ? triangle.line(k + 1) : triangle.line(k + 2);
    lines[side] = {triangle.node(k + 2), line};
  }
  for (std::size_t side = 0; side < at_edge.count; ++side) remove(at_edge.triangle[side]);
  for (const Index number : around(from)) {
    Triangle& triangle = at(number);
    triangle.nodes[triangle.place_of(from)] = to;
    around_[static_cast<std::size_t>(to)].push_back(number);
  }
  around_[static_cast<std::size_t>(from)].clear();
  for (std::size_t side = 0; side < at_edge.count; ++side) set_line(to, lines[side].first, lines[side].second);
}

bool EditableTriangles::can_flip(Index a, Index b) const {
  const Sides at_edge = sides(a, b);
  if (at_edge.count != 2) return false;
  const Triangle& left = triangle(at_edge.triangle[0]);
  const Triangle& right = triangle(at_edge.triangle[1]);
  const Index c = left.node(at_edge.corner[0] + 2);
  const Index d = right.node(at_edge.corner[1] + 2);
  return left.line(at_edge.corner[0]) == no_line && c != d && !is_edge(c, d);
}

void EditableTriangles::flip(Index a, Index b) {
  const Sides at_edge = sides(a, b);
  const Triangle left = triangle(at_edge.triangle[0]);
  const Triangle right = triangle(at_edge.triangle[1]);
  const std::size_t k = at_edge.corner[0];
  const std::size_t j = at_edge.corner[1];
  const Index first = left.node(k);
  const Index second = left.node(k + 1);
  const Index c = left.node(k + 2);
  const Index d = right.node(j + 2);
  at(at_edge.triangle[0]) = {{first, d, c}, {right.line(j + 1), no_line, left.line(k + 2)}};
  at(at_edge.triangle[1]) = {{d, second, c}, {right.line(j + 2), left.line(k + 1), no_line}};
  std::erase(around_[static_cast<std::size_t>(second)], at_edge.triangle[0]);
  std::erase(around_[static_cast<std::size_t>(first)], at_edge.triangle[1]);
  around_[static_cast<std::size_t>(d)].push_back(at_edge.triangle[0]);
  around_[static_cast<std::size_t>(c)].push_back(at_edge.triangle[1]);
}

void EditableTriangles::remove(Index triangle) {
  for (const Index node : at(triangle).nodes) std::erase(around_[static_cast<std::size_t>(node)], triangle);
  at(triangle) = {};
}

void EditableTriangles::set_line(Index a, Index b, Index line) {
  for (const Index number : around(a)) {
    Triangle& triangle = at(number);
    const std::size_t k = triangle.place_of(a);
    if (triangle.node(k + 1) == b) triangle.lines[k] = line;
    if (triangle.node(k + 2) == b) triangle.lines[(k + 2) % 3] = line;
  }
}

}  // namespace vspring
