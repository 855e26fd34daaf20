#include "scene/key_groups.h"

#include <algorithm>
#include <array>

namespace rainref::scene {

std::string table_of(std::string_view key) {
  const std::size_t dot = key.rfind('.');
  return std::string(key.substr(0, dot == std::string_view::npos ? 0 : dot));
}

std::span<const std::string_view> basic_keys() {
  static constexpr std::array<std::string_view, 56> keys{
      "effect", "variant", "seed", "run.frames", "run.fps", "run.size",
      // Where one stands and how the picture is shown.
      "camera.position", "camera.target", "camera.vertical_fov_deg", "display.exposure", "compositor.picture",
      // What lies behind the water.
      "scene.image", "scene.depth_image", "scene.panorama", "scene.source", "scene.blades", "scene.defocus", "environment.image",
      "background.defocus",
      // The weather.
      "rain.rate", "rain.amount", "world.wind", "vehicle.speed", "falling_rain.on",
      // The water.
      "puddle.drop_intensity", "puddle.damping", "puddle.reflectivity", "puddle.fog_depth", "puddle.water_turbidity", "puddle.puddle_depth",
      "puddle.tint", "puddle.ground_image", "wipers.count", "wipers.cycles_per_minute", "smear.on", "condensation.on", "interior.on",
      "composite.blur_lod", "blur.fog_density", "glass.shape", "glass.distance", "glass.height", "rain.drop_period", "rain.rivulet_speed",
      "rain.rivulet_amount", "maps.droplets", "maps.trails", "drops.largest_radius", "drops.share", "flow.on", "edge_splash.drop_color",
      "edge_splash.drop_alpha", "edge_splash.rain_drop_scale", "edge_splash.band", "edge_splash.noise_size", "edge_splash.drop_velocity"};
  return keys;
}
bool is_basic(std::string_view key) { return std::find(basic_keys().begin(), basic_keys().end(), key) != basic_keys().end(); }

std::string repeated_table(std::string_view table) {
  const std::size_t digit = table.find_first_of("0123456789");
  if (digit == 0 || digit == std::string_view::npos || table[digit - 1] != '_') return "";
  const std::size_t end = table.find_first_not_of("0123456789", digit);
  return end == std::string_view::npos || table[end] != '_' ? "" : std::string(table.substr(end + 1));
}

}  // namespace rainref::scene
