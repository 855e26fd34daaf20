#include "scene/json.h"

#include <cmath>

#include <nlohmann/json.hpp>

namespace rainref::scene {

using Json = nlohmann::ordered_json;

Json value_json(const Value& value) {
  return std::visit([](const auto& v) { return Json(v); }, value);
}

Json config_json(const Config& config) {
  Json out = Json::object();
  for (const Config::Entry& e : config.entries()) out[e.parameter.key] = value_json(e.value);
  return out;
}

Json origins_json(const Config& config) {
  Json out = Json::object();
  for (const Config::Entry& e : config.entries()) out[e.parameter.key] = e.origin.text();
  return out;
}

Json parameters_json(std::span<const Parameter> parameters) {
  const auto bound = [](double v) { return std::isfinite(v) ? Json(v) : Json(); };
  Json out = Json::array();
  for (const Parameter& p : parameters) {
    Json j{{"name", p.key},
           {"type", name(p.type)},
           {"unit", p.unit},
           {"minimum", bound(p.minimum)},
           {"maximum", bound(p.maximum)},
           {"default", p.is_required ? Json() : value_json(p.default_value)},
           {"sentence", p.sentence}};
    if (!p.choices.empty()) j["choices"] = p.choices;
    if (!p.variants.empty()) j["variants"] = p.variants;
    for (const auto& [variant, value] : p.variant_defaults) j["variant_defaults"][variant] = value_json(value);
    out.push_back(std::move(j));
  }
  return out;
}

Json uniform_block_json(const UniformBlock& block) {
  Json members = Json::array();
  for (const Member& m : block.members) {
    members.push_back({{"name", m.name},
                       {"type", name(m.scalar)},
                       {"components", m.components},
                       {"offset", m.offset},
                       {"unit", m.unit},
                       {"sentence", m.sentence}});
  }
  return Json{{"name", block.name}, {"size", block.size}, {"members", std::move(members)}};
}

}  // namespace rainref::scene
