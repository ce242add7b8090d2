#include "precondition/tangential_rigid_modes.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>

#include "base/dense_algebra.hpp"

namespace vspring {

TangentialRigidModes::TangentialRigidModes(const Net& net) : net_(&net) {
  if (!net.target_positions.empty()) return;
  constexpr auto unseen = static_cast<std::uint32_t>(-1);
  std::vector<std::uint32_t> component(net.moving, unseen);
  std::vector<std::uint8_t> held;
  std::vector<std::size_t> queue;
  for (std::size_t first = 0; first < net.moving; ++first) {
    if (component[first] != unseen) continue;
    const auto number = static_cast<std::uint32_t>(held.size());
    held.push_back(0);
    component[first] = number;
    queue.assign(1, first);
    while (!queue.empty()) {
      const std::size_t i = queue.back();
      queue.pop_back();
      for (const Link link : net.rings.links(i)) {
        const std::size_t j = link.node();
        if (j >= net.moving) {
          held[number] = 1;
        } else if (component[j] == unseen) {
          component[j] = number;
          queue.push_back(j);
        }
      }
    }
  }
  count_ = static_cast<std::size_t>(std::count(held.begin(), held.end(), 0));
  if (count_ == 0) return;
  std::vector<std::uint32_t> number(held.size(), static_cast<std::uint32_t>(count_));
  std::uint32_t next = 0;
  for (std::size_t k = 0; k < held.size(); ++k) {
    if (held[k] == 0) number[k] = next++;
  }
  for (std::uint32_t& one : component) one = number[one];
  component_ = std::move(component);
}

void TangentialRigidModes::hold(std::span<Vector3> vectors) const {
  if (!needed()) return;
  using Fields = Eigen::Matrix<double, 3, 6>;
  std::vector<Vector3> centre(count_ + 1, Vector3::Zero());
  std::vector<double> nodes(count_ + 1, 0);
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    centre[component_[i]] += net_->positions[i];
    nodes[component_[i]] += 1;
  }
  for (std::size_t k = 0; k < count_; ++k) centre[k] /= nodes[k];
  /// The components, across the normal of a node, of translations along the axes and rotations about them.
  const auto fields_at = [&](std::size_t i) {
    const Vector3& normal = net_->normals[i];
    const Vector3 arm = net_->positions[i] - centre[component_[i]];
    Fields fields;
    for (int axis = 0; axis < 3; ++axis) {
      fields.col(axis) = Vector3::Unit(axis);
      fields.col(axis + 3) = Vector3::Unit(axis).cross(arm);
    }
    return Fields(fields - normal * (normal.transpose() * fields));
  };
  using Vector6 = Eigen::Matrix<double, 6, 1>;
  using Matrix6 = Eigen::Matrix<double, 6, 6>;
  std::vector<Matrix6> products(count_, Matrix6::Zero());
  std::vector<Vector6> shares(count_, Vector6::Zero());
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    if (component_[i] == count_) continue;
    const Fields fields = fields_at(i);
    products[component_[i]] += fields.transpose() * fields;
    shares[component_[i]] += fields.transpose() * vectors[i];
  }
  for (std::size_t k = 0; k < count_; ++k)
    shares[k] = PivotedCholesky(products[k]).solve(shares[k], 6 * std::numeric_limits<double>::epsilon());
  for (std::size_t i = 0; i < vectors.size(); ++i) {
    if (component_[i] != count_) vectors[i] -= fields_at(i) * shares[component_[i]];
  }
}

}  // namespace vspring
