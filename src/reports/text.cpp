#include "reports/text.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reports/figures.h"

namespace rainref::reports {
namespace {

using faults::MutantJudgement;
using faults::MutationReport;
using judge::CaseJudgement;
using judge::Cause;
using judge::OutputJudgement;
using judge::PassJudgement;
using judge::PortJudgement;
using judge::QuantityJudgement;
using judge::Status;

constexpr std::size_t shown_outputs = 4;  // of a pass that fails
constexpr std::size_t worst_shown = 3;    // of an output
constexpr std::size_t columns = 120;

/// The text in lines of at most `columns`, broken at spaces, with this indent on all but the first; a longer word is not broken.
std::string wrapped(const std::string& text, std::size_t indent) {
  std::string out;
  std::size_t column = 0;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t word = std::min(text.find_first_not_of(' ', at), text.size()), end = std::min(text.find(' ', word), text.size());
    if (column > indent && column + end - at > columns) {
      out += "\n" + std::string(indent, ' ');
      column = indent;
      at = word;
    }
    out += text.substr(at, end - at);
    column += end - at;
    at = end;
  }
  return out + "\n";
}

std::vector<std::string> row_of(const PassJudgement& p) {
  const Figures f = figures_of(p);
  if (f.elements == 0) return {name(p.status), p.pass, "nothing judged", "-", "-", "-", "-", "-", "-"};
  return {name(p.status),
          p.pass,
          fmt::format("{} of {}", f.failing, f.invocations),
          share_text(f.bounded(), f.sampled()),
          width_text(f.median_width),
          width_text(f.p99_width),
          fmt::format("{}", f.ambiguous),
          share_text(f.vacuous, f.sampled()),
          share_text(f.loose, f.sampled())};
}

/// Bounds of a list's fields: those with a width, then the number of those with a single value.
std::string fields_text(const QuantitiesOfOutput& o) {
  std::string wide;
  std::size_t exact = 0;
  for (const QuantityJudgement& q : o.quantities) {
    if (q.p99_codes == 0 && q.vacuous == 0) {
      ++exact;
      continue;
    }
    Width median = median_width(q);
    median.unit.clear();  // without the unit, which follows the other number
    wide += fmt::format("{}{} {}, 99 % {}", wide.empty() ? "" : "; ", q.name, in_unit(median), in_unit(p99_width(q)));
    if (q.vacuous > 0) wide += fmt::format(", {} vacuous", q.vacuous);
    if (q.loose > q.vacuous) wide += fmt::format(", {} loose", q.loose - q.vacuous);
  }
  if (wide.empty()) return "";
  const std::string others = exact == 0 ? "" : fmt::format("; the other {}: one value each", exact);
  return fmt::format("{}, median width by field: {}{}", o.output, wide, others);
}

/// Remarks on a pass beyond the columns; for a passing pass only if everything is shown.
std::vector<std::string> remarks_on(const PassJudgement& p, bool is_verbose) {
  const Figures f = figures_of(p);
  std::vector<std::string> out;
  if (p.status == Status::pass && !is_verbose) return out;
  // A reason of a single case is shown below, with the case.
  if (!p.reason.empty() && !is_broken(p)) out.push_back(p.reason);
  std::string open;
  std::size_t count = 0;
  for (const CaseJudgement& c : p.cases)
    if ((c.status == Status::untested || c.status == Status::not_judged) && c.outputs.empty() && ++count <= shown_outputs)
      open += (open.empty() ? "" : ", ") + c.id;
  if (count > 0)
    out.push_back(fmt::format("not judged: {}{}", open, count > shown_outputs ? fmt::format(" and {} more", count - shown_outputs) : ""));
  if (f.atypical > 0 && p.status != Status::warn)
    out.push_back(fmt::format("{} elements inside the profile but outside what known devices do", f.atypical));
  if (f.typical > 0)
    out.push_back(
        fmt::format("{} elements have no useful bound from the profile; what known devices do bounds {} of them, {} stay unbounded",
                    f.vacuous, f.typical, f.unbounded));
  if (f.other_branch > 0)
    out.push_back(fmt::format("{} of {} ambiguous invocations took another branch than the reference", f.other_branch, f.ambiguous));
  if (f.gave_up > 0) out.push_back(fmt::format("{} invocations with too many open decisions to bound", f.gave_up));
  for (const QuantitiesOfOutput& o : quantities_of(p))
    if (const std::string fields = o.counted == judge::Counted::fields ? fields_text(o) : ""; !fields.empty()) out.push_back(fields);
  if (f.free > 0) out.push_back(fmt::format("{} of {} elements are free: declared as not reproducible", f.free, f.elements));
  for (const std::string& text : {half_text(p), sample_text(p)})
    if (!text.empty()) out.push_back(text);
  if (p.status == Status::warn)
    for (const Cause& c : p.causes) out.push_back(cause_text(c, "warned"));
  if (is_verbose && !p.coverage.never.empty()) out.push_back(coverage_text(p.coverage, p.coverage.never.size()));
  return out;
}

/// Columns as wide as their widest cell; the first two are words, the others numbers.
std::string table_text(const PortJudgement& j, bool is_verbose) {
  std::vector<std::vector<std::string>> rows{{"", "pass", "outside", "bounded", "median width", "99 %", "ambiguous", "vacuous", "loose"}};
  for (const PassJudgement& p : j.passes) rows.push_back(row_of(p));
  std::vector<std::size_t> widths(rows[0].size(), 0);
  for (const auto& row : rows)
    for (std::size_t k = 0; k < row.size(); ++k) widths[k] = std::max(widths[k], row[k].size());
  std::string out;
  for (std::size_t r = 0; r < rows.size(); ++r) {
    std::string line;
    for (std::size_t k = 0; k < rows[r].size(); ++k)
      line += k < 2 ? fmt::format("{:<{}}  ", rows[r][k], widths[k])
                    : fmt::format("{:>{}}{}", rows[r][k], widths[k], k + 1 < rows[r].size() ? "  " : "");
    out += line + "\n";
    if (r == 0) continue;
    for (const std::string& remark : remarks_on(j.passes[r - 1], is_verbose))
      out += wrapped(std::string(widths[0] + 2, ' ') + remark, widths[0] + 4);
  }
  return out;
}

std::string output_text(const CaseJudgement& c, const OutputJudgement& o) {
  std::string out = fmt::format("  {}/out.{} ({}): {} of {} {}{} outside ({})\n", c.id, o.name, shape_text(o), o.failing, o.elements,
                                c.is_of_sample ? "sampled " : "", element_word(o), share_text(o.failing, o.elements));
  const std::size_t shown = std::min(worst_shown, o.worst.size());
  for (std::size_t k = 0; k < shown; ++k) {
    const FailureText t = failure_text(o, o.worst[k]);
    out += t.got.empty() ? fmt::format("    {}  {}\n", t.place, t.distance)
                         : fmt::format("    {}  got {}  accepted {}  {}\n", t.place, t.got, t.accepted, t.distance);
  }
  if (o.failing > static_cast<std::int64_t>(shown))
    out += fmt::format("    ({} more not shown)\n", o.failing - static_cast<std::int64_t>(shown));
  return out;
}

std::string failures_text(const PassJudgement& p, const PortJudgement& j) {
  const std::string verdict = figures_of(p).outside > 0 ? fmt::format(" {} under profile {}", outside_text(p), j.profile) : "";
  std::string out = "\n" + wrapped(fmt::format("{} {}{}", name(p.status), p.pass, verdict), 2);
  if (p.pass == j.first_bad_pass)
    out += p.inputs_are_good ? "  first bad pass, its inputs are good\n" : "  first bad pass, its inputs are not good either\n";
  std::size_t shown = 0, skipped = 0;
  for (const CaseJudgement& c : p.cases) {
    if (c.broken) {
      if (shown == shown_outputs)
        ++skipped;
      else
        out += wrapped(fmt::format("  {}: {}", c.id, c.reason), 4);
      shown = std::min(shown + 1, shown_outputs);
    }
    for (const OutputJudgement& o : c.outputs) {
      if (o.failing == 0) continue;
      if (shown == shown_outputs) {
        ++skipped;
        continue;
      }
      ++shown;
      out += output_text(c, o);
      if (!o.known.empty()) out += wrapped(fmt::format("    known: {}", o.known), 6);
    }
  }
  if (skipped > 0) out += fmt::format("  ({} more failures not shown)\n", skipped);
  if (has_unknown_cause(p) && p.causes.empty()) out += "  cause unknown\n";
  if (!p.where.empty()) out += wrapped(fmt::format("  where: {}", p.where), 4);
  for (const Cause& c : p.causes) {
    if (c.repeats_first) continue;
    out += wrapped("  " + cause_text(c), 4);
    for (const std::string& line : line_texts(c)) out += line + "\n";
  }
  return out;
}

template <class Is>
std::vector<std::string> passes_with(const PortJudgement& j, Is is) {
  std::vector<std::string> out;
  for (const PassJudgement& p : j.passes)
    if (is(p)) out.push_back(p.pass);
  return out;
}

}  // namespace

std::string report_text(const PortJudgement& j, bool is_verbose) {
  std::string out = j.passes.empty() ? "" : table_text(j, is_verbose);
  for (const PassJudgement& p : j.passes)
    if ((p.status == Status::fail || p.status == Status::known) && !p.cases.empty()) out += failures_text(p, j);
  for (const std::string& s : j.stale) out += fmt::format("\nbaseline: {}\n", s);
  if (!j.files.empty()) out += "\nmissing, or cannot be used:\n";
  for (const judge::FileFault& f : j.files) out += wrapped("  " + f.text, 4);
  for (const std::string& note : j.notes) out += fmt::format("note: {}\n", note);
  if (const std::vector<std::string> some = passes_with(j, [](const PassJudgement& p) { return figures_of(p).unsampled > 0; });
      !some.empty())
    out += wrapped(fmt::format("note: widths and shares of {} are those of samples; --exhaustive computes all", fmt::join(some, ", ")), 2);
  if (const std::vector<std::string> some = passes_with(j, fails_by_sample); !some.empty())
    out += wrapped(
        fmt::format("note: much of a sample of {} fails, and only the sample was judged; --exhaustive judges all", fmt::join(some, ", ")),
        2);
  out += fmt::format("\n{}: {} against {}, profile {}", name(j.status), j.port, j.pack, j.profile);
  if (!j.device.empty()) out += fmt::format(", {} {}", j.api, j.device);
  if (const std::string counts = count_text(j); !counts.empty()) out += fmt::format(" ({})", counts);
  if (!j.reason.empty()) out += fmt::format("\n  {}", j.reason);
  out += "\n";
  if (const std::vector<std::string> without = not_judged(j); !without.empty())
    out += wrapped(fmt::format("  not judged: {}", fmt::join(without, ", ")), 4);
  return out;
}

std::string report_text(const MutationReport& r, bool all) {
  std::string out;
  std::int64_t caught = 0, equivalent = 0, bugs = 0, warned = 0;
  for (const MutantJudgement& m : r.mutants) {
    if (m.differing == 0) {
      ++equivalent;
    } else if (!m.legal) {
      ++bugs;
      caught += m.caught();
      warned += m.warned();
    }
    const char* verdict = m.differing == 0 ? "equivalent" : m.caught() ? "caught" : m.legal ? "legal" : m.warned() ? "WARNED" : "MISSED";
    if (all || (!m.caught() && m.differing > 0 && !m.legal))
      out += fmt::format("{:<10} {:<12} {}: {} of {} invocations differ, {} outside, {} only rearranged\n", verdict, m.pass, m.name,
                         m.differing, m.compared, m.outside, m.rearranged);
  }
  for (const std::string& u : r.unjudged) out += fmt::format("not judged: {}\n", u);
  out += fmt::format(
      "{} of {} faults that change something would be caught under {} ({} more would warn, as rearrangements; {} change nothing on "
      "this pack)\n",
      caught, bugs, r.profile, warned, equivalent);
  return out;
}

}  // namespace rainref::reports
