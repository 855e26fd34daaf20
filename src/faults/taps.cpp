#include "faults/taps.h"

#include <algorithm>
#include <cmath>
#include <memory>

#include "faults/image_faults.h"
#include "rainref/error.h"

namespace rainref::faults {
namespace {

using capture::Array;
using capture::PassCase;

/// Stores an integer so that whole_of() can read it: up to 255 for codes, 2000 for halves.
void write_whole(const Array& a, std::byte* at, int number) {
  const FormatInfo& f = info(a.format);
  if (f.kind == FormatInfo::float32 || f.kind == FormatInfo::float16)
    put_channel(f, at, static_cast<float>(number));
  else
    *at = static_cast<std::byte>(number);
}
int whole_of(const Array& a, float v) { return static_cast<int>(std::lround(info(a.format).kind == FormatInfo::unorm8 ? v * 255 : v)); }
/// Numbers relative to the probe, so that they fit.
constexpr int middle = 100, reach = 90;

std::vector<float> loads_of(const capture::PassModel& model, Texel at) {
  const perturbed::Trace trace = trace_of(model, at);
  std::vector<float> out;
  for (const auto& n : trace.nodes)
    if (n.op == perturbed::Op::load) out.push_back(n.value);
  return out;
}

/// The loads of an invocation if every channel of every texel of an input holds number(x, y, channel).
template <class Number>
std::vector<float> loads_with(const Probed& p, std::size_t input, Texel at, const Number& number) {
  PassCase c = p.c;
  Array& a = c.inputs[input].array;
  const FormatInfo& f = info(a.format);
  std::byte* const texels = a.levels[0].edit().data();
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      for (int k = 0; k < f.channels; ++k)
        write_whole(
            a,
            texels + (static_cast<std::size_t>(y) * static_cast<std::size_t>(a.width) + static_cast<std::size_t>(x)) * a.element_bytes() +
                static_cast<std::size_t>(k * f.channel_bytes),
            number(x, y, k));
  const std::unique_ptr<capture::PassModel> model = p.bind(c);
  return loads_of(*model, at);
}

Taps found_taps(const Probed& p, std::size_t input) {
  const Array& a = p.c.inputs[input].array;
  Taps taps{p.c.inputs[input].name, {}};
  const Texel at{p.model.width() / 2, p.model.height() / 2}, next{std::max(at.x - 1, 0), std::max(at.y - 1, 0)};
  taps.scale_x = std::max(1, (a.width + p.model.width() / 2) / std::max(p.model.width(), 1));
  taps.scale_y = std::max(1, (a.height + p.model.height() / 2) / std::max(p.model.height(), 1));
  const Texel centre{taps.scale_x * at.x, taps.scale_y * at.y};
  const auto around = [](int x, int from) { return std::clamp(x - from, -reach, reach) + middle; };
  const auto column = [&](int x, int, int) { return around(x, centre.x); };
  const auto row = [&](int, int y, int) { return around(y, centre.y); };
  const std::vector<float> columns = loads_with(p, input, at, column), rows = loads_with(p, input, at, row),
                           next_columns = loads_with(p, input, next, column), next_rows = loads_with(p, input, next, row),
                           channels = loads_with(p, input, at, [](int, int, int k) { return middle + k; }),
                           none = loads_with(p, input, at, [](int, int, int) { return 0; });
  if (columns.size() != rows.size() || columns.size() != channels.size() || columns.size() != none.size()) return taps;
  if (next_columns.size() != columns.size() || next_rows.size() != columns.size()) return taps;
  for (std::size_t l = 0; l < columns.size(); ++l) {
    // A load of another input does not change.
    if (channels[l] == none[l]) continue;
    // A load that does not move with the pass's own texel is not a neighbour.
    if (whole_of(a, columns[l]) - whole_of(a, next_columns[l]) != taps.scale_x * (at.x - next.x) ||
        whole_of(a, rows[l]) - whole_of(a, next_rows[l]) != taps.scale_y * (at.y - next.y))
      continue;
    taps.all.push_back({l, whole_of(a, columns[l]) - middle, whole_of(a, rows[l]) - middle, whole_of(a, channels[l]) - middle});
  }
  return taps;
}

}  // namespace

Taps taps_of(const Probed& p, std::size_t input) {
  const Array& a = p.c.inputs[input].array;
  Taps taps{p.c.inputs[input].name, {}};
  if (a.is_records || a.levels.size() != 1 || a.width < 3 || a.height < 3) return taps;
  try {
    taps = found_taps(p, input);
  } catch (const Error&) {
    return taps;  // the pass rejects such an input
  }
  const int channels = info(a.format).channels;
  // Loads from far away, or from no channel, are not loads of a texel from an input of this size.
  std::erase_if(taps.all,
                [&](const Tap& t) { return t.channel < 0 || t.channel >= channels || std::abs(t.dx) >= reach || std::abs(t.dy) >= reach; });
  return taps;
}

int placed(int i, int size, Address address) {
  if (0 <= i && i < size) return i;
  switch (address) {
    case Address::repeat:
      return ((i % size) + size) % size;
    case Address::mirror: {
      const int r = ((i % (2 * size)) + 2 * size) % (2 * size);
      return r < size ? r : 2 * size - 1 - r;
    }
    case Address::border:
      return -1;
    case Address::clamp:
      break;
  }
  return std::clamp(i, 0, size - 1);
}

}  // namespace rainref::faults
