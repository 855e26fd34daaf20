#include "reports/junit.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "reports/figures.h"
#include "reports/markup.h"

namespace rainref::reports {
namespace {

using judge::CaseJudgement;
using judge::Cause;
using judge::OutputJudgement;
using judge::PassJudgement;
using judge::PortJudgement;
using judge::Status;

constexpr std::size_t shown_failures = 10;

/// A testcase and its content.
struct Test {
  enum Outcome : std::uint8_t { passed, failed, skipped, error } outcome = passed;
  std::string name, message, text;
  const char* type = "outside";  ///< for a failure
  double seconds = -1;           ///< below 0: not measured
};
struct Suite {
  std::string name;
  std::vector<Test> tests;
  std::string remark;
  double seconds = -1;

  std::int64_t count(Test::Outcome o) const {
    return std::count_if(tests.begin(), tests.end(), [&](const Test& t) { return t.outcome == o; });
  }
};

std::string lines_of(const Cause& c) {
  std::string out;
  for (const std::string& line : line_texts(c)) out += line + "\n";
  return out;
}
std::string failing_text(const PassJudgement& p, const OutputJudgement& o) {
  std::string out = outside_text(p).substr(3) + "\n";  // without "is "
  for (std::size_t k = 0; k < std::min(shown_failures, o.worst.size()); ++k) {
    const FailureText t = failure_text(o, o.worst[k]);
    out += t.got.empty() ? fmt::format("{}: {}\n", t.place, t.distance)
                         : fmt::format("{}  got {}  accepted {}  expected {}  {}\n", t.place, t.got, t.accepted, t.expected, t.distance);
  }
  if (o.failing > static_cast<std::int64_t>(shown_failures))
    out += fmt::format("({} more not shown)\n", o.failing - static_cast<std::int64_t>(shown_failures));
  if (has_unknown_cause(p) && p.causes.empty()) out += "cause unknown\n";
  if (!p.where.empty()) out += fmt::format("where: {}\n", p.where);
  for (const Cause& c : p.causes) out += cause_text(c) + "\n" + lines_of(c);
  return out;
}

/// The message in a list of failures: the extent of the failure, and the first cause in words.
std::string failing_message(const PassJudgement& p, const OutputJudgement& o) {
  const std::string cause = first_cause_text(p);
  return fmt::format("{} of {} {} outside{}{}", o.failing, o.elements, element_word(o), cause.empty() ? "" : "; ", cause);
}

std::string first_line(const std::string& text) { return text.substr(0, text.find('\n')); }
/// Problems with the files of a run.
std::string files_text(const PortJudgement& j, const std::string& id) {
  std::string out;
  for (const judge::FileFault& f : j.files)
    if (f.id == id) out += f.text + "\n";
  return out;
}

Test test_of(const PassJudgement& p, const CaseJudgement& c, const OutputJudgement& o, Test::Outcome untested) {
  Test t;
  t.name = fmt::format("{}/out.{}", c.id, o.name);
  if (o.failing > 0) {
    t.outcome = o.known.empty() ? Test::failed : Test::skipped;
    t.message = failing_message(p, o);
    if (!o.known.empty()) t.message = fmt::format("known: {} ({})", o.known, t.message);
    t.text = failing_text(p, o);
  } else if (c.status == Status::untested) {
    t.outcome = untested;
    t.message = fmt::format("UNTESTED: {}", c.reason);
    t.type = "not judged";
  } else if (!c.reason.empty() && c.status != Status::fail) {
    t.text = fmt::format("{}: {}\n", name(c.status), c.reason);
    for (const Cause& cause : p.causes) t.text += cause_text(cause, "warned") + "\n" + lines_of(cause);
  }
  return t;
}

std::vector<Test> tests_of(const PortJudgement& j, const PassJudgement& p, const CaseJudgement& c, Test::Outcome untested,
                           const Times& times) {
  std::vector<Test> tests;
  if (c.broken) tests.push_back({Test::failed, c.id, c.reason, c.reason, "broken"});
  for (const OutputJudgement& o : c.outputs) tests.push_back(test_of(p, c, o, untested));
  const std::string files = files_text(j, c.id);
  // If the run was judged, they belong to another run of the port.
  if (!files.empty()) tests.push_back({Test::error, c.id, first_line(files), files, "not judged"});
  if (tests.empty()) {
    const bool is_open = c.status == Status::untested || c.status == Status::not_judged;
    const Test::Outcome outcome = is_open ? untested : c.status == Status::data ? Test::skipped : Test::passed;
    tests.push_back({outcome, c.id, outcome == Test::passed ? "" : fmt::format("{}: {}", name(c.status), c.reason),
                     outcome == Test::passed ? c.reason : "", "not judged"});
  }
  // The outputs of a case are judged together: each has an equal share of its time.
  if (const auto time = times.cases.find(c.id); time != times.cases.end())
    for (Test& t : tests) t.seconds = time->second / static_cast<double>(tests.size());
  return tests;
}

Suite suite_of(const PortJudgement& j, const PassJudgement& p, Test::Outcome untested, const Times& times) {
  Suite suite;
  suite.name = fmt::format("{}.{}", j.effect, p.pass);
  if (!times.cases.empty()) {
    const auto causes = times.causes.find(p.pass);
    suite.seconds = causes == times.causes.end() ? 0 : causes->second;
  }
  if ((p.status == Status::untested || p.status == Status::not_judged) && p.cases.empty())
    suite.tests.push_back({untested, p.pass, fmt::format("{}: {}", name(p.status), p.reason), "", "not judged"});
  for (const CaseJudgement& c : p.cases) {
    const std::vector<Test> tests = tests_of(j, p, c, untested, times);
    for (const Test& t : tests) suite.seconds += std::max(t.seconds, 0.0);
    suite.tests.insert(suite.tests.end(), tests.begin(), tests.end());
  }
  // A pass may fail for a reason that belongs to no run: how its stores round, if warnings are failures.
  if (p.status == Status::fail && suite.count(Test::failed) + suite.count(Test::error) == 0)
    suite.tests.push_back({Test::failed, p.pass, p.reason, p.reason, "broken"});
  const Figures f = figures_of(p);
  suite.remark = fmt::format("{} {}\n", name(p.status), p.reason);
  if (f.elements > 0) {
    suite.remark += fmt::format("bounded {}, median width {}, 99 % below {}, ambiguous {}, vacuous {}, loose {}, atypical {}, free {}\n",
                                share_text(f.bounded(), f.sampled()), width_text(f.median_width), width_text(f.p99_width), f.ambiguous,
                                share_text(f.vacuous, f.sampled()), share_text(f.loose, f.sampled()), f.atypical, f.free);
  }
  for (const std::string& text : {sample_text(p), half_text(p)})
    if (!text.empty()) suite.remark += text + "\n";
  return suite;
}

std::string time_xml(double seconds) { return seconds < 0 ? "" : fmt::format(" time=\"{:.3f}\"", seconds); }
std::string test_xml(const Suite& suite, const Test& t) {
  std::string out =
      fmt::format("    <testcase classname=\"{}\" name=\"{}\"{}", marked_up(suite.name), marked_up(t.name), time_xml(t.seconds));
  const std::string message = marked_up(t.message), text = marked_up(t.text);
  switch (t.outcome) {
    case Test::passed:
      return out + (text.empty() ? "/>\n" : fmt::format(">\n      <system-out>{}</system-out>\n    </testcase>\n", text));
    case Test::skipped:
      out += fmt::format(">\n      <skipped message=\"{}\"/>\n", message);
      break;
    case Test::failed:
      out += fmt::format(">\n      <failure type=\"{}\" message=\"{}\">{}</failure>\n", t.type, message, text);
      break;
    case Test::error:
      out += fmt::format(">\n      <error type=\"not judged\" message=\"{}\">{}</error>\n", message, text);
      break;
  }
  return out + "    </testcase>\n";
}

std::string counts_xml(const std::vector<Suite>& suites, bool skipped) {
  double seconds = -1;
  std::int64_t tests = 0, of[4] = {};
  for (const Suite& s : suites) {
    tests += static_cast<std::int64_t>(s.tests.size());
    if (s.seconds >= 0) seconds = std::max(seconds, 0.0) + s.seconds;
    for (const Test::Outcome o : {Test::failed, Test::error, Test::skipped}) of[o] += s.count(o);
  }
  return fmt::format("tests=\"{}\" failures=\"{}\" errors=\"{}\"{}{}", tests, of[Test::failed], of[Test::error],
                     skipped ? fmt::format(" skipped=\"{}\"", of[Test::skipped]) : "", time_xml(seconds));
}

std::string suite_xml(const PortJudgement& j, const Suite& s) {
  std::string out = fmt::format("  <testsuite name=\"{}\" {}>\n    <properties>\n", marked_up(s.name), counts_xml({s}, true));
  for (const auto& [key, value] : {std::pair{"pack", j.pack},
                                   {"port", j.port},
                                   {"profile", j.profile},
                                   {"api", j.api},
                                   {"device", j.device},
                                   {"driver", j.driver},
                                   {"command", j.command}})
    if (!value.empty()) out += fmt::format("      <property name=\"{}\" value=\"{}\"/>\n", key, marked_up(value));
  out += "    </properties>\n";
  for (const Test& t : s.tests) out += test_xml(s, t);
  if (!s.remark.empty()) out += fmt::format("    <system-out>{}</system-out>\n", marked_up(s.remark));
  return out + "  </testsuite>\n";
}

}  // namespace

std::string report_junit(const PortJudgement& j, bool allow_untested, const Times& times) {
  const Test::Outcome untested = forgives_untested(j, allow_untested) ? Test::skipped : Test::failed;
  std::vector<Suite> suites;
  for (const PassJudgement& p : j.passes) suites.push_back(suite_of(j, p, untested, times));
  if (!j.stale.empty()) {
    Suite baseline{"baseline", {}, "", -1};
    for (const std::string& s : j.stale)
      baseline.tests.push_back({Test::failed, s, "no longer fails: remove it from the baseline", s, "baseline"});
    suites.push_back(std::move(baseline));
  }
  // Failures outside all passes: nothing was judged, or the port itself failed.
  const bool shown =
      std::any_of(suites.begin(), suites.end(), [](const Suite& s) { return s.count(Test::failed) + s.count(Test::error) > 0; });
  if (exit_code(j, allow_untested) != 0 && !shown)
    suites.push_back({"validate", {{Test::error, "validate", j.reason, fmt::format("{}", fmt::join(j.notes, "\n"))}}, "", -1});

  std::string out =
      fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites name=\"rainref validate\" {}>\n", counts_xml(suites, false));
  for (const Suite& s : suites) out += suite_xml(j, s);
  return out + "</testsuites>\n";
}

}  // namespace rainref::reports
