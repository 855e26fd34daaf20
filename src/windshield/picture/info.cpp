#include "windshield/picture/info.h"

#include "pass/display.h"
#include "pass/info.h"
#include "windshield/picture/interior.pass.h"
#include "windshield/picture/join_panes.pass.h"
#include "windshield/picture/mist.pass.h"
#include "windshield/picture/soften.pass.h"

namespace rainref::windshield {
using namespace rainref::scene;
using namespace rainref::capture;

std::vector<PassInfo> picture_passes() {
  return {pass::info_of<CompositePass>(), pass::info_of<SoftenPass>(),   pass::info_of<MistPass>(),
          pass::info_of<JoinPanesPass>(), pass::info_of<InteriorPass>(), pass::display_info("composite")};
}

std::vector<BufferInfo> picture_buffers() {
  std::vector<BufferInfo> all{{.name = "glints", .format = "records", .sentence = "Lights that drops mirror.", .record = "Glint"}};
  all.push_back({.name = "streaks",
                 .format = "records",
                 .sentence = "Drops that fall behind the glass, far ones first.",
                 .range = {-1e6, 1e6},
                 .record = "Streak"});
  all.push_back({.name = "profile",
                 .format = "r16f",
                 .sentence = "Thickness of the film that a blade leaves, from its inner end to its outer one.",
                 .variant = "corrected"});
  all.push_back({.name = "deflections",
                 .format = "records",
                 .sentence = "Angles by which a blade's film turns light.",
                 .range = {-1, 1},
                 .record = "Deflection",
                 .variant = "corrected"});
  all.push_back({.name = "taps",
                 .format = "records",
                 .sentence = "Places that the picture behind the mist is the mean of.",
                 .record = "Tap",
                 .variant = "corrected"});
  const std::vector<BufferInfo> colour = pass::buffers_of<CompositePass>();
  all.insert(all.end(), colour.begin(), colour.end());
  all.push_back({.name = "pane_colour",
                 .format = "rgba16f",
                 .sentence = "As colour, through a pane behind the first.",
                 .colour_space = "linear Rec. 709",
                 .alpha = "opaque"});
  all.push_back({.name = "interior",
                 .format = "rgba16f",
                 .sentence = "What of the car stands before the glass.",
                 .colour_space = "linear Rec. 709",
                 .alpha = "premultiplied",
                 .variant = "corrected"});
  all.push_back({.name = "picture",
                 .format = "rgba8",
                 .sentence = "Display code; alpha 1.",
                 .encoding = "sRGB",
                 .colour_space = "sRGB",
                 .alpha = "opaque"});
  return all;
}

std::vector<UniformBlock> picture_records() {
  return {record<Streak>("Streak",
                         {member<&Streak::opened>("texel", "Its middle when the shutter opens: column and row of the scene's picture."),
                          member<&Streak::closed>("texel", "The same when it closes."),
                          member<&Streak::radius>("texel", "Half its width, at least half a texel."),
                          member<&Streak::depth>("m", "Along the view axis."),
                          member<&Streak::opacity>("1", "Share of the exposure and of the width in which it covers a point of its way."),
                          member<&Streak::radiance>("1", "Linear RGB.")}),
          record<Tap>("Tap", {member<&Tap::x>("1", "From the pixel's place, in texture coordinates of the scene."),
                              member<&Tap::y>("1", "See x.")}),
          record<Deflection>("Deflection", {member<&Deflection::tangent>("1", "Of the angle, along the blade that left the film."),
                                            member<&Deflection::weight>("1", "Share of the scattered light.")}),
          record<Glint>("Glint", {member<&Glint::direction>("1", "Unit, toward the light, camera axes: right, up, forward."),
                                  member<&Glint::radiance>("1", "Linear RGB.")})};
}

const std::vector<MemberParameter<PictureSettings>>& picture_parameters() {
  using P = PictureSettings;
  static const std::vector<MemberParameter<P>> table{
      real<&P::camera_position>("camera.position", "m", -100, 100, "Eye, in the car's axes: x forward, y left, z up."),
      real<&P::camera_target>("camera.target", "m", -1000, 1000, "Point that the eye looks at."),
      real<&P::vertical_fov_deg>("camera.vertical_fov_deg", "deg", 1, 120, "Vertical field of view."),
      real<&P::blur_lod>("composite.blur_lod", "1", 0, 12, "Mip level of the picture behind the wet film.").published(3.0),
      real<&P::wetness>("composite.wetness", "1", 0, 1, "Weight of the blurred picture where the glass was not wiped.").published(0.6),
      real<&P::visible_from>("composite.visible_from", "mm", 0, 10, "Height at which water begins to show as a drop."),
      real<&P::visible_to>("composite.visible_to", "mm", 1e-3, 10, "Height from which it shows fully."),
      real<&P::refraction>("composite.refraction", "1", -1, 1, "Offset of the sharp picture, in pictures per unit of the normal's x and y.")
          .only(published),
      real<&P::water_ior>("composite.water_ior", "1", 1, 2, "Refractive index of water.").only(correct),
      real<&P::inner>("composite.inner", "1", 0, 1, "Share of the blurred scene that the water's surface mirrors.").only(correct),
      real<&P::shininess>("composite.shininess", "1", 1, 4096, "Power of the highlights."),
      real<&P::glint_strength>("composite.glint_strength", "1", 0, 10, "Weight of the highlights."),
      {real3("composite.light_direction", "1", -1, 1, {}, "Toward the light that the water mirrors, in the car's axes."),
       [](P& s, const Value& v) { s.lights.front().direction = std::get<Real3>(v); },
       [](const P& s) { return Value(s.lights.front().direction); }},
      {real3("composite.light_radiance", "1", 0, 1000, {}, "Its radiance, linear RGB."),
       [](P& s, const Value& v) { s.lights.front().radiance = std::get<Real3>(v); },
       [](const P& s) { return Value(s.lights.front().radiance); }},
      real<&P::cabin>("composite.cabin", "1", 0, 100, "Radiance beside the glass, linear RGB."),
      real<&P::exposure>("display.exposure", "EV", -20, 20, "Exposure of the picture."),
  };
  return table;
}

}  // namespace rainref::windshield
