// What the passes written by hand give for a case, each with a mistake or with none.
#pragma once

#include <cstdlib>

#include "documents/judged_written.h"
#include "faults/hand_made.h"
#include "faults/mistakes_drops_and_maps.h"
#include "faults/mistakes_pictures.h"
#include "faults/mistakes_puddle.h"
#include "faults/mistakes_rainy_glass.h"
#include "faults/mistakes_windshield.h"

namespace rainref::faults::hand {

/// The passes whose mistakes the diagnosis was improved with.
inline std::vector<Pass> known_passes() {
  std::vector<Pass> all = puddle_passes();
  for (const auto& more : {windshield_passes(), picture_passes(), rainy_glass_passes(), drops_and_maps_passes()})
    all.insert(all.end(), more.begin(), more.end());
  return all;
}

/// Whether every mistake is tried, in place of a few (scripts/full/mistakes).
inline bool measures_all() { return std::getenv("RAINREF_MISTAKES") != nullptr; }

/// What the hand-made pass stores, or that of tests/documents. `stores`: how halves are rounded; either: as the reference does.
inline std::vector<capture::Array> given(const Pass& p, const capture::Pack& pack, const capture::PassCase& c, const std::string& mistake,
                                         judge::HalfMode stores = judge::HalfMode::either) {
  if (!p.loop) return documents::given(*documents::written(p.pack, p.pass), pack, c, mistake, stores);
  std::vector<capture::Array> out;
  for (const capture::CaseOutput& o : c.outputs) out.push_back(o.array);
  const std::vector<judge::Slot> slots = judge::slots_of(c);
  const Run run(c, pack.pass(p.pass).block, mistake);
  std::vector<float> values(slots.size());
  for (int y = 0; y < out[0].height; ++y)
    for (int x = 0; x < out[0].width; ++x) {
      if (!p.loop(run, x, y, values.data())) continue;
      for (std::size_t v = 0; v < slots.size(); ++v)
        judge::store_value(slots[v], values[v], judge::rounding_of(slots[v], stores),
                           out[static_cast<std::size_t>(slots[v].output)].levels[0].edit().data() + slots[v].offset(x, y));
    }
  return out;
}

}  // namespace rainref::faults::hand
