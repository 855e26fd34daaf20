#include "simulation/describe.h"

#include <algorithm>

#include <nlohmann/json.hpp>

#include "registry/registry.h"
#include "scene/json.h"
#include "simulation/opened.h"

namespace rainref::simulation {

std::string describe_json(const std::string& name) {
  const scene::EffectTable& table = effect_table();
  const scene::Effect& declared = table.find(name);
  const effect::Effect& e = *registry::find(declared.name);
  const std::vector<scene::Parameter> parameters = scene::scene_parameters(declared, table);
  nlohmann::ordered_json out{{"effect", e.name}, {"variants", e.variants}, {"parameters", scene::parameters_json(parameters)}};
  for (nlohmann::ordered_json& parameter : out["parameters"]) {
    const std::string key = parameter["name"];
    parameter["makes"] = nlohmann::ordered_json::array();
    for (const effect::Prepared& thing : e.prepared)
      if (key == "effect" || key == "variant" || std::ranges::find(thing.keys, key) != thing.keys.end())
        parameter["makes"].push_back(thing.name);
  }
  out["passes"] = nlohmann::ordered_json::array();
  for (const capture::PassInfo& p : e.info->passes) {
    std::vector<std::string> variants;
    for (const capture::PassVariant& v : p.variants) variants.push_back(v.name);
    nlohmann::ordered_json pass{
        {"name", p.name}, {"sentence", p.sentence}, {"variants", variants}, {"writes", p.writes}, {"judge", capture::judge_text(p)}};
    pass["reads"] = nlohmann::ordered_json::array();
    for (const capture::ReadInfo& r : p.reads) pass["reads"].push_back(r.buffer);
    for (const capture::PassVariant& v : p.variants) pass["formulas"].push_back(capture::formula(*e.info, p, v));
    for (const scene::UniformBlock& block : p.uniforms) pass["uniforms"].push_back(scene::uniform_block_json(block));
    out["passes"].push_back(pass);
  }
  for (const capture::BufferInfo& b : e.info->buffers) {
    out["buffers"].push_back(
        {{"name", b.name}, {"format", b.format}, {"sentence", b.sentence}, {"unit", b.unit}, {"range", b.range}, {"encoding", b.encoding}});
    if (!b.variant.empty()) out["buffers"].back()["variant"] = b.variant;
  }
  for (const scene::UniformBlock& record : e.info->records) out["records"].push_back(scene::uniform_block_json(record));
  return out.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

}  // namespace rainref::simulation
