#include "windshield/info.h"

#include "blur_pyramid/blur_pyramid.h"
#include "drops/info.h"
#include "pass/info.h"
#include "windshield/motion/info.h"
#include "windshield/motion/windshield_frame.pass.h"
#include "windshield/motion/wipe_drops.pass.h"
#include "windshield/picture/falling_rain.pass.h"
#include "windshield/picture/info.h"
#include "windshield/surface/condense.pass.h"
#include "windshield/surface/smear.pass.h"
#include "windshield/surface/surface.h"

namespace rainref::windshield {
namespace {

using namespace rainref::capture;

template <class T>
void append(std::vector<T>& all, std::vector<T> more) {
  for (T& one : more) all.push_back(std::move(one));
}

EffectInfo make_info() {
  EffectInfo info;
  info.name = "windshield";
  info.up_axis = "z";
  info.depth = "along the view axis [m], not reversed";
  info.passes = {pass::info_of<WindshieldFramePass>(),
                 drops::spawn_info({"wipe_drops", "merge"}),
                 drops::integrate_info("windshield_frame"),
                 pass::info_of<WipeDropsPass>(),
                 drops::necks_info("wipe_drops"),
                 drops::merge_info("wipe_drops", "wipe_drops"),
                 drops::splat_info({"wipe_drops", "merge"}),
                 pass::info_of<PersistPass>(),
                 pass::info_of<WipeTexturePass>(),
                 pass::info_of<SmearPass>(),
                 pass::info_of<CondensePass>(),
                 pass::info_of<NormalsPass>(),
                 blur_pyramid::blur_info("", ""),
                 pass::info_of<FallingRainPass>()};
  append(info.passes, picture_passes());
  append(info.buffers, drops::buffers());
  append(info.buffers, wiper_buffers());
  append(info.buffers, drops::splat_buffers());
  info.buffers.push_back({.name = "previous_height",
                          .format = "r16f",
                          .sentence = "Height of the frame before, wiped.",
                          .unit = "mm",
                          .range = {0, 8},
                          .variant = "as-published"});
  append(info.buffers, pass::buffers_of<WipeTexturePass>());
  append(info.buffers, pass::buffers_of<SmearPass>());
  append(info.buffers, pass::buffers_of<CondensePass>());
  append(info.buffers, pass::buffers_of<NormalsPass>());
  append(info.buffers, blur_pyramid::blur_buffers());
  append(info.buffers, picture_buffers());
  append(info.records, drops::records());
  append(info.records, wiper_records());
  append(info.records, picture_records());
  return info;
}

}  // namespace

const EffectInfo& effect_info() {
  static const EffectInfo info = make_info();
  return info;
}

}  // namespace rainref::windshield
