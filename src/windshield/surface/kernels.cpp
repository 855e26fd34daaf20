// persist, wipe_texture, condense, normals and falling_rain in lanes; compiled once for each SIMD target.
#include <algorithm>
#include <vector>

#include "pass/run.h"
#include "windshield/picture/falling_rain.pass.h"
#include "windshield/surface/condense.pass.h"
#include "windshield/surface/normals.pass.h"
#include "windshield/surface/persist.pass.h"
#include "windshield/surface/wipe_texture.pass.h"
#include "windshield/surface/wiper_reach.h"

#define RAINREF_KERNELS "windshield/surface/kernels.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"
#include "pass/rows-inl.h"

RAINREF_TARGET_BEGIN(windshield)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "windshield/surface/normals.pass.h"
#include "windshield/surface/persist.pass.h"
#include "windshield/surface/wipe_texture.pass.h"
#include "windshield/surface/condense.pass.h"
#include "windshield/picture/falling_rain.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

// Area that a wiper may cover, in the plane [m]; outside, its coverage is exactly 0.
Reach reach_of(const WipeTextureUniforms& u, bool corrected, const Wiper& w) {
  if (corrected) return sector_reach(w, u.edge_width);
  Reach r;
  for (const float* end : {w.inner, w.outer}) r.hold(end[0] * u.axis_length[0], end[1] * u.axis_length[1]);
  return r.wider(w.half_width + u.edge_width + 1e-3f);
}

template <bool corrected>
HWY_ATTR void wiped_rows(const WipeTextureUniforms& uniforms, Rounding rounding, const pass::HostIo<WipeTexturePass>& host,
                         const parallel::Tile& tile) {
  WipeTextureUniforms u = uniforms;
  const int n = Lanes::size();
  const std::span<const Wiper> all = host.wipers.records;
  std::vector<Reach> reaches;
  for (int i = 0; i < uniforms.wiper_count; ++i) reaches.push_back(reach_of(u, corrected, all[static_cast<std::size_t>(i)]));
  std::vector<Wiper> near(reaches.size());
  std::vector<std::size_t> of_row;
  for (int y = tile.y0; y < tile.y1; ++y) {
    WipeTexturePass::Io<LaneCursors> io;
    pass::begin_row<WipeTexturePass>(host, io, y, rounding);
    io.wipers.records = near;
    const float row = static_cast<float>(y) + 0.5f, py = u.frame[2] * row;
    of_row.clear();
    for (std::size_t i = 0; i < reaches.size(); ++i)
      if (reaches[i].y0 <= py && py <= reaches[i].y1) of_row.push_back(i);
    for (int x = tile.x0; x < tile.x1; x += n) {
      const float px0 = u.frame[0] * static_cast<float>(x) + u.frame[1] * row, px1 = px0 + u.frame[0] * static_cast<float>(n);
      u.wiper_count = 0;
      for (const std::size_t i : of_row) {
        const Reach& r = reaches[i];
        if (r.x0 <= px1 && px0 <= r.x1) near[static_cast<std::size_t>(u.wiper_count++)] = all[i];
      }
      pass::move_to<WipeTexturePass>(io, x, std::min(n, tile.x1 - x));
      WipeTexturePassText::run<Lanes, corrected>(u, io, x, y);
    }
  }
}
void WipeTexturePassRows(const WipeTextureUniforms& u, bool corrected, Rounding rounding, const pass::HostIo<WipeTexturePass>& io,
                         const parallel::Tile& tile) {
  corrected ? wiped_rows<true>(u, rounding, io, tile) : wiped_rows<false>(u, rounding, io, tile);
}
RAINREF_PASS_ROWS(NormalsPass)
RAINREF_PASS_ROWS(PersistPass)
RAINREF_PASS_ROWS(CondensePass)
RAINREF_PASS_ROWS(FallingRainPass)
RAINREF_TARGET_END(windshield)

#if RAINREF_ONCE
RAINREF_PASS_DISPATCH(windshield, WipeTexturePass)
RAINREF_PASS_DISPATCH(windshield, NormalsPass)
RAINREF_PASS_DISPATCH(windshield, PersistPass)
RAINREF_PASS_DISPATCH(windshield, CondensePass)
RAINREF_PASS_DISPATCH(windshield, FallingRainPass)
#endif
