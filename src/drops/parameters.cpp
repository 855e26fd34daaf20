#include <fmt/format.h>

#include "drops/drops.h"
#include "drops/settings.h"
#include "rainref/error.h"

namespace rainref::drops {
namespace {

constexpr const char *published = "as-published", *correct = "corrected";

}  // namespace

std::vector<scene::Parameter> parameters(const std::string& prefix) {
  using namespace rainref::scene;
  const auto key = [&](const char* name) { return prefix + "." + name; };
  return {
      integer(key("capacity"), "1", 1, static_cast<double>(DropArrays::most_slots), 100000,
              "Most drops at a time; an arrival that finds none free is lost."),
      real(key("lifetime"), "s", 0.01, 4096, 6, "Time after which a drop ends.").default_for(correct, 600.0),
      real(key("spawn_rate"), "1/s", 0, 1e6, 400, "New drops in a second, all over the glass.").only(published),
      real(key("mass_min"), "1", 0.01, 100, 0.4, "Mass of the lightest new drop; 1 is an ordinary drop.").only(published),
      real(key("mass_max"), "1", 0.01, 100, 1.6, "Mass of the heaviest new drop.").only(published),
      real(key("inertia_coupling"), "1", 0, 100, 1, "Share of the vehicle's acceleration that a drop feels (inertiaCoupling).")
          .only(published),
      real(key("wind_coupling"), "1/s", 0, 100, 0.33, "Acceleration by a unit of apparent wind (windCoupling).").only(published),
      real(key("drag"), "1/s", 0.01, 1000, 12, "Rate at which the glass slows a drop down (effectiveDrag).").only(published),
      real("rain.rate", "mm/h", 0, 200, 5, "Rain rate; drops follow Marshall and Palmer's size distribution.").only(correct),
      real("rain.smallest_drop", "mm", 0.1, 5, 0.5, "Drops below this diameter are left out.").only(correct),
      real(key("advancing_angle"), "deg", 1, 150, 50, "Contact angle of water that advances over the glass.").only(correct),
      real(key("receding_angle"), "deg", 1, 150, 20, "Contact angle of water that recedes; the difference holds a drop.").only(correct),
      real(key("wind_exposure"), "1", 0, 2, 0.4, "Wind at the height of a drop over the apparent wind: the boundary layer.").only(correct),
      real(key("wind_drag"), "1", 0, 10, 1, "Drag coefficient of a drop's front.").only(correct),
      real(key("mobility"), "1", 1e-4, 1, 0.01, "Capillary number over Bond number beyond the hold: how fast drops slide.").only(correct),
      real(key("humidity"), "1", 0, 1, 0.95, "Relative humidity of the air at the glass.").only(correct),
      real(key("margin"), "1", 0, 1, 0.02, "How far outside the glass, in u and v, a drop still lives.").only(correct),
      real(key("trail_thickness"), "m", 0, 1e-4, 2e-6, "Film that a sliding drop leaves behind, as wide as its base.").only(correct),
      real(key("film_drying"), "m/s", 0, 1e-4, 1e-7, "Thickness that the film loses to the air.").only(correct),
  };
}

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
  std::erase_if(all, [&](const scene::Parameter& p) { return p.key == prefix + ".wind_exposure" || p.key == prefix + ".wind_drag"; });
  return all;
}

namespace {

Settings read(const scene::Config& config, const std::string& prefix, bool still) {
  const auto key = [&](const char* name) { return prefix + "." + name; };
  const auto real = [&](const char* name) { return config.real(key(name)); };
  Settings s;
  s.corrected = config.variant() == "corrected";
  s.seed = static_cast<std::uint64_t>(config.integer("seed"));
  s.capacity = config.integer(key("capacity"));
  s.lifetime = real("lifetime");
  if (s.corrected) {
    s.rain_rate = config.real("rain.rate");
    s.smallest_drop = config.real("rain.smallest_drop");
    s.advancing_deg = real("advancing_angle");
    s.receding_deg = real("receding_angle");
    s.wind_exposure = still ? 0 : real("wind_exposure");
    s.wind_drag = still ? 0 : real("wind_drag");
    s.mobility = real("mobility");
    s.humidity = real("humidity");
    s.margin = real("margin");
    s.trail_thickness = real("trail_thickness");
    s.film_drying = real("film_drying");
    if (s.receding_deg > s.advancing_deg) {
      throw Error(ExitCode::usage, fmt::format("{} is {} degrees: expected at most {} = {}", key("receding_angle"), s.receding_deg,
                                               key("advancing_angle"), s.advancing_deg));
    }
  } else {
    s.spawn_rate = real("spawn_rate");
    s.mass_min = real("mass_min");
    s.mass_max = real("mass_max");
    s.inertia_coupling = real("inertia_coupling");
    s.wind_coupling = real("wind_coupling");
    s.drag = real("drag");
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
