// Shells of wipe_texture and normals; compiled once for each SIMD target.
#include <algorithm>
#include <vector>

#include "windshield/surface.h"

#define RAINREF_KERNELS "windshield/kernels_surface.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(windshield)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#include "windshield/normals.pass.h"
#include "windshield/wipe_texture.pass.h"
#undef RAINREF_FN

// What a wiper may cover, in the plane [m]; outside, its coverage is exactly 0.
struct Reach {
  float x0, y0, x1, y1;
};
Reach reach_of(const WipeTextureUniforms& u, bool corrected, const Wiper& w) {
  Reach r{1e30f, 1e30f, -1e30f, -1e30f};
  const auto hold = [&](float x, float y) { r = {std::min(r.x0, x), std::min(r.y0, y), std::max(r.x1, x), std::max(r.y1, y)}; };
  float more = w.half_width + u.edge_width + 1e-3f;
  if (corrected) {
    for (const float* axis : {w.previous_axis, w.axis}) {
      for (const float radius : {w.inner_radius, w.outer_radius}) hold(w.pivot[0] + radius * axis[0], w.pivot[1] + radius * axis[1]);
    }
    // The arc's sagitta, 1 - cos(turn / 2) of the radius, is at most (1 - cos(turn)) / 2 of it.
    more += w.outer_radius * 0.5f * (1.001f - (w.previous_axis[0] * w.axis[0] + w.previous_axis[1] * w.axis[1]));
  } else {
    for (const float* end : {w.inner, w.outer}) hold(end[0] * u.axis_length[0], end[1] * u.axis_length[1]);
  }
  return {r.x0 - more, r.y0 - more, r.x1 + more, r.y1 + more};
}

void WipeTextureRows(const WipeTextureUniforms& uniforms, bool corrected, Rounding rounding, const Wiper* all, const WipedTextures& textures,
                     const parallel::Tile& tile) {
  WipeTextureUniforms u = uniforms;
  const int n = Lanes::size();
  std::vector<Reach> reaches;
  for (int i = 0; i < uniforms.wiper_count; ++i) reaches.push_back(reach_of(u, corrected, all[i]));
  std::vector<Wiper> near(reaches.size());
  const Wiper* wipers = near.data();
  for (int y = tile.y0; y < tile.y1; ++y) {
    Half *height = textures.height->row<Half>(y), *mask = textures.mask->row<Half>(y);
    float* wiped = corrected ? textures.wiped->row<float>(y) : nullptr;
    for (int x = tile.x0; x < tile.x1; x += n) {
      const int count = std::min(n, tile.x1 - x);
      const float row = static_cast<float>(y) + 0.5f, py = u.frame[2] * row;
      const float px0 = u.frame[0] * static_cast<float>(x) + u.frame[1] * row, px1 = px0 + u.frame[0] * static_cast<float>(n);
      u.wiper_count = 0;
      for (std::size_t i = 0; i < reaches.size(); ++i) {
        const Reach& r = reaches[i];
        if (r.x0 <= px1 && px0 <= r.x1 && r.y0 <= py && py <= r.y1) near[static_cast<std::size_t>(u.wiper_count++)] = all[i];
      }
      if (corrected) {
        const Lanes coverage = wipe_coverage_corrected<Lanes>(u, wipers, x, y);
        const Lanes since = time_since_wipe(u, Lanes::load(wiped + x), coverage);
        store(height + x, wiped_height_corrected(Lanes::load(height + x), coverage), rounding, count);
        store(wiped + x, since, rounding, count);
        store(mask + x, wiped_mask_corrected(u, since), rounding, count);
      } else {
        const Lanes coverage = wipe_coverage_as_published<Lanes>(u, wipers, x, y);
        store(height + x, wiped_height_as_published(u, Lanes::load(height + x), coverage), rounding, count);
        store(mask + x, wiped_mask_as_published(u, Lanes::load(mask + x), coverage), rounding, count);
      }
    }
  }
}

// Columns [x - 1, x + n] of a row, the nearest texel standing where there is none.
HWY_INLINE const Half* with_ends(const Half* row, int x, int width, Half* copy) {
  for (int k = -1; k <= Lanes::size(); ++k) copy[k + 1] = row[std::clamp(x + k, 0, width - 1)];
  return copy + 1 - x;
}
template <bool corrected>
void normals_of(const NormalsUniforms& u, Rounding rounding, const Image& height, const Image& mask, Image& normal, const parallel::Tile& tile) {
  const int n = Lanes::size(), width = height.width();
  Half ends[6][HWY_MAX_BYTES / sizeof(float) + 2];
  for (int y = tile.y0; y < tile.y1; ++y) {
    const int below = std::max(y - 1, 0), above = std::min(y + 1, height.height() - 1);
    const SurfaceRows<Half> rows{height.row<Half>(below), height.row<Half>(y), height.row<Half>(above),
                                 mask.row<Half>(below),   mask.row<Half>(y),   mask.row<Half>(above)};
    Half* out = normal.row<Half>(y);
    for (int x = tile.x0; x < tile.x1; x += n) {
      SurfaceRows<Half> in = rows;
      if (x == 0 || x + n >= width) {
        in = {with_ends(rows.below, x, width, ends[0]),      with_ends(rows.here, x, width, ends[1]),
              with_ends(rows.above, x, width, ends[2]),      with_ends(rows.mask_below, x, width, ends[3]),
              with_ends(rows.mask_here, x, width, ends[4]), with_ends(rows.mask_above, x, width, ends[5])};
      }
      const Vec3<Lanes> v = corrected ? normal_corrected<Lanes>(u, in, x) : normal_as_published<Lanes>(u, in, x);
      const Lanes rgba[4] = {v.x, v.y, v.z, Lanes(1.0f)};
      store4(out + 4 * x, rgba, rounding);
    }
  }
}
void NormalsRows(const NormalsUniforms& u, bool corrected, Rounding rounding, const Image& height, const Image& mask, Image& normal,
                 const parallel::Tile& tile) {
  if (corrected) return normals_of<true>(u, rounding, height, mask, normal, tile);
  normals_of<false>(u, rounding, height, mask, normal, tile);
}
RAINREF_TARGET_END(windshield)

#if RAINREF_ONCE
namespace rainref::windshield {

RAINREF_EXPORT(WipeTextureRows);
RAINREF_EXPORT(NormalsRows);

void wipe_texture_rows(const WipeTextureUniforms& uniforms, bool corrected, Rounding rounding, const Wiper* wipers,
                       const WipedTextures& textures, const parallel::Tile& tile) {
  RAINREF_DISPATCH(WipeTextureRows)(uniforms, corrected, rounding, wipers, textures, tile);
}
void normals_rows(const NormalsUniforms& uniforms, bool corrected, Rounding rounding, const Image& height, const Image& mask, Image& normal,
                  const parallel::Tile& tile) {
  RAINREF_DISPATCH(NormalsRows)(uniforms, corrected, rounding, height, mask, normal, tile);
}

}  // namespace rainref::windshield
#endif
