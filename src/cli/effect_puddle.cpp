#include <optional>

#include <nlohmann/json.hpp>

#include "capture/pass_clock.h"
#include "cli/effects.h"
#include "cli/inputs.h"
#include "cli/pictures.h"
#include "cli/truth.h"
#include "compositor/parameters.h"
#include "compositor/puddle_truth.h"
#include "image_io/write.h"
#include "night_street/night_street.h"
#include "puddle/info.h"
#include "puddle/parameters.h"
#include "rainref/error.h"
#include "rainref/puddle.h"

namespace rainref::cli {
namespace {

/// What is traced: the puddle as surfaces, and the picture of it, if the scene wants one.
class PuddleTracing {
 public:
  PuddleTracing(const scene::Config& config, const puddle::Settings& settings, const puddle::Surroundings& surroundings,
                const parallel::Executor& executor)
      : settings_(settings),
        choice_(compositor::choice_from(config)),
        scene_(settings, surroundings, {choice_.tracer, is_street(config), choice_.picture.samples}, executor) {}

  void trace(const puddle::Puddle& puddle, const parallel::Executor& executor, Recorder* recorder) {
    capture::Stopwatch time;
    scene_.update(puddle, executor);
    picture_ = compositor::trace_picture(scene_.scene(), scene_.camera(), settings_.width, settings_.height, choice_.picture, executor);
    shown_ = compositor::display(settings_, picture_.beauty, executor);
    report_traced(recorder, puddle.frame() - 1, picture_, shown_, time.seconds());
  }
  const Image& shown() const { return shown_; }
  void write_exr(const std::filesystem::path& path) const { write_traced_exr(path, picture_); }
  nlohmann::ordered_json compare(const puddle::Puddle& puddle, const parallel::Executor& executor, const std::filesystem::path& stem) {
    scene_.update(puddle, executor);
    const compositor::PuddleTruth truth = compositor::compare(puddle, settings_, scene_, choice_.picture.shading, executor);
    nlohmann::ordered_json out{{"pixels", truth.pixels},
                               {"water_in_both", truth.water_in_both},
                               {"water_in_passes_only", truth.water_in_passes_only},
                               {"water_in_truth_only", truth.water_in_truth_only}};
    out["differences"] = write_differences(stem, truth.differences);
    return out;
  }

 private:
  static bool is_street(const scene::Config& config) {
    if (config.text("compositor.surroundings") != "street") return false;
    if (!config.text("environment.image").empty()) {
      throw Error(ExitCode::usage,
                  "compositor.surroundings: expected \"picture\", for environment.image names one; \"street\" is the street made here");
    }
    return true;
  }

  puddle::Settings settings_;
  compositor::Choice choice_;
  compositor::PuddleScene scene_;
  compositor::Picture picture_;
  Image shown_;
};

class PuddleSimulation : public Simulation {
 public:
  PuddleSimulation(const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs)
      : config_(config),
        executor_(executor),
        settings_(puddle::settings_from(config)),
        is_traced_(compositor::choice_from(config).is_traced),
        surroundings_(surroundings(config, executor, inputs)),
        puddle_(settings_, surroundings_, executor) {
    if (is_traced_) tracing();
  }

  void advance(Recorder* recorder) override {
    puddle_.simulate(recorder);
    puddle_.render(recorder);
    if (is_traced_ && is_shown_) tracing().trace(puddle_, executor_, recorder);
  }
  void show(bool is_shown) override { is_shown_ = is_shown; }
  const Image& picture() const override { return is_traced_ ? tracing_->shown() : puddle_.picture(); }
  void write_exr(const std::filesystem::path& path) const override {
    if (is_traced_) return tracing_->write_exr(path);
    const Image colour = flipped(puddle_.colour()), normal = flipped(puddle_.normal()), hit = flipped(puddle_.hit());
    image_io::write_exr(path, {{"", {"R", "G", "B"}, &colour}, {"normal", {"X", "Y", "Z"}, &normal}, {"position", {"X", "Y", "Z"}, &hit}});
  }
  bool has_truth() const override { return settings_.variant == Variant::corrected; }
  nlohmann::ordered_json compare_truth(const std::filesystem::path& stem) override { return tracing().compare(puddle_, executor_, stem); }

 private:
  static puddle::Surroundings surroundings(const scene::Config& config, const parallel::Executor& executor,
                                           std::vector<InputFile>& inputs) {
    puddle::Surroundings s;
    if (config.text("environment.image").empty()) {
      s.environment = night_street::Street().panorama(1024, 512, {0, 0.05, 0}, executor);
    } else {
      image_io::Picture picture = read_input(config, "environment.image", inputs);
      s.environment_is_cube = config.text("environment.layout") == "cube";
      // A panorama's v = 0 looks down; a cube's faces start at their top row, as graphics APIs have it.
      s.environment = s.environment_is_cube ? std::move(picture.image) : flipped(picture.image);
      s.environment_is_encoded = picture.srgb_encoded;
    }
    if (!config.text("puddle.ground_image").empty()) {
      image_io::Picture picture = read_input(config, "puddle.ground_image", inputs);
      s.ground = flipped(picture.image);
      s.ground_is_encoded = picture.srgb_encoded;
    }
    return s;
  }
  PuddleTracing& tracing() {
    if (!tracing_) tracing_.emplace(config_, settings_, surroundings_, executor_);
    return *tracing_;
  }

  scene::Config config_;
  const parallel::Executor& executor_;
  puddle::Settings settings_;
  bool is_traced_, is_shown_ = true;
  puddle::Surroundings surroundings_;
  puddle::Puddle puddle_;
  std::optional<PuddleTracing> tracing_;  // made when something is traced
};

/// The puddle's own parameters and those of traced pictures.
std::span<const scene::Parameter> all_parameters() {
  static const std::vector<scene::Parameter> all = [] {
    const auto own = puddle::parameters();
    std::vector<scene::Parameter> table(own.begin(), own.end());
    for (scene::Parameter& p : compositor::parameters()) table.push_back(std::move(p));
    table.push_back(
        scene::choice(
            "compositor.surroundings", {"picture", "street"}, "picture",
            "What a traced ray sees beyond the puddle: the passes' picture of the surroundings, or the street made here, ray by ray.")
            .only("corrected"));
    return table;
  }();
  return all;
}

}  // namespace

EffectEntry puddle_entry() {
  return {
      "puddle",
      {"as-published", "corrected"},
      all_parameters(),
      &puddle::effect_info(),
      [](const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs) -> std::unique_ptr<Simulation> {
        return std::make_unique<PuddleSimulation>(config, executor, inputs);
      },
      puddle_memory};
}

}  // namespace rainref::cli
