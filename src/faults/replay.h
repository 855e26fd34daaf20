// Repeats a failing run with mistakes, to find those that reproduce what the port stored.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "faults/fault.h"
#include "faults/search_limit.h"
#include "faults/shader_line.h"
#include "rainref/executor.h"

namespace rainref::faults {

/// A mistake that was tried on a run.
struct Tried : judge::Cause {
  Tried() = default;
  /// Also makes the texts of `made`.
  Tried(What made, judge::Cause figures, double how_far = 0);
  What what;                           ///< used for ranking
  double misfit = 0;                   ///< share of the port's difference from the reference that remains with the mistake: 0 to 1
  bool is_untested = false;            ///< another run could not be tested
  std::int64_t bad = 0;                ///< texels that passed and that the mistake moves away from the port's values
  const Fault* fault = nullptr;        ///< the mistake itself; owned by the caller's list of faults
  const Fault* other_fault = nullptr;  ///< the same mistake on another run
};

/// Number of places that speak against a mistake: failing ones that it does not explain, and passing ones that it would break.
inline double against(const Tried& c) { return static_cast<double>(c.of - c.inside + c.bad); }

/// The share of the failures that it explains, with equal weight for bits and nearness: 0 to 2.
inline double score(const judge::Cause& c) {
  return static_cast<double>(c.explained + c.inside) / static_cast<double>(std::max<std::int64_t>(c.of, 1));
}

class Replay {
 public:
  virtual ~Replay() = default;
  /// Mistakes to try, in order of plausibility, each at most once.
  virtual std::vector<Fault> plain() = 0;
  /// More mistakes, tried if no plain one explains the run.
  virtual std::vector<Fault> deeper() { return {}; }
  /// Mistakes found by solving for what the port stored, tried if the others explain too little.
  virtual std::vector<Fault> solved() { return {}; }
  /// Mistakes fitted to the port, tried last, if all others explain too little.
  virtual std::vector<Fault> fitted() = 0;
  /// From now on mistakes are also tried with records that do not contribute near the failures: a mistake may make them contribute. Returns
  /// false if this was already so, or if there are none.
  virtual bool widen() { return false; }
  /// Measures how well each fault explains the failures.
  virtual std::vector<Tried> causes(const std::vector<Fault>& all) const = 0;

  /// The pass on a case with other numbers: faults with equal bits here may differ there. Null: there is none.
  virtual std::unique_ptr<Replay> elsewhere() const = 0;
  /// Values of the pass with a mistake, at some places; empty if the mistake is impossible. A fault without a name: values without a
  /// mistake.
  virtual std::vector<float> given(const Fault& d) const = 0;

  /// Appends some invocations in which a mistake reproduces the port's bits, traced in the port's shader too; none if there is no shader.
  virtual void follow(const Fault&, std::vector<Followed>&) const {}
  /// Appends invocations of the port's shader without any mistake: some where it gives wrong values, and some that passed.
  virtual void follow_right(std::vector<Followed>& /*failing*/, std::vector<Followed>& /*passing*/) const {}
  /// A line of that shader; nothing if it has no line information.
  std::optional<judge::ShaderLine> line(const FoundLine& found) const;

  /// From now on causes() stops when the time is over. The limit must outlive the replay.
  void limit(const SearchLimit& to) { limit_ = &to; }
  bool is_time_over() const { return limit_ && limit_->is_over(); }

 protected:
  const capture::ProgramSource* source_ = nullptr;  ///< of the port's shader; null: there is none

 private:
  const SearchLimit* limit_ = nullptr;
};

/// True if it was found by solving.
inline bool is_solved(const Tried& c) { return c.what.is(trait::solved); }
/// True if it is a number fitted to what the port stored.
inline bool is_fitted(const Tried& c) { return c.what.is(trait::fitted); }

/// Makes a replay R(of, case, model) that owns its case.
template <class R>
class OwnReplay : public R {
 public:
  OwnReplay(const R& of, std::unique_ptr<capture::PassCase> c, std::unique_ptr<capture::PassModel> model)
      : R(of, *c, *model), c_(std::move(c)), model_(std::move(model)) {}

 private:
  std::unique_ptr<capture::PassCase> c_;
  std::unique_ptr<capture::PassModel> model_;
};

/// A mistake that explains none of `of` failing elements.
Tried untried(const Fault& d, std::size_t of, bool of_records, double misfit = 0);
/// Calls try_one(fault) for each fault, in parallel. A fault counts as explaining none of `of` if the altered input makes the pass
/// impossible to run, or if `replay` has no time left.
std::vector<Tried> tried(const Replay& replay, const parallel::Executor& executor, const std::vector<Fault>& all, std::size_t of,
                         bool of_records, const std::function<Tried(const Fault&)>& try_one);

/// The model of a pass that has none.
inline const capture::PassModel& no_model() {
  static const capture::ListPass none("", nullptr);
  return none;
}

/// Adds lines of the port's shader to the first of the best causes: its own and those of causes that give the same bits (`alike`: their
/// names). If it is not likely, further places follow: those of the other best causes, the function or its call, and where the port departs
/// from the reference. At most three in all.
void add_lines(const Replay& run, const Replay* other, std::vector<Tried>& best, const std::vector<Tried>& causes,
               const std::set<std::string>& alike);

/// The cause of a run for which none was found: lines of the port's shader where it departs from the reference. Nothing if there are none.
std::optional<judge::Cause> unknown_cause(const Replay& run, bool of_records);

/// The case with other uniforms, texels and records, changed by about a quarter.
capture::PassCase varied(const capture::PackPass& pass, const capture::PassCase& c);

}  // namespace rainref::faults
