#pragma once

#include <string>
#include <vector>

#include "constraints/holding.hpp"
#include "vspring/constraints.hpp"
#include "vspring/polygon_mesh.hpp"

namespace vspring {

/// Constraints of a mesh with the nodes held that cannot move. Which these are is found where a run comes upon them,
/// and costs nothing else.
class ImmovableHeld {
 public:
  /// The mesh must outlive it.
  explicit ImmovableHeld(const PolygonMesh& mesh) : mesh_(&mesh) {}

  /// work(constraints), with those held that have been found; once more where that throws ImmovableNodes.
  /// Warnings(result) are the warnings of what it returns: one comes first that counts such nodes.
  template <typename Work, typename Warnings>
  auto run(const Constraints& constraints, const Work& work, const Warnings& warnings) {
    for (;;) {
      try {
        auto result = nodes_.empty() ? work(constraints) : work(held(constraints));
        const std::string text = warning(constraints);
        auto& list = warnings(result);
        if (!text.empty()) list.insert(list.begin(), text);
        return result;
      } catch (const ImmovableNodes& found) {
        add(found);
      }
    }
  }

  [[nodiscard]] Constraints held(const Constraints& constraints) const;

 private:
  void add(const ImmovableNodes& found);
  [[nodiscard]] std::string warning(const Constraints& constraints) const;

  const PolygonMesh* mesh_;
  std::vector<Index> nodes_;
  std::string message_;
};

}  // namespace vspring
