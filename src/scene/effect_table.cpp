#include "scene/effect_table.h"

#include <fmt/format.h>

#include "rainref/error.h"

namespace rainref::scene {

std::vector<std::string> EffectTable::names() const {
  std::vector<std::string> out;
  for (const Effect& effect : effects) out.push_back(effect.name);
  return out;
}

const Effect& EffectTable::find(std::string_view name) const {
  for (const Effect& effect : effects) {
    if (effect.name == name) return effect;
  }
  throw Error(ExitCode::usage,
              fmt::format("effect: expected {}, found '{}'{}", expectation(effect_parameter(*this)), name, did_you_mean(name, names())));
}

Parameter effect_parameter(const EffectTable& table) {
  return choice("effect", table.names(), "", "The effect that the scene simulates.").required();
}

Parameter variant_parameter(const Effect& effect) {
  return choice("variant", effect.variants, "",
                "The arithmetic of the effect: that of its source with all defects, or with every known defect corrected.")
      .required();
}

std::vector<Parameter> scene_parameters(const Effect& effect, const EffectTable& table) {
  std::vector<Parameter> out{
      effect_parameter(table),
      variant_parameter(effect),
      integer("seed", "", 0, 9223372036854775807.0, 0, "Seed of every random number of the scene."),
      integer("run.frames", "frame", 1, 1000000, 60, "Number of frames to simulate."),
      real("run.fps", "1/s", 1, 1000, 60, "Frames per second of simulated time."),
      integer2("run.size", "texel", 1, 65536, {1280, 720}, "Width and height of the picture."),
      integer("run.supersample", "1", 1, 4, 1,
              "Passes run at this multiple of run.size in both directions. A tent filter reduces their picture to run.size."),
  };
  out.insert(out.end(), effect.parameters.begin(), effect.parameters.end());
  validate(out, effect.variants);
  return out;
}

}  // namespace rainref::scene
