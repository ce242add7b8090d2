#pragma once

#include <map>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// The faces of the named groups (`g`) and objects (`o`) of an OBJ file, gathered while it is read.
class ObjGroups {
 public:
  /// The names of a `g` line: the faces that follow belong to all of them.
  void start_groups(std::vector<std::string> names, Index next_face);
  /// The name of an `o` line.
  void start_object(std::string name, Index next_face);
  [[nodiscard]] bool empty() const { return faces_.empty(); }

  /// Ends what is open and returns the nodes of every group, ascending. Cost: linear in the faces of all groups.
  [[nodiscard]] std::map<std::string, std::vector<Index>> take(const PolygonMesh& mesh);

 private:
  void end_run(Index next_face);

  std::vector<std::string> groups_;
  std::string object_;
  Index run_begin_ = 0;
  /// Runs of faces [first, second) of each name.
  std::map<std::string, std::vector<std::pair<Index, Index>>> faces_;
};

}  // namespace vspring
