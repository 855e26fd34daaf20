// blur_pyramid in lanes; compiled once for each SIMD target.
#include <algorithm>
#include <memory>

#include "blur_pyramid/blur_pyramid.pass.h"
#include "pass/run.h"

#define RAINREF_KERNELS "blur_pyramid/kernels.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"
#include "pass/rows-inl.h"

RAINREF_TARGET_BEGIN(blur_pyramid)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#define RAINREF_LAMBDA HWY_ATTR __attribute__((always_inline))
#include "math/optics-inl.h"
#include "blur_pyramid/blur_pyramid.pass.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

RAINREF_PASS_ROWS(FogPass)

// One row of the level above as four planes of floats, and the combination of two or seven such rows. A plane is readable two vectors and
// six texels past its last texel.
struct Planes {
  std::size_t pitch;
  std::unique_ptr<float[]> texels;
  explicit Planes(int width)
      : pitch(static_cast<std::size_t>(width) + 8 + 3 * HWY_MAX_BYTES / sizeof(float)),
        texels(std::make_unique_for_overwrite<float[]>(4 * pitch)) {
    for (int c = 0; c < 4; ++c) std::fill(channel(c) + width, channel(c) + pitch, 0.0f);
  }
  float* channel(int c) { return texels.get() + pitch * static_cast<std::size_t>(c); }
};

// A row of pairs starts at 2 x. Even and odd texels are separated on loading; every lane is still one output texel.
HWY_INLINE HWY_ATTR void load_pairs(const float* row, Lanes& even, Lanes& odd) {
#if HWY_TARGET == HWY_SCALAR
  even = Lanes::load(row);
  odd = Lanes::load(row + 1);
#else
  hn::LoadInterleaved2(Lanes::D(), row, even.v, odd.v);
#endif
}

template <bool corrected>
HWY_INLINE HWY_ATTR void halve(const BlurUniforms& u, Rounding rounding, const Image& above, Image& out, const parallel::Tile& tile) {
  const int n = Lanes::size(), source_width = u.source_size[0], width = out.width();
  // corrected: the seven rows combined, from the second texel before the first on; as-published: the first row.
  constexpr int before = corrected ? 2 : 0;
  Planes column(source_width);
  Planes second(corrected ? 0 : source_width);
  for (int y = tile.y0; y < tile.y1; ++y) {
    const Half* rows[corrected ? 7 : 2];
    int j = 2 * y - before;
    for (const Half*& row : rows) {
      row = above.row<Half>(corrected ? mirrored(j, u.source_size[1]) : std::min(j, u.source_size[1] - 1));
      ++j;
    }
    const Lanes w1(u.middle[1]), w2 = last_weight(u.last[1], Lanes(static_cast<float>(y)));
    for (int x = 0; x < source_width; x += n) {
      Lanes t[corrected ? 7 : 2][4];
      for (std::size_t i = 0; i < std::size(rows); ++i) load4(rows[i] + 4 * x, t[i]);
      for (int k = 0; k < 4; ++k) {
        if constexpr (corrected) {
          const Lanes taps[] = {t[0][k], t[1][k], t[2][k], t[3][k], t[4][k], t[5][k], t[6][k]};
          hn::StoreU(round_of_seven(taps, w1, w2).v, Lanes::D(), column.channel(k) + before + x);
        } else {
          hn::StoreU(t[0][k].v, Lanes::D(), column.channel(k) + x);
          hn::StoreU(t[1][k].v, Lanes::D(), second.channel(k) + x);
        }
      }
    }
    // Outside the image: the mirrored texel, or the nearest one.
    for (int k = 0; k < 4; ++k) {
      float* const own = column.channel(k) + before;
      const auto beyond = [&](int i) { return corrected ? mirrored(i, source_width) : source_width - 1; };
      for (int i = 0; i < before; ++i) column.channel(k)[i] = own[beyond(i - before)];
      for (int i = source_width; i < source_width + 3; ++i) own[i] = own[beyond(i)];
      if constexpr (!corrected)
        for (int i = 0; i < 3; ++i) second.channel(k)[source_width + i] = second.channel(k)[source_width - 1];
    }
    for (int x = 0; x < width; x += n) {
      Lanes rgba[4];
      for (int k = 0; k < 4; ++k) {
        Lanes even, odd;
        load_pairs(column.channel(k) + 2 * x, even, odd);
        if constexpr (corrected) {
          Lanes t2, t3, t4, t5, t6, unused;
          load_pairs(column.channel(k) + 2 * x + 2, t2, t3);
          load_pairs(column.channel(k) + 2 * x + 4, t4, t5);
          load_pairs(column.channel(k) + 2 * x + 6, t6, unused);
          const Lanes taps[] = {even, odd, t2, t3, t4, t5, t6};
          rgba[k] = round_of_seven(taps, Lanes(u.middle[0]), last_weight(u.last[0], Lanes::index(x)));
        } else {
          Lanes below_even, below_odd;
          load_pairs(second.channel(k) + 2 * x, below_even, below_odd);
          rgba[k] = box_of_four(even, odd, below_even, below_odd);
        }
      }
      store4(out.row<Half>(y) + 4 * x, rgba, rounding);
    }
  }
}
void HalvePassRows(const BlurUniforms& u, bool corrected, Rounding rounding, const pass::HostIo<HalvePass>& io,
                   const parallel::Tile& tile) {
  if (corrected) return halve<true>(u, rounding, *io.above.image, *io.blurred.image, tile);
  halve<false>(u, rounding, *io.above.image, *io.blurred.image, tile);
}
RAINREF_TARGET_END(blur_pyramid)

#if RAINREF_ONCE
RAINREF_PASS_DISPATCH(blur_pyramid, FogPass)
RAINREF_PASS_DISPATCH(blur_pyramid, HalvePass)
#endif
