// Samples to pixels; compiled once for each SIMD target.
#include <limits>

#include "compositor/picture_kernels.h"

#define RAINREF_KERNELS "compositor/kernels_picture.cpp"
#include "math/foreach_target.h"
#include "math/double_lanes-inl.h"

RAINREF_TARGET_BEGIN(compositor)

using N = DoubleLanes;
constexpr std::size_t n = static_cast<std::size_t>(N::size());

void AddSample(std::size_t pixels, SeenColumns& seen, bool is_first, SampleSums& sums) {
  const N zero(0.0), one(1.0), endless(std::numeric_limits<double>::infinity());
  const auto apart = hn::ShiftLeft<2>(hn::Iota(hn::RebindToSigned<N::D>(), 0));
  for (std::size_t i = 0; i < pixels; i += n) {
    const auto so_far = [&](const double* sum, N nothing) HWY_ATTR { return is_first ? nothing : N::load(sum + i); };
    const auto add = [&](const double* from, double* to) HWY_ATTR { hn::StoreU((so_far(to, zero) + N::load(from + i)).v, N::D(), to + i); };
    for (int k = 0; k < 3; ++k) {
      add(seen.radiance().component[k], sums.radiance().component[k]);
      add(seen.normal().component[k], sums.normal().component[k]);
    }
    add(seen.film(), sums.film());
    add(seen.mask(), sums.mask());
    const N t = hn::GatherIndex(N::D(), &seen.hits()[i].t, apart);  // infinite if nothing was hit
    hn::StoreU((so_far(sums.met(), zero) + select(t < endless, one, zero)).v, N::D(), sums.met() + i);
    hn::StoreU(min(so_far(sums.depth(), N(static_cast<double>(far))), t).v, N::D(), sums.depth() + i);
  }
}

void Develop(std::size_t first, std::size_t pixels, double share, SampleSums& sums, float* beauty, float* normal, float* film, float* mask,
             float* depth) {
  const NarrowTag d;
  const N each(share), brightest(65504.0);
  // + 0 makes the zero positive.
  const auto rounded = [&](N x) HWY_ATTR { return hn::Add(hn::DemoteTo(d, x.v), hn::Zero(d)); };
  const auto mean = [&](const double* sum, std::size_t i) HWY_ATTR { return each * N::load(sum + first + i); };
  for (std::size_t i = 0; i < pixels; i += n) {
    const auto bright = [&](int k) HWY_ATTR { return rounded(min(mean(sums.radiance().component[k], i), brightest)); };
    const auto along = [&](int k) HWY_ATTR { return rounded(mean(sums.normal().component[k], i)); };
    hn::StoreInterleaved4(bright(0), bright(1), bright(2), hn::Set(d, 1.0f), d, beauty + 4 * i);
    hn::StoreInterleaved4(along(0), along(1), along(2), rounded(mean(sums.met(), i)), d, normal + 4 * i);
    hn::StoreU(rounded(mean(sums.film(), i)), d, film + i);
    hn::StoreU(rounded(mean(sums.mask(), i)), d, mask + i);
    hn::StoreU(rounded(N::load(sums.depth() + first + i)), d, depth + i);
  }
}

RAINREF_TARGET_END(compositor)

#if RAINREF_ONCE
namespace rainref::compositor {

RAINREF_EXPORT(AddSample);
RAINREF_EXPORT(Develop);

void add_sample(std::size_t pixels, SeenColumns& seen, bool is_first, SampleSums& sums) {
  RAINREF_DISPATCH(AddSample)(pixels, seen, is_first, sums);
}
void develop(std::size_t first, std::size_t pixels, double share, SampleSums& sums, float* beauty, float* normal, float* film, float* mask,
             float* depth) {
  RAINREF_DISPATCH(Develop)(first, pixels, share, sums, beauty, normal, film, mask, depth);
}

}  // namespace rainref::compositor
#endif
