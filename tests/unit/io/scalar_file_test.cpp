#include "vspring/scalar_file.hpp"

#include <limits>

#include "unit/io/scratch.hpp"
#include "vspring/surface_file.hpp"

namespace vspring::scalar_file_test {
namespace {

class ScalarFile : public Scratch {
 protected:
  // A triangle and a quad.
  const PolygonMesh mesh_{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {2, 0.5, 0}}, {0, 3, 7}, {1, 4, 2, 0, 1, 2, 3}};
  const std::vector<NodeScalar> heights_ = {{"height", {0.1, 2, -3, 4e-300, 5}}};

  /// What write_scalars() says.
  template <typename Shape>
  std::string refusal(const std::string& name, const Shape& shape, const std::vector<NodeScalar>& scalars) const {
    try {
      write_scalars(path(name), shape, scalars);
    } catch (const Error& error) {
      EXPECT_EQ(error.code(), ErrorCode::invalid_argument);
      EXPECT_TRUE(files().empty());
      return error.what();
    }
    return {};
  }
};

TEST_F(ScalarFile, VtpHasPolygonsAndNumbersThatReadBackTheSame) {
  write_scalars(path("out.vtp"), mesh_, heights_);
  const std::string text = get("out.vtp");
  EXPECT_NE(text.find("NumberOfPoints=\"5\" NumberOfVerts=\"0\" NumberOfLines=\"0\" NumberOfStrips=\"0\" "
                      "NumberOfPolys=\"2\""),
            std::string::npos);
  EXPECT_NE(text.find("Name=\"height\" format=\"ascii\">\n0.1\n2\n-3\n4e-300\n5\n</DataArray>"), std::string::npos);
  EXPECT_NE(text.find("Name=\"connectivity\" format=\"ascii\">\n1 4 2\n0 1 2 3\n</DataArray>"), std::string::npos);
  EXPECT_NE(text.find("Name=\"offsets\" format=\"ascii\">\n3\n7\n</DataArray>"), std::string::npos);
}

TEST_F(ScalarFile, PlyIsReadAsTheSameMesh) {
  write_scalars(path("out.PLY"), mesh_, heights_);
  const PolygonMesh read = read_surface(path("out.PLY")).mesh;
  EXPECT_EQ(read.positions(), mesh_.positions());
  EXPECT_EQ(read.corners(), mesh_.corners());
  EXPECT_NE(get("out.PLY").find("property double height\nelement face 2\n"), std::string::npos);
}

TEST_F(ScalarFile, ClosedChainsComeBackToTheirFirstNode) {
  const PolygonCurve curve({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}}, true);
  write_scalars(path("out.vtp"), curve, {});
  EXPECT_NE(
      get("out.vtp").find("<Lines>\n<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\">\n0 1 2 0\n"),
      std::string::npos);
}

TEST_F(ScalarFile, RefusesWhatNoFileCanHold) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal("out.vtu", mesh_, heights_).find("vtp"), std::string::npos);
  EXPECT_NE(refusal("out.vtp", mesh_, {{"height", {1, 2}}}).find("2 values given for 5 nodes"), std::string::npos);
  EXPECT_NE(refusal("out.vtp", mesh_, {{"a\"b", {1, 2, 3, 4, 5}}}).find("letters"), std::string::npos);
  EXPECT_NE(refusal("out.ply", mesh_, {{"height", {1, 2, nan, 4, 5}}}).find("node 2"), std::string::npos);
  PolygonMesh odd = mesh_;
  std::vector<Vector3> positions = mesh_.positions();
  positions[3].x() = nan;
  odd.set_positions(positions);
  EXPECT_NE(refusal("out.vtp", odd, heights_).find("node 3"), std::string::npos);
  EXPECT_NE(refusal("out.ply", PolygonCurve({{0, 0, 0}, {1, 0, 0}}), {}).find(".vtp"), std::string::npos);
}

}  // namespace
}  // namespace vspring::scalar_file_test
