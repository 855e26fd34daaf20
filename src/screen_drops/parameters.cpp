#include "screen_drops/parameters.h"

#include <vector>

#include "screen_drops/flow_info.h"

namespace rainref::screen_drops {
namespace {

using namespace rainref::scene;

constexpr const char *published = "as-published", *correct = "corrected";

}  // namespace

std::span<const scene::Parameter> parameters() {
  static const std::vector<scene::Parameter> table = [] {
    std::vector<scene::Parameter> all{
        // The origin's constants.
        real("drops.grid", "cell/pixel", 1e-4, 1, 0.015, "Cells of the coarsest layer in a pixel; layer r has r times as many.")
            .only(published),
        real("drops.keep", "1", 0, 1, 0.08, "A cell of layer r holds a drop where its noise is below 5 - r times this.").only(published),
        real("drops.refraction", "1", -1, 1, 0.3, "Pictures by which a unit normal across the view moves the lookup.").only(published),
        boolean("drops.printed_misprint", false, "Displaces the grid by (1 - c2) c3, as the report prints, instead of by the noise.")
            .only(published),
        real("background.level", "1", 0, 16, 2.5, "Mip level of the scene behind the drops.").only(published),
        integer("noise.size", "texel", 1, 4096, 256, "Side of the noise made here.").only(published),
        text("noise.image", "", "Noise of your own, four channels, a tile; empty: made here.").only(published),
        // Glass in metres.
        real("glass.height", "m", 1e-3, 100, 0.12, "Glass in the height of the picture.").only(correct),
        real("drops.largest_radius", "mm", 0.01, 1000, 4, "Base of the largest drop; radii go down to a 16th, with density ~ 1 / radius^3.")
            .only(correct),
        real("drops.share", "1", 0, 1, 0.6, "Share of the cells that hold a drop.").only(correct),
        real("drops.contact_angle", "deg", 1, 85, 50, "Of the drops' caps.").only(correct),
        real("drops.shortest_cycle", "s", 0.01, 65.535, 8, "Shortest time after which a cell draws another drop.").only(correct),
        real("drops.longest_cycle", "s", 0.01, 65.535, 30, "Longest such time.").only(correct),
        real("drops.impact", "1", 1e-3, 0.9, 0.02, "Share of its cycle in which a drop spreads; then it dries.").only(correct),
        real("drops.water_ior", "1", 1, 2, 1.333, "Refractive index of water.").only(correct),
        real("drops.inner", "1", 0, 1, 0.3, "Share of the background that the water's surface mirrors.").only(correct),
        real("background.defocus", "picture height", 0, 0.2, 0.02, "Radius of a far point's disc, in a camera that focuses on the glass.")
            .only(correct),
        choice("drops.rounding", {"rne", "rtz"}, "rne", "Rounding of every store: to nearest even, or toward zero as many GPUs do."),
        text("scene.image", "", "Picture behind the glass, of the run's size, EXR, HDR, PNG or NPY; empty: the street at night."),
        text("scene.panorama", "",
             "Latitude/longitude panorama behind the glass instead, EXR, HDR, PNG or NPY, seen through the camera; as far as the sky."),
        real("scene.margin", "1", 1, 10, 2.2,
             "Field of view of the scene's picture over that of the picture, as tangents: drops see what lies beside the view.")
            .only(correct),
        real("display.exposure", "EV", -20, 20, 0.5, "Exposure of the picture."),
        real3("camera.position", "m", -1e5, 1e5, {2.2, 1.7, 12}, "Eye of the camera."),
        real3("camera.target", "m", -1e5, 1e5, {0.6, 1.9, -20},
              "Point that the camera looks at, through glass that stands across the view."),
        real3("camera.up", "1", -1, 1, {0, 1, 0}, "Direction that is up in the picture."),
        real("camera.vertical_fov_deg", "deg", 1, 150, 30, "Vertical field of view; of a picture from a file, too."),
        boolean("flow.on", true, "Whether rain also brings drops that slide and merge.").only(correct),
    };
    for (const scene::Parameter& p : flow_parameters("flow")) all.push_back(p);
    return all;
  }();
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
  s.rounding = c.text("drops.rounding") == "rtz" ? Rounding::rtz : Rounding::rne;
  s.exposure = c.real("display.exposure");
  s.camera_position = c.real3("camera.position");
  s.camera_target = c.real3("camera.target");
  s.camera_up = c.real3("camera.up");
  s.vertical_fov_deg = c.real("camera.vertical_fov_deg");
  if (is_corrected) {
    s.pane_height = c.real("glass.height");
    s.largest_radius = c.real("drops.largest_radius");
    s.share = c.real("drops.share");
    s.contact_angle_deg = c.real("drops.contact_angle");
    s.shortest_cycle = c.real("drops.shortest_cycle");
    s.longest_cycle = c.real("drops.longest_cycle");
    s.impact = c.real("drops.impact");
    s.water_ior = c.real("drops.water_ior");
    s.inner = c.real("drops.inner");
    s.defocus = c.real("background.defocus");
    s.scene_margin = c.real("scene.margin");
  } else {
    s.grid = c.real("drops.grid");
    s.keep = c.real("drops.keep");
    s.refraction = c.real("drops.refraction");
    s.printed_misprint = c.boolean("drops.printed_misprint");
    s.blur_level = c.real("background.level");
    s.noise_size = static_cast<int>(c.integer("noise.size"));
  }
  return s;
}

std::optional<FlowSettings> flow_from(const scene::Config& config, const Settings& s) {
  if (s.variant != Variant::corrected || !config.boolean("flow.on")) return {};
  return flow_settings(config, "flow", {s.pane_height * s.width / s.height, s.pane_height}, s.rounding);
}

}  // namespace rainref::screen_drops
