#include "precondition/anderson.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/random.hpp"

namespace vspring::anderson_test {
namespace {

using State = std::vector<Vector3>;

double size_of(const State& state) {
  double sum = 0;
  for (const Vector3& v : state) sum += v.squaredNorm();
  return std::sqrt(sum);
}

/// c(x) = −D x, with as many different values in D as there are rates, some of which would diverge.
State correction_at(const State& x, const std::vector<double>& rates) {
  State c(x.size());
  for (std::size_t i = 0; i < x.size(); ++i) c[i] = -rates[i % rates.size()] * x[i];
  return c;
}

State random_state(std::size_t size) {
  Random random(2);
  State x(size);
  for (Vector3& v : x) v = random.in_ball();
  return x;
}

template <typename Scalar>
void step(State& x, Anderson<Scalar>& anderson, const std::vector<double>& rates) {
  State c = correction_at(x, rates);
  anderson.accelerate(c);
  for (std::size_t i = 0; i < x.size(); ++i) x[i] += c[i];
}

TEST(Anderson, TheFirstStepIsTheCorrectionItself) {
  ThreadTeam alone(1);
  State x = random_state(20);
  Anderson<double> anderson(6, x.size(), alone);
  const State c = correction_at(x, {0.3});
  State taken = c;
  anderson.accelerate(taken);
  EXPECT_EQ(taken, c);
}

/// What is left after as many steps as there are rates, and one, as a share.
template <typename Scalar>
double left_over(const std::vector<double>& rates) {
  ThreadTeam alone(1);
  State x = random_state(60);
  const double before = size_of(x);
  Anderson<Scalar> anderson(6, x.size(), alone);
  for (std::size_t k = 0; k < rates.size(); ++k) step(x, anderson, rates);
  EXPECT_GT(size_of(correction_at(x, rates)), 0);
  step(x, anderson, rates);
  return size_of(x) / before;
}

TEST(Anderson, SolvesLinearEquationsInAsManyStepsAsTheyHaveRates) {
  for (const auto& rates : {std::vector<double>{0.5}, {0.5, 1.5}, {0.1, 0.9, 2.5}, {0.2, 0.6, 1.3, 3.0}}) {
    EXPECT_LT(left_over<double>(rates), 1e-6) << rates.size();
    EXPECT_LT(left_over<float>(rates), 1e-4) << rates.size();
  }
}

TEST(Anderson, MoreRatesThanItsDepthStillConverge) {
  ThreadTeam alone(1);
  std::vector<double> rates;
  for (int k = 1; k <= 20; ++k) rates.push_back(0.1 * k - 0.02);
  State x = random_state(60);
  const double before = size_of(x);
  Anderson<double> anderson(3, x.size(), alone);
  for (int k = 0; k < 80; ++k) step(x, anderson, rates);
  // Without acceleration 0.98⁸⁰ = 0.2 of the part with the largest rate would be left.
  EXPECT_LT(size_of(x), 1e-6 * before);
}

TEST(Anderson, ForgetsWhatItIsToldToForget) {
  ThreadTeam alone(1);
  State x = random_state(30);
  Anderson<double> used(6, x.size(), alone);
  for (int k = 0; k < 4; ++k) step(x, used, {0.3, 1.2, 0.7});
  used.forget();
  Anderson<double> fresh(6, x.size(), alone);
  State y = x;
  for (int k = 0; k < 3; ++k) {
    step(x, used, {0.3, 1.2, 0.7});
    step(y, fresh, {0.3, 1.2, 0.7});
    EXPECT_EQ(x, y);
  }
}

TEST(Anderson, CorrectionsThatDoNotChangeDoNoHarm) {
  ThreadTeam alone(1);
  Anderson<double> anderson(6, 10, alone);
  for (int k = 0; k < 5; ++k) {
    State c(10, Vector3(1, 0, 0));
    anderson.accelerate(c);
    for (const Vector3& v : c) EXPECT_TRUE(v.allFinite());
  }
  State none(10, Vector3::Zero());
  anderson.accelerate(none);
  for (const Vector3& v : none) EXPECT_TRUE(v.allFinite());
}

TEST(Anderson, TeamsOfAnySizeGiveTheSameBits) {
  const std::vector<double> rates = {0.1, 0.4, 0.8, 1.1, 1.7};
  std::vector<State> results;
  for (const int threads : {1, 2, 5}) {
    ThreadTeam team(threads);
    State x = random_state(30000);
    Anderson<double> anderson(4, x.size(), team);
    for (int k = 0; k < 4; ++k) step(x, anderson, rates);
    results.push_back(x);
  }
  EXPECT_EQ(results[0], results[1]);
  EXPECT_EQ(results[0], results[2]);
}

}  // namespace
}  // namespace vspring::anderson_test
