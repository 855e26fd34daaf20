#include "edge_splash/info.h"

#include "edge_splash/splash.pass.h"
#include "pass/display.h"
#include "pass/info.h"
#include "scene/parameter.h"

namespace rainref::edge_splash {
namespace {

using namespace rainref::scene;
using namespace rainref::capture;

EffectInfo make() {
  EffectInfo info;
  info.name = "edge_splash";
  info.passes = {pass::info_of<PublishedSplashPass, SplashPass>(), pass::display_info("splash")};
  info.buffers = {
      {.name = "scene",
       .format = "rgba16f",
       .sentence = "Linear radiance and alpha of the picture that rain falls on.",
       .colour_space = "linear Rec. 709",
       .alpha = "straight"},
      {.name = "depth", .format = "r32f", .sentence = "Device depth; 0 outside the picture.", .variant = published},
      {.name = "depth",
       .format = "r32f",
       .sentence = "Device depth.",
       .encoding = "1 / z = depth_scale d + depth_bias",
       .variant = correct},
      {.name = "noise_map", .format = "r8", .sentence = "Noise, a tile; 0 outside it.", .variant = published},
      {.name = "noise_map", .format = "r32f", .sentence = "Noise at half its resolution, a tile.", .variant = correct},
      {.name = "layer", .format = "r8", .sentence = "1 where splashes may be.", .variant = correct},
  };
  pass::append(info.buffers, pass::buffers_of<PublishedSplashPass, SplashPass>());
  info.buffers.push_back(pass::display_buffer());
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
