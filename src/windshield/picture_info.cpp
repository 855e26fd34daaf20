#include "windshield/picture_info.h"

#include "math/constants.h"
#include "pass/display.h"
#include "pass/info.h"
#include "windshield/composite.pass.h"

namespace rainref::windshield {
namespace {

using namespace rainref::scene;
using namespace rainref::capture;

constexpr const char *published = "as-published", *correct = "corrected";

}  // namespace

std::vector<PassInfo> picture_passes() { return {pass::info_of<CompositePass>(), pass::display_info("composite")}; }

std::vector<BufferInfo> picture_buffers() {
  const std::array<double, 2> one{0, 1};
  std::vector<BufferInfo> all{{"glints", "records", "Lights that drops mirror.", "1", one, "none", "none", "none", "", "Glint"}};
  const std::vector<BufferInfo> colour = pass::buffers_of<CompositePass>();
  all.insert(all.end(), colour.begin(), colour.end());
  all.push_back({"picture", "rgba8", "Display code; alpha 1.", "1", one, "sRGB", "sRGB", "opaque"});
  return all;
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
      real("composite.refraction", "1", -1, 1, 0.08, "Offset of the sharp picture, in pictures per unit of the normal's x and y.")
          .only(published),
      real("composite.water_ior", "1", 1, 2, water_refractive_index, "Refractive index of water.").only(correct),
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
