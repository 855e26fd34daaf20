// An image with levels, whose first level is read where it is meant: what a port has that looks up a coarser one there.
#include <algorithm>
#include <cmath>
#include <vector>

#include "capture/bound_texture.h"
#include "faults/generators.h"
#include "faults/image_faults.h"

namespace rainref::faults {
namespace {

using capture::Array;
using capture::PassCase;

bool has_floats(const Array& a) {
  const FormatInfo::Kind kind = info(a.format).kind;
  return kind == FormatInfo::float16 || kind == FormatInfo::float32;
}
/// A level, decoded.
struct Level {
  std::vector<float> values;
  int width, height, channels;
};
Level level_of(const Array& a, int level) {
  return {capture::decoded(a, level), a.level_width(level), a.level_height(level), info(a.format).channels};
}
/// Between four texels, at (u, v) of [0, 1].
double filtered(const Level& l, double u, double v, int channel) {
  const double x = u * l.width - 0.5, y = v * l.height - 0.5;
  const int i = static_cast<int>(std::floor(x)), j = static_cast<int>(std::floor(y));
  const double fx = x - i, fy = y - j;
  const auto at = [&](int dx, int dy) {
    const int column = std::clamp(i + dx, 0, l.width - 1), row = std::clamp(j + dy, 0, l.height - 1);
    return static_cast<double>(l.values[static_cast<std::size_t>((row * l.width + column) * l.channels + channel)]);
  };
  return (at(0, 0) * (1 - fx) + at(1, 0) * fx) * (1 - fy) + (at(0, 1) * (1 - fx) + at(1, 1) * fx) * fy;
}
/// The first level becomes what a lookup at `lod` gives at its texels.
void coarsen(Array& a, double lod) {
  const FormatInfo& f = info(a.format);
  const int last = static_cast<int>(a.levels.size()) - 1;
  const double level = std::clamp(lod, 0.0, static_cast<double>(last));
  const int first = static_cast<int>(std::floor(level));
  const Level low = level_of(a, first), high = level_of(a, std::min(first + 1, last));
  const double share = level - first;
  std::byte* to = a.levels[0].data();
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      for (int k = 0; k < f.channels; ++k, to += f.channel_bytes) {
        const double u = (x + 0.5) / a.width, v = (y + 0.5) / a.height;
        const auto value = static_cast<float>(filtered(low, u, v, k) * (1 - share) + filtered(high, u, v, k) * share);
        put_channel(f, to, value);
      }
}

}  // namespace

void add_level_faults(std::vector<Fault>& out, const Probed& p) {
  for (std::size_t i = 0; i < p.c.inputs.size(); ++i) {
    const Array& a = p.c.inputs[i].array;
    if (a.is_records || a.levels.size() < 2 || !has_floats(a)) continue;
    const auto at = [&](double lod, const std::string& level) {
      if (lod > 0)
        out.emplace_back(What{Kind::input_at_level, {p.c.inputs[i].name, level}}).alter_case = [i, lod](PassCase& altered) {
          coarsen(altered.inputs[i].array, lod);
        };
    };
    for (const scene::Member& m : p.pass.block.members)
      if (is_level(m) && m.scalar == scene::Scalar::float32 && m.components == 1)
        at(number_at<float>(p.c.uniforms.data(), m.offset), m.name);
    for (int k = 1; k < static_cast<int>(a.levels.size()); ++k) at(k, std::to_string(k));
  }
}

}  // namespace rainref::faults
