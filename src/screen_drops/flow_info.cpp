#include "screen_drops/flow_info.h"

#include <algorithm>

#include "drops/info.h"
#include "drops/evaluations.h"
#include "drops/settings.h"
#include "drops/splat/splat.h"
#include "math/constants.h"
#include "scene/variant_names.h"
#include "screen_drops/flow.h"

namespace rainref::screen_drops {
namespace {

using namespace rainref::scene;

template <class T>
void append(std::vector<T>& all, std::vector<T> more) {
  all.insert(all.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

}  // namespace

std::vector<Parameter> flow_parameters(const std::string& prefix) {
  const auto key = [&](const char* name) { return prefix + "." + name; };
  std::vector<Parameter> all = drops::still_parameters(prefix);
  append(all, drops::corrected_only(drops::splat_parameters(prefix)));
  std::erase_if(all, [&](const Parameter& p) { return p.key == key("rounding"); });
  // As wide to high as most screens.
  std::find_if(all.begin(), all.end(), [&](const Parameter& p) { return p.key == key("height_size"); })->default_value =
      Integer2{1024, 576};
  const FlowSettings standard;
  append(all, {integer(key("substeps"), "1", 1, 64, standard.substeps, "Steps of the drops in a frame.").only(correct),
               real(key("warm_up"), "s", 0, 3600, standard.warm_up, "Time that it has rained onto the pane before frame 0.").only(correct),
               real("rain.wind", "m/s", 0, 100, standard.wind,
                    "Wind that drives the rain onto the pane; rain that falls straight misses upright glass. 2 m/s is a light breeze.")
                   .only(correct),
               real("world.gravity", "m/s^2", 0, 100, standard.gravity, "Acceleration of gravity.").only(correct)});
  return all;
}

FlowSettings flow_settings(const Config& config, const std::string& prefix, const std::array<double, 2>& pane, Rounding rounding) {
  const auto key = [&](const char* name) { return prefix + "." + name; };
  FlowSettings s;
  s.fps = config.real("run.fps");
  s.substeps = static_cast<int>(config.integer(key("substeps")));
  s.pane = pane;
  s.gravity = config.real("world.gravity");
  s.wind = config.real("rain.wind");
  s.warm_up = config.real(key("warm_up"));
  s.drops = drops::still_settings_from(config, prefix);
  s.splat = drops::splat_keys(config, prefix, rounding);
  return s;
}

std::vector<capture::PassInfo> flow_passes() {
  return {drops::corrected_only(drops::spawn_info({"merge", "merge"})), drops::corrected_only(drops::integrate_info("")),
          drops::corrected_only(drops::necks_info("integrate")), drops::corrected_only(drops::merge_info("integrate", "merge")),
          drops::corrected_only(drops::splat_info({"merge", "merge"}))};
}

std::vector<capture::BufferInfo> flow_buffers() {
  std::vector<capture::BufferInfo> all = drops::buffers();
  append(all, drops::splat_buffers());
  return drops::corrected_only(std::move(all));
}

std::vector<UniformBlock> flow_records() { return drops::records(); }

std::vector<capture::PassEvaluations> flow_evaluations() {
  return {drops::spawn_evaluations(),
          {"integrate", drops::bind_integrate},
          {"necks", drops::bind_necks},
          {"merge", drops::bind_merge},
          {"splat", drops::bind_splat}};
}

}  // namespace rainref::screen_drops
