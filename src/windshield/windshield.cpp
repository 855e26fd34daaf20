// The order of the passes. No arithmetic.
#include "rainref/windshield.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "base/floating_point.h"
#include "capture/pass_clock.h"
#include "drops/wet_glass.h"
#include "pass/display.h"
#include "rainref/error.h"
#include "scene/toml.h"
#include "windshield/memory.h"
#include "windshield/scene_keys.h"
#include "windshield/street.h"
#include "windshield/wipe_drops.h"

namespace rainref::windshield {
namespace {

using capture::Stopwatch;

constexpr int tile_rows = 8;

/// Refuses what does not fit before the drops, the first large thing, are made.
Settings fitting(Settings s, const scene::Config& config, const Surroundings& around) {
  require_memory(fmt::format("windshield.height_size {}x{} with scene.size {}x{} for {} drops", s.surface.width, s.surface.height,
                             s.scene_size[0], s.scene_size[1], s.drops.capacity),
                 memory(s, static_cast<int>(config.integer("run.frames")), {around.colour.width(), around.colour.height()}).peak());
  return s;
}

}  // namespace

struct Windshield::State {
  static void check_pictures(const Surroundings& s) {
    const auto expect = [&](const Image& image, Format format, const char* key) {
      if (image.format() == format && image.width() == s.colour.width() && image.height() == s.colour.height()) return;
      throw Error(ExitCode::usage, fmt::format("{}: expected {} of {}x{}, found {} of {}x{}", key, info(format).name, s.colour.width(),
                                               s.colour.height(), info(image.format()).name, image.width(), image.height()));
    };
    if (s.colour.empty()) return;
    expect(s.colour, Format::rgba16f, "scene.image");
    expect(s.depth, Format::r32f, "scene.depth_image");
  }

  Settings settings;
  const parallel::Executor& executor;
  bool corrected;
  Glass glass;
  PlaneFrame plane;
  Vehicle vehicle;
  int frame = 0;
  std::int64_t steps = 0;

  drops::WetGlass water;
  std::vector<Wiper> wipers;  // of the frame

  Image height, mask, wiped, normal, colour, picture;
  CodeTable display;
  SceneView scene;
  bool own_scene;
  std::optional<StreetDrive> street;
  std::vector<Image> levels;
  std::optional<blur_pyramid::LevelTexture> pyramid;
  std::vector<Glint> lights;

  State(const scene::Config& config, Surroundings surroundings, const parallel::Executor& e)
      : settings(fitting(settings_from(config), config, surroundings)),
        executor(e),
        corrected(settings.corrected),
        glass(make_glass(settings.corners)),
        plane(corrected ? glass.plane() : glass.axes()),
        vehicle(settings.vehicle),
        water(settings.drops, plane.frame, glass.area, settings.fps * settings.substeps, settings.surface.width, settings.surface.height,
              e) {
    check(settings.wipers, glass);
    static_cast<void>(composite_uniforms(settings.picture, settings.corners));  // refuses an eye in the glass
    const int w = settings.surface.width, h = settings.surface.height;
    height = Image(Format::r16f, w, h);
    mask = make_mask(settings.surface);
    if (corrected) wiped = make_wiped(settings.surface);
    normal = Image(Format::rgba16f, w, h);
    colour = Image(Format::rgba16f, settings.picture.width, settings.picture.height);
    picture = Image(Format::rgba8, settings.picture.width, settings.picture.height);
    display = pass::display_table(settings.picture.width, settings.picture.height, settings.picture.exposure, settings.surface.rounding);
    lights = glints(settings.picture);
    own_scene = surroundings.colour.empty();
    check_pictures(surroundings);
    if (own_scene) {
      scene::Camera wide = camera(settings.picture);
      wide.vertical_fov_deg = widened_fov(settings.picture);
      street.emplace(wide, settings.scene_size[0], settings.scene_size[1],
                     StreetOptions{settings.street_start, settings.seed, settings.clear_lane, settings.keyframes, vehicle.at(0).speed == 0},
                     executor);
    } else {
      scene.colour = std::move(surroundings.colour);
      scene.depth = std::move(surroundings.depth);
    }
  }

  double step_time() const { return 1 / (settings.fps * settings.substeps); }
  double frame_time() const { return 1 / settings.fps; }

  pass::Moment moment(Recorder* recorder, int step, double dt) const {
    return {recorder, frame, step, frame / settings.fps, dt, settings.surface.rounding};
  }

  /// body computes it.
  template <class P, class Body>
  void run(const pass::Moment& now, const typename P::Uniforms& uniforms, const pass::HostIo<P>& io, const Body& body) const {
    pass::Run<P> pass(uniforms, corrected, now.rounding, io);
    pass.start(now);
    pass.tile(body);
    pass.finish(now);
  }
  void step(Recorder* recorder, int substep);
  bool look();
};

void Windshield::State::step(Recorder* recorder, int substep) {
  const double dt = step_time(), t = static_cast<double>(steps) * dt;
  const VehicleState car = vehicle.at(t);

  const pass::Moment now = moment(recorder, substep, dt);
  const WindshieldFrameUniforms frame_uniforms = windshield_frame_uniforms(glass, car, settings.wind, settings.gravity, corrected);
  drops::GlassFrame moving{};
  pass::HostIo<WindshieldFramePass> given;
  given.glass_frame.list = [&] { return RecordView{&moving, 1, sizeof moving}; };
  run<WindshieldFramePass>(now, frame_uniforms, given, [&] { moving = windshield_frame(frame_uniforms, corrected); });

  // The wind of the car's axes along the glass's normal.
  const Real3 apparent{settings.wind[0] - car.velocity[0], settings.wind[1] - car.velocity[1], settings.wind[2] - car.velocity[2]};
  const Real3 in_car{car.direction[0] * apparent[0] + car.direction[1] * apparent[1],
                     car.direction[0] * apparent[1] - car.direction[1] * apparent[0], apparent[2]};
  const drops::Exposure exposure{glass.area, glass.normal[2], dot(in_car, glass.normal)};
  water.spawn(now, exposure, steps);
  water.integrate(now, moving);

  // As published the first frame has no frame before it: the blades stand.
  const std::vector<Wiper> swept =
      steps == 0 && !corrected ? wipers_at(settings.wipers, plane, t) : wipers_between(settings.wipers, plane, t, t + dt, corrected);
  wipers.insert(wipers.end(), swept.begin(), swept.end());
  const WipeDropsUniforms wipe =
      wipe_drops_uniforms(glass, corrected, static_cast<int>(swept.size()), settings.capture, drops::radius_of_mass_unit(settings.drops),
                          corrected ? water.film.width() : 0, corrected ? water.film.height() : 0);
  pass::HostIo<WipeDropsPass> swept_io;
  swept_io.drops.list = [&] { return water.list(); };
  swept_io.wipers = swept;
  if (corrected) {
    swept_io.film = water.film;
    swept_io.new_film = water.film;
  }
  run<WipeDropsPass>(now, wipe, swept_io, [&] {
    drops::DropArrays& d = water.drops;
    const std::int64_t drops_before = corrected ? d.water() : 0;
    const std::int64_t gone = static_cast<std::int64_t>(
        wipe_drops(wipe, corrected, swept, {d.u(), d.v(), d.velocity_u(), d.velocity_v(), d.mass(), d.life(), d.id()},
                   corrected ? &water.film : nullptr, executor));
    // What the drops gained, or lost less than what is gone, came from the film.
    water.mass_balance.removed += gone;
    if (corrected) water.mass_balance.to_film -= d.water() - drops_before + gone;
  });

  if (corrected) water.merge(now, steps);
  ++steps;
}

/// The scene as the camera sees it in this frame; whether it is another one than before.
bool Windshield::State::look() {
  if (!own_scene) return levels.empty();
  const bool moves = settings.scene_moves;
  return street->look(moves ? vehicle.at(frame * frame_time()).distance : 0, moves, scene);
}

Windshield::Windshield(const SceneText& scene, Surroundings surroundings, const parallel::Executor& executor) {
  const FloatingPointGuard guard;
  constexpr const char* pictures[] = {"scene.image", "scene.depth_image"};
  const scene::Config config = scene::parse(scene, {"windshield", {"as-published", "corrected"}, parameters()}, pictures);
  state_ = std::make_unique<State>(config, std::move(surroundings), executor);
}
Windshield::Windshield(const scene::Config& config, Surroundings surroundings, const parallel::Executor& executor) {
  const FloatingPointGuard guard;
  state_ = std::make_unique<State>(config, std::move(surroundings), executor);
}
Windshield::~Windshield() = default;
Windshield::Windshield(Windshield&&) noexcept = default;

void Windshield::simulate(Recorder* recorder) {
  const FloatingPointGuard guard;
  State& s = *state_;
  s.wipers.clear();
  for (int substep = 0; substep < s.settings.substeps; ++substep) s.step(recorder, substep);
  ++s.frame;
}

void Windshield::render(Recorder* recorder) {
  const FloatingPointGuard guard;
  State& s = *state_;
  const int recorded_frame = s.frame;
  s.frame = std::max(0, recorded_frame - 1);  // the frame whose water this is
  const parallel::Executor& executor = s.executor;
  const Settings& settings = s.settings;
  const pass::Moment now = s.moment(recorder, 0, s.frame_time());
  const Rounding rounding = settings.surface.rounding;

  s.water.splat(now, settings.splat, s.height);

  WipeTextureUniforms wipe = wipe_texture_uniforms(settings.surface, s.frame);
  wipe.wiper_count = static_cast<std::int32_t>(s.wipers.size());
  pass::Run<WipeTexturePass> wiping(wipe, s.corrected, rounding,
                                    wipe_texture_io(s.corrected, s.wipers, {&s.height, &s.mask, s.corrected ? &s.wiped : nullptr}));
  wiping.start(now);
  wiping.tiles(executor, tile_rows);
  wiping.finish(now);

  const NormalsUniforms slopes = normals_uniforms(settings.surface);
  pass::HostIo<NormalsPass> io;
  io.height = s.height;
  io.mask = s.mask;
  io.normal = s.normal;
  pass::Run<NormalsPass> normals(slopes, s.corrected, rounding, io);
  normals.start(now);
  normals.tiles(executor, tile_rows);
  normals.finish(now);

  // A scene that stands still has its pyramid already.
  const bool anew = s.look();
  const int width = s.scene.colour.width(), height = s.scene.colour.height();
  if (s.levels.empty()) {
    s.levels = blur_pyramid::make_levels(settings.blur, width, height);
    s.pyramid.emplace(s.levels);
  }
  for (int level = 0; level < static_cast<int>(s.levels.size()); ++level) {
    const std::size_t l = static_cast<std::size_t>(level);
    const blur_pyramid::BlurUniforms blur = blur_pyramid::blur_uniforms(settings.blur, width, height, level);
    pass::Moment at_level = now;
    at_level.level = level;
    const auto run = [&](auto pass) {
      pass.start(at_level);
      if (anew) pass.tiles(executor, blur_pyramid::tile_rows);
      pass.finish(at_level);
    };
    if (level == 0)
      run(blur_pyramid::fog_run(blur, rounding, s.scene.colour, s.scene.depth, s.levels[0]));
    else
      run(blur_pyramid::halve_run(blur, s.corrected, rounding, s.levels[l - 1], s.levels[l]));
  }
  Stopwatch pyramid_clock;
  if (anew) s.pyramid->refresh(executor, s.levels);
  pass::HostIo<CompositePass> seen;
  seen.blurred.set(s.pyramid->view(), s.levels);
  if (s.corrected) seen.scene_depth = s.scene.depth;
  seen.height = s.height;
  seen.normal = s.normal;
  seen.mask = s.mask;
  seen.glints = s.lights;
  seen.colour = s.colour;
  const double refreshed = pyramid_clock.seconds();
  pass::Run<CompositePass> composite(composite_uniforms(settings.picture, settings.corners), s.corrected, rounding, seen);
  composite.start(now);
  composite.tiles(executor, tile_rows);
  composite.finish(now, 1, refreshed);

  pass::Run<pass::DisplayPass> display = pass::display_run(settings.picture.exposure, rounding, s.colour, s.picture);
  display.start(now);
  executor.for_tiles(s.colour.width(), s.colour.height(), s.colour.width(), tile_rows,
                     [&](const parallel::Tile& tile) { display.tile([&] { s.display.rows(s.colour, s.picture, tile.y0, tile.y1); }); });
  display.finish(now, executor.threads());
  s.frame = recorded_frame;
}

int Windshield::frame() const { return state_->frame; }
std::vector<DropView> Windshield::drops() const {
  const FloatingPointGuard guard;
  std::vector<drops::Drop> all;
  state_->water.drops.gather(all, state_->executor);
  std::vector<DropView> out;
  for (const drops::Drop& d : all) out.push_back({d.position[0], d.position[1], d.velocity[0], d.velocity[1], d.mass, d.life, d.id});
  return out;
}
MassBalance Windshield::mass_balance() const {
  const FloatingPointGuard guard;
  const State& s = *state_;
  const drops::WetGlass& w = s.water;
  return {w.mass_balance.spawned, w.mass_balance.evaporated, w.mass_balance.removed, s.corrected ? drops::film_water(w.film) : 0,
          s.corrected ? w.drops.water() : w.drops.live()};
}
const Image& Windshield::height() const { return state_->height; }
const Image& Windshield::mask() const { return state_->mask; }
const Image& Windshield::film() const { return state_->water.film; }
const Image& Windshield::normal() const { return state_->normal; }
const Image& Windshield::scene_depth() const { return state_->scene.depth; }
const Image& Windshield::colour() const { return state_->colour; }
const Image& Windshield::picture() const { return state_->picture; }

}  // namespace rainref::windshield
