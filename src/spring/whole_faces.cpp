#include "spring/whole_faces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <utility>

namespace vspring {

WholeFaces::WholeFaces(std::vector<std::vector<Corner>> faces)
    : faces_(std::move(faces)), areas_(faces_.size(), Vector3::Zero()) {
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const auto& face = faces_[f];
    const std::size_t count = face.size();
    for (std::size_t k = 0; k < count; ++k) {
      const auto& next = face[(k + 1) % count].node;
      const auto& previous = face[(k + count - 1) % count].node;
      if (face[k].node && next && previous)
        wedges_.push_back({*face[k].node, static_cast<std::uint32_t>(f), *next, *previous});
    }
  }
  std::sort(wedges_.begin(), wedges_.end(),
            [](const Wedge& a, const Wedge& b) { return a.node != b.node ? a.node < b.node : a.face < b.face; });
}

void WholeFaces::measure(std::span<const Vector3> positions) {
  for (std::size_t f = 0; f < faces_.size(); ++f) {
    const auto place = [&](const Corner& corner) { return corner.node ? positions[*corner.node] : corner.place; };
    const Vector3 origin = place(faces_[f].front());
    Vector3 area = Vector3::Zero();
    Vector3 previous = Vector3::Zero();
    for (const Corner& corner : faces_[f]) {
      const Vector3 next = place(corner) - origin;
      area += previous.cross(next);
      previous = next;
    }
    areas_[f] = area;
  }
}

std::optional<Vector3> WholeFaces::area(std::size_t node, std::size_t first, std::size_t last, bool in_sense) const {
  const auto begin = std::lower_bound(wedges_.begin(), wedges_.end(), node,
                                      [](const Wedge& wedge, std::size_t of) { return wedge.node < of; });
  for (auto wedge = begin; wedge != wedges_.end() && wedge->node == node; ++wedge) {
    if (wedge->next == first && wedge->previous == last) return areas_[wedge->face];
    if (!in_sense && wedge->next == last && wedge->previous == first) return -areas_[wedge->face];
  }
  return std::nullopt;
}

}  // namespace vspring
