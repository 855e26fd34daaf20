// What the numbers at some places of a pass text would have to be for what a port stored.
#pragma once

#include <functional>
#include <vector>

#include "faults/probe.h"

namespace rainref::faults {

/// A failing texel or record: what a port stored there, one number for each slot, and how far off that a number may be.
struct Solvable {
  const Probe& probe;
  std::vector<float> port;
  std::vector<double> leeway;
  std::function<std::vector<float>()> evaluate;  ///< what the slots hold under the behaviour in force; others than port's: it cannot be
};

/// Numbers in the place of others that give what the port stored, and how the slots change with them.
struct Solution {
  std::vector<double> at;                  ///< of each place
  std::vector<float> values;               ///< of each slot
  std::vector<std::vector<double>> slope;  ///< of each slot by each place
};

/// A value between two at which off(value) changes its sign, which is that of `at_low` at the lower one.
template <class Off>
float bisected(float low, float high, double at_low, int rounds, const Off& off) {
  for (int round = 0; round < rounds; ++round) {
    const float middle = low + (high - low) / 2;
    const double at = off(middle);
    if ((at < 0) == (at_low < 0))
      low = middle, at_low = at;
    else
      high = middle;
  }
  return low + (high - low) / 2;
}

class Solver {
 public:
  /// What is given must outlive it.
  Solver(const Solvable& of, const std::vector<float>& known) : of_(of), known_(known) {}

  std::vector<float> values(const std::vector<perturbed::Substitution>& places) const;
  bool is_near(const std::vector<float>& values) const;
  bool is_near(const std::vector<perturbed::Substitution>& places) const { return is_near(values(places)); }

  /// Of one place or of the two or three of a vector, whose numbers are `now`: other numbers that give what the port stored; none
  /// where these places decide nothing that differs.
  std::vector<Solution> solutions(std::vector<perturbed::Substitution> places, const std::vector<float>& now) const;
  /// Whether these numbers are near a solution, as far as its slope tells.
  bool may_be(const Solution& s, const std::vector<float>& numbers) const;

 private:
  std::vector<Solution> of_one(std::vector<perturbed::Substitution> places, float now, const std::vector<float>& right) const;
  std::vector<Solution> of_vector(std::vector<perturbed::Substitution> places, const std::vector<float>& now) const;
  Solution with_slope(std::vector<perturbed::Substitution>& places, const std::vector<double>& at) const;
  double misfit(const std::vector<float>& values) const;

  const Solvable& of_;
  const std::vector<float>& known_;
};

}  // namespace rainref::faults
