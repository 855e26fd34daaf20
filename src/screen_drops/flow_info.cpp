
#include <algorithm>

#include "drops/info.h"
#include "drops/settings.h"
#include "drops/splat/splat.h"
#include "pass/info.h"
#include "scene/member_parameter.h"
#include "screen_drops/flow.h"

namespace rainref::screen_drops {
namespace {

using namespace rainref::scene;

const std::vector<MemberParameter<FlowSettings>>& flow_members() {
  using F = FlowSettings;
  static const std::vector<MemberParameter<F>> table{
      integer<&F::substeps>("flow.substeps", "1", 1, 64, "Time steps of the drops in a frame.").only(correct),
      real<&F::warm_up>("flow.warm_up", "s", 0, 3600, "Time for which it has rained onto the pane before frame 0.").only(correct),
      real<&F::wind>("rain.wind", "m/s", 0, 100,
                     "Wind that drives the rain onto the pane; rain that falls straight misses upright glass. 2 m/s is a light breeze.")
          .only(correct),
      real<&F::gravity>("world.gravity", "m/s^2", 0, 100, "Acceleration of gravity.").only(correct)};
  return table;
}

}  // namespace

std::vector<Parameter> flow_parameters() {
  std::vector<Parameter> all = drops::still_parameters("flow");
  pass::append(all, drops::corrected_only(drops::splat_parameters("flow")));
  std::erase_if(all, [](const Parameter& p) { return p.key == "flow.rounding"; });
  // The aspect ratio of most screens.
  std::find_if(all.begin(), all.end(), [](const Parameter& p) { return p.key == "flow.height_size"; })->default_value = Integer2{1024, 576};
  pass::append(all, parameters_of(flow_members()));
  return all;
}

FlowSettings flow_settings(const Config& config, const std::array<double, 2>& pane, Rounding rounding) {
  FlowSettings s;
  s.fps = config.real("run.fps");
  s.pane = pane;
  apply(flow_members(), config, s);
  s.drops = drops::still_settings_from(config, "flow");
  s.splat = drops::splat_keys(config, "flow", rounding);
  return s;
}

std::vector<capture::PassInfo> flow_passes() {
  return {drops::corrected_only(drops::spawn_info({"merge", "merge"})), drops::corrected_only(drops::integrate_info("")),
          drops::corrected_only(drops::necks_info("integrate")), drops::corrected_only(drops::merge_info("integrate", "merge")),
          drops::corrected_only(drops::splat_info({"merge", "merge"}))};
}

std::vector<capture::BufferInfo> flow_buffers() {
  std::vector<capture::BufferInfo> all = drops::buffers();
  pass::append(all, drops::splat_buffers());
  return drops::corrected_only(std::move(all));
}

std::vector<UniformBlock> flow_records() { return drops::records(); }

}  // namespace rainref::screen_drops
