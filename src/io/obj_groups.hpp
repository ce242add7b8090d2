#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vspring/types.hpp"

namespace vspring {

/// The elements (faces or lines) of the named groups (`g`) and objects (`o`) of an OBJ file, gathered while it is read.
class ObjGroups {
 public:
  /// The names of a `g` line: the elements that follow belong to all of them.
  void start_groups(std::vector<std::string> names, Index next_element);
  /// The name of an `o` line.
  void start_object(std::string name, Index next_element);
  [[nodiscard]] bool empty() const { return elements_.empty(); }

  /// element_begin: where each element's nodes begin, and where the last one's end. Ends what is open and returns the
  /// nodes of every group, ascending. Cost: linear in the elements of all groups.
  [[nodiscard]] std::map<std::string, std::vector<Index>> take(std::span<const Index> element_begin,
                                                               std::span<const Index> nodes, Index node_count);

 private:
  void end_run(Index next_element);

  std::vector<std::string> groups_;
  std::string object_;
  Index run_begin_ = 0;
  /// Runs of elements [first, second) of each name.
  std::map<std::string, std::vector<std::pair<Index, Index>>> elements_;
};

}  // namespace vspring
