#include "screen_drops/flow.h"

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <span>
#include <vector>

#include "cache/kept_images.h"
#include "math/half.h"
#include "rainref/error.h"
#include "state/file.h"

namespace rainref::screen_drops {
namespace {

drops::SplatSettings splat_of(const FlowSettings& s) {
  drops::SplatSettings splat{true, s.splat, {s.pane[0], 0, s.pane[1]}, 0.5 * (s.drops.advancing_deg + s.drops.receding_deg) * degree};
  splat.keys.half_accumulation = false;
  return splat;
}

}  // namespace

struct Flow::State {
  FlowSettings settings;
  drops::SplatSettings splat;
  const parallel::Executor& executor;
  drops::WetGlass water;
  drops::GlassFrame forces{};
  drops::Exposure exposure;
  Image height;
  int frame = 0;
  std::int64_t steps = 0;

  State(const FlowSettings& s, const parallel::Executor& e)
      : settings(s),
        splat(splat_of(s)),
        executor(e),
        water(s.drops, {s.pane[0], 0, s.pane[1]}, s.pane[0] * s.pane[1], s.fps * s.substeps, s.splat.width, s.splat.height, e),
        exposure{s.pane[0] * s.pane[1], 0, -s.wind},
        height(Format::r16f, s.splat.width, s.splat.height) {
    // The wind stops at the pane, so nothing blows along it.
    forces.gravity[1] = static_cast<float>(-s.gravity / s.pane[1]);
    if (warm_up_steps() == 0) return;
    const int none = 0;
    const auto listed = [&] {  // listed again each time, because lengths change
      state::Items items;
      list(items, none);
      return items;
    };
    warm_up_once(settings, listed, [&] {
      while (steps < warm_up_steps()) step(moment(nullptr, 0, 0));
    });
  }
  pass::Moment moment(Recorder* recorder, int step, double dt) const {
    return {recorder, frame, step, frame / settings.fps, dt, settings.splat.rounding};
  }
  std::int64_t warm_up_steps() const { return static_cast<std::int64_t>(settings.warm_up * settings.fps * settings.substeps + 0.5); }
  void list(state::Items& items, const int& frames) {
    items.begin_names_with("flow.");
    water.list_state(items);
    items.begin_names_with("");
    items.then([this, &frames] {
      frame = frames;
      steps = warm_up_steps() + static_cast<std::int64_t>(frame) * settings.substeps;
      if (frame > 0)
        water.splat(moment(nullptr, 0, 1 / settings.fps), splat, forces, height);
      else
        clear_height();
    });
  }
  /// In place, because Python arrays may view its memory.
  void clear_height() {
    for (int y = 0; y < height.height(); ++y) std::memset(height.row_bytes(y), 0, static_cast<std::size_t>(height.width()) * sizeof(Half));
  }
  void step(const pass::Moment& now) {
    water.spawn(now, exposure, steps);
    water.integrate(now, forces);
    water.merge(now, steps);
    ++steps;
  }
};

Flow::Flow(const FlowSettings& settings, const parallel::Executor& executor) : state_(std::make_unique<State>(settings, executor)) {}
Flow::~Flow() = default;
Flow::Flow(Flow&&) noexcept = default;

void Flow::simulate(Recorder* recorder) {
  State& s = *state_;
  const double fps = s.settings.fps;
  const int substeps = s.settings.substeps;
  for (int substep = 0; substep < substeps; ++substep) s.step(s.moment(recorder, substep, 1 / (fps * substeps)));
  s.water.splat(s.moment(recorder, 0, 1 / fps), s.splat, s.forces, s.height);
  ++s.frame;
}

void Flow::list_state(state::Items& items, const int& frames) { state_->list(items, frames); }

int Flow::frame() const { return state_->frame; }
const Image& Flow::height() const { return state_->height; }
const Image& Flow::film() const { return state_->water.film; }
std::vector<drops::Drop> Flow::drops() const {
  std::vector<drops::Drop> all;
  state_->water.drops.gather(all, state_->executor);
  return all;
}
const drops::MassBalance& Flow::mass_balance() const { return state_->water.mass_balance; }
std::int64_t Flow::residual() const { return state_->water.residual(); }

void Flow::set_drops(std::span<const drops::Drop> records) {
  drops::WetGlass& water = state_->water;
  const std::int64_t before = water.drops.water();
  water.drops.assign(records);
  water.mass_balance.removed += before;
  water.mass_balance.spawned += water.drops.water();
}

namespace {

// Inputs of a warm-up. Before the first frame only the film's size matters of the splat. This does not compile if a member is added to the
// drops' settings but not read here.
struct WarmUp {
  cache::Only<&FlowSettings::fps, &FlowSettings::substeps, &FlowSettings::pane, &FlowSettings::gravity, &FlowSettings::wind,
              &FlowSettings::warm_up>
      flow;
  drops::Settings drops;
  int width, height;
  void add_to(cache::Recipe& recipe) const {
    const auto& [corrected, seed, capacity, lifetime, spawn_rate, mass_min, mass_max, inertia_coupling, wind_coupling, drag, rain_rate,
                 smallest_drop, advancing_deg, receding_deg, wind_exposure, wind_drag, mobility, humidity, margin, trail_thickness,
                 film_drying, neck_time] = drops;
    flow.add_to(recipe);
    recipe.add(seed).add_read(capacity).add_read(corrected).add_read(width).add_read(height);
    recipe.add({lifetime, spawn_rate, mass_min, mass_max, inertia_coupling, wind_coupling, drag, rain_rate, smallest_drop, advancing_deg,
                receding_deg, wind_exposure, wind_drag, mobility, humidity, margin, trail_thickness, film_drying, neck_time});
  }
};

// Bytes as rows of an image: their number, the bytes, and zeros to the end of the last row.
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
  // It runs the flow that was made with these settings.
  const std::function<Image()> run = [&] {
    warm_up();
    is_done = true;
    return as_image(written(list()));
  };
  const Image kept = cache::kept(
      "screen_drops warm-up", cache::Shape{Format::r8, bytes_in_row, 0}, rows_here, run,
      +[](const std::function<Image()>& by, const WarmUp&) { return by(); },
      WarmUp{settings, settings.drops, settings.splat.width, settings.splat.height});
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
