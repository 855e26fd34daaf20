#include "windshield/motion/parameters.h"

#include <array>

#include <fmt/format.h>

#include "base/path_text.h"
#include "rainref/error.h"
#include "scene/check.h"
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
      corner(0,
             "Corner (0, 0) of the glass in the car's axes (x forward, y left, z up, from the middle of the rear axle): the lower left "
             "corner as seen from inside."),
      corner(1, "Corner (1, 0) of the glass: lower right."),
      corner(2, "Corner (0, 1) of the glass: upper left. The order of the corners says which side is outside."),
      {text("windshield.panes", "",
            "Further panes of the car: their corners in the same order, \"x y z, x y z, x y z; ...\" in m; empty: none."),
       [](M& s, const Value& v) { s.panes = parse_panes(std::get<std::string>(v)); }, [](const M&) { return Value(std::string()); }},
      real<&M::gravity>("world.gravity", "m/s^2", 0, 100, "Acceleration of gravity."),
      real<&M::weather, &WeatherSettings::wind>("world.wind", "m/s", -100, 100,
                                                "Velocity of the wind in world axes: x is the car's forward direction at heading 0, z up."),
      {text("world.wind_key_frames", "",
            "Key frames of the wind, which is smooth between them: \"time x y z; ...\" in s and m/s; empty: none."),
       [](M& s, const Value& v) { s.weather.wind_key_frames = std::get<std::string>(v); },
       [](const M& s) { return Value(s.weather.wind_key_frames); }},
      {text("rain.key_frames", "",
            "Key frames of the rain, which is smooth between them: \"time rate; ...\" in s and mm/h (as-published: new drops per second); "
            "empty: none."),
       [](M& s, const Value& v) { s.weather.rain_key_frames = std::get<std::string>(v); },
       [](const M& s) { return Value(s.weather.rain_key_frames); }},
      {text("rain.shelter", "",
            "Bridges and tunnels, where no rain falls, as stretches of the car's way: \"from to; ...\" in m. A pane is inside while its "
            "middle is; empty: none."),
       [](M& s, const Value& v) { s.weather.shelter = parse_shelter(std::get<std::string>(v)); },
       [](const M&) { return Value(std::string()); }},
      real<&M::vehicle, &V::speed>("vehicle.speed", "m/s", 0, largest_speed,
                                   "Speed of the car, if neither key frames nor a drive cycle give it. 13.9 m/s are 50 km/h."),
      real<&M::vehicle, &V::yaw_rate>("vehicle.yaw_rate", "rad/s", -largest_yaw_rate, largest_yaw_rate,
                                      "Turn rate of the car, positive to the left, if neither key frames nor a drive cycle give it."),
      {real("vehicle.heading", "deg", -360, 360, 0, "Direction of the car at time 0, positive to the left."),
       [](M& s, const Value& v) { s.vehicle.heading = std::get<double>(v) * degree; },
       [](const M& s) { return Value(s.vehicle.heading / degree); }},
      real<&M::vehicle, &V::start>("vehicle.start", "s", -1e6, 1e6, "Time in the key frames or the drive cycle at which the run begins."),
      {text("vehicle.key_frames", "",
            "Key frames of the speed, which is smooth between them: \"time speed; time speed; ...\" in s and m/s, or \"time speed "
            "yaw_rate\" with rad/s; empty: none."),
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
  s.vehicle.drive_cycle = utf8_path(config.text("vehicle.drive_cycle"));
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

namespace {

using namespace rainref::scene;

/// The values of the keys, before blades are arranged.
struct WiperKeys {
  PaneWipers pane;
  double fast_cycles_per_minute = 65;                     ///< for "fast" in key frames
  std::array<Blade, most_wipers> custom = tandem_blades;  ///< values of the keys ending in _0 and _1
};

std::string of_pane(int number) { return number == 0 ? "" : fmt::format("Pane {} of windshield.panes: ", number); }

/// For the custom arrangement.
std::vector<MemberParameter<WiperKeys>> blade_members(int number, std::size_t i) {
  const std::string table = wiper_table(number), begin = fmt::format("{}Custom arrangement, blade {}: ", of_pane(number), i);
  const auto member = [&](const char* key, const char* unit, double least, double most, double Blade::*of, const char* sentence,
                          double in_unit = 1) {
    return MemberParameter<WiperKeys>(
        real(fmt::format("{}.{}_{}", table, key, i), unit, least, most, 0, begin + sentence),
        [=](WiperKeys& s, const Value& v) { s.custom[i].*of = std::get<double>(v) * in_unit; },
        [=](const WiperKeys& s) { return Value(s.custom[i].*of / in_unit); });
  };
  return {{real2(fmt::format("{}.pivot_{}", table, i), "m", -100, 100, {},
                 begin + "pivot in the plane of the glass, in metres from corner (0, 0), with x along the edge to corner (1, 0)."),
           [i](WiperKeys& s, const Value& v) { s.custom[i].pivot = std::get<Real2>(v); },
           [i](const WiperKeys& s) { return Value(s.custom[i].pivot); }},
          member("inner_radius", "m", 0, 100, &Blade::inner_radius, "distance of its inner end from the pivot."),
          member("outer_radius", "m", 0, 100, &Blade::outer_radius, "distance of its outer end from the pivot."),
          member("start_angle", "deg", -360, 360, &Blade::start_angle, "angle at rest, from x toward y.", degree),
          member("sweep", "deg", -360, 360, &Blade::sweep, "angle through which it turns, positive from x toward y.", degree),
          member("phase", "1", 0, 1, &Blade::phase, "share of its cycle that is over at time 0.")};
}

std::vector<MemberParameter<WiperKeys>> members(int number) {
  using K = WiperKeys;
  const std::string begin = of_pane(number);
  const auto key = [table = wiper_table(number)](const char* name) { return fmt::format("{}.{}", table, name); };
  std::vector<MemberParameter<K>> all{
      integer(key("count"), "1", 0, most_wipers, number == 0 ? most_wipers : 0, begin + "Number of blades."),
      choice(key("arrangement"), {"tandem", "opposed", "custom"}, "tandem",
             begin + "Blades that turn the same way or toward each other, fitted to the glass. custom: the keys ending in _0 and _1 "
                     "describe them."),
      real<&K::pane, &PaneWipers::wipers, &WiperSettings::cycles_per_minute>(
          key("cycles_per_minute"), "1/min", 0, 600,
          begin + "Strokes back and forth per minute. EU 1008/2010 asks for at least 45 at the highest speed; 0: at rest."),
      text(key("key_frames"), "",
           begin + "Key frames of the wipers, each valid until the next: \"time off; time intermittent PERIOD; time slow; time fast\" in "
                   "s. slow: cycles_per_minute; empty: always slow."),
      real<&K::fast_cycles_per_minute>(key("fast_cycles_per_minute"), "1/min", 0, 600,
                                       begin + "Strokes per minute while key frames say fast."),
      // As published a texture is wiped only by the blade's current outline; 25 mm leave no gap at 60 frames and 45 cycles.
      real<&K::pane, &PaneWipers::wipers, &WiperSettings::half_width>(key("half_width"), "m", 1e-4, 0.2,
                                                                      begin + "Half the width that a blade wipes.")
          .published(0.025),
      real<&K::pane, &PaneWipers::capture, &Capture::follow>(
          key("follow"), "1", 0, 1, begin + "Share of the way to the blade's leading edge that a captured drop moves in a frame.")
          .only(published),
      real<&K::pane, &PaneWipers::capture, &Capture::inherit>(
          key("inherit"), "1", 0, 1, begin + "Share of the blade's velocity that a captured drop takes over in a frame.")
          .only(published),
      real<&K::pane, &PaneWipers::capture, &Capture::gain>(key("gain"), "1", 0, 100, begin + "Mass that a captured drop gains in a frame.")
          .only(published),
  };
  for (std::size_t i = 0; i < most_wipers; ++i)
    for (const MemberParameter<K>& m : blade_members(number, i)) all.push_back(m);
  return all;
}
const std::vector<MemberParameter<WiperKeys>>& members_of(int number) {
  static const std::array<std::vector<MemberParameter<WiperKeys>>, 1 + most_wiped_panes> all = [] {
    std::array<std::vector<MemberParameter<WiperKeys>>, 1 + most_wiped_panes> tables;
    for (int k = 0; k <= most_wiped_panes; ++k) tables[static_cast<std::size_t>(k)] = members(k);
    return tables;
  }();
  return all[static_cast<std::size_t>(number)];
}

}  // namespace

std::string wiper_table(int number) { return number == 0 ? "wipers" : fmt::format("pane_{}_wipers", number); }

std::vector<Parameter> wiper_parameters(int number) { return parameters_of(members_of(number)); }

PaneWipers wipers_from(const Config& config, int number, const Glass& glass) {
  WiperKeys keys;
  apply(members_of(number), config, keys);
  WiperSettings& wipers = keys.pane.wipers;
  const std::string table = wiper_table(number);
  const int count = static_cast<int>(config.integer(table + ".count"));
  if (const std::string& arrangement = config.text(table + ".arrangement"); arrangement != "custom")
    wipers.blades = arranged_blades(arrangement, count, glass);
  else
    wipers.blades.assign(keys.custom.begin(), keys.custom.begin() + count);
  check(wipers, glass, table);
  if (const std::string& keyed = config.text(table + ".key_frames"); !keyed.empty())
    wipers.keyed.emplace(keyed, wipers.cycles_per_minute, keys.fast_cycles_per_minute, table);
  else if (const std::string fast = table + ".fast_cycles_per_minute"; config.given(fast))
    refuse(config.entry(fast).origin, fast,
           fmt::format("expected none beside wipers that no {}.key_frames drive, found {:g}", table, keys.fast_cycles_per_minute));
  return keys.pane;
}

void refuse_wipers(const Config& config, int number, const std::string& why) {
  for (const MemberParameter<WiperKeys>& m : members_of(number)) {
    const std::string& key = m.parameter.key;
    if (m.parameter.used_by(config.variant()) && config.given(key)) refuse(config.entry(key).origin, key, why);
  }
}

}  // namespace rainref::windshield
