#pragma once

#include <span>
#include <vector>

#include "vspring/polygon_mesh.hpp"
#include "vspring/refined_mesh.hpp"

namespace vspring {

/// What the corners of a refined mesh have, such as texture coordinates: items of the input, by numbers, and new ones
/// that are means of items. Corners that share a node share a new item only if those of its edge do.
struct CornerItems {
  std::vector<Index> items;  ///< per corner of the refined mesh; −1 if a corner that it lies between has none
  /// New item k, whose number is k behind the input's last, is the mean of mean_of[mean_begin[k]] and those behind it
  /// up to mean_begin[k + 1], which have smaller numbers.
  std::vector<Index> mean_begin = {0};
  std::vector<Index> mean_of;
  std::vector<double> shares;  ///< of these in the mean; empty: all are equal
  bool left_out = false;       ///< corners of new triangles have no items, as those of the nodes are not one

  [[nodiscard]] std::span<const Index> means(std::size_t k) const {
    return std::span(mean_of).subspan(static_cast<std::size_t>(mean_begin[k]),
                                      static_cast<std::size_t>(mean_begin[k + 1] - mean_begin[k]));
  }
  /// The mean of new item k of what value(of) says of each of means(k).
  template <typename Value>
  [[nodiscard]] double mean(std::size_t k, const Value& value) const {
    const auto of = means(k);
    double sum = 0;
    for (std::size_t j = 0; j < of.size(); ++j)
      sum += shares.empty() ? value(of[j]) : shares[static_cast<std::size_t>(mean_begin[k]) + j] * value(of[j]);
    return shares.empty() ? sum / static_cast<double>(of.size()) : sum;
  }
  [[nodiscard]] std::size_t new_count() const { return mean_begin.size() - 1; }
};

/// items: one per corner of `input`, from 0 to item_count, or −1 for none. Of a mesh with new triangles: where a node
/// of the changed faces has several items, as at seams, these triangles get none; with joins_seams the node has the
/// first of them. Cost: linear.
CornerItems refined_items(const PolygonMesh& input, const RefinedMesh& refined, std::span<const Index> items,
                          Index item_count, bool joins_seams = false);

/// What a face of the input has become: the faces from `begin` up to `end` of the refined mesh.
struct FaceParts {
  Index begin;
  Index end;
  bool is_divided;     ///< else it is the same face
  bool is_renumbered;  ///< its nodes have other numbers
};

/// The parts of each face of the input. Cost: linear.
std::vector<FaceParts> parts_of_faces(const PolygonMesh& input, const RefinedMesh& refined);

}  // namespace vspring
