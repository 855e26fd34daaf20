#include "reports/annotations.h"

#include <string_view>

#include <fmt/format.h>

#include "reports/figures.h"

namespace rainref::reports {
namespace {

using judge::PassJudgement;
using judge::PortJudgement;
using judge::Status;

/// Escapes what ends a command's message, and what ends one of its properties.
std::string escaped(std::string_view text, bool is_property) {
  std::string out;
  for (const char c : text) {
    if (c == '%' || c == '\n' || c == '\r' || (is_property && (c == ':' || c == ',')))
      out += fmt::format("%{:02X}", static_cast<unsigned>(c));
    else
      out += c;
  }
  return out;
}

std::string annotation(const char* level, const std::string& of, const std::string& message, const judge::ShaderLine* at = nullptr) {
  const std::string place = at ? fmt::format("file={},line={},", escaped(at->file, true), at->line) : "";
  return fmt::format("::{} {}title={}::{}\n", level, place, escaped(of.empty() ? "rainref" : "rainref: " + of, true),
                     escaped(message, false));
}

std::string annotation_of(const char* level, const PassJudgement& p) {
  const Figures f = figures_of(p);
  std::string message = name(p.status);
  if (f.failing > 0) message += fmt::format(": {} of {} invocations outside", f.failing, f.invocations);
  if (!p.reason.empty()) message += ": " + p.reason;
  if (const std::string cause = first_cause_text(p); !cause.empty()) message += "; " + cause;
  const bool has_line = !p.causes.empty() && !p.causes.front().lines.empty();
  return annotation(level, p.pass, message, has_line ? &p.causes.front().lines.front() : nullptr);
}

}  // namespace

std::string report_annotations(const PortJudgement& j, bool allow_untested) {
  const bool forgives = forgives_untested(j, allow_untested);
  std::string errors, warnings;
  for (const PassJudgement& p : j.passes) {
    const bool is_open = p.status == Status::untested || p.status == Status::not_judged;
    if (p.status == Status::fail || (is_open && !forgives)) errors += annotation_of("error", p);
    if (p.status == Status::warn) warnings += annotation_of("warning", p);
  }
  for (const std::string& stale : j.stale) errors += annotation("error", "baseline", stale);
  if (!j.files.empty()) {
    const std::size_t others = j.files.size() - 1;
    errors += annotation("error", j.files.front().pass, j.files.front().text + (others > 0 ? fmt::format(" (and {} more)", others) : ""));
  }
  // Nothing was judged, or the port itself failed.
  if (errors.empty() && exit_code(j, allow_untested) != 0) errors = annotation("error", "", j.reason);
  return errors + warnings;
}

}  // namespace rainref::reports
