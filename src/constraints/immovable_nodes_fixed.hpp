#pragma once

#include <string>
#include <vector>

#include "constraints/holding.hpp"
#include "vspring/constraints.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// Constraints of a mesh with the nodes held that cannot move. Which these are is found where a run comes upon them,
/// and costs nothing else.
class ImmovableNodesFixed {
 public:
  /// The mesh must outlive it.
  explicit ImmovableNodesFixed(const PolygonMesh& mesh) : mesh_(&mesh) {}

  /// work(constraints), with those nodes held that have been found so far.
  template <typename Work>
  auto use(const Constraints& constraints, const Work& work) const {
    return nodes_.empty() ? work(constraints) : work(held(constraints));
  }

  /// The same, and again where that throws ImmovableNodes. warnings(result): the list of them in what it returns, in
  /// which one comes first that counts such nodes.
  template <typename Work, typename Warnings>
  auto run(const Constraints& constraints, const Work& work, const Warnings& warnings) {
    for (;;) {
      try {
        auto result = use(constraints, work);
        const std::string text = warning(constraints);
        auto& list = warnings(result);
        if (!text.empty()) list.insert(list.begin(), {WarningCode::immovable_nodes, text});
        return result;
      } catch (const ImmovableNodes& found) {
        add(found);
      }
    }
  }

 private:
  [[nodiscard]] Constraints held(const Constraints& constraints) const;
  void add(const ImmovableNodes& found);
  [[nodiscard]] std::string warning(const Constraints& constraints) const;

  const PolygonMesh* mesh_;
  std::vector<Index> nodes_;
  std::string message_;
};

}  // namespace vspring
