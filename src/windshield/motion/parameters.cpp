#include "windshield/motion/parameters.h"

#include <fmt/format.h>

#include "rainref/error.h"
#include "scene/member_parameter.h"
#include "scene/value_text.h"
#include "windshield/motion/glass.h"
#include "windshield/motion/shelter.h"

namespace rainref::windshield {
namespace {

using namespace rainref::scene;

/// A corner of the glass.
MemberParameter<MotionSettings> corner(std::size_t i, std::string sentence) {
  return {real3(fmt::format("windshield.corner_{}", i), "m", -100, 100, {}, std::move(sentence)),
          [i](MotionSettings& s, const Value& v) { s.corners[i] = std::get<Real3>(v); },
          [i](const MotionSettings& s) { return Value(s.corners[i]); }};
}
const std::vector<MemberParameter<MotionSettings>>& members() {
  using M = MotionSettings;
  using V = VehicleSettings;
  static const std::vector<MemberParameter<M>> table{
      // 27 degrees from the horizontal, 1.4 m x 0.8 m, its lower edge 1.9 m ahead of the rear axle and 1 m above the road.
      corner(
          0,
          "Corner (0, 0) of the glass in the car's axes (x forward, y left, z up, from the middle of the rear axle); seen from inside at "
          "the lower left."),
      corner(1, "Corner (1, 0) of the glass; lower right."),
      corner(2, "Corner (0, 1) of the glass; upper left: this order says which side is outside."),
      {text("windshield.panes", "",
            "Further panes of the car: their corners in the same order, \"x y z, x y z, x y z; ...\" in m; empty: none."),
       [](M& s, const Value& v) { s.panes = parse_panes(std::get<std::string>(v)); }, [](const M&) { return Value(std::string()); }},
      real<&M::gravity>("world.gravity", "m/s^2", 0, 100, "Acceleration of gravity."),
      real<&M::weather, &WeatherSettings::wind>("world.wind", "m/s", -100, 100,
                                                "Velocity of the wind in world axes: x is the car's forward direction at heading 0, z up."),
      {text("world.wind_key_frames", "", "The wind by key frames, smooth between them: \"time x y z; ...\" in s and m/s; empty: none."),
       [](M& s, const Value& v) { s.weather.wind_key_frames = std::get<std::string>(v); },
       [](const M& s) { return Value(s.weather.wind_key_frames); }},
      {text("rain.key_frames", "",
            "The rain by key frames, smooth between them: \"time rate; ...\" in s and mm/h, as-published in new drops a second; empty: "
            "none."),
       [](M& s, const Value& v) { s.weather.rain_key_frames = std::get<std::string>(v); },
       [](const M& s) { return Value(s.weather.rain_key_frames); }},
      {text(
           "rain.shelter", "",
           "Bridges and tunnels, under which no rain falls: stretches of the way that the car has driven, \"from to; ...\" in m. A pane is "
           "where its middle is; empty: "
           "none."),
       [](M& s, const Value& v) { s.weather.shelter = parse_shelter(std::get<std::string>(v)); },
       [](const M&) { return Value(std::string()); }},
      real<&M::vehicle, &V::speed>("vehicle.speed", "m/s", 0, largest_speed,
                                   "Speed of the car, where neither key frames nor a drive cycle say it; 13.9 m/s are 50 km/h."),
      real<&M::vehicle, &V::yaw_rate>("vehicle.yaw_rate", "rad/s", -largest_yaw_rate, largest_yaw_rate,
                                      "Turn rate of the car, positive to the left, where neither key frames nor a drive cycle say it."),
      {real("vehicle.heading", "deg", -360, 360, 0, "Direction of the car at time 0, positive to the left."),
       [](M& s, const Value& v) { s.vehicle.heading = std::get<double>(v) * degree; },
       [](const M& s) { return Value(s.vehicle.heading / degree); }},
      real<&M::vehicle, &V::start>("vehicle.start", "s", -1e6, 1e6, "Time in the key frames or the drive cycle at time 0."),
      {text("vehicle.key_frames", "",
            "Speed by key frames, smooth between them: \"time speed; time speed; ...\" in s and m/s, or \"time speed yaw_rate\" in rad/s; "
            "empty: none."),
       [](M& s, const Value& v) { s.vehicle.key_frames = std::get<std::string>(v); },
       [](const M& s) { return Value(s.vehicle.key_frames); }},
      text("vehicle.drive_cycle", "", "CSV file with the columns time_s, speed_mps and, optionally, yaw_rad_s; empty: none."),
  };
  return table;
}

}  // namespace

std::vector<scene::Parameter> motion_parameters() {
  std::vector<scene::Parameter> all = parameters_of(members());
  for (int number = 0; number <= most_wiped_panes; ++number)
    for (const scene::Parameter& p : wiper_parameters(number)) all.push_back(p);
  return all;
}

MotionSettings motion_settings_from(const scene::Config& config) {
  MotionSettings s{};
  apply(members(), config, s);
  s.glass = make_glass(s.corners);
  const auto refuse_beside = [&](const char* key, const std::string& table) {
    if (!config.given(key)) return;
    const Config::Entry& entry = config.entry(key);
    const double* number = std::get_if<double>(&entry.value);
    throw Error(
        ExitCode::usage, entry.origin.at,
        fmt::format("{}: expected none beside {}, found {}", key, table, number ? fmt::format("{:g}", *number) : value_text(entry.value)));
  };
  if (!s.vehicle.key_frames.empty() || !config.text("vehicle.drive_cycle").empty())
    for (const char* key : {"vehicle.speed", "vehicle.yaw_rate"}) refuse_beside(key, "vehicle.key_frames or vehicle.drive_cycle");
  if (!s.weather.wind_key_frames.empty()) refuse_beside("world.wind", "world.wind_key_frames");
  s.vehicle.drive_cycle = config.text("vehicle.drive_cycle");
  const bool in_file = config.entry("vehicle.drive_cycle").origin.kind == scene::Origin::file;
  if (!s.vehicle.drive_cycle.empty() && s.vehicle.drive_cycle.is_relative() && in_file)
    s.vehicle.drive_cycle = config.directory() / s.vehicle.drive_cycle;

  static_cast<PaneWipers&>(s) = wipers_from(config, 0, s.glass);
  const int panes = static_cast<int>(s.panes.size());
  for (int number = 1; number <= panes; ++number)
    s.pane_wipers.push_back(
        number > most_wiped_panes
            ? PaneWipers()
            : wipers_from(config, number, make_glass(s.panes[static_cast<std::size_t>(number) - 1], pane_name(number))));
  for (int number = panes + 1; number <= most_wiped_panes; ++number)
    refuse_wipers(config, number, fmt::format("expected none, for windshield.panes has {} {}", panes, panes == 1 ? "pane" : "panes"));
  return s;
}

}  // namespace rainref::windshield
