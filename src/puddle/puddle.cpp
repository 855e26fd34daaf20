// The order of the passes. No arithmetic.
#include "rainref/puddle.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "base/floating_point.h"
#include "capture/pass_clock.h"
#include "parallel/rows.h"
#include "pass/planes.h"
#include "pass/run.h"
#include "puddle/display.pass.h"
#include "puddle/shade.pass.h"
#include "puddle/surface_hit.pass.h"
#include "puddle/bounds.h"
#include "puddle/host.h"
#include "puddle/kernels.h"
#include "puddle/objects.h"
#include "puddle/raindrops.pass.h"
#include "puddle/rainfall.h"
#include "puddle/scenery.h"
#include "puddle/wave_step.pass.h"
#include "rainref/error.h"
#include "rainref/executor.h"
#include "state/items.h"

namespace rainref::puddle {
namespace {

using capture::Stopwatch;

constexpr int wave_tile_rows = 32, picture_tile_rows = 2, picture_tile_columns = 256;

Format channel_format(Format storage) {
  switch (storage) {
    case Format::rg16f:
      return Format::r16f;
    case Format::rg32f:
      return Format::r32f;
    case Format::rgba8:
      return Format::r8;
    default:
      throw Error(ExitCode::usage, "puddle.storage: expected rg16f, rg32f or rgba8");
  }
}

}  // namespace

struct Puddle::State {
  Settings settings;
  const parallel::Executor& executor;
  bool corrected;
  Encoding encoding;
  int frame = 0;
  std::int64_t steps = 0;
  Image newest, previous, rest_row;
  float stored_rest = 0;  // encoding.rest as rounded for storage
  Rainfall rainfall;
  Objects objects;

  std::shared_ptr<const Sky> sky;
  std::shared_ptr<const Ground> ground;
  std::shared_ptr<const Bed> bed;  // for corrected
  TextureData water;               // one channel of the wave, decoded
  Image hit, normal, noise, colour, picture;
  std::shared_ptr<const CodeSteps> display;  // for corrected
  bool is_moderate = false;                  // for corrected: shade_or_background may replace shade
  Image behind;                              // then: the surroundings that it keeps

  State(const Settings& s, const Surroundings& around, const parallel::Executor& e)
      : settings(s),
        executor(e),
        corrected(s.variant == Variant::corrected),
        encoding(puddle::encoding(s)),
        rainfall(corrected ? s : no_rain(s), 1 / encoding.scale, corrected ? shelter_of(s, around.shelter) : Shelter{}),
        objects(s, 1 / encoding.scale) {
    const auto [columns, rows] = wave_size(s);
    const Format format = channel_format(s.storage);
    newest = Image(format, columns, rows);
    previous = Image(format, columns, rows);
    rest_row = Image(format, columns, 1);
    set_rest();
    sky = sky_of(s, around, parallel::rows_of(e));
    ground = ground_of(s, around, parallel::rows_of(e));
    if (corrected) {
      bed = bed_of(s);
      display = cache::prepared(
          "puddle display", 0, +[](const int&, const Rounding& rounding) { return display_steps(rounding); }, s.rounding);
      is_moderate = s.ground_reach > 0 && are_moderate(sky->environment.view(), ground->tile.view());
      if (is_moderate) behind = Image(Format::rgba16f, s.width, s.height);
    }
    environment_is_cube = around.environment_is_cube;
    hit = Image(Format::rgba32f, s.width, s.height);
    normal = Image(Format::rgba16f, s.width, s.height);
    colour = Image(Format::rgba16f, s.width, s.height);
    picture = Image(Format::rgba8, s.width, s.height);
    if (!corrected) noise = Image(Format::r32f, s.width, s.height);
    const Address edge = !corrected && s.boundary == Boundary::periodic ? Address::repeat : Address::clamp;
    water = TextureData(zeroed::Array<float>(static_cast<std::size_t>(columns) * rows), 1, columns, rows, edge, edge);
    water.set_border(encoding.rest, 0, 0, 0);
  }

  bool environment_is_cube = false;

  /// True if all texels are below 1e12. The environment is non-negative, so its mean times its number of texels bounds each texel.
  static bool are_moderate(const Texture& environment, const Texture& tile) {
    const int last = environment.levels - 1;
    if (environment.width[last] != 1 || environment.height[last] != 1) return false;
    const double texels = static_cast<double>(environment.width[0]) * environment.height[0];
    for (int k = 0; k < 3; ++k)
      if (!(environment.texels[4 * static_cast<std::ptrdiff_t>(environment.offset[last]) + k] * texels < 1e12)) return false;
    const std::ptrdiff_t values = 4 * static_cast<std::ptrdiff_t>(tile.width[0]) * tile.height[0];
    return std::all_of(tile.texels, tile.texels + values, [](float x) { return x > -1e12f && x < 1e12f; });
  }

  /// Null if there is none.
  const Image* shore() const { return bed && !bed->shore.empty() ? &bed->shore : nullptr; }

  static Settings no_rain(Settings s) {
    s.rain_rate = 0;
    return s;
  }

  void set_rest() {
    const Image& p = newest;
    const std::vector<float> level(static_cast<std::size_t>(p.width()) * p.height(), encoding.rest);
    encode(level, newest);
    encode(level, previous);
    encode(std::vector<float>(static_cast<std::size_t>(p.width()), encoding.rest), rest_row);
    stored_rest = TextureData(rest_row, Address::clamp, Address::clamp).texels()[0];
  }
  // Encodes stored values, row-major, into a plane with its ghosts.
  void encode(const std::vector<float>& stored, Image& plane) const {
    encode_rows(stored.data(), plane, settings.boundary, encoding.rest, settings.rounding);
  }

  void wave_tiles(const std::function<void(const parallel::Tile&)>& body) const {
    executor.for_tiles(newest.width(), newest.height(), newest.width(), wave_tile_rows, body);
  }

  double frame_time() const { return 1 / settings.fps; }
  double step_time() const { return corrected ? 1 / settings.step_rate : frame_time(); }
  /// For a pass of this frame with the time step dt.
  pass::Moment moment(Recorder* recorder, int step, double dt) const {
    return {recorder, frame, step, frame / settings.fps, dt, settings.rounding};
  }
  /// The drops of the steps [first, first + count), each computed separately.
  std::vector<std::vector<Drop>> fallen(std::int64_t first, std::int64_t count) const {
    std::vector<std::vector<Drop>> drops(static_cast<std::size_t>(count));
    executor.for_range(count, 1, [&](std::int64_t k, std::int64_t) {
      drops[static_cast<std::size_t>(k)] =
          corrected ? rainfall.drops(first + k, objects.records(first + k)) : raindrops_as_published(raindrops_uniforms(settings, frame));
    });
    return drops;
  }
  /// Records pass raindrops of a step, which took `seconds`.
  void show_raindrops(const pass::Moment& now, std::int64_t step, const std::vector<Drop>& drops, double seconds) const {
    const auto run = [&](const auto& pass) {
      pass.start(now);
      pass.finish(now, 1, seconds);
    };
    if (corrected) {
      pass::HostIo<RaindropsPass> io;
      io.craters = rainfall.craters();
      io.count_thresholds = rainfall.count_thresholds();
      io.shelter = rainfall.shelter();
      const std::vector<Drop> moved = objects.records(step);
      io.objects = moved;
      io.drops = drops;
      run(pass::Run<RaindropsPass>(rainfall.uniforms(step, moved.size()), true, settings.rounding, io));
    } else {
      pass::HostIo<PublishedRaindropsPass> io;
      io.drops = drops;
      run(pass::Run<PublishedRaindropsPass>(raindrops_uniforms(settings, frame), false, settings.rounding, io));
    }
  }
  /// Passes raindrops and wave_step of the steps [steps, end) of one frame. wave: the external view of the levels.
  void advance(Recorder* recorder, std::int64_t end, const BufferView& wave) {
    const pass::Moment first = moment(recorder, 0, step_time());
    // Intermediate levels are only made for a recorder that reads them; else the steps of a frame run together.
    const std::int64_t together = first.is_read("wave_step") || first.is_read("raindrops") ? 1 : end - steps;
    for (int step = 0; steps < end;) {
      const Stopwatch watch;
      const std::vector<std::vector<Drop>> drops = fallen(steps, together);
      const double seconds = watch.seconds() / static_cast<double>(together);
      for (std::int64_t k = 0; k < together; ++k, ++steps)
        show_raindrops(moment(recorder, step + static_cast<int>(k), step_time()), steps, drops[static_cast<std::size_t>(k)], seconds);
      make_wave(moment(recorder, step, step_time()), drops, wave);
      step += static_cast<int>(together);
    }
  }
  /// Pass wave_step for one step per list of drops.
  void make_wave(pass::Moment now, const std::vector<std::vector<Drop>>& drops, const BufferView& wave) {
    std::vector<WaveJob> jobs;
    for (const std::vector<Drop>& fallen : drops) {
      const bool even = jobs.size() % 2 == 0;
      WaveJob& job = jobs.emplace_back(WaveJob{wave_step_uniforms(settings), corrected, settings.rounding, settings.boundary,
                                               even ? &newest : &previous, even ? &previous : &newest, &rest_row, shore(), fallen});
      job.uniforms.drop_count = static_cast<std::int32_t>(fallen.size());
    }
    const PassInput loaded = loaded_wave(wave);
    double seconds = 0;  // for all steps
    for (std::size_t k = 0; k < jobs.size(); ++k, ++now.step) {
      pass::HostIo<WaveStepPass> io;
      io.wave.input = &loaded;
      io.drops = drops[k];
      if (jobs[k].shore) io.shore = *jobs[k].shore;
      io.next.planes = &wave;
      pass::Run<WaveStepPass> run(jobs[k].uniforms, corrected, settings.rounding, io);
      run.start(now);
      if (k == 0) {
        const Stopwatch watch;
        step_wave(jobs, executor);
        if (jobs.size() % 2 == 1) std::swap(newest, previous);
        seconds = watch.seconds();
      }
      run.finish(now, 1, seconds / static_cast<double>(jobs.size()));
    }
  }
  /// The boundary rule is an address rule, the border the stored rest value.
  Address address() const {
    constexpr Address rules[] = {Address::clamp, Address::repeat, Address::border};
    return rules[static_cast<int>(settings.boundary)];
  }
  /// The wave as wave_step loads it.
  PassInput loaded_wave(BufferView wave) const {
    return {"wave", std::move(wave), Filter::none, Filter::none, address(), {stored_rest, stored_rest, 0, 0}};
  }
  void fill_ghosts() {
    for (Image* plane : {&newest, &previous}) {
      pass::in_storage(plane->format(), [&]<class Storage>(Storage) {
        for (int y = 0; y < plane->height(); ++y)
          pass::fill_margins(plane->row<Storage>(y), plane->width(), address(), rest_row.row<Storage>(0)[0]);
      });
    }
  }
  void list(state::Items& items) {
    items.number("frame", frame, state::frames);
    constexpr state::Range levels{-1e4, 1e4};  // higher than any wave, and such that steps stay finite
    items.image("newest", newest, levels);
    items.image("previous", previous, levels);
    items.then([this] {
      steps = steps_until(settings, frame);
      fill_ghosts();
    });
  }
};

Puddle::Puddle(const Settings& settings, const Surroundings& surroundings, const parallel::Executor& executor) {
  const FloatingPointGuard guard;
  check(settings);
  check_memory(settings, sizes_of(surroundings));
  state_ = std::make_unique<State>(settings, surroundings, executor);
}
Puddle::~Puddle() = default;
Puddle::Puddle(Puddle&&) noexcept = default;

void Puddle::simulate(Recorder* recorder) {
  const FloatingPointGuard guard;
  State& s = *state_;
  const std::int64_t end = steps_until(s.settings, s.frame + 1);
  s.advance(recorder, end, wave());
  ++s.frame;
}

void Puddle::render(Recorder* recorder) {
  const FloatingPointGuard guard;
  State& s = *state_;
  const int recorded_frame = s.frame;
  s.frame = std::max(0, recorded_frame - 1);  // the frame to which this water belongs

  Stopwatch hit_time;
  SurfaceHitUniforms u = surface_hit_uniforms(s.settings);
  // As published the green channel: the previous level. Corrected: the newest.
  const Image& shown = s.corrected ? s.newest : s.previous;
  float* decoded = s.water.texels();
  s.wave_tiles([&](const parallel::Tile& tile) { decode_rows(shown, decoded, tile); });
  TextureData bounds;
  if (s.corrected) bounds = surface_bounds(s.settings, decoded, s.executor, u);
  const double prepared = hit_time.seconds();

  const bool corrected = s.corrected;
  const Rounding rounding = s.settings.rounding;
  const BufferView stored_wave = wave();
  pass::HostIo<SurfaceHitPass> at_hit;
  at_hit.wave = s.water.view();
  at_hit.wave.recorded = &stored_wave;
  if (corrected) at_hit.bounds = bounds.view();
  at_hit.hit = s.hit;
  at_hit.normal = s.normal;
  pass::Run<SurfaceHitPass> surface_hit(u, corrected, rounding, at_hit);

  std::optional<pass::Run<GroundNoisePass>> ground_noise;
  if (!corrected) {
    pass::HostIo<GroundNoisePass> io;
    io.hit = s.hit;
    io.normal = s.normal;
    io.noise = s.noise;
    ground_noise.emplace(ground_noise_uniforms(s.settings), corrected, rounding, io);
  }

  ShadeUniforms of_shade = shade_uniforms(s.settings);
  of_shade.environment_is_cube = s.environment_is_cube;
  of_shade.ground_footprint = ground_footprint(s.settings, s.ground->tile.view().width[0]);
  if (corrected) of_shade.gloss_level = gloss_level(s.sky->environment.view().width[0], s.environment_is_cube);
  for (int k = 0; k < 3; ++k) of_shade.ambient[k] = of_shade.fog_colour[k] = s.sky->ambient[k];
  pass::HostIo<ShadePass> at_shade;
  at_shade.hit = s.hit;
  at_shade.normal = s.normal;
  at_shade.environment = s.sky->environment.view();
  at_shade.ground = s.ground->tile.view();
  if (corrected) {
    // For a cube the level is the nearest one.
    at_shade.environment.is.mip_filter = s.environment_is_cube ? Filter::nearest : Filter::linear;
    at_shade.ground.is.mip_filter = Filter::nearest;
    at_shade.relief = s.ground->relief.view();
    at_shade.bed = s.bed->depths.view();
  } else {
    at_shade.noise = s.noise;
  }
  at_shade.colour = s.colour;
  pass::Run<ShadePass> shade(of_shade, corrected, rounding, at_shade);

  pass::HostIo<DisplayPass> at_display;
  at_display.colour = s.colour;
  at_display.picture = s.picture;
  const DisplayUniforms of_display = display_uniforms(s.settings);
  pass::Run<DisplayPass> display(of_display, corrected, rounding, at_display);

  // These passes read no neighbours, so all of them run on a tile while it is in the cache.
  s.executor.for_tiles(s.settings.width, s.settings.height, picture_tile_columns, picture_tile_rows, [&](const parallel::Tile& tile) {
    surface_hit.tile(tile);
    if (ground_noise) ground_noise->tile(tile);
    if (s.is_moderate)
      shade.tile([&] { shade_or_background(of_shade, rounding, at_shade, s.colour, s.behind, tile); });
    else
      shade.tile(tile);
    if (!s.display || s.display->empty())
      display.tile(tile);
    else
      display.tile([&] { display_by_steps(of_display, *s.display, s.colour, s.picture, tile); });
  });
  // None of them overwrites its inputs, so their starts may be recorded after all have run.
  const int threads = s.executor.threads();
  const pass::Moment now = s.moment(recorder, 0, s.frame_time());
  surface_hit.start(now);
  surface_hit.finish(now, threads, prepared);
  if (ground_noise) {
    ground_noise->start(now);
    ground_noise->finish(now, threads);
  }
  shade.start(now);
  shade.finish(now, threads);
  display.start(now);
  display.finish(now, threads);
  s.frame = recorded_frame;
}

void Puddle::set_water(const std::vector<float>& newest, const std::vector<float>& previous) {
  const FloatingPointGuard guard;
  State& s = *state_;
  const std::size_t cells = static_cast<std::size_t>(s.newest.width()) * s.newest.height();
  if (newest.size() != cells || previous.size() != cells) throw Error(ExitCode::internal, "set_water: sizes differ from the wave's");
  std::vector<float> stored(cells);
  const auto put = [&](const std::vector<float>& heights, Image& plane) {
    for (std::size_t i = 0; i < cells; ++i) stored[i] = static_cast<float>((heights[i] - s.encoding.bias) / s.encoding.scale);
    s.encode(stored, plane);
  };
  put(newest, s.newest);
  put(previous, s.previous);
}

void Puddle::list_state(state::Items& items) {
  const FloatingPointGuard guard;
  state_->list(items);
}

int Puddle::frame() const { return state_->frame; }
std::int64_t Puddle::steps() const { return state_->steps; }
double Puddle::courant() const {
  const FloatingPointGuard guard;
  return courant_number(state_->settings);
}
const Image& Puddle::newest() const { return state_->newest; }
const Image& Puddle::previous() const { return state_->previous; }
BufferView Puddle::wave() const { return BufferView(state_->settings.storage, {&state_->newest, &state_->previous}); }
const Image& Puddle::hit() const { return state_->hit; }
const Image& Puddle::normal() const { return state_->normal; }
const Image& Puddle::colour() const { return state_->colour; }
const Image& Puddle::picture() const { return state_->picture; }

}  // namespace rainref::puddle
