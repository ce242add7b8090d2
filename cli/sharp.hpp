#pragma once

#include <nlohmann/json.hpp>
#include <string>

#include "fairing_arguments.hpp"
#include "fitting.hpp"
#include "vspring/context.hpp"
#include "vspring/fair.hpp"
#include "vspring/polygon_curve.hpp"
#include "vspring/polygon_mesh.hpp"
#include "vspring/sharp_edges.hpp"

namespace vspring::cli {

/// The sharp edges of a surface that --sharp finds.
class FoundSharpEdges {
 public:
  /// own_nodes_pull: then edges of noise are left out. Throws what find_sharp_edges() throws.
  FoundSharpEdges(const PolygonMesh& mesh, const FairingArguments& arguments, const PullArguments& pull,
                  bool own_nodes_pull, Context& context);

  /// None: curves have corners.
  FoundSharpEdges(const PolygonCurve& curve, const FairingArguments& arguments, const PullArguments& pull,
                  bool own_nodes_pull, Context& context);

  /// The same options, with the edges.
  [[nodiscard]] FairOptions with_edges(FairOptions options) const;
  [[nodiscard]] Index count() const { return static_cast<Index>(sharp_.edges.size()); }
  /// For the report and for people; empty without --sharp.
  [[nodiscard]] nlohmann::ordered_json figures() const;
  [[nodiscard]] std::string lines() const;

 private:
  double angle_ = 0;
  bool fixes_normals_ = false;
  SharpEdges sharp_;
};

}  // namespace vspring::cli
