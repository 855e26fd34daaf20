#include "screen_drops/parameters.h"

#include <vector>

#include "screen_drops/flow.h"
#include "effect/picture_sequence.h"
#include "scene/member_parameter.h"
#include "screen_drops/uniforms.h"

namespace rainref::screen_drops {
namespace {

using namespace rainref::scene;

const std::vector<MemberParameter<Settings>>& members() {
  static const std::vector<MemberParameter<Settings>> table{
      // The origin's constants.
      real<&Settings::grid>("drops.grid", "cell/pixel", 1e-4, 1, "Cells of the coarsest layer per pixel. Layer r has r times as many.")
          .only(published),
      integer<&Settings::layers>("drops.layers", "1", 1, most_published_layers, "Number of grids of cells. Layer 1 lies on top.")
          .only(published),
      real<&Settings::cell_angle>("drops.cell_angle", "rad", 0.01, 100,
                                  "Angle of the sine over a cell: the source's c1, which stands for 2 pi.")
          .only(published),
      real<&Settings::noise_middle>("drops.noise_middle", "1", 0, 1, "Noise that displaces nothing: the source's c2.").only(published),
      real<&Settings::displacement>("drops.displacement", "rad", -100, 100, "Displacement of the grid per unit of noise: the source's c3.")
          .only(published),
      real<&Settings::keep_from>("drops.keep_from", "1", 0, 100,
                                 "A cell of layer r holds a drop if its noise is below (drops.keep_from - r) times drops.keep.")
          .only(published),
      real<&Settings::keep>("drops.keep", "1", 0, 1, "What each layer keeps more than the next finer one: see drops.keep_from.")
          .only(published),
      real<&Settings::threshold>("drops.threshold", "1", least_threshold, 2, "Sum of the two sines, faded, above which there is a drop.")
          .only(published),
      real<&Settings::refraction>("drops.refraction", "1", -1, 1, "Offset of the lookup for a unit normal across the view, in pictures.")
          .only(published),
      boolean<&Settings::printed_misprint>("drops.printed_misprint",
                                           "Displaces the grid by (1 - c2) c3, as the report prints, instead of by the noise.")
          .only(published),
      boolean<&Settings::printed_normal>("drops.printed_normal",
                                         "Takes the normal from cos(sin p), as the report prints, instead of from cos p.")
          .only(published),
      choice<&Settings::lod>("drops.lod", {{"finest", Lod::finest}, {"fixed", Lod::fixed}, {"gradient", Lod::gradient}},
                             "Mip level at which drops see the scene: the finest, drops.level (fixed), or one from the gradient of a "
                             "drop's normal, as a fragment shader takes it from neighbouring pixels.")
          .only(published),
      real<&Settings::lod_level>("drops.level", "1", 0, 16, "Mip level at which drops see the scene if drops.lod is fixed.")
          .only(published),
      real<&Settings::blur_level>("background.level", "1", 0, 16, "Mip level of the scene behind the drops.").only(published),
      integer<&Settings::noise_size>("noise.size", "texel", 1, 4096, "Side of the generated noise.").only(published),
      choice<&Settings::noise_filter>("noise.filter", {{"bilinear", Filter::linear}, {"nearest", Filter::nearest}},
                                      "Filter of the noise's lookups. Filtered white noise is seldom low, so few cells hold a drop.")
          .only(published),
      text("noise.image", "", "Your own noise: four channels, a tile; empty: generated noise.").only(published),
      // Glass in metres.
      real<&Settings::pane_height>("glass.height", "m", 1e-3, 100, "Height of the glass that the picture shows.").only(correct),
      real<&Settings::largest_radius>("drops.largest_radius", "mm", 0.01, 1000,
                                      "Radius of the largest drop's base. Radii go down to a 16th of this, with density ~ 1 / radius^3.")
          .only(correct),
      real<&Settings::share>("drops.share", "1", 0, 1, "Share of the cells that hold a drop.").only(correct),
      real<&Settings::contact_angle_deg>("drops.contact_angle", "deg", 1, 85, "Contact angle of the drops.").only(correct),
      real<&Settings::shortest_cycle>("drops.shortest_cycle", "s", 0.01, 65.535, "Shortest time after which a cell draws another drop.")
          .only(correct),
      real<&Settings::longest_cycle>("drops.longest_cycle", "s", 0.01, 65.535, "Longest time after which a cell draws another drop.")
          .only(correct),
      real<&Settings::impact>("drops.impact", "1", 1e-3, 0.9, "Share of its cycle during which a drop spreads; then it dries.")
          .only(correct),
      real<&Settings::water_ior>("drops.water_ior", "1", 1, 2, "Refractive index of water.").only(correct),
      real<&Settings::inner>("drops.inner", "1", 0, 1, "Share of the background that the water's surface mirrors.").only(correct),
      real<&Settings::defocus>("background.defocus", "picture height", 0, 0.2,
                               "Radius of a far point's blur disc, in a camera that focuses on the glass.")
          .only(correct),
      rounding<&Settings::rounding>("drops.rounding"),
      text("scene.image", "", "Picture or film behind the glass, of any size; empty: the street at night."),
      text("scene.panorama", "",
           "Latitude/longitude panorama behind the glass instead of a picture, seen through the camera. It is as far as the sky."),
      choice<&Settings::wrap>("scene.wrap", {{"clamp", Address::clamp}, {"repeat", Address::repeat}, {"mirror", Address::mirror}},
                              "How the scene's picture goes on beyond its edge, for drops and background.")
          .only(published),
      real<&Settings::scene_margin>(
          "scene.margin", "1", 1, 10,
          "Field of view of the scene's picture, divided by that of the picture, as tangents. Drops see what lies beside the view.")
          .only(correct),
      real<&Settings::exposure>("display.exposure", "EV", -20, 20, "Exposure of the picture."),
      real<&Settings::camera_position>("camera.position", "m", -1e5, 1e5, "Position of the camera's eye."),
      real<&Settings::camera_target>("camera.target", "m", -1e5, 1e5,
                                     "Point that the camera looks at, through glass that stands across the view."),
      real<&Settings::camera_up>("camera.up", "1", -1, 1, "Direction that is up in the picture."),
      real<&Settings::vertical_fov_deg>("camera.vertical_fov_deg", "deg", 1, 150, "Vertical field of view, also of a picture from a file."),
      boolean("flow.on", true, "Whether rain also brings drops that slide and merge.").only(correct),
  };
  return table;
}

}  // namespace

std::span<const scene::Parameter> parameters() {
  static const std::vector<scene::Parameter> all = parameters_of(members(), {effect::sequence_parameters(), flow_parameters()});
  return all;
}

Settings settings_from(const scene::Config& config) { return scene::settings_from(members(), config); }
Settings default_settings(Variant variant) { return scene::default_settings(members(), variant); }

std::optional<FlowSettings> flow_from(const scene::Config& config, const Settings& s) {
  if (s.variant != Variant::corrected || !config.boolean("flow.on")) return {};
  return flow_settings(config, {s.pane_height * s.width / s.height, s.pane_height}, s.rounding);
}

}  // namespace rainref::screen_drops
