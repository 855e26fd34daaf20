#include "windshield/motion_parameters.h"

#include <fmt/format.h>

#include "math/constants.h"
#include "rainref/error.h"

namespace rainref::windshield {
namespace {

using namespace rainref::scene;

constexpr const char *published = "as-published", *correct = "corrected";
constexpr int most_wipers = 2;
// The tandem arrangement, as its keys would say it.
constexpr double pivot[most_wipers][2] = {{0.12, -0.06}, {0.71, -0.06}}, inner[most_wipers] = {0.18, 0.14},
                 outer[most_wipers] = {0.8, 0.68};
constexpr double sweep[most_wipers] = {91, 104};

std::string numbered(const char* key, int i) { return fmt::format("wipers.{}_{}", key, i); }

}  // namespace

std::vector<scene::Parameter> motion_parameters() {
  std::vector<scene::Parameter> table{
      // 27 degrees from the horizontal, 1.4 m x 0.8 m, its lower edge 1.9 m ahead of the rear axle and 1 m above the road.
      real3("windshield.corner_0", "m", -100, 100, {1.9, 0.7, 1.0},
            "Corner (0, 0) of the glass in the car's axes (x forward, y left, z up, from the middle of the rear axle); seen from inside at "
            "the lower left."),
      real3("windshield.corner_1", "m", -100, 100, {1.9, -0.7, 1.0}, "Corner (1, 0) of the glass; lower right."),
      real3("windshield.corner_2", "m", -100, 100, {1.18719478064930573, 0.7, 1.36319239979163742},
            "Corner (0, 1) of the glass; upper left."),
      real("world.gravity", "m/s^2", 0, 100, standard_gravity, "Acceleration of gravity."),
      real3("world.wind", "m/s", -100, 100, {0, 0, 0},
            "Velocity of the wind in world axes: x is the car's forward direction at heading 0, z up."),
      real("vehicle.speed", "m/s", 0, largest_speed, 13.9,
           "Speed of the car, where neither key frames nor a drive cycle say it; 13.9 m/s are 50 km/h."),
      real("vehicle.yaw_rate", "rad/s", -largest_yaw_rate, largest_yaw_rate, 0,
           "Turn rate of the car, positive to the left, where neither key frames nor a drive cycle say it."),
      real("vehicle.heading", "deg", -360, 360, 0, "Direction of the car at time 0, positive to the left."),
      real("vehicle.start", "s", -1e6, 1e6, 0, "Time in the key frames or the drive cycle at time 0."),
      text("vehicle.key_frames", "",
           "Speed by key frames, smooth between them: \"time speed; time speed; ...\" in s and m/s, or \"time speed yaw_rate\" in rad/s; "
           "empty: none."),
      text("vehicle.drive_cycle", "", "CSV file with the columns time_s, speed_mps and, optionally, yaw_rad_s; empty: none."),
      integer("wipers.count", "1", 0, most_wipers, most_wipers, "Blades."),
      choice("wipers.arrangement", {"tandem", "opposed", "custom"}, "tandem",
             "Blades that turn the same way, or toward each other, fitted to the glass; custom: as the keys ending in _0 and _1 say."),
      real("wipers.cycles_per_minute", "1/min", 0, 600, 45,
           "Strokes forth and back in a minute; EU 1008/2010 asks for at least 45 at the highest speed; 0: at rest."),
      // As published a texture is wiped by the blade's present outline alone: 25 mm leave no gap at 60 frames and 45 cycles.
      real("wipers.half_width", "m", 1e-4, 0.2, 0.025, "Half the width that a blade wipes.").default_for(correct, 0.008),
      real("wipers.follow", "1", 0, 1, 0.6, "Share of the way to the blade's leading edge that a captured drop makes in a frame.")
          .only(published),
      real("wipers.inherit", "1", 0, 1, 0.5, "Share of the blade's velocity that a captured drop takes over in a frame.").only(published),
      real("wipers.gain", "1", 0, 100, 0.02, "Mass that a captured drop gains in a frame.").only(published),
  };
  for (int i = 0; i < most_wipers; ++i) {
    const std::string blade = fmt::format("Custom arrangement, blade {}: ", i);
    table.push_back(real2(numbered("pivot", i), "m", -100, 100, {pivot[i][0], pivot[i][1]},
                          blade + "pivot, in metres in the glass from corner (0, 0), x along the edge to corner (1, 0)."));
    table.push_back(real(numbered("inner_radius", i), "m", 0, 100, inner[i], blade + "distance of its inner end from the pivot."));
    table.push_back(real(numbered("outer_radius", i), "m", 0, 100, outer[i], blade + "distance of its outer end from the pivot."));
    table.push_back(real(numbered("start_angle", i), "deg", -360, 360, 4, blade + "angle at rest, from x toward y."));
    table.push_back(real(numbered("sweep", i), "deg", -360, 360, sweep[i], blade + "angle that it turns, positive from x toward y."));
    table.push_back(real(numbered("phase", i), "1", 0, 1, 0, blade + "share of its cycle that is over at time 0."));
  }
  return table;
}

MotionSettings motion_settings_from(const scene::Config& config) {
  MotionSettings s{};
  s.glass = make_glass({config.real3("windshield.corner_0"), config.real3("windshield.corner_1"), config.real3("windshield.corner_2")});
  s.gravity = config.real("world.gravity");
  s.wind = config.real3("world.wind");
  s.vehicle.speed = config.real("vehicle.speed");
  s.vehicle.yaw_rate = config.real("vehicle.yaw_rate");
  s.vehicle.heading = config.real("vehicle.heading") * degree;
  s.vehicle.start = config.real("vehicle.start");
  s.vehicle.key_frames = config.text("vehicle.key_frames");
  const bool has_table = !s.vehicle.key_frames.empty() || !config.text("vehicle.drive_cycle").empty();
  for (const char* key : {"vehicle.speed", "vehicle.yaw_rate"}) {
    if (has_table && config.given(key)) {
      throw Error(ExitCode::usage, config.entry(key).origin.at,
                  fmt::format("{}: expected none beside vehicle.key_frames or vehicle.drive_cycle, found {:g}", key, config.real(key)));
    }
  }
  s.vehicle.drive_cycle = config.text("vehicle.drive_cycle");
  const bool in_file = config.entry("vehicle.drive_cycle").origin.kind == scene::Origin::file;
  if (!s.vehicle.drive_cycle.empty() && s.vehicle.drive_cycle.is_relative() && in_file)
    s.vehicle.drive_cycle = config.directory() / s.vehicle.drive_cycle;

  const int count = static_cast<int>(config.integer("wipers.count"));
  s.wipers.cycles_per_minute = config.real("wipers.cycles_per_minute");
  s.wipers.half_width = config.real("wipers.half_width");
  if (config.text("wipers.arrangement") != "custom") {
    s.wipers.blades = arranged_blades(config.text("wipers.arrangement"), count, s.glass);
  } else {
    for (int i = 0; i < count; ++i) {
      const auto number = [&](const char* key) { return config.real(numbered(key, i)); };
      s.wipers.blades.push_back({config.real2(numbered("pivot", i)), number("inner_radius"), number("outer_radius"),
                                 number("start_angle") * degree, number("sweep") * degree, number("phase")});
    }
  }
  check(s.wipers, s.glass);
  if (config.variant() == published) s.capture = {config.real("wipers.follow"), config.real("wipers.inherit"), config.real("wipers.gain")};
  return s;
}

}  // namespace rainref::windshield
