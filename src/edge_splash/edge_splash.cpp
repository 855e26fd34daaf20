// The order of the passes. No arithmetic.
#include "rainref/edge_splash.h"

#include <algorithm>
#include <memory>
#include <utility>

#include <fmt/format.h>

#include "base/floating_point.h"
#include "cache/prepared.h"
#include "capture/pass_clock.h"
#include "edge_splash/host.h"
#include "edge_splash/splash.pass.h"
#include "parallel/rows.h"
#include "pass/display.h"
#include "rainref/error.h"
#include "state/items.h"

namespace rainref::edge_splash {
namespace {

constexpr int tile_rows = 4;

struct Depth {
  Image image;
  TextureData texture;
  std::size_t bytes() const { return cache::bytes_of(image) + texture.bytes(); }
};
Depth make_depth(const Rows& rows, const Image& depth, const bool& is_distance, const Image& colour, const DepthRange& range,
                 const Address& edges) {
  Depth made{prepare_depth(depth, is_distance, colour, range, rows), {}};
  made.texture = TextureData(made.image, edges, edges);
  return made;
}

/// A map of splashes: the tile, and its decoded form for sampling.
struct NoiseMap {
  Image image;
  TextureData texture;
  std::size_t bytes() const { return cache::bytes_of(image) + texture.bytes(); }
};
NoiseMap decoded(Image image, Address tile) {
  TextureData texture(image, tile, tile);
  return {std::move(image), std::move(texture)};
}
NoiseMap make_noise_map(const int&, const Image& own, const cache::Only<&Settings::variant, &Settings::seed>& reads) {
  return decoded(prepare_noise(own, reads.of), reads.of.variant == Variant::corrected ? Address::repeat : Address::border);
}
Image make_scene(const Rows& rows, const Image& colour, const bool& is_encoded) { return prepare_scene(colour, is_encoded, rows); }
Image make_layer(const int&, const Image& layer, const Image& colour) { return prepare_layer(layer, colour); }

Settings with_size(Settings s, const Image& colour) {
  s.width = colour.width();
  s.height = colour.height();
  check(s);
  return s;
}

}  // namespace

struct EdgeSplash::State {
  Settings settings;
  const parallel::Executor& executor;
  bool corrected;
  bool makes_crowns;  // makes them again for each frame
  int frame = 0;
  Image scene, layer;
  std::shared_ptr<const Depth> depth;
  std::shared_ptr<const NoiseMap> noise_map;
  Image edge, angle, noise, colour, picture;
  CodeTable display;
  std::vector<std::string> warnings;

  State(const Settings& s, const Inputs& in, const parallel::Executor& e)
      : settings(with_size(s, in.colour)),
        executor(e),
        corrected(s.variant == Variant::corrected),
        makes_crowns(corrected && s.has_crowns && in.noise.empty()) {
    settings.has_crowns = makes_crowns;
    const Rows rows = parallel::rows_of(e);
    scene = cache::prepared("edge_splash scene", rows, make_scene, in.colour, in.colour_is_encoded)->shared();
    depth = cache::prepared("edge_splash depth", rows, make_depth, in.depth, in.depth_is_distance, in.colour, s.depth, edges());
    layer = cache::prepared("edge_splash layer", 0, make_layer, in.layer, in.colour)->shared();
    if (makes_crowns)
      show_crowns(0);
    else
      noise_map = cache::prepared("edge_splash noise", 0, make_noise_map, in.noise, s);
    for (Image* mask : {&edge, &angle, &noise}) *mask = Image(Format::r8, settings.width, settings.height);
    colour = Image(colour_format(s), settings.width, settings.height);
    picture = Image(Format::rgba8, settings.width, settings.height);
    display = pass::display_table(settings.width, settings.height, settings.exposure, settings.rounding);
    const std::string seam = in.noise.empty() ? "" : seam_warning(in.noise);
    if (!seam.empty()) warnings.push_back(seam);
  }
  Address edges() const { return corrected ? Address::clamp : Address::border; }
  void show_crowns(double time) {
    noise_map = std::make_shared<const NoiseMap>(decoded(make_crowns(settings.seed, time), Address::repeat));
  }
};

EdgeSplash::EdgeSplash(const Settings& settings, const Inputs& inputs, const parallel::Executor& executor) {
  const FloatingPointGuard guard;
  if (inputs.colour.empty()) throw Error(ExitCode::usage, "scene.image: expected an image of four channels");
  state_ = std::make_unique<State>(settings, inputs, executor);
}
EdgeSplash::~EdgeSplash() = default;
EdgeSplash::EdgeSplash(EdgeSplash&&) noexcept = default;

void EdgeSplash::simulate(Recorder*) {
  const FloatingPointGuard guard;
  ++state_->frame;
}

void EdgeSplash::render(Recorder* recorder) {
  const FloatingPointGuard guard;
  State& s = *state_;
  const Rounding rounding = s.settings.rounding;
  const int frame = std::max(0, s.frame - 1);
  const pass::Moment now{recorder, frame, 0, frame / s.settings.fps, 1 / s.settings.fps, rounding};
  if (s.makes_crowns) s.show_crowns(frame / s.settings.fps);
  const auto bound = [&](auto io) {
    io.scene = s.scene;
    io.depth = s.depth->texture.view();
    io.noise_map = s.noise_map->texture.view();
    io.edge = s.edge;
    io.angle = s.angle;
    io.noise = s.noise;
    io.colour = s.colour;
    return io;
  };
  const auto run = [&](auto splash) {
    pass::run_and_display(splash, s.display, s.settings.exposure, s.colour, s.picture, s.executor, tile_rows, now);
  };
  const int noise_columns = s.noise_map->image.width(), noise_rows = s.noise_map->image.height();
  if (s.corrected) {
    auto io = bound(pass::HostIo<SplashPass>());
    io.layer = s.layer;
    run(pass::Run<SplashPass>(splash_uniforms(s.settings, frame, noise_columns, noise_rows), true, rounding, io));
  } else {
    run(pass::Run<PublishedSplashPass>(published_splash_uniforms(s.settings, frame, noise_columns, noise_rows), false, rounding,
                                       bound(pass::HostIo<PublishedSplashPass>())));
  }
}

void EdgeSplash::show(const Inputs& inputs) {
  const FloatingPointGuard guard;
  State& s = *state_;
  if (inputs.colour.width() != s.settings.width || inputs.colour.height() != s.settings.height) {
    throw Error(ExitCode::usage, fmt::format("scene.image: expected {}x{} as before, found {}x{}", s.settings.width, s.settings.height,
                                             inputs.colour.width(), inputs.colour.height()));
  }
  const Rows rows = parallel::rows_of(s.executor);
  // Frames of a film are not cached, because their pictures are transient.
  Image scene = make_scene(rows, inputs.colour, inputs.colour_is_encoded), layer = prepare_layer(inputs.layer, inputs.colour);
  auto depth =
      std::make_shared<const Depth>(make_depth(rows, inputs.depth, inputs.depth_is_distance, inputs.colour, s.settings.depth, s.edges()));
  s.scene = std::move(scene);
  s.layer = std::move(layer);
  s.depth = std::move(depth);
}

void EdgeSplash::list_state(state::Items& items) {
  const FloatingPointGuard guard;
  items.number("frame", state_->frame, state::frames);
}

int EdgeSplash::frame() const { return state_->frame; }
const Image& EdgeSplash::edge() const { return state_->edge; }
const Image& EdgeSplash::angle() const { return state_->angle; }
const Image& EdgeSplash::noise() const { return state_->noise; }
const Image& EdgeSplash::colour() const { return state_->colour; }
const Image& EdgeSplash::picture() const { return state_->picture; }
const Image& EdgeSplash::depth() const { return state_->depth->image; }
const std::vector<std::string>& EdgeSplash::warnings() const { return state_->warnings; }

}  // namespace rainref::edge_splash
