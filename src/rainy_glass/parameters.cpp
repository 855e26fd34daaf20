#include "rainy_glass/parameters.h"

#include <vector>

namespace rainref::rainy_glass {
namespace {

using namespace rainref::scene;

constexpr const char* published = "as-published";
constexpr const char* correct = "corrected";

}  // namespace

std::span<const scene::Parameter> parameters() {
  static const std::vector<scene::Parameter> table{
      choice("glass.shape", {"pane", "sphere", "image"}, "pane",
             "An upright pane across the view, a ball, or the normals of glass.normal_image."),
      real("glass.distance", "m", 0.01, 1000, 0.5,
           "From the eye to the glass: along the level view to a pane, along the view to the ball's centre."),
      real("glass.yaw", "deg", -80, 80, 0, "Turn of the pane about the vertical."),
      real("glass.radius", "m", 0.001, 1000, 0.2, "Of the ball."),
      text("glass.normal_image", "",
           "World normals of the glass by pixel (a mesh's normal pass; integers n / 2 + 1/2), alpha where there is glass."),
      choice("glass.background", {"grab", "probe"}, "grab", "What lies behind the glass: the scene's picture, or a reflection probe."),
      real("glass.drop_tile", "m", 1e-3, 1000, 0.36, "Side of the raindrop map on the glass."),
      real("glass.rivulet_tile", "m", 1e-3, 1000, 0.4, "Side of the rivulet map on the glass."),
      real("glass.distortion", "1", -1, 1, 0.02, "Pictures by which the summed channels move the lookup.").only(published),
      real("glass.water_ior", "1", 1, 2, 1.333, "Refractive index of water.").only(correct),
      real("glass.probe_level", "1", 0, 16, 1, "Mip level of the probe."),
      text("glass.probe_image", "",
           "Latitude/longitude panorama of the probe, EXR, HDR, PNG or NPY; empty: scene.panorama, or the street at night."),
      real("rain.amount", "1", 0, 1, 1, "How heavy the rain is: droplets whose height in the map is below 1 - amount never show.")
          .default_for(correct, 0.9),
      real("rain.drop_period", "s", 1e-3, 1e6, 1, "Cycle of a droplet: it appears, dries from its rim, comes again.")
          .default_for(correct, 9.0),
      real("rain.flow_period", "s", 1e-3, 1e6, 1, "Cycle of each flow phase of the rivulets.").default_for(correct, 3.0),
      real("rain.flow_strength", "1", 0, 10, 1, "Offset of a rivulet at full flow in a cycle, in tiles; corrected: across the glass.")
          .default_for(correct, 0.015),
      real("rain.rivulet_speed", "m/s", 0, 100, 0.03, "Mean speed of the rivulets down the glass.").only(correct),
      real("rain.run", "1", 0, 1, 0.9, "Share of that speed by which rivulets hold back and run.").only(correct),
      real("rain.rivulet_amount", "1", 0, 4, 1, "Weight of the rivulets' slopes.").only(correct),
      real("rain.impact", "1", 1e-3, 0.9, 0.04, "Share of its cycle in which a droplet spreads.").only(correct),
      real("rain.rim", "1", 1e-4, 1, 0.06, "Height over which a droplet's rim turns visible.").only(correct),
      real("rain.wind", "m/s", 0.1, 100, 6, "Wind that drives the rain toward the glass.").only(correct),
      real("rain.fall_speed", "m/s", 0, 20, 6, "Fall speed of the rain.").only(correct),
      integer("maps.size", "texel", 4, 8192, 512, "Side of the baked maps."),
      choice("maps.storage", {"rgba8", "rgba16f"}, "rgba8", "Storage format of the maps.").default_for(correct, "rgba16f"),
      choice("maps.rounding", {"rne", "rtz"}, "rne", "Rounding of every store: to nearest even, or toward zero as many GPUs do."),
      integer("maps.droplets", "1", 0, 4000, 2200, "Droplets to scatter over a tile; those that find no room are left out."),
      real("maps.largest_droplet", "1", 1e-4, 0.2, 0.028, "Radius of the largest droplet, in tiles."),
      real("maps.smallest_droplet", "1", 1e-5, 0.2, 0.0035, "Radius of the smallest, in tiles."),
      real("maps.contact_angle", "deg", 1, 80, 45, "Steepest angle of the water at a droplet's rim."),
      integer("maps.trails", "1", 0, 1000, 22, "Rivulets in a tile."),
      real("maps.trail_half_width", "1", 1e-4, 0.1, 0.011, "Half width of the widest rivulet's head, in tiles."),
      integer("maps.flow_cells", "1", 1, 256, 8, "Cells of the flow's coarser octave along a tile."),
      real("maps.flow_gain", "1", 0, 10, 1.2, "Factor of the flow's noise before it is held in [-1, 1]."),
      text("maps.raindrops_image", "", "Raindrop map of your own: normal in R and G, time offset in B, height in A; empty: baked."),
      text("maps.rivulets_image", "", "Rivulet map of your own: normal in R and G, flow in B (across) and A (along); empty: baked."),
      text("scene.image", "",
           "Picture behind the glass, of the run's size, EXR, HDR, PNG or NPY; empty: the street at night, through a camera that focuses "
           "on the glass."),
      text("scene.panorama", "",
           "Latitude/longitude panorama behind the glass instead, EXR, HDR, PNG or NPY, seen through the camera; as far as the sky."),
      text("scene.depth_image", "", "Its depth along the view axis, of the same size, EXR, 16-bit PNG or NPY, needed beside scene.image.")
          .only(correct),
      real("scene.depth_scale", "m", 1e-9, 1e9, 1, "Metres in a unit of the depth image (65.535 for 16-bit millimetres).").only(correct),
      real("scene.defocus", "1", 0, 0.2, 0.012, "Of street and panorama: radius of a far point's disc, in picture heights."),
      real("scene.bar_spacing", "m", 0, 100, 0.5,
           "Of street and panorama, behind a pane: distance of the conservatory's glazing bars, which stand before the glass; 0: none."),
      real("scene.bar_width", "m", 1e-4, 10, 0.03, "Width of a bar."),
      real("display.exposure", "EV", -20, 20, 1, "Exposure of the picture."),
      real3("camera.position", "m", -1e5, 1e5, {2.2, 1.7, 12}, "Eye of the camera."),
      real3("camera.target", "m", -1e5, 1e5, {0.6, 1.9, -20}, "Point that the camera looks at."),
      real3("camera.up", "1", -1, 1, {0, 1, 0}, "Direction that is up in the picture."),
      real("camera.vertical_fov_deg", "deg", 1, 170, 40, "Vertical field of view."),
  };
  return table;
}

Settings settings_from(const scene::Config& c) {
  Settings s;
  const bool is_corrected = c.variant() == correct;
  s.variant = is_corrected ? Variant::corrected : Variant::as_published;
  s.seed = static_cast<std::uint64_t>(c.integer("seed"));
  s.fps = c.real("run.fps");
  s.width = static_cast<int>(c.integer2("run.size")[0]);
  s.height = static_cast<int>(c.integer2("run.size")[1]);
  const std::string& shape = c.text("glass.shape");
  s.shape = shape == "sphere" ? Shape::sphere : shape == "image" ? Shape::image : Shape::pane;
  s.distance = c.real("glass.distance");
  s.yaw_deg = c.real("glass.yaw");
  s.radius = c.real("glass.radius");
  s.use_probe = c.text("glass.background") == "probe";
  s.drop_tile = c.real("glass.drop_tile");
  s.rivulet_tile = c.real("glass.rivulet_tile");
  s.probe_level = c.real("glass.probe_level");
  s.rain_amount = c.real("rain.amount");
  s.drop_period = c.real("rain.drop_period");
  s.flow_period = c.real("rain.flow_period");
  s.flow_strength = c.real("rain.flow_strength");
  s.map_size = static_cast<int>(c.integer("maps.size"));
  s.map_storage = format_from_name(c.text("maps.storage"));
  s.rounding = c.text("maps.rounding") == "rtz" ? Rounding::rtz : Rounding::rne;
  s.droplet_count = static_cast<int>(c.integer("maps.droplets"));
  s.largest_droplet = c.real("maps.largest_droplet");
  s.smallest_droplet = c.real("maps.smallest_droplet");
  s.contact_angle_deg = c.real("maps.contact_angle");
  s.trail_count = static_cast<int>(c.integer("maps.trails"));
  s.trail_half_width = c.real("maps.trail_half_width");
  s.flow_cells = static_cast<int>(c.integer("maps.flow_cells"));
  s.flow_gain = c.real("maps.flow_gain");
  s.exposure = c.real("display.exposure");
  s.camera_position = c.real3("camera.position");
  s.camera_target = c.real3("camera.target");
  s.camera_up = c.real3("camera.up");
  s.vertical_fov_deg = c.real("camera.vertical_fov_deg");
  if (is_corrected) {
    s.water_ior = c.real("glass.water_ior");
    s.rivulet_speed = c.real("rain.rivulet_speed");
    s.run = c.real("rain.run");
    s.rivulet_amount = c.real("rain.rivulet_amount");
    s.impact = c.real("rain.impact");
    s.rim = c.real("rain.rim");
    s.wind = c.real("rain.wind");
    s.fall_speed = c.real("rain.fall_speed");
  } else {
    s.distortion = c.real("glass.distortion");
  }
  return s;
}

BackdropOptions backdrop_from(const scene::Config& c) {
  return {c.real("scene.defocus"), c.real("scene.bar_spacing"), c.real("scene.bar_width")};
}

}  // namespace rainref::rainy_glass
