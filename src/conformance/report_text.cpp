#include "conformance/report_text.h"

#include <algorithm>

#include <fmt/format.h>

#include "image/code_range.h"

namespace rainref::conformance {
namespace {

std::string channel_name(int channel) { return std::string(1, "xyzw"[channel & 3]); }

std::string failure_line(const OutputJudgement& o, const Failure& f) {
  if (o.records) return fmt::format("record {}: other bits than expected", f.x);
  const FormatInfo::Kind kind = info(o.format).kind;
  const std::string place = fmt::format("({}, {}).{}", f.x, f.y, channel_name(f.channel));
  if (f.not_a_number) return fmt::format("{} is not a number", place);
  const std::string accepted = f.low == f.high ? enclosed::code_text(kind, f.low)
                                               : fmt::format("{} to {}", enclosed::code_text(kind, f.low), enclosed::code_text(kind, f.high));
  return fmt::format("{}  got {}  accepted {}  off by {} code{}", place, enclosed::code_text(kind, f.got), accepted, f.distance, f.distance == 1 ? "" : "s");
}

struct Sums {
  std::int64_t invocations = 0, failing = 0, ambiguous = 0, other_branch = 0, elements = 0, vacuous = 0, loose = 0, free = 0, atypical = 0, differing = 0;
  double median = 0;
};
Sums sums_of(const PassJudgement& p) {
  Sums s;
  for (const CaseJudgement& c : p.cases) {
    s.invocations += c.invocations;
    s.failing += c.failing;
    s.ambiguous += c.ambiguous;
    s.other_branch += c.other_branch;
    for (const OutputJudgement& o : c.outputs) {
      s.elements += o.elements;
      s.vacuous += o.vacuous;
      s.loose += o.loose;
      s.free += o.free;
      s.atypical += o.atypical;
      s.differing += o.differing;
      s.median = std::max(s.median, o.median_width);
    }
  }
  return s;
}
double percent(std::int64_t part, std::int64_t of) { return of == 0 ? 0 : 100.0 * static_cast<double>(part) / static_cast<double>(of); }

std::string pass_line(const PassJudgement& p) {
  const Sums s = sums_of(p);
  std::string line = fmt::format("{:<9} {:<12}", name(p.status), p.pass);
  if (s.elements > 0) {
    const std::int64_t judged = s.elements - s.free;
    line += fmt::format(" {} of {} invocations outside; bounded {:.2f} %, median width {:.0f} codes, loose {:.2f} %, ambiguous {} ({} took the other branch)", s.failing,
                        s.invocations, percent(judged - s.vacuous, judged), s.median, percent(s.loose, judged), s.ambiguous, s.other_branch);
    if (s.free > 0) line += fmt::format(", {} values free", s.free);
  }
  if (p.half_mode_voted) line += fmt::format("; half stores: {}", name(p.half_mode));
  if (!p.reason.empty()) line += fmt::format("\n          {}", p.reason);
  return line + "\n";
}

}  // namespace

std::string report_text(const PortJudgement& j) {
  std::string out;
  for (const PassJudgement& p : j.passes) out += pass_line(p);
  for (const PassJudgement& p : j.passes) {
    if (p.status != Status::fail || sums_of(p).failing == 0) continue;
    out += fmt::format("\n{} is outside the as-written envelope of {} under profile {}{}\n", p.pass, p.formula, j.profile,
                       p.pass == j.first_bad_pass ? " (first bad pass)" : "");
    for (const CaseJudgement& c : p.cases) {
      for (const OutputJudgement& o : c.outputs) {
        if (o.failing == 0) continue;
        out += fmt::format("  {}/out.{}: {} of {} elements outside ({:.3f} %)\n", c.id, o.name, o.failing, o.elements, percent(o.failing, o.elements));
        for (std::size_t k = 0; k < std::min<std::size_t>(3, o.worst.size()); ++k) out += fmt::format("    {}\n", failure_line(o, o.worst[k]));
      }
    }
    if (p.causes.empty()) out += "  cause unknown\n";
    for (const Cause& c : p.causes) out += fmt::format("  likely cause: {}: {} (gives {} of {} failing texels bit for bit, comes near {})\n", c.name, c.sentence, c.explained, c.of, c.inside);
  }
  for (const std::string& note : j.notes) out += fmt::format("note: {}\n", note);
  out += fmt::format("\n{}: {} against {}, profile {}{}\n", name(j.status), j.port, j.pack, j.profile, j.device.empty() ? "" : fmt::format(", {} {}", j.api, j.device));
  if (!j.reason.empty()) out += fmt::format("  {}\n", j.reason);
  return out;
}

std::string report_text(const MutationReport& r, bool all) {
  std::string out;
  std::int64_t caught = 0, equivalent = 0, bugs = 0;
  for (const MutantJudgement& m : r.mutants) {
    if (m.differing == 0) {
      ++equivalent;
    } else if (!m.legal) {
      ++bugs;
      caught += m.caught();
    }
    const char* verdict = m.differing == 0 ? "equivalent" : m.caught() ? "caught" : m.legal ? "legal" : "MISSED";
    if (all || (!m.caught() && m.differing > 0 && !m.legal))
      out += fmt::format("{:<10} {:<12} {}: {} of {} invocations differ, {} outside\n", verdict, m.pass, m.name, m.differing, m.compared, m.outside);
  }
  for (const std::string& u : r.unjudged) out += fmt::format("not judged: {}\n", u);
  out += fmt::format("{} of {} deviations that change something would be caught under {} ({} change nothing on this pack)\n", caught, bugs, r.profile, equivalent);
  return out;
}

int exit_code(const PortJudgement& j, bool allow_untested) {
  if (j.status == Status::pass || j.status == Status::warn) return 0;
  if (j.status == Status::fail || !allow_untested) return 1;
  return std::any_of(j.passes.begin(), j.passes.end(), [](const PassJudgement& p) { return p.status == Status::pass || p.status == Status::warn; }) ? 0 : 1;
}

}  // namespace rainref::conformance
