#include "refine/edge_table.hpp"

#include <algorithm>
#include <utility>

namespace vspring {

EdgeTable::EdgeTable(const FaceParcel& faces, Index node_count) : of_corner_(faces.corners.size()) {
  struct Use {
    Index high;
    Index corner;
  };
  const auto each = [&](const auto& action) {
    for (Index f = 0; f < faces.count(); ++f) {
      const auto face = faces.face(f);
      const Index first = faces.begin[static_cast<std::size_t>(f)];
      for (std::size_t k = 0; k < face.size(); ++k) {
        const auto [low, high] = std::minmax(face[k], face[(k + 1) % face.size()]);
        action(static_cast<std::size_t>(low), Use{high, first + static_cast<Index>(k)});
      }
    }
  };
  std::vector<Index> begin(static_cast<std::size_t>(node_count) + 1, 0);
  each([&](std::size_t low, const Use& /*use*/) { ++begin[low + 1]; });
  for (std::size_t i = 1; i < begin.size(); ++i) begin[i] += begin[i - 1];
  std::vector<Use> at(faces.corners.size());
  std::vector<Index> end(begin.begin(), begin.end() - 1);
  each([&](std::size_t low, const Use& use) { at[static_cast<std::size_t>(end[low]++)] = use; });

  uses_.reserve(at.size());
  for (Index low = 0; low < node_count; ++low) {
    const auto first = at.begin() + begin[static_cast<std::size_t>(low)];
    const auto last = at.begin() + begin[static_cast<std::size_t>(low) + 1];
    std::sort(first, last,
              [](const Use& a, const Use& b) { return a.high != b.high ? a.high < b.high : a.corner < b.corner; });
    for (auto use = first; use != last; ++use) {
      if (use == first || (use - 1)->high != use->high)
        edges_.push_back({low, use->high, static_cast<Index>(uses_.size())});
      of_corner_[static_cast<std::size_t>(use->corner)] = static_cast<Index>(edges_.size()) - 1;
      uses_.push_back(use->corner);
    }
  }
}

bool EdgeTable::joins(Index low, Index high) const {
  return std::binary_search(edges_.begin(), edges_.end(), Edge{low, high, 0}, [](const Edge& a, const Edge& b) {
    return a.low != b.low ? a.low < b.low : a.high < b.high;
  });
}

}  // namespace vspring
