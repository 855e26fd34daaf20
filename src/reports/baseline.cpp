#include "reports/baseline.h"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/path_text.h"
#include "base/read_file.h"
#include "judge/conclude.h"
#include "scene/toml_reader.h"

namespace rainref::reports {
namespace {

using judge::CaseJudgement;
using judge::OutputJudgement;
using judge::PassJudgement;
using judge::PortJudgement;
using judge::Status;

/// The parts of a dotted key; a quoted part without its quotes. read_toml writes them as TOML does.
std::vector<std::string> parts_of(const std::string& key) {
  std::vector<std::string> parts{""};
  char quote = 0;
  for (std::size_t i = 0; i < key.size(); ++i) {
    const char c = key[i];
    if (quote == '"' && c == '\\' && i + 1 < key.size())
      parts.back() += key[++i];
    else if (c == quote)
      quote = 0;
    else if (!quote && (c == '"' || c == '\''))
      quote = c;
    else if (!quote && c == '.')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

bool is_blank(const std::string& text) { return text.find_first_not_of(" \t\r\n") == std::string::npos; }

[[noreturn]] void refuse(const SourceLocation& at, const std::string& what, const std::string& found,
                         const std::vector<std::string>& known) {
  const std::size_t shown = std::min<std::size_t>(known.size(), 8);
  const std::string more = known.size() > shown ? fmt::format(" and {} more", known.size() - shown) : "";
  throw Error(ExitCode::usage, at,
              fmt::format("expected {} ({}{}), found '{}'{}", what,
                          fmt::join(known.begin(), known.begin() + static_cast<std::ptrdiff_t>(shown), ", "), more, found,
                          did_you_mean(found, known)));
}

}  // namespace

std::string Baseline::Entry::text() const {
  return id.empty() ? fmt::format("[{}.{}]", pass, output) : fmt::format("[{}.{}.\"{}\"]", pass, output, id);
}

Baseline Baseline::read(const std::filesystem::path& file) {
  const std::vector<std::byte> bytes = read_file(file, {std::uint64_t{1} << 20, ExitCode::usage});
  return parse({reinterpret_cast<const char*>(bytes.data()), bytes.size()}, path_text(file));
}

Baseline Baseline::parse(std::string_view toml, const std::string& file) {
  Baseline baseline;
  for (const scene::RawEntry& e : scene::read_toml(toml, file)) {
    std::vector<std::string> parts = parts_of(e.key);
    if (std::holds_alternative<scene::RawValue::Table>(e.value.data)) {
      if (parts.size() == 2 || parts.size() == 3)
        throw Error(ExitCode::usage, e.at, fmt::format("[{}]: expected a reason, found none", e.key));
      throw Error(ExitCode::usage, e.at, fmt::format("expected a table [PASS.OUTPUT] or [PASS.OUTPUT.\"CASE\"], found [{}]", e.key));
    }
    const std::string key = parts.back();
    parts.pop_back();
    if (parts.size() != 2 && parts.size() != 3)
      throw Error(ExitCode::usage, e.at,
                  fmt::format("expected 'reason' in a table [PASS.OUTPUT] or [PASS.OUTPUT.\"CASE\"], found '{}'", e.key));
    if (key != "reason")
      throw Error(ExitCode::usage, e.at,
                  fmt::format("expected 'reason' alone, found '{}'{}", key, did_you_mean(key, std::vector<std::string>{"reason"})));
    const auto* reason = std::get_if<std::string>(&e.value.data);
    if (!reason || is_blank(*reason))
      throw Error(ExitCode::usage, e.at, fmt::format("reason: expected a text that says why, found {}", e.value.text()));
    baseline.entries_.push_back({parts[0], parts[1], parts.size() == 3 ? parts[2] : "", *reason, e.at});
  }
  return baseline;
}

void Baseline::check(const std::vector<capture::PackPass>& all, const std::vector<std::string>& ids) const {
  std::vector<std::string> passes;
  for (const capture::PackPass& p : all) passes.push_back(p.name);
  for (const Entry& e : entries_) {
    const auto pass = std::find(passes.begin(), passes.end(), e.pass);
    if (pass == passes.end()) refuse(e.at, "a pass", e.pass, passes);
    const std::vector<std::string>& outputs = all[static_cast<std::size_t>(pass - passes.begin())].writes;
    if (std::find(outputs.begin(), outputs.end(), e.output) == outputs.end())
      refuse(e.at, fmt::format("an output of {}", e.pass), e.output, outputs);
    if (e.id.empty()) continue;
    std::vector<std::string> cases;
    for (const std::string& id : ids)
      if (id.find("." + e.pass + "/") != std::string::npos) cases.push_back(id);
    if (std::find(cases.begin(), cases.end(), e.id) == cases.end()) refuse(e.at, fmt::format("a case of {}", e.pass), e.id, cases);
  }
}

void Baseline::apply(PortJudgement& j) const {
  std::vector<bool> used(entries_.size(), false);
  const auto entry_for = [&](const std::string& pass, const std::string& output, const std::string& id) -> const Entry* {
    const auto listed = [&](const std::string& which) {
      return std::find_if(entries_.begin(), entries_.end(),
                          [&](const Entry& e) { return e.pass == pass && e.output == output && e.id == which; });
    };
    auto found = listed(id);
    if (found == entries_.end()) found = listed("");
    if (found == entries_.end()) return nullptr;
    used[static_cast<std::size_t>(found - entries_.begin())] = true;
    return &*found;
  };

  bool changed = false;
  for (PassJudgement& p : j.passes) {
    if (p.status != Status::fail) continue;
    Status status = Status::pass;
    for (CaseJudgement& c : p.cases) {
      bool all_known = c.failing > 0 && !c.broken;
      for (OutputJudgement& o : c.outputs) {
        if (o.failing == 0) continue;
        if (const Entry* e = entry_for(p.pass, o.name, c.id)) o.known = e->reason;
        all_known &= !o.known.empty();
      }
      if (all_known) c.status = Status::known;
      status = worse(status, c.status);
    }
    changed |= status != p.status;
    p.status = status;
  }
  if (changed) {
    const auto first = std::find_if(j.passes.begin(), j.passes.end(), [&](const PassJudgement& p) { return p.pass == j.first_bad_pass; });
    if (first != j.passes.end() && first->status != Status::fail) j.first_bad_pass.clear();
    conclude(j);
  }
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const bool judged = std::any_of(j.passes.begin(), j.passes.end(), [&](const PassJudgement& p) {
      if (p.pass != entries_[k].pass) return false;
      const std::string& id = entries_[k].id;
      const auto was_judged = [&](const CaseJudgement& c) { return c.status != Status::not_judged; };
      return id.empty() ? !p.cases.empty() && std::all_of(p.cases.begin(), p.cases.end(), was_judged)
                        : std::any_of(p.cases.begin(), p.cases.end(), [&](const CaseJudgement& c) { return c.id == id && was_judged(c); });
    });
    if (!used[k] && judged)
      j.stale.push_back(
          fmt::format("{}: {} no longer fails (\"{}\"): remove the entry", entries_[k].at.text(), entries_[k].text(), entries_[k].reason));
  }
  if (!j.stale.empty()) {
    j.status = Status::fail;
    if (j.reason.empty())
      j.reason = fmt::format("the baseline lists {} failure{} that no longer happen{}", j.stale.size(), j.stale.size() == 1 ? "" : "s",
                             j.stale.size() == 1 ? "s" : "");
  }
}

}  // namespace rainref::reports
