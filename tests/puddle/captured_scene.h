// What the passes of a golden scene took, for tests that run single invocations again.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "puddle/scenery.h"
#include "puddle/golden_scenes.h"
#include "puddle/ground.h"
#include "puddle/host.h"
#include "puddle/uniforms.h"
#include "rainref/executor.h"
#include "rainref/recorder.h"

namespace rainref::puddle {

// A golden scene some frames in: the state before the last wave step, its drops, and everything that render takes.
struct Scene : Recorder {
  Settings settings;
  Surroundings around;
  std::vector<float> newest, previous;
  std::vector<Drop> drops;
  std::unique_ptr<Puddle> puddle;
  TextureData environment, ground, relief, bed;
  ShadeUniforms shade;
  bool corrected;

  Scene(const std::string& name, int frames) {
    static const parallel::Executor executor(1);
    for (const GoldenScene& g : golden_scenes()) {
      if (g.name == name) settings = g.settings;
    }
    corrected = settings.variant == Variant::corrected;
    around = golden_surroundings(executor);
    puddle = std::make_unique<Puddle>(settings, around, executor);
    for (int frame = 0; frame < frames; ++frame) puddle->simulate(this);
    puddle->render();
    environment = prepare_environment(around, settings.variant);
    ground = prepare_ground(make_asphalt(settings.seed), false, settings.variant);
    shade = shade_uniforms(settings);
    shade.environment_is_cube = false;
    shade.ground_footprint = ground_footprint(settings, ground.view().width[0]);
    if (corrected) {
      relief = make_relief(ground, true);
      bed = make_bed(settings);
      shade.gloss_level = gloss_level(environment.view().width[0], false);
      const auto ambient = ambient_radiance(environment.view(), false);
      for (int k = 0; k < 3; ++k) shade.ambient[k] = shade.fog_colour[k] = ambient[k];
    }
  }
  // Called before wave_step with the drops of the step: the state is still the one that the step takes.
  void pass(const PassCall& call) override {
    if (call.pass != "raindrops") return;
    const auto& records = std::get<RecordView>(call.outputs[0].content);
    const auto* first = static_cast<const Drop*>(records.data);
    drops.assign(first, first + records.count);
    newest = stored(puddle->newest());
    previous = stored(puddle->previous());
  }
  static std::vector<float> stored(const Image& plane) {
    std::vector<float> out;
    for (int y = 0; y < plane.height(); ++y) {
      for (int x = 0; x < plane.width(); ++x) {
        out.push_back(info(plane.format()).kind == FormatInfo::float32 ? plane.row<float>(y)[x] : to_float(plane.row<Half>(y)[x]));
      }
    }
    return out;
  }
};
/// The scene of this name after 20 frames; made once.
inline const Scene& scene(const std::string& name) {
  static std::map<std::string, std::unique_ptr<Scene>> scenes;
  auto& s = scenes[name];
  if (!s) s = std::make_unique<Scene>(name, 20);
  return *s;
}

}  // namespace rainref::puddle
