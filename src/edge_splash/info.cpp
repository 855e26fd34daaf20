#include "edge_splash/info.h"

#include "capture/display.h"
#include "edge_splash/uniforms.h"

namespace rainref::edge_splash {
namespace {

using namespace rainref::scene;
using namespace rainref::capture;

constexpr const char *published = "as-published", *correct = "corrected";

EffectInfo make() {
  using P = PublishedSplashUniforms;
  using U = SplashUniforms;
  const UniformBlock printed = uniform_block<P>(
      "PublishedSplashUniforms", {member<&P::drop_color>("drop_color", "1", radiance, "Linear RGB and opacity of the drops."),
                                  member<&P::width>("width", "texel", {1, 65536}, "Columns of the picture."),
                                  member<&P::height>("height", "texel", {1, 65536}, "Rows of the picture."),
                                  member<&P::noise_width>("noise_width", "texel", {2, 65536}, "Columns of the noise map."),
                                  member<&P::noise_height>("noise_height", "texel", {2, 65536}, "Rows of the noise map."),
                                  member<&P::edge_threshold>("edge_threshold", "1", {0, 16}, "Sobel sum of device depths that counts as an edge."),
                                  member<&P::rain_drop_scale>("rain_drop_scale", "1", share, "Threshold of the noise."),
                                  member<&P::time>("time", "s", frame_time, "Frame number over frame rate, rounded once."),
                                  member<&P::drop_speed>("drop_speed", "texel/s", {-1e6, 1e6}, "Speed of the noise in x and in y."),
                                  member<&P::thickness>("thickness", "texel", {0, 20}, "Distance of the taps where the depth is 1.")});
  const UniformBlock splash = uniform_block<U>(
      "SplashUniforms", {member<&U::drop_color>("drop_color", "1", radiance, "Linear RGB and opacity of the drops."),
                         member<&U::up>("up", "1", component, "Unit vector that points up, camera axes: right, up, forward."),
                         member<&U::reach>("reach", "texel", {0, 1e9}, "Texels that the band covers at 1 m."),
                         member<&U::pixel>("pixel", "1", {0, 1e6}, "Extent of a pixel on the image plane at distance 1."),
                         member<&U::half_size>("half_size", "1", {0, 1e6}, "Half the extent of the image plane at distance 1."),
                         member<&U::depth_scale>("depth_scale", "1/m", {-1e4, 1e4}, "1 / z = depth_scale d + depth_bias."),
                         member<&U::depth_bias>("depth_bias", "1/m", {0, 1e4}, "See depth_scale."),
                         member<&U::reach_min>("reach_min", "texel", whole(1, 4096), "Smallest reach of the taps."),
                         member<&U::reach_max>("reach_max", "texel", whole(1, 4096), "Largest reach of the taps; whole."),
                         member<&U::step_low>("step_low", "m", {0, 1e5}, "Sobel sum of distances at which an edge begins."),
                         member<&U::step_high>("step_high", "m", {0, 1e5}, "Sobel sum from which it is whole."),
                         member<&U::bend_low>("bend_low", "1", {0, 11}, "Bend at which an edge begins."),
                         member<&U::bend_high>("bend_high", "1", {0, 11}, "Bend from which it is whole."),
                         member<&U::cosine_low>("cosine_low", "1", {0, 11}, "Cosine between an edge's normal and up at which the mask begins."),
                         member<&U::cosine_high>("cosine_high", "1", {0, 11}, "Cosine from which it is whole."),
                         member<&U::noise_low>("noise_low", "1", {0, 11}, "Noise at which a drop begins."),
                         member<&U::noise_high>("noise_high", "1", {0, 11}, "Noise from which it is whole."),
                         member<&U::noise_scale>("noise_scale", "1", {0, 1e7}, "Texture coordinates of the noise in a pixel."),
                         member<&U::noise_offset>("noise_offset", "1", share, "Texture coordinates that the noise has scrolled, in [0, 1).")});

  constexpr auto envelope = Judge::envelope;
  EffectInfo info;
  info.name = "edge_splash";
  info.passes = {
      {"splash", "Masks of edge, angle and noise, and the scene with drops blended over it.",
       {{published, 1, envelope, "PublishedSplashUniforms"}, {correct, 1, envelope, "SplashUniforms"}},
       {per_texel({"scene"}), per_texel({"depth"}), {"noise_map"}, per_texel({"layer", "", false, correct})}, {"edge", "angle", "noise", "colour"}, {printed, splash}, "gather", {"sobel", "length"}},
      display_info("splash"),
  };
  const std::array<double, 2> one{0, 1};
  info.buffers = {
      {"scene", "rgba16f", "Linear radiance and alpha of the picture that rain falls on.", "1", one, "none", "linear Rec. 709", "straight"},
      {"depth", "r32f", "Device depth; 0 outside the picture.", "1", one, "none", "none", "none", "", "", published},
      {"depth", "r32f", "Device depth.", "1", one, "1 / z = depth_scale d + depth_bias", "none", "none", "", "", correct},
      {"noise_map", "r8", "Noise, a tile; 0 outside it.", "1", one, "none", "none", "none", "", "", published},
      {"noise_map", "r32f", "Noise at half its resolution, a tile.", "1", one, "none", "none", "none", "", "", correct},
      {"layer", "r8", "1 where splashes may be.", "1", one, "none", "none", "none", "", "", correct},
      {"edge", "r8", "1 at an edge of the depth."},
      {"angle", "r8", "1 where the edge faces up."},
      {"noise", "r8", "1 where a drop is."},
      {"colour", "rgba16f", "Linear radiance with drops; the scene's alpha, as published blended like a colour.", "1", one, "none", "linear Rec. 709", "straight"},
      {"picture", "rgba8", "Display code, alpha 1. Row 0 is the bottom of the picture.", "1", one, "sRGB (IEC 61966-2-1)", "sRGB", "1"},
  };
  info.depth = "device depth of a perspective projection: uniforms depth_scale and depth_bias (corrected), scene keys scene.near, scene.far, scene.reversed_depth";
  return info;
}

}  // namespace

const capture::EffectInfo& effect_info() {
  static const capture::EffectInfo info = make();
  return info;
}

}  // namespace rainref::edge_splash
