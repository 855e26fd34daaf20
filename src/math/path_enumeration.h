// Decisions that an enclosure leaves open. Inside one run each comparison is a plain bool and each floor one integer. If the interval
// leaves it open, the run is repeated for each answer, depth first. So masks, texel indices and loops need no set type, and the
// alternatives are consistent over all outputs of an invocation.
#pragma once

#include <cstdint>
#include <span>

#include "math/profile.h"

namespace rainref::enclosed {

class PathEnumeration;

/// The settings of this thread's enclosures.
struct Context {
  const Profile* profile;
  PathEnumeration* paths;  ///< null outside PathEnumeration::for_each_alternative
};
inline constinit thread_local Context context{&reference_profile, nullptr};

inline const Profile& profile() { return *context.profile; }

/// Sets a profile for this thread during a scope. The profile must outlive it.
class ProfileScope {
 public:
  explicit ProfileScope(const Profile& p) : before_(context.profile) { context.profile = &p; }
  ~ProfileScope() { context.profile = before_; }
  ProfileScope(const ProfileScope&) = delete;
  ProfileScope& operator=(const ProfileScope&) = delete;

 private:
  const Profile* before_;
};

/// An open decision, and which of `count` answers a run took. For a comparison 0 is false and 1 is true; for a floor k is the k-th
/// candidate from below.
struct Decision {
  std::uint8_t chosen, count;
};

class PathEnumeration {
 public:
  /// With more alternatives than this the invocation is vacuous.
  static constexpr int max_runs = 4;

  /// Calls run() once for each combination of answers to its open decisions. run must meet the same decisions if it gets the same answers.
  /// Returns false if there are more than max_runs combinations; the results are then to be discarded, and the invocation is vacuous. Calls
  /// may be nested; each has its own decisions.
  template <class Run>
  bool for_each_alternative(Run run) {
    const Scope scope(this);
    known_ = runs_ = 0;
    overflow_ = false;
    do {
      depth_ = 0;
      run();
      ++runs_;
      while (known_ > 0 && decisions_[known_ - 1].chosen + 1 == decisions_[known_ - 1].count) --known_;
      if (known_ > 0) ++decisions_[known_ - 1].chosen;
    } while (known_ > 0 && runs_ < max_runs && !overflow_);
    return known_ == 0 && !overflow_;
  }
  /// Number of runs of the last for_each_alternative; if that returned true, its number of alternatives.
  int runs() const { return runs_; }
  /// Inside run(): the open decisions so far with this run's answers, in order. Empty: nothing was open.
  std::span<const Decision> decisions() const { return {decisions_, static_cast<std::size_t>(depth_)}; }

  /// Returns the answer to an open decision with `count` >= 2 answers, in [0, count).
  int choose(int count) {
    // A path with max_runs open decisions already has more than max_runs leaves.
    if (depth_ == max_runs || count > max_runs) {
      overflow_ = true;
      return 0;
    }
    if (depth_ == known_) decisions_[known_++] = {0, static_cast<std::uint8_t>(count)};
    return decisions_[depth_++].chosen;
  }
  /// Declares the invocation vacuous, because a number that the run needs has too many alternatives.
  void give_up() { overflow_ = true; }

 private:
  struct Scope {
    explicit Scope(PathEnumeration* paths) : before(context.paths) { context.paths = paths; }
    ~Scope() { context.paths = before; }
    PathEnumeration* before;
  };

  Decision decisions_[max_runs];
  int depth_ = 0, known_ = 0, runs_ = 0;
  bool overflow_ = false;
};

/// Returns the answer to an open decision from the current enumeration. Throws Error(internal) if there is none.
int choose(int count);
/// Declares the invocation vacuous; throws as choose does.
void give_up();

}  // namespace rainref::enclosed
