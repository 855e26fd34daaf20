// Shells of windshield_frame and wipe_drops; compiled once for each SIMD target.
#include "windshield/motion/kernels.h"

#include <algorithm>

#include "pass/stored_record.h"

#define RAINREF_KERNELS "windshield/motion/kernels.cpp"
#include "math/foreach_target.h"
#include "math/lane_pair-inl.h"
#include "math/lanes-inl.h"
#include "pass/records-inl.h"

RAINREF_TARGET_BEGIN(windshield)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#include "math/cube_root_lanes-inl.h"
#include "drops/drop-inl.h"
#include "windshield/motion/windshield_frame.pass.h"
#include "windshield/motion/wipe_drops.pass.h"
#undef RAINREF_FN

constexpr std::size_t lane_room = HWY_MAX_BYTES / sizeof(float);

void WindshieldFrame(const WindshieldFrameUniforms& uniforms, bool corrected, const std::vector<float*>& columns) {
  const pass::HostIo<WindshieldFramePass> io;
  if (corrected)
    give_record<WindshieldFramePass, WindshieldFramePassText, true>(uniforms, io, columns);
  else
    give_record<WindshieldFramePass, WindshieldFramePassText, false>(uniforms, io, columns);
}

void WipeDropsRange(const WipeDropsUniforms& uniforms, bool corrected, const pass::HostIo<WipeDropsPass>& io, float* wiper, float* bin,
                    std::int64_t begin, std::int64_t end) {
  const std::vector<float*>& columns = io.drops.columns;
  if (corrected) {
    change_records<WipeDropsPass, WipeDropsPassText, true>(
        uniforms, io, columns, begin, end, [&](std::int64_t first, int count, const DropState<Lanes>&, const WipedDrop<Lanes>& d) HWY_ATTR {
          store(wiper + (first - begin), d.wiper, Rounding::rne, count);
          store(bin + (first - begin), d.bin, Rounding::rne, count);
        });
  } else {
    change_records<WipeDropsPass, WipeDropsPassText, false>(uniforms, io, columns, begin, end,
                                                            [](std::int64_t, int, const auto&, const auto&) {});
  }
}

void WipeFilmRow(const WipeDropsUniforms& uniforms, const Wiper* wipers, Image& film, int y, int x0, int x1, std::uint64_t* mass_units) {
  const int n = Lanes::size();
  HWY_ALIGN float held[lane_room], swept_by[lane_room], swept_in[lane_room];
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
RAINREF_TARGET_END(windshield)

#if RAINREF_ONCE
namespace rainref::windshield {

RAINREF_EXPORT(WindshieldFrame);
RAINREF_EXPORT(WipeDropsRange);
RAINREF_EXPORT(WipeFilmRow);

drops::GlassFrame windshield_frame(const WindshieldFrameUniforms& uniforms, bool corrected) {
  drops::GlassFrame out{};
  RAINREF_DISPATCH(WindshieldFrame)(uniforms, corrected, pass::columns_of(out));
  return out;
}
void wipe_drops_range(const WipeDropsUniforms& uniforms, bool corrected, const pass::HostIo<WipeDropsPass>& io, float* wiper, float* bin,
                      std::int64_t begin, std::int64_t end) {
  RAINREF_DISPATCH(WipeDropsRange)(uniforms, corrected, io, wiper, bin, begin, end);
}
void wipe_film_row(const WipeDropsUniforms& uniforms, const Wiper* wipers, Image& film, int y, int x0, int x1, std::uint64_t* mass_units) {
  RAINREF_DISPATCH(WipeFilmRow)(uniforms, wipers, film, y, x0, x1, mass_units);
}

}  // namespace rainref::windshield
#endif
