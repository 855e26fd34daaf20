#include <fmt/format.h>

#include "drops/drops.h"
#include "drops/settings.h"
#include "rainref/error.h"
#include "scene/member_parameter.h"

namespace rainref::drops {
namespace {

using namespace rainref::scene;

std::vector<MemberParameter<Settings>> members(const std::string& prefix) {
  const auto key = [&](const char* name) { return prefix + "." + name; };
  return {
      integer<&Settings::capacity>(key("capacity"), "1", 1, static_cast<double>(DropArrays::most_slots),
                                   "Maximum number of drops. A new drop is lost if there are already as many."),
      real<&Settings::lifetime>(key("lifetime"), "s", 0.01, 4096, "Time after which a drop disappears.").published(6.0),
      real<&Settings::spawn_rate>(key("spawn_rate"), "1/s", 0, 1e6, "New drops per second on the whole glass.").only(published),
      real<&Settings::mass_min>(key("mass_min"), "1", 0.01, 100, "Mass of the lightest new drop; 1 is an ordinary drop.").only(published),
      real<&Settings::mass_max>(key("mass_max"), "1", 0.01, 100, "Mass of the heaviest new drop.").only(published),
      real<&Settings::inertia_coupling>(key("inertia_coupling"), "1", 0, 100,
                                        "Share of the vehicle's acceleration that a drop feels (inertiaCoupling).")
          .only(published),
      real<&Settings::wind_coupling>(key("wind_coupling"), "1/s", 0, 100, "Acceleration per unit of apparent wind (windCoupling).")
          .only(published),
      real<&Settings::drag>(key("drag"), "1/s", 0.01, 1000, "Rate at which the glass slows a drop down (effectiveDrag).").only(published),
      real<&Settings::rain_rate>("rain.rate", "mm/h", 0, 200, "Rain rate. Drops follow Marshall and Palmer's size distribution.")
          .only(correct),
      real<&Settings::smallest_drop>("rain.smallest_drop", "mm", 0.1, 5, "Drops below this diameter are left out.").only(correct),
      real<&Settings::advancing_deg>(key("advancing_angle"), "deg", 1, 150, "Contact angle of water that advances over the glass.")
          .only(correct),
      real<&Settings::receding_deg>(key("receding_angle"), "deg", 1, 150,
                                    "Contact angle of water that recedes. Its difference from the advancing angle holds a drop.")
          .only(correct),
      real<&Settings::wind_exposure>(key("wind_exposure"), "1", 0, 2,
                                     "Wind at the height of a drop, divided by the apparent wind: the effect of the boundary layer.")
          .only(correct),
      real<&Settings::wind_drag>(key("wind_drag"), "1", 0, 10, "Drag coefficient of a drop's front.").only(correct),
      real<&Settings::mobility>(
          key("mobility"), "1", 1e-4, 1,
          "How fast drops slide: capillary number, divided by the excess of the Bond number over the one that still holds a drop.")
          .only(correct),
      real<&Settings::humidity>(key("humidity"), "1", 0, 1, "Relative humidity of the air at the glass.").only(correct),
      real<&Settings::margin>(key("margin"), "1", 0, 1, "How far outside the glass, in u and v, a drop still lives.").only(correct),
      real<&Settings::trail_thickness>(key("trail_thickness"), "m", 0, 1e-4,
                                       "Thickness of the film that a sliding drop leaves behind, as wide as its base.")
          .only(correct),
      real<&Settings::film_drying>(key("film_drying"), "m/s", 0, 1e-4, "Thickness that the film loses to the air per second.")
          .only(correct),
      real<&Settings::neck_time>(
          key("neck_time"), "s", 0, 3600,
          "Merged drops keep the outline of both, with a neck. Within this time they become round to 1 - 1/e; 0: at once.")
          .only(correct),
  };
}

/// True for parameters that a glass without wind along it lacks.
bool is_of_wind(const Parameter& p, const std::string& prefix) {
  return p.key == prefix + ".wind_exposure" || p.key == prefix + ".wind_drag";
}

}  // namespace

std::vector<scene::Parameter> parameters(const std::string& prefix) { return parameters_of(members(prefix)); }

std::vector<scene::Parameter> corrected_only(std::vector<scene::Parameter> parameters) {
  std::erase_if(parameters, [](const scene::Parameter& p) { return !p.used_by(correct); });
  for (scene::Parameter& p : parameters) {
    p.default_value = scene::Value(p.default_in(correct));
    p.variant_defaults.clear();
    p.variants = {correct};
  }
  return parameters;
}

std::vector<scene::Parameter> still_parameters(const std::string& prefix) {
  std::vector<scene::Parameter> all = corrected_only(parameters(prefix));
  std::erase_if(all, [&](const scene::Parameter& p) { return is_of_wind(p, prefix); });
  return all;
}

namespace {

Settings read(const scene::Config& config, const std::string& prefix, bool still) {
  const auto key = [&](const char* name) { return prefix + "." + name; };
  Settings s;
  s.corrected = config.variant() == correct;
  s.seed = static_cast<std::uint64_t>(config.integer("seed"));
  std::vector<MemberParameter<Settings>> table = members(prefix);
  if (still) {
    std::erase_if(table, [&](const auto& m) { return is_of_wind(m.parameter, prefix); });
    s.wind_exposure = s.wind_drag = 0;
  }
  apply(table, config, s);
  if (s.corrected) {
    if (s.receding_deg > s.advancing_deg) {
      throw Error(ExitCode::usage, fmt::format("{} is {} degrees: expected at most {} = {}", key("receding_angle"), s.receding_deg,
                                               key("advancing_angle"), s.advancing_deg));
    }
  } else {
    if (s.mass_min > s.mass_max) {
      throw Error(ExitCode::usage,
                  fmt::format("{} is {}: expected at most {} = {}", key("mass_min"), s.mass_min, key("mass_max"), s.mass_max));
    }
    const double fps = config.real("run.fps");
    if (!(s.drag < 2 * fps)) {
      throw Error(ExitCode::usage, fmt::format("{} is {}: expected less than {}, twice run.fps; the published step is unstable beyond",
                                               key("drag"), s.drag, 2 * fps));
    }
  }
  return s;
}

}  // namespace

Settings settings_from(const scene::Config& config, const std::string& prefix) { return read(config, prefix, false); }
Settings still_settings_from(const scene::Config& config, const std::string& prefix) { return read(config, prefix, true); }

}  // namespace rainref::drops
