#include "drops/kernels.h"
#include "drops/passes.h"

namespace rainref::drops {
namespace {

/// The sum over fixed chunks of what body(begin, end) reports. Whole numbers, so the order is free.
template <class Body>
MassBalance over_chunks(const parallel::Executor& executor, std::int64_t extent, Body body) {
  std::vector<MassBalance> of_chunk(static_cast<std::size_t>((extent + chunk_slots - 1) / chunk_slots));
  executor.for_range(extent, chunk_slots, [&](std::int64_t begin, std::int64_t end) {
    of_chunk[static_cast<std::size_t>(begin / chunk_slots)] = body(begin, end);
  });
  MassBalance sum;
  for (const MassBalance& l : of_chunk) sum += l;
  return sum;
}

}  // namespace

MassBalance integrate_as_published(const parallel::Executor& executor, DropArrays& drops, const IntegrateUniforms& uniforms,
                                   const GlassFrame& glass) {
  const Slots slots(drops);
  return over_chunks(executor, drops.extent(), [&](std::int64_t begin, std::int64_t end) {
    MassBalance balance;
    balance.removed = integrate_range_as_published(uniforms, glass, slots, begin, end);
    return balance;
  });
}

MassBalance integrate_corrected(const parallel::Executor& executor, DropArrays& drops, const IntegrateUniforms& uniforms,
                                const GlassFrame& glass) {
  const Slots slots(drops);
  return over_chunks(executor, drops.extent(),
                     [&](std::int64_t begin, std::int64_t end) { return integrate_range_corrected(uniforms, glass, slots, begin, end); });
}

}  // namespace rainref::drops
