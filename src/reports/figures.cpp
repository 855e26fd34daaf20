#include "reports/figures.h"

#include <algorithm>

#include <fmt/format.h>

#include "image/code_range.h"

namespace rainref::reports {
namespace {

using judge::CaseJudgement;
using judge::Cause;
using judge::Counted;
using judge::Failure;
using judge::HalfMode;
using judge::OutputJudgement;
using judge::PassJudgement;
using judge::PortJudgement;
using judge::Status;

void add(Figures& to, const Figures& f) {
  for (auto sum :
       {&Figures::invocations, &Figures::failing, &Figures::ambiguous, &Figures::other_branch, &Figures::gave_up, &Figures::elements,
        &Figures::outside, &Figures::differing, &Figures::vacuous, &Figures::loose, &Figures::atypical, &Figures::free})
    to.*sum += f.*sum;
  to.median_width = std::max(to.median_width, f.median_width);
  to.p99_width = std::max(to.p99_width, f.p99_width);
}

const char* negative_zero_text(FormatInfo::Kind kind) { return kind == FormatInfo::float16 ? "-0 (0x8000)" : "-0 (0x80000000)"; }

}  // namespace

Figures figures_of(const OutputJudgement& o) {
  Figures f;
  f.elements = o.elements;
  f.outside = o.failing;
  f.differing = o.differing;
  f.vacuous = o.vacuous;
  f.loose = o.loose;
  f.atypical = o.atypical;
  f.free = o.free;
  f.median_width = o.median_width;
  f.p99_width = o.p99_width;
  return f;
}
Figures figures_of(const CaseJudgement& c) {
  Figures f;
  f.invocations = c.invocations;
  f.failing = c.failing;
  f.ambiguous = c.ambiguous;
  f.other_branch = c.other_branch;
  f.gave_up = c.gave_up;
  for (const OutputJudgement& o : c.outputs) add(f, figures_of(o));
  return f;
}
Figures figures_of(const PassJudgement& p) {
  Figures f;
  for (const CaseJudgement& c : p.cases) add(f, figures_of(c));
  return f;
}

std::string share_text(std::int64_t part, std::int64_t of) {
  if (of <= 0) return "-";
  if (part <= 0) return "0 %";
  if (part >= of) return "100 %";
  return fmt::format("{:.2f} %", std::clamp(100.0 * static_cast<double>(part) / static_cast<double>(of), 0.01, 99.99));
}
std::string width_text(double codes) { return codes >= 4e9 ? "none" : fmt::format("{:.0f}", codes); }
std::string shape_text(const OutputJudgement& o) {
  const std::int64_t records = o.counted == Counted::fields ? o.width : o.elements;
  return o.records ? fmt::format("{} record{}", records, records == 1 ? "" : "s")
                   : fmt::format("{} {}x{}", info(o.format).name, o.width, o.height);
}
const char* element_word(const OutputJudgement& o) { return o.counted == Counted::fields ? "fields" : o.records ? "records" : "elements"; }
const char* element_word(const Cause& c) { return c.of_records ? "records" : "texels"; }
std::string channel_name(int channel) { return std::string(1, "xyzw"[channel & 3]); }

FailureText failure_text(const OutputJudgement& o, const Failure& f) {
  if (o.records && f.field.empty()) return {fmt::format("record {}", f.x), "", "", "", "is in one of the lists alone"};
  const FormatInfo::Kind kind = o.records ? f.field_kind : info(o.format).kind;
  FailureText t;
  t.place = o.records ? fmt::format("record {}, {}", f.x, f.field) : fmt::format("({}, {}).{}", f.x, f.y, channel_name(f.channel));
  const auto text = [&](std::int64_t code, bool negative_zero) {
    return negative_zero ? negative_zero_text(kind) : enclosed::code_text(kind, code);
  };
  t.got = text(f.got, f.got_is_negative_zero);
  t.expected = text(f.expected, f.expected_is_negative_zero);
  t.accepted = f.low == f.high && f.low == f.expected ? t.expected
               : f.low == f.high                      ? enclosed::code_text(kind, f.low)
                                 : fmt::format("{} to {}", enclosed::code_text(kind, f.low), enclosed::code_text(kind, f.high));
  t.distance = f.not_a_number ? "is not a number" : fmt::format("off by {} code{}", f.distance, f.distance == 1 ? "" : "s");
  return t;
}

const char* cause_word(const Cause& c) { return c.is_likely ? "likely cause" : "may be"; }
std::string cause_text(const Cause& c) {
  return fmt::format("{}: {}: {} (gives {} of {} failing {} bit for bit, comes near {})", cause_word(c), c.name, c.sentence, c.explained,
                     c.of, element_word(c), c.inside);
}

bool is_broken(const PassJudgement& p) {
  return std::any_of(p.cases.begin(), p.cases.end(), [](const CaseJudgement& c) { return c.broken; });
}
bool has_unknown_cause(const PassJudgement& p) { return p.causes.empty() && figures_of(p).outside > 0 && !is_broken(p); }

std::string half_text(const PassJudgement& p) {
  if (!p.half_mode_voted) return "";
  const auto [rne, rtz, either] = p.half_votes;
  const char* found = p.half_mode == HalfMode::rne   ? "to nearest"
                      : p.half_mode == HalfMode::rtz ? "toward zero"
                                                     : "sometimes to nearest, sometimes toward zero";
  if (rne == rtz && p.half_mode != HalfMode::either) return "stores to half: nothing tells how they round";
  return fmt::format("stores to half round {} (invocations outside if to nearest: {}, toward zero: {}, either way: {})", found, rne, rtz,
                     either);
}

bool forgives_untested(const PortJudgement& j, bool allow_untested) {
  return allow_untested && std::any_of(j.passes.begin(), j.passes.end(),
                                       [](const PassJudgement& p) { return p.status == Status::pass || p.status == Status::warn; });
}
int exit_code(const PortJudgement& j, bool allow_untested) {
  if (j.status == Status::fail) return 1;
  return j.status == Status::untested && !forgives_untested(j, allow_untested) ? 1 : 0;
}

std::string count_text(const PortJudgement& j) {
  std::string out;
  for (const Status s : {Status::fail, Status::untested, Status::known, Status::warn, Status::pass, Status::data}) {
    const auto count = std::count_if(j.passes.begin(), j.passes.end(), [&](const PassJudgement& p) { return p.status == s; });
    if (count > 0) out += fmt::format("{}{} {}", out.empty() ? "" : ", ", count, name(s));
  }
  return out;
}

}  // namespace rainref::reports
