#include "windshield/wet_pane.h"

#include <algorithm>
#include <utility>

#include "pass/run.h"
#include "windshield/motion/host.h"
#include "windshield/motion/glass.h"
#include "windshield/motion/kernels.h"
#include "windshield/picture/mist.pass.h"
#include "windshield/picture/soften.pass.h"

namespace rainref::windshield {
namespace {

double steps_per_second(const Settings& s) { return s.fps * s.substeps; }

constexpr int composite_rows = 2;  // of a tile; few, because rows differ in cost

/// Runs all of its texels; before: host time already spent on it [s].
template <class P>
void draw_all(pass::Run<P> pass, const pass::Moment& now, const parallel::Executor& executor, double before = 0, int rows = tile_rows) {
  pass.start(now);
  pass.tiles(executor, rows);
  pass.finish(now, 1, before);
}

}  // namespace

double middle_of(const Glass& glass) { return glass.origin[0] + 0.5 * (glass.e_u[0] + glass.e_v[0]); }

Real3 apparent_wind(const VehicleState& car, const Real3& wind) {
  const Real3 apparent{wind[0] - car.velocity[0], wind[1] - car.velocity[1], wind[2] - car.velocity[2]};
  return {car.direction[0] * apparent[0] + car.direction[1] * apparent[1], car.direction[0] * apparent[1] - car.direction[1] * apparent[0],
          apparent[2]};
}

double wind_along_normal(const Glass& glass, const VehicleState& car, const Real3& wind) {
  return dot(apparent_wind(car, wind), glass.normal);
}

WetPane::WetPane(const Settings& settings, int number, const Vehicle& vehicle, const parallel::Executor& executor)
    : settings_(settings),
      executor_(executor),
      corrected_(settings.corrected),
      has_blades_(number == 0 || !settings.wipers.blades.empty()),
      glass_(make_glass(settings.corners, pane_name(number))),
      plane_(corrected_ ? glass_.plane() : glass_.axes()),
      view_(composite_uniforms(settings.picture, settings.corners, pane_name(number))),
      shelter_(settings.weather.shelter, vehicle, middle_of(glass_)),
      water_(settings.drops, plane_.frame, glass_.area, steps_per_second(settings), settings.surface.width, settings.surface.height,
             executor) {
  check(settings_.wipers, glass_, wiper_table(number));
  const int w = settings_.surface.width, h = settings_.surface.height;
  height_ = Image(Format::r16f, w, h);
  if (settings_.surface.height_tau > 0) previous_height_ = Image(Format::r16f, w, h);
  mask_ = make_mask(settings_.surface);
  if (corrected_) wiped_ = make_wiped(settings_.surface);
  normal_ = Image(Format::rgba16f, w, h);
  if (settings_.smear.on && has_blades_) {
    laid_ = make_laid(settings_.surface);
    smear_ = make_laid(settings_.surface);
    profile_ = smear_profile(settings_.smear, settings_.seed);
  }
  if (!settings_.condensation.on) return;
  clear_time_ = make_clear_time(settings_.condensation, settings_.surface);
  condensation_ = Image(Format::r16f, w, h);
}

/// The same, with body computing it.
template <class P, class Body>
void WetPane::run(const pass::Moment& now, const typename P::Uniforms& uniforms, const pass::HostIo<P>& io, const Body& body) const {
  pass::Run<P> pass(uniforms, corrected_, now.rounding, io);
  pass.start(now);
  pass.tile(body);
  pass.finish(now);
}

drops::Exposure WetPane::exposure(std::int64_t n, double t, const VehicleState& car, const Weather& weather) const {
  drops::Exposure e{glass_.area, glass_.normal[2], wind_along_normal(glass_, car, weather.wind(t))};
  const auto begin_of = [&](std::int64_t step) { return static_cast<double>(step) / steps_per_second(settings_); };
  if (corrected_) {
    // The sizes are those of the rain; only a share of its drops falls outside roofs.
    e.area *= shelter_.open_share(begin_of(n), begin_of(n + 1));
    if (weather.rain_changes()) e.rain_rate = weather.rain(t);
  } else if (weather.rain_changes() || !shelter_.is_open_until(begin_of(n + 1))) {
    // The millionth keeps rounding of the integral from delaying a drop that is due.
    const auto until = [&](std::int64_t step) {
      return static_cast<std::int64_t>(settings_.drops_share * shelter_.rained(weather, begin_of(step)) + 1e-6);
    };
    e.arrivals = std::max<std::int64_t>(until(n + 1) - until(n), 0);
  }
  return e;
}

void WetPane::step(const pass::Moment& now, std::int64_t n, double t, const VehicleState& car, const Weather& weather) {
  const WindshieldFrameUniforms frame_uniforms = windshield_frame_uniforms(glass_, car, weather.wind(t), settings_.gravity, corrected_);
  pass::HostIo<WindshieldFramePass> given;
  given.glass_frame.list = [&] { return RecordView{&forces_, 1, sizeof forces_}; };
  run<WindshieldFramePass>(now, frame_uniforms, given, [&] { forces_ = windshield_frame(frame_uniforms, corrected_); });

  water_.spawn(now, exposure(n, t, car, weather), n);
  water_.integrate(now, forces_);

  if (has_blades_) wipe(now, n, t);
  if (corrected_) water_.merge(now, n);
}

void WetPane::take_forces(double t, const VehicleState& car, const Weather& weather) {
  forces_ = windshield_frame(windshield_frame_uniforms(glass_, car, weather.wind(t), settings_.gravity, corrected_), corrected_);
}

// As published the first frame has no previous frame, so the blades are at rest.
std::vector<Wiper> WetPane::swept(std::int64_t n, double t, double dt) const {
  return n == 0 && !corrected_ ? wipers_at(settings_.wipers, plane_, t) : wipers_between(settings_.wipers, plane_, t, t + dt, corrected_);
}

void WetPane::sweep(std::int64_t n, double t, double dt) {
  if (!has_blades_) return;
  const std::vector<Wiper> more = swept(n, t, dt);
  wipers_.insert(wipers_.end(), more.begin(), more.end());
}

void WetPane::wipe(const pass::Moment& now, std::int64_t n, double t) {
  const std::vector<Wiper> swept = this->swept(n, t, now.dt);
  wipers_.insert(wipers_.end(), swept.begin(), swept.end());
  const WipeDropsUniforms wipe = wipe_drops_uniforms(glass_, corrected_, static_cast<int>(swept.size()), settings_.capture,
                                                     drops::radius_of_mass_unit(settings_.drops), corrected_ ? water_.film.width() : 0,
                                                     corrected_ ? water_.film.height() : 0);
  pass::HostIo<WipeDropsPass> io;
  io.drops.list = [&] { return water_.list(); };
  io.wipers = swept;
  if (corrected_) {
    io.film = water_.film;
    io.new_film = water_.film;
  }
  run<WipeDropsPass>(now, wipe, io, [&] {
    drops::DropArrays& d = water_.drops;
    const std::int64_t drops_before = corrected_ ? d.water(executor_) : 0;
    const std::int64_t gone = static_cast<std::int64_t>(
        wipe_drops(wipe, corrected_, swept, {d.u(), d.v(), d.velocity_u(), d.velocity_v(), d.mass(), d.life(), d.id()},
                   corrected_ ? &water_.film : nullptr, executor_));
    // Water that the drops gained, or did not lose although it is gone, came from the film.
    water_.mass_balance.removed += gone;
    if (corrected_) water_.mass_balance.to_film -= d.water(executor_) - drops_before + gone;
  });
}

void WetPane::list_state(state::Items& items) {
  water_.list_state(items);
  if (settings_.surface.height_tau > 0) items.image("height", height_);
  if (settings_.condensation.on) items.image("clear_time", clear_time_);
  if (has_blades_ && settings_.smear.on) items.image("laid", laid_);
  if (!has_blades_) return;
  if (corrected_)
    items.image("wiped", wiped_);
  else
    items.image("mask", mask_);
}

void WetPane::leave_traces(const pass::Moment& now, int frame) {
  const Rounding rounding = settings_.surface.rounding;
  const bool persists = settings_.surface.height_tau > 0;
  if (persists) std::swap(height_, previous_height_);
  water_.splat(now, settings_.splat, forces_, height_);
  if (persists) {
    pass::HostIo<PersistPass> io;
    io.height = height_;
    io.previous_height = previous_height_;
    io.new_height = height_;
    draw_all(pass::Run<PersistPass>(persist_uniforms(settings_.surface), corrected_, rounding, io), now, executor_);
  }

  if (has_blades_) wipe_texture(now, frame);
  if (has_blades_ && settings_.smear.on) leave_smear(now);
  if (settings_.condensation.on) condense(now, frame);
}

void WetPane::leave_smear(const pass::Moment& now) {
  SmearUniforms uniforms = smear_uniforms(settings_.smear, settings_.surface);
  uniforms.wiper_count = static_cast<std::int32_t>(wipers_.size());
  pass::HostIo<SmearPass> io;
  io.height = height_;
  io.wiped = wiped_;
  io.laid = laid_;
  io.wipers = wipers_;
  io.profile = profile_;
  io.smear = smear_;
  io.new_laid = laid_;
  pass::Run<SmearPass> run(uniforms, corrected_, settings_.surface.rounding, io);
  run.start(now);
  run.tiles(executor_, 16, 64);  // few blades reach a tile of it
  run.finish(now);
}

void WetPane::condense(const pass::Moment& now, int frame) {
  pass::HostIo<CondensePass> io;
  io.height = height_;
  io.wiped = wiped_;
  io.clear_time = clear_time_;
  io.condensation = condensation_;
  io.new_clear_time = clear_time_;
  const CondenseUniforms uniforms = condense_uniforms(settings_.condensation, settings_.surface, frame);
  draw_all(pass::Run<CondensePass>(uniforms, corrected_, settings_.surface.rounding, io), now, executor_);
}

void WetPane::draw(const pass::Moment& now, int frame) {
  leave_traces(now, frame);
  pass::HostIo<NormalsPass> io;
  io.height = height_;
  io.mask = mask_;
  io.normal = normal_;
  draw_all(pass::Run<NormalsPass>(normals_uniforms(settings_.surface), corrected_, settings_.surface.rounding, io), now, executor_);
}

void WetPane::wipe_texture(const pass::Moment& now, int frame) {
  WipeTextureUniforms wipe = wipe_texture_uniforms(settings_.surface, frame);
  wipe.wiper_count = static_cast<std::int32_t>(wipers_.size());
  draw_all(pass::Run<WipeTexturePass>(wipe, corrected_, settings_.surface.rounding,
                                      wipe_texture_io(corrected_, wipers_, {&height_, &mask_, corrected_ ? &wiped_ : nullptr})),
           now, executor_);
}

void WetPane::composite(const pass::Moment& now, const blur_pyramid::LevelTexture& pyramid, std::span<const Image> levels,
                        const Image& scene_depth, std::span<const Glint> lights, bool shows_drops, Image& colour, double before) {
  pass::HostIo<CompositePass> seen;
  seen.blurred.set(pyramid.view(), levels);
  if (corrected_) seen.scene_depth = scene_depth;
  seen.height = height_;
  seen.normal = normal_;
  seen.mask = mask_;
  seen.glints = lights;
  seen.colour = colour;
  CompositeUniforms view = view_;
  if (!shows_drops) {  // a height that no water reaches, so no drop is visible
    view.visible_from = 1e6f;
    view.visible_to = 2e6f;
  }
  draw_all(pass::Run<CompositePass>(view, corrected_, settings_.surface.rounding, seen), now, executor_, before, composite_rows);
}

void WetPane::soften(const pass::Moment& now, const blur_pyramid::LevelTexture& pyramid, std::span<const Image> levels,
                     Image& colour) const {
  if (!has_blades_) return;
  pass::HostIo<SoftenPass> io;
  io.blurred.set(pyramid.view(), levels);
  const std::vector<Deflection> turns = deflections(settings_.smear);
  io.deflections = turns;
  io.smear = smear_;
  io.colour = colour;
  io.softened = colour;
  draw_all(
      pass::Run<SoftenPass>(soften_uniforms(settings_.smear, view_, levels.front().width()), corrected_, settings_.surface.rounding, io),
      now, executor_);
}

void WetPane::mist(const pass::Moment& now, const blur_pyramid::LevelTexture& pyramid, std::span<const Image> levels, Image& colour) const {
  pass::HostIo<MistPass> io;
  io.blurred.set(pyramid.view(), levels);
  const std::vector<Tap> taps = mist_taps(settings_.condensation, levels.front().width(), levels.front().height());
  io.taps = taps;
  io.condensation = condensation_;
  io.colour = colour;
  io.misted = colour;
  draw_all(pass::Run<MistPass>(mist_uniforms(settings_.condensation, view_), corrected_, settings_.surface.rounding, io), now, executor_);
}

std::vector<DropView> WetPane::drops() const {
  std::vector<drops::Drop> all;
  water_.drops.gather(all, executor_);
  std::vector<DropView> out;
  for (const drops::Drop& d : all) out.push_back({d.position[0], d.position[1], d.velocity[0], d.velocity[1], d.mass, d.life, d.id});
  return out;
}

MassBalance WetPane::mass_balance() const {
  return {water_.mass_balance.spawned, water_.mass_balance.evaporated, water_.mass_balance.removed,
          corrected_ ? drops::film_water(water_.film) : 0, corrected_ ? water_.drops.water(executor_) : water_.drops.live()};
}

}  // namespace rainref::windshield
