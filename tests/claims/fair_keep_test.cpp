// The distribution of the nodes kept where noise has put them outside their neighbours.

#include <gtest/gtest.h>

#include "support/methods.hpp"
#include "support/surfaces.hpp"
#include "vspring/vspring.hpp"

namespace vspring::fair_keep_test {
namespace {

using namespace support;

TEST(KeptDistribution, NoiseThatTurnsFacesOverDoesNotDriveNodesApart) {
  for (const auto faces : {generate::Faces::triangles, generate::Faces::quads}) {
    const PolygonMesh plane = generate::plane({.columns = 20, .rows = 20, .faces = faces});
    const Constraints held = held_boundary(plane);
    for (const std::uint64_t seed : {1U, 2U, 3U}) {
      std::vector<Vector3> rough = generate::add_noise(plane, 0.7 / 20, seed).positions();
      for (Index i = 0; i < plane.node_count(); ++i) {
        if (held.position_fixed(i)) rough[static_cast<std::size_t>(i)] = plane.position(i);
      }
      for (const FairingMethod& method : {FairingMethod(SweepMethod{}), FairingMethod(equilibrium_alone())}) {
        SCOPED_TRACE(testing::Message() << static_cast<int>(faces) << " " << seed << " " << method.index());
        FairOptions options{.method = method};
        options.distribution = Distribution::keep;
        const FairResult result = fair(with_positions(plane, rough), held, options);
        EXPECT_EQ(result.report.outcome, Outcome::converged);
        for (const Vector3& p : result.positions) {
          // A plain iteration ends short of its equilibrium.
          EXPECT_LT(std::abs(p.z()), result.report.method == Method::sweep ? 0.01 : 1e-4);
          EXPECT_LT((p - Vector3(0.5, 0.5, 0)).cwiseAbs().maxCoeff(), 0.5 + 1e-9);
        }
      }
    }
  }
}

}  // namespace
}  // namespace vspring::fair_keep_test
