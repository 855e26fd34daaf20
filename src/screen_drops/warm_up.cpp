#include "screen_drops/flow.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "cache/kept_images.h"
#include "rainref/error.h"
#include "state/file.h"

namespace rainref::screen_drops {
namespace {

// A member that is added to one of these structs does not compile here before it is in the recipe.
cache::Recipe recipe_of(const FlowSettings& settings) {
  const auto& [fps, substeps, pane, gravity, wind, warm_up, drops, splat] = settings;
  const auto& [corrected, seed, capacity, lifetime, spawn_rate, mass_min, mass_max, inertia_coupling, wind_coupling, drag, rain_rate,
               smallest_drop, advancing_deg, receding_deg, wind_exposure, wind_drag, mobility, humidity, margin, trail_thickness,
               film_drying, neck_time] = drops;
  cache::Recipe recipe("screen_drops warm-up");
  recipe.add(seed).add(static_cast<std::uint64_t>(capacity)).add(static_cast<std::uint64_t>(substeps)).add(std::uint64_t{corrected});
  recipe.add({fps,           pane[0],         pane[1],      gravity,          wind,          warm_up,  lifetime,
              spawn_rate,    mass_min,        mass_max,     inertia_coupling, wind_coupling, drag,     rain_rate,
              smallest_drop, advancing_deg,   receding_deg, wind_exposure,    wind_drag,     mobility, humidity,
              margin,        trail_thickness, film_drying,  neck_time});
  // Of the splat nothing counts before the first frame but the size of the film.
  return recipe.add(static_cast<std::uint64_t>(splat.width)).add(static_cast<std::uint64_t>(splat.height));
}

// Bytes as rows of an image: their count, they, and zeros to the end of the last row.
constexpr int bytes_in_row = 4096;
using Count = std::uint64_t;
Image as_image(std::span<const std::byte> bytes) {
  Image image(Format::r8, bytes_in_row, static_cast<int>((bytes.size() + bytes_in_row - 1) / bytes_in_row));
  for (int y = 0; y < image.height(); ++y) {
    const std::span<const std::byte> row = bytes.subspan(static_cast<std::size_t>(y) * bytes_in_row);
    std::memcpy(image.row_bytes(y), row.data(), std::min<std::size_t>(row.size(), bytes_in_row));
  }
  return image;
}

std::vector<std::byte> written(const state::Items& items) {
  std::vector<std::byte> bytes(sizeof(Count));
  state::write({}, items, [&](std::span<const std::byte> part) { bytes.insert(bytes.end(), part.begin(), part.end()); });
  const Count count = bytes.size() - sizeof(Count);
  std::memcpy(bytes.data(), &count, sizeof count);
  return bytes;
}

}  // namespace

void warm_up_once(const FlowSettings& settings, const std::function<state::Items()>& list, const std::function<void()>& warm_up) {
  bool is_done = false;
  const Image kept = cache::image(recipe_of(settings), {Format::r8, bytes_in_row, 0}, [&] {
    warm_up();
    is_done = true;
    return as_image(written(list()));
  });
  if (is_done) return;
  std::vector<std::byte> bytes;
  for (int y = 0; y < kept.height(); ++y) bytes.insert(bytes.end(), kept.row_bytes(y), kept.row_bytes(y) + kept.width());
  Count count;
  std::memcpy(&count, bytes.data(), sizeof count);
  const std::span<const std::byte> all = std::span(bytes).subspan(sizeof count);
  try {
    const state::Saved saved(all.first(static_cast<std::size_t>(std::min<Count>(count, all.size()))), "the cache");
    const state::Items items = list();
    state::require_fit(saved, items);
    state::load(saved, items);
  } catch (const Error&) {  // nothing has changed
    warm_up();
  }
}

}  // namespace rainref::screen_drops
