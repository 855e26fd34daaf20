#include "reports/markdown.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "base/printable.h"
#include "reports/figures.h"
#include "reports/markup.h"
#include "reports/text.h"

namespace rainref::reports {
namespace {

using judge::PassJudgement;
using judge::PortJudgement;

/// Text on one line, in which no character formats anything.
std::string plain(std::string_view text) {
  std::string out;
  for (const char c : marked_up(text)) {
    if (std::string_view("\\`*_[]|~@").find(c) != std::string_view::npos) out += '\\';
    out += c;
  }
  return out;
}

/// Text in a fence that is longer than any run of backticks in it.
std::string fenced(std::string_view text) {
  std::size_t run = 0, longest = 2;
  for (const char c : text) longest = std::max(longest, run = c == '`' ? run + 1 : 0);
  const std::string fence(longest + 1, '`');
  return fmt::format("{0}text\n{1}{0}\n", fence, printable(text));
}

std::string row_of(const PassJudgement& p) {
  const Figures f = figures_of(p);
  const std::string outside = f.invocations > 0 ? fmt::format("{} of {}", f.failing, f.invocations) : "-", cause = first_cause_text(p);
  return fmt::format("| {} | {} | {} | {} |\n", judge::name(p.status), plain(p.pass), outside, plain(cause.empty() ? p.reason : cause));
}

}  // namespace

std::string report_markdown(const PortJudgement& j) {
  std::string out =
      fmt::format("## {}: {} against {}, profile {}\n", judge::name(j.status), plain(j.port), plain(j.pack), plain(j.profile));
  if (!j.reason.empty()) out += fmt::format("\n{}\n", plain(j.reason));
  if (!j.device.empty()) out += fmt::format("\n{} {}{}{}\n", plain(j.api), plain(j.device), j.driver.empty() ? "" : " ", plain(j.driver));
  if (!j.passes.empty()) out += "\n| verdict | pass | invocations outside | why |\n|---|---|---|---|\n";
  for (const PassJudgement& p : j.passes) out += row_of(p);
  return out + fmt::format("\n<details><summary>The whole report</summary>\n\n{}\n</details>\n", fenced(report_text(j)));
}

}  // namespace rainref::reports
