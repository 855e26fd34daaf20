#include "windshield/picture_info.h"

#include "capture/display.h"

namespace rainref::windshield {
namespace {

using namespace rainref::scene;
using namespace rainref::capture;

constexpr const char *published = "as-published", *correct = "corrected";

}  // namespace

std::vector<PassInfo> picture_passes() {
  using U = CompositeUniforms;
  const UniformBlock composite = uniform_block<U>(
      "CompositeUniforms",
      {member<&U::u_row>("u_row", "1", {-1e9, 1e9}, "u = u_row . (x, y, 1) / w_row . (x, y, 1) at pixel centre (x, y)."),
       member<&U::glass_distance>("glass_distance", "m", {-1e9, 1e9}, "The glass lies glass_distance / w_row . (x, y, 1) along the view axis."),
       member<&U::v_row>("v_row", "1", {-1e9, 1e9}, "v likewise."),
       member<&U::blur_lod>("blur_lod", "1", mip_level, "Mip level of the picture behind the film."),
       member<&U::w_row>("w_row", "1", {-1e9, 1e9}, "See u_row; positive where the glass lies before the eye."),
       member<&U::wetness>("wetness", "1", share, "Weight of the blurred picture where the glass was not wiped."),
       member<&U::plane_x>("plane_x", "1", component, "First axis of the glass's plane, camera axes: right, up, forward."),
       member<&U::visible_from>("visible_from", "mm", {0, 10}, "Height at which water begins to show as a drop."),
       member<&U::plane_y>("plane_y", "1", component, "Second axis."),
       member<&U::visible_to>("visible_to", "mm", {0, 10}, "Height from which it shows fully."),
       member<&U::outward>("outward", "1", component, "Normal of the glass, away from the car."),
       member<&U::refraction>("refraction", "1", component, "as-published: offset in pictures per unit of n.xy."),
       member<&U::pixel>("pixel", "1", {0, 1e6}, "Extent of a pixel on the image plane at distance 1."),
       member<&U::half_size>("half_size", "1", {0, 1e6}, "Half the extent of the image plane at distance 1."),
       member<&U::scene_scale>("scene_scale", "1", {0, 1e6}, "Texture coordinates of the scene per unit of the image plane."),
       member<&U::shininess>("shininess", "1", {1, 4096}, "Power of a highlight."),
       member<&U::glint_strength>("glint_strength", "1", {0, 10}, "Weight of the highlights."),
       member<&U::cabin>("cabin", "1", radiance, "Radiance beside the glass."),
       member<&U::glint_count>("glint_count", "1", {0, 65536}, "Lights in the list."),
       member<&U::water_ior>("water_ior", "1", {0, 2}, "corrected: refractive index of the water."),
       member<&U::inner>("inner", "1", share, "corrected: share of the blurred scene that the water's surface mirrors.")});
  const std::vector<std::string> lengths{"dot", "length", "normalize"};
  constexpr auto envelope = Judge::envelope;
  return {
      {"composite", "The scene through film and drops, with glints: linear radiance.", {{published, 1, envelope, "CompositeUniforms"}, {correct, 1, envelope, "CompositeUniforms"}},
       {{"blurred", "blur_pyramid"}, {"scene_depth", "", false, correct}, {"height", "wipe_texture"}, {"normal", "normals"}, {"mask", "wipe_texture"}, {"glints"}}, {"colour"}, {composite}, "gather", lengths},
      display_info("composite"),
  };
}

std::vector<BufferInfo> picture_buffers() {
  const std::array<double, 2> one{0, 1};
  return {
      {"glints", "records", "Lights that drops mirror.", "1", one, "none", "none", "none", "", "Glint"},
      {"colour", "rgba16f", "Linear radiance; alpha 1.", "1", one, "none", "linear Rec. 709", "opaque"},
      {"picture", "rgba8", "Display code; alpha 1.", "1", one, "sRGB", "sRGB", "opaque"},
  };
}

std::vector<UniformBlock> picture_records() {
  return {record<Glint>("Glint", {member<&Glint::direction>("direction", "1", "Unit, toward the light, camera axes: right, up, forward."),
                                  member<&Glint::radiance>("radiance", "1", "Linear RGB.")})};
}

std::vector<Parameter> picture_parameters() {
  return {
      real3("camera.position", "m", -100, 100, {0.6, 0, 1.21}, "Eye, in the car's axes: x forward, y left, z up."),
      real3("camera.target", "m", -1000, 1000, {10, 0, 1.6}, "Point that the eye looks at."),
      real("camera.vertical_fov_deg", "deg", 1, 120, 22, "Vertical field of view."),
      real("composite.blur_lod", "1", 0, 12, 3, "Mip level of the picture behind the wet film."),
      real("composite.wetness", "1", 0, 1, 0.6, "Weight of the blurred picture where the glass was not wiped.").default_for(correct, 0.35),
      real("composite.visible_from", "mm", 0, 10, 0.02, "Height at which water begins to show as a drop."),
      real("composite.visible_to", "mm", 1e-3, 10, 0.2, "Height from which it shows fully."),
      real("composite.refraction", "1", -1, 1, 0.08, "Offset of the sharp picture, in pictures per unit of the normal's x and y.").only(published),
      real("composite.water_ior", "1", 1, 2, 1.333, "Refractive index of water.").only(correct),
      real("composite.inner", "1", 0, 1, 0.3, "Share of the blurred scene that the water's surface mirrors.").only(correct),
      real("composite.shininess", "1", 1, 4096, 80, "Power of the highlights."),
      real("composite.glint_strength", "1", 0, 10, 0.5, "Weight of the highlights."),
      real3("composite.light_direction", "1", -1, 1, {-0.9, 0.25, 0.35}, "Toward the light that the water mirrors, in the car's axes."),
      real3("composite.light_radiance", "1", 0, 1000, {1, 0.92, 0.8}, "Its radiance, linear RGB."),
      real3("composite.cabin", "1", 0, 100, {0.004, 0.004, 0.005}, "Radiance beside the glass, linear RGB."),
      real("display.exposure", "EV", -20, 20, 0.5, "Exposure of the picture."),
  };
}

PictureSettings picture_settings(const Config& config) {
  PictureSettings s;
  const bool corrected = config.variant() == correct;
  s.camera_position = config.real3("camera.position");
  s.camera_target = config.real3("camera.target");
  s.vertical_fov_deg = config.real("camera.vertical_fov_deg");
  s.blur_lod = config.real("composite.blur_lod");
  s.wetness = config.real("composite.wetness");
  s.visible_from = config.real("composite.visible_from");
  s.visible_to = config.real("composite.visible_to");
  if (corrected) {
    s.water_ior = config.real("composite.water_ior");
    s.inner = config.real("composite.inner");
  } else {
    s.refraction = config.real("composite.refraction");
  }
  s.shininess = config.real("composite.shininess");
  s.glint_strength = config.real("composite.glint_strength");
  s.lights = {{config.real3("composite.light_direction"), config.real3("composite.light_radiance")}};
  s.cabin = config.real3("composite.cabin");
  s.exposure = config.real("display.exposure");
  return s;
}

}  // namespace rainref::windshield
