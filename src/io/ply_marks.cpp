// Edges that PLY marks, in its element `edge`.
#include <fmt/format.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "io/ply.hpp"
#include "io/ply_data.hpp"

namespace vspring {

namespace {

/// Data: PlyText or PlyBinary.
template <typename Data>
class MarkReader : private PlyElements<Data> {
 public:
  using PlyElements<Data>::PlyElements;

  MeshEdges read(Index node_count) {
    for (const PlyElement& element : this->header_.elements) {
      this->check_count(element);
      if (element.name == "edge") return read_edges(element, node_count);
      this->skip_elements(element);
    }
    return {};
  }

 private:
  MeshEdges read_edges(const PlyElement& element, Index node_count) {
    const std::array ends = {find_number(element, "vertex1"), find_number(element, "vertex2")};
    for (const int end : ends) {
      if (end < 0 || !is_whole(element.properties[static_cast<std::size_t>(end)].type))
        this->file_.refuse("element edge has no whole numbers vertex1 and vertex2; export the file again");
    }
    const int sharp = find_number(element, "sharp");
    const int said = sharp >= 0 ? sharp : find_number(element, "crease");
    MeshEdges edges;
    for (PlyPlace place{&element, 0}; place.number < element.count; ++place.number) {
      std::array<Index, 2> nodes{};
      bool is_marked = true;
      for (int k = 0; k < static_cast<int>(element.properties.size()); ++k) {
        const PlyProperty& property = element.properties[static_cast<std::size_t>(k)];
        if (k == ends[0] || k == ends[1]) {
          const std::int64_t node = this->data_.whole(property.type, place);
          if (node < 0 || node >= node_count)
            this->data_.refuse(fmt::format("{}: node {} does not exist, nodes go from 0 to {}; correct the edge",
                                           place.text(), node, node_count - 1));
          nodes[k == ends[0] ? 0 : 1] = static_cast<Index>(node);
        } else if (k == said) {
          is_marked = this->data_.number(property.type, place) != 0;
        } else {
          this->skip_property(property, place);
        }
      }
      if (is_marked) edges.emplace_back(nodes[0], nodes[1]);
    }
    return edges;
  }
};

}  // namespace

MeshEdges PlySource::marked_edges() const {
  if (is_plain) return {};
  return header.encoding == PlyEncoding::text ? MarkReader<PlyText>(file, header).read(mesh.node_count())
                                              : MarkReader<PlyBinary>(file, header).read(mesh.node_count());
}

}  // namespace vspring
