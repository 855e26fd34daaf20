// The order of the passes. No arithmetic.
#include "rainref/rainy_glass.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "base/floating_point.h"
#include "image/flipped.h"
#include "parallel/rows.h"
#include "pass/display.h"
#include "rainref/error.h"
#include "rainy_glass/bake.pass.h"
#include "rainy_glass/host.h"
#include "rainy_glass/rain_on_glass.pass.h"
#include "state/items.h"

namespace rainref::rainy_glass {
namespace {

constexpr int bake_tile = 64, bake_rows = 16, picture_tile_rows = 4;

}  // namespace

struct RainyGlass::State {
  Settings settings;
  const parallel::Executor& executor;
  bool corrected, bakes_raindrops, bakes_rivulets;
  int frame = 0;
  bool is_baked = false;
  bool bakes_are_recorded = false;  ///< in a run that was saved, they are not recorded once more
  Code drop_code, rivulet_code;
  std::vector<Droplet> droplets;
  std::vector<Trail> trails;
  TextureData lattice, raindrop_texture, rivulet_texture, probe;
  Image raindrops, rivulets, scene, depth, least_depth, surface, orientation, colour, picture;
  CodeTable display;

  State(const Settings& s, const Surroundings& around, const parallel::Executor& e)
      : settings(s),
        executor(e),
        corrected(s.variant == Variant::corrected),
        bakes_raindrops(around.raindrops.empty()),
        bakes_rivulets(around.rivulets.empty()) {
    const auto code = [&](const Image& map) { return code_of(s, map.empty() ? s.map_storage : map.format()); };
    drop_code = code(around.raindrops);
    rivulet_code = code(around.rivulets);
    if (bakes_raindrops) {
      droplets = make_droplets(s);
      raindrops = Image(s.map_storage, s.map_size, s.map_size);
    } else {
      raindrops = stored_map(around.raindrops, s.map_storage);
    }
    if (bakes_rivulets) {
      trails = make_trails(s);
      lattice = TextureData(make_lattice(s), Address::repeat, Address::repeat);
      rivulets = Image(s.map_storage, s.map_size, s.map_size);
    } else {
      rivulets = stored_map(around.rivulets, s.map_storage);
    }
    take(around.colour, around.depth);
    if (s.use_probe) {
      probe = TextureData(around.probe, Address::repeat, Address::clamp, parallel::rows_of(e));
      probe.build_mips(Texture::max_levels, parallel::rows_of(e));
    }
    make_surface(s, around.normals, surface, orientation, parallel::rows_of(e));
    colour = Image(Format::rgba16f, s.width, s.height);
    picture = Image(Format::rgba8, s.width, s.height);
    display = pass::display_table(s.width, s.height, s.exposure, s.rounding);
  }

  void take(const Image& seen, const Image& seen_depth) {
    const Rows rows = parallel::rows_of(executor);
    scene = colour_as_half(seen, rows);
    if (!corrected) return;
    depth = copy_of(seen_depth);
    least_depth = near_depth(depth, rows);
  }

  int shown() const { return std::max(0, frame - 1); }
  pass::Moment moment(Recorder* recorder) const {
    return {recorder, shown(), 0, shown() / settings.fps, 1 / settings.fps, settings.rounding};
  }

  void bake(const pass::Moment& now) {
    const auto run = [&](auto bake) {
      bake.start(now);
      bake.tiles(executor, bake_rows, bake_tile);
      bake.finish(now);
    };
    if (bakes_raindrops) {
      pass::HostIo<BakeRaindropsPass> io;
      io.droplets = droplets;
      io.map = raindrops;
      const BakeRaindropsUniforms u = bake_raindrops_uniforms(settings, static_cast<int>(droplets.size()));
      run(pass::Run<BakeRaindropsPass>(u, corrected, settings.rounding, io));
    }
    if (bakes_rivulets) {
      pass::HostIo<BakeRivuletsPass> io;
      io.trails = trails;
      io.lattice = lattice.view();
      io.map = rivulets;
      const BakeRivuletsUniforms u = bake_rivulets_uniforms(settings, static_cast<int>(trails.size()));
      run(pass::Run<BakeRivuletsPass>(u, corrected, settings.rounding, io));
    }
    if (raindrops.format() == Format::rgba16f && rivulets.format() == Format::rgba16f) return;
    raindrop_texture = TextureData(raindrops, Address::repeat, Address::repeat);
    rivulet_texture = TextureData(rivulets, Address::repeat, Address::repeat);
  }
};

RainyGlass::RainyGlass(const Settings& settings, const Surroundings& surroundings, const parallel::Executor& executor) {
  const FloatingPointGuard guard;
  check(settings);
  check(settings, surroundings);
  check_memory(settings, sizes_of(surroundings));
  state_ = std::make_unique<State>(settings, surroundings, executor);
}
RainyGlass::~RainyGlass() = default;
RainyGlass::RainyGlass(RainyGlass&&) noexcept = default;

void RainyGlass::simulate(Recorder*) {
  const FloatingPointGuard guard;
  ++state_->frame;
}

void RainyGlass::show(const Image& colour, const Image& depth) {
  const FloatingPointGuard guard;
  State& s = *state_;
  check_scene(s.settings, colour, depth);
  s.take(colour, depth);
}

void RainyGlass::render(Recorder* recorder) {
  const FloatingPointGuard guard;
  State& s = *state_;
  const pass::Moment now = s.moment(recorder);
  if (!std::exchange(s.is_baked, true)) s.bake(s.bakes_are_recorded ? s.moment(nullptr) : now);
  s.bakes_are_recorded = true;
  const Rounding rounding = s.settings.rounding;
  const BufferView raindrops(s.raindrops), rivulets(s.rivulets);
  pass::HostIo<RainOnGlassPass> io;
  io.surface = s.surface;
  io.orientation = s.orientation;
  const auto set_map = [](auto& member, const BufferView& map, const TextureData& decoded) {
    member.recorded = &map;
    member.address = Address::repeat;
    if (!decoded.empty()) member = decoded.view();
  };
  set_map(io.raindrops, raindrops, s.raindrop_texture);
  set_map(io.rivulets, rivulets, s.rivulet_texture);
  io.scene = s.scene;
  if (s.corrected) {
    io.scene_depth = s.depth;
    io.near_depth = s.least_depth;
  }
  if (s.settings.use_probe) io.probe = s.probe.view();
  io.colour = s.colour;
  pass::Run<RainOnGlassPass> rain(rain_on_glass_uniforms(s.settings, s.shown(), s.drop_code, s.rivulet_code), s.corrected, rounding, io);
  pass::run_and_display(rain, s.display, s.settings.exposure, s.colour, s.picture, s.executor, picture_tile_rows, now);
}

void RainyGlass::list_state(state::Items& items) {
  const FloatingPointGuard guard;
  items.number("frame", state_->frame, state::frames);
  items.flag("bakes_are_recorded", state_->bakes_are_recorded);
  // Maps that were baked here and told nobody of would be told of now.
  items.then([s = state_.get()] { s->is_baked = s->is_baked && s->bakes_are_recorded; });
}

int RainyGlass::frame() const { return state_->frame; }
const Image& RainyGlass::raindrops() const { return state_->raindrops; }
const Image& RainyGlass::rivulets() const { return state_->rivulets; }
const Image& RainyGlass::surface() const { return state_->surface; }
const Image& RainyGlass::orientation() const { return state_->orientation; }
const Image& RainyGlass::colour() const { return state_->colour; }
const Image& RainyGlass::picture() const { return state_->picture; }

}  // namespace rainref::rainy_glass
