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

/// Holds the nodes of a mesh that cannot move because sheets meet there, and cuts the mesh at them, so each sheet has
/// its own faces. They are found when a run throws ImmovableNodes; without any it costs nothing.
class ImmovableNodesFixed {
 public:
  /// Returns positions of all nodes; only those of immovable ones are used.
  using Places = std::function<std::vector<Vector3>(const Constraints&)>;

  /// places: gives the positions at which immovable nodes are held, called at most once; empty: their present
  /// positions.
  explicit ImmovableNodesFixed(PolygonMesh mesh, Places places = {})
      : mesh_(std::move(mesh)), find_places_(std::move(places)) {}

  /// Calls work(mesh, constraints) with the immovable nodes known so far held, and the mesh cut there: copies of nodes
  /// follow those of the mesh.
  template <typename Work>
  auto use(const Constraints& constraints, const Work& work) const {
    return cut_ ? work(cut_->mesh, held(constraints)) : work(mesh_, constraints);
  }

  /// Calls work() likewise, and again as long as it throws ImmovableNodes.
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

  /// Turns the results for the sheets into those for the mesh. report: a FairReport.
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
  /// Inserts a warning, as the first, that counts the nodes held.
  void warn(const Constraints& constraints, std::vector<Warning>& warnings) const;

 private:
  [[nodiscard]] Constraints held(const Constraints& constraints) const;
  void add(const ImmovableNodes& found, const Constraints& constraints);

  PolygonMesh mesh_;
  Places find_places_;
  std::vector<Vector3> places_;  ///< empty until immovable nodes are found
  std::vector<Index> nodes_;
  std::optional<MeshOfSheets> cut_;
  std::string message_;
};

}  // namespace vspring
