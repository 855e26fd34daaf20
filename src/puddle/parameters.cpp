#include "puddle/parameters.h"

#include <vector>

namespace rainref::puddle {
namespace {

using namespace rainref::scene;

constexpr const char* published = "as-published";
constexpr const char* correct = "corrected";

}  // namespace

std::span<const scene::Parameter> parameters() {
  static const std::vector<scene::Parameter> table{
      // The published parameters, in the article's order.
      integer("puddle.drop_count", "1", 1, 10, 5, "Number of simultaneous raindrops.").only(published),
      real("puddle.drop_intensity", "1", 0, 4, 0.5, "Strength of each raindrop's impact; corrected: factor of the crater's depth.")
          .default_for(correct, 1.0),
      real("puddle.rain_speed", "1/s", 0, 20, 1.5, "How quickly new drops appear: pulses of each drop a second.").only(published),
      real("puddle.damping", "1", 0.5, 1, 0.98,
           "How fast ripples fade: energy kept in 1/60 s (as-published: in a frame), 0.95 to 0.999 in the article.")
          .default_for(correct, 0.96),
      real("puddle.reflectivity", "1", 0, 1, 0.6,
           "How much the water reflects against showing the ground; corrected: factor of the Fresnel reflectance.")
          .default_for(correct, 1.0),
      // Beyond sqrt(2) the published display pass takes a power of a negative number.
      real("puddle.vignette", "1", 0, 0x1.6a09e6p+0, 0.4,
           "Darkening of the picture's edges: loss at distance 1 from the centre in picture sides.")
          .default_for(correct, 0.2),
      real("puddle.fog_depth", "1/m", 0, 10, 0.01, "Density of the distance fog.").default_for(correct, 0.02),
      real("puddle.env_rotation", "rad", 0, 6.2831853071795862, 0, "Rotation of the environment about the vertical axis."),
      boolean("puddle.use_checkerboard", true, "Checkerboard ground instead of the ground image.").default_for(correct, false),
      real("puddle.ground_scale", "1/m", 1e-4, 100, 0.15, "Tiles of the ground, or of the checkerboard, in a metre.")
          .default_for(correct, 1.6),
      real("puddle.water_turbidity", "1/m", 0, 1000, 0.05, "Attenuation of light in the water by Beer's law.").default_for(correct, 6.0),
      real("puddle.puddle_depth", "m", 0.001, 100, 5, "Depth of the ground under y = 0; corrected: of the puddle's deepest point.")
          .default_for(correct, 0.03),
      real3("puddle.tint", "1", 0, 1, {0.02, 0.05, 0.06}, "Colour of the water's body, linear RGB.")
          .default_for(correct, Real3{0.05, 0.045, 0.04}),
      // How the water is stored and computed.
      choice("puddle.storage", {"rg16f", "rg32f", "rgba8"}, "rg16f", "Storage format of the wave: newest and previous level."),
      choice("puddle.rounding", {"rne", "rtz"}, "rne", "Rounding of every store: to nearest even, or toward zero as many GPUs do."),
      choice("puddle.boundary", {"reflecting", "periodic", "fixed"}, "reflecting", "What waves meet at the edge of the water's rectangle."),
      integer("puddle.max_steps", "1", 1, 4096, 256, "Most steps of the march along a view ray."),
      real("puddle.step", "texel", 1, 8, 1, "Offset of the four neighbours (STEP); a fraction reads between texels.").only(published),
      integer2("puddle.grid", "texel", 2, 8192, {768, 512}, "Cells of the water in x and z.").only(correct),
      real("puddle.cell_size", "m", 1e-5, 10, 0.004, "Side of a cell.").only(correct),
      real("puddle.wave_speed", "m/s", 0, 100, 0.25, "Speed of the ripples.").only(correct),
      real("puddle.step_rate", "1/s", 1, 100000, 240, "Wave steps in a second, whatever the frame rate.").only(correct),
      choice("puddle.shape", {"natural", "basin"}, "natural", "An irregular shore, or water of constant depth all over.").only(correct),
      real("puddle.shore_width", "m", 1e-6, 1, 0.004, "Depth over which wet ground turns into water.").only(correct),
      choice("puddle.fresnel", {"exact", "schlick"}, "exact", "Reflectance of the surface.").only(correct),
      text("puddle.ground_image", "", "Image of the ground, a tile; empty: asphalt made here."),
      real("rain.rate", "mm/h", 0, 200, 5, "Rain rate; drops follow Marshall and Palmer's size distribution.").only(correct),
      real("rain.smallest_drop", "mm", 0, 5, 1.6, "Drops below this diameter leave no crater.").only(correct),
      text("environment.image", "", "Picture of the surroundings, EXR, HDR or PNG; empty: the street at night made here."),
      choice("environment.layout", {"latlong", "cube"}, "latlong",
             "Latitude/longitude panorama, or six cube faces in a row or column (+x -x +y -y +z -z)."),
      real("display.exposure", "EV", -20, 20, 0.7, "Exposure of the picture.").only(correct),
      real3("camera.position", "m", -1e5, 1e5, {20, 18, 14}, "Eye of the camera.").default_for(correct, Real3{0.25, 0.36, 1.8}),
      real3("camera.target", "m", -1e5, 1e5, {-6, -4, 10}, "Point that the camera looks at.").default_for(correct, Real3{0.0, 0.0, 0.1}),
      real3("camera.up", "1", -1, 1, {0, 1, 0}, "Direction that is up in the picture."),
      real("camera.vertical_fov_deg", "deg", 1, 170, 60, "Vertical field of view.").default_for(correct, 36.0),
  };
  return table;
}

Settings settings_from(const scene::Config& config) {
  Settings s;
  s.variant = config.variant() == correct ? Variant::corrected : Variant::as_published;
  const bool is_corrected = s.variant == Variant::corrected;
  s.seed = static_cast<std::uint64_t>(config.integer("seed"));
  s.fps = config.real("run.fps");
  s.width = static_cast<int>(config.integer2("run.size")[0]);
  s.height = static_cast<int>(config.integer2("run.size")[1]);
  s.drop_intensity = config.real("puddle.drop_intensity");
  s.damping = config.real("puddle.damping");
  s.reflectivity = config.real("puddle.reflectivity");
  s.vignette = config.real("puddle.vignette");
  s.fog_depth = config.real("puddle.fog_depth");
  s.env_rotation = config.real("puddle.env_rotation");
  s.use_checkerboard = config.boolean("puddle.use_checkerboard");
  s.ground_scale = config.real("puddle.ground_scale");
  s.water_turbidity = config.real("puddle.water_turbidity");
  s.puddle_depth = config.real("puddle.puddle_depth");
  s.tint = config.real3("puddle.tint");
  s.storage = format_from_name(config.text("puddle.storage"));
  s.rounding = config.text("puddle.rounding") == "rtz" ? Rounding::rtz : Rounding::rne;
  const std::string& boundary = config.text("puddle.boundary");
  s.boundary = boundary == "periodic" ? Boundary::periodic : boundary == "fixed" ? Boundary::fixed : Boundary::reflecting;
  s.max_steps = static_cast<int>(config.integer("puddle.max_steps"));
  s.camera_position = config.real3("camera.position");
  s.camera_target = config.real3("camera.target");
  s.camera_up = config.real3("camera.up");
  s.vertical_fov_deg = config.real("camera.vertical_fov_deg");
  if (is_corrected) {
    s.grid = {static_cast<int>(config.integer2("puddle.grid")[0]), static_cast<int>(config.integer2("puddle.grid")[1])};
    s.cell_size = config.real("puddle.cell_size");
    s.wave_speed = config.real("puddle.wave_speed");
    s.step_rate = config.real("puddle.step_rate");
    s.shape = config.text("puddle.shape") == "basin" ? Shape::basin : Shape::natural;
    s.shore_width = config.real("puddle.shore_width");
    s.exact_fresnel = config.text("puddle.fresnel") == "exact";
    s.exposure = config.real("display.exposure");
    s.rain_rate = config.real("rain.rate");
    s.smallest_drop = config.real("rain.smallest_drop");
  } else {
    s.drop_count = static_cast<int>(config.integer("puddle.drop_count"));
    s.rain_speed = config.real("puddle.rain_speed");
    s.step = config.real("puddle.step");
  }
  return s;
}

}  // namespace rainref::puddle
