#include "sweep/sweep.hpp"

#include <algorithm>

#include "base/cancellation.hpp"

namespace vspring {

Sweep::Sweep(Net& net, const Model& model, ThreadTeam& team, SweepOrder order)
    : net_(&net), model_(&model), team_(&team) {
  if (order == SweepOrder::file) {
    sequence_ = file_order(net);
    return;
  }
  groups_ = parallel_order(net);
  std::size_t most = 0;
  for (const auto& group : groups_) most = std::max(most, group.size());
  greatest_.resize(most);
}

double Sweep::iterate() {
  update_directions(*net_, *model_, *team_);
  double greatest = 0;
  for (std::size_t k = 0; k < sequence_.size(); ++k) {
    end_if_cancelled_at(k);
    greatest = std::max(greatest, model_->move(*net_, sequence_[k]));
  }
  for (const auto& group : groups_) {
    team_->run(group.size(), [&](std::size_t k) { greatest_[k] = model_->move(*net_, group[k]); });
    greatest = std::max(
        greatest, *std::max_element(greatest_.begin(), greatest_.begin() + static_cast<std::ptrdiff_t>(group.size())));
  }
  return greatest;
}

}  // namespace vspring
