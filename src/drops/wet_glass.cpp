#include "drops/wet_glass.h"

#include "drops/motion/integrate.pass.h"
#include "drops/motion/merge.pass.h"
#include "drops/motion/necks.pass.h"
#include "drops/motion/spawn.pass.h"
#include "drops/splat/splat.pass.h"
#include "pass/run.h"

namespace rainref::drops {

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
  return capture::records(listed_);
}

std::int64_t WetGlass::residual() const {
  return mass_balance.spawned - mass_balance.evaporated - mass_balance.removed -
         (settings_.corrected ? film_water(film) + drops.water(executor_) : drops.live());
}

void WetGlass::list_state(state::Items& items) {
  drops.list_state(items);
  if (settings_.corrected) items.image("film", film, {0, most_mass});
  if (settings_.neck_time > 0) necks_.list_state(items, settings_.capacity);
  items.number("spawned", mass_balance.spawned, state::sums);
  items.number("evaporated", mass_balance.evaporated, state::sums);
  items.number("removed", mass_balance.removed, state::sums);
  items.number("to_film", mass_balance.to_film, state::sums);
}

template <class P>
void WetGlass::run(const pass::Moment& now, const typename P::Uniforms& uniforms, pass::HostIo<P> io,
                   const std::function<MassBalance()>& body) {
  io.drops.list = [this] { return list(); };
  pass::Run<P> run(uniforms, settings_.corrected, now.rounding, io);
  run.start(now);
  run.tile([&] { mass_balance += body(); });
  run.finish(now);
}

void WetGlass::spawn(const pass::Moment& now, const Exposure& exposure, std::int64_t n) {
  const SpawnPlan& plan = arrivals_.plan(exposure, n, steps_per_second_, drops.next_id(), drops.free_slots());
  pass::HostIo<SpawnPass> io;
  if (settings_.corrected) io.count_thresholds = plan.thresholds;
  io.spawn_masses = plan.masses;
  run<SpawnPass>(now, plan.uniforms, std::move(io),
                 [&] { return drops::spawn(executor_, drops, plan.uniforms, plan.thresholds, plan.masses, settings_.corrected); });
}

void WetGlass::integrate(const pass::Moment& now, const GlassFrame& glass) {
  const IntegrateUniforms uniforms = integrate_uniforms(settings_, frame_, 1 / steps_per_second_);
  pass::HostIo<IntegratePass> io;
  io.glass_frame = std::span(&glass, 1);
  run<IntegratePass>(now, uniforms, std::move(io),
                     [&] { return drops::integrate(executor_, drops, uniforms, glass, settings_.corrected); });
}

void WetGlass::merge(const pass::Moment& now, std::int64_t n) {
  const double texel_area = area_ / (static_cast<double>(film.width()) * film.height());
  const std::int64_t drying = film_loss(settings_, texel_area, n, steps_per_second_);
  const MergeUniforms uniforms = merge_uniforms(settings_, frame_, 1 / steps_per_second_, film.width(), film.height(), drying);
  if (settings_.neck_time > 0) {
    const NecksUniforms receding = necks_uniforms(settings_, frame_, 1 / steps_per_second_);
    pass::HostIo<NecksPass> of_necks;
    if (now.is_read("necks")) list();
    of_necks.drops = listed_;
    of_necks.necks.list = [this] { return capture::records(necks_.list()); };
    pass::Run<NecksPass> run(receding, true, now.rounding, of_necks);
    run.start(now);
    run.tile([&] { merger_.necks(executor_, drops, uniforms, receding, necks_); });
    run.finish(now);
  }
  pass::HostIo<MergePass> io;
  io.film = film;
  io.new_film = film;
  run<MergePass>(now, uniforms, std::move(io), [&] { return merger_.run(executor_, drops, uniforms, film); });
}

void WetGlass::splat(const pass::Moment& now, const SplatSettings& splat, const GlassFrame& glass, Image& height) {
  list();
  SplatUniforms uniforms = settings_.corrected ? splat_uniforms(splat, pull_on_drops(settings_, frame_, glass)) : splat_uniforms(splat);
  uniforms.drop_count = static_cast<std::int32_t>(listed_.size());
  pass::HostIo<SplatPass> io;
  io.drops = listed_;
  if (settings_.corrected) io.film = film;
  const bool have_necks = settings_.neck_time > 0;
  const std::span<const Neck> necks = have_necks ? std::span<const Neck>(necks_.list()) : std::span<const Neck>();
  if (have_necks) io.necks = necks;
  io.height = height;
  pass::Run<SplatPass> run(uniforms, settings_.corrected, splat.keys.rounding, io);
  run.start(now);
  run.tile([&] {
    drops::splat(executor_, uniforms, splat.keys.half_accumulation, splat.keys.rounding, listed_, necks,
                 settings_.corrected ? &film : nullptr, height, scratch_);
  });
  run.finish(now);
}

}  // namespace rainref::drops
