// Small scenes of every effect, variant and storage whose frames have a past, or none; and runs of them, hashed.
#pragma once

#include <memory>
#include <ostream>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "capture/hashing.h"
#include "registry/registry.h"
#include "scene/toml.h"
#include "simulation/opened.h"
#include "simulation/small_scenes.h"

namespace rainref {

/// A film of 40 pictures of 33 x 21, no two alike, as sequence keys name it: "%02d" in its name.
inline std::string tiny_film() {
  static const TemporaryFolder folder;
  static const std::string name = [] {
    for (int k = 0; k < 40; ++k) {
      std::string codes;
      for (int i = 0; i < 21 * 33 * 3; ++i) codes += static_cast<char>(i * 37 % 251 + k);
      put(folder / fmt::format("{:02}.npy", k), npy("'|u1'", "(21, 33, 3)", codes));
    }
    return (folder / "%02d.npy").string();
  }();
  return name;
}

struct StateScene {
  std::string name;
  SceneText text;
  friend void PrintTo(const StateScene& scene, std::ostream* out) { *out << scene.name; }
};
inline std::vector<StateScene> state_scenes() {
  std::vector<StateScene> all;
  const auto add = [&](const std::string& effect, const std::string& variant, const std::string& name, std::vector<std::string> more) {
    more.push_back("run.frames=40");
    all.push_back({effect + (variant == "corrected" ? "_corrected_" : "_published_") + name, small(effect, variant, std::move(more))});
  };
  for (const std::string variant : {"as-published", "corrected"}) {
    const bool corrected = variant == "corrected";
    const auto puddle = [&](const std::string& name, std::vector<std::string> more) { add("puddle", variant, name, std::move(more)); };
    puddle("rg16f", {"puddle.storage=rg16f"});
    puddle("rg32f", {"puddle.storage=rg32f", "puddle.boundary=periodic"});
    puddle("rgba8", {"puddle.storage=rgba8", "puddle.boundary=fixed"});
    puddle("rtz", {"puddle.rounding=rtz", "run.fps=24", "puddle.boundary=fixed"});
    if (corrected) puddle("shore", {"puddle.shape=natural", "puddle.bed_columns=64"});
    if (corrected) puddle("objects", {"puddle.objects=0.1 0.01: 0 -0.3 0, 2 0.3 0.1", "rain.shelter=0 0 1 1"});

    add("edge_splash", variant, "still", {});
    add("screen_drops", variant, "still", {});
    add("screen_drops", variant, "film", {"scene.image=" + tiny_film(), "sequence.count=40"});
    for (const std::string storage : {"rgba8", "rgba16f"}) add("rainy_glass", variant, storage, {"maps.storage=" + storage});

    // A street of two dozen texels takes most of the time; a still picture none.
    const auto windshield = [&](const std::string& name, std::vector<std::string> more) {
      std::vector<std::string> keys{"run.fps=30", "vehicle.key_frames=0 12 0.1; 1 9 0.4"};
      if (!corrected) keys.push_back("windshield.spawn_rate=2000");  // room stays
      keys.insert(keys.end(), more.begin(), more.end());
      add("windshield", variant, name, std::move(keys));
    };
    windshield("plain", {});
    windshield("film", {"scene.image=" + tiny_film(), "sequence.count=40"});
    windshield("panes", {"scene.moves=false", "windshield.panes=1.0 0.75 0.95, 1.9 0.8 1.0, 1.1 0.7 1.4", "pane_1_wipers.count=1"});
    windshield("behind", {"scene.moves=false", "falling_rain.on=true", "falling_rain.gain=8", "falling_rain.far=2",
                          "falling_rain.exposure=0.01", corrected ? "windshield.substeps=3" : "seed=3"});
    windshield("weather", {"scene.moves=false", "rain.key_frames=0 30; 1 150", "wipers.key_frames=0 slow; 0.3 fast; 0.9 off",
                           "world.wind_key_frames=0 0 0 0; 1 3 -6 0", "windshield.rounding=rtz"});
    std::erase_if(all.back().text.set,
                  [](const std::string& s) { return s.starts_with("rain.rate=") || s.starts_with("windshield.spawn_rate="); });
    windshield("shelter", {"scene.moves=false", "rain.shelter=4 9; 11.5 12", "falling_rain.on=true", "falling_rain.gain=8",
                           "falling_rain.far=2", "falling_rain.exposure=0.01"});
    if (corrected) windshield("interior", {"scene.moves=false", "interior.on=true"});
    if (corrected) windshield("condensation", {"scene.moves=false", "condensation.on=true", "condensation.tau=1"});
    if (corrected) windshield("smear", {"scene.moves=false", "smear.on=true", "smear.drying=2", "windshield.lean=1"});
    if (corrected) windshield("neck", {"scene.moves=false", "windshield.neck_time=2"});
    if (!corrected) {
      windshield("trails", {"scene.moves=false", "windshield.height_tau=0.5", "windshield.blend=max"});
      windshield("float", {"scene.moves=false", "windshield.accumulate=float"});
    }
  }
  add("screen_drops", "corrected", "flow",
      {"flow.on=true", "flow.height_size=[37, 29]", "flow.capacity=500", "flow.warm_up=0.7", "flow.neck_time=0.5", "rain.rate=100",
       "rain.wind=20"});
  add("screen_drops", "corrected", "dry", {"flow.on=false"});
  return all;
}

/// Opened anew.
inline std::unique_ptr<simulation::Opened> open(const StateScene& scene, const parallel::Executor& executor) {
  return std::make_unique<simulation::Opened>(scene::parse(scene.text, simulation::effect_table()), executor);
}
inline std::vector<std::byte> saved(const simulation::Opened& running) {
  std::vector<std::byte> bytes;
  running.save("", [&](std::span<const std::byte> more) { bytes.insert(bytes.end(), more.begin(), more.end()); });
  return bytes;
}
inline std::vector<std::string> texts_of(capture::HashRecorder& recorder) {
  std::vector<std::string> texts;
  for (const capture::HashLine& line : recorder.take_lines()) texts.push_back(line.text());
  return texts;
}
/// What a call records, hashed.
template <class Call>
std::vector<std::string> lines_of(const Call& call) {
  capture::HashRecorder recorder;
  call(&recorder);
  return texts_of(recorder);
}
inline std::vector<std::string> lines_of_frame(simulation::Opened& running) {
  return lines_of([&](Recorder* r) { running.next_frame(r); });
}

}  // namespace rainref
