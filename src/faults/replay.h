// A failing run in which mistakes are made, to see which gives what the port stored.
#pragma once

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
  /// With its words.
  Tried(What made, judge::Cause figures, double how_far = 0);
  What what;                           ///< by which it is ranked
  double misfit = 0;                   ///< of what the port is off from the reference, the share that is left with the mistake: 0 to 1
  bool is_untested = false;            ///< another run could not be asked about it
  std::int64_t bad = 0;                ///< texels that passed and that the mistake moves away from where the port is
  const Fault* fault = nullptr;        ///< the mistake itself, as long as who asked for it keeps it
  const Fault* other_fault = nullptr;  ///< the same of another run
};

/// Places that a mistake leaves unexplained, and those that passed and would not have with it.
inline double against(const Tried& c) { return static_cast<double>(c.of - c.inside + c.bad); }

class Replay {
 public:
  virtual ~Replay() = default;
  /// What is tried, in the order in which it is to be believed; at most once each.
  virtual std::vector<Fault> plain() = 0;
  /// More of it, asked where nothing plain explains the run.
  virtual std::vector<Fault> deeper() { return {}; }
  /// What is found by solving for what the port stored, asked where that explains too little.
  virtual std::vector<Fault> solved() { return {}; }
  /// What is fitted to the port, asked where all that explains too little. After these.
  virtual std::vector<Fault> fitted() = 0;
  /// From now on what is tried meets records too that count nowhere near what fails: a mistake may make them count. False: it did
  /// already, or there are none.
  virtual bool widen() { return false; }
  /// How well each explains what fails.
  virtual std::vector<Tried> causes(const std::vector<Fault>& all) const = 0;

  /// The pass on a case of other numbers: what gives the same bits here may differ there. Null: there is none.
  virtual std::unique_ptr<Replay> elsewhere() const = 0;
  /// What the pass gives with a mistake, at some places; empty where it cannot be made. Of a fault without a name: without one.
  virtual std::vector<float> given(const Fault& d) const = 0;

  /// Adds some invocations in which a mistake gives the port's bits, followed in the port's shader too; none where there is no shader.
  virtual void follow(const Fault&, std::vector<Followed>&) const {}
  /// A line of that shader; nothing where it does not say its lines.
  virtual std::optional<judge::ShaderLine> line(const FoundLine&) const { return {}; }

  /// From now on causes() tries nothing more once the time is over. The limit must outlive the replay.
  void limit(const SearchLimit& to) { limit_ = &to; }
  bool is_time_over() const { return limit_ && limit_->is_over(); }

 private:
  const SearchLimit* limit_ = nullptr;
};

/// Whether it was found by solving.
inline bool is_solved(const Tried& c) { return c.what.is(trait::solved); }
/// Whether it is a number fitted to what the port stored.
inline bool is_fitted(const Tried& c) { return c.what.is(trait::fitted); }

/// A replay of a case that nobody else holds, from R(of, case, model).
template <class R>
class OwnReplay : public R {
 public:
  OwnReplay(const R& of, std::unique_ptr<capture::PassCase> c, std::unique_ptr<capture::PassModel> model)
      : R(of, *c, *model), c_(std::move(c)), model_(std::move(model)) {}

 private:
  std::unique_ptr<capture::PassCase> c_;
  std::unique_ptr<capture::PassModel> model_;
};

/// A mistake that explains nothing of so many failing elements.
Tried untried(const Fault& d, std::size_t of, bool of_records, double misfit = 0);
/// try_one(fault) of each, in parallel. A mistake in what the pass is given may make it none that the pass can run: then it explains
/// nothing of `of`; and so does what `replay` has no time for.
std::vector<Tried> tried(const Replay& replay, const parallel::Executor& executor, const std::vector<Fault>& all, std::size_t of,
                         bool of_records, const std::function<Tried(const Fault&)>& try_one);

/// Of a pass without one.
inline const capture::PassModel& no_model() {
  static const capture::ListPass none("", nullptr);
  return none;
}

/// Adds where the best cause, and those of `causes` that give the same (`alike`: their names), stand in the port's shader. What leaves most
/// of the failures unexplained, or is not what the shader itself gives, says nothing of its lines.
void add_lines(const Replay& run, const Replay* other, Tried& best, const std::vector<Tried>& causes, const std::set<std::string>& alike);

/// What explains a run, best first. `other`: another failing run of the pass, or null: what explains both is believed. A cause is
/// likely where no rival, which would be another mistake elsewhere, explains as much; none is when the time was over before all were tried.
/// `is_plain`: what is plain is tried alone.
std::vector<judge::Cause> diagnosed(Replay& run, Replay* other, bool is_plain = false);

/// A case whose uniforms, texels and records are others, within a quarter or so.
capture::PassCase varied(const capture::PackPass& pass, const capture::PassCase& c);

}  // namespace rainref::faults
