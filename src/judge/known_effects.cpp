#include "judge/known_effects.h"

#include <map>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "edge_splash/evaluations.h"
#include "edge_splash/info.h"
#include "edge_splash/parameters.h"
#include "puddle/evaluations.h"
#include "puddle/info.h"
#include "puddle/parameters.h"
#include "rainref/error.h"
#include "rainy_glass/evaluations.h"
#include "rainy_glass/info.h"
#include "rainy_glass/parameters.h"
#include "screen_drops/evaluations.h"
#include "screen_drops/info.h"
#include "screen_drops/parameters.h"
#include "windshield/evaluations.h"
#include "windshield/info.h"
#include "windshield/scene_keys.h"

namespace rainref::judge {
namespace {

const std::map<std::string, KnownEffect, std::less<>>& all() {
  static const std::map<std::string, KnownEffect, std::less<>> effects{
      {"puddle", {&puddle::effect_info(), puddle::parameters(), &puddle::evaluations()}},
      {"windshield", {&windshield::effect_info(), windshield::parameters(), &windshield::evaluations()}},
      {"edge_splash", {&edge_splash::effect_info(), edge_splash::parameters(), &edge_splash::evaluations()}},
      {"screen_drops", {&screen_drops::effect_info(), screen_drops::parameters(), &screen_drops::evaluations()}},
      {"rainy_glass", {&rainy_glass::effect_info(), rainy_glass::parameters(), &rainy_glass::evaluations()}}};
  return effects;
}

}  // namespace

const KnownEffect* find_effect(std::string_view name) {
  const auto found = all().find(name);
  return found == all().end() ? nullptr : &found->second;
}

const KnownEffect& known_effect(std::string_view name) {
  if (const KnownEffect* found = find_effect(name)) return *found;
  std::vector<std::string> names;
  for (const auto& [known, unused] : all()) names.push_back(known);
  throw Error(ExitCode::usage, fmt::format("this build judges {}; the pack is of '{}'", fmt::join(names, ", "), name));
}

}  // namespace rainref::judge
