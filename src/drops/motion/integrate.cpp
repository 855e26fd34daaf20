#include "drops/motion/kernels.h"
#include "drops/motion/passes.h"

namespace rainref::drops {

MassBalance integrate(const parallel::Executor& executor, DropArrays& drops, const IntegrateUniforms& uniforms, const GlassFrame& glass,
                      bool corrected) {
  pass::HostIo<IntegratePass> io;
  io.drops.columns = drops.columns();
  io.glass_frame = std::span(&glass, 1);
  // Over fixed chunks. Integers, so the order of the sum does not matter.
  const std::int64_t chunk = chunk_of(drops.extent());
  std::vector<MassBalance> of_chunk(static_cast<std::size_t>((drops.extent() + chunk - 1) / chunk));
  executor.for_range(drops.extent(), chunk, [&](std::int64_t begin, std::int64_t end) {
    of_chunk[static_cast<std::size_t>(begin / chunk)] = integrate_range(uniforms, corrected, io, begin, end);
  });
  MassBalance sum;
  for (const MassBalance& b : of_chunk) sum += b;
  return sum;
}

}  // namespace rainref::drops
