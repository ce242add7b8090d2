#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "spring/net.hpp"

namespace vspring {

/// The edges from a node to all of its link, gathered once.
class LinkEdges {
 public:
  LinkEdges(const Net& net, std::size_t i)
      : links_(net.rings.links(i)), edges_(few_.data()), squares_(squares_of_few_.data()) {
    if (links_.size() > few) {
      many_.resize(links_.size());
      squares_of_many_.resize(links_.size());
      edges_ = many_.data();
      squares_ = squares_of_many_.data();
    }
    for (std::size_t k = 0; k < links_.size(); ++k) {
      edges_[k] = net.positions[links_[k].node()] - net.positions[i];
      squares_[k] = edges_[k].squaredNorm();
    }
  }
  LinkEdges(const LinkEdges&) = delete;
  LinkEdges& operator=(const LinkEdges&) = delete;

  [[nodiscard]] std::span<const Link> links() const { return links_; }
  [[nodiscard]] std::size_t size() const { return links_.size(); }
  [[nodiscard]] const Vector3& operator[](std::size_t k) const { return edges_[k]; }
  [[nodiscard]] double square(std::size_t k) const { return squares_[k]; }

 private:
  // Hardly any node has more, and space on the stack costs nothing.
  static constexpr std::size_t few = 24;

  std::span<const Link> links_;
  std::array<Vector3, few> few_;
  std::array<double, few> squares_of_few_;
  std::vector<Vector3> many_;
  std::vector<double> squares_of_many_;
  Vector3* edges_;
  double* squares_;
};

}  // namespace vspring
