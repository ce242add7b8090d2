#include "constraints/immovable_nodes_fixed.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>

namespace vspring {

Constraints ImmovableNodesFixed::held(const Constraints& constraints) const {
  if (constraints.node_count() != mesh_.node_count()) return constraints;
  Constraints held = constraints;
  for (const Index node : nodes_) {
    if (held.position_fixed(node)) continue;
    const Vector3& place = places_[static_cast<std::size_t>(node)];
    const Support* const support = held.support(node);
    held.fix_position(node, support != nullptr ? support->nearest(place).value_or(place) : place);
  }
  held.add_nodes(static_cast<Index>(cut_->origin.size()));
  for (std::size_t k = 0; k < cut_->origin.size(); ++k)
    held.hold_as(mesh_.node_count() + static_cast<Index>(k), held, cut_->origin[k]);
  return held;
}

void ImmovableNodesFixed::add(const ImmovableNodes& found, const Constraints& constraints) {
  if (places_.empty()) places_ = find_places_ ? find_places_(constraints) : mesh_.positions();
  for (const Index node : found.nodes()) {
    const Index added = node - mesh_.node_count();
    nodes_.push_back(added < 0 ? node : cut_->origin[static_cast<std::size_t>(added)]);
  }
  const std::size_t known = nodes_.size() - found.nodes().size();
  std::sort(nodes_.begin(), nodes_.end());
  nodes_.erase(std::unique(nodes_.begin(), nodes_.end()), nodes_.end());
  // All are held already: holding does not help.
  if (nodes_.size() == known) throw Error(found.code(), found.what());
  cut_ = into_sheets(mesh_, nodes_);
  message_ = found.what();
}

void ImmovableNodesFixed::warn(const Constraints& constraints, std::vector<Warning>& warnings) const {
  const auto count = std::count_if(nodes_.begin(), nodes_.end(), [&](Index node) {
    return !constraints.position_fixed(node) && places_[static_cast<std::size_t>(node)] == mesh_.position(node);
  });
  if (count == 0) return;
  warnings.insert(warnings.begin(), {WarningCode::immovable_nodes,
                                     fmt::format("{} node{} cannot move and {} held: {}", count, count == 1 ? "" : "s",
                                                 count == 1 ? "is" : "are", message_)});
}

}  // namespace vspring
