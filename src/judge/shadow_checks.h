// Checks the inputs of a port's run. They must be the outputs of the runs before it, and the uniforms must be those of this run.
#pragma once

#include <functional>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "capture/pass_model.h"
#include "judge/shadow_plan.h"

namespace rainref::judge {

/// Hashes of all buffers that a port dumped: "puddle.shade/0001.0/in.hit".
class DumpedContents {
 public:
  void add(const std::string& buffer, std::string hash) { hashes_[buffer] = std::move(hash); }
  /// Hash of a buffer; "" if it was not dumped.
  const std::string& hash(const std::string& buffer) const;
  /// Buffers with this content, sorted by name.
  std::vector<std::string> with(const std::string& hash) const;

 private:
  std::map<std::string, std::string> hashes_;
};

/// Explains why an input is not the output that it should be, and names the dumped buffer that it equals, if any. `input` and `output` have
/// different contents; `read` returns a buffer's values.
std::string broken_link(const std::string& input, const std::string& output, const DumpedContents& contents,
                        const std::function<capture::Array(const std::string&)>& read);

/// Collects sentences of many runs: one for each subject, with a count and the first example.
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

/// Differences of the host's inputs and uniforms from the scene that are not failures.
struct HostNotes {
  Tally rounded;   ///< within float rounding (host_values.h)
  Tally foreign;   ///< allowed: the host chose otherwise
  Tally of_state;  ///< depends on the port's own state and is not checked
};
/// How a host is compared with the plan.
struct HostRules {
  bool is_foreign = false;                                ///< its other choices are notes
  const capture::PassEvaluations* evaluations = nullptr;  ///< of the pass; null: none

  bool hangs_on_state(std::string_view name) const;
};

/// Explains why the uniforms of a run with inputs `taken` cannot be its own, or returns "": another time, another run's counter, or, unless
/// the host is foreign, a number that differs from the plan.
std::string check_uniforms(const ShadowPlan& plan, const PlannedRun& run, const capture::PassCase& taken, const HostRules& rules,
                           HostNotes& notes);
/// Explains why an input of the run cannot be the host's, or returns "". `hash`: content_hash() of `given`.
std::string check_given(const ShadowPlan& plan, const PlannedRun& run, std::size_t input, const capture::Array& given,
                        const std::string& hash, const HostRules& rules, HostNotes& notes);

}  // namespace rainref::judge
