#include "scene/toml.h"

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <optional>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/floating_point.h"
#include "base/path_text.h"
#include "base/system.h"
#include "scene/check.h"
#include "scene/key_groups.h"
#include "scene/key_guess.h"
#include "scene/presets.h"
#include "scene/unexercised.h"

namespace rainref::scene {
namespace {

// More than any scene has. The rest is not read, so that a device or a film given by mistake ends at once.
constexpr std::size_t read_limit = (std::size_t{1} << 20) + 1;
constexpr std::size_t longest_shown = 128;

std::string shortened(const std::string& key) { return key.size() <= longest_shown ? key : key.substr(0, longest_shown) + "…"; }

std::vector<Override> split(const std::vector<std::string>& overrides) {
  std::vector<Override> out;
  for (const std::string& o : overrides) {
    const std::size_t equals = o.find('=');
    const std::size_t begin = o.find_first_not_of(' ');
    if (equals == std::string::npos || begin == equals) {
      throw Error(ExitCode::usage, fmt::format("--set {}: expected key=value", shortened(o)));
    }
    out.push_back({o.substr(begin, o.find_last_not_of(' ', equals - 1) + 1 - begin), o.substr(equals + 1), {}});
  }
  return out;
}

Origin origin_of(const Override& o) { return {Origin::override_option, o.at}; }

Value checked(const Override& o, const Parameter& p) {
  if (const auto* value = std::get_if<RawValue>(&o.value)) return checked(*value, p, origin_of(o));
  const std::string& text = std::get<std::string>(o.value);
  const bool wants_text = p.type == Type::text || p.type == Type::choice;
  std::optional<RawValue> raw = read_toml_value(text);
  if (!raw || (wants_text && !std::holds_alternative<std::string>(raw->data))) raw = read_bare_text(text);
  if (!raw) refuse(origin_of(o), o.key, fmt::format("expected {}, found bytes that are not UTF-8", expectation(p)));
  raw->at = {};
  return checked(*raw, p, origin_of(o));
}

class Assembly {
 public:
  Assembly(const Effect& effect, const EffectTable& effects, std::string variant)
      : effect_(effect), effects_(effects), variant_(std::move(variant)) {
    for (Parameter& p : scene_parameters(effect, effects)) {
      const Value value = p.default_in(variant_);
      entries_.push_back({std::move(p), value, {}});
    }
  }

  void take(const RawEntry& raw) {
    if (is_unexercised(raw.key)) return take_unexercised(raw, unexercised_);
    const Origin origin{Origin::file, raw.at};
    const auto inside = [&](const Config::Entry& e) { return e.parameter.key.starts_with(raw.key + "."); };
    if (std::any_of(entries_.begin(), entries_.end(), inside)) {
      if (std::holds_alternative<RawValue::Table>(raw.value.data)) return;  // an empty table says nothing
      const std::string on = raw.key + ".on";
      refuse({Origin::file, raw.value.at}, raw.key,
             fmt::format("expected a table, found {}{}", raw.value.text(), declared(on) ? "; did you mean '" + on + "'?" : ""));
    }
    if (std::holds_alternative<RawValue::Table>(raw.value.data) && !declared(raw.key)) {
      refuse(origin, shortened(raw.key), "unknown table" + foreign(raw.key + "."));
    }
    Config::Entry& entry = find(raw.key, origin);
    entry.value = scene::checked(raw.value, entry.parameter, origin);
    entry.origin = origin;
  }

  void take(const Override& o) {
    Config::Entry& entry = find(o.key, origin_of(o));
    entry.value = checked(o, entry.parameter);
    entry.origin = origin_of(o);
  }

  Config finish(const std::filesystem::path& file) {
    std::vector<Config::Entry> used;
    for (Config::Entry& e : entries_) {
      if (!e.parameter.used_by(variant_)) continue;
      if (e.parameter.is_required && e.origin.kind == Origin::by_default) {
        refuse({Origin::file, {path_text(file)}}, e.parameter.key, "missing; expected " + expectation(e.parameter));
      }
      used.push_back(std::move(e));
    }
    return Config(std::move(used), file.parent_path());
  }

 private:
  Config::Entry& find(const std::string& key, const Origin& origin) {
    for (Config::Entry& e : entries_) {
      if (e.parameter.key != key) continue;
      if (e.parameter.used_by(variant_)) return e;
      refuse(origin, key, fmt::format("not used by variant '{}', only by '{}'", variant_, fmt::join(e.parameter.variants, "', '")));
    }
    refuse(origin, shortened(key), "unknown key" + foreign(key));
  }

  /// For a key (or a table, ending in a dot) that this effect lacks: the other effects that have it, else the nearest valid one.
  std::string foreign(const std::string& key) const {
    const bool is_table = key.ends_with('.');
    std::vector<std::string> owners;
    for (const Effect& other : effects_.effects) {
      const auto is_it = [&](const Parameter& p) { return is_table ? p.key.starts_with(key) : p.key == key; };
      if (&other != &effect_ && std::any_of(other.parameters.begin(), other.parameters.end(), is_it))
        owners.push_back("'" + other.name + "'");
    }
    if (owners.empty() && is_table) return key.size() > longest_shown ? "" : did_you_mean(key.substr(0, key.size() - 1), tables());
    if (owners.empty()) return did_you_mean_key(key, effect_.name, valid());
    return fmt::format(" of '{}'; it is one of {}", effect_.name, fmt::join(owners, " and "));
  }

  bool declared(const std::string& key) const {
    return std::any_of(entries_.begin(), entries_.end(), [&](const Config::Entry& e) { return e.parameter.key == key; });
  }

  // The parameters that this variant uses.
  std::vector<Parameter> valid() const {
    std::vector<Parameter> out;
    for (const Config::Entry& e : entries_)
      if (e.parameter.used_by(variant_)) out.push_back(e.parameter);
    return out;
  }
  // "run", "puddle", …
  std::vector<std::string> tables() const {
    std::vector<std::string> out;
    for (const Parameter& p : valid())
      if (std::string table = table_of(p.key); !table.empty()) out.push_back(std::move(table));
    return out;
  }

  const Effect& effect_;
  const EffectTable& effects_;
  std::string variant_;
  std::vector<Config::Entry> entries_;
  Unexercised unexercised_;  // checked, and not used by a run
};

// The text of `effect` or `variant`; they are read before the rest, because they determine which keys are valid.
std::string deciding(const Parameter& p, const std::vector<RawEntry>& entries, const std::vector<Override>& overrides,
                     const std::filesystem::path& file) {
  for (auto o = overrides.rbegin(); o != overrides.rend(); ++o) {
    if (o->key == p.key) return std::get<std::string>(checked(*o, p));
  }
  for (const RawEntry& e : entries) {
    if (e.key == p.key) return std::get<std::string>(checked(e.value, p, {Origin::file, e.at}));
  }
  refuse({Origin::file, {path_text(file)}}, p.key, "missing; expected " + expectation(p));
}

/// What the presets that the last "preset=..." names say.
std::vector<Override> of_presets(const std::vector<Override>& given, const std::string& effect, const std::string& variant,
                                 const std::filesystem::path& folder) {
  std::vector<Override> out;
  const auto said = std::find_if(given.rbegin(), given.rend(), [](const Override& o) { return o.key == preset_word; });
  if (said == given.rend()) return out;
  const std::string names = std::get<std::string>(checked(*said, text(std::string(preset_word), "", "Names of presets.")));
  try {
    for (const Preset& preset : presets_for(names, effect, variant, folder))
      for (const RawEntry& e : preset.keys.at(effect)) out.push_back({e.key, e.value, e.value.at});
  } catch (const Error& e) {
    throw said->at.file.empty() ? e : Error(e.code(), said->at, e.what());
  }
  return out;
}

bool says(const std::vector<RawEntry>& entries, std::string_view key) {
  return std::any_of(entries.begin(), entries.end(), [&](const RawEntry& e) { return e.key == key; });
}

}  // namespace

std::string read_scene(const std::filesystem::path& file) {
  const SourceLocation at{path_text(file)};
  std::error_code ignored;
  if (std::filesystem::is_directory(file, ignored)) {
    throw Error(ExitCode::io, at, "expected a scene file, found a directory");
  }
  const auto cannot_read = [&](int why) { return Error(ExitCode::io, at, fmt::format("cannot be read: {}", reason_of(why))); };
  const auto close = [](std::FILE* f) { std::fclose(f); };
  const std::unique_ptr<std::FILE, decltype(close)> stream(system::stream_to_read(file), close);
  if (!stream) throw cannot_read(errno);
  std::string text(read_limit, '\0');
  text.resize(std::fread(text.data(), 1, text.size(), stream.get()));
  if (std::ferror(stream.get())) throw cannot_read(errno);
  return text;
}

Config load(const std::filesystem::path& file, const std::vector<std::string>& overrides, const EffectTable& effects) {
  const FloatingPointGuard guard;
  return parse(read_scene(file), file, overrides, effects);
}

Config parse(std::string_view toml, const std::filesystem::path& file, const std::vector<std::string>& overrides,
             const EffectTable& effects) {
  const FloatingPointGuard guard;
  const std::vector<Override> given = split(overrides);
  return parse(read_toml(toml, path_text(file)), file, given, effects);
}

Config parse(const std::vector<RawEntry>& entries, const std::filesystem::path& file, const std::vector<Override>& given,
             const EffectTable& effects) {
  const FloatingPointGuard guard;
  const Effect& effect = effects.find(deciding(effect_parameter(effects), entries, given, file));
  std::string variant = deciding(variant_parameter(effect), entries, given, file);
  const std::vector<Override> preset = of_presets(given, effect.name, variant, effects.presets);
  Assembly assembly(effect, effects, std::move(variant));
  for (const RawEntry& e : entries) assembly.take(e);
  for (const Override& o : preset) assembly.take(o);
  for (const Override& o : given)
    if (o.key != preset_word) assembly.take(o);
  return assembly.finish(file);
}

void give(Config& config, const Override& override) {
  const FloatingPointGuard guard;
  config.set(override.key, checked(override, config.entry(override.key).parameter), origin_of(override));
}

Config parse(const SceneText& scene, const EffectTable& effects) {
  const FloatingPointGuard guard;
  const std::vector<RawEntry> entries = read_toml(scene.toml, scene.file);
  std::vector<std::string> overrides;
  if (!says(entries, "variant")) overrides.push_back("variant=corrected");  // before the caller's own, which override it
  overrides.insert(overrides.end(), scene.set.begin(), scene.set.end());
  return parse(scene.toml, utf8_path(scene.file), overrides, effects);
}

Config parse(const SceneText& scene, const Effect& effect, std::span<const char* const> pictures) {
  const FloatingPointGuard guard;
  std::vector<std::string> overrides;
  const std::vector<RawEntry> entries = read_toml(scene.toml, scene.file);
  // Before the caller's own, which override it.
  if (!says(entries, "effect")) overrides.push_back("effect=" + effect.name);
  if (!says(entries, "variant")) overrides.push_back("variant=" + effect.variants.back());
  overrides.insert(overrides.end(), scene.set.begin(), scene.set.end());
  const Config config = parse(scene.toml, utf8_path(scene.file), overrides, {{effect}});
  for (const char* key : pictures) {
    const bool is_used =
        std::any_of(config.entries().begin(), config.entries().end(), [&](const Config::Entry& e) { return e.parameter.key == key; });
    if (is_used && !config.text(key).empty())
      refuse(config.entry(key).origin, key,
             fmt::format("expected none, for the caller hands in the picture itself, found '{}'", config.text(key)));
  }
  return config;
}

}  // namespace rainref::scene
