#include "judge/conclude.h"

#include <algorithm>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "judge/profiles.h"

namespace rainref::judge {
namespace {

/// Counts of one or several cases.
struct Counts {
  std::int64_t elements = 0, free = 0, atypical = 0, beyond = 0;
  double unbounded = 0, margin = 0;  ///< of all elements, estimated from the sample; and its margin of error
  std::int64_t failing = 0, expanded = 0, rearranged = 0;
  std::uint64_t rearranged_distance = 0;

  void add(const CaseJudgement& j) {
    for (const OutputJudgement& o : j.outputs) {
      elements += o.elements;
      unbounded += static_cast<double>(o.unbounded) * static_cast<double>(o.unsampled > 0 ? j.stride : 1);
      free += o.free;
      atypical += o.atypical;
      beyond += j.beyond > 0 ? o.beyond : 0;
    }
    margin += j.unbounded_margin;
    failing += j.failing;
    expanded += j.expanded;
    rearranged += j.rearranged;
    rearranged_distance = std::max(rearranged_distance, j.rearranged_distance);
  }
};

/// True if less than half of the elements have a bound, when `more` than estimated have none.
bool lacks_bounds(const Counts& n, double more) {
  const auto judged = static_cast<double>(n.elements - n.free);
  return (n.unbounded + more) * 2 > judged && judged > 0;
}

/// Explains failures from the counts, or returns "".
std::string failure_text(const Counts& n, const enclosed::Profile& profile) {
  if (n.beyond > 0)
    return fmt::format("{} elements that {} leaves without a bound are farther off than the coarsest device that is known or conforms",
                       n.beyond, profile.name);
  // Wide bounds accept some by chance, stale values too: it is the reason of all failures or of none.
  if (n.expanded == 0 || n.expanded < n.failing) return "";
  return fmt::format(
      "only multiplying out a product of two sums would explain the {} invocations outside; no compiler is seen to do that{}", n.failing,
      profile.rearrangement_remedy.empty() ? "" : ", and " + profile.rearrangement_remedy);
}
/// Warnings; empty: none.
std::vector<std::string> warnings(const Counts& n, const enclosed::Profile& profile) {
  std::vector<std::string> out;
  if (n.rearranged > 0)
    out.push_back(fmt::format("{} invocations lie outside the formula as written, by up to {} codes, inside its rearrangements ({}){}",
                              n.rearranged, n.rearranged_distance, name(profile.rearrangement),
                              profile.rearrangement_remedy.empty() ? "" : ": " + profile.rearrangement_remedy));
  if (n.atypical > 0)
    out.push_back(fmt::format("{} elements lie inside the profile {} but outside {}", n.atypical, profile.name, typical_words()));
  return out;
}
std::string joined(const std::vector<std::string>& sentences) { return fmt::format("{}", fmt::join(sentences, "; ")); }

}  // namespace

bool is_open_by_sample(const CaseJudgement& j) {
  Counts n;
  n.add(j);
  return j.failing == 0 && lacks_bounds(n, n.margin) != lacks_bounds(n, -n.margin);
}

void conclude(CaseJudgement& j, const enclosed::Profile& profile) {
  Counts n;
  n.add(j);
  if (j.failing > 0) {
    j.status = Status::fail;
    j.reason = failure_text(n, profile);
  } else if (n.elements == 0 && j.outputs.empty()) {
    j.status = Status::untested;
    j.reason = "nothing to judge";
  } else if (lacks_bounds(n, n.margin)) {
    j.status = Status::untested;
    j.reason = fmt::format("{:.2f} % of the elements have no useful bound, neither from the profile nor from what known devices do{}",
                           std::min(100.0, 100.0 * n.unbounded / static_cast<double>(n.elements - n.free)),
                           n.margin > 0 ? ", by a sample of them" : "");
  } else {
    j.reason = joined(warnings(n, profile));
    j.status = j.reason.empty() ? Status::pass : Status::warn;
  }
}

void conclude(PassJudgement& pass, const enclosed::Profile& profile) {
  const std::string doubt = std::move(pass.reason);  // about the rounding that was found
  pass.status = doubt.empty() ? Status::pass : Status::warn;
  for (const CaseJudgement& c : pass.cases) pass.status = worse(pass.status, c.status);
  Counts n;
  for (const CaseJudgement& c : pass.cases)
    if (c.status == pass.status) n.add(c);
  pass.reason = doubt;
  if (pass.status == Status::warn) {
    std::vector<std::string> all = warnings(n, profile);
    if (!doubt.empty()) all.insert(all.begin(), doubt);
    pass.reason = joined(all);
  } else {
    // The first case with a reason of its own; reasons from counts apply to all.
    const auto own = [&](const CaseJudgement& c) {
      Counts one;
      one.add(c);
      return c.status == pass.status && !c.reason.empty() && (c.status != Status::fail || c.reason != failure_text(one, profile));
    };
    const auto found = std::find_if(pass.cases.begin(), pass.cases.end(), own);
    const std::string counted = pass.status == Status::fail ? failure_text(n, profile) : "";
    if (found != pass.cases.end())
      pass.reason = found->reason;
    else if (!counted.empty())
      pass.reason = counted;
  }
  if (!pass.cases.empty() &&
      std::all_of(pass.cases.begin(), pass.cases.end(), [](const CaseJudgement& c) { return c.status == Status::data; })) {
    pass.status = Status::data;
    pass.reason = pass.cases[0].reason;
  }
  if (pass.cases.empty()) {
    pass.status = Status::untested;
    pass.reason = "there is no run of this pass";
  }
}

void conclude(PortJudgement& j) {
  j.status = Status::pass;
  for (const PassJudgement& p : j.passes) {
    j.status = worse(j.status, p.status);
    if (j.first_bad_pass.empty() && p.status == Status::fail) j.first_bad_pass = p.pass;
  }
  if (std::all_of(j.passes.begin(), j.passes.end(), [](const PassJudgement& p) { return p.status == Status::data; })) {
    j.status = Status::untested;
    j.reason = j.passes.empty() ? "nothing was judged" : "nothing was judged: all is taken as data";
  }
  if (j.status == Status::not_judged) j.status = Status::untested;  // for the port, other passes may have been judged
}

void fail_warnings(PortJudgement& j) {
  bool has_changed = false;
  const auto fail = [&](Status& status, std::string& reason) {
    if (status != Status::warn) return false;
    status = Status::fail;
    reason = "a warning, which is to fail: " + reason;
    return has_changed = true;
  };
  for (PassJudgement& p : j.passes) {
    for (CaseJudgement& c : p.cases)
      if (fail(c.status, c.reason)) c.broken = true;
    if (fail(p.status, p.reason)) continue;
    for (const CaseJudgement& c : p.cases) p.status = worse(p.status, c.status);
  }
  if (has_changed) conclude(j);
}

}  // namespace rainref::judge
