#include "drops/host.h"

#include <cstdint>

#include "drops/drops.h"
#include "drops/motion/kernels.h"
#include "drops/splat/kernels.h"
#include "image/memory.h"
#include "rainref/image.h"

namespace rainref::drops {

MemoryPeak memory(const Settings& s, int columns, int rows, std::int64_t live, bool lean) {
  const auto drops = static_cast<std::uint64_t>(live);
  MemoryPeak m;
  m.hold(DropArrays::memory_bytes(s.capacity));
  m.hold(drops * (sizeof(Drop) + sizeof(StampRecord)));  // listed, and to be drawn
  if (lean) m.hold(drops * sizeof(LeanRecord));
  if (!s.corrected) return m;
  m.hold(Image::memory_bytes(Format::r32f, columns, rows));
  // merge: place, radius and cell by slot; cell and slot; place, radius, mass, id and slot by cell; the larger one; the cells.
  m.hold(drops * (3 * sizeof(float) + sizeof(std::uint32_t) + 2 * sizeof(std::uint32_t) + 4 * sizeof(float) + 2 * sizeof(std::uint32_t) +
                  sizeof(std::int32_t) + sizeof(std::uint32_t)));
  // Each neck is of two drops that were: its numbers, id and slot, their record, and as it is drawn.
  if (s.neck_time > 0) m.hold(drops / 2 * (6 * sizeof(float) + 2 * sizeof(Neck) + sizeof(NeckRecord)));
  m.pass(drops * sizeof(Deposit));
  return m;
}

}  // namespace rainref::drops
