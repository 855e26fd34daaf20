// Compiled once for each SIMD target, as is what the bench measures beside it.
#include "stream.h"

#define RAINREF_KERNELS "stream.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(bench)

void StreamRow(const std::uint64_t* from, std::size_t read, std::uint64_t* to, std::size_t updated) {
  const hn::ScalableTag<std::uint64_t> d;
  const std::size_t n = hn::Lanes(d), both = std::min(read, updated);
  std::size_t i = 0;
  for (; i + n <= both; i += n) hn::StoreU(hn::Xor(hn::LoadU(d, to + i), hn::LoadU(d, from + i)), d, to + i);
  auto rest = hn::Zero(d);
  std::size_t k = i;
  for (; k + n <= read; k += n) rest = hn::Xor(rest, hn::LoadU(d, from + k));
  for (; i + n <= updated; i += n) hn::StoreU(hn::Xor(hn::LoadU(d, to + i), hn::Set(d, 1)), d, to + i);
  to[0] ^= hn::GetLane(rest);  // or the reading would be left out
}

RAINREF_TARGET_END(bench)

#if RAINREF_ONCE
#include "base/zeroed.h"

namespace rainref::bench {

RAINREF_EXPORT(StreamRow);

double stream_seconds(const parallel::Executor& executor, int width, int height, int tile_rows, Traffic traffic) {
  const std::size_t in_row = static_cast<std::size_t>(width) * traffic.read / sizeof(std::uint64_t);
  const std::size_t out_row = static_cast<std::size_t>(width) * traffic.updated / sizeof(std::uint64_t);
  zeroed::Array<std::uint64_t> in(in_row * height, 0x0123456789abcdefu), out(out_row * height, 0x55u);  // on large pages, as planes are
  const auto rows = [&](const parallel::Tile& tile) {
    for (int y = tile.y0; y < tile.y1; ++y) RAINREF_DISPATCH(StreamRow)(in.data() + in_row * y, in_row, out.data() + out_row * y, out_row);
  };
  double best = 1e9, total = 0;
  for (int go = 0; go < 5 || (total < 0.1 && go < 2000); ++go) {
    const double seconds = seconds_of([&] { executor.for_tiles(width, height, width, tile_rows, rows); });
    best = std::min(best, seconds);
    total += seconds;
  }
  return best;
}

}  // namespace rainref::bench
#endif
