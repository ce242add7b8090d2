#include "shape/corner_items.hpp"

#include <algorithm>
#include <cstdint>
#include <unordered_map>
#include <utility>

namespace vspring {

namespace {

/// Finds the items of nodes within one face of the input after the other.
class ItemFinder {
 public:
  ItemFinder(const RefinedMesh& refined, Index item_count, CornerItems& result)
      : refined_(refined), item_count_(item_count), result_(result) {}

  void begin_face(std::span<const Index> nodes, std::span<const Index> items) {
    known_.clear();
    for (std::size_t k = 0; k < nodes.size(); ++k) known_.emplace(nodes[k], items[k]);
  }

  Index item_at(Index node) {
    if (const auto found = known_.find(node); found != known_.end()) return found->second;
    std::vector<Index> of;
    for (const Index other : refined_.means(node)) of.push_back(item_at(other));
    const Index item = mean_of(std::move(of));
    known_.emplace(node, item);
    return item;
  }

 private:
  Index mean_of(std::vector<Index> of) {
    std::sort(of.begin(), of.end());
    if (of.front() < 0 || of.front() == of.back()) return of.front();
    const auto add = [&] {
      result_.mean_of.insert(result_.mean_of.end(), of.begin(), of.end());
      result_.mean_begin.push_back(static_cast<Index>(result_.mean_of.size()));
      return item_count_ + static_cast<Index>(result_.new_count()) - 1;
    };
    // The middle of a face belongs to no other.
    if (of.size() != 2) return add();
    const std::uint64_t key = (static_cast<std::uint64_t>(of[0]) << 32) | static_cast<std::uint32_t>(of[1]);
    const auto [place, is_new] = of_edges_.try_emplace(key, -1);
    if (is_new) place->second = add();
    return place->second;
  }

  const RefinedMesh& refined_;
  Index item_count_;
  CornerItems& result_;
  std::unordered_map<Index, Index> known_;             ///< of this face: items of nodes
  std::unordered_map<std::uint64_t, Index> of_edges_;  ///< of all faces: means of two items
};

}  // namespace

CornerItems refined_items(const PolygonMesh& input, const RefinedMesh& refined, std::span<const Index> items,
                          Index item_count) {
  CornerItems result;
  result.items.reserve(refined.mesh.corners().size());
  ItemFinder finder(refined, item_count, result);
  Index last = -1;
  for (Index f = 0; f < refined.mesh.face_count(); ++f) {
    const Index from = refined.face_from[static_cast<std::size_t>(f)];
    if (from != last) {
      const auto nodes = input.face(from);
      finder.begin_face(nodes, items.subspan(static_cast<std::size_t>(input.face_begin(from)), nodes.size()));
      last = from;
    }
    for (const Index node : refined.mesh.face(f)) result.items.push_back(finder.item_at(node));
  }
  return result;
}

std::vector<FaceParts> parts_of_faces(const PolygonMesh& input, const RefinedMesh& refined) {
  std::vector<FaceParts> parts;
  parts.reserve(static_cast<std::size_t>(input.face_count()));
  Index begin = 0;
  for (Index f = 0; f < input.face_count(); ++f) {
    Index end = begin;
    while (end < refined.mesh.face_count() && refined.face_from[static_cast<std::size_t>(end)] == f) ++end;
    const auto before = input.face(f);
    bool is_divided = end != begin + 1;
    if (!is_divided) {
      const auto after = refined.mesh.face(begin);
      is_divided = !std::equal(before.begin(), before.end(), after.begin(), after.end());
    }
    parts.push_back({begin, end, is_divided});
    begin = end;
  }
  return parts;
}

}  // namespace vspring
