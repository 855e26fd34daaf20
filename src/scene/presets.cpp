#include "scene/presets.h"

#include <algorithm>
#include <array>
#include <system_error>
#include <tuple>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/path_text.h"
#include "rainref/error.h"
#include "scene/parameter.h"
#include "scene/rows_of_text.h"
#include "scene/toml.h"

namespace rainref::scene {
namespace {

constexpr std::array<std::string_view, 2> kinds{"weather", "light"};

[[noreturn]] void refuse_value(const RawEntry& e, const std::string& what) {
  throw Error(ExitCode::usage, e.value.at, fmt::format("{}: expected {}, found {}", e.key, what, e.value.text()));
}
std::string text_of(const RawEntry& e, const char* what) {
  const auto* text = std::get_if<std::string>(&e.value.data);
  if (!text || text->empty()) refuse_value(e, what);
  return *text;
}

void take_head(const RawEntry& e, Preset& to) {
  if (e.key == "sentence") {
    to.sentence = text_of(e, "a sentence");
  } else if (e.key == "kind") {
    to.kind = text_of(e, "\"weather\" or \"light\"");
    if (std::find(kinds.begin(), kinds.end(), to.kind) == kinds.end()) refuse_value(e, "\"weather\" or \"light\"");
  } else if (e.key == "order") {
    const auto* number = std::get_if<std::int64_t>(&e.value.data);
    if (!number) refuse_value(e, "a whole number");
    to.order = *number;
  } else {
    const std::vector<std::string> known{"kind", "order", "sentence"};
    throw Error(ExitCode::usage, e.at,
                fmt::format("{}: unknown key of a preset; expected one of {} or a table of an effect{}", e.key, fmt::join(known, ", "),
                            did_you_mean(e.key, known)));
  }
}

Preset read_preset(const std::filesystem::path& file) {
  Preset preset;
  preset.name = path_text(file.stem());
  for (RawEntry& e : read_toml(read_scene(file), path_text(file))) {
    const std::size_t dot = e.key.find('.');
    if (dot == std::string::npos) {
      take_head(e, preset);
      continue;
    }
    const std::string effect = e.key.substr(0, dot);
    e.key.erase(0, dot + 1);
    preset.keys[effect].push_back(std::move(e));
  }
  for (const auto& [key, said] : {std::pair("kind", &preset.kind), std::pair("sentence", &preset.sentence)})
    if (said->empty()) throw Error(ExitCode::usage, SourceLocation{path_text(file)}, fmt::format("{}: missing; expected a text", key));
  return preset;
}

[[noreturn]] void refuse_name(const std::string& message) { throw Error(ExitCode::usage, fmt::format("--preset: {}", message)); }

}  // namespace

std::vector<Preset> read_presets(const std::filesystem::path& folder) {
  std::vector<Preset> all;
  std::error_code none;
  if (!folder.empty())
    for (const auto& entry : std::filesystem::directory_iterator(folder, none))
      if (entry.path().extension() == ".toml") all.push_back(read_preset(entry.path()));
  std::sort(all.begin(), all.end(), [](const Preset& a, const Preset& b) {
    const bool is_light_a = a.kind == kinds[1], is_light_b = b.kind == kinds[1];
    return std::tie(is_light_a, a.order, a.name) < std::tie(is_light_b, b.order, b.name);
  });
  return all;
}

std::vector<Preset> presets_for(std::string_view names, std::string_view effect, std::string_view variant,
                                const std::filesystem::path& folder) {
  const std::vector<Preset> all = read_presets(folder);
  if (all.empty()) refuse_name(fmt::format("expected presets beside the bundled scenes, found none, and so no '{}'", names));
  std::vector<std::string> known, of_effect;
  for (const Preset& p : all) {
    known.push_back(p.name);
    if (p.keys.contains(std::string(effect))) of_effect.push_back(p.name);
  }
  std::vector<Preset> out;
  for (const std::string_view name : split(names, ',')) {
    const auto found = std::find_if(all.begin(), all.end(), [&](const Preset& p) { return p.name == name; });
    if (found == all.end())
      refuse_name(fmt::format("expected one of {}, found '{}'{}", fmt::join(known, ", "), name, did_you_mean(name, known)));
    const auto same = std::find_if(out.begin(), out.end(), [&](const Preset& p) { return p.kind == found->kind; });
    if (same != out.end()) refuse_name(fmt::format("expected one preset of {}, found '{}' and '{}'", found->kind, same->name, found->name));
    if (!found->keys.contains(std::string(effect)))
      refuse_name(fmt::format("'{}' does not describe {}; expected one of {}", name, effect,
                              of_effect.empty() ? "none" : fmt::format("{}", fmt::join(of_effect, ", "))));
    if (variant != correct) refuse_name(fmt::format("'{}' is for the variant '{}', found a scene of '{}'", name, correct, variant));
    out.push_back(*found);
  }
  return out;
}

}  // namespace rainref::scene
