#include "precondition/anderson.hpp"

#include <algorithm>

#include "base/dense_algebra.hpp"

namespace vspring {

namespace {

// Sums are taken over ranges, and then over the ranges in order, so they do not depend on the number of threads.
constexpr std::size_t vectors_per_task = 8192;

}  // namespace

template <typename Scalar>
void Anderson<Scalar>::accelerate(std::vector<Vector3>& correction) {
  const bool remembers = !last_step_.empty();
  if (remembers) used_ = std::min(used_ + 1, depth_);
  if (corrections_.size() < used_) {
    corrections_.emplace_back(size_);
    steps_.emplace_back(size_);
  }
  const auto columns = static_cast<Eigen::Index>(used_);
  const std::size_t newest = next_;

  // The products of all columns with each other and with the correction; also makes the newest column.
  last_correction_.resize(size_);
  const Eigen::MatrixXd nothing = Eigen::MatrixXd::Zero(columns, columns + 1);
  const auto multiply = [&](std::size_t begin, std::size_t end, Eigen::MatrixXd& part) {
    if (remembers) {
      for (std::size_t i = begin; i < end; ++i) {
        corrections_[newest][i] = (correction[i] - last_correction_[i].template cast<double>()).template cast<Scalar>();
        steps_[newest][i] = last_step_[i];
      }
    }
    for (std::size_t i = begin; i < end; ++i) last_correction_[i] = correction[i].template cast<Scalar>();
    for (Eigen::Index a = 0; a < columns; ++a) {
      const auto& column_a = corrections_[static_cast<std::size_t>(a)];
      const auto with_a = [&](const auto& other) {
        double sum = 0;
        for (std::size_t i = begin; i < end; ++i)
          sum += column_a[i].template cast<double>().dot(other[i].template cast<double>());
        return sum;
      };
      for (Eigen::Index b = 0; b <= a; ++b) part(a, b) = with_a(corrections_[static_cast<std::size_t>(b)]);
      part(a, columns) = with_a(correction);
    }
  };
  const std::vector<Eigen::MatrixXd> parts = parallel_parts(*team_, size_, vectors_per_task, nothing, multiply);
  if (remembers) next_ = (next_ + 1) % depth_;
  if (columns > 0) {
    Eigen::MatrixXd products = nothing;
    for (const Eigen::MatrixXd& part : parts) products += part;
    const Eigen::MatrixXd gram = products.leftCols(columns).selfadjointView<Eigen::Lower>();
    const Eigen::VectorXd shares = damped_solution(gram, products.col(columns), 1e-12);
    if (shares.allFinite()) {
      parallel_ranges(*team_, size_, vectors_per_task, [&](std::size_t begin, std::size_t end) {
        for (std::size_t a = 0; a < used_; ++a) {
          const double share = shares[static_cast<Eigen::Index>(a)];
          for (std::size_t i = begin; i < end; ++i)
            correction[i] -= share * (corrections_[a][i] + steps_[a][i]).template cast<double>();
        }
      });
    }
  }
  last_step_.resize(size_);
  parallel_ranges(*team_, size_, vectors_per_task, [&](std::size_t begin, std::size_t end) {
    for (std::size_t i = begin; i < end; ++i) last_step_[i] = correction[i].template cast<Scalar>();
  });
}

template class Anderson<float>;
template class Anderson<double>;

}  // namespace vspring
