// Shells of raindrops as published, and functions that read and write levels of the wave; compiled once for each SIMD target.
#include <algorithm>

#include "pass/planes.h"
#include "puddle/kernels.h"
#include "puddle/raindrops.pass.h"

#define RAINREF_KERNELS "puddle/kernels_levels.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(puddle)
#define RAINREF_FN HWY_INLINE HWY_ATTR
#include "puddle/raindrops.pass.h"
#undef RAINREF_FN

template <class Storage>
Storage encode_one(float x, Rounding rounding) {
  Storage s;
  store(&s, Lanes(x), rounding, 1);
  return s;
}

template <class Storage>
void encode(const float* stored, Image& plane, Boundary boundary, float rest, Rounding rounding) {
  const int n = Lanes::size(), width = plane.width();
  HWY_ALIGN float block[HWY_MAX_BYTES / sizeof(float)] = {};
  for (int y = 0; y < plane.height(); ++y) {
    Storage* row = plane.row<Storage>(y);
    for (int x = 0; x < width; x += n) {
      const int count = std::min(n, width - x);
      std::copy_n(stored + static_cast<std::size_t>(y) * width + x, count, block);
      store(row + x, Lanes::load(block), rounding, count);
    }
    pass::fill_margins(row, width, address_of(boundary), encode_one<Storage>(rest, rounding));
  }
}
void EncodeRows(const float* stored, Image& plane, Boundary boundary, float rest, Rounding rounding) {
  pass::in_storage(plane.format(), [&]<class Storage>(Storage) HWY_ATTR { encode<Storage>(stored, plane, boundary, rest, rounding); });
}

template <class Storage>
void decode(const Image& plane, float* out, const parallel::Tile& tile) {
  const int n = Lanes::size(), width = plane.width();
  for (int y = tile.y0; y < tile.y1; ++y) {
    const Storage* row = plane.row<Storage>(y);
    float* to = out + static_cast<std::size_t>(y) * width;
    for (int x = 0; x < width; x += n) store(to + x, Lanes::load(row + x), Rounding::rne, std::min(n, width - x));
  }
}
void DecodeRows(const Image& plane, float* out, const parallel::Tile& tile) {
  pass::in_storage(plane.format(), [&]<class Storage>(Storage) HWY_ATTR { decode<Storage>(plane, out, tile); });
}

// A maximum does not depend on the order of its operands, so lanes may hold partial ones.
float largest(Lanes x) {
  HWY_ALIGN float lanes[HWY_MAX_BYTES / sizeof(float)];
  hn::Store(x.v, Lanes::D(), lanes);
  return *std::max_element(lanes, lanes + Lanes::size());
}
void ExtentsOfRows(const float* decoded, int width, int height, float rest, const parallel::Tile& tile, Extent* blocks) {
  const int n = Lanes::size();
  const auto magnitude = [](float x) { return x < 0 ? -x : x; };
  for (int x0 = 0; x0 < width; x0 += extent_block) {
    const int x1 = std::min(width, x0 + extent_block);
    Lanes top(0.0f), step(0.0f);
    float tail_top = 0, tail_step = 0;
    for (int y = tile.y0; y < tile.y1; ++y) {
      const float *row = decoded + static_cast<std::size_t>(y) * width, *next = y + 1 < height ? row + width : row;
      // The water drops to the rest level beyond its edge.
      if (x0 == 0) tail_step = std::max(tail_step, magnitude(row[0] - rest));
      if (x1 == width) tail_step = std::max(tail_step, magnitude(row[width - 1] - rest));
      if (y == 0 || y + 1 == height) {
        for (int x = x0; x < x1; ++x) tail_step = std::max(tail_step, magnitude(row[x] - rest));
      }
      int x = x0;
      for (; x + n <= x1 && x + n < width; x += n) {
        const Lanes here = Lanes::load(row + x);
        top = max(top, abs(here - Lanes(rest)));
        step = max(step, max(abs(Lanes::load(row + x + 1) - here), abs(Lanes::load(next + x) - here)));
      }
      for (; x < x1; ++x) {
        tail_top = std::max(tail_top, magnitude(row[x] - rest));
        if (x + 1 < width) tail_step = std::max(tail_step, magnitude(row[x + 1] - row[x]));
        tail_step = std::max(tail_step, magnitude(next[x] - row[x]));
      }
    }
    *blocks++ = {std::max(tail_top, largest(top)), std::max(tail_step, largest(step))};
  }
}

void RaindropsAsPublished(const RaindropsUniforms& uniforms, Drop* out) {
  const int n = Lanes::size();
  for (int i = 0; i < uniforms.drop_count; i += n) {
    const Vec3<Lanes> drop = raindrop_as_published<Lanes>(uniforms, i);
    HWY_ALIGN float x[HWY_MAX_BYTES / sizeof(float)], y[HWY_MAX_BYTES / sizeof(float)], strength[HWY_MAX_BYTES / sizeof(float)];
    hn::Store(drop.x.v, Lanes::D(), x);
    hn::Store(drop.y.v, Lanes::D(), y);
    hn::Store(drop.z.v, Lanes::D(), strength);
    for (int k = 0; k < std::min(n, uniforms.drop_count - i); ++k) out[i + k] = {x[k], y[k], strength[k] + 0.0f, raindrop_radius};
  }
}
RAINREF_TARGET_END(puddle)

#if RAINREF_ONCE
namespace rainref::puddle {

RAINREF_EXPORT(EncodeRows);
RAINREF_EXPORT(DecodeRows);
RAINREF_EXPORT(ExtentsOfRows);
RAINREF_EXPORT(RaindropsAsPublished);

void encode_rows(const float* stored, Image& plane, Boundary boundary, float rest, Rounding rounding) {
  RAINREF_DISPATCH(EncodeRows)(stored, plane, boundary, rest, rounding);
}
void decode_rows(const Image& plane, float* out, const parallel::Tile& tile) { RAINREF_DISPATCH(DecodeRows)(plane, out, tile); }
void extents_of_rows(const float* decoded, int width, int height, float rest, const parallel::Tile& tile, Extent* blocks) {
  RAINREF_DISPATCH(ExtentsOfRows)(decoded, width, height, rest, tile, blocks);
}
std::vector<Drop> raindrops_as_published(const RaindropsUniforms& uniforms) {
  std::vector<Drop> drops(static_cast<std::size_t>(std::max(0, uniforms.drop_count)));
  RAINREF_DISPATCH(RaindropsAsPublished)(uniforms, drops.data());
  return drops;
}

}  // namespace rainref::puddle
#endif
