// Matrices of levels in single precision, whose constants stay exact.

#include "linear/level_matrix.hpp"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>

#include "precondition/bending_operator.hpp"
#include "spring/model.hpp"
#include "spring/net.hpp"
#include "spring/shares.hpp"
#include "support/surfaces.hpp"

namespace vspring::level_matrix_test {
namespace {

using namespace support;

/// The boundary held, with the spacing that it has.
Net net_of(const PolygonMesh& mesh, ThreadTeam& team) {
  Net net = gather_net(mesh, held_boundary(mesh));
  update_directions(net, *surface_model(PseudoNormals::link), team);
  net.laplacian_weights = laplacian_weights_at(net, net.positions, team);
  return net;
}

TEST(LinkMatrix, HasTheRoundedEntriesAndTheExactSumsOfRows) {
  ThreadTeam team(2);
  for (const PolygonMesh& mesh : {generate::flat_disc({.nodes = 400, .jitter = 0.3}),
                                  generate::tube({.columns = 16, .rows = 12, .faces = generate::Faces::quads}, 1, 1)}) {
    const Net net = net_of(mesh, team);
    const SparseRows exact = tangential_laplacian(net, team);
    const LinkMatrix matrix(net, exact, team);
    ASSERT_EQ(matrix.size(), net.moving);
    Eigen::MatrixXd wanted = exact.to_eigen();
    const double size = wanted.diagonal().maxCoeff();
    for (std::size_t i = 0; i < net.moving; ++i) {
      const auto row = static_cast<Eigen::Index>(i);
      double sum = 0;
      matrix.for_row(i, [&](std::size_t column, double value) {
        double& entry = wanted(row, static_cast<Eigen::Index>(column));
        sum += value - entry;
        EXPECT_LT(std::abs(value - entry), 1e-6 * size) << i << ' ' << column;
        if (column != i) {
          EXPECT_EQ(value, static_cast<double>(static_cast<float>(entry)));
        }
        entry = 0;
      });
      EXPECT_LT(std::abs(sum), 1e-14 * size) << i;
    }
    EXPECT_EQ(wanted.cwiseAbs().maxCoeff(), 0) << "an entry was left out";
  }
}

}  // namespace
}  // namespace vspring::level_matrix_test
