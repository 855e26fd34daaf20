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
  m.hold(drops * (sizeof(Drop) + sizeof(StampRecord)));  // the list, and the stamps
  if (lean) m.hold(drops * sizeof(LeanRecord));
  if (!s.corrected) return m;
  m.hold(Image::memory_bytes(Format::r32f, columns, rows));
  // merge: position, radius and cell by slot; cell and slot; position, radius, mass, id and slot by cell; the larger drop; the cells.
  m.hold(drops * (3 * sizeof(float) + sizeof(std::uint32_t) + 2 * sizeof(std::uint32_t) + 4 * sizeof(float) + 2 * sizeof(std::uint32_t) +
                  sizeof(std::int32_t) + sizeof(std::uint32_t)));
  // Each neck belongs to two former drops: its numbers, id and slot, its record, and its stamp.
  if (s.neck_time > 0) m.hold(drops / 2 * (6 * sizeof(float) + 2 * sizeof(Neck) + sizeof(NeckRecord)));
  m.pass(drops * sizeof(Deposit));
  return m;
}

}  // namespace rainref::drops
