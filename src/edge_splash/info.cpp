#include "edge_splash/info.h"

#include "edge_splash/splash.pass.h"
#include "pass/display.h"
#include "pass/info.h"
#include "scene/variant_names.h"

namespace rainref::edge_splash {
namespace {

using namespace rainref::scene;
using namespace rainref::capture;

EffectInfo make() {
  EffectInfo info;
  info.name = "edge_splash";
  info.passes = {pass::info_of<PublishedSplashPass, SplashPass>(), pass::display_info("splash")};
  const std::array<double, 2> one{0, 1};
  info.buffers = {
      {"scene", "rgba16f", "Linear radiance and alpha of the picture that rain falls on.", "1", one, "none", "linear Rec. 709", "straight"},
      {"depth", "r32f", "Device depth; 0 outside the picture.", "1", one, "none", "none", "none", "", "", published},
      {"depth", "r32f", "Device depth.", "1", one, "1 / z = depth_scale d + depth_bias", "none", "none", "", "", correct},
      {"noise_map", "r8", "Noise, a tile; 0 outside it.", "1", one, "none", "none", "none", "", "", published},
      {"noise_map", "r32f", "Noise at half its resolution, a tile.", "1", one, "none", "none", "none", "", "", correct},
      {"layer", "r8", "1 where splashes may be.", "1", one, "none", "none", "none", "", "", correct},
  };
  for (const BufferInfo& written : pass::buffers_of<PublishedSplashPass, SplashPass>()) info.buffers.push_back(written);
  info.buffers.push_back(
      {"picture", "rgba8", "Display code, alpha 1. Row 0 is the bottom of the picture.", "1", one, "sRGB (IEC 61966-2-1)", "sRGB", "1"});
  info.depth =
      "device depth of a perspective projection: uniforms depth_scale and depth_bias (corrected), scene keys scene.near, scene.far, "
      "scene.reversed_depth";
  return info;
}

}  // namespace

const capture::EffectInfo& effect_info() {
  static const capture::EffectInfo info = make();
  return info;
}

}  // namespace rainref::edge_splash
