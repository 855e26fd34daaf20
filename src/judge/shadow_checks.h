// Whether what a port's run took is what it should have taken: its inputs the outputs of the runs before it, its
// uniforms this run's.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "capture/pass_model.h"
#include "judge/shadow_plan.h"

namespace rainref::judge {

/// Every buffer that a port dumped, by hash: "puddle.shade/0001.0/in.hit".
class DumpedContents {
 public:
  void add(const std::string& buffer, std::string hash) { hashes_[buffer] = std::move(hash); }
  /// "" for a buffer that was not dumped.
  const std::string& hash(const std::string& buffer) const;
  /// Buffers of this content, in the order of their names.
  std::vector<std::string> with(const std::string& hash) const;

 private:
  std::map<std::string, std::string> hashes_;
};

/// Why an input is not the output that it should be, and what it is instead, if it is anything that was dumped.
/// `input` and `output` are buffers of unlike content; `read` gives a buffer's values.
std::string broken_link(const std::string& input, const std::string& output, const DumpedContents& contents,
                        const std::function<capture::Array(const std::string&)>& read);

/// Sentences about many runs: one for each subject, with a count and the first example.
class Tally {
 public:
  void add(const std::string& subject, const std::string& example);
  /// "uniform exposure of display is not the scene's, 3 times, first puddle.display/0000.0: ..."
  std::vector<std::string> lines() const;

 private:
  struct Entry {
    std::string subject, first;
    int count = 0;
  };
  std::vector<Entry> entries_;
};

/// What of the host's inputs and uniforms is not the scene's, and no failure.
struct HostNotes {
  Tally rounded;   ///< as near as a host in float comes (host_values.h)
  Tally foreign;   ///< forgiven: the host chose otherwise
  Tally of_state;  ///< what hangs on the port's own state and nobody checks
};
/// How a host is held to the plan.
struct HostRules {
  bool is_foreign = false;                                ///< what it chose otherwise is noted
  const capture::PassEvaluations* evaluations = nullptr;  ///< of the pass; null: none

  bool hangs_on_state(std::string_view name) const;
};

/// Why the uniforms of a run, which took `taken`, cannot be its own, or "": another time, a counter of another run, or, of a host that is
/// not foreign, a number that the plan does not say.
std::string check_uniforms(const ShadowPlan& plan, const PlannedRun& run, const capture::PassCase& taken, const HostRules& rules,
                           HostNotes& notes);
/// Why an input of the run cannot be what the host gives, or "". `hash`: content_hash() of `given`.
std::string check_given(const ShadowPlan& plan, const PlannedRun& run, std::size_t input, const capture::Array& given,
                        const std::string& hash, const HostRules& rules, HostNotes& notes);

}  // namespace rainref::judge
