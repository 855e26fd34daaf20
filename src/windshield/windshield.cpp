// The order of the passes. No arithmetic.
#include "rainref/windshield.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "base/floating_point.h"
#include "capture/pass_clock.h"
#include "effect/picture_sequence.h"
#include "image/flipped.h"
#include "parallel/rows.h"
#include "rainref/error.h"
#include "scene/check.h"
#include "scene/toml.h"
#include "windshield/picture/falling_rain.pass.h"
#include "windshield/windshield_state.h"

namespace rainref::windshield {
namespace {

using capture::Stopwatch;

}  // namespace

void Windshield::State::list(state::Items& items) {
  items.number("frame", frame, state::frames);
  constexpr state::Range ways{-1e10, 1e10};  // [m]; limited because cells of the air are counted
  items.numbers("air_moved", air_moved, ways);
  items.numbers("air_of_frame", air_of_frame, ways);
  for (std::size_t k = 0; k < panes.size(); ++k) {
    items.begin_names_with(k == 0 ? "windshield." : fmt::format("pane_{}.", k));
    panes[k]->list_state(items);
  }
  items.begin_names_with("");
  items.then([this] {
    steps = static_cast<std::int64_t>(frame) * settings.substeps;
    for (const auto& pane : panes) {
      pane->begin_frame();
      for (std::int64_t n = std::max<std::int64_t>(0, steps - settings.substeps); n < steps; ++n)
        pane->sweep(n, static_cast<double>(n) * step_time(), step_time());
      if (const double last = static_cast<double>(steps - 1) * step_time(); steps > 0) pane->take_forces(last, vehicle.at(last), weather);
    }
  });
}

// The steps of pane k are numbered after those of the panes before it.
void Windshield::State::step(Recorder* recorder, int substep) {
  const double dt = step_time(), t = static_cast<double>(steps) * dt;
  const VehicleState car = vehicle.at(t);
  for (std::size_t k = 0; k < panes.size(); ++k)
    panes[k]->step(moment(recorder, static_cast<int>(k) * settings.substeps + substep, dt), steps, t, car, weather);
  const Real3 wind = apparent_wind(car, weather.wind(t));
  for (std::size_t axis = 0; axis < 3; ++axis) air_moved[axis] += wind[axis] * dt;
  ++steps;
}

/// Updates the scene in the camera's view in this frame, with the blades if they are shown; returns whether it changed.
bool Windshield::State::look() {
  const bool is_new = look_at_scene();
  if (!settings.shows_blades) return is_new;
  scene::Camera eye = camera(settings.picture);
  eye.vertical_fov_deg = widened_fov(settings.picture);
  std::vector<SeenBlade> now;
  for (const auto& pane : panes) add_seen(now, pane->wipers(), pane->glass(), eye);
  if (!is_new && now == blades) return false;
  blades = std::move(now);
  copy_into(scene.colour, without_blades.colour, parallel::rows_of(executor));
  copy_into(scene.depth, without_blades.depth, parallel::rows_of(executor));
  const double half_height = eye.half_height();
  draw_blades(blades, {half_height * settings.picture.width / settings.picture.height, half_height}, scene, executor);
  return true;
}
bool Windshield::State::look_at_scene() {
  if (!own_scene) return std::exchange(scene_is_new, false) || levels.empty();
  const bool moves = settings.scene_moves;
  return street->look(moves ? vehicle.at(frame * frame_time()).distance : 0, moves, looked_at());
}

/// falling_rain, on level 0 of the pyramid.
void Windshield::State::rain_behind(const pass::Moment& now) {
  const Stopwatch clock;
  const double t = frame * frame_time();
  const VehicleState car = vehicle.at(t);
  const double rate = corrected ? weather.rain(t) : settings.falling.rate;
  const Air air{t, air_of_frame, apparent_wind(car, weather.wind(t)), rate, mean_radiance(scene.colour)};
  RainView view{camera(settings.picture), scene.colour.width(), scene.colour.height()};
  view.camera.vertical_fov_deg = widened_fov(settings.picture);
  std::vector<Glass> glasses;
  for (const auto& pane : panes) glasses.push_back(pane->glass());
  std::vector<RainLamp> lamps;
  if (street) lamps = lamps_from(street->street(), place_in_street(settings.street_start, settings.scene_moves ? car.distance : 0));
  falling = falling_drops(settings.falling, settings.seed, air, view, glasses, lamps);
  // Straight ahead of the car, as far as visible, the road continues.
  std::erase_if(falling, [&](const FallingDrop& drop) {
    return is_covered(settings.weather.shelter, car.distance + 0.5 * (drop.from.x + drop.to.x));
  });
  std::vector<Streak> streaks;
  for (const FallingDrop& drop : falling) streaks.push_back(drop.streak);

  FallingRainUniforms uniforms{};
  uniforms.streak_count = static_cast<std::int32_t>(streaks.size());
  uniforms.sharpness = 10;  // an object in the street hides a streak within 10 cm
  pass::HostIo<FallingRainPass> io;
  io.blurred = levels[0];
  io.scene_depth = scene.depth;
  io.streaks = streaks;
  io.rainy = levels[0];
  pass::Run<FallingRainPass> run(uniforms, corrected, settings.surface.rounding, io);
  const double prepared = clock.seconds();
  run.start(now);
  run.tiles(executor, 16, 32);  // in place, so tiles have columns of whole vectors
  run.finish(now, 1, prepared);
}

/// blur_pyramid and the view through all panes.
void Windshield::State::look_through(const pass::Moment& now) {
  const Rounding rounding = settings.surface.rounding;
  // A still scene already has its pyramid.
  const bool anew = look() || settings.falling.on;
  const int width = scene.colour.width(), height = scene.colour.height();
  if (levels.empty()) {
    levels = blur_pyramid::make_levels(settings.blur, width, height);
    pyramid.emplace(levels);
  }
  for (int level = 0; level < static_cast<int>(levels.size()); ++level) {
    const std::size_t l = static_cast<std::size_t>(level);
    const blur_pyramid::BlurUniforms blur = blur_pyramid::blur_uniforms(settings.blur, width, height, level);
    pass::Moment at_level = now;
    at_level.level = level;
    const auto run = [&](auto pass) {
      pass.start(at_level);
      if (anew) pass.tiles(executor, blur_pyramid::tile_rows(levels[l].height()));
      pass.finish(at_level);
    };
    if (level == 0) {
      run(blur_pyramid::fog_run(blur, rounding, scene.colour, scene.depth, levels[0]));
      if (settings.falling.on) rain_behind(now);
    } else {
      run(blur_pyramid::halve_run(blur, corrected, rounding, levels[l - 1], levels[l]));
    }
  }
  Stopwatch pyramid_clock;
  if (anew) pyramid->refresh(executor, levels);
  const double refreshed = pyramid_clock.seconds();
  show_panes(now, true, colour, refreshed);
}

Windshield::Windshield(const SceneText& scene, Surroundings surroundings, const parallel::Executor& executor) {
  const FloatingPointGuard guard;
  constexpr const char* pictures[] = {"scene.image", "scene.depth_image"};
  const scene::Config config = scene::parse(scene, {"windshield", {"as-published", "corrected"}, parameters()}, pictures);
  effect::refuse_unused_sequence(config, {"scene.image", "scene.depth_image"});
  if (config.given("scene.depth"))
    scene::refuse(config.entry("scene.depth").origin, "scene.depth", "expected none beside pictures in memory");
  state_ = std::make_unique<State>(config, std::move(surroundings), executor);
}
Windshield::Windshield(const scene::Config& config, Surroundings surroundings, const parallel::Executor& executor) {
  const FloatingPointGuard guard;
  state_ = std::make_unique<State>(config, std::move(surroundings), executor);
}
Windshield::~Windshield() = default;
Windshield::Windshield(Windshield&&) noexcept = default;

void Windshield::show(Surroundings scene) {
  const FloatingPointGuard guard;
  State& s = *state_;
  if (s.own_scene) throw Error(ExitCode::usage, "scene.image: expected pictures from the start, found a street");
  if (scene.colour.width() != s.looked_at().colour.width() || scene.colour.height() != s.looked_at().colour.height())
    throw Error(ExitCode::usage, fmt::format("scene.image: expected {}x{} texels as before, found {}x{}", s.looked_at().colour.width(),
                                             s.looked_at().colour.height(), scene.colour.width(), scene.colour.height()));
  State::check_pictures(scene);
  s.looked_at().colour = std::move(scene.colour);
  s.looked_at().depth = std::move(scene.depth);
  s.scene_is_new = true;
}

void Windshield::simulate(Recorder* recorder) {
  const FloatingPointGuard guard;
  State& s = *state_;
  s.air_of_frame = s.air_moved;
  for (const auto& pane : s.panes) pane->begin_frame();
  for (int substep = 0; substep < s.settings.substeps; ++substep) s.step(recorder, substep);
  ++s.frame;
}

void Windshield::skip(Recorder* recorder) {
  const FloatingPointGuard guard;
  State& s = *state_;
  const int recorded_frame = s.frame;
  s.frame = std::max(0, recorded_frame - 1);  // the frame to which this water belongs
  for (std::size_t k = 0; k < s.panes.size(); ++k)
    s.panes[k]->leave_traces(s.moment(recorder, static_cast<int>(k), s.frame_time()), s.frame);
  s.frame = recorded_frame;
}

void Windshield::render(Recorder* recorder) {
  const FloatingPointGuard guard;
  State& s = *state_;
  const int recorded_frame = s.frame;
  s.frame = std::max(0, recorded_frame - 1);  // the frame to which this water belongs
  for (std::size_t k = 0; k < s.panes.size(); ++k) s.panes[k]->draw(s.moment(recorder, static_cast<int>(k), s.frame_time()), s.frame);
  const pass::Moment now = s.moment(recorder, 0, s.frame_time());
  s.look_through(now);
  if (s.settings.interior.on) s.sit_inside(now, s.colour);

  pass::Run<pass::DisplayPass> display = pass::display_run(s.settings.picture.exposure, s.settings.surface.rounding, s.colour, s.picture);
  display.start(now);
  s.executor.for_tiles(s.colour.width(), s.colour.height(), s.colour.width(), tile_rows,
                       [&](const parallel::Tile& tile) { display.tile([&] { s.display.rows(s.colour, s.picture, tile.y0, tile.y1); }); });
  display.finish(now, s.executor.threads());
  s.frame = recorded_frame;
}

void Windshield::list_state(state::Items& items) {
  const FloatingPointGuard guard;
  state_->list(items);
}

int Windshield::frame() const { return state_->frame; }
int Windshield::panes() const {
  const FloatingPointGuard guard;
  return static_cast<int>(state_->panes.size());
}
std::vector<DropView> Windshield::drops(int pane) const {
  const FloatingPointGuard guard;
  return state_->pane(pane).drops();
}
MassBalance Windshield::mass_balance(int pane) const {
  const FloatingPointGuard guard;
  return state_->pane(pane).mass_balance();
}
const Image& Windshield::height(int pane) const { return state_->pane(pane).height(); }
const Image& Windshield::mask(int pane) const { return state_->pane(pane).mask(); }
const Image& Windshield::film(int pane) const { return state_->pane(pane).film(); }
const Image& Windshield::normal(int pane) const { return state_->pane(pane).normal(); }
const Image& Windshield::smear(int pane) const { return state_->pane(pane).smear(); }
const Image& Windshield::condensation(int pane) const { return state_->pane(pane).condensation(); }
const Image& Windshield::scene_colour() const { return state_->scene.colour; }
const Image& Windshield::scene_depth() const { return state_->scene.depth; }
std::vector<FallingDropView> Windshield::falling() const {
  const FloatingPointGuard guard;
  const auto three = [](const scene::Vector3& v) { return std::array<double, 3>{v.x, v.y, v.z}; };
  std::vector<FallingDropView> out;
  for (const FallingDrop& d : state_->falling) out.push_back({three(d.from), three(d.to), d.radius, d.time_share, three(d.radiance)});
  return out;
}
const Image& Windshield::colour() const { return state_->colour; }
const Image& Windshield::picture() const { return state_->picture; }

}  // namespace rainref::windshield
