#include "registry/registry.h"

#include <algorithm>
#include <deque>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "edge_splash/instance.h"
#include "puddle/instance.h"
#include "rainref/error.h"
#include "rainy_glass/instance.h"
#include "screen_drops/instance.h"
#include "windshield/instance.h"

namespace rainref::registry {
namespace {

struct Registry {
  std::deque<effect::Effect> owned;  // whose elements stay where they are
  std::vector<const effect::Effect*> all;

  Registry() {
    for (const effect::Effect& e : std::initializer_list<effect::Effect>{puddle::entry(), windshield::entry(), edge_splash::entry(),
                                                                         screen_drops::entry(), rainy_glass::entry()})
      add(e);
  }
  void add(effect::Effect e) {
    owned.push_back(std::move(e));
    all.push_back(&owned.back());
  }
};
Registry& the() {
  static Registry registry;
  return registry;
}

}  // namespace

const std::vector<const effect::Effect*>& effects() { return the().all; }

const effect::Effect* find(std::string_view name) {
  const auto found = std::find_if(effects().begin(), effects().end(), [&](const effect::Effect* e) { return e->name == name; });
  return found == effects().end() ? nullptr : *found;
}

const effect::Effect& effect_of_pack(std::string_view name) {
  if (const effect::Effect* found = find(name)) return *found;
  std::vector<std::string> names;
  for (const effect::Effect* e : effects()) names.push_back(e->name);
  std::sort(names.begin(), names.end());
  throw Error(ExitCode::usage, fmt::format("this build judges {}; the pack is of '{}'", fmt::join(names, ", "), name));
}

void add(effect::Effect effect) {
  if (find(effect.name)) throw Error(ExitCode::internal, fmt::format("two effects are called '{}'", effect.name));
  the().add(std::move(effect));
}

}  // namespace rainref::registry
