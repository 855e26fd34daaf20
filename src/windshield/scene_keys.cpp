#include "windshield/scene_keys.h"

#include "math/constants.h"
#include "rainref/error.h"
#include "windshield/motion_parameters.h"
#include "windshield/picture_info.h"

namespace rainref::windshield {
namespace {

using namespace rainref::scene;

constexpr const char* correct = "corrected";

void append(std::vector<Parameter>& all, std::vector<Parameter> more) { all.insert(all.end(), more.begin(), more.end()); }

std::vector<Parameter> make() {
  std::vector<Parameter> all = motion_parameters();
  append(all, drops::parameters("windshield"));
  all.push_back(integer("windshield.substeps", "1", 1, 64, 1, "Steps of the drops in a frame.").only(correct));
  append(all, drops::splat_parameters("windshield"));
  append(all, surface_parameters("windshield"));
  append(all, blur_pyramid::blur_parameters("blur"));
  append(all, {text("scene.image", "", "Picture of what lies before the car, EXR, HDR, PNG or NPY; empty: the street at night made here."),
               text("scene.depth_image", "",
                    "Its depth along the view axis, of the same size, EXR, 16-bit PNG or NPY; empty: everything is far away."),
               real("scene.depth_scale", "m", 1e-9, 1e9, 1, "Metres in a unit of the depth image (65.535 for 16-bit millimetres)."),
               integer2("scene.size", "texel", 8, 8192, {1280, 720}, "Columns and rows of the street's picture."),
               real("scene.margin", "1", 1, 4, 1.15, "Width of the scene's picture over that of the view."),
               real("scene.start", "m", 0, 1e6, 0, "Place on the street at time 0."),
               boolean("scene.moves", true, "The street passes as the car drives; false: it stands still."),
               boolean("scene.clear_lane", false, "No car of the street stands in this one's lane: a drive would go through it."),
               integer("scene.keyframes", "1", 1, 24, 1,
                       "Pictures of the street in 12 m of way, of which the views between are made: the more, the less cars close by warp, "
                       "and the longer it takes.")});
  append(all, picture_parameters());
  return all;
}

}  // namespace

std::span<const Parameter> parameters() {
  static const std::vector<Parameter> all = make();
  return all;
}

Settings settings_from(const Config& config) {
  Settings s;
  s.corrected = config.variant() == correct;
  s.seed = static_cast<std::uint64_t>(config.integer("seed"));
  s.fps = config.real("run.fps");
  if (s.corrected) s.substeps = static_cast<int>(config.integer("windshield.substeps"));
  const MotionSettings motion = motion_settings_from(config);
  s.corners = {config.real3("windshield.corner_0"), config.real3("windshield.corner_1"), config.real3("windshield.corner_2")};
  s.wind = motion.wind;
  s.gravity = motion.gravity;
  s.vehicle = motion.vehicle;
  s.wipers = motion.wipers;
  s.capture = motion.capture;
  s.drops = drops::settings_from(config, "windshield");

  const PlaneFrame plane = s.corrected ? motion.glass.plane() : motion.glass.axes();
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
  read_surface(config, "windshield", s.surface);
  s.blur = blur_pyramid::blur_settings(config, "blur", s.surface.rounding);

  s.picture = picture_settings(config);
  s.picture.width = static_cast<int>(config.integer2("run.size")[0]);
  s.picture.height = static_cast<int>(config.integer2("run.size")[1]);
  s.picture.scene_margin = config.real("scene.margin");
  s.scene_size = {static_cast<int>(config.integer2("scene.size")[0]), static_cast<int>(config.integer2("scene.size")[1])};
  s.street_start = config.real("scene.start");
  s.clear_lane = config.boolean("scene.clear_lane");
  s.keyframes = static_cast<int>(config.integer("scene.keyframes"));
  s.scene_moves = config.boolean("scene.moves");
  return s;
}

}  // namespace rainref::windshield
