#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <span>
#include <type_traits>

#include "spring/model_of.hpp"
#include "spring/pseudo_normal.hpp"
#include "spring/shares.hpp"
#include "spring/surface_force.hpp"

namespace vspring {

namespace {

/// Pseudo-normals of one kind, V-Spring along them, regularisation across.
template <typename Normal>
struct SurfaceRules {
  explicit SurfaceRules(Forces forces) : forces_(forces) {}

  static void prepare(Net& /*net*/) {}

  void update_directions(Net& net, std::size_t begin, std::size_t end) const {
    const auto normal = [&](std::size_t i) { return normal_of(net, i); };
    if (!net.spheres.on()) {
      for (std::size_t i = begin; i < end; ++i) {
        if (!net.normal_given(i)) net.normals[i] = normal(i);
      }
      return;
    }
    std::array<Vector3, spheres_together> first;
    for (std::size_t i = begin; i < end; i += first.size()) {
      const std::size_t count = std::min(first.size(), end - i);
      for (std::size_t k = 0; k < count; ++k) first[k] = net.normal_given(i + k) ? Vector3::Zero() : normal(i + k);
      update_spheres(net, i, std::span(first).first(count));
    }
  }

  [[nodiscard]] NodeForce force(const Net& net, std::size_t i) const { return surface_force(net, i, forces_); }

  [[nodiscard]] Vector3 sprung(const Net& net, std::size_t i, const Vector3& d) const {
    return d.dot(net.normals[i]) * net.normals[i];
  }

  /// The shares nearest to equal ones. If noise has put a node outside its neighbours and flipped faces, negative
  /// shares would drive nodes apart: then all are raised to at least a tenth of an equal share, which sends the node
  /// among its neighbours.
  void present_laplacian_weights(const Net& net, std::size_t i, std::span<double> shares) const {
    const auto links = net.rings.links(i);
    const Vector3& normal = net.normals[i];
    even_shares(net, i, normal, net.positions, shares);
    const auto spokes =
        static_cast<double>(std::count_if(links.begin(), links.end(), [](Link link) { return link.spoke(); }));
    const auto across = [&](Link link) -> Vector3 {
      const Vector3 d = net.positions[link.node()] - net.positions[i];
      return d - d.dot(normal) * normal;
    };
    const double least = spokes * *std::min_element(shares.begin(), shares.end());
    // At larger polygons, and with three neighbours, a node may rightly lie outside its neighbours.
    const auto around = static_cast<double>(links.size());
    const bool inside_if_flat = spokes > 3 && (around == spokes || around == 2 * spokes);
    if (!(inside_if_flat && least < -tolerated_share) && !(least < 0 && has_turned_face(links, across, normal))) return;
    double sum = 0;
    for (std::size_t k = 0; k < links.size(); ++k) {
      if (links[k].spoke()) sum += shares[k] = std::max(shares[k], least_share / spokes);
    }
    for (double& share : shares) share /= sum;
  }

 private:
  Forces forces_;
  // As a share of an equal one.
  static constexpr double least_share = 0.1;
  static constexpr double tolerated_share = 0.5;

  static Vector3 normal_of(const Net& net, std::size_t i) {
    const auto links = net.rings.links(i);
    if constexpr (!std::is_same_v<Normal, LinkNormal>) {
      if (!net.whole_faces.empty()) {
        const bool has_two = std::count_if(links.begin(), links.end(), [](Link link) { return link.spoke(); }) == 2;
        return Normal()(net.positions[i], links, net.positions,
                        [&](std::size_t first, std::size_t last, const Vector3& area) {
                          return net.whole_faces.area(i, first, last, has_two).value_or(area);
                        });
      }
    }
    return Normal()(net.positions[i], links, net.positions);
  }

  /// Whether a face around the node is flipped.
  template <typename Across>
  static bool has_turned_face(std::span<const Link> links, const Across& across, const Vector3& normal) {
    double area = 0;
    for (std::size_t k = 1; k <= links.size(); ++k) {
      const Link link = links[k % links.size()];
      if (link.start()) {
        area = 0;
        continue;
      }
      area += across(links[k - 1]).cross(across(link)).dot(normal);
      if (!link.spoke()) continue;
      if (area < 0) return true;
      area = 0;
    }
    return false;
  }
};

}  // namespace

std::unique_ptr<const Model> surface_model(PseudoNormals pseudo_normals, Forces forces) {
  switch (pseudo_normals) {
    case PseudoNormals::link:
      return std::make_unique<ModelOf<SurfaceRules<LinkNormal>>>(forces);
    case PseudoNormals::average:
      return std::make_unique<ModelOf<SurfaceRules<AverageNormal>>>(forces);
    case PseudoNormals::area:
      return std::make_unique<ModelOf<SurfaceRules<AreaNormal>>>(forces);
    case PseudoNormals::angle:
      return std::make_unique<ModelOf<SurfaceRules<AngleNormal>>>(forces);
  }
  return nullptr;
}

}  // namespace vspring
