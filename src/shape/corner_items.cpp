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

/// Items of a mesh with new triangles: each new node has one.
class RemeshedItems {
 public:
  RemeshedItems(const PolygonMesh& input, const RefinedMesh& refined, std::span<const Index> items, Index item_count)
      : input_(input),
        refined_(refined),
        items_(items),
        item_count_(item_count),
        parts_(parts_of_faces(input, refined)),
        of_node_(static_cast<std::size_t>(input.node_count()), -1),
        numbers_(refined.numbers_in_means()) {}

  CornerItems find(bool joins_seams) {
    result_.left_out = find_items_of_nodes() && !joins_seams;
    if (!result_.left_out) add_new_items();
    for (Index f = 0; f < input_.face_count(); ++f) {
      const FaceParts& parts = parts_[static_cast<std::size_t>(f)];
      for (Index part = parts.begin; part < parts.end; ++part) {
        if (parts.is_divided)
          add_part(part);
        else
          result_.items.insert(result_.items.end(), items_.begin() + input_.face_begin(f),
                               items_.begin() + input_.face_begin(f + 1));
      }
    }
    return std::move(result_);
  }

 private:
  /// Returns whether a node of the changed faces has several.
  bool find_items_of_nodes() {
    bool any = false;
    for (Index f = 0; f < input_.face_count(); ++f) {
      if (!parts_[static_cast<std::size_t>(f)].is_divided) continue;
      const auto face = input_.face(f);
      for (std::size_t k = 0; k < face.size(); ++k) {
        Index& known = of_node_[static_cast<std::size_t>(face[k])];
        const Index own = items_[static_cast<std::size_t>(input_.face_begin(f)) + k];
        if (known < 0) known = own;
        any = any || known != own;
      }
    }
    for (std::size_t corner = 0; corner < items_.size(); ++corner) {
      Index& known = of_node_[static_cast<std::size_t>(input_.corners()[corner])];
      if (known < 0) known = items_[corner];
    }
    return any;
  }
  void add_new_items() {
    for (Index node = refined_.kept_node_count(); node < refined_.mesh.node_count(); ++node) {
      const auto of = refined_.means(node);
      const auto first = static_cast<std::size_t>(of.data() - refined_.mean_of.data());
      const bool has_items = std::all_of(of.begin(), of.end(),
                                         [&](Index other) { return of_node_[static_cast<std::size_t>(other)] >= 0; });
      new_items_.push_back(has_items ? item_count_ + static_cast<Index>(result_.new_count()) : -1);
      if (!has_items) continue;
      for (std::size_t j = 0; j < of.size(); ++j) {
        result_.mean_of.push_back(of_node_[static_cast<std::size_t>(of[j])]);
        result_.shares.push_back(refined_.shares[first + j]);
      }
      result_.mean_begin.push_back(static_cast<Index>(result_.mean_of.size()));
    }
  }
  void add_part(Index part) {
    for (const Index node : refined_.mesh.face(part)) {
      const Index kept = refined_.kept_node_count();
      const Index item = node < kept ? of_node_[static_cast<std::size_t>(numbers_[static_cast<std::size_t>(node)])]
                         : result_.left_out ? -1
                                            : new_items_[static_cast<std::size_t>(node - kept)];
      result_.items.push_back(result_.left_out ? -1 : item);
    }
  }

  const PolygonMesh& input_;
  const RefinedMesh& refined_;
  std::span<const Index> items_;
  Index item_count_;
  std::vector<FaceParts> parts_;
  std::vector<Index> of_node_;  ///< of the changed faces
  std::vector<Index> numbers_;
  std::vector<Index> new_items_;  ///< per new node
  CornerItems result_;
};

}  // namespace

CornerItems refined_items(const PolygonMesh& input, const RefinedMesh& refined, std::span<const Index> items,
                          Index item_count, bool joins_seams) {
  if (refined.is_remeshed()) return RemeshedItems(input, refined, items, item_count).find(joins_seams);
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
  const std::vector<Index> numbers = refined.numbers_in_means();
  Index begin = 0;
  for (Index f = 0; f < input.face_count(); ++f) {
    Index end = begin;
    while (end < refined.mesh.face_count() && refined.face_from[static_cast<std::size_t>(end)] == f) ++end;
    const auto before = input.face(f);
    bool is_divided = end != begin + 1;
    bool is_renumbered = false;
    if (!is_divided) {
      const auto after = refined.mesh.face(begin);
      is_divided = !std::equal(before.begin(), before.end(), after.begin(), after.end(),
                               [&](Index old, Index now) { return old == numbers[static_cast<std::size_t>(now)]; });
      is_renumbered = !std::equal(before.begin(), before.end(), after.begin(), after.end());
    }
    parts.push_back({begin, end, is_divided, is_renumbered});
    begin = end;
  }
  return parts;
}

}  // namespace vspring
