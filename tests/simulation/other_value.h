// Another value for each key of a scene.
#pragma once

#include <array>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include <fmt/format.h>

#include "scene/config.h"
#include "scene/value_text.h"
#include "simulation/small_scenes.h"

namespace rainref {

/// A picture for a key, unlike that of any other key and name: of the small scenes' size, an environment one that may be six faces; with an
/// alpha for maps, grey for quantities.
inline std::string picture_of(const std::string& key, const std::string& name = "") {
  static const TemporaryFolder folder;
  const bool is_faces = key == "environment.image";
  const int width = is_faces ? 6 : 33, height = is_faces ? 1 : 21;
  const bool is_grey =
      key.ends_with("depth_image") || key.ends_with("layer_image") || key.ends_with(".noise_image") || key.ends_with("shelter_image");
  const int channels = is_grey ? 1 : key.starts_with("maps.") ? 4 : 3;
  const auto file = folder / (key + name + ".npy");
  std::uint32_t word = 1;
  for (const char c : key + name) word = word * 31 + static_cast<unsigned char>(c);
  std::string codes;
  for (int i = 0; i < width * height * channels; ++i) {
    word = word * 1664525 + 1013904223;
    codes += static_cast<char>(20 + (word >> 24) % 200);
  }
  const std::string shape = channels == 1 ? fmt::format("({}, {})", height, width) : fmt::format("({}, {}, {})", height, width, channels);
  put(file, npy("'|u1'", shape, codes));
  return file.string();
}

/// A value near this one that the parameter accepts.
template <class Number>
Number other_number(const scene::Parameter& p, Number now) {
  const auto is_allowed = [&](double x) { return x != static_cast<double>(now) && x >= p.minimum && x <= p.maximum; };
  const double x = static_cast<double>(now);
  const std::initializer_list<double> whole{x + 1, x - 1}, real{1.1 * x, 0.9 * x, x + 0.1, x - 0.1, 0.5 * (p.minimum + p.maximum)};
  for (const double other : std::is_integral_v<Number> ? whole : real)
    if (is_allowed(other)) return static_cast<Number>(other);
  return now;
}

/// Another value of a scene's key, as TOML; none where there is no other.
inline std::optional<std::string> other_value(const scene::Config::Entry& e) {
  static const std::map<std::string, std::string> texts{{"puddle.objects", "0.1 0.01: 0 -0.3 0, 2 0.3 0.1"},
                                                        {"vehicle.key_frames", "0 12 0.1; 1 9 0.4"},
                                                        {"rain.key_frames", "0 30; 1 150"},
                                                        {"wipers.key_frames", "0 slow; 0.3 fast; 0.9 off"},
                                                        {"world.wind_key_frames", "0 0 0 0; 1 3 -6 0"}};
  const scene::Parameter& p = e.parameter;
  scene::Value other = e.value;
  if (auto* flag = std::get_if<bool>(&other)) {
    *flag = !*flag;
  } else if (auto* whole = std::get_if<std::int64_t>(&other)) {
    *whole = other_number(p, *whole);
    for (const std::string& choice : p.choices)
      if (choice != std::to_string(std::get<std::int64_t>(e.value))) *whole = std::stoll(choice);
  } else if (auto* text = std::get_if<std::string>(&other)) {
    for (const std::string& choice : p.choices) {
      if (choice == std::get<std::string>(e.value)) continue;
      *text = choice;
      break;
    }
    if (const auto found = texts.find(p.key); found != texts.end()) *text = found->second;
    if (p.key == "rain.shelter") *text = "0.1 0 1 1";
    if (p.key.ends_with("image") || p.key.ends_with("panorama")) *text = picture_of(p.key);
  } else if (auto* number = std::get_if<double>(&other)) {
    *number = other_number(p, *number);
  } else {
    std::visit(
        [&](auto& many) {
          if constexpr (requires { std::tuple_size<std::remove_reference_t<decltype(many)>>::value; })
            for (auto& x : many) x = other_number(p, x);
        },
        other);
  }
  if (other == e.value || !scene::accepts(p, other)) return {};
  return scene::value_text(other);
}

}  // namespace rainref
