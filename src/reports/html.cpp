#include "reports/html.h"

#include <map>

#include <fmt/format.h>

#include "reports/buffers.h"
#include "reports/json.h"
#include "reports/markup.h"
#include "reports/text.h"

namespace rainref::reports {
namespace {

/// Replaces {{name}} by its value, or by the asset of that name, once, from left to right; inserted text is not searched.
std::string filled(std::string_view text, const std::map<std::string_view, std::string>& values) {
  std::string out;
  for (std::size_t at = 0;;) {
    const std::size_t open = text.find("{{", at), close = text.find("}}", open);
    if (open == std::string_view::npos || close == std::string_view::npos) return out += text.substr(at);
    out += text.substr(at, open - at);
    const std::string_view name = text.substr(open + 2, close - open - 2);
    const auto value = values.find(name);
    out += value == values.end() ? detail::report_asset(name) : value->second;
    at = close + 2;
  }
}

/// JSON inside a script element: "<" occurs only in its strings, and could begin a closing tag.
std::string embedded(std::string_view json) {
  std::string out;
  out.reserve(json.size());
  for (const char c : json) {
    if (c == '<')
      out += "\\u003c";
    else
      out += c;
  }
  return out;
}

}  // namespace

std::string report_html(const judge::PortJudgement& j, int exit_code, const PageSource& source) {
  const std::string title = j.effect.empty() ? "rainref validate" : fmt::format("{} {}, {}", j.effect, j.variant, j.profile);
  return filled(detail::report_asset("report.html"), {{"title", fmt::format("{}: {}", name(j.status), marked_up(title))},
                                                      {"text", marked_up(report_text(j))},
                                                      {"report", embedded(report_json(j, exit_code, source))},
                                                      {"buffers", embedded(buffers_json(j, source))}});
}

}  // namespace rainref::reports
