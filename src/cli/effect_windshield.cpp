#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "capture/pass_clock.h"
#include "cli/effects.h"
#include "cli/pictures.h"
#include "cli/scene_pictures.h"
#include "cli/truth.h"
#include "compositor/parameters.h"
#include "compositor/windshield_truth.h"
#include "image_io/write.h"
#include "rainref/error.h"
#include "rainref/windshield.h"
#include "windshield/info.h"
#include "windshield/scene_images.h"
#include "windshield/scene_keys.h"

namespace rainref::cli {
namespace {

std::vector<scene::Parameter> pane_parameters() {
  return {
      compositor::pane_thickness(),
      scene::real("compositor.glass_radius", "m", 0, 1e6, 0,
                  "Radius of its bend across the car, convex outward; 0: flat. The passes' glass is flat."),
  };
}

/// What is traced: the view through the wet pane, and the picture of it, if the scene wants one.
class WindshieldTracing {
 public:
  WindshieldTracing(const scene::Config& config, const parallel::Executor& executor)
      : choice_(compositor::choice_from(config)),
        executor_(executor),
        view_(windshield::settings_from(config), {config.real("compositor.glass_thickness"), config.real("compositor.glass_radius")},
              choice_.tracer, executor) {}

  void trace(const windshield::Windshield& windshield, Recorder* recorder) {
    capture::Stopwatch time;
    const windshield::Settings& s = view_.settings();
    picture_ =
        compositor::trace_picture(*view_.scene(windshield), view_.camera(), s.picture.width, s.picture.height, choice_.picture, executor_);
    shown_ = compositor::display(s, picture_.beauty, executor_);
    report_traced(recorder, windshield.frame() - 1, picture_, shown_, time.seconds());
  }
  const Image& shown() const { return shown_; }
  void write_exr(const std::filesystem::path& path) const { write_traced_exr(path, picture_); }
  nlohmann::ordered_json compare(const windshield::Windshield& windshield, const std::filesystem::path& stem) const {
    const compositor::WindshieldTruth truth = compositor::compare(windshield, view_, choice_.picture, executor_);
    nlohmann::ordered_json out{{"glass_pixels", truth.glass}, {"drop_pixels", truth.drops}, {"mirrored_pixels", truth.mirrored}};
    out["differences"] = write_differences(stem, truth.differences);
    return out;
  }

 private:
  compositor::Choice choice_;
  const parallel::Executor& executor_;
  compositor::WindshieldView view_;
  compositor::Picture picture_;
  Image shown_;
};

class WindshieldSimulation : public Simulation {
 public:
  WindshieldSimulation(const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs)
      : config_(config),
        executor_(executor),
        is_traced_(compositor::choice_from(config).is_traced),
        has_street_(config.text("scene.image").empty()),
        windshield_(config, surroundings(config, inputs), executor) {
    if (!is_traced_) return;
    if (!has_street_)
      throw Error(ExitCode::usage,
                  "compositor.picture: expected \"passes\", for rays need the street made here and scene.image names a picture");
    tracing();
  }

  void advance(Recorder* recorder) override {
    windshield_.simulate(recorder);
    windshield_.render(recorder);
    if (is_traced_ && is_shown_) tracing().trace(windshield_, recorder);
  }
  void show(bool is_shown) override { is_shown_ = is_shown; }
  const Image& picture() const override { return is_traced_ ? tracing_->shown() : windshield_.picture(); }
  bool has_truth() const override { return has_street_; }
  nlohmann::ordered_json compare_truth(const std::filesystem::path& stem) override { return tracing().compare(windshield_, stem); }
  void write_exr(const std::filesystem::path& path) const override {
    if (is_traced_) return tracing_->write_exr(path);
    const Image colour = flipped(windshield_.colour());
    image_io::write_exr(path, {{"", {"R", "G", "B"}, &colour}});
  }

 private:
  static windshield::Surroundings surroundings(const scene::Config& config, std::vector<InputFile>& inputs) {
    windshield::Surroundings s;
    const bool has_depth = !config.text("scene.depth_image").empty();
    if (config.text("scene.image").empty()) {
      if (has_depth)
        throw Error(ExitCode::usage, config.entry("scene.depth_image").origin.at,
                    "scene.depth_image: expected scene.image beside it, found none");
      return s;
    }
    const Image colour = read_linear(config, "scene.image", inputs);
    s.colour = windshield::opaque_half(colour);
    s.depth = has_depth ? read_depth(config, colour, inputs) : windshield::far_depth(colour.width(), colour.height());
    return s;
  }

  WindshieldTracing& tracing() {
    if (!tracing_) tracing_.emplace(config_, executor_);
    return *tracing_;
  }

  scene::Config config_;
  const parallel::Executor& executor_;
  bool is_traced_, has_street_, is_shown_ = true;
  windshield::Windshield windshield_;
  std::optional<WindshieldTracing> tracing_;  // made when something is traced
};

/// The windshield's own parameters and those of traced pictures.
std::span<const scene::Parameter> all_parameters() {
  static const std::vector<scene::Parameter> all = [] {
    const auto own = windshield::parameters();
    std::vector<scene::Parameter> table(own.begin(), own.end());
    for (scene::Parameter& p : compositor::parameters()) table.push_back(std::move(p));
    for (scene::Parameter& p : pane_parameters()) table.push_back(std::move(p));
    return table;
  }();
  return all;
}

}  // namespace

EffectEntry windshield_entry() {
  return {
      "windshield",
      {"as-published", "corrected"},
      all_parameters(),
      &windshield::effect_info(),
      [](const scene::Config& config, const parallel::Executor& executor, std::vector<InputFile>& inputs) -> std::unique_ptr<Simulation> {
        return std::make_unique<WindshieldSimulation>(config, executor, inputs);
      },
      windshield_memory};
}

}  // namespace rainref::cli
