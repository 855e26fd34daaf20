#include "drops/wet_glass.h"

#include "capture/pass_clock.h"

namespace rainref::drops {

using capture::records;
using capture::Stopwatch;

WetGlass::WetGlass(const Settings& settings, const PlaneFrame& frame, double area, double steps_per_second, int columns, int rows,
                   const parallel::Executor& executor)
    : drops(settings.capacity),
      settings_(settings),
      frame_(frame),
      area_(area),
      steps_per_second_(steps_per_second),
      executor_(executor),
      arrivals_(settings) {
  if (settings.corrected) film = Image(Format::r32f, columns, rows);
}

RecordView WetGlass::list() {
  drops.gather(listed_, executor_);
  return records(listed_);
}

std::int64_t WetGlass::residual() const {
  return mass_balance.spawned - mass_balance.evaporated - mass_balance.removed -
         (settings_.corrected ? film_water(film) + drops.water() : drops.live());
}

void WetGlass::spawn(const pass::Moment& now, const Exposure& exposure, std::int64_t n) {
  const SpawnPlan& plan = arrivals_.plan(exposure, n, steps_per_second_, drops.next_id(), drops.free_slots());
  if (now.recorder) {
    const PassInput before{"drops", list_for(now, "spawn")}, thresholds{"count_thresholds", records(plan.thresholds)},
        masses{"spawn_masses", records(plan.masses)};
    if (settings_.corrected) {
      now.before("spawn", plan.uniforms, std::array{before, thresholds, masses});
    } else {
      now.before("spawn", plan.uniforms, std::array{before, masses});
    }
  }
  const Stopwatch clock;
  mass_balance += drops::spawn(drops, plan.uniforms, plan.thresholds, plan.masses, settings_.corrected);
  const double seconds = clock.seconds();
  if (now.recorder) now.after("spawn", std::array{PassOutput{"drops", list_for(now, "spawn")}}, seconds);
}

void WetGlass::integrate(const pass::Moment& now, const GlassFrame& glass) {
  const IntegrateUniforms uniforms = integrate_uniforms(settings_, frame_, 1 / steps_per_second_);
  if (now.recorder)
    now.before("integrate", uniforms,
               std::array{PassInput{"drops", list_for(now, "integrate")}, PassInput{"glass_frame", RecordView{&glass, 1, sizeof glass}}});
  const Stopwatch clock;
  mass_balance += settings_.corrected ? integrate_corrected(executor_, drops, uniforms, glass)
                                      : integrate_as_published(executor_, drops, uniforms, glass);
  const double seconds = clock.seconds();
  if (now.recorder) now.after("integrate", std::array{PassOutput{"drops", list_for(now, "integrate")}}, seconds);
}

void WetGlass::merge(const pass::Moment& now, std::int64_t n) {
  const double texel_area = area_ / (static_cast<double>(film.width()) * film.height());
  const std::int64_t drying = film_loss(settings_, texel_area, n, steps_per_second_);
  const MergeUniforms uniforms = merge_uniforms(settings_, frame_, 1 / steps_per_second_, film.width(), film.height(), drying);
  if (now.recorder) now.before("merge", uniforms, std::array{PassInput{"drops", list_for(now, "merge")}, PassInput{"film", film}});
  const Stopwatch clock;
  mass_balance += merger_.run(executor_, drops, uniforms, film);
  const double seconds = clock.seconds();
  if (now.recorder) now.after("merge", std::array{PassOutput{"drops", list_for(now, "merge")}, PassOutput{"film", film}}, seconds);
}

void WetGlass::splat(const pass::Moment& now, const SplatSettings& splat, Image& height) {
  const PassInput drawn{"drops", list()};
  SplatUniforms uniforms = splat_uniforms(splat);
  uniforms.drop_count = static_cast<std::int32_t>(listed_.size());
  if (settings_.corrected) {
    now.before("splat", uniforms, std::array{drawn, PassInput{"film", film}});
  } else {
    now.before("splat", uniforms, std::array{drawn});
  }
  const Stopwatch clock;
  drops::splat(executor_, uniforms, splat.keys.half_accumulation, splat.keys.rounding, listed_, settings_.corrected ? &film : nullptr,
               height, scratch_);
  now.after("splat", std::array{PassOutput{"height", height}}, clock.seconds());
}

}  // namespace rainref::drops
