#include "windshield/parameters.h"

#include <algorithm>

#include <fmt/format.h>

#include "effect/scene_pictures.h"
#include "rainref/error.h"
#include "scene/member_parameter.h"
#include "windshield/motion/glass.h"
#include "windshield/motion/parameters.h"

namespace rainref::windshield {
namespace {

using namespace rainref::scene;

/// The picture and its passes; size and margin are handled elsewhere.
const std::vector<MemberParameter<PictureSettings>>& picture_members() {
  using P = PictureSettings;
  static const std::vector<MemberParameter<P>> table{
      real<&P::camera_position>("camera.position", "m", -100, 100, "Position of the eye in the car's axes: x forward, y left, z up."),
      real<&P::camera_target>("camera.target", "m", -1000, 1000, "Point that the eye looks at."),
      real<&P::vertical_fov_deg>("camera.vertical_fov_deg", "deg", 1, 120, "Vertical field of view."),
      real<&P::blur_lod>("composite.blur_lod", "1", 0, 12, "Mip level of the picture behind the wet film.").published(3.0),
      real<&P::wetness>("composite.wetness", "1", 0, 1, "Weight of the blurred picture where the glass was not wiped.").published(0.6),
      real<&P::visible_from>("composite.visible_from", "mm", 0, 10, "Height at which water begins to show as a drop."),
      real<&P::visible_to>("composite.visible_to", "mm", 1e-3, 10, "Height from which water shows fully as a drop."),
      real<&P::refraction>("composite.refraction", "1", -1, 1, "Offset of the sharp picture, in pictures per unit of the normal's x and y.")
          .only(published),
      real<&P::water_ior>("composite.water_ior", "1", 1, 2, "Refractive index of water.").only(correct),
      real<&P::inner>("composite.inner", "1", 0, 1, "Share of the blurred scene that the water's surface mirrors.").only(correct),
      real<&P::shininess>("composite.shininess", "1", 1, 4096, "Power of the highlights."),
      real<&P::glint_strength>("composite.glint_strength", "1", 0, 10, "Weight of the highlights."),
      {real3("composite.light_direction", "1", -1, 1, {}, "Direction toward the light that the water mirrors, in the car's axes."),
       [](P& s, const Value& v) { s.lights.front().direction = std::get<Real3>(v); },
       [](const P& s) { return Value(s.lights.front().direction); }},
      {real3("composite.light_radiance", "1", 0, 1000, {}, "Radiance of the light that the water mirrors, linear RGB."),
       [](P& s, const Value& v) { s.lights.front().radiance = std::get<Real3>(v); },
       [](const P& s) { return Value(s.lights.front().radiance); }},
      real<&P::cabin>("composite.cabin", "1", 0, 100, "Radiance beside the glass, linear RGB."),
      real<&P::exposure>("display.exposure", "EV", -20, 20, "Exposure of the picture."),
  };
  return table;
}

const std::vector<MemberParameter<Settings>>& scene_members() {
  using S = Settings;
  using W = SurfaceSettings;
  using B = blur_pyramid::BlurSettings;
  static const std::vector<MemberParameter<S>> table{
      // Blades and time on the wet glass, and the scene out of focus behind it.
      real<&S::surface, &W::height_tau>(
          "windshield.height_tau", "s", 0, 600,
          "Time in which the height texture falls to 1/e where no drop is, so that drops leave trails; 0: it is cleared each frame.")
          .only(published),
      real<&S::surface, &W::wipe_strength>("windshield.wipe_strength", "mm", 0, 1000, "Height of water that a blade wipes off.")
          .only(published),
      real<&S::surface, &W::mask_tau>("windshield.mask_tau", "s", 0.01, 600, "Time in which the mask of freshly wiped glass falls to 1/e."),
      integer<&S::blur, &B::levels>("blur.blur_levels", "1", 1, Texture::max_levels,
                                    "Levels of the blurred scene, including the sharp one."),
      real<&S::blur, &B::fog_density>("blur.fog_density", "1/m", 0, 10, "Extinction of light in the air in front of the scene."),
      real<&S::blur, &B::fog_colour>("blur.fog_colour", "1", 0, 1000, "Linear radiance of the fog."),
      // The street before the car.
      text("scene.image", "", "Picture or film of the scene before the car, of any size; empty: the generated street at night."),
      text("scene.depth_image", "",
           "Depth of scene.image along the view axis, of the same shape: EXR, 16-bit PNG or NPY; empty: scene.depth."),
      effect::depth_parameter(),
      real("scene.depth_scale", "m", 1e-9, 1e9, 1, "Metres per unit of the depth image (65.535 for 16-bit millimetres)."),
      integer<&S::scene_size>("scene.size", "texel", 8, 8192,
                              "Columns and rows of the street's picture; a picture from a file is fitted to them."),
      real<&S::picture, &PictureSettings::scene_margin>("scene.margin", "1", 1, 4,
                                                        "Width of the scene's picture, divided by that of the view."),
      real<&S::street_start>("scene.start", "m", 0, 1e6, "Place on the street at time 0."),
      boolean<&S::scene_moves>("scene.moves", "The street moves past as the car drives; false: it stands still."),
      boolean<&S::clear_lane>("scene.clear_lane",
                              "No car of the street stands in the lane of the camera's car, which would drive through it."),
      boolean<&S::shows_blades>("scene.blades", "The scene's picture shows the wipers, dark and out of focus. Traced pictures do not.")
          .only(correct),
      integer<&S::keyframes>("scene.keyframes", "1", 1, 24,
                             "Pictures of the street per 12 m of way. Views between them are made from them. With more pictures, cars "
                             "close by warp less and the run takes longer.")};
  return table;
}
const std::vector<MemberParameter<Settings>>& detail_members() {
  using S = Settings;
  using F = FallingRainSettings;
  using M = SmearSettings;
  using C = CondensationSettings;
  using I = InteriorSettings;
  static const std::vector<MemberParameter<S>> table{
      // The rain in the air behind the glass.
      boolean<&S::falling, &F::on>("falling_rain.on", "Rain also falls behind the glass, in streaks that lamps light up."),
      real<&S::falling, &F::rate>("falling_rain.rate", "mm/h", 0, 200,
                                  "Rate of the rain behind the glass; rain.key_frames do not change it.")
          .only(published),
      real<&S::falling, &F::smallest_drop>("falling_rain.smallest_drop", "mm", 0.5, 5, "Drops below this diameter are left out."),
      real<&S::falling, &F::exposure>("falling_rain.exposure", "s", 0, 1, "Time for which the shutter is open in a frame."),
      real<&S::falling, &F::far>("falling_rain.far", "m", 1, 40, "Depth of the farthest drops."),
      real<&S::falling, &F::gain>("falling_rain.gain", "1", 0, 1000, "Radiance of the drops, divided by the physical value."),
      // The film that blades leave.
      boolean<&S::smear, &M::on>("smear.on", "Blades leave streaks of a thin film, which dries behind them.").only(correct),
      real<&S::smear, &M::wear>("smear.wear", "1", 0, 1, "Wear of the blades. 0: new; 1: ragged, with more and thicker streaks.")
          .only(correct),
      real<&S::smear, &M::drying>("smear.drying", "s", 0.01, 60, "Time in which the thickest streak dries.").only(correct),
      real<&S::smear, &M::most>("smear.most", "1", 0, 1, "Share of the light that the thickest streak scatters.").only(correct),
      real<&S::smear, &M::spread_deg>("smear.spread", "deg", 0.01, 20, "Largest angle by which the film turns light, along the blade.")
          .only(correct),
      // The mist of condensed water on the glass.
      boolean<&S::condensation, &C::on>("condensation.on", "Mist lies on the glass. Drops, their trails and blades clear it.")
          .only(correct),
      real<&S::condensation, &C::tau>("condensation.tau", "s", 0.01, 600,
                                      "Time in which the mist on cleared glass grows to 1 - 1/e of its limit.")
          .only(correct),
      real<&S::condensation, &C::most>("condensation.most", "1", 0, 1, "Share of the light that the mist scatters where nothing clears it.")
          .only(correct),
      real<&S::condensation, &C::water>("condensation.water", "mm", 1e-6, 10, "Height of water that absorbs all of the mist.")
          .only(correct),
      real<&S::condensation, &C::blur_lod>(
          "condensation.blur_lod", "1", 0, 12,
          "The picture behind the mist is blurred over a disc. The disc's radius is a texel of this mip level.")
          .only(correct),
      real<&S::condensation, &C::veil>("condensation.veil", "1", 0, 1, "Share of the scattered light that comes from the whole scene.")
          .only(correct),
      // Pillar and dashboard.
      boolean<&S::interior, &I::on>("interior.on",
                                    "Pillar and dashboard stand before the glass, dark and out of focus. Traced pictures do not show them.")
          .only(correct),
      real<&S::interior, &I::pillar>("interior.pillar", "1", 0, 1,
                                     "u of the left pillar's edge at the lower and at the upper end of the glass; 0, 0: none.")
          .only(correct),
      real<&S::interior, &I::dashboard>("interior.dashboard", "1", 0, 1, "v of the dashboard's edge; 0: none.").only(correct),
      real<&S::interior, &I::binnacle>("interior.binnacle", "1", 0, 1,
                                       "Height of the hood over the instruments, on the image plane at distance 1.")
          .only(correct),
      real<&S::interior, &I::light>("interior.light", "1", 0, 100, "Radiance of the lightest parts of the interior.").only(correct),
      real<&S::interior, &I::reflection>("interior.reflection", "1", 0, 1, "Share of the dashboard's light that the glass mirrors.")
          .only(correct)};
  return table;
}
const std::vector<MemberParameter<Settings>>& step_members() {
  static const std::vector<MemberParameter<Settings>> table{
      integer<&Settings::substeps>("windshield.substeps", "1", 1, 64, "Time steps of the drops in a frame.").only(correct)};
  return table;
}

constexpr int fewest_texels = 8, most_texels = 16384;
// Odd, so that panes of one scene, and scenes with neighbouring seeds, draw different numbers.
constexpr std::uint64_t next_seed = 0x9e3779b97f4a7c15;

int texels(double of_windshield, double metres, double metres_of_windshield) {
  return std::clamp(static_cast<int>(of_windshield * metres / metres_of_windshield + 0.5), fewest_texels, most_texels);
}

}  // namespace

std::span<const Parameter> parameters() {
  static const std::vector<Parameter> all = parameters_of(
      std::vector<MemberParameter<Settings>>(),
      {motion_parameters(), drops::parameters("windshield"), parameters_of(step_members()), drops::splat_parameters("windshield"),
       parameters_of(scene_members()), effect::sequence_parameters(), parameters_of(detail_members()), parameters_of(picture_members())});
  return all;
}

Settings settings_from(const Config& config) {
  Settings s;
  s.corrected = config.variant() == correct;
  s.seed = static_cast<std::uint64_t>(config.integer("seed"));
  s.fps = config.real("run.fps");
  apply(step_members(), config, s);
  static_cast<MotionSettings&>(s) = motion_settings_from(config);
  s.drops = drops::settings_from(config, "windshield");
  const char* rate = s.corrected ? "rain.rate" : "windshield.spawn_rate";
  s.weather.rain = config.real(rate);
  s.weather.most_rain = config.entry(rate).parameter.maximum;
  s.weather.rain_unit = s.corrected ? "mm/h" : "1/s";
  if (!s.weather.rain_key_frames.empty() && config.given(rate))
    throw Error(ExitCode::usage, config.entry(rate).origin.at,
                fmt::format("{}: expected none beside rain.key_frames, found {:g}", rate, s.weather.rain));

  const PlaneFrame plane = s.corrected ? s.glass.plane() : s.glass.axes();
  s.splat.corrected = s.corrected;
  s.splat.keys = drops::splat_keys(config, "windshield");
  s.splat.frame = plane.frame;
  if (s.corrected) s.splat.contact_angle = 0.5 * (s.drops.advancing_deg + s.drops.receding_deg) * degree;
  s.surface.corrected = s.corrected;
  s.surface.width = s.splat.keys.width;
  s.surface.height = s.splat.keys.height;
  s.surface.rounding = s.splat.keys.rounding;
  s.surface.fps = s.fps;
  s.surface.frame = plane.frame;
  s.surface.half_width = s.wipers.half_width;
  s.blur.corrected = s.corrected;
  s.blur.rounding = s.surface.rounding;

  apply(picture_members(), config, s.picture);
  apply(scene_members(), config, s);
  apply(detail_members(), config, s);
  if (effect::is_picture_far(config)) s.blur.fog_density = 0;
  s.picture.width = static_cast<int>(config.integer2("run.size")[0]);
  s.picture.height = static_cast<int>(config.integer2("run.size")[1]);
  constexpr double most = 300000;
  if (const double falling = most_falling(s, static_cast<double>(config.integer("run.frames")) / s.fps); falling > most)
    throw Error(ExitCode::usage,
                fmt::format("falling_rain.far: expected at most {:.0f} drops in view, found {:.0f}: nearer, or with a larger "
                            "falling_rain.smallest_drop",
                            most, falling));
  return s;
}

Settings settings_of_pane(const Settings& car, int number) {
  Settings s = car;
  if (number == 0) return s;
  s.corners = car.panes[static_cast<std::size_t>(number) - 1];
  s.glass = make_glass(s.corners, pane_name(number));
  static_cast<PaneWipers&>(s) = car.pane_wipers[static_cast<std::size_t>(number) - 1];
  s.surface.half_width = s.wipers.half_width;
  s.drops.seed += static_cast<std::uint64_t>(number) * next_seed;
  s.drops_share = s.glass.area / car.glass.area;
  s.drops.spawn_rate *= s.drops_share;
  const PlaneFrame plane = s.corrected ? s.glass.plane() : s.glass.axes(),
                   of_windshield = s.corrected ? car.glass.plane() : car.glass.axes();
  s.surface.frame = s.splat.frame = plane.frame;
  s.surface.width = s.splat.keys.width = texels(car.surface.width, plane.frame[0], of_windshield.frame[0]);
  s.surface.height = s.splat.keys.height = texels(car.surface.height, plane.frame[2], of_windshield.frame[2]);
  return s;
}

}  // namespace rainref::windshield
