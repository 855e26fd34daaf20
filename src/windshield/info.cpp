#include "windshield/info.h"

#include "blur_pyramid/blur_pyramid.h"
#include "drops/info.h"
#include "pass/display.h"
#include "pass/info.h"
#include "windshield/motion/windshield_frame.pass.h"
#include "windshield/motion/wipe_drops.pass.h"
#include "windshield/picture/falling_rain.pass.h"
#include "windshield/picture/interior.pass.h"
#include "windshield/picture/join_panes.pass.h"
#include "windshield/picture/mist.pass.h"
#include "windshield/picture/picture.h"
#include "windshield/picture/soften.pass.h"
#include "windshield/surface/condense.pass.h"
#include "windshield/surface/smear.pass.h"
#include "windshield/surface/surface.h"

namespace rainref::windshield {
namespace {

using namespace rainref::scene;
using namespace rainref::capture;

/// Inputs and outputs of the picture's passes.
std::vector<BufferInfo> picture_buffers() {
  std::vector<BufferInfo> all{{.name = "glints", .format = "records", .sentence = "Lights that drops mirror.", .record = "Glint"},
                              {.name = "streaks",
                               .format = "records",
                               .sentence = "Drops that fall behind the glass, far ones first.",
                               .range = {-1e6, 1e6},
                               .record = "Streak"},
                              {.name = "profile",
                               .format = "r16f",
                               .sentence = "Thickness of the film that a blade leaves, from its inner end to its outer one.",
                               .variant = "corrected"},
                              {.name = "deflections",
                               .format = "records",
                               .sentence = "Angles by which a blade's film turns light.",
                               .range = {-1, 1},
                               .record = "Deflection",
                               .variant = "corrected"},
                              {.name = "taps",
                               .format = "records",
                               .sentence = "Places that the picture behind the mist is the mean of.",
                               .record = "Tap",
                               .variant = "corrected"}};
  pass::append(all, pass::buffers_of<CompositePass>());
  pass::append(all, {{.name = "pane_colour",
                      .format = "rgba16f",
                      .sentence = "As colour, through a pane behind the first.",
                      .colour_space = "linear Rec. 709",
                      .alpha = "opaque"},
                     {.name = "interior",
                      .format = "rgba16f",
                      .sentence = "What of the car stands before the glass.",
                      .colour_space = "linear Rec. 709",
                      .alpha = "premultiplied",
                      .variant = "corrected"},
                     {.name = "picture",
                      .format = "rgba8",
                      .sentence = "Display code; alpha 1.",
                      .encoding = "sRGB",
                      .colour_space = "sRGB",
                      .alpha = "opaque"}});
  return all;
}

std::vector<UniformBlock> records() {
  return {
      record<Wiper>(
          {member<&Wiper::previous_inner>("1", "Inner end before the step, glass coordinates."),
           member<&Wiper::previous_outer>("1", "Outer end before the step."), member<&Wiper::inner>("1", "Inner end after it."),
           member<&Wiper::outer>("1", "Outer end after it."), member<&Wiper::pivot>("m", "Plane coordinates."),
           member<&Wiper::inner_radius>("m", "Of the inner end, from the pivot."), member<&Wiper::outer_radius>("m", "Of the outer end."),
           member<&Wiper::previous_axis>("1", "Cosine and sine of the blade's angle before the step."),
           member<&Wiper::axis>("1", "The same after it."), member<&Wiper::half_width>("m", "Half the width that the blade wipes."),
           member<&Wiper::rate>("rad/s", "Turned angle over the time that the record stands for."),
           member<&Wiper::direction>("1", "Sign of rate; 0 at rest.")}),
      record<Streak>({member<&Streak::opened>("texel", "Its middle when the shutter opens: column and row of the scene's picture."),
                      member<&Streak::closed>("texel", "The same when it closes."),
                      member<&Streak::radius>("texel", "Half its width, at least half a texel."),
                      member<&Streak::depth>("m", "Along the view axis."),
                      member<&Streak::opacity>("1", "Share of the exposure and of the width in which it covers a point of its way."),
                      member<&Streak::radiance>("1", "Linear RGB.")}),
      record<Tap>({member<&Tap::x>("1", "From the pixel's place, in texture coordinates of the scene."), member<&Tap::y>("1", "See x.")}),
      record<Deflection>({member<&Deflection::tangent>("1", "Of the angle, along the blade that left the film."),
                          member<&Deflection::weight>("1", "Share of the scattered light.")}),
      record<Glint>({member<&Glint::direction>("1", "Unit, toward the light, camera axes: right, up, forward."),
                     member<&Glint::radiance>("1", "Linear RGB.")})};
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
                 pass::info_of<FallingRainPass>(),
                 pass::info_of<CompositePass>(),
                 pass::info_of<SoftenPass>(),
                 pass::info_of<MistPass>(),
                 pass::info_of<JoinPanesPass>(),
                 pass::info_of<InteriorPass>(),
                 pass::display_info("composite")};
  const auto append = [&](const std::vector<BufferInfo>& more) { pass::append(info.buffers, more); };
  append(drops::buffers());
  info.buffers.push_back({.name = "wipers",
                          .format = "records",
                          .sentence = "A record for each blade; corrected: for each of its moves in one direction.",
                          .range = {-1, 1},
                          .record = "Wiper"});
  append(drops::splat_buffers());
  info.buffers.push_back({.name = "previous_height",
                          .format = "r16f",
                          .sentence = "Height of the frame before, wiped.",
                          .unit = "mm",
                          .range = {0, 8},
                          .variant = "as-published"});
  append(pass::buffers_of<WipeTexturePass>());
  append(pass::buffers_of<SmearPass>());
  append(pass::buffers_of<CondensePass>());
  append(pass::buffers_of<NormalsPass>());
  append(blur_pyramid::blur_buffers());
  append(picture_buffers());
  pass::append(info.records, drops::records());
  pass::append(info.records, records());
  return info;
}

}  // namespace

const EffectInfo& effect_info() {
  static const EffectInfo info = make_info();
  return info;
}

}  // namespace rainref::windshield
