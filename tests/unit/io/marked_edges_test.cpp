#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

#include "support/refusal.hpp"
#include "vspring/surface_file.hpp"

namespace vspring::marked_edges_test {
namespace {

using support::refusal;
using support::says;

SurfaceFile file_of(const std::string& text) { return read_surface_bytes(text, "in"); }

const std::string square = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";

std::string ply(const std::string& properties, const std::string& rows) {
  return "ply\nformat ascii 1.0\nelement edge 3\n" + properties +
         "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n"
         "element face 2\nproperty list uchar int vertex_indices\nend_header\n" +
         rows + "0 0 0\n1 0 0\n1 1 0\n0 1 0\n3 0 1 2\n3 0 2 3\n";
}

const std::string ends = "property int vertex1\nproperty int vertex2\n";

TEST(MarkedEdges, AreLinesOfObj) {
  EXPECT_EQ(marked_edges(file_of(square + "l 1/1 3 \\\n 4\nl -1 -4\n")), (MeshEdges{{0, 2}, {2, 3}, {3, 0}}));
  EXPECT_TRUE(marked_edges(file_of(square)).empty());
}

TEST(MarkedEdges, OfObjThatCannotBeReadAreRefusedAlone) {
  for (const auto& [line, why] : {std::pair("l 1 5\n", "node 5 does not exist"), std::pair("l 1\n", "number of a node"),
                                  std::pair("l 1 x\n", "number of a node")}) {
    const SurfaceFile file = file_of(square + line);
    EXPECT_EQ(surface_bytes("out.obj", file, file.mesh.positions()).bytes, square + line);
    const std::string message = refusal([&] { (void)marked_edges(file); }, ErrorCode::unusable_file);
    EXPECT_TRUE(says(message, why) && says(message, ":7:")) << message;
  }
}

TEST(MarkedEdges, AreElementsOfPly) {
  const MeshEdges all = {{0, 2}, {2, 3}, {3, 0}};
  EXPECT_EQ(marked_edges(file_of(ply(ends, "0 2\n2 3\n3 0\n"))), all);
  const std::string more = "property list uchar float more\n" + ends + "property uchar red\n";
  EXPECT_EQ(marked_edges(file_of(ply(more, "1 0.5 0 2 0\n0 2 3 0\n0 3 0 9\n"))), all);
  for (const std::string said : {"sharp", "crease"}) {
    const std::string property = fmt::format("{}property float {}\n", ends, said);
    EXPECT_EQ(marked_edges(file_of(ply(property, "0 2 0.5\n2 3 0\n3 0 1\n"))), (MeshEdges{{0, 2}, {3, 0}})) << said;
  }
}

TEST(MarkedEdges, OfBinaryPlyAreTheSame) {
  std::string text = ply(ends, "");
  const std::string body = "end_header\n";
  text = text.substr(0, text.find(body) + body.size());
  text.replace(text.find("ascii"), 5, "binary_little_endian");
  const auto put = [&](const auto number) { text.append(reinterpret_cast<const char*>(&number), sizeof number); };
  for (const int node : {0, 2, 2, 3, 3, 0}) put(node);
  for (const float number : {0.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F, 1.0F, 1.0F, 0.0F, 0.0F, 1.0F, 0.0F}) put(number);
  for (const int last : {2, 3}) {
    text += '\3';
    for (const int node : {0, last - 1, last}) put(node);
  }
  EXPECT_EQ(marked_edges(file_of(text)), (MeshEdges{{0, 2}, {2, 3}, {3, 0}}));
}

TEST(MarkedEdges, OfPlyThatCannotBeReadAreRefused) {
  const std::string message =
      refusal([] { (void)marked_edges(file_of(ply(ends, "0 2\n2 4\n3 0\n"))); }, ErrorCode::unusable_file);
  EXPECT_TRUE(says(message, "edge 1 of 3: node 4 does not exist")) << message;
  const std::string nameless = "property int a\nproperty int vertex2\n";
  EXPECT_TRUE(
      says(refusal([&] { (void)marked_edges(file_of(ply(nameless, "0 2\n2 3\n3 0\n"))); }, ErrorCode::unusable_file),
           "vertex1 and vertex2"));
}

}  // namespace
}  // namespace vspring::marked_edges_test
