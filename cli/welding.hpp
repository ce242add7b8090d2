#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "fairing_arguments.hpp"
#include "vspring/curve_file.hpp"
#include "vspring/refined_mesh.hpp"
#include "vspring/rules.hpp"
#include "vspring/scalar_file.hpp"
#include "vspring/surface_file.hpp"
#include "vspring/weld.hpp"

namespace vspring::cli {

/// Joins nodes of a file for fairing, by --weld; by default those of STL that the rounding of single precision has
/// separated. The file keeps all its nodes.
class Welding {
 public:
  /// Throws what weld() throws.
  Welding(const SurfaceFile& file, const FairingArguments& arguments);
  /// Throws Error(invalid_argument) if a curve is to be welded.
  Welding(const CurveFile& file, const FairingArguments& arguments);

  /// Joins the nodes of a refined file, if those of the file are. of_file: its mesh; refined: the refined shape;
  /// joined: per node of the file the node of `refined` that it is. Returns per node of `refined` its number in
  /// shape().
  std::vector<Index> refine(const SurfaceFile& file, const RefinedMesh& of_file, const RefinedMesh& refined,
                            const std::vector<Index>& joined);

  /// The shape to fair or measure.
  [[nodiscard]] const PolygonMesh& shape(const SurfaceFile& file) const { return welded_ ? welded_->mesh : file.mesh; }
  [[nodiscard]] static const PolygonCurve& shape(const CurveFile& file) { return file.curve; }

  /// What rules may refer to; file and this must outlive it.
  [[nodiscard]] RuleInput rules(const SurfaceFile& file) const;
  [[nodiscard]] static RuleInput rules(const CurveFile& file) { return {.groups = &file.groups}; }

  /// Positions of the file's nodes, given those of the shape.
  [[nodiscard]] std::vector<Vector3> positions(const std::vector<Vector3>& of_shape) const;

  /// Weights of the shape's nodes as points: 0 for those that another one represents. Empty: 1 for all.
  [[nodiscard]] std::vector<double> weights() const;

  /// Gives each representative the greatest number of its group.
  [[nodiscard]] std::vector<double> greatest(std::vector<double> values) const;

  /// Writes numbers at the nodes of the shape, with nodes and faces of the file.
  void write_scalars(const std::string& path, const PolygonMesh& shape, std::vector<NodeScalar> scalars) const;
  static void write_scalars(const std::string& path, const PolygonCurve& shape, const std::vector<NodeScalar>& scalars);

  /// A warning for people if few faces meet others, and so show no noise; else empty.
  [[nodiscard]] const std::string& loose_faces() const noexcept { return loose_faces_; }
  /// Adds warnings for people: what is welded, what may need welding, and which faces do not count.
  [[nodiscard]] std::vector<std::string> with_warnings(std::vector<std::string> warnings) const;
  /// Figures for the report; empty if nothing was to be welded.
  [[nodiscard]] nlohmann::ordered_json figures() const;
  /// Lines for people; empty if nothing was to be welded.
  [[nodiscard]] std::string lines() const;

 private:
  void weld_file(const SurfaceFile& file, double tolerance);
  void weld_by_itself(const SurfaceFile& file);
  void look_for_seams(const SurfaceFile& file, const FairingArguments& arguments);
  void look_for_faces_without_area(const PolygonMesh& mesh);

  double tolerance_ = 0;  ///< a share of the diagonal
  std::optional<Welded> welded_;
  PolygonMesh file_;  ///< set if welded
  std::vector<std::string> warnings_;
  std::string loose_faces_;
};

}  // namespace vspring::cli
