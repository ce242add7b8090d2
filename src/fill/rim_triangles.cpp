// Minimum-weight triangulation of a closed polygon in space.
#include "fill/rim_triangles.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <set>
#include <tuple>
#include <utility>

#include "base/cancellation.hpp"
#include "shape/direction.hpp"

namespace vspring {

namespace {

// In units of 1 − cos of the dihedral angle.
constexpr double angle_step = 1e-7;
constexpr auto full_turn = static_cast<std::int32_t>(2 / angle_step);
constexpr std::int32_t turn_of_folds = full_turn - static_cast<std::int32_t>(0.0038 / angle_step);  // 175°

/// The quantity to minimise: the greatest angle, then the area.
struct Weight {
  std::int32_t turn = 0;
  double area = 0;

  [[nodiscard]] bool operator<(const Weight& other) const {
    return std::tie(turn, area) < std::tie(other.turn, other.area);
  }
};

struct Triangle3 {
  Vector3 normal;  ///< zero if it has none
  double area;
};

Triangle3 triangle(const Vector3& a, const Vector3& b, const Vector3& c) {
  const Vector3 ab = b - a;
  const Vector3 ac = c - a;
  const Vector3 sum = ab.cross(ac);
  return {direction(sum, ab.squaredNorm() + ac.squaredNorm()), sum.norm() / 2};
}

/// The angle between a triangle and the face across one of its edges.
std::int32_t turn_between(const Vector3& normal, const Vector3& beside) {
  if (beside.isZero(0)) return 0;
  if (normal.isZero(0)) return full_turn;
  return static_cast<std::int32_t>(std::lround((1 - std::clamp(normal.dot(beside), -1.0, 1.0)) / angle_step));
}

bool joins(const Rim& rim, Index a, Index b) {
  const std::vector<Index>& others = rim.joined[static_cast<std::size_t>(a)];
  return std::binary_search(others.begin(), others.end(), b);
}

/// A closed polygon of nodes of a rim.
struct Polygon {
  std::vector<Index> nodes;
  std::vector<Vector3> normals;  ///< of the face at the edge from each node to the next
};

/// Cuts ears off until the polygon has at most `most` edges: those with the shortest new edge first, so it coarsens
/// evenly, and those that fold over last.
class EarCutter {
  template <typename Values>
  static auto& at(Values& values, Index node) {
    return values[static_cast<std::size_t>(node)];
  }
  struct Ear {
    bool folds = false;
    double chord = -1;  ///< negative: cannot be cut
    Vector3 normal = Vector3::Zero();
  };

 public:
  explicit EarCutter(const Rim& rim) : rim_(rim), normals_(rim.normals) {
    const auto count = static_cast<Index>(rim.places.size());
    for (Index k = 0; k < count; ++k) {
      before_.push_back((k + count - 1) % count);
      behind_.push_back((k + 1) % count);
    }
    ears_.resize(rim.places.size());
    for (Index k = 0; k < count; ++k) add(k);
  }

  /// Appends the ears to `triangles`.
  Polygon cut(std::size_t most, std::vector<std::array<Index, 3>>& triangles) {
    std::size_t left = rim_.places.size();
    for (; left > most && !queue_.empty(); --left) {
      end_if_cancelled_at(left);
      const Index tip = std::get<2>(*queue_.begin());
      remove(tip);
      const Index a = at(before_, tip);
      const Index b = at(behind_, tip);
      triangles.push_back({a, tip, b});
      at(normals_, a) = at(ears_, tip).normal;
      at(behind_, a) = b;
      at(before_, b) = a;
      for (const Index end : {a, b}) {
        remove(end);
        add(end);
      }
      last_ = a;
    }
    Polygon polygon;
    Index node = last_;
    for (; left > 0; --left, node = at(behind_, node)) {
      polygon.nodes.push_back(node);
      polygon.normals.push_back(at(normals_, node));
    }
    return polygon;
  }

 private:
  void add(Index tip) {
    const Index a = at(before_, tip);
    const Index b = at(behind_, tip);
    Ear& ear = at(ears_, tip);
    ear = {};
    if (joins(rim_, a, b)) return;
    const Triangle3 cut = triangle(at(rim_.places, a), at(rim_.places, tip), at(rim_.places, b));
    const auto turn = std::max(turn_between(cut.normal, at(normals_, a)), turn_between(cut.normal, at(normals_, tip)));
    ear = {turn > full_turn / 2, (at(rim_.places, b) - at(rim_.places, a)).norm(), cut.normal};
    queue_.emplace(ear.folds, ear.chord, tip);
  }
  void remove(Index tip) {
    const Ear& ear = at(ears_, tip);
    if (ear.chord >= 0) queue_.erase({ear.folds, ear.chord, tip});
  }

  const Rim& rim_;
  std::vector<Vector3> normals_;
  std::vector<Index> before_;
  std::vector<Index> behind_;
  std::vector<Ear> ears_;
  std::set<std::tuple<bool, double, Index>> queue_;
  Index last_ = 0;
};

/// Finds the best triangulation of each part of a polygon from one node to a later one, and so of the whole.
class BestTriangulation {
 public:
  BestTriangulation(const Rim& rim, const Polygon& polygon)
      : rim_(rim), polygon_(polygon), count_(polygon.nodes.size()), parts_(count_ * count_) {
    for (std::size_t i = 0; i + 1 < count_; ++i) part(i, i + 1) = {{0, 0}, 0, polygon.normals[i], true};
    for (std::size_t length = 2; length < count_; ++length) {
      end_if_cancelled();
      for (std::size_t i = 0; i + length < count_; ++i) look_at(i, i + length);
    }
  }

  /// Appends the triangles. Returns whether there are any.
  bool take(std::vector<std::array<Index, 3>>& triangles) const {
    if (!part(0, count_ - 1).is_possible) return false;
    std::vector<std::pair<std::size_t, std::size_t>> left = {{0, count_ - 1}};
    while (!left.empty()) {
      const auto [i, j] = left.back();
      left.pop_back();
      if (j == i + 1) continue;
      const std::size_t k = part(i, j).tip;
      triangles.push_back({polygon_.nodes[i], polygon_.nodes[k], polygon_.nodes[j]});
      left.emplace_back(i, k);
      left.emplace_back(k, j);
    }
    return true;
  }

  [[nodiscard]] bool is_folded() const { return part(0, count_ - 1).weight.turn > turn_of_folds; }

 private:
  struct Part {
    Weight weight;
    std::size_t tip = 0;
    Vector3 normal = Vector3::Zero();  ///< of the triangle at the edge that closes the part
    bool is_possible = false;
  };
  [[nodiscard]] Part& part(std::size_t i, std::size_t j) { return parts_[i * count_ + j]; }
  [[nodiscard]] const Part& part(std::size_t i, std::size_t j) const { return parts_[i * count_ + j]; }
  [[nodiscard]] const Vector3& place(std::size_t i) const {
    return rim_.places[static_cast<std::size_t>(polygon_.nodes[i])];
  }

  void look_at(std::size_t i, std::size_t j) {
    const bool is_whole = j - i == count_ - 1;
    if (!is_whole && joins(rim_, polygon_.nodes[i], polygon_.nodes[j])) return;
    Part& best = part(i, j);
    for (std::size_t k = i + 1; k < j; ++k) {
      const Part& first = part(i, k);
      const Part& second = part(k, j);
      if (!first.is_possible || !second.is_possible) continue;
      Weight weight = {std::max(first.weight.turn, second.weight.turn), first.weight.area + second.weight.area};
      if (best.is_possible && !(weight < best.weight)) continue;
      const Triangle3 middle = triangle(place(i), place(k), place(j));
      weight.turn = std::max(
          {weight.turn, turn_between(middle.normal, first.normal), turn_between(middle.normal, second.normal)});
      if (is_whole) weight.turn = std::max(weight.turn, turn_between(middle.normal, polygon_.normals.back()));
      weight.area += middle.area;
      if (!best.is_possible || weight < best.weight) best = {weight, k, middle.normal, true};
    }
  }

  const Rim& rim_;
  const Polygon& polygon_;
  std::size_t count_;
  std::vector<Part> parts_;
};

}  // namespace

RimTriangles triangulate(const Rim& rim, std::size_t at_once) {
  RimTriangles result;
  if (rim.places.size() < 3) return result;
  const Polygon polygon = EarCutter(rim).cut(std::max<std::size_t>(at_once, 3), result.triangles);
  // No more ear may be cut.
  const bool is_stuck = polygon.nodes.size() > std::max<std::size_t>(at_once, 3);
  if (is_stuck) return {};
  const BestTriangulation best(rim, polygon);
  if (!best.take(result.triangles)) return {};
  result.is_folded = best.is_folded();
  return result;
}

}  // namespace vspring
