#include "judge/reference_outputs.h"

#include <optional>

#include "judge/slots.h"
#include "math/scalar.h"

namespace rainref::judge {

using capture::Array;
using capture::PassCase;
using capture::PassModel;

std::vector<Array> reference_outputs(const PassCase& c, const PassModel& model, const parallel::Executor& executor, HalfMode mode) {
  const std::vector<Slot> slots = slots_of(c);
  std::vector<Array> out;
  for (const capture::CaseOutput& o : c.outputs) {
    Array& array = out.emplace_back(o.array);
    if (o.array.is_records && is_placed(o)) {
      array.width = model.width();
      array.levels.assign(1, capture::Bytes(array.element_bytes() * static_cast<std::size_t>(array.width)));
    }
    const capture::KeyedModel* keyed = o.judge == capture::Judge::keyed ? model.keyed(o.name) : nullptr;
    const auto records = keyed ? keyed->reference() : std::nullopt;
    if (!records) continue;
    array.width = static_cast<int>(records->size() / array.element_bytes());
    array.levels = {*records};
  }
  if (slots.empty()) return out;
  std::vector<std::byte*> texels;  // one for each output
  for (Array& array : out) texels.push_back(array.levels.empty() ? nullptr : array.levels[0].edit().data());
  executor.for_tiles(model.width(), model.height(), model.width(), 4, [&](const parallel::Tile& tile) {
    std::vector<scalar::Scalar<float>> values(slots.size());
    for (int y = tile.y0; y < tile.y1; ++y) {
      for (int x = tile.x0; x < tile.x1; ++x) {
        model.evaluate(x, y, values.data());
        for (std::size_t v = 0; v < slots.size(); ++v) {
          const Slot& s = slots[v];
          store_value(s, values[v].v, rounding_of(s, mode), texels[static_cast<std::size_t>(s.output)] + s.offset(x, y));
        }
      }
    }
  });
  return out;
}

}  // namespace rainref::judge
