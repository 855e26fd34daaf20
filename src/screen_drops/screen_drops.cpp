// The order of the passes. No arithmetic.
#include "rainref/screen_drops.h"

#include <algorithm>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/floating_point.h"
#include "blur_pyramid/blur_pyramid.h"
#include "cache/prepared.h"
#include "capture/pass_clock.h"
#include "parallel/rows.h"
#include "pass/display.h"
#include "rainref/error.h"
#include "scene/toml.h"
#include "screen_drops/background.pass.h"
#include "screen_drops/cells.pass.h"
#include "screen_drops/drops.pass.h"
#include "screen_drops/flow.h"
#include "screen_drops/host.h"
#include "screen_drops/parameters.h"
#include "state/items.h"

namespace rainref::screen_drops {
namespace {

constexpr int tile_rows = 4, cell_rows = 4;

/// The scene's picture with its mip levels, as images and as one texture.
struct SceneLevels {
  std::vector<Image> levels;
  std::unique_ptr<blur_pyramid::LevelTexture> texture;
  std::size_t bytes() const { return 2 * cache::bytes_of(levels); }
  void add_to(cache::Recipe& recipe) const { recipe.add_read(levels); }
};
SceneLevels make_levels(const parallel::Executor& executor, const Image& colour) {
  SceneLevels made{scene_levels(colour, parallel::rows_of(executor)), {}};
  for (Image& level : made.levels) level.share();
  made.texture = std::make_unique<blur_pyramid::LevelTexture>(made.levels);
  made.texture->refresh(executor, made.levels);
  return made;
}

pass::Run<BackgroundPass> background_run(const SceneLevels& scene, const BackgroundUniforms& uniforms, const std::vector<Tap>& taps,
                                         Address wrap, bool corrected, Rounding rounding, Image& background) {
  pass::HostIo<BackgroundPass> io;
  io.scene.set(scene.texture->view(), scene.levels, wrap);
  if (corrected) io.taps = taps;
  io.background = background;
  return {uniforms, corrected, rounding, io};
}
Image make_background(const parallel::Executor& executor, const SceneLevels& scene, const BackgroundUniforms& uniforms,
                      const std::vector<Tap>& taps, const Address& wrap, const bool& corrected, const Rounding& rounding, const int& width,
                      const int& height) {
  Image background(Format::rgba16f, width, height);
  background_run(scene, uniforms, taps, wrap, corrected, rounding, background).tiles(executor, tile_rows);
  return background;
}

/// As published: as stored, and decoded.
struct Noise {
  Image stored;
  TextureData texture;
  std::size_t bytes() const { return cache::bytes_of(stored) + texture.bytes(); }
};
Noise make_noise_map(const int&, const Image& own, const std::uint64_t& seed, const int& side) {
  Noise made{own.empty() ? make_noise(seed, side) : stored_noise(own), {}};
  made.texture = TextureData(made.stored, Address::repeat, Address::repeat);
  return made;
}

void check_memory(const Settings& s, const FlowSettings* flow) {
  require_memory(fmt::format("run.size {}x{}{}", s.width, s.height, flow ? fmt::format(" with {} drops", flow->drops.capacity) : ""),
                 memory(s, flow).peak());
}

}  // namespace

struct ScreenDrops::State {
  Settings settings;
  const parallel::Executor& executor;
  bool corrected;
  int frame = 0;
  bool has_background = false;
  bool background_is_recorded = false;  ///< in the saved run; then it is not recorded again
  std::shared_ptr<const SceneLevels> scene;
  bool is_film = false;  ///< transient pictures are not cached
  std::vector<Tap> taps;
  std::array<Layer, layers> grids{};
  std::optional<Flow> flow;
  std::vector<DrawnCell> drawn_cells;
  std::shared_ptr<const Noise> noise;
  Image no_height, background, cells, water, colour, picture;
  std::vector<Image> earlier_backgrounds;  ///< kept because Python arrays may view their memory
  CodeTable display;

  State(const Settings& s, const Inputs& in, const parallel::Executor& e, const FlowSettings* flowing)
      : settings(s),
        executor(e),
        corrected(s.variant == Variant::corrected),
        scene(cache::prepared("screen_drops levels", e, make_levels, in.colour)) {
    if (corrected) {
      taps = make_taps(s);
      grids = make_layers(s);
      const std::array<int, 2> size = cells_size(grids);
      cells = Image(Format::rgba32f, size[0], size[1]);
      drawn_cells.resize(static_cast<std::size_t>(size[0]) * static_cast<std::size_t>(size[1]));
      no_height = Image(Format::r16f, 1, 1);
      if (flowing != nullptr) flow.emplace(*flowing, e);
    } else {
      noise = cache::prepared("screen_drops noise", 0, make_noise_map, in.noise, s.seed, s.noise_size);
    }
    background = Image(Format::rgba16f, s.width, s.height);
    water = Image(Format::r8, s.width, s.height);
    colour = Image(Format::rgba16f, s.width, s.height);
    picture = Image(Format::rgba8, s.width, s.height);
    display = pass::display_table(s.width, s.height, s.exposure, s.rounding);
  }

  Address wrap() const { return corrected ? Address::clamp : settings.wrap; }
  const Image& height() const { return flow ? flow->height() : no_height; }

  int shown() const { return std::max(0, frame - 1); }
  pass::Moment moment(Recorder* recorder) const {
    return {recorder, shown(), 0, shown() / settings.fps, 1 / settings.fps, settings.rounding};
  }
  void replace_background(Image by) { earlier_backgrounds.push_back(std::exchange(background, std::move(by))); }
  void blur(const pass::Moment& now) {
    const BackgroundUniforms u = background_uniforms(settings);
    pass::Run<BackgroundPass> run = background_run(*scene, u, taps, wrap(), corrected, settings.rounding, background);
    run.start(now);
    const capture::Stopwatch watch;
    if (is_film)
      run.tiles(executor, tile_rows);
    else
      replace_background(cache::prepared("screen_drops background", executor, make_background, *scene, u, taps, wrap(), corrected,
                                         settings.rounding, settings.width, settings.height)
                             ->shared());
    run.finish(now, 1, is_film ? 0 : watch.seconds());
  }
  void fill_cells(const pass::Moment& now) {
    const CellsUniforms u = cells_uniforms(settings, grids, shown());
    pass::HostIo<CellsPass> io;
    io.cells = cells;
    pass::Run<CellsPass> run(u, true, settings.rounding, io);
    run.start(now);
    run.tile([&] {
      executor.for_range(cells.height(), cell_rows, [&](std::int64_t begin, std::int64_t end) {
        cells_rows(u, drawn_cells, cells, static_cast<int>(begin), static_cast<int>(end));
      });
    });
    run.finish(now);
  }
};

ScreenDrops::ScreenDrops(const SceneText& scene, const Inputs& inputs, const parallel::Executor& executor) {
  const FloatingPointGuard guard;
  constexpr const char* pictures[] = {"scene.image", "scene.panorama", "noise.image"};
  const scene::Config config = scene::parse(scene, {"screen_drops", {"as-published", "corrected"}, parameters()}, pictures);
  const Settings settings = settings_from(config);
  check(settings);
  check(settings, inputs);
  const std::optional<FlowSettings> flow = flow_from(config, settings);
  check_memory(settings, flow ? &*flow : nullptr);
  state_ = std::make_unique<State>(settings, inputs, executor, flow ? &*flow : nullptr);
}
ScreenDrops::ScreenDrops(const Settings& settings, const Inputs& inputs, const parallel::Executor& executor, const FlowSettings* flow) {
  const FloatingPointGuard guard;
  check(settings);
  check(settings, inputs);
  check_memory(settings, flow);
  if (flow != nullptr && settings.variant != Variant::corrected)
    throw Error(ExitCode::internal, "screen_drops: as published nothing flows");
  state_ = std::make_unique<State>(settings, inputs, executor, flow);
}
ScreenDrops::~ScreenDrops() = default;
ScreenDrops::ScreenDrops(ScreenDrops&&) noexcept = default;

void ScreenDrops::simulate(Recorder* recorder) {
  const FloatingPointGuard guard;
  if (state_->flow) state_->flow->simulate(recorder);
  ++state_->frame;
}

void ScreenDrops::show(const Image& colour) {
  const FloatingPointGuard guard;
  show_again(colour);
  state_->background_is_recorded = false;
}

void ScreenDrops::show_again(const Image& colour) {
  const FloatingPointGuard guard;
  State& s = *state_;
  check_scene(s.settings, colour);
  s.scene = std::make_shared<const SceneLevels>(make_levels(s.executor, colour));
  if (!std::exchange(s.is_film, true)) s.replace_background(Image(Format::rgba16f, s.settings.width, s.settings.height));
  s.has_background = false;
}

void ScreenDrops::render(Recorder* recorder) {
  const FloatingPointGuard guard;
  State& s = *state_;
  const pass::Moment now = s.moment(recorder);
  if (!std::exchange(s.has_background, true)) s.blur(s.background_is_recorded ? s.moment(nullptr) : now);
  s.background_is_recorded = true;
  if (s.corrected) s.fill_cells(now);
  const Rounding rounding = s.settings.rounding;
  const auto bound = [&](auto io) {
    io.background = s.background;
    io.scene.set(s.scene->texture->view(), s.scene->levels, s.wrap());
    io.water = s.water;
    io.colour = s.colour;
    return io;
  };
  const auto run = [&](auto drops) {
    pass::run_and_display(drops, s.display, s.settings.exposure, s.colour, s.picture, s.executor, tile_rows, now);
  };
  if (s.corrected) {
    auto io = bound(pass::HostIo<DropsPass>());
    io.cells = s.cells;
    io.height = s.height();
    const std::array<int, 2> flow_size = s.flow ? std::array{s.height().width(), s.height().height()} : std::array{0, 0};
    run(pass::Run<DropsPass>(drops_uniforms(s.settings, s.grids, flow_size), true, rounding, io));
  } else {
    const BufferView noise(s.noise->stored);
    auto io = bound(pass::HostIo<PublishedDropsPass>());
    io.noise = s.noise->texture.view();
    io.noise.recorded = &noise;
    run(pass::Run<PublishedDropsPass>(published_drops_uniforms(s.settings, s.shown()), false, rounding, io));
  }
}

void ScreenDrops::list_state(state::Items& items) {
  const FloatingPointGuard guard;
  State& s = *state_;
  items.number("frame", s.frame, state::frames);
  items.flag("background_is_recorded", s.background_is_recorded);
  if (s.flow) s.flow->list_state(items, s.frame);
  items.then([&s] { s.has_background = s.has_background && s.background_is_recorded; });
}

int ScreenDrops::frame() const { return state_->frame; }
const Image& ScreenDrops::background() const { return state_->background; }
const Image& ScreenDrops::cells() const { return state_->cells; }
const Image& ScreenDrops::height() const { return state_->height(); }
const Image& ScreenDrops::water() const { return state_->water; }
const Image& ScreenDrops::colour() const { return state_->colour; }
const Image& ScreenDrops::picture() const { return state_->picture; }

}  // namespace rainref::screen_drops
