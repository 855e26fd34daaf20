#include "rainy_glass/parameters.h"

#include <vector>

#include "effect/scene_pictures.h"
#include "scene/member_parameter.h"

namespace rainref::rainy_glass {
namespace {

using namespace rainref::scene;

const std::vector<MemberParameter<Settings>>& members() {
  static const std::vector<MemberParameter<Settings>> table{
      choice<&Settings::shape>("glass.shape", {{"pane", Shape::pane}, {"sphere", Shape::sphere}, {"image", Shape::image}},
                               "An upright pane across the view, a ball, or the normals of glass.normal_image."),
      real<&Settings::distance>("glass.distance", "m", 0.01, 1000,
                                "Distance from the eye to the glass: to a pane along the level view, to a ball's centre along the view."),
      real<&Settings::yaw_deg>("glass.yaw", "deg", -80, 80, "Rotation of the pane about the vertical."),
      real<&Settings::radius>("glass.radius", "m", 0.001, 1000, "Radius of the ball."),
      text("glass.normal_image", "",
           "World normal of the glass at each pixel, as a mesh's normal pass gives it (integers hold n / 2 + 1/2). Alpha says where there "
           "is glass."),
      choice<&Settings::use_probe>("glass.background", {{"grab", false}, {"probe", true}},
                                   "What lies behind the glass: the scene's picture, or a reflection probe."),
      real<&Settings::drop_tile>("glass.drop_tile", "m", 1e-3, 1000, "Side of the raindrop map on the glass."),
      real<&Settings::rivulet_tile>("glass.rivulet_tile", "m", 1e-3, 1000, "Side of the rivulet map on the glass."),
      real<&Settings::distortion>("glass.distortion", "1", -1, 1, "Offset of the lookup by the summed channels, in pictures.")
          .only(published),
      real<&Settings::map_turn_deg>("glass.map_turn", "deg", -180, 180, "Rotation of both maps on the glass.").only(published),
      real<&Settings::rivulet_turn_deg>("glass.rivulet_turn", "deg", -180, 180, "Rotation of the rivulet map, added to that of both maps.")
          .only(published),
      real<&Settings::tint>("glass.tint", "1", 0, 1, "Factor of the light seen through the glass, linear RGB.").only(published),
      real<&Settings::water_ior>("glass.water_ior", "1", 1, 2, "Refractive index of water.").only(correct),
      real<&Settings::probe_level>("glass.probe_level", "1", 0, 16, "Mip level of the probe."),
      text("glass.probe_image", "", "Latitude/longitude panorama of the probe; empty: scene.panorama, or the street at night."),
      real<&Settings::rain_amount>("rain.amount", "1", 0, 1,
                                   "How heavy the rain is: droplets whose height in the map is below 1 - amount never show.")
          .published(1.0),
      real<&Settings::drop_period>("rain.drop_period", "s", 1e-3, 1e6,
                                   "Duration of a droplet's cycle: it appears, dries from its rim, and comes again.")
          .published(1.0),
      real<&Settings::flow_period>("rain.flow_period", "s", 1e-3, 1e6, "Duration of the cycle of each flow phase of the rivulets.")
          .published(1.0),
      real<&Settings::flow_strength>("rain.flow_strength", "1", 0, 10,
                                     "Distance that full flow moves a rivulet in a cycle, in tiles; corrected: across the glass.")
          .published(1.0),
      real<&Settings::flow_across>("rain.flow_across", "1", -10, 10,
                                   "Flow across the glass for B = 0 and for B = 1 of the rivulet map, times rain.flow_strength.")
          .only(published),
      real<&Settings::flow_along>("rain.flow_along", "1", -10, 10,
                                  "Flow along the glass for A = 0 and for A = 1 of the rivulet map, times rain.flow_strength.")
          .only(published),
      choice<&Settings::squared_weight>("rain.flow_weight", {{"triangle", false}, {"squared", true}},
                                        "Weight of the second flow phase: |1 - 2 p| at phase p, or its square.")
          .only(published),
      real<&Settings::rivulet_speed>("rain.rivulet_speed", "m/s", 0, 100, "Mean speed of the rivulets down the glass.").published(0.0),
      real<&Settings::run>("rain.run", "1", 0, 1, "Share of that mean speed by which rivulets become slower and faster.").only(correct),
      real<&Settings::rivulet_amount>("rain.rivulet_amount", "1", 0, 4, "Weight of the rivulets."),
      real<&Settings::fade_from>("rain.fade_from", "1", 0, 0.99,
                                 "Rivulets are full up to this |n.y| of the glass. Above it they fade, to none on level glass.")
          .only(published),
      choice<&Settings::signed_offset>("rain.time_offset", {{"stored", false}, {"signed", true}},
                                       "Time offset of a droplet: B of the raindrop map, or 2 B - 1.")
          .only(published),
      real<&Settings::impact>("rain.impact", "1", 1e-3, 0.9, "Share of its cycle during which a droplet spreads.").only(correct),
      real<&Settings::rim>("rain.rim", "1", 1e-4, 1, "Height over which a droplet's rim becomes visible.").only(correct),
      real<&Settings::wind>("rain.wind", "m/s", 0.1, 100, "Wind that drives the rain toward the glass.").only(correct),
      real<&Settings::fall_speed>("rain.fall_speed", "m/s", 0, 20, "Fall speed of the rain.").only(correct),
      integer<&Settings::map_size>("maps.size", "texel", 4, 8192, "Side of the baked maps."),
      storage<&Settings::map_storage>("maps.storage", {Format::rgba8, Format::rgba16f}, "Storage format of the maps.").published("rgba8"),
      rounding<&Settings::rounding>("maps.rounding"),
      choice<&Settings::remap_first>("maps.remap", {{"after", false}, {"before", true}},
                                     "When channels are remapped to [-1, 1]: after they are masked and added, or before.")
          .only(published),
      integer<&Settings::droplet_count>("maps.droplets", "1", 0, 4000,
                                        "Droplets to scatter over a tile; those that find no room are left out."),
      real<&Settings::largest_droplet>("maps.largest_droplet", "1", 1e-4, 0.2, "Radius of the largest droplet, in tiles."),
      real<&Settings::smallest_droplet>("maps.smallest_droplet", "1", 1e-5, 0.2, "Radius of the smallest droplet, in tiles."),
      real<&Settings::contact_angle_deg>("maps.contact_angle", "deg", 1, 80, "Steepest angle of the water at a droplet's rim."),
      integer<&Settings::trail_count>("maps.trails", "1", 0, 1000, "Rivulets in a tile."),
      real<&Settings::trail_half_width>("maps.trail_half_width", "1", 1e-4, 0.1, "Half width of the widest rivulet's head, in tiles."),
      integer<&Settings::flow_cells>("maps.flow_cells", "1", 1, 256, "Cells of the flow's coarser octave along a tile.")
          .published(std::int64_t{1}),
      real<&Settings::flow_gain>("maps.flow_gain", "1", 0, 10, "Factor of the flow's noise before it is clamped to [-1, 1].")
          .published(0.6),
      text("maps.raindrops_image", "", "Your own raindrop map: normal in R and G, time offset in B, height in A; empty: the baked map."),
      text("maps.rivulets_image", "", "Your own rivulet map: normal in R and G, flow in B (across) and A (along); empty: the baked map."),
      text("scene.image", "",
           "Picture or film behind the glass, of any size; empty: the street at night, through a camera that focuses on the glass."),
      text("scene.panorama", "",
           "Latitude/longitude panorama behind the glass instead of a picture, seen through the camera. It is as far as the sky."),
      text("scene.depth_image", "",
           "Depth of scene.image along the view axis, of the same shape: EXR, 16-bit PNG or NPY; empty: scene.depth.")
          .only(correct),
      effect::depth_parameter().only(correct),
      real("scene.depth_scale", "m", 1e-9, 1e9, 1, "Metres per unit of the depth image (65.535 for 16-bit millimetres).").only(correct),
      real("scene.defocus", "1", 0, 0.2, 0.012, "Radius of a far point's blur disc in street and panorama, in picture heights."),
      real("scene.bar_spacing", "m", 0, 100, 0.5,
           "Distance between a conservatory's glazing bars, which stand before a pane with the street or a panorama behind it; 0: none."),
      real("scene.bar_width", "m", 1e-4, 10, 0.03, "Width of a glazing bar."),
      real<&Settings::exposure>("display.exposure", "EV", -20, 20, "Exposure of the picture."),
      real<&Settings::camera_position>("camera.position", "m", -1e5, 1e5, "Position of the camera's eye."),
      real<&Settings::camera_target>("camera.target", "m", -1e5, 1e5, "Point that the camera looks at."),
      real<&Settings::camera_up>("camera.up", "1", -1, 1, "Direction that is up in the picture."),
      real<&Settings::vertical_fov_deg>("camera.vertical_fov_deg", "deg", 1, 170, "Vertical field of view."),
  };
  return table;
}

}  // namespace

std::span<const scene::Parameter> parameters() {
  static const std::vector<scene::Parameter> all = parameters_of(members(), {effect::sequence_parameters()});
  return all;
}

Settings settings_from(const scene::Config& config) { return scene::settings_from(members(), config); }
Settings default_settings(Variant variant) { return scene::default_settings(members(), variant); }

BackdropOptions backdrop_from(const scene::Config& c) {
  return {c.real("scene.defocus"), c.real("scene.bar_spacing"), c.real("scene.bar_width")};
}

}  // namespace rainref::rainy_glass
