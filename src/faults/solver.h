// Solves for the numbers at some places of a pass text that would give what a port stored.
#pragma once

#include <functional>
#include <vector>

#include "faults/probe.h"
#include "rainref/executor.h"

namespace rainref::faults {

/// A failing texel or record: what a port stored there, one number for each slot, and its tolerance.
struct Solvable {
  const Probe& probe;
  std::vector<float> port;
  std::vector<double> leeway;
  std::function<std::vector<float>()> evaluate;  ///< slots under the active behaviour; if their count differs: impossible
};

/// Threads for a search, and its time limit.
struct Workers {
  const parallel::Executor& executor;
  std::function<bool()> is_time_over;  ///< thread-safe
};

/// Replacement numbers that give what the port stored, and the derivatives of the slots.
struct Solution {
  std::vector<double> at;                  ///< one for each place
  std::vector<float> values;               ///< one for each slot
  std::vector<std::vector<double>> slope;  ///< derivative of each slot by each place
};

/// Bisects: returns a value between two where off(value) changes sign; `at_low` is the sign at the lower one.
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
  /// The arguments must outlive it.
  Solver(const Solvable& of, const std::vector<float>& known) : of_(of), known_(known) {}

  std::vector<float> values(const std::vector<perturbed::Substitution>& places) const;
  bool is_near(const std::vector<float>& values) const;
  bool is_near(const std::vector<perturbed::Substitution>& places) const { return is_near(values(places)); }

  /// Returns other numbers for one place, or for the two or three of a vector, that give what the port stored; `now` are the present ones.
  /// Empty if these places affect nothing that differs.
  std::vector<Solution> solutions(std::vector<perturbed::Substitution> places, const std::vector<float>& now) const;
  /// True if these numbers are near a solution, to first order.
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
