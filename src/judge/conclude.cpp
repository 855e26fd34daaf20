#include "judge/conclude.h"

#include <algorithm>

#include <fmt/format.h>

namespace rainref::judge {

void conclude(CaseJudgement& j, const enclosed::Profile& profile) {
  std::int64_t elements = 0, unbounded = 0, free = 0, atypical = 0;
  for (const OutputJudgement& o : j.outputs) {
    elements += o.elements;
    unbounded += o.unbounded;
    free += o.free;
    atypical += o.atypical;
  }
  if (j.failing > 0) {
    j.status = Status::fail;
    if (j.expanded > 0)
      j.reason = fmt::format(
          "for {} of {} invocations only multiplying out a product of two sums would explain it; no compiler is seen "
          "to do that{}",
          j.expanded, j.failing, profile.rearrangement_remedy.empty() ? "" : ", and " + profile.rearrangement_remedy);
  } else if (elements == 0 && j.outputs.empty()) {
    j.status = Status::untested;
    j.reason = "nothing to judge";
  } else if (unbounded * 2 > elements - free && elements > free) {
    j.status = Status::untested;
    j.reason = fmt::format("{:.2f} % of the elements have no useful bound, neither from the profile nor from what real devices do",
                           100.0 * static_cast<double>(unbounded) / static_cast<double>(elements - free));
  } else if (j.rearranged > 0) {
    j.status = Status::warn;
    j.reason = fmt::format("{} invocations lie outside the formula as written, by up to {} codes, inside its rearrangements ({}){}",
                           j.rearranged, j.rearranged_distance, name(profile.rearrangement),
                           profile.rearrangement_remedy.empty() ? "" : "; " + profile.rearrangement_remedy);
  } else if (atypical > 0) {
    j.status = Status::warn;
    j.reason = fmt::format("{} elements lie inside the profile but outside what real devices do", atypical);
  } else {
    j.status = Status::pass;
  }
}

void conclude(PassJudgement& pass) {
  const std::string doubt = std::move(pass.reason);  // of the rounding that was found
  pass.status = doubt.empty() ? Status::pass : Status::warn;
  pass.reason = doubt;
  for (const CaseJudgement& c : pass.cases) {
    const Status both = worse(pass.status, c.status);
    if (both != pass.status || (c.status == both && pass.reason.empty())) pass.reason = c.reason.empty() ? doubt : c.reason;
    pass.status = both;
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
  if (j.status == Status::not_judged) j.status = Status::untested;  // of the whole, something may well have been judged
}

}  // namespace rainref::judge
