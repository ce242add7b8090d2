#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "vspring/error.hpp"
#include "vspring/rules.hpp"
#include "vspring/weld.hpp"

namespace vspring::welded_rules_test {
namespace {

/// A fan of four triangles about the middle, cut along an edge: nodes 4 and 5 are the middle, 0 and 6 the end of the
/// cut.
class WeldedRules : public testing::Test {
 protected:
  [[nodiscard]] std::string fault(const std::string& rules) {
    try {
      apply_rules(constraints_, welded_.mesh, "{\"rules\": [" + rules + "]}",
                  {.normals = &normals_, .welded = &welded_});
    } catch (const Error& error) {
      return error.what();
    }
    return {};
  }

  PolygonMesh mesh_{{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 0.5}, {1e-7, 0, 0.5}, {1, 1e-7, 0}},
                    {0, 3, 6, 9, 12},
                    {4, 0, 1, 4, 1, 2, 5, 2, 3, 5, 3, 6}};
  Welded welded_ = weld(mesh_, 1e-6);
  std::vector<Vector3> normals_ = std::vector<Vector3>(7, Vector3(0, 0, 1));
  Constraints constraints_{7};
};

TEST_F(WeldedRules, ActOnWhatNodesHaveBecome) {
  EXPECT_EQ(fault(R"({"nodes": [5], "position": [0, 0, 1], "normal": "fixed"})"), "");
  EXPECT_EQ(constraints_.position(4), Vector3(0, 0, 1));
  EXPECT_TRUE(constraints_.normal_fixed(4));
  EXPECT_FALSE(constraints_.position_fixed(5));
  EXPECT_EQ(fault(R"({"nodes": [5], "position": "free", "normal": "free"})"), "");
  EXPECT_FALSE(constraints_.position_fixed(4));
  EXPECT_FALSE(constraints_.normal_fixed(4));
  EXPECT_EQ(fault(R"({"nodes": "boundary", "position": "fixed", "normal": "fixed"})"), "");
  for (const Index node : {0, 1, 2, 3})
    EXPECT_TRUE(constraints_.position_fixed(node) && constraints_.normal_fixed(node));
  EXPECT_FALSE(constraints_.position_fixed(4));
  EXPECT_EQ(fault(R"({"nodes": "interior", "position": "fixed"})"), "");
  EXPECT_TRUE(constraints_.position_fixed(4));
}

TEST_F(WeldedRules, RefuseTwoPlacesForOneNode) {
  const std::string both = "nodes 4 and 5 are welded into one and cannot have two ";
  EXPECT_NE(fault(R"({"nodes": [4, 5], "position": [[0, 0, 1], [0, 0, 2]]})").find("rule 1: " + both),
            std::string::npos);
  EXPECT_NE(
      fault(R"({"nodes": [4], "position": [0, 0, 1]}, {"nodes": [5], "position": "fixed"})").find("rule 2: " + both),
      std::string::npos);
  EXPECT_NE(fault(R"({"nodes": [4], "normal": [0, 0, 1]}, {"nodes": [5], "normal": [0, 1, 1]})").find("normals"),
            std::string::npos);
  normals_[5] = {0, 1, 0};
  EXPECT_NE(fault(R"({"nodes": "all", "normal": "file"})").find(both), std::string::npos);
  EXPECT_FALSE(constraints_.position_fixed(4));
}

TEST_F(WeldedRules, AgreeWithinTheToleranceAndWithWhatIsSaidOfAll) {
  EXPECT_EQ(fault(R"({"nodes": [4, 5], "position": [[0, 0, 1], [1e-7, 0, 1]], "normal": [[0, 0, 1], [0, 0, -2]]})"),
            "");
  EXPECT_EQ(fault(R"({"nodes": "all", "position": "fixed"}, {"nodes": [5], "position": [0, 0, 1]})"), "");
  EXPECT_EQ(constraints_.position(4), Vector3(0, 0, 1));
  EXPECT_EQ(fault(R"({"nodes": [4], "position": [0, 0, 1]}, {"nodes": [4], "position": [0, 0, 2]})"), "");
  EXPECT_EQ(fault(R"({"nodes": [4], "position": [0, 0, 1]}, {"nodes": [5], "position": "free"})"), "");
  EXPECT_FALSE(constraints_.position_fixed(4));
}

}  // namespace
}  // namespace vspring::welded_rules_test
