// The order of the passes. No arithmetic.
#include "rainref/rainy_glass.h"

#include <algorithm>
#include <memory>
#include <utility>
#include <vector>

#include "base/floating_point.h"
#include "cache/prepared.h"
#include "capture/pass_clock.h"
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

struct Glass {
  Image surface, orientation;
  std::size_t bytes() const { return cache::bytes_of(surface) + cache::bytes_of(orientation); }
};
Glass make_glass(const Rows& rows, const GlassReads& reads, const Image& normals) {
  Glass glass;
  make_surface(reads.of, normals, glass.surface, glass.orientation, rows);
  for (Image* image : {&glass.surface, &glass.orientation}) image->share();
  return glass;
}

using DropletReads =
    cache::Only<&Settings::seed, &Settings::droplet_count, &Settings::smallest_droplet, &Settings::largest_droplet, &Settings::map_size>;
std::vector<Droplet> droplets_of(const int&, const DropletReads& reads) { return make_droplets(reads.of); }
using TrailReads = cache::Only<&Settings::seed, &Settings::trail_count, &Settings::trail_half_width>;
std::vector<Trail> trails_of(const int&, const TrailReads& reads) { return make_trails(reads.of); }
using LatticeReads = cache::Only<&Settings::seed, &Settings::flow_cells>;
TextureData lattice_of(const int&, const LatticeReads& reads) {
  return TextureData(make_lattice(reads.of), Address::repeat, Address::repeat);
}

/// How a map is stored.
using MapReads = cache::Only<&Settings::variant, &Settings::map_storage, &Settings::map_size, &Settings::rounding>;
template <class P>
pass::Run<P> bake_run(const typename P::Uniforms& uniforms, const MapReads& map, const pass::HostIo<P>& io) {
  return {uniforms, map.of.variant == Variant::corrected, map.of.rounding, io};
}
Image bake_raindrops(const parallel::Executor& executor, const std::vector<Droplet>& droplets, const BakeRaindropsUniforms& u,
                     const MapReads& reads) {
  Image map(reads.of.map_storage, reads.of.map_size, reads.of.map_size);
  pass::HostIo<BakeRaindropsPass> io;
  io.droplets = droplets;
  io.map = map;
  bake_run<BakeRaindropsPass>(u, reads, io).tiles(executor, bake_rows, bake_tile);
  return map;
}
Image bake_rivulets(const parallel::Executor& executor, const std::vector<Trail>& trails, const LatticeReads& of_lattice,
                    const BakeRivuletsUniforms& u, const MapReads& reads) {
  Image map(reads.of.map_storage, reads.of.map_size, reads.of.map_size);
  const TextureData lattice = lattice_of(0, of_lattice);
  pass::HostIo<BakeRivuletsPass> io;
  io.trails = trails;
  io.lattice = lattice.view();
  io.map = map;
  bake_run<BakeRivuletsPass>(u, reads, io).tiles(executor, bake_rows, bake_tile);
  return map;
}
Image half_of(const Rows& rows, const Image& colour) { return colour_as_half(colour, rows); }
Image near_depth_of(const Rows& rows, const Image& depth) { return near_depth(depth, rows); }
TextureData tile_of(const int&, const Image& map) { return TextureData(map, Address::repeat, Address::repeat); }
TextureData probe_of(const Rows& rows, const Image& panorama) {
  TextureData probe(panorama, Address::repeat, Address::clamp, rows);
  probe.build_mips(Texture::max_levels, rows);
  return probe;
}

}  // namespace

struct RainyGlass::State {
  Settings settings;
  const parallel::Executor& executor;
  bool corrected, bakes_raindrops, bakes_rivulets;
  int frame = 0;
  bool is_baked = false;
  bool bakes_are_recorded = false;  ///< in the saved run; then they are not recorded again
  Code drop_code, rivulet_code;
  std::shared_ptr<const std::vector<Droplet>> droplets;
  std::shared_ptr<const std::vector<Trail>> trails;
  std::shared_ptr<const TextureData> lattice, raindrop_texture, rivulet_texture, probe;  // textures of maps, if they are decoded
  std::shared_ptr<const Glass> glass;
  Image raindrops, rivulets, scene, depth, least_depth, colour, picture;
  std::vector<Image> earlier_maps;  ///< kept because Python arrays may view their memory
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
      droplets = cache::prepared("rainy_glass droplets", 0, droplets_of, s);
      raindrops = Image(s.map_storage, s.map_size, s.map_size);
    } else {
      raindrops = stored_map(around.raindrops, s.map_storage);
    }
    if (bakes_rivulets) {
      trails = cache::prepared("rainy_glass trails", 0, trails_of, s);
      lattice = cache::prepared("rainy_glass lattice", 0, lattice_of, s);
      rivulets = Image(s.map_storage, s.map_size, s.map_size);
    } else {
      rivulets = stored_map(around.rivulets, s.map_storage);
    }
    const Rows rows = parallel::rows_of(e);
    scene = cache::prepared("rainy_glass scene", rows, half_of, around.colour)->shared();
    if (corrected) {
      depth = around.depth.shared();
      least_depth = cache::prepared("rainy_glass near depth", rows, near_depth_of, depth)->shared();
    }
    if (s.use_probe) probe = cache::prepared("rainy_glass probe", rows, probe_of, around.probe);
    glass = cache::prepared("rainy_glass surface", rows, make_glass, s, around.normals);
    colour = Image(Format::rgba16f, s.width, s.height);
    picture = Image(Format::rgba8, s.width, s.height);
    display = pass::display_table(s.width, s.height, s.exposure, s.rounding);
  }

  /// Frames of a film are not cached, because their pictures are transient.
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
    const auto run = [&](auto bake, Image& map, const auto& make) {
      bake.start(now);
      const capture::Stopwatch watch;
      earlier_maps.push_back(std::exchange(map, make()->shared()));
      bake.finish(now, 1, watch.seconds());
    };
    if (bakes_raindrops) {
      pass::HostIo<BakeRaindropsPass> io;
      io.droplets = *droplets;
      io.map = raindrops;
      const BakeRaindropsUniforms u = bake_raindrops_uniforms(settings, static_cast<int>(droplets->size()));
      run(bake_run<BakeRaindropsPass>(u, settings, io), raindrops,
          [&] { return cache::prepared("rainy_glass raindrops", executor, bake_raindrops, *droplets, u, settings); });
    }
    if (bakes_rivulets) {
      pass::HostIo<BakeRivuletsPass> io;
      io.trails = *trails;
      io.lattice = lattice->view();
      io.map = rivulets;
      const BakeRivuletsUniforms u = bake_rivulets_uniforms(settings, static_cast<int>(trails->size()));
      run(bake_run<BakeRivuletsPass>(u, settings, io), rivulets,
          [&] { return cache::prepared("rainy_glass rivulets", executor, bake_rivulets, *trails, settings, u, settings); });
    }
    if (raindrops.format() == Format::rgba16f && rivulets.format() == Format::rgba16f) return;
    raindrop_texture = cache::prepared("rainy_glass raindrops decoded", 0, tile_of, raindrops);
    rivulet_texture = cache::prepared("rainy_glass rivulets decoded", 0, tile_of, rivulets);
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
  io.surface = s.glass->surface;
  io.orientation = s.glass->orientation;
  const auto set_map = [](auto& member, const BufferView& map, const std::shared_ptr<const TextureData>& decoded) {
    member.recorded = &map;
    member.address = Address::repeat;
    if (decoded) member = decoded->view();
  };
  set_map(io.raindrops, raindrops, s.raindrop_texture);
  set_map(io.rivulets, rivulets, s.rivulet_texture);
  io.scene = s.scene;
  if (s.corrected) {
    io.scene_depth = s.depth;
    io.near_depth = s.least_depth;
  }
  if (s.settings.use_probe) io.probe = s.probe->view();
  io.colour = s.colour;
  pass::Run<RainOnGlassPass> rain(rain_on_glass_uniforms(s.settings, s.shown(), s.drop_code, s.rivulet_code), s.corrected, rounding, io);
  pass::run_and_display(rain, s.display, s.settings.exposure, s.colour, s.picture, s.executor, picture_tile_rows, now);
}

void RainyGlass::list_state(state::Items& items) {
  const FloatingPointGuard guard;
  items.number("frame", state_->frame, state::frames);
  items.flag("bakes_are_recorded", state_->bakes_are_recorded);
  // Maps that were baked here without being recorded are recorded after loading.
  items.then([s = state_.get()] { s->is_baked = s->is_baked && s->bakes_are_recorded; });
}

int RainyGlass::frame() const { return state_->frame; }
const Image& RainyGlass::raindrops() const { return state_->raindrops; }
const Image& RainyGlass::rivulets() const { return state_->rivulets; }
const Image& RainyGlass::surface() const { return state_->glass->surface; }
const Image& RainyGlass::orientation() const { return state_->glass->orientation; }
const Image& RainyGlass::colour() const { return state_->colour; }
const Image& RainyGlass::picture() const { return state_->picture; }

}  // namespace rainref::rainy_glass
