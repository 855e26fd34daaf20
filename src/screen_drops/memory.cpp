
#include <algorithm>
#include <cmath>

#include "base/floating_point.h"
#include "drops/host.h"
#include "image/memory.h"
#include "screen_drops/cells.h"
#include "screen_drops/flow.h"
#include "screen_drops/host.h"

namespace rainref::screen_drops {

MemoryPeak memory(const Settings& s, const FlowSettings* flow, double seconds) {
  const auto image = [&](Format f) { return Image::memory_bytes(f, s.width, s.height); };
  MemoryPeak m;
  // scene_levels: floats with mips, then halves; and the texture made from these.
  MemoryPeak floats;
  floats.hold(texel_bytes(s.width, s.height, 4));
  hold_mips(floats, s.width, s.height, 4);
  const std::uint64_t halves = floats.held() / 2;
  m.pass(floats.peak());
  m.pass(floats.held() + halves);
  m.hold(2 * halves);
  if (s.variant == Variant::corrected) {
    const std::array<int, 2> size = cells_size(make_layers(s));
    m.hold(Image::memory_bytes(Format::rgba32f, size[0], size[1]) +
           static_cast<std::uint64_t>(size[0]) * static_cast<std::uint64_t>(size[1]) * sizeof(DrawnCell));
    if (flow != nullptr) {
      const double arrivals = drops::flux(flow->drops, 0, -flow->wind).drops * flow->pane[0] * flow->pane[1] * seconds;
      const auto live = static_cast<std::int64_t>(std::min(std::ceil(arrivals), static_cast<double>(flow->drops.capacity)));
      m.then(drops::memory(flow->drops, flow->splat.width, flow->splat.height, live, flow->splat.lean > 0));
      m.hold(Image::memory_bytes(Format::r16f, flow->splat.width, flow->splat.height));
    }
  } else {
    m.hold(Image::memory_bytes(Format::rgba8, s.noise_size, s.noise_size) + texel_bytes(s.noise_size, s.noise_size, 4));
  }
  m.hold(2 * image(Format::rgba16f) + image(Format::r8) + image(Format::rgba8));  // background, colour, water, picture
  return m;
}

std::uint64_t memory_bytes(const Settings& settings) {
  const FloatingPointGuard guard;
  return memory(settings).peak();
}

}  // namespace rainref::screen_drops
