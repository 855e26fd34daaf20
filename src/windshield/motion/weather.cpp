#include "windshield/motion/weather.h"

#include <utility>

#include <fmt/format.h>

#include "base/number_text.h"
#include "rainref/error.h"
#include "scene/rows_of_text.h"

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

std::vector<Pchip> parse_curves(std::string_view text, const std::string& key, std::span<const KeyedQuantity> quantities) {
  std::string form = "time";
  for (const KeyedQuantity& q : quantities) form += fmt::format(" {}", q.name);
  int row = 0;
  const auto fail = [&](const std::string& what) { throw Error(ExitCode::usage, fmt::format("{}, key frame {}: {}", key, row, what)); };
  std::vector<std::vector<double>> columns(quantities.size() + 1);
  for (const std::string_view frame : scene::split(text, ';')) {
    if (frame.empty()) continue;  // a semicolon at the end
    ++row;
    const std::vector<std::string_view> fields = scene::words_of(frame);
    if (fields.size() != columns.size()) fail(fmt::format("expected \"{}\", found '{}'", form, frame));
    for (std::size_t k = 0; k < columns.size(); ++k) {
      const std::optional<double> value = number_from<double>(fields[k]);
      const char* name = k == 0 ? "time" : quantities[k - 1].name;
      if (!value) fail(fmt::format("{}: expected a number, found '{}'", name, fields[k]));
      if (k == 0 && !columns[0].empty() && !(*value > columns[0].back()))
        fail(fmt::format("time: expected more than {:g} of the row before, found {:g}", columns[0].back(), *value));
      if (k > 0) {
        const KeyedQuantity& q = quantities[k - 1];
        if (!(q.least <= *value && *value <= q.most))
          fail(fmt::format("{}: expected {:g} to {:g} {}, found {:g}", name, q.least, q.most, q.unit, *value));
      }
      columns[k].push_back(*value);
    }
  }
  if (row < 2) fail(fmt::format("expected at least two rows, found {}", row));
  std::vector<Pchip> curves;
  for (std::size_t k = 1; k < columns.size(); ++k) curves.emplace_back(columns[0], std::move(columns[k]));
  return curves;
}

}  // namespace rainref::windshield
