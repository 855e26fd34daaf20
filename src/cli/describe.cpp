// `rainref describe`.
#include <algorithm>
#include <functional>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include "base/path_text.h"
#include "cli/commands.h"
#include "cli/json_text.h"
#include "cli/layout_text.h"
#include "cli/scene_file.h"
#include "cli/terminal.h"
#include "foreign/draft.h"
#include "rainref/error.h"
#include "registry/registry.h"
#include "scene/describe.h"
#include "scene/json.h"
#include "scene/key_groups.h"
#include "scene/key_guess.h"
#include "scene/value_text.h"
#include "simulation/describe.h"
#include "simulation/opened.h"
#include "simulation/own_scenes.h"
#include "simulation/picture_notes.h"
#include "simulation/scene_index.h"

namespace rainref::cli {
namespace {

using scene::Parameter;

std::string reads_text(const capture::PassInfo& pass) {
  std::string text;
  for (const capture::ReadInfo& r : pass.reads) {
    text += fmt::format("{}{}{}", text.empty() ? "" : ", ", r.buffer, r.variant.empty() ? "" : fmt::format(" ({})", r.variant));
  }
  return text.empty() ? "nothing" : text;
}
std::vector<std::string> variants_of(const capture::PassInfo& pass) {
  std::vector<std::string> out;
  for (const capture::PassVariant& v : pass.variants) out.push_back(v.name);
  return out;
}

/// A heading and the parameters that `is` takes out of `all`; nothing if there are none.
void say_section(const char* heading, std::vector<Parameter>& all, const std::function<bool(const Parameter&)>& is) {
  const auto rest = std::stable_partition(all.begin(), all.end(), is);
  if (rest != all.begin()) say("{}\n\n{}\n", heading, scene::describe_text({all.data(), static_cast<std::size_t>(rest - all.begin())}));
  all.erase(all.begin(), rest);
}

/// Tables whose keys repeat those of another, which are shown once: takes them out of `all`.
std::string taken_repetitions(const std::string& effect, std::vector<Parameter>& all) {
  std::vector<std::string> tables;
  const auto repeats = [](const Parameter& p) { return !scene::repeated_table(scene::table_of(p.key)).empty(); };
  for (const Parameter& p : all)
    if (const std::string table = scene::table_of(p.key); repeats(p) && (tables.empty() || tables.back() != table)) tables.push_back(table);
  std::erase_if(all, repeats);
  if (tables.empty()) return "";
  return fmt::format("{}.*\n    The keys of {}.* once more: `rainref describe {} {}`.\n\n", fmt::join(tables, ".*, "),
                     scene::repeated_table(tables[0]), effect, tables[0]);
}

void say_effect(const effect::Effect& e, std::vector<Parameter> parameters) {
  say("{}: variants {}\n\n", e.name, fmt::join(e.variants, ", "));
  const std::string repetitions = taken_repetitions(e.name, parameters);
  const auto is_published_alone = [](const Parameter& p) { return p.variants == std::vector<std::string>{scene::published}; };
  say_section("Basic keys", parameters, [&](const Parameter& p) { return scene::is_basic(p.key); });
  say_section("Further keys", parameters, [&](const Parameter& p) { return !is_published_alone(p); });
  say("{}", repetitions);
  say_section("Keys of as-published alone", parameters, is_published_alone);
  say("Passes, in the order of execution\n\n");
  for (const capture::PassInfo& p : e.info->passes) {
    const bool all = p.variants.size() == e.variants.size();
    say("{}{}\n    {}\n    reads {}; writes {}; judged by {}\n", p.name, all ? "" : fmt::format(" ({})", fmt::join(variants_of(p), ", ")),
        p.sentence, reads_text(p), fmt::join(p.writes, ", "), capture::judge_text(p));
  }
  say("\nBuffers\n\n");
  for (const capture::BufferInfo& b : e.info->buffers) {
    say("{:<16} {:<15} {}{}{}\n", b.name, b.format, b.variant.empty() ? "" : b.variant + ": ", b.sentence,
        b.encoding == "none" ? "" : fmt::format(" {}.", b.encoding));
  }
}

/// The keys of a table, or one key.
void say_group(const std::string& effect, const std::string& group, const std::vector<Parameter>& parameters) {
  std::vector<Parameter> found;
  for (const Parameter& p : parameters)
    if (p.key == group || p.key.starts_with(group + ".")) found.push_back(p);
  if (found.empty()) {
    std::vector<std::string> tables;
    for (const Parameter& p : parameters) tables.push_back(scene::table_of(p.key));
    const std::string near = did_you_mean(group, tables);
    throw Error(ExitCode::usage, fmt::format("{}: expected a key or the first part of keys, found '{}'{}", effect, group,
                                             near.empty() ? scene::did_you_mean_key(group, effect, parameters) : near));
  }
  say("{}", scene::describe_text(found));
}

/// What a scene file, or the scene in a picture, says beside the defaults.
int describe_scene(const std::filesystem::path& named, bool json, const std::vector<std::string>& overrides) {
  const std::filesystem::path file = simulation::find_scene(named);
  const scene::Config config = load_scene({file, overrides, 0});
  const std::string sentence = simulation::scene_sentence(simulation::scene_text(file));
  if (json) {
    const nlohmann::ordered_json out{{"scene", path_text(named)},
                                     {"sentence", sentence},
                                     {"values", scene::config_json(config)},
                                     {"origins", scene::origins_json(config)}};
    say("{}\n", json_text(out));
    return 0;
  }
  std::vector<Parameter> own;
  for (const scene::Config::Entry& e : config.entries()) {
    if (!config.given(e.parameter.key) || e.parameter.is_required) continue;
    Parameter p = e.parameter;
    p.sentence += fmt::format(" Default: {}.", scene::value_text(p.default_in(config.variant())));
    p.default_value = e.value;
    p.variants.clear();
    p.variant_defaults.clear();
    own.push_back(std::move(p));
  }
  say("{}{}{}\n\neffect {}, variant {}\n\nKeys that it sets, with its values\n\n{}\nAll keys: rainref describe {}\n", path_text(named),
      sentence.empty() ? "" : ": ", sentence, config.effect(), config.variant(), scene::describe_text(own), config.effect());
  return 0;
}

}  // namespace

int describe_shaders(const std::vector<std::filesystem::path>& shaders) {
  say("{}", foreign::draft_of(shaders));
  return 0;
}

int describe(const std::string& name, const std::string& group, bool json, const LayoutRequest& layout,
             const std::vector<std::string>& overrides) {
  const scene::EffectTable& table = simulation::effect_table();
  const bool has_layout = layout.language || layout.pass || layout.variant;
  if (!group.empty() && (json || has_layout))
    throw Error(ExitCode::usage, fmt::format("{}: expected no group of keys beside it", json ? "--json" : "--layout"));
  // A name with a folder or an ending is a scene's.
  const std::vector<std::string> effects = table.names();
  if (std::find(effects.begin(), effects.end(), name) == effects.end() && name.find_first_of("./\\") != std::string::npos) {
    if (!group.empty() || has_layout)
      throw Error(ExitCode::usage, fmt::format("{}: expected an effect beside {}", name, group.empty() ? "--layout" : "a group of keys"));
    return describe_scene(utf8_path(name), json, overrides);
  }
  const scene::Effect& declared = table.find(name);
  if (!overrides.empty()) throw Error(ExitCode::usage, fmt::format("--preset: expected a scene, found the effect '{}'", name));
  const effect::Effect& e = *registry::find(declared.name);
  if (layout.language) {
    say("{}", layout_text(*e.info, scene::language_from_name(*layout.language), layout.pass, layout.variant));
    return 0;
  }
  if (has_layout) throw Error(ExitCode::usage, fmt::format("{}: only beside --layout", layout.pass ? "--pass" : "--variant"));
  if (json)
    say("{}\n", simulation::describe_json(name));
  else if (group.empty())
    say_effect(e, scene::scene_parameters(declared, table));
  else
    say_group(e.name, group, scene::scene_parameters(declared, table));
  return 0;
}

}  // namespace rainref::cli
