#include "reports/html.h"

#include <algorithm>
#include <limits>
#include <map>
#include <vector>

#include <fmt/format.h>

#include "rainref/version.h"
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

const PassJudgement* pass_named(const PortJudgement& j, const std::string& name) {
  const auto found = std::find_if(j.passes.begin(), j.passes.end(), [&](const PassJudgement& p) { return p.pass == name; });
  return found == j.passes.end() ? nullptr : &*found;
}

/// What of a pass fails worst, with the way there: the first thing to look at.
std::string opening_html(const PassJudgement& p) {
  const std::vector<const CaseJudgement*> cases = pictured_cases(p);
  if (cases.empty() || cases[0]->failing == 0) return "";
  const std::vector<const OutputJudgement*> outputs = shown_outputs(*cases[0]);
  const QuantityJudgement* worst = outputs.empty() ? nullptr : worst_quantity(*outputs[0]);
  if (!worst) return "";
  const std::string off = worst->farthest <= std::numeric_limits<double>::max()
                              ? fmt::format(", off by up to {}", quantity_text(worst->farthest, worst->unit))
                              : ", not a finite number";
  return fmt::format(" Worst in <a href=\"#{}\">{} of out.{}</a>{}.", marked_up(place_of(*cases[0], *outputs[0])),
                     marked_up(outputs[0]->records ? worst->name : "channel " + worst->name), marked_up(outputs[0]->name), marked_up(off));
}

/// What could not be judged for want of files; "" where all was there.
std::string open_html(const PortJudgement& j) {
  std::string out;
  if (!j.files.empty())
    out +=
        fmt::format(" <a href=\"#files\">{} file{}</a> missing, or cannot be used.", j.files.size(), j.files.size() == 1 ? " is" : "s are");
  std::string passes;
  for (const std::string& pass : not_judged(j))
    passes += fmt::format("{0}<a href=\"#pass-{1}\">{1}</a>", passes.empty() ? "" : ", ", marked_up(pass));
  return passes.empty() ? out : out + " Not judged: " + passes + ".";
}

/// The one sentence that a reader in a hurry needs.
std::string summary_html(const PortJudgement& j) {
  Figures all;
  for (const PassJudgement& p : j.passes) {
    const Figures f = figures_of(p);
    all.elements += f.elements;
    all.differing += f.differing;
  }
  if (const PassJudgement* bad = pass_named(j, j.first_bad_pass)) {
    const Figures f = figures_of(*bad);
    std::string out = fmt::format("<a href=\"#pass-{0}\">{0}</a> is the first bad pass: ", marked_up(bad->pass));
    if (is_broken(*bad))
      out += marked_up(bad->reason) + ".";
    else if (f.outside > 0)
      out += fmt::format("{} of {} invocations ({}) stored what <b>{}</b> does not allow.", f.failing, f.invocations,
                         share_text(f.failing, f.invocations), marked_up(j.profile));
    else
      out += marked_up(bad->reason) + ".";
    std::string others;
    for (const PassJudgement& p : j.passes)
      if (p.status == Status::fail && &p != bad)
        others += fmt::format("{0} <a href=\"#pass-{1}\">{1}</a>", others.empty() ? " Also fail:" : ",", marked_up(p.pass));
    if (!others.empty()) others += ".";
    out += opening_html(*bad);
    if (!bad->where.empty()) out += fmt::format(" Where: {}.", marked_up(bad->where));
    if (bad->causes.empty()) return out + (has_unknown_cause(*bad) ? " The cause is unknown." : "") + others;
    const Cause& c = bad->causes[0];
    return out + fmt::format(" {} <b>{}</b>, {} (gives {} of {} failing {} bit for bit, comes near {}).{}",
                             c.is_likely ? "Likely cause:" : "The cause may be", marked_up(c.name), marked_up(c.sentence), c.explained,
                             c.of, element_word(c), c.inside, others);
  }
  if (!j.reason.empty()) return marked_up(j.reason) + ".";
  const std::string equal =
      fmt::format("{} of the elements have the reference's own bits.", share_text(all.elements - all.differing, all.elements));
  switch (j.status) {
    case Status::pass:
      return fmt::format("Every judged element lies inside what <b>{}</b> allows. {}", marked_up(j.profile), equal);
    case Status::warn:
      return fmt::format("Every judged element lies inside what <b>{}</b> allows, with remarks. {}", marked_up(j.profile), equal);
    case Status::known:
      return "Everything that fails is listed in the baseline, with its reason.";
    default:
      break;
  }
  std::string out;
  for (const PassJudgement& p : j.passes)
    if (p.status == Status::untested && !p.reason.empty())
      out += fmt::format("{0}<a href=\"#pass-{1}\">{1}</a>: {2}.", out.empty() ? "" : " ", marked_up(p.pass), marked_up(p.reason));
  return out.empty() ? "" : "Too little could be judged. " + out;
}

std::string facts_html(const PortJudgement& j) {
  std::string out = "<dl class=\"facts\">\n";
  const auto fact = [&](const char* key, const std::string& value) {
    if (!value.empty()) out += fmt::format("<div><dt>{}</dt><dd>{}</dd></div>\n", key, marked_up(value));
  };
  fact("effect", j.variant.empty() ? j.effect : fmt::format("{}, {}", j.effect, j.variant));
  fact("scene", j.scene);
  fact("profile", j.profile);
  fact("API", j.api);
  fact("device", j.device);
  fact("driver", j.driver);
  fact("pack", j.pack);
  fact("port", j.port);
  fact("judged by", fmt::format("rainref {}, golden generation {}", version(), golden_generation));
  out += "</dl>\n";
  if (!j.command.empty())
    out += fmt::format("<p class=\"command\"><span class=\"dim\">Reproduce:</span> <code>{}</code></p>\n", marked_up(j.command));
  return out;
}

std::string overview_html(const PortJudgement& j) {
  std::vector<std::vector<std::string>> rows;
  for (const PassJudgement& p : j.passes) {
    const Figures f = figures_of(p);
    const std::string link = fmt::format("<a href=\"#pass-{0}\">{0}</a>", marked_up(p.pass));
    if (f.elements == 0)
      rows.push_back({status_pill(p.status), link, "nothing judged", "-", "-", "-", "-", "-", "-", "-"});
    else
      rows.push_back({status_pill(p.status), link, fmt::format("{} of {}", f.failing, f.invocations), share_text(f.differing, f.elements),
                      share_text(f.bounded(), f.judged()), width_text(f.median_width), width_text(f.p99_width),
                      fmt::format("{}", f.ambiguous), share_text(f.vacuous, f.judged()), share_text(f.loose, f.judged())});
  }
  return table_html(
      "figures", {"verdict", "pass", "invocations outside", "differ", "bounded", "median width", "99 %", "ambiguous", "vacuous", "loose"},
      rows, 2);
}

/// Everything between the banner and the help. Pictures of failing passes are drawn first, so that these get them.
std::string body_html(const PortJudgement& j, const PageSource& source) {
  std::size_t budget = picture_budget;
  std::vector<std::string> sections(j.passes.size());
  for (const bool failing : {true, false}) {
    for (std::size_t k = 0; k < j.passes.size(); ++k) {
      const Status s = j.passes[k].status;
      if ((s == Status::fail || s == Status::known) == failing) sections[k] = pass_html(j.passes[k], j, source, budget);
    }
  }
  std::string out;
  for (const std::string& s : j.stale) out += fmt::format("<p class=\"stale\"><b>Baseline:</b> {}</p>\n", marked_up(s));
  if (!j.files.empty()) {
    out += "<section id=\"files\"><h2>Missing, or cannot be used</h2>\n<ul>\n";
    for (const judge::FileFault& f : j.files) out += fmt::format("<li>{}</li>\n", marked_up(f.text));
    out += "</ul></section>\n";
  }
  // What went wrong first stands first.
  for (std::size_t k = 0; k < sections.size(); ++k)
    if (j.passes[k].pass == j.first_bad_pass) out += sections[k];
  if (!j.notes.empty()) {
    out += "<section><h2>Notes</h2>\n<ul>\n";
    for (const std::string& n : j.notes) out += fmt::format("<li>{}</li>\n", marked_up(n));
    out += "</ul></section>\n";
  }
  if (!j.passes.empty()) {
    out += "<section id=\"dataflow\"><h2>Dataflow</h2>\n" + graph_html(j, source.edges) + "</section>\n";
    out += "<section id=\"overview\"><h2>How much each verdict is worth</h2>\n" + overview_html(j) + "</section>\n";
  }
  for (std::size_t k = 0; k < sections.size(); ++k)
    if (j.passes[k].pass != j.first_bad_pass) out += sections[k];
  return out;
}

/// Replaces {{name}} by its value, once, from left to right; values are not looked into.
std::string filled(std::string_view text, const std::map<std::string, std::string, std::less<>>& values) {
  std::string out;
  for (std::size_t at = 0;;) {
    const std::size_t open = text.find("{{", at), close = text.find("}}", open);
    if (open == std::string_view::npos || close == std::string_view::npos) return out += text.substr(at);
    out += text.substr(at, open - at);
    out += values.at(std::string(text.substr(open + 2, close - open - 2)));
    at = close + 2;
  }
}

}  // namespace

std::string status_class(Status status) {
  constexpr const char* names[] = {"is-pass", "is-warn", "is-fail", "is-untested", "is-known", "is-data", "is-not-judged"};
  return names[static_cast<int>(status)];
}
std::string status_pill(Status status) { return fmt::format("<span class=\"pill {}\">{}</span>", status_class(status), name(status)); }

std::string table_html(std::string_view css_class, const std::vector<std::string>& head, const std::vector<std::vector<std::string>>& rows,
                       std::size_t words) {
  std::string out = fmt::format("<div class=\"scroll\"><table class=\"{}\"><thead><tr>", css_class);
  const auto cell = [&](const char* tag, std::size_t k, const std::string& text) {
    out += fmt::format("<{0}{1}>{2}</{0}>", tag, k < words ? "" : " class=\"n\"", text);
  };
  for (std::size_t k = 0; k < head.size(); ++k) cell("th", k, head[k]);
  out += "</tr></thead><tbody>\n";
  for (const std::vector<std::string>& row : rows) {
    out += "<tr>";
    for (std::size_t k = 0; k < row.size(); ++k) cell("td", k, row[k]);
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string report_html(const PortJudgement& j, const PageSource& source) {
  const std::string title = j.effect.empty() ? "rainref validate" : fmt::format("{} {}, {}", j.effect, j.variant, j.profile);
  return filled(detail::report_asset("report.html"), {{"title", fmt::format("{}: {}", name(j.status), marked_up(title))},
                                                      {"css", std::string(detail::report_asset("report.css"))},
                                                      {"js", std::string(detail::report_asset("report.js"))},
                                                      {"class", status_class(j.status)},
                                                      {"verdict", name(j.status)},
                                                      {"summary", summary_html(j) + open_html(j)},
                                                      {"counts", count_text(j)},
                                                      {"facts", facts_html(j)},
                                                      {"body", body_html(j, source)}});
}

}  // namespace rainref::reports
