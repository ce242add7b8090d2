#include <gtest/gtest.h>

#include <string>
#include <variant>
#include <vector>

#include "unit/io/scratch.hpp"
#include "vspring/error.hpp"
#include "vspring/rules.hpp"

namespace vspring::region_specification_test {
namespace {

using Nodes = std::vector<Index>;

class RegionSpecification : public Scratch {
 protected:
  [[nodiscard]] Nodes selected(const std::string& specification) const {
    return select_region(positions_, parse_region(specification), groups_);
  }
  [[nodiscard]] std::string refused(const std::string& specification,
                                    ErrorCode code = ErrorCode::unusable_constraint) const {
    return message_of([&] { (void)selected(specification); }, code);
  }

  std::vector<Vector3> positions_ = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {3, 0, 0}};
  Groups groups_ = {{"ends", {0, 3}}, {"none", {}}};
};

TEST_F(RegionSpecification, SelectsWhatItSays) {
  EXPECT_EQ(selected("sphere:1,0,0,1"), (Nodes{0, 1, 2}));
  EXPECT_EQ(selected("box:3,1,1,2,-1,-1"), (Nodes{2, 3}));
  EXPECT_EQ(selected("group:ends"), (Nodes{0, 3}));
  EXPECT_EQ(selected(put("list.json", "[3, 1, 3]")), (Nodes{1, 3}));
  EXPECT_EQ(selected(put("object.json", R"({"nodes": [2]})")), (Nodes{2}));
}

TEST_F(RegionSpecification, IsTheSameAsTheRegionItNames) {
  const Region sphere = parse_region("sphere:0.5,1,-2,1e-1");
  EXPECT_EQ(sphere.name, "sphere:0.5,1,-2,1e-1");
  EXPECT_EQ(std::get<SphereRegion>(sphere.extent).centre, Vector3(0.5, 1, -2));
  EXPECT_EQ(std::get<SphereRegion>(sphere.extent).radius, 0.1);
  const Region box = parse_region("box:0,1,2,3,4,5");
  EXPECT_EQ(std::get<BoxRegion>(box.extent).from, Vector3(0, 1, 2));
  EXPECT_EQ(std::get<BoxRegion>(box.extent).to, Vector3(3, 4, 5));
  EXPECT_EQ(std::get<GroupRegion>(parse_region("group:a,b:c").extent).group, "a,b:c");
}

TEST_F(RegionSpecification, IsRefusedWithWhatIsWrong) {
  const std::string ways =
      "; write sphere:x,y,z,r, box:x0,y0,z0,x1,y1,z1, group:NAME or the name of a JSON file with a list of nodes";
  EXPECT_EQ(refused("sphere:1,0,0"), "region \"sphere:1,0,0\": 4 numbers are needed, 3 are given" + ways);
  EXPECT_EQ(refused("sphere:1,0,0,-1"), "region \"sphere:1,0,0,-1\": the radius must not be negative" + ways);
  EXPECT_EQ(refused("box:0,0,0,1,1,x"), "region \"box:0,0,0,1,1,x\": \"x\" is no number" + ways);
  EXPECT_EQ(refused("sphere:9,0,0,1"), "region \"sphere:9,0,0,1\": no node lies in it");
  EXPECT_EQ(refused("group:side"), "region \"group:side\": the shape has no such group; it has ends, none");
  EXPECT_EQ(refused("group:none"), "region \"group:none\": no node lies in it");
  EXPECT_EQ(
      refused(path("gone.json"), ErrorCode::unusable_file),
      "gone.json: cannot be read: No such file or directory; check the path, its folders have to exist; a region is "
      "sphere:x,y,z,r, box:x0,y0,z0,x1,y1,z1, group:NAME or the name of a JSON file with a list of nodes");
  EXPECT_EQ(refused(put("four.json", "[0, 4]")), "four.json: 4 is not a node; nodes go from 0 to 3");
  EXPECT_EQ(refused(put("below.json", "[-1]")), "below.json: -1 is not a node; nodes go from 0 to 3");
  EXPECT_EQ(refused(put("half.json", "[0.5]")),
            "half.json: 0.5 is not a node; write a list of node numbers, such as [1, 2, 3]");
  EXPECT_EQ(refused(put("large.json", "[99999999999]")),
            "large.json: 99999999999 is not a node; write a list of node numbers, such as [1, 2, 3]");
  EXPECT_EQ(refused(put("word.json", "\"all\"")), "word.json: write a list of node numbers, such as [1, 2, 3]");
  EXPECT_EQ(refused(put("text.json", "all")).substr(0, 20), "text.json: no JSON: ");
}

TEST_F(RegionSpecification, WithoutANameIsARegion) {
  EXPECT_EQ(message_of(
                [&] {
                  (void)select_region(positions_, {SphereRegion{{9, 0, 0}, 1}});
                },
                ErrorCode::unusable_constraint),
            "region: no node lies in it");
  EXPECT_EQ(message_of([&] { (void)select_region(positions_, {NodeRegion{{7}}}); }, ErrorCode::unusable_constraint),
            "region: 7 is not a node; nodes go from 0 to 3");
}

}  // namespace
}  // namespace vspring::region_specification_test
