#include "io/obj_groups.hpp"

#include <algorithm>

namespace vspring {

void ObjGroups::end_run(Index next_element) {
  const auto note = [&](const std::string& name) {
    auto& runs = elements_[name];
    if (next_element > run_begin_ && (runs.empty() || runs.back().first != run_begin_))
      runs.emplace_back(run_begin_, next_element);
  };
  for (const std::string& name : groups_) note(name);
  if (!object_.empty()) note(object_);
  run_begin_ = next_element;
}

void ObjGroups::start_groups(std::vector<std::string> names, Index next_element) {
  end_run(next_element);
  groups_ = std::move(names);
}

void ObjGroups::start_object(std::string name, Index next_element) {
  end_run(next_element);
  object_ = std::move(name);
}

std::map<std::string, std::vector<Index>> ObjGroups::take(std::span<const Index> element_begin,
                                                          std::span<const Index> nodes, Index node_count) {
  end_run(static_cast<Index>(element_begin.size()) - 1);
  std::map<std::string, std::vector<Index>> groups;
  std::vector<Index> seen_in(static_cast<std::size_t>(node_count), -1);
  Index number = 0;
  for (const auto& [name, runs] : elements_) {
    std::vector<Index>& members = groups[name];
    for (const auto& [first, last] : runs) {
      for (Index corner = element_begin[first]; corner < element_begin[last]; ++corner) {
        const Index node = nodes[corner];
        if (seen_in[node] == number) continue;
        seen_in[node] = number;
        members.push_back(node);
      }
    }
    std::sort(members.begin(), members.end());
    ++number;
  }
  return groups;
}

}  // namespace vspring
