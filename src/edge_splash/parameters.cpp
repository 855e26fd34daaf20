#include "edge_splash/parameters.h"

#include <vector>

namespace rainref::edge_splash {
namespace {

using namespace rainref::scene;

constexpr const char *published = "as-published", *correct = "corrected";

}  // namespace

std::span<const scene::Parameter> parameters() {
  static const std::vector<scene::Parameter> table{
      // The published settings, in the article's order.
      real3("edge_splash.drop_color", "1", 0, 1000, {1, 1, 1}, "Colour of the drops, linear RGB.")
          .default_for(correct, Real3{0.34, 0.40, 0.43}),
      real("edge_splash.drop_alpha", "1", 0, 1, 1, "Opacity of the drops.").default_for(correct, 0.85),
      integer("edge_splash.thickness", "texel", 0, 20, 3,
              "Distance of the Sobel taps where the device depth is 1; it shrinks with the square of the depth.")
          .only(published),
      real("edge_splash.edge_threshold", "1", 0, 16, 0.166, "Sobel sum of device depths that counts as an edge.").only(published),
      real("edge_splash.rain_drop_scale", "1", 0, 1, 0.5, "Threshold of the noise: drops are where it lies above.")
          .default_for(correct, 0.52),
      real("edge_splash.drop_speed", "texel/s", -1e6, 1e6, 100, "Speed of the noise, in x and in y.").only(published),
      choice("edge_splash.rounding", {"rne", "rtz"}, "rne", "Rounding of every store: to nearest even, or toward zero as many GPUs do."),
      // In metres and picture heights.
      real("edge_splash.band", "m", 1e-4, 100, 0.03, "Width of the splashes beside an edge.").only(correct),
      real("edge_splash.smallest_band", "picture height", 1e-5, 0.05, 1.0 / 720, "A band is no narrower, and no narrower than a texel.")
          .only(correct),
      real("edge_splash.largest_band", "picture height", 1e-5, 0.05, 0.01, "A band is no wider.").only(correct),
      real("edge_splash.edge_step", "m", 1e-4, 1000, 0.15, "Smallest step of distance that counts as an edge.").only(correct),
      real("edge_splash.edge_bend", "1", 1e-4, 1, 0.02,
           "Smallest share of its distance by which an edge stands before what is behind it; a plane has none.")
          .only(correct),
      real("edge_splash.softness", "1", 1e-4, 10, 0.3,
           "Every threshold t of the masks ends at (1 + softness) t; those of noise and angle that share of their way to 1 further.")
          .only(correct),
      real("edge_splash.widest_angle", "deg", 1, 90, 62, "Between an edge's normal and the way up.").only(correct),
      real3("edge_splash.up", "1", -1, 1, {0, 1, 0}, "Where the rain comes from, world axes.").only(correct),
      real("edge_splash.noise_size", "picture height", 0.01, 100, 0.3, "Height of the noise tile.").only(correct),
      real2("edge_splash.drop_velocity", "picture height/s", -1000, 1000, {0.25, -1.0}, "Velocity of the noise.").only(correct),
      // The picture.
      choice("scene.source", {"shapes", "street", "files"}, "shapes",
             "A mine track in fog, the street at night, both made here, or the files below."),
      text("scene.image", "", "Picture that rain falls on, EXR, HDR, PNG or NPY; needs scene.depth_image."),
      text("scene.depth_image", "", "Its depth, EXR, 16-bit PNG or NPY."),
      choice("scene.depth_encoding", {"device", "metres"}, "device",
             "What the depth image holds: device depth in [0, 1], or metres along the view axis."),
      real("scene.depth_scale", "m", 1e-9, 1e9, 1,
           "Metres in a unit of the depth image, where it holds metres (65.535 for 16-bit millimetres)."),
      text("scene.noise_image", "", "Noise map, a tile; empty: gradient noise made here."),
      text("scene.layer_image", "", "Where splashes may be, white; empty: everywhere.").only(correct),
      real("scene.near", "m", 1e-4, 1e5, 0.3, "Near plane of the device depth."),
      real("scene.far", "m", 1e-3, 1e7, 1000, "Far plane of the device depth."),
      boolean("scene.reversed_depth", true, "Device depth 1 is near and 0 far; else the other way round."),
      real3("camera.position", "m", -1e5, 1e5, {0.15, 1.25, 1.2}, "Eye of the camera."),
      real3("camera.target", "m", -1e5, 1e5, {-0.35, 0.75, -6}, "Point that the camera looks at."),
      real3("camera.up", "1", -1, 1, {0, 1, 0}, "Direction that is up in the picture."),
      real("camera.vertical_fov_deg", "deg", 1, 170, 50, "Vertical field of view; of a picture from a file, too."),
      real("display.exposure", "EV", -20, 20, 1.2, "Exposure of the picture."),
  };
  return table;
}

Settings settings_from(const scene::Config& config) {
  Settings s;
  s.variant = config.variant() == correct ? Variant::corrected : Variant::as_published;
  s.seed = static_cast<std::uint64_t>(config.integer("seed"));
  s.fps = config.real("run.fps");
  s.width = static_cast<int>(config.integer2("run.size")[0]);
  s.height = static_cast<int>(config.integer2("run.size")[1]);
  s.depth = {config.real("scene.near"), config.real("scene.far"), config.boolean("scene.reversed_depth")};
  s.drop_color = config.real3("edge_splash.drop_color");
  s.drop_alpha = config.real("edge_splash.drop_alpha");
  s.rain_drop_scale = config.real("edge_splash.rain_drop_scale");
  s.rounding = config.text("edge_splash.rounding") == "rtz" ? Rounding::rtz : Rounding::rne;
  s.exposure = config.real("display.exposure");
  if (s.variant == Variant::as_published) {
    s.thickness = static_cast<int>(config.integer("edge_splash.thickness"));
    s.edge_threshold = config.real("edge_splash.edge_threshold");
    s.drop_speed = config.real("edge_splash.drop_speed");
  } else {
    s.band = config.real("edge_splash.band");
    s.smallest_band = config.real("edge_splash.smallest_band");
    s.largest_band = config.real("edge_splash.largest_band");
    s.edge_step = config.real("edge_splash.edge_step");
    s.edge_bend = config.real("edge_splash.edge_bend");
    s.softness = config.real("edge_splash.softness");
    s.widest_angle_deg = config.real("edge_splash.widest_angle");
    s.up = config.real3("edge_splash.up");
    s.noise_size = config.real("edge_splash.noise_size");
    s.drop_velocity = config.real2("edge_splash.drop_velocity");
  }
  s.camera_position = config.real3("camera.position");
  s.camera_target = config.real3("camera.target");
  s.camera_up = config.real3("camera.up");
  s.vertical_fov_deg = config.real("camera.vertical_fov_deg");
  return s;
}

}  // namespace rainref::edge_splash
