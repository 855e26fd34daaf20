// Decisions that an enclosure does not settle. Inside one run each comparison is a plain bool and each floor one
// integer; where the interval leaves it open, the run is made again for each answer, depth first. So masks, texel
// indices and even loops need no set type, and the alternatives stay joint over all outputs of an invocation.
#pragma once

#include <cstdint>
#include <span>

#include "math/profile.h"

namespace rainref::enclosed {

class PathEnumeration;

/// What enclosures of this thread compute under.
struct Context {
  const Profile* profile;
  PathEnumeration* paths;  ///< null outside of PathEnumeration::for_each_alternative
};
inline constinit thread_local Context context{&reference_profile, nullptr};

inline const Profile& profile() { return *context.profile; }

/// Puts a profile in force for this thread, until it ends. The profile must outlive it.
class ProfileScope {
 public:
  explicit ProfileScope(const Profile& p) : before_(context.profile) { context.profile = &p; }
  ~ProfileScope() { context.profile = before_; }
  ProfileScope(const ProfileScope&) = delete;
  ProfileScope& operator=(const ProfileScope&) = delete;

 private:
  const Profile* before_;
};

/// One open decision: which of `count` answers a run took. Of a comparison 0 is false and 1 is true; of a floor k is
/// the k-th candidate from below.
struct Decision {
  std::uint8_t chosen, count;
};

class PathEnumeration {
 public:
  /// More alternatives than this are too many: the invocation is vacuous.
  static constexpr int max_runs = 4;

  /// Calls run() once for each combination of answers to the open decisions it meets. run must meet the same decisions
  /// when it is given the same answers. False when there are more than max_runs combinations: what the calls gave is
  /// then to be thrown away, and the invocation is vacuous. Calls may be nested; each has its own decisions.
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
  /// Runs made by the last for_each_alternative: its alternatives when it gave true.
  int runs() const { return runs_; }
  /// Inside run(): the open decisions met so far and how this run answers them, in order. Empty: everything was
  /// settled.
  std::span<const Decision> decisions() const { return {decisions_, static_cast<std::size_t>(depth_)}; }

  /// The answer to an open decision of `count` >= 2 answers, in [0, count).
  int choose(int count) {
    // A path of max_runs open decisions already has more leaves than max_runs.
    if (depth_ == max_runs || count > max_runs) {
      overflow_ = true;
      return 0;
    }
    if (depth_ == known_) decisions_[known_++] = {0, static_cast<std::uint8_t>(count)};
    return decisions_[depth_++].chosen;
  }
  /// Declares the invocation vacuous: too many alternatives for a number that the run cannot do without.
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

/// The answer to an open decision, from the enumeration in force. Throws Error(internal) where there is none.
int choose(int count);
/// Declares the invocation vacuous; throws like choose.
void give_up();

}  // namespace rainref::enclosed
