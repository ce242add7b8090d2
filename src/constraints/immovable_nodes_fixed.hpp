#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "constraints/holding.hpp"
#include "shape/sheets.hpp"
#include "vspring/constraints.hpp"
#include "vspring/polygon_mesh.hpp"
#include "vspring/warning.hpp"

namespace vspring {

/// Holds the nodes of a mesh that cannot move, as sheets meet there, and cuts the mesh at them, so that each sheet goes
/// by its own faces. Which these are is found where a run comes upon them, and costs nothing else.
class ImmovableNodesFixed {
 public:
  /// Positions of all nodes, of which those of immovable ones count.
  using Places = std::function<std::vector<Vector3>(const Constraints&)>;

  /// places: where nodes are held, asked for once if any are immovable; empty: where they are.
  explicit ImmovableNodesFixed(PolygonMesh mesh, Places places = {})
      : mesh_(std::move(mesh)), find_places_(std::move(places)) {}

  /// work(mesh, constraints), as far as is known by now: its nodes are those of the mesh, and more behind them.
  template <typename Work>
  auto use(const Constraints& constraints, const Work& work) const {
    return cut_ ? work(cut_->mesh, held(constraints)) : work(mesh_, constraints);
  }

  /// The same, and again where that throws ImmovableNodes.
  template <typename Work>
  auto run(const Constraints& constraints, const Work& work) {
    for (;;) {
      try {
        return use(constraints, work);
      } catch (const ImmovableNodes& found) {
        add(found, constraints);
      }
    }
  }

  /// Makes of what came out for the sheets what came out for the mesh. report: a FairReport.
  template <typename Report>
  void join_sheets(const Constraints& constraints, std::vector<Vector3>& positions, Report& report) const {
    if (!cut_) return;
    positions.resize(mesh_.positions().size());
    report.nodes = mesh_.node_count();
    for (const Index node : cut_->origin) {
      --report.fixed_positions;
      report.fixed_normals -= constraints.normal_fixed(node) ? 1 : 0;
    }
    warn(constraints, report.warnings);
  }
  /// Adds a first warning that counts such nodes.
  void warn(const Constraints& constraints, std::vector<Warning>& warnings) const;

 private:
  [[nodiscard]] Constraints held(const Constraints& constraints) const;
  void add(const ImmovableNodes& found, const Constraints& constraints);

  PolygonMesh mesh_;
  Places find_places_;
  std::vector<Vector3> places_;  ///< empty until any are known to be immovable
  std::vector<Index> nodes_;
  std::optional<MeshOfSheets> cut_;
  std::string message_;
};

}  // namespace vspring
