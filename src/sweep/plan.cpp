#include "sweep/plan.h"

#include <algorithm>
#include <array>
#include <functional>
#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/number_text.h"
#include "base/path_text.h"
#include "judge/profiles.h"
#include "simulation/own_scenes.h"
#include "sweep/axes.h"

namespace rainref::sweep {
namespace {

using scene::RawEntry;
using scene::RawValue;

constexpr std::array verb_names{"run", "hash", "pack", "validate", "mutate"};
constexpr std::int64_t most_frames = 1'000'000;

[[noreturn]] void refuse(const SourceLocation& at, const std::string& key, const std::string& message) {
  throw Error(ExitCode::usage, at, fmt::format("{}: {}", key, message));
}
[[noreturn]] void refuse_unexpected(const RawEntry& e, const std::string& what) {
  refuse(e.value.at, e.key, fmt::format("expected {}, found {}", what, e.value.text()));
}

std::string text_of(const RawEntry& e, const char* what) {
  const auto* text = std::get_if<std::string>(&e.value.data);
  if (!text || text->empty()) refuse_unexpected(e, what);
  return *text;
}
std::int64_t whole_of(const RawValue& v, const RawEntry& e, std::int64_t low, std::int64_t high) {
  const auto* number = std::get_if<std::int64_t>(&v.data);
  if (!number || *number < low || *number > high)
    refuse(v.at, e.key, fmt::format("expected a whole number from {} to {}, found {}", low, high, v.text()));
  return *number;
}
/// A text, or a list of texts.
std::vector<Placed> texts_of(const RawEntry& e, const char* what) {
  std::vector<Placed> out;
  const auto take = [&](const RawValue& v) {
    const auto* text = std::get_if<std::string>(&v.data);
    if (!text || text->empty()) refuse(v.at, e.key, fmt::format("expected {}, found {}", what, v.text()));
    out.push_back({*text, v.at});
  };
  if (const auto* list = std::get_if<std::vector<RawValue>>(&e.value.data)) {
    for (const RawValue& v : *list) take(v);
  } else {
    take(e.value);
  }
  if (out.empty()) refuse_unexpected(e, what);
  return out;
}
std::vector<std::string> words_of(const RawEntry& e, const char* what) {
  std::vector<std::string> out;
  for (const Placed& p : texts_of(e, what)) out.push_back(p.text);
  return out;
}

/// 120, or "40..119", with both ends included.
void take_frames(const RawEntry& e, Plan& plan) {
  std::int64_t frames = 0;
  if (const auto* text = std::get_if<std::string>(&e.value.data)) {
    const std::size_t dots = text->find("..");
    const auto number = [&](std::size_t from, std::size_t count) {
      return whole_from<std::int64_t>(std::string_view(*text).substr(from, count));
    };
    const auto first = dots == std::string::npos ? std::nullopt : number(0, dots),
               last = first ? number(dots + 2, text->npos) : std::nullopt;
    if (!last || *first < 0 || *last < *first || *last >= most_frames)
      refuse_unexpected(e, fmt::format("a number of frames from 1 to {}, or \"FIRST..LAST\"", most_frames));
    plan.first = *first;
    frames = *last + 1;
  } else {
    frames = whole_of(e.value, e, 1, most_frames);
  }
  RawValue value;
  value.data = frames;
  value.at = e.value.at;
  plan.set.push_back({"run.frames", value, e.at});
}

/// "640x360".
void take_size(const RawEntry& e, Plan& plan) {
  const auto* text = std::get_if<std::string>(&e.value.data);
  std::array<std::int64_t, 2> size{};
  const std::size_t x = text ? text->find('x') : std::string::npos;
  const auto number = [&](std::size_t from, std::size_t to, std::int64_t& n) {
    n = whole_from<std::int64_t>(std::string_view(*text).substr(from, to - from)).value_or(0);
    return n >= 1 && n <= 65536;
  };
  if (x == std::string::npos || !number(0, x, size[0]) || !number(x + 1, text->size(), size[1]))
    refuse_unexpected(e, "WxH such as \"640x360\"");
  RawValue value;
  value.data = std::vector<RawValue>{{size[0], e.value.at}, {size[1], e.value.at}};
  value.at = e.value.at;
  plan.set.push_back({"run.size", value, e.at});
}

/// The path of a scene's file relative to the plan; if there is none, the bundled scene of this name.
std::filesystem::path scene_file(const Plan& plan, const std::string& named) {
  const std::filesystem::path beside = plan.file.parent_path() / utf8_path(named);
  std::error_code none;
  if (std::filesystem::exists(beside, none)) return beside;
  const std::filesystem::path own = simulation::own_scene(utf8_path(named));
  return own.empty() ? beside : own;
}

/// A key of the plan, with its verbs and its parser.
struct Key {
  std::vector<Verb> verbs;  ///< empty: all
  std::function<void(const RawEntry&, Plan&)> take;
};
const std::map<std::string, Key>& keys() {
  static const std::vector<Verb> simulate{Verb::run, Verb::hash}, scenes{Verb::run, Verb::hash, Verb::pack},
      judge{Verb::validate, Verb::mutate}, validate{Verb::validate}, pack{Verb::pack};
  const auto scene_files = [](const RawEntry& e, Plan& plan) {
    for (const Placed& p : texts_of(e, "the file of a scene, or a list of them"))
      plan.scenes.push_back({path_text(scene_file(plan, p.text)), p.at, p.text});
  };
  static const std::map<std::string, Key> all{
      {"verb", {{}, [](const RawEntry&, Plan&) {}}},
      {"scene", {scenes, scene_files}},
      {"frames", {scenes, take_frames}},
      {"size", {scenes, take_size}},
      {"chunk", {simulate, [](const RawEntry& e, Plan& plan) { plan.chunk = whole_of(e.value, e, 1, most_frames); }}},
      {"state_every", {simulate, [](const RawEntry& e, Plan& plan) { plan.state_every = whole_of(e.value, e, 1, most_frames); }}},
      {"keep",
       {simulate,
        [](const RawEntry& e, Plan& plan) {
          for (const Placed& p : texts_of(e, "a list of what to keep")) plan.keep.push_back(keep_from(p.text, p.at));
        }}},
      {"tries", {{}, [](const RawEntry& e, Plan& plan) { plan.tries = whole_of(e.value, e, 1, 100); }}},
      {"at",
       {pack,
        [](const RawEntry& e, Plan& plan) {
          const auto* list = std::get_if<std::vector<RawValue>>(&e.value.data);
          if (!list || list->empty()) refuse_unexpected(e, "a list of frames");
          for (const RawValue& v : *list) plan.pack.at.push_back(whole_of(v, e, 0, most_frames));
        }}},
      {"passes", {pack, [](const RawEntry& e, Plan& plan) { plan.pack.passes = words_of(e, "a list of passes"); }}},
      {"pack",
       {judge,
        [](const RawEntry& e, Plan& plan) {
          for (const Placed& p : texts_of(e, "the folder of a pack, or a list of them"))
            plan.judging.packs.push_back(
                {path_text(std::filesystem::absolute(plan.file.parent_path() / utf8_path(p.text)).lexically_normal()), p.at, p.text});
        }}},
      {"profile",
       {judge,
        [](const RawEntry& e, Plan& plan) {
          const std::vector<std::string> known = judge::profile_names();
          for (const Placed& p : texts_of(e, "the name of a profile, or a list of them")) {
            if (std::find(known.begin(), known.end(), p.text) == known.end())
              refuse(p.at, e.key,
                     fmt::format("expected one of {}, found '{}'{}", fmt::join(known, ", "), p.text, did_you_mean(p.text, known)));
            plan.judging.profiles.push_back(p);
          }
        }}},
      {"exec", {validate, [](const RawEntry& e, Plan& plan) { plan.judging.exec = text_of(e, "a command"); }}},
      {"port",
       {validate,
        [](const RawEntry& e, Plan& plan) {
          plan.judging.port =
              path_text(std::filesystem::absolute(plan.file.parent_path() / utf8_path(text_of(e, "a folder"))).lexically_normal());
        }}},
      {"timeout", {validate, [](const RawEntry& e, Plan& plan) { plan.judging.timeout = whole_of(e.value, e, 1, 1000000); }}},
      {"repeat", {validate, [](const RawEntry& e, Plan& plan) { plan.judging.repeat = whole_of(e.value, e, 1, 1000); }}},
      {"only", {judge, [](const RawEntry& e, Plan& plan) { plan.judging.only = words_of(e, "a list of passes"); }}},
      {"label", {judge, [](const RawEntry& e, Plan& plan) { plan.judging.label = text_of(e, "a name"); }}},
  };
  return all;
}

Verb verb_of(const std::vector<RawEntry>& entries, const std::filesystem::path& file) {
  const auto said = std::find_if(entries.begin(), entries.end(), [](const RawEntry& e) { return e.key == "verb"; });
  if (said == entries.end())
    throw Error(ExitCode::usage, SourceLocation{path_text(file)},
                fmt::format("verb: missing; expected one of {}", fmt::join(verb_names, ", ")));
  const std::string word = text_of(*said, "a verb");
  for (std::size_t i = 0; i < verb_names.size(); ++i)
    if (word == verb_names[i]) return static_cast<Verb>(i);
  const std::vector<std::string> known(verb_names.begin(), verb_names.end());
  refuse(said->value.at, "verb", fmt::format("expected one of {}, found '{}'{}", fmt::join(known, ", "), word, did_you_mean(word, known)));
}

void take(const RawEntry& e, Plan& plan) {
  const auto found = keys().find(e.key);
  if (found == keys().end()) {
    std::vector<std::string> known{"set", "axes"};
    for (const auto& [key, unused] : keys()) known.push_back(key);
    refuse(e.at, e.key.substr(0, 100), "unknown key of a plan" + (e.key.size() > 100 ? "" : did_you_mean(e.key, known)));
  }
  const Key& key = found->second;
  if (!key.verbs.empty() && std::find(key.verbs.begin(), key.verbs.end(), plan.verb) == key.verbs.end()) {
    std::vector<std::string> verbs;
    for (const Verb v : key.verbs) verbs.emplace_back(name(v));
    refuse(e.at, e.key, fmt::format("not used by verb '{}', only by '{}'", name(plan.verb), fmt::join(verbs, "', '")));
  }
  key.take(e, plan);
}

void require_whole(const Plan& plan) {
  const auto missing = [&](const char* key, const char* what) {
    throw Error(ExitCode::usage, SourceLocation{path_text(plan.file)}, fmt::format("{}: missing; expected {}", key, what));
  };
  const bool is_judging = plan.verb == Verb::validate || plan.verb == Verb::mutate;
  if (!is_judging && plan.scenes.empty()) missing("scene", "the file of a scene, or a list of them");
  if (is_judging && plan.judging.packs.empty()) missing("pack", "the folder of a pack, or a list of them");
  if (is_judging && !plan.axes.empty())
    throw Error(ExitCode::usage, SourceLocation{path_text(plan.file)},
                fmt::format("axes: not used by verb '{}', whose cells are its packs and profiles", name(plan.verb)));
  if (plan.verb == Verb::validate && plan.judging.exec.empty() && plan.judging.port.empty())
    missing("exec", "a port's command, or port, the folder of its outputs");
}

}  // namespace

const char* name(Verb verb) { return verb_names[static_cast<std::size_t>(verb)]; }

Plan read_plan(const std::filesystem::path& file) {
  const std::vector<RawEntry> entries = scene::read_toml(scene::read_scene(file), path_text(file));
  Plan plan;
  plan.file = file;
  if (const std::string name = plan.name(); name == "." || name == "..")
    throw Error(ExitCode::usage, SourceLocation{path_text(file)},
                fmt::format("expected a file whose name without .toml is that of a folder, found '{}'", name));
  plan.verb = verb_of(entries, file);
  std::vector<RawEntry> axes;
  for (const RawEntry& e : entries) {
    if (e.key == "set" || e.key == "axes") {
      if (!std::holds_alternative<RawValue::Table>(e.value.data)) refuse_unexpected(e, "a table");
    } else if (e.key.starts_with("set.")) {
      const std::string key = unquoted(e.key.substr(4));
      plan.set.push_back({key, e.value, e.at});
    } else if (e.key.starts_with("axes.")) {
      axes.push_back(e);
      axes.back().key.erase(0, 5);
    } else {
      take(e, plan);
    }
  }
  plan.axes = axes_from(axes, file.parent_path());
  for (const Axis& axis : plan.axes) {
    for (const std::string& key : axis.keys) {
      const auto same = std::find_if(plan.set.begin(), plan.set.end(), [&](const scene::Override& o) { return o.key == key; });
      if (same != plan.set.end()) throw Error(ExitCode::usage, same->at, fmt::format("{}: is an axis too", key));
    }
  }
  if (plan.verb == Verb::hash && plan.keep.empty()) plan.keep.push_back(keep_from("hash", {}));
  if (plan.verb == Verb::run && plan.keep.empty()) plan.keep.push_back(keep_from("picture", {}));
  if ((plan.verb == Verb::validate || plan.verb == Verb::mutate) && plan.judging.profiles.empty())
    plan.judging.profiles.push_back({"vulkan", {}});
  require_whole(plan);
  return plan;
}

}  // namespace rainref::sweep
