#include "reports/figures.h"

#include <algorithm>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "image/code_range.h"
#include "judge/port_files.h"
#include "judge/quantities.h"

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
using judge::QuantityJudgement;
using judge::Status;

constexpr double no_bound = 4e9;
/// More codes than this exceed an eighth of a float's size, mostly because the envelope contains 0; then codes are not meaningful.
constexpr double most_codes = 0x1p20;

bool is_vacuous(const Width& w) { return w.is_vacuous || w.codes >= no_bound; }
const Width& wider(const Width& a, const Width& b) {
  if (is_vacuous(a) != is_vacuous(b)) return is_vacuous(a) ? a : b;
  return b.codes > a.codes ? b : a;
}

/// Whether this number of vacuous envelopes includes the given percentile.
bool reaches(std::int64_t vacuous, std::int64_t of, double share) {
  return vacuous > 0 && static_cast<double>(vacuous) > (1 - share) * static_cast<double>(of);
}
Width width_of(const QuantityJudgement& q, double codes, double value, double share) {
  return {codes, reaches(q.vacuous, q.sampled(), share), value, q.unit};
}
Width width_of(const OutputJudgement& o, double codes, double share, Width (*of_quantity)(const QuantityJudgement&)) {
  Width w{codes, reaches(o.vacuous, o.sampled(), share), -1, ""};
  if (codes < most_codes || is_vacuous(w)) return w;
  for (const QuantityJudgement& q : o.quantities)
    if (const Width own = of_quantity(q); w.value < 0 || own.codes > w.codes) w = {own.codes, false, own.value, own.unit};
  return w;
}

/// Distance of a quantity relative to its declared range; infinite without a range.
double share_off(const QuantityJudgement& q) { return q.extent > 0 ? q.farthest / q.extent : std::numeric_limits<double>::infinity(); }
bool fails_worse(const QuantityJudgement& a, const QuantityJudgement& b) {
  return std::pair(share_off(a), a.failing) > std::pair(share_off(b), b.failing);
}

void add(Figures& to, const Figures& f) {
  for (auto sum : {&Figures::invocations, &Figures::failing, &Figures::ambiguous, &Figures::other_branch, &Figures::gave_up,
                   &Figures::elements, &Figures::outside, &Figures::differing, &Figures::vacuous, &Figures::loose, &Figures::atypical,
                   &Figures::free, &Figures::typical, &Figures::unbounded, &Figures::rearranged, &Figures::unsampled})
    to.*sum += f.*sum;
  to.median_width = wider(to.median_width, f.median_width);
  to.p99_width = wider(to.p99_width, f.p99_width);
}

/// The quantity of a failure; null if it has no name.
const QuantityJudgement* quantity_at(const OutputJudgement& o, const Failure& f) {
  const auto found = std::find_if(o.quantities.begin(), o.quantities.end(),
                                  [&](const QuantityJudgement& q) { return q.name == (o.records ? f.field : channel_name(f.channel)); });
  return found == o.quantities.end() ? nullptr : &*found;
}

const char* negative_zero_text(FormatInfo::Kind kind) { return kind == FormatInfo::float16 ? "-0 (0x8000)" : "-0 (0x80000000)"; }

}  // namespace

Width median_width(const QuantityJudgement& q) { return width_of(q, q.median_codes, q.median_width, 0.5); }
Width p99_width(const QuantityJudgement& q) { return width_of(q, q.p99_codes, q.p99_width, 0.99); }
Width median_width(const OutputJudgement& o) { return width_of(o, o.median_width, 0.5, median_width); }
Width p99_width(const OutputJudgement& o) { return width_of(o, o.p99_width, 0.99, p99_width); }

Figures figures_of(const OutputJudgement& o) {
  Figures f;
  f.elements = o.elements;
  f.outside = o.failing;
  f.differing = o.differing;
  f.vacuous = o.vacuous;
  f.loose = o.loose;
  f.atypical = o.atypical;
  f.free = o.free;
  f.typical = o.typical;
  f.unbounded = o.unbounded;
  f.rearranged = o.rearranged;
  f.unsampled = o.unsampled;
  f.median_width = median_width(o);
  f.p99_width = p99_width(o);
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
std::string quantity_text(double value, const std::string& unit) {
  return fmt::format("{:.3g}{}{}", value, unit.empty() || unit == "1" ? "" : " ", unit == "1" ? "" : unit);
}
std::string in_unit(const Width& w) { return is_vacuous(w) ? "vacuous" : quantity_text(w.value, w.unit); }
std::string width_text(const Width& w) {
  if (is_vacuous(w)) return "vacuous";
  if (w.codes >= most_codes && w.value >= 0) return quantity_text(w.value, w.unit);
  return fmt::format("{:.0f} code{}", w.codes, w.codes == 1 ? "" : "s");
}
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
  t.accepted = f.low == INT64_MIN                       ? "any number"  // a range without ends, whose codes do not belong to the format
               : f.low == f.high && f.low == f.expected ? t.expected
               : f.low == f.high                        ? enclosed::code_text(kind, f.low)
                                 : fmt::format("{} to {}", enclosed::code_text(kind, f.low), enclosed::code_text(kind, f.high));
  t.distance = f.not_a_number ? "is not a number" : fmt::format("off by {} code{}", f.distance, f.distance == 1 ? "" : "s");
  const QuantityJudgement* quantity = quantity_at(o, f);
  const double value = judge::value_distance(kind, f);
  if (kind == FormatInfo::uint32 || !(value <= std::numeric_limits<double>::max()) || value == 0) return t;
  t.value = quantity_text(value, quantity ? quantity->unit : "");
  t.distance += fmt::format(" ({})", t.value);
  return t;
}

const QuantityJudgement* worst_quantity(const OutputJudgement& o) {
  const QuantityJudgement* worst = nullptr;
  for (const QuantityJudgement& q : o.quantities)
    if (q.failing > 0 && (!worst || fails_worse(q, *worst))) worst = &q;
  return worst;
}
bool fails_worse(const OutputJudgement& a, const OutputJudgement& b) {
  const QuantityJudgement *of_a = worst_quantity(a), *of_b = worst_quantity(b);
  if (of_a && of_b) return fails_worse(*of_a, *of_b);
  return !of_b && (of_a || a.failing > b.failing);
}

std::vector<Shown> shown_of(const PassJudgement& p) {
  std::vector<const CaseJudgement*> failing, cases;
  const CaseJudgement* sample = nullptr;
  const auto differing = [](const CaseJudgement& c) { return figures_of(c).differing; };
  for (const CaseJudgement& c : p.cases) {
    if (c.status == Status::fail || c.status == Status::known)
      failing.push_back(&c);
    else if (!c.outputs.empty() && (!sample || differing(c) >= differing(*sample)))
      sample = &c;  // the case that differs most is the most informative; of equals the last
  }
  if (!failing.empty()) cases.push_back(failing[0]);
  std::stable_sort(failing.begin(), failing.end(), [](const auto* a, const auto* b) { return a->failing > b->failing; });
  for (const CaseJudgement* c : failing)
    if (cases.size() < pictured_failures && c != cases[0]) cases.push_back(c);
  if (sample) cases.push_back(sample);
  std::vector<Shown> out;
  for (const CaseJudgement* c : cases) {
    const auto first = static_cast<std::ptrdiff_t>(out.size());
    for (const OutputJudgement& o : c->outputs)
      if (c->failing == 0 || o.failing > 0) out.push_back({c, &o});
    std::stable_sort(out.begin() + first, out.end(), [](const Shown& a, const Shown& b) { return fails_worse(*a.output, *b.output); });
  }
  return out;
}

std::vector<QuantitiesOfOutput> quantities_of(const PassJudgement& p) {
  std::vector<QuantitiesOfOutput> all;
  for (const CaseJudgement& c : p.cases) {
    for (const OutputJudgement& o : c.outputs) {
      auto found = std::find_if(all.begin(), all.end(), [&](const QuantitiesOfOutput& q) { return q.output == o.name; });
      if (found == all.end()) {
        all.push_back({o.name, o.counted, o.quantities});
        continue;
      }
      for (std::size_t k = 0; k < std::min(found->quantities.size(), o.quantities.size()); ++k) {
        QuantityJudgement& to = found->quantities[k];
        const QuantityJudgement& from = o.quantities[k];
        for (auto count : {&QuantityJudgement::elements, &QuantityJudgement::failing, &QuantityJudgement::vacuous,
                           &QuantityJudgement::loose, &QuantityJudgement::free, &QuantityJudgement::unsampled})
          to.*count += from.*count;
        for (auto figure : {&QuantityJudgement::median_codes, &QuantityJudgement::p99_codes, &QuantityJudgement::median_width,
                            &QuantityJudgement::p99_width, &QuantityJudgement::farthest})
          to.*figure = std::max(to.*figure, from.*figure);
      }
    }
  }
  return all;
}

std::string coverage_text(const judge::PassCoverage& c, std::size_t shown) {
  if (c.alternatives == 0) return "";
  std::string out = fmt::format("exercises {} of {} alternatives{}", c.taken, c.alternatives, c.is_sampled ? " by a sample" : "");
  if (!c.reasons.empty()) out += fmt::format(", {} with a reason not", c.reasons.size());
  if (shown == 0) return c.never.empty() ? out : fmt::format("{}, {} without one", out, c.never.size());
  for (std::size_t k = 0; k < std::min(shown, c.never.size()); ++k) out += (k == 0 ? "; never: " : "; ") + c.never[k];
  return out + (c.never.size() > shown ? fmt::format(" and {} more", c.never.size() - shown) : "");
}

std::string cause_words(const Cause& c) {
  return c.is_found() ? fmt::format("{}: {}: {}", c.is_likely ? "likely cause" : "may be", c.name, c.sentence)
                      : fmt::format("{}: {}", c.name, c.sentence);
}
std::string cause_text(const Cause& c, std::string_view which) {
  if (!c.is_found()) return cause_words(c);
  return fmt::format("{} (gives {} of {} {} {} bit for bit, comes near {})", cause_words(c), c.explained, c.of, which, element_word(c),
                     c.inside);
}
std::vector<std::string> line_texts(const Cause& c) {
  std::vector<std::string> out;
  for (const judge::ShaderLine& l : c.lines)
    out.push_back(fmt::format("{}:{}: {}", l.file, l.line,
                              l.until > 0 ? fmt::format("a step is missing between this line and line {}", l.until) : l.text));
  return out;
}
std::string first_cause_text(const PassJudgement& p) {
  if (p.causes.empty()) return has_unknown_cause(p) ? "cause unknown" : "";
  const std::vector<std::string> lines = line_texts(p.causes.front());
  return cause_words(p.causes.front()) + (lines.empty() ? "" : "; " + lines.front());
}
std::string outside_text(const PassJudgement& p) {
  std::int64_t outside = 0, beyond = 0;
  for (const CaseJudgement& c : p.cases)
    for (const OutputJudgement& o : c.outputs) outside += o.failing, beyond += c.beyond > 0 ? o.beyond : 0;
  return beyond > 0 && beyond == outside ? fmt::format("is outside what any known device makes of {}", p.formula)
                                         : fmt::format("is outside the as-written envelope of {}", p.formula);
}

bool is_broken(const PassJudgement& p) {
  return std::any_of(p.cases.begin(), p.cases.end(), [](const CaseJudgement& c) { return c.broken; });
}
bool has_unknown_cause(const PassJudgement& p) {
  return p.causes_sought && (p.causes.empty() || !p.causes.front().is_found()) && figures_of(p).outside > 0 && !is_broken(p);
}

bool fails_by_sample(const PassJudgement& p) {
  return std::any_of(p.cases.begin(), p.cases.end(), [](const CaseJudgement& c) { return c.is_of_sample; });
}
std::string sample_text(const PassJudgement& p) {
  const Figures f = figures_of(p);
  if (fails_by_sample(p)) return "much of its sample fails, and only the sample was judged (--exhaustive judges all)";
  return f.unsampled == 0 ? ""
                          : fmt::format("widths and shares are those of a sample of {} of {} elements (--exhaustive computes all)",
                                        f.sampled(), f.judged());
}

std::string half_text(const PassJudgement& p) {
  if (p.half_mode_is_open) return "nothing tells how stores to half round: name it in port.json, as half_store";
  if (!p.half_mode_voted) return "";
  const auto [rne, rtz, either] = p.half_votes;
  const char* found = p.half_mode == HalfMode::rne   ? "to nearest"
                      : p.half_mode == HalfMode::rtz ? "toward zero"
                                                     : "sometimes to nearest, sometimes toward zero";
  if (rne == rtz && p.half_mode != HalfMode::either)
    return p.half_is_least[0] || p.half_is_least[1] ? "stores to half: nothing that had to be computed tells how they round"
                                                    : "stores to half: nothing tells how they round";
  const auto text = [&](std::int64_t count, std::size_t k) { return fmt::format("{}{}", p.half_is_least[k] ? "at least " : "", count); };
  return fmt::format("stores to half round {} (invocations outside if to nearest: {}, toward zero: {}, either way: {})", found,
                     text(rne, 0), text(rtz, 1), text(either, 2));
}

std::vector<std::string> not_judged(const PortJudgement& j) {
  std::vector<std::string> out;
  for (const PassJudgement& p : j.passes)
    if (p.status == Status::not_judged) out.push_back(p.pass);
  return out;
}
bool forgives_untested(const PortJudgement& j, bool allow_untested) {
  return allow_untested && std::any_of(j.passes.begin(), j.passes.end(),
                                       [](const PassJudgement& p) { return p.status == Status::pass || p.status == Status::warn; });
}
int exit_code(const PortJudgement& j, bool allow_untested) {
  if (!j.files.empty()) return static_cast<int>(judge::files_error(j.files).code());
  if (j.status == Status::fail) return 1;
  return j.status == Status::untested && !forgives_untested(j, allow_untested) ? 1 : 0;
}

std::string count_text(const PortJudgement& j) {
  std::string out;
  for (const Status s : {Status::fail, Status::not_judged, Status::untested, Status::known, Status::warn, Status::pass, Status::data}) {
    const auto count = std::count_if(j.passes.begin(), j.passes.end(), [&](const PassJudgement& p) { return p.status == s; });
    if (count > 0) out += fmt::format("{}{} {}", out.empty() ? "" : ", ", count, name(s));
  }
  return out;
}

}  // namespace rainref::reports
