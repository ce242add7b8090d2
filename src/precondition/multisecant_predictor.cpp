#include "precondition/multisecant_predictor.hpp"

#include <utility>

#include "base/dense_algebra.hpp"

namespace vspring {

namespace {

// A drag moves in two dimensions, seldom in three.
constexpr std::size_t depth = 4;
// Damping for steps of unit length: suppresses directions in which they hardly differ.
constexpr double damping = 1e-3;

double product(std::span<const Vector3> a, std::span<const Vector3> b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i].dot(b[i]);
  return sum;
}

}  // namespace

void MultisecantPredictor::remember(std::vector<Vector3> held, std::vector<Eigen::Vector3f> moving) {
  if (steps_.size() == depth) steps_.erase(steps_.begin());
  steps_.push_back({std::move(held), std::move(moving)});
}

void MultisecantPredictor::predict(std::span<Vector3> held, std::span<Vector3> moving) const {
  const auto count = static_cast<Eigen::Index>(steps_.size());
  if (count == 0) return;
  const auto step = [&](Eigen::Index k) -> const Step& { return steps_[static_cast<std::size_t>(k)]; };
  Eigen::MatrixXd gram(count, count);
  Eigen::VectorXd right(count);
  for (Eigen::Index a = 0; a < count; ++a) {
    for (Eigen::Index b = 0; b <= a; ++b) gram(a, b) = gram(b, a) = product(step(a).held, step(b).held);
    right[a] = product(step(a).held, held);
  }
  const Eigen::VectorXd shares = damped_solution(gram, right, damping);
  if (!shares.allFinite()) return;
  for (Eigen::Index k = 0; k < count; ++k) {
    for (std::size_t i = 0; i < held.size(); ++i) held[i] -= shares[k] * step(k).held[i];
    for (std::size_t i = 0; i < moving.size(); ++i) moving[i] += shares[k] * step(k).moving[i].cast<double>();
  }
}

}  // namespace vspring
