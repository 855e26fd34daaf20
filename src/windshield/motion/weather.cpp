#include "windshield/motion/weather.h"

#include "windshield/motion/key_frames.h"

namespace rainref::windshield {

Weather::Weather(const WeatherSettings& settings) : settings_(settings) {
  if (!settings.wind_key_frames.empty()) {
    const KeyedQuantity components[] = {{"x", "m/s", -100, 100}, {"y", "m/s", -100, 100}, {"z", "m/s", -100, 100}};
    wind_ = parse_curves(settings.wind_key_frames, "world.wind_key_frames", components);
  }
  if (!settings.rain_key_frames.empty()) {
    const KeyedQuantity rate[] = {{"rate", settings.rain_unit, 0, settings.most_rain}};
    rain_ = parse_curves(settings.rain_key_frames, "rain.key_frames", rate);
  }
}

Real3 Weather::wind(double t) const {
  if (wind_.empty()) return settings_.wind;
  return {wind_[0].value(t), wind_[1].value(t), wind_[2].value(t)};
}

}  // namespace rainref::windshield
