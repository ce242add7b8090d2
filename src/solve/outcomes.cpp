#include "solve/outcomes.hpp"

namespace vspring {

namespace {

/// A rank of outcomes, from good to bad.
int rank(Outcome outcome) {
  switch (outcome) {
    case Outcome::converged:
      return 0;
    case Outcome::iteration_limit:
      return 1;
    case Outcome::work_limit:
      return 2;
    case Outcome::stalled:
      return 3;
    case Outcome::worse_than_input:
      return 4;
    case Outcome::cancelled:
      return 5;
  }
  return 0;
}

}  // namespace

void worsen(Outcome& outcome, Outcome other) {
  if (rank(other) > rank(outcome)) outcome = other;
}

}  // namespace vspring
