// Faces that cross each other where the input's did not: no such shape is called converged.

#include <gtest/gtest.h>

#include <string>

#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fair_crossings_test {
namespace {

using namespace support;

/// Two sheets above each other; the rim of the lower one is tilted so that it bulges up, beyond the other one.
struct Sheets {
  PolygonMesh mesh;
  Constraints constraints;
};

Sheets sheets(generate::Faces faces, double tilt) {
  const PolygonMesh sheet = generate::plane({.columns = 10, .rows = 10, .faces = faces});
  MeshBuilder builder;
  for (const double height : {0.0, 0.05}) {
    for (const Vector3& p : sheet.positions()) builder.add_node({p.x(), p.y(), height});
  }
  for (Index face = 0; face < sheet.face_count(); ++face) builder.add_face(sheet.face(face));
  for (Index face = 0; face < sheet.face_count(); ++face) {
    std::vector<Index> nodes(sheet.face(face).begin(), sheet.face(face).end());
    for (Index& node : nodes) node += sheet.node_count();
    builder.add_face(nodes);
  }
  PolygonMesh mesh = builder.take();
  Constraints constraints = held_boundary(mesh);
  for (Index i = 0; i < mesh.node_count(); ++i) {
    if (!constraints.position_fixed(i)) continue;
    const Vector3 from_middle = mesh.position(i) - Vector3(0.5, 0.5, mesh.position(i).z());
    constraints.fix_normal(i, Vector3(0, 0, 1) + (i < sheet.node_count() ? tilt : 0) * from_middle);
  }
  return {std::move(mesh), std::move(constraints)};
}

TEST(FairCrossings, AreNeverHandedOutAsConverged) {
  for (const generate::Faces faces : every_kind) {
    const auto [mesh, constraints] = sheets(faces, 1);
    ASSERT_TRUE(self_intersections(mesh).empty());
    const FairResult result = fair(mesh, constraints);
    EXPECT_EQ(result.report.outcome, Outcome::converged);
    EXPECT_NE(result.positions, mesh.positions());
    EXPECT_TRUE(self_intersections(with_positions(mesh, result.positions)).empty());
    ASSERT_FALSE(result.report.warnings.empty());
    EXPECT_EQ(result.report.warnings.back().code, WarningCode::other_fairness);
    EXPECT_NE(result.report.warnings.back().text.find("cross each other"), std::string::npos);
    EXPECT_NE(result.report.warnings.back().text.find("near the input"), std::string::npos);

    FairOptions options;
    options.accept_worse = true;
    const FairResult found = fair(mesh, constraints, options);
    EXPECT_EQ(found.report.outcome, Outcome::worse_than_input);
    PolygonMesh crossed = mesh;
    crossed.set_positions(found.positions);
    EXPECT_FALSE(self_intersections(crossed).empty());
  }
}

TEST(FairCrossings, OfTheInputAreNoFault) {
  const Sheets bulging = sheets(generate::Faces::triangles, 1);
  FairOptions options;
  options.accept_worse = true;
  PolygonMesh crossed = bulging.mesh;
  crossed.set_positions(fair(bulging.mesh, bulging.constraints, options).positions);
  EXPECT_EQ(fair(crossed, bulging.constraints).report.outcome, Outcome::converged);
  const Sheets nearly_flat = sheets(generate::Faces::triangles, 0.05);
  EXPECT_EQ(fair(nearly_flat.mesh, nearly_flat.constraints).report.outcome, Outcome::converged);
}

}  // namespace
}  // namespace vspring::fair_crossings_test
