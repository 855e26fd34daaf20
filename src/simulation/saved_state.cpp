// Opened: saving and loading.
#include <algorithm>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "base/floating_point.h"
#include "base/printable.h"
#include "rainref/error.h"
#include "simulation/opened.h"
#include "simulation/picture_notes.h"
#include "state/file.h"

namespace rainref::simulation {
namespace {

// This key only says where a run ends, so it may differ.
constexpr std::string_view may_differ = "run.frames = ";

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    if (!line.starts_with(may_differ)) lines.push_back(line);
    text = end == std::string_view::npos ? std::string_view() : text.substr(end + 1);
  }
  return lines;
}

/// Throws if two texts differ, with the first different lines.
void require_same(const state::Saved& saved, std::string_view theirs, std::string_view ours, const char* what) {
  const std::vector<std::string_view> there = lines_of(theirs), here = lines_of(ours);
  const auto line = [](const std::vector<std::string_view>& lines, std::size_t i) {
    return i < lines.size() ? printable(lines[i]) : std::string("no more");
  };
  for (std::size_t i = 0; i < std::max(there.size(), here.size()); ++i) {
    if (i < there.size() && i < here.size() && there[i] == here[i]) continue;
    throw Error(ExitCode::usage,
                fmt::format("{}: of another {}: expected '{}', found '{}'", saved.origin(), what, line(here, i), line(there, i)));
  }
}

state::Items items_of(effect::Instance& instance) {
  state::Items items;
  instance.list_state(items);
  return items;
}

}  // namespace

void Opened::save(const std::string& note, const state::Sink& sink) const {
  const FloatingPointGuard guard;
  state::write({config_.canonical_text(), inputs_text(inputs_), note}, items_of(*instance_), sink);
}

void Opened::load(const state::Saved& saved) {
  const FloatingPointGuard guard;
  require_same(saved, saved.scene(), config_.canonical_text(), "scene");
  require_same(saved, saved.inputs(), inputs_text(inputs_), "picture");
  const state::Items items = items_of(*instance_);
  state::require_fit(saved, items);
  state::load(saved, items);
}

void Opened::carry_over(const state::Saved& saved, const std::string& key) {
  const FloatingPointGuard guard;
  const state::Items items = items_of(*instance_);
  try {
    state::require_fit(saved, items);
  } catch (const Error& e) {
    throw Error(e.code(), fmt::format("{}: cannot change while the simulation runs: {}", key, e.what()));
  }
  state::load(saved, items);
}

}  // namespace rainref::simulation
