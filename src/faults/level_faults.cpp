// An image with levels, whose first level is read where it is meant: what a port has that looks up a coarser one there.
#include <algorithm>
#include <cmath>
#include <cstring>

#include <fmt/format.h>

#include "faults/case_adder.h"
#include "faults/whole_faults.h"
#include "math/half.h"

namespace rainref::faults {
namespace {

using capture::Array;
using capture::PassCase;

bool has_floats(const Array& a) {
  const FormatInfo::Kind kind = info(a.format).kind;
  return kind == FormatInfo::float16 || kind == FormatInfo::float32;
}
int size_of(int size, std::size_t level) { return std::max(1, size >> level); }
float number_at(const Array& a, std::size_t level, int x, int y, int channel) {
  const FormatInfo& f = info(a.format);
  const int width = size_of(a.width, level), height = size_of(a.height, level);
  const std::size_t texel = static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * static_cast<std::size_t>(width) +
                            static_cast<std::size_t>(std::clamp(x, 0, width - 1));
  const std::byte* at = a.levels[level].data() + texel * a.element_bytes() + static_cast<std::size_t>(channel * f.channel_bytes);
  if (f.kind == FormatInfo::float32) {
    float v;
    std::memcpy(&v, at, 4);
    return v;
  }
  Half h;
  std::memcpy(&h, at, 2);
  return to_float(h);
}
/// Between four texels of a level, at (u, v) of [0, 1].
double filtered(const Array& a, std::size_t level, double u, double v, int channel) {
  const double x = u * size_of(a.width, level) - 0.5, y = v * size_of(a.height, level) - 0.5;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const double fx = x - i, fy = y - j;
  const auto at = [&](int dx, int dy) { return static_cast<double>(number_at(a, level, i + dx, j + dy, channel)); };
  return (at(0, 0) * (1 - fx) + at(1, 0) * fx) * (1 - fy) + (at(0, 1) * (1 - fx) + at(1, 1) * fx) * fy;
}
/// The first level becomes what a lookup at `lod` gives at its texels.
void coarsen(Array& a, double lod) {
  const Array from = a;
  const FormatInfo& f = info(a.format);
  const auto last = static_cast<double>(a.levels.size() - 1);
  const double level = std::clamp(lod, 0.0, last);
  const auto low = static_cast<std::size_t>(std::floor(level)), high = std::min(low + 1, a.levels.size() - 1);
  const double share = level - static_cast<double>(low);
  std::byte* to = a.levels[0].data();
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      for (int k = 0; k < f.channels; ++k, to += f.channel_bytes) {
        const double u = (x + 0.5) / a.width, v = (y + 0.5) / a.height;
        const auto value = static_cast<float>(filtered(from, low, u, v, k) * (1 - share) + filtered(from, high, u, v, k) * share);
        if (f.kind == FormatInfo::float32) {
          std::memcpy(to, &value, 4);
        } else {
          const Half h = to_half(value);
          std::memcpy(to, &h, 2);
        }
      }
}

}  // namespace

void add_level_faults(std::vector<Fault>& out, const Probed& p) {
  CaseAdder add(out);
  for (std::size_t i = 0; i < p.c.inputs.size(); ++i) {
    const Array& a = p.c.inputs[i].array;
    if (a.is_records || a.levels.size() < 2 || !has_floats(a)) continue;
    const std::string& name = p.c.inputs[i].name;
    const auto at = [&](double lod, const std::string& level) {
      if (lod > 0)
        add(fmt::format("input {} at level {}", name, level),
            fmt::format("{} is looked up at level {} where its level 0, the sharp one, is meant", name, level),
            [i, lod](PassCase& altered) { coarsen(altered.inputs[i].array, lod); });
    };
    for (const scene::Member& m : p.pass.block.members) {
      const bool is_level = m.name.ends_with("lod") || m.name.ends_with("level");
      if (!is_level || m.scalar != scene::Scalar::float32 || m.components != 1) continue;
      float lod;
      std::memcpy(&lod, p.c.uniforms.data() + m.offset, 4);
      at(lod, m.name);
    }
    for (int k = 1; k < static_cast<int>(a.levels.size()); ++k) at(k, std::to_string(k));
  }
}

}  // namespace rainref::faults
