#include "puddle/parameters.h"

#include <vector>

#include "scene/member_parameter.h"

namespace rainref::puddle {
namespace {

using namespace rainref::scene;

const std::vector<MemberParameter<Settings>>& members() {
  static const std::vector<MemberParameter<Settings>> table{
      // The published parameters, in the article's order.
      integer<&Settings::drop_count>("puddle.drop_count", "1", 1, 10, "Number of simultaneous raindrops.").only(published),
      real<&Settings::drop_intensity>("puddle.drop_intensity", "1", 0, 4,
                                      "Strength of each raindrop's impact; corrected: factor of the crater's depth.")
          .published(0.5),
      real<&Settings::rain_speed>("puddle.rain_speed", "1/s", 0, 20, "How quickly new drops appear: pulses of each drop per second.")
          .only(published),
      real<&Settings::damping>(
          "puddle.damping", "1", 0.5, 1,
          "How fast ripples fade: energy that is left after 1/60 s (as-published: after a frame), 0.95 to 0.999 in the article.")
          .published(0.98),
      real<&Settings::reflectivity>(
          "puddle.reflectivity", "1", 0, 1,
          "How much the water reflects instead of showing the ground; corrected: factor of the Fresnel reflectance.")
          .published(0.6),
      // Beyond sqrt(2) the published display pass takes a power of a negative number.
      real<&Settings::vignette>(
          "puddle.vignette", "1", 0, 0x1.6a09e6p+0,
          "Darkening of the picture's edges: loss at distance 1 from the centre, where each side of the picture is 1 long.")
          .published(0.4),
      real<&Settings::fog_depth>("puddle.fog_depth", "1/m", 0, 10, "Density of the distance fog.").published(0.01),
      real<&Settings::env_rotation>("puddle.env_rotation", "rad", 0, 6.2831853071795862,
                                    "Rotation of the environment about the vertical axis."),
      boolean<&Settings::use_checkerboard>("puddle.use_checkerboard", "Checkerboard ground instead of the ground image.").published(true),
      real<&Settings::ground_scale>("puddle.ground_scale", "1/m", 1e-4, 100, "Tiles of the ground, or of the checkerboard, per metre.")
          .published(0.15),
      real<&Settings::water_turbidity>("puddle.water_turbidity", "1/m", 0, 1000, "Attenuation of light in the water by Beer's law.")
          .published(0.05),
      real<&Settings::puddle_depth>("puddle.puddle_depth", "m", 0.001, 100,
                                    "Depth of the ground below y = 0; corrected: depth of the puddle's deepest point.")
          .published(5.0),
      real<&Settings::tint>("puddle.tint", "1", 0, 1, "Colour of the water's body, linear RGB.").published(Real3{0.02, 0.05, 0.06}),
      // How the water is stored and computed.
      storage<&Settings::storage>("puddle.storage", {Format::rg16f, Format::rg32f, Format::rgba8},
                                  "Storage format of the wave: newest and previous level."),
      rounding<&Settings::rounding>("puddle.rounding"),
      choice<&Settings::boundary>("puddle.boundary",
                                  {{"reflecting", Boundary::reflecting}, {"periodic", Boundary::periodic}, {"fixed", Boundary::fixed}},
                                  "What happens to waves at the edge of the water's rectangle."),
      integer<&Settings::max_steps>("puddle.max_steps", "1", 1, 4096, "Maximum number of steps of the march along a view ray."),
      real<&Settings::step>("puddle.step", "texel", 1, 8, "Distance of the four neighbours (STEP). A fraction reads between texels.")
          .only(published),
      integer<&Settings::grid>("puddle.grid", "texel", 2, 8192, "Cells of the water in x and z.").only(correct),
      real<&Settings::cell_size>("puddle.cell_size", "m", 1e-5, 10, "Side of a cell.").only(correct),
      real<&Settings::wave_speed>("puddle.wave_speed", "m/s", 0, 100, "Speed of the ripples.").only(correct),
      real<&Settings::step_rate>("puddle.step_rate", "1/s", 1, 100000, "Wave steps per second, at any frame rate.").only(correct),
      real<&Settings::rim_width>("puddle.rim_width", "m", 0, 100,
                                 "Width of a rim along the water's edges that absorbs waves. Use two wavelengths or more; 0: none.")
          .only(correct),
      choice<&Settings::shape>("puddle.shape", {{"natural", Shape::natural}, {"basin", Shape::basin}},
                               "An irregular shore, or water of constant depth everywhere.")
          .only(correct),
      integer<&Settings::bed_columns>("puddle.bed_columns", "texel", 2, 4096,
                                      "Columns of the image of a natural puddle's bed. Its rows follow from puddle.grid.")
          .only(correct),
      real<&Settings::shore_width>("puddle.shore_width", "m", 1e-6, 1, "Depth over which wet ground turns into water.").only(correct),
      real<&Settings::ground_reach>("puddle.ground_reach", "1", 0, 1000,
                                    "Distance, in extents of the puddle, over which the ground around it turns into the environment's "
                                    "ground; 0: the ground goes on to the horizon.")
          .only(correct),
      choice<&Settings::exact_fresnel>("puddle.fresnel", {{"exact", true}, {"schlick", false}},
                                       "Reflectance of the surface: Fresnel's equations, or Schlick's approximation.")
          .only(correct),
      text("puddle.ground_image", "", "Image of the ground, a tile; empty: generated asphalt."),
      real<&Settings::rain_rate>("rain.rate", "mm/h", 0, 200, "Rain rate. Drops follow Marshall and Palmer's size distribution.")
          .only(correct),
      real<&Settings::smallest_drop>("rain.smallest_drop", "mm", 0, 5, "Drops below this diameter leave no crater.").only(correct),
      {text("rain.shelter", "", "Roofs over the water. No rain falls under them: \"x0 z0 x1 z1; ...\" in world metres.").only(correct),
       [](Settings& s, const Value& v) { s.shelter = std::get<std::string>(v); }, [](const Settings& s) { return Value(s.shelter); }},
      text("rain.shelter_image", "",
           "Picture over the water's rectangle, with the least z at its lower edge: white where all rain falls, black where none falls.")
          .only(correct),
      {text("puddle.objects", "",
            "Round objects that move through the water: \"radius depth: time x z, time x z, ...; ...\" in m and s. depth: how far the "
            "object's middle presses the water down.")
           .only(correct),
       [](Settings& s, const Value& v) { s.objects = std::get<std::string>(v); }, [](const Settings& s) { return Value(s.objects); }},
      text("environment.image", "", "Picture of the surroundings; empty: the generated street at night."),
      choice("environment.layout", {"latlong", "cube"}, "latlong",
             "Latitude/longitude panorama, or six cube faces in a row or column (+x -x +y -y +z -z)."),
      integer("environment.width", "texel", 0, 8192, 1024,
              "Columns of the panorama of the generated street, which has half as many rows. 0: as fine as the picture, from 1024 to 4096.")
          .default_for(correct, std::int64_t{0}),
      real<&Settings::exposure>("display.exposure", "EV", -20, 20, "Exposure of the picture.").only(correct),
      real<&Settings::camera_position>("camera.position", "m", -1e5, 1e5, "Position of the camera's eye.").published(Real3{20, 18, 14}),
      real<&Settings::camera_target>("camera.target", "m", -1e5, 1e5, "Point that the camera looks at.").published(Real3{-6, -4, 10}),
      real<&Settings::camera_up>("camera.up", "1", -1, 1, "Direction that is up in the picture."),
      real<&Settings::vertical_fov_deg>("camera.vertical_fov_deg", "deg", 1, 170, "Vertical field of view.").published(60.0),
  };
  return table;
}

}  // namespace

std::span<const scene::Parameter> parameters() {
  static const std::vector<scene::Parameter> all = parameters_of(members());
  return all;
}

Settings settings_from(const scene::Config& config) { return scene::settings_from(members(), config); }
Settings default_settings(Variant variant) { return scene::default_settings(members(), variant); }

}  // namespace rainref::puddle
