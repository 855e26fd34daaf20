#include "edge_splash/parameters.h"

#include <vector>

#include "effect/picture_sequence.h"
#include "scene/member_parameter.h"

namespace rainref::edge_splash {
namespace {

using namespace rainref::scene;

const std::vector<MemberParameter<Settings>>& members() {
  static const std::vector<MemberParameter<Settings>> table{
      // The published settings, in the article's order.
      real<&Settings::drop_color>("edge_splash.drop_color", "1", 0, 1000, "Colour of the drops, linear RGB.").published(Real3{1, 1, 1}),
      real<&Settings::drop_alpha>("edge_splash.drop_alpha", "1", 0, 1, "Opacity of the drops.").published(1.0),
      integer<&Settings::thickness>("edge_splash.thickness", "texel", 0, 20,
                                    "Distance of the Sobel taps where the device depth is 1; it shrinks with the square of the depth.")
          .only(published),
      real<&Settings::edge_threshold>("edge_splash.edge_threshold", "1", 0, 1, "Sobel sum of device depths that counts as an edge.")
          .only(published),
      real<&Settings::rain_drop_scale>("edge_splash.rain_drop_scale", "1", 0, 1,
                                       "Threshold of the noise: drops are where the noise is above it.")
          .published(0.5),
      real<&Settings::drop_speed>("edge_splash.drop_speed", "texel/s", -1e6, 1e6, "Speed of the noise, in x and in y.").only(published),
      storage<&Settings::storage>("edge_splash.storage", {Format::rgba16f, Format::rgba8},
                                  "Storage format of the picture with drops. The article's target has 8 bits per channel.")
          .only(published),
      rounding<&Settings::rounding>("edge_splash.rounding"),
      // In metres and picture heights.
      real<&Settings::band>("edge_splash.band", "m", 1e-4, 100, "Width of the splashes beside an edge.").only(correct),
      real<&Settings::smallest_band>("edge_splash.smallest_band", "picture height", 1e-5, 0.05,
                                     "Smallest width of a band. A band is also no narrower than a texel.")
          .only(correct),
      real<&Settings::largest_band>("edge_splash.largest_band", "picture height", 1e-5, 0.05, "Largest width of a band.").only(correct),
      real<&Settings::edge_step>("edge_splash.edge_step", "m", 1e-4, 1000, "Smallest step of distance that counts as an edge.")
          .only(correct),
      real<&Settings::edge_bend>("edge_splash.edge_bend", "1", 1e-4, 1,
                                 "Smallest step of distance at an edge, as a share of the distance behind the edge; a plane has none.")
          .only(correct),
      real<&Settings::softness>(
          "edge_splash.softness", "1", 1e-4, 10,
          "Every threshold t of the masks is a ramp from t to (1 + softness) t; for noise and angle, from t to t + softness (1 - t).")
          .only(correct),
      real<&Settings::widest_angle_deg>("edge_splash.widest_angle", "deg", 1, 90, "Largest angle between an edge's normal and up.")
          .only(correct),
      real<&Settings::up>("edge_splash.up", "1", -1, 1, "Direction from which the rain comes, in world axes.").only(correct),
      real<&Settings::noise_size>("edge_splash.noise_size", "picture height", 0.01, 100, "Height of the noise tile.").only(correct),
      real<&Settings::drop_velocity>("edge_splash.drop_velocity", "picture height/s", -1000, 1000, "Velocity of the noise.").only(correct),
      choice<&Settings::has_crowns>(
          "edge_splash.splashes", {{"noise", false}, {"crowns", true}},
          "What the drops are without a noise map: a scrolling noise, or crowns that rise, fall and thin out where drops hit.")
          .only(correct),
      // The picture.
      choice("scene.source", {"shapes", "street", "files"}, "shapes",
             "A generated mine track in fog, the generated street at night, or the files below."),
      text("scene.image", "", "Picture or film that rain falls on, of any size. It overrides scene.source."),
      text("scene.depth_image", "",
           "Depth of scene.image, of the same shape: EXR, 16-bit PNG or NPY; empty: all is far, and nothing splashes."),
      choice("scene.depth_encoding", {"device", "metres"}, "device",
             "What the depth image holds: device depth in [0, 1], or metres along the view axis."),
      real("scene.depth_scale", "m", 1e-9, 1e9, 1,
           "Metres per unit of the depth image, if it holds metres (65.535 for 16-bit millimetres)."),
      text("scene.noise_image", "", "Noise map, a tile; empty: generated gradient noise."),
      text("scene.layer_image", "", "White where splashes may be; empty: everywhere.").only(correct),
      real<&Settings::depth, &DepthRange::near_plane>("scene.near", "m", 1e-4, 1e5, "Near plane of the device depth."),
      real<&Settings::depth, &DepthRange::far_plane>("scene.far", "m", 1e-3, 1e7, "Far plane of the device depth."),
      boolean<&Settings::depth, &DepthRange::reversed>("scene.reversed_depth",
                                                       "Device depth 1 is near and 0 far; false: the other way round."),
      real<&Settings::camera_position>("camera.position", "m", -1e5, 1e5, "Position of the camera's eye."),
      real<&Settings::camera_target>("camera.target", "m", -1e5, 1e5, "Point that the camera looks at."),
      real<&Settings::camera_up>("camera.up", "1", -1, 1, "Direction that is up in the picture."),
      real<&Settings::vertical_fov_deg>("camera.vertical_fov_deg", "deg", 1, 170, "Vertical field of view, also of a picture from a file."),
      real<&Settings::exposure>("display.exposure", "EV", -20, 20, "Exposure of the picture."),
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

}  // namespace rainref::edge_splash
