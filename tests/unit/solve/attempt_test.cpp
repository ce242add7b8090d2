#include "solve/attempt.hpp"

#include <gtest/gtest.h>

#include <string>
#include <utility>
#include <vector>

namespace vspring::attempt_test {
namespace {

Attempt ended(Outcome outcome, double bending, std::string fault = {}) {
  Attempt attempt;
  attempt.outcome = outcome;
  attempt.bent.bending = bending;
  attempt.fault = std::move(fault);
  return attempt;
}

/// The only warning.
WarningCode said(const FairReport& report) {
  EXPECT_EQ(report.warnings.size(), 1U);
  return report.warnings.back().code;
}

TEST(Attempt, TheLastIsTakenWhereItIsAnEquilibriumThatIsNoWorse) {
  Attempt found = ended(Outcome::converged, 5);
  found.springs = Springs::edge;
  const std::vector<Attempt> attempts = {ended(Outcome::stalled, 1), found};
  FairReport report;
  EXPECT_EQ(pick(attempts, {.bent = {.bending = 2}}, {}, report), &attempts.back());
  EXPECT_EQ(report.outcome, Outcome::converged);
  EXPECT_EQ(report.springs, Springs::edge);
  EXPECT_EQ(said(report), WarningCode::other_springs);
}

TEST(Attempt, WhereNoneIsAnEquilibriumTheOneThatIsBentLeastIsTaken) {
  const std::vector<Attempt> attempts = {ended(Outcome::stalled, 3), ended(Outcome::work_limit, 2),
                                         ended(Outcome::converged, 1, "worse"), ended(Outcome::stalled, 4)};
  FairReport report;
  EXPECT_EQ(pick(attempts, {.bent = {.bending = 5}}, {}, report), &attempts[1]);
  EXPECT_EQ(report.outcome, Outcome::work_limit);
  EXPECT_EQ(said(report), WarningCode::no_equilibrium);
}

TEST(Attempt, FewerFoldsAreLessBending) {
  // What is folded flat is not bent.
  std::vector<Attempt> attempts = {ended(Outcome::stalled, 3), ended(Outcome::stalled, 0)};
  attempts.back().bent.turned = 2;
  FairReport report;
  EXPECT_EQ(pick(attempts, {.bent = {.turned = 4, .bending = 9}}, {}, report), attempts.data());
}

TEST(Attempt, AStartThatIsBentLessThanAllThatIsNoWorseStays) {
  const std::vector<Attempt> attempts = {ended(Outcome::stalled, 3), ended(Outcome::converged, 1, "it is folded")};
  FairReport report;
  EXPECT_EQ(pick(attempts, {.bent = {.bending = 2}}, {}, report), nullptr);
  EXPECT_EQ(report.outcome, Outcome::worse_than_input);
  EXPECT_EQ(said(report), WarningCode::worse_than_input);
  EXPECT_NE(report.warnings.back().text.find("it is folded"), std::string::npos);
  // Where it has folds itself it does not.
  FairReport of_folds;
  EXPECT_EQ(pick(attempts, {.is_sound = false, .bent = {.bending = 2}}, {}, of_folds), attempts.data());
}

TEST(Attempt, WhatIsWantedAsFoundIsTheLast) {
  const std::vector<Attempt> attempts = {ended(Outcome::converged, 1, "worse")};
  FairReport report;
  EXPECT_EQ(pick(attempts, {}, {.accept_worse = true}, report), attempts.data());
  EXPECT_EQ(report.outcome, Outcome::worse_than_input);
}

TEST(Attempt, ACancelledOneSaysSo) {
  const std::vector<Attempt> attempts = {ended(Outcome::stalled, 1), ended(Outcome::cancelled, 0)};
  FairReport report;
  EXPECT_EQ(pick(attempts, {.bent = {.bending = 2}}, {}, report), &attempts.back());
  EXPECT_EQ(report.outcome, Outcome::cancelled);
  EXPECT_TRUE(report.warnings.empty());
}

}  // namespace
}  // namespace vspring::attempt_test
