#include "constraints/immovable_nodes_fixed.hpp"

#include <fmt/format.h>

#include <algorithm>

namespace vspring {

Constraints ImmovableNodesFixed::held(const Constraints& constraints) const {
  Constraints held = constraints;
  for (const Index node : nodes_) {
    if (!held.position_fixed(node)) held.fix_position(node, mesh_->position(node));
  }
  return held;
}

void ImmovableNodesFixed::add(const ImmovableNodes& found) {
  nodes_.insert(nodes_.end(), found.nodes().begin(), found.nodes().end());
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  message_ = found.what();
}

std::string ImmovableNodesFixed::warning(const Constraints& constraints) const {
  const auto count =
      std::count_if(nodes_.begin(), nodes_.end(), [&](Index node) { return !constraints.position_fixed(node); });
  if (count == 0) return {};
  return fmt::format("{} node{} cannot move and {} held: {}", count, count == 1 ? "" : "s", count == 1 ? "is" : "are",
                     message_);
}

}  // namespace vspring
