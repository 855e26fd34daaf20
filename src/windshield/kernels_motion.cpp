// Shells of windshield_frame and wipe_drops; compiled once for each SIMD target.
#include "windshield/kernels_motion.h"

#include <algorithm>

#define RAINREF_KERNELS "windshield/kernels_motion.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(windshield)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#include "windshield/windshield_frame.pass.h"
#include "windshield/wipe_drops.pass.h"
#undef RAINREF_FN

constexpr std::size_t lane_room = HWY_MAX_BYTES / sizeof(float);

void WindshieldFrame(const WindshieldFrameUniforms& uniforms, bool corrected, drops::GlassFrame& out) {
  const GlassForces<Lanes> forces =
      corrected ? windshield_frame_corrected<Lanes>(uniforms) : windshield_frame_as_published<Lanes>(uniforms);
  const auto put = [](const Lanes* from, float* to, int count) HWY_ATTR {
    for (int k = 0; k < count; ++k) store(to + k, from[k], Rounding::rne, 1);
  };
  put(forces.gravity, out.gravity, 2);
  put(forces.wind, out.wind, 2);
  put(forces.acceleration, out.acceleration, 2);
  put(forces.spin, out.spin, 4);
  put(forces.coriolis, out.coriolis, 4);
}

// The first `count` values from p; the rest are 0.
HWY_INLINE HWY_ATTR Lanes load_some(const float* p, int count) {
  if (HWY_LIKELY(count == Lanes::size())) return Lanes::load(p);
  HWY_ALIGN float block[lane_room] = {};
  std::copy_n(p, count, block);
  return Lanes::load(block);
}

void WipeDropsRange(const WipeDropsUniforms& uniforms, bool corrected, const Wiper* wipers, const DropSpans& drops, float* wiper,
                    float* bin, std::int64_t begin, std::int64_t end) {
  const int n = Lanes::size();
  for (std::int64_t first = begin; first < end; first += n) {
    const int count = static_cast<int>(std::min<std::int64_t>(n, end - first));
    const auto at = [&](std::span<float> values) { return values.data() + first; };
    WipedDrop<Lanes> drop;
    drop.u = load_some(at(drops.u), count);
    drop.v = load_some(at(drops.v), count);
    drop.velocity_u = load_some(at(drops.velocity_u), count);
    drop.velocity_v = load_some(at(drops.velocity_v), count);
    drop.mass = load_some(at(drops.mass), count);
    drop.life = load_some(at(drops.life), count);
    drop.wiper = drop.bin = Lanes(0.0f);
    drop = corrected ? wipe_drop_corrected<Lanes>(uniforms, wipers, drop) : wipe_drop_as_published<Lanes>(uniforms, wipers, drop);
    store(at(drops.u), drop.u, Rounding::rne, count);
    store(at(drops.v), drop.v, Rounding::rne, count);
    store(at(drops.velocity_u), drop.velocity_u, Rounding::rne, count);
    store(at(drops.velocity_v), drop.velocity_v, Rounding::rne, count);
    store(at(drops.mass), drop.mass, Rounding::rne, count);
    store(at(drops.life), drop.life, Rounding::rne, count);
    if (!corrected) continue;
    store(wiper + first, drop.wiper, Rounding::rne, count);
    store(bin + first, drop.bin, Rounding::rne, count);
  }
}

void WipeFilmRows(const WipeDropsUniforms& uniforms, const Wiper* wipers, const TexelBox* boxes, Image& film, const parallel::Tile& tile,
                  std::uint64_t* mass_units) {
  const int n = Lanes::size();
  HWY_ALIGN float held[lane_room], swept_by[lane_room], swept_in[lane_room];
  for (int y = tile.y0; y < tile.y1; ++y) {
    int x0 = film.width(), x1 = 0;
    for (int i = 0; i < uniforms.wiper_count; ++i) {
      if (y < boxes[i].y0 || y >= boxes[i].y1) continue;
      x0 = std::min(x0, boxes[i].x0);
      x1 = std::max(x1, boxes[i].x1);
    }
    float* row = film.row<float>(y);
    for (int x = x0; x < x1; x += n) {
      const int count = std::min(n, x1 - x);
      const SweptTexel<Lanes> swept = swept_texel<Lanes>(uniforms, wipers, x, y);
      const auto is_swept = swept.wiper >= Lanes(0.0f);
      if (!any(is_swept)) continue;
      const Lanes here = Lanes::load(row + x);
      hn::Store(here.v, Lanes::D(), held);
      hn::Store(swept.wiper.v, Lanes::D(), swept_by);
      hn::Store(swept.bin.v, Lanes::D(), swept_in);
      for (int k = 0; k < count; ++k) {
        if (swept_by[k] < 0 || held[k] <= 0) continue;
        const int bin = static_cast<int>(swept_by[k]) * uniforms.bin_count + static_cast<int>(swept_in[k]);
        mass_units[bin] += static_cast<std::uint64_t>(held[k]);
      }
      store(row + x, select(is_swept, Lanes(0.0f), here), Rounding::rne, count);
    }
  }
}
RAINREF_TARGET_END(windshield)

#if RAINREF_ONCE
namespace rainref::windshield {

RAINREF_EXPORT(WindshieldFrame);
RAINREF_EXPORT(WipeDropsRange);
RAINREF_EXPORT(WipeFilmRows);

drops::GlassFrame windshield_frame(const WindshieldFrameUniforms& uniforms, bool corrected) {
  drops::GlassFrame out{};
  RAINREF_DISPATCH(WindshieldFrame)(uniforms, corrected, out);
  return out;
}
void wipe_drops_range(const WipeDropsUniforms& uniforms, bool corrected, const Wiper* wipers, const DropSpans& drops, float* wiper,
                      float* bin, std::int64_t begin, std::int64_t end) {
  RAINREF_DISPATCH(WipeDropsRange)(uniforms, corrected, wipers, drops, wiper, bin, begin, end);
}
void wipe_film_rows(const WipeDropsUniforms& uniforms, const Wiper* wipers, const TexelBox* boxes, Image& film, const parallel::Tile& tile,
                    std::uint64_t* mass_units) {
  RAINREF_DISPATCH(WipeFilmRows)(uniforms, wipers, boxes, film, tile, mass_units);
}

}  // namespace rainref::windshield
#endif
