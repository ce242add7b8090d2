#pragma once

#include <functional>
#include <memory>
#include <utility>
#include <vector>

#include "spring/net.hpp"

namespace vspring {

/// Where all nodes of a shape were as it went in, with its constraints applied: kept, or made again each time from what
/// the caller has anyway, as of a large shape they are many.
class StartPlaces {
 public:
  using Make = std::function<std::vector<Vector3>(const Net&)>;

  StartPlaces() = default;
  explicit StartPlaces(std::vector<Vector3> kept)
      : kept_(std::make_shared<const std::vector<Vector3>>(std::move(kept))) {}
  explicit StartPlaces(Make make) : make_(std::move(make)) {}

  /// Whether they are known.
  explicit operator bool() const noexcept { return kept_ != nullptr || make_ != nullptr; }
  /// In the coordinates of the net, whose nodes may be elsewhere by now.
  [[nodiscard]] std::vector<Vector3> of(const Net& net) const { return kept_ ? *kept_ : make_(net); }

 private:
  std::shared_ptr<const std::vector<Vector3>> kept_;
  Make make_;
};

}  // namespace vspring
