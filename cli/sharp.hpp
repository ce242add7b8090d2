#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "fairing_arguments.hpp"
#include "fitting.hpp"
#include "symmetry.hpp"
#include "vspring/context.hpp"
#include "vspring/curve_file.hpp"
#include "vspring/fair.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"
#include "vspring/refined_mesh.hpp"
#include "vspring/remesh.hpp"
#include "vspring/sharp_edges.hpp"
#include "vspring/surface_file.hpp"
#include "welding.hpp"

namespace vspring::cli {

/// Sharp edges of a surface that its file marks, with --sharp marked, or rules name; of the whole with --symmetry.
class NamedSharpEdges {
 public:
  /// After read_rules(). Throws what marked_edges() and apply_rules() throw.
  NamedSharpEdges(const FairingArguments& arguments, const PullArguments& pull, const SurfaceFile& file,
                  const Welding& welding, const MirroredShape<PolygonMesh>& mirrored);
  /// None. Throws Error(invalid_argument) if marked ones are asked for.
  NamedSharpEdges(const FairingArguments& arguments, const PullArguments& pull, const CurveFile& file,
                  const Welding& welding, const MirroredShape<PolygonCurve>& mirrored);

  /// Takes the parts of divided edges in their place. node_of: per node of `refined` its number in the shape; empty:
  /// the same.
  void refine(const RefinedMesh& refined, const std::vector<Index>& node_of);
  /// Takes those of a remeshed shape, whose lines were the marked ones, those of rules, and perhaps others, in this
  /// order. node_of: as for refine().
  void remesh(const Remeshed& remeshed, const std::vector<Index>& node_of);

  [[nodiscard]] bool takes_marks() const { return takes_marks_; }
  [[nodiscard]] const MeshEdges& marked() const { return marked_; }
  [[nodiscard]] const MeshEdges& by_rules() const { return by_rules_; }
  /// Marked ones that cannot be sharp.
  [[nodiscard]] const std::vector<LeftOutEdge>& left_out() const { return left_out_; }
  /// Warnings for people.
  [[nodiscard]] std::vector<std::string> warnings() const;

 private:
  bool takes_marks_;
  MeshEdges marked_;
  MeshEdges by_rules_;
  std::vector<LeftOutEdge> left_out_;
};

/// The sharp edges of a surface: those that --sharp finds, and those that are named.
class SharpEdgesOfRun {
 public:
  /// own_nodes_pull: then edges of noise are left out. Throws what find_sharp_edges() throws.
  SharpEdgesOfRun(const PolygonMesh& mesh, const NamedSharpEdges& named, const FairingArguments& arguments,
                  const PullArguments& pull, bool own_nodes_pull, Context& context);

  /// None: curves have corners.
  SharpEdgesOfRun(const PolygonCurve& curve, const NamedSharpEdges& named, const FairingArguments& arguments,
                  const PullArguments& pull, bool own_nodes_pull, Context& context);

  /// The same options, with the edges.
  [[nodiscard]] FairOptions with_edges(FairOptions options) const;
  /// Takes from them those that a fit has rounded. Throws what as_sharp_edges() throws.
  void leave_out(const PolygonMesh& mesh, const MeshEdges& rounded);
  void leave_out(const PolygonCurve& /*curve*/, const MeshEdges& /*rounded*/) {}
  [[nodiscard]] Index count() const { return static_cast<Index>(sharp_.edges.size()); }
  /// Whether --sharp, if it was given, found and took none.
  [[nodiscard]] bool option_is_idle() const { return by_option_ == 0; }
  /// For the report and for people; empty without sharp edges to be found or named.
  [[nodiscard]] nlohmann::ordered_json figures() const;
  [[nodiscard]] std::string lines() const;
  /// Warnings for people: that --sharp found little but bends and noise.
  [[nodiscard]] std::vector<std::string> warnings() const;

 private:
  double angle_ = 0;
  bool fixes_normals_ = false;
  std::size_t by_option_ = 0;
  nlohmann::ordered_json of_named_;  ///< null without any
  SharpEdges sharp_;
  MeshEdges rounded_;
};

}  // namespace vspring::cli
