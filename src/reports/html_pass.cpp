// The section of one pass.
#include <algorithm>
#include <limits>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reports/figures.h"
#include "reports/html_parts.h"
#include "reports/markup.h"

namespace rainref::reports {
namespace {

using judge::CaseJudgement;
using judge::Cause;
using judge::OutputJudgement;
using judge::PassJudgement;
using judge::PortJudgement;
using judge::QuantityJudgement;
using judge::Status;

constexpr std::size_t shown_bad_rows = 200, shown_good_rows = 24;  // of the table of cases

bool is_bad(Status s) { return s != Status::pass; }

/// "wave of wave_step (the run before), drops of raindrops": where its inputs come from.
std::string takes_html(const PassJudgement& p, const PortJudgement& j, const PageSource& source) {
  std::vector<std::string> takes, from_host;
  for (const capture::PackEdge& e : source.edges) {
    if (e.pass != p.pass) continue;
    if (e.from == "host") {
      from_host.push_back(marked_up(e.input));
      continue;
    }
    const bool is_shown = std::any_of(j.passes.begin(), j.passes.end(), [&](const PassJudgement& other) { return other.pass == e.from; });
    const std::string from = is_shown ? fmt::format("<a href=\"#pass-{0}\">{0}</a>", marked_up(e.from)) : marked_up(e.from);
    takes.push_back(fmt::format("{} of {}{}", marked_up(e.input), from, e.previous ? " (the run before)" : ""));
  }
  if (!from_host.empty()) takes.push_back(fmt::format("{} of the host", fmt::join(from_host, ", ")));
  return takes.empty() ? "" : fmt::format("<p class=\"dim\">Takes {}.</p>\n", fmt::join(takes, ", "));
}

std::string causes_html(const PassJudgement& p) {
  if (figures_of(p).outside == 0 && p.causes.empty()) return "";
  std::string out = p.where.empty() ? "" : fmt::format("<p class=\"cause\"><b>Where:</b> {}.</p>\n", marked_up(p.where));
  if (p.causes.empty() && (is_broken(p) || !p.causes_sought)) return out;
  if (p.causes.empty()) return out + "<p class=\"cause\"><b>Cause unknown:</b> no single mistake that was tried gives these bits.</p>\n";
  out += fmt::format("<h3>{}</h3>\n<ol class=\"causes\">\n", p.causes[0].is_likely ? "Likely cause" : "What the cause may be");
  for (const Cause& c : p.causes) {
    out += fmt::format(
        "<li>{} <b>{}</b>: {} <span class=\"dim\">gives {} of {} {} {} bit for bit, comes near {}</span><meter min=\"0\" max=\"{}\" "
        "value=\"{}\">{}</meter></li>\n",
        cause_word(c), marked_up(c.name), marked_up(c.sentence), c.explained, c.of, p.status == Status::warn ? "warned" : "failing",
        element_word(c), c.inside, c.of, c.explained, share_text(c.explained, c.of));
  }
  return out + "</ol>\n";
}

std::vector<std::string> row_of(const CaseJudgement& c, const OutputJudgement& o) {
  const Figures f = figures_of(o);
  const Status status = o.failing == 0 && c.status == Status::fail ? Status::pass
                        : o.failing > 0 && !o.known.empty()        ? Status::known
                                                                   : c.status;
  return {status_pill(status),
          marked_up(fmt::format("{}/out.{}", c.id, o.name)),
          shape_text(o),
          fmt::format("{} of {}", o.failing, o.elements),
          share_text(f.differing, f.elements),
          share_text(f.bounded(), f.judged()),
          width_text(f.median_width),
          width_text(f.p99_width),
          fmt::format("{}", c.ambiguous),
          share_text(f.vacuous, f.judged()),
          share_text(f.loose, f.judged()),
          fmt::format("{}", f.atypical),
          fmt::format("{}", f.free)};
}

std::string cases_html(const PassJudgement& p) {
  std::vector<std::vector<std::string>> rows;
  std::size_t bad = 0, good = 0, skipped = 0;
  for (const CaseJudgement& c : p.cases) {
    for (const OutputJudgement& o : c.outputs) {
      std::size_t& count = is_bad(c.status) ? bad : good;
      if (++count > (is_bad(c.status) ? shown_bad_rows : shown_good_rows))
        ++skipped;
      else
        rows.push_back(row_of(c, o));
    }
  }
  if (rows.empty()) return "";
  std::string out = table_html("figures",
                               {"verdict", "output", "shape", "outside", "differ", "bounded", "median width", "99 %", "ambiguous",
                                "vacuous", "loose", "atypical", "free"},
                               rows, 3);
  if (skipped > 0) out += fmt::format("<p class=\"remark\">{} more outputs are not shown; --json lists all.</p>\n", skipped);
  return out;
}

/// A width without its unit, which has a column of its own.
std::string value_text(Width w) {
  w.unit.clear();
  return in_unit(w);
}

/// Each channel and field in its own unit, over all cases.
std::string quantities_html(const PassJudgement& p) {
  std::vector<std::vector<std::string>> rows;
  bool has_list = false;
  for (const QuantitiesOfOutput& o : quantities_of(p)) {
    has_list |= o.counted == judge::Counted::fields;
    for (const QuantityJudgement& q : o.quantities) {
      const std::int64_t judged = q.elements - q.free;
      const bool is_list = o.counted == judge::Counted::fields || o.counted == judge::Counted::records;
      rows.push_back({marked_up(o.output), marked_up(q.name), marked_up(q.unit), is_list ? "field" : "channel",
                      fmt::format("{} of {}", q.failing, q.elements),
                      q.failing == 0                                     ? ""
                      : q.farthest <= std::numeric_limits<double>::max() ? quantity_text(q.farthest, "")
                                                                         : "no number",
                      judged == 0 ? "-" : value_text(median_width(q)), judged == 0 ? "-" : value_text(p99_width(q)),
                      q.extent > 0 ? quantity_text(q.extent, "") : "-", share_text(q.vacuous, judged), share_text(q.loose, judged)});
    }
  }
  if (rows.empty()) return "";
  return fmt::format(
      "<details{}><summary>Each channel and field in its own unit</summary>\n{}</details>\n", has_list ? " open" : "",
      table_html("figures",
                 {"output", "name", "unit", "", "outside", "farthest off", "median width", "99 %", "declared range", "vacuous", "loose"},
                 rows, 4));
}

/// Cases that fail, or could not be judged, for a reason that no output shows.
std::string broken_html(const PassJudgement& p) {
  std::string rows;
  std::size_t count = 0;
  for (const CaseJudgement& c : p.cases) {
    const bool is_open = c.status == Status::untested || c.status == Status::not_judged;
    if (!c.broken && (!is_open || !c.outputs.empty())) continue;
    if (++count <= shown_bad_rows) rows += fmt::format("<li>{} {}: {}</li>\n", status_pill(c.status), marked_up(c.id), marked_up(c.reason));
  }
  if (count > shown_bad_rows) rows += fmt::format("<li>{} more; --json lists all.</li>\n", count - shown_bad_rows);
  return count == 0 ? "" : "<ul class=\"broken\">\n" + rows + "</ul>\n";
}

std::string known_html(const PassJudgement& p) {
  std::vector<std::string> reasons;
  for (const CaseJudgement& c : p.cases)
    for (const OutputJudgement& o : c.outputs)
      if (const std::string r = fmt::format("{}: {}", o.name, o.known);
          !o.known.empty() && std::find(reasons.begin(), reasons.end(), r) == reasons.end())
        reasons.push_back(r);
  std::string out;
  for (const std::string& r : reasons) out += fmt::format("<p class=\"known-reason\"><b>Known</b> {}</p>\n", marked_up(r));
  return out;
}

}  // namespace

std::vector<const CaseJudgement*> pictured_cases(const PassJudgement& p) {
  std::vector<const CaseJudgement*> failing, out;
  const CaseJudgement* sample = nullptr;
  const auto differing = [](const CaseJudgement& c) { return figures_of(c).differing; };
  for (const CaseJudgement& c : p.cases) {
    if (c.status == Status::fail || c.status == Status::known)
      failing.push_back(&c);
    else if (!c.outputs.empty() && (!sample || differing(c) >= differing(*sample)))
      sample = &c;  // what differs most shows most; of equals the last
  }
  if (!failing.empty()) out.push_back(failing[0]);
  std::stable_sort(failing.begin(), failing.end(), [](const auto* a, const auto* b) { return a->failing > b->failing; });
  for (const CaseJudgement* c : failing)
    if (out.size() < pictured_failures && c != out[0]) out.push_back(c);
  if (sample) out.push_back(sample);
  return out;
}

std::string place_of(const CaseJudgement& c, const OutputJudgement& o) { return fmt::format("at-{}/out.{}", c.id, o.name); }

std::vector<const OutputJudgement*> shown_outputs(const CaseJudgement& c) {
  std::vector<const OutputJudgement*> out;
  for (const OutputJudgement& o : c.outputs)
    if (c.failing == 0 || o.failing > 0) out.push_back(&o);
  std::stable_sort(out.begin(), out.end(), [](const auto* a, const auto* b) { return fails_worse(*a, *b); });
  return out;
}

std::string pass_html(const PassJudgement& p, const PortJudgement& j, const PageSource& source, std::size_t& budget) {
  const std::string css = status_class(p.status), name = marked_up(p.pass);
  std::string out = fmt::format("<section class=\"pass {}\" id=\"pass-{}\">\n<h2>{} {} <code class=\"dim\">{}</code></h2>\n", css, name,
                                status_pill(p.status), name, marked_up(p.formula));
  if (const auto sentence = source.sentences.find(p.pass); sentence != source.sentences.end())
    out += fmt::format("<p>{}</p>\n", marked_up(sentence->second));
  if (p.pass == j.first_bad_pass)
    out += fmt::format("<p class=\"first\">The first bad pass.{}</p>\n",
                       p.inputs_are_good ? " Its inputs are good, so no pass before it is to blame." : " Its inputs are not good either.");
  if (!p.reason.empty() && !is_broken(p)) out += fmt::format("<p class=\"reason\">{}</p>\n", marked_up(p.reason));
  out += broken_html(p);
  out += known_html(p) + takes_html(p, j, source) + causes_html(p);
  if (const std::string half = half_text(p); !half.empty()) out += fmt::format("<p class=\"dim\">S{}.</p>\n", marked_up(half.substr(1)));
  if (p.coverage.alternatives > 0) out += fmt::format("<p class=\"dim\">The pack {}.</p>\n", marked_up(coverage_text(p.coverage, 0)));
  const Figures f = figures_of(p);
  if (f.other_branch > 0)
    out += fmt::format("<p class=\"dim\">{} of {} ambiguous invocations took another branch than the reference.</p>\n", f.other_branch,
                       f.ambiguous);
  if (f.gave_up > 0) out += fmt::format("<p class=\"dim\">{} invocations had too many open decisions to bound.</p>\n", f.gave_up);
  out += cases_html(p);
  out += quantities_html(p);

  std::size_t unpictured = 0;
  for (const CaseJudgement* c : pictured_cases(p)) {
    for (const OutputJudgement* o : shown_outputs(*c)) {
      const std::optional<OutputBuffers> buffers = source.read ? source.read(c->id, o->name) : std::nullopt;
      if (!buffers) continue;
      const ViewerHtml viewer = viewer_html(*c, *o, *buffers, budget > 0);
      unpictured += budget == 0 && !o->map.empty();
      budget -= std::min(budget, viewer.bytes);
      out += viewer.html;
    }
  }
  const auto failing = static_cast<std::size_t>(std::count_if(
      p.cases.begin(), p.cases.end(), [](const CaseJudgement& c) { return c.status == Status::fail || c.status == Status::known; }));
  if (failing > pictured_failures)
    out += fmt::format("<p class=\"remark\">Pictures of {} of {} failing cases: the first and those with most failures.</p>\n",
                       pictured_failures, failing);
  if (unpictured > 0)
    out += fmt::format("<p class=\"remark\">No pictures of {} more outputs: a page holds {} MiB of them.</p>\n", unpictured,
                       picture_budget >> 20);
  return out + "</section>\n";
}

}  // namespace rainref::reports
