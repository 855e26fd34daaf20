// Inputs of a pass exchanged, shifted, in another encoding, or at coarser levels; one change in the records of an input.
#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <tuple>
#include <utility>
#include <vector>

#include "capture/bound_texture.h"
#include "faults/generators.h"
#include "faults/image_faults.h"
#include "faults/members.h"
#include "image/colour.h"
#include "judge/rearrange.h"
#include "math/unorm.h"

namespace rainref::faults {

using capture::Array;
using capture::CaseInput;
using capture::PassCase;

namespace {

/// Applies a function to the colours of every level; codes become floats, which can hold the result.
template <class Change>
void recode(Array& a, Change change, bool is_any = false) {
  const FormatInfo f = info(a.format);
  const bool to_floats = f.kind == FormatInfo::unorm8;
  for (capture::Bytes& shared : a.levels) {
    std::vector<std::byte>& level = shared.edit();
    std::vector<std::byte> out;
    const std::size_t n = static_cast<std::size_t>(f.channel_bytes);
    for (std::size_t t = 0, k = 0; t + n <= level.size(); t += n, ++k) {
      float v = channel_at(f, &level[t]);
      const bool is_alpha = f.channels == 4 && k % 4 == 3;
      if (!is_alpha && (is_any || (v >= 0 && v <= 1))) v = static_cast<float>(change(v));
      if (!to_floats) {
        put_channel(f, &level[t], v);
        continue;
      }
      const auto* bytes = reinterpret_cast<const std::byte*>(&v);
      out.insert(out.end(), bytes, bytes + 4);
    }
    if (to_floats) level = std::move(out);
  }
  if (to_floats) a.format = f.channels == 1 ? Format::r32f : Format::rgba32f;
}

/// Removes level 0; level k + 1 becomes level k.
void drop_first_level(Array& a) {
  a.levels.erase(a.levels.begin());
  a.width = a.width > 1 ? a.width / 2 : 1;
  a.height = a.height > 1 ? a.height / 2 : 1;
}

class InputAdder {
 public:
  InputAdder(std::vector<Fault>& out, const PassCase& c) : out_(out), c_(c) {}

  void add(Kind kind, std::vector<std::string> of, std::function<void(PassCase&)> alter) const {
    out_.emplace_back(What{kind, std::move(of)}).alter_case = std::move(alter);
  }
  /// alter(array of input i); `more`: further names in its text.
  void array(std::size_t i, Kind kind, std::vector<std::string> more, std::function<void(Array&)> alter) const {
    more.insert(more.begin(), c_.inputs[i].name);
    add(kind, std::move(more), [i, alter](PassCase& altered) { alter(altered.inputs[i].array); });
  }

  void image(std::size_t i) const {
    const std::string& name = c_.inputs[i].name;
    const Array& a = c_.inputs[i].array;
    const FormatInfo& f = info(a.format);
    for (const auto& [dx, dy, way] : {std::tuple(1, 0, Kind::input_read_right),
                                      {-1, 0, Kind::input_read_left},
                                      {0, 1, Kind::input_read_further_on},
                                      {0, -1, Kind::input_read_before}})
      array(i, way, {}, [dx = dx, dy = dy](Array& to) { judge::shift(to, dx, dy); });
    if (a.width == a.height) array(i, Kind::input_axes_exchanged, {}, judge::transpose);
    if (a.levels.size() > 1) array(i, Kind::input_one_level_above, {}, drop_first_level);
    for (int from = 0; from < f.channels; ++from)
      for (int to = 0; to < f.channels; ++to) {
        if (from == to) continue;
        const std::vector<std::string> both{component_name(from), component_name(to)};
        if (from < to && !(from == 0 && to == 1))
          array(i, Kind::input_channels_exchanged, both, [from, to](Array& altered) { judge::swap_channels(altered, from, to); });
        if (f.channels > 2)
          array(i, Kind::input_channel_for_another, both, [from, to](Array& altered) { judge::copy_channel(altered, from, to); });
      }
    if (f.kind == FormatInfo::float16 || f.kind == FormatInfo::float32)
      for (int k = 0; k < f.channels; ++k) {
        array(i, Kind::input_channel_negated, {component_name(k)}, negating_channel(f, k));
        array(i, Kind::input_without_channel, {component_name(k)}, clearing_channel(f, k));
      }
    const auto coded = [&](Kind kind, double (*change)(double)) {
      array(i, kind, {}, [change](Array& altered) { recode(altered, change); });
    };
    if (f.kind == FormatInfo::unorm8 || f.channels >= 3) {
      coded(Kind::input_decoded, [](double v) { return decode_srgb(v); });
      coded(Kind::input_encoded, [](double v) { return encode_srgb(v); });
      coded(Kind::input_decoded_by_power, [](double v) { return decode_gamma22(v); });
    }
    coded(Kind::input_from_1, [](double v) { return 1 - v; });
    for (const Address address : {Address::clamp, Address::repeat, Address::mirror, Address::border}) {
      if (c_.inputs[i].address_u == address && c_.inputs[i].address_v == address) continue;
      add(Kind::input_beyond_edge, {name, address_words(address)}, [i, address](PassCase& altered) {
        altered.inputs[i].address_u = altered.inputs[i].address_v = address;
        if (address == Address::border) altered.inputs[i].border = {};
      });
    }
  }

  /// Changes every record of a list in one way.
  void records(std::size_t i) const {
    const std::string& name = c_.inputs[i].name;
    const scene::UniformBlock& record = c_.inputs[i].array.record;
    const auto keep = [&](Kind kind, std::vector<std::string> more, std::size_t count) {
      array(i, kind, std::move(more), [count, size = record.size](Array& list) {
        list.levels[0].edit().resize(count * size);
        list.width = static_cast<int>(count);
      });
    };
    keep(Kind::input_left_out, {}, 0);
    const std::size_t count = record.size > 0 ? c_.inputs[i].array.levels[0].size() / record.size : 0;
    constexpr std::size_t most_records = 40;
    for (std::size_t k = 1; k < std::min(count, most_records); ++k)
      keep(k == 1 ? Kind::loop_ends_after_one : Kind::loop_ends_early, {std::to_string(k)}, k);
    const auto each = [&](Kind kind, std::vector<std::string> of, std::function<void(std::byte*)> change) {
      add(kind, std::move(of), [i, change, size = record.size](PassCase& altered) {
        std::vector<std::byte>& all = altered.inputs[i].array.levels[0].edit();
        for (std::size_t r = 0; r + size <= all.size(); r += size) change(all.data() + r);
      });
    };
    for (const scene::Member& m : record.members)
      if (m.scalar == scene::Scalar::float32 && m.components > 1)
        each(Kind::vector_of_other_sign, {m.name, name}, [m](std::byte* r) {
          for (int k = 0; k < m.components; ++k) r[offset_of(m, k) + 3] ^= std::byte{0x80};
        });
    // Four components without names are a 2 x 2 matrix.
    std::vector<std::size_t> matrices;
    for (const scene::Member& m : record.members)
      if (m.scalar == scene::Scalar::float32 && m.components == 4) matrices.push_back(m.offset);
    if (!matrices.empty())
      each(Kind::matrices_transposed, {name}, [matrices](std::byte* r) {
        for (const std::size_t at : matrices) std::swap_ranges(r + at + 4, r + at + 8, r + at + 8);
      });
    const std::vector<Part> fields = float_parts(record);
    for (const Part& f : fields) {
      const auto changed = [&](Kind kind, float (*change)(float)) {
        each(kind, {f.name, name}, [at = f.offset, change](std::byte* r) { put_number(r, at, change(number_at<float>(r, at))); });
      };
      changed(Kind::field_left_out, [](float) { return 0.0f; });
      changed(Kind::field_left_out_of_product, [](float) { return 1.0f; });
      changed(Kind::field_of_other_sign, [](float v) { return -v; });
      changed(Kind::field_halved, [](float v) { return v / 2; });
      changed(Kind::field_doubled, [](float v) { return v * 2; });
      changed(Kind::field_squared, [](float v) { return v * v; });
      if (f.unit == "texel") changed(Kind::field_half_less, [](float v) { return v - 0.5f; });
      if (f.unit == "texel") changed(Kind::field_half_more, [](float v) { return v + 0.5f; });
      for (const Part& other : fields)
        if (&other != &f)
          each(Kind::field_is_another, {f.name, name, other.name},
               [to = f.offset, from = other.offset](std::byte* r) { std::memcpy(r + to, r + from, 4); });
      for (const Part& other : fields)
        if (&other > &f)
          each(Kind::fields_exchanged, {f.name, name, other.name},
               [a = f.offset, b = other.offset](std::byte* r) { std::swap_ranges(r + a, r + a + 4, r + b); });
    }
  }

 private:
  std::vector<Fault>& out_;
  const PassCase& c_;
};

}  // namespace

void add_scaled_inputs(std::vector<Fault>& out, const Probed& p) {
  const InputAdder add(out, p.c);
  for (std::size_t i = 0; i < p.c.inputs.size(); ++i) {
    if (p.c.inputs[i].array.is_records) continue;
    const auto scaled = [&](Kind kind, double by) {
      add.array(i, kind, {}, [by](Array& a) {
        recode(
            a, [by](double v) { return by * v; }, true);
      });
    };
    scaled(Kind::input_doubled, 2);
    scaled(Kind::input_halved, 0.5);
  }
}

void add_input_mixups(std::vector<Fault>& out, const Probed& p, bool images) {
  const InputAdder add(out, p.c);
  const std::string other = p.c.corrected() ? "as-published" : "corrected";
  add.add(Kind::other_formula, {other, p.c.variant}, [other](PassCase& c) { c.variant = other; });
  const std::vector<CaseInput>& all = p.c.inputs;
  for (std::size_t i = 0; i < all.size(); ++i) {
    if (all[i].array.is_records) add.records(i);
    if (all[i].array.is_records || !images) continue;
    add.image(i);
    for (std::size_t j = i + 1; j < all.size(); ++j) {
      const Array &a = all[i].array, &b = all[j].array;
      if (a.is_records || b.is_records || info(a.format).channels != info(b.format).channels) continue;
      add.add(Kind::inputs_exchanged, {all[i].name, all[j].name}, [i, j](PassCase& c) { std::swap(c.inputs[i].array, c.inputs[j].array); });
      for (const auto& [to, from] : {std::pair(i, j), std::pair(j, i)})
        add.add(Kind::input_is_another, {all[to].name, all[from].name},
                [to = to, from = from](PassCase& c) { c.inputs[to].array = c.inputs[from].array; });
    }
  }
}

namespace {

bool has_floats(const Array& a) {
  const FormatInfo::Kind kind = info(a.format).kind;
  return kind == FormatInfo::float16 || kind == FormatInfo::float32;
}
/// A decoded level.
struct Level {
  std::vector<float> values;
  int width, height, channels;
};
Level level_of(const Array& a, int level) {
  return {capture::decoded(a, level), a.level_width(level), a.level_height(level), info(a.format).channels};
}
/// Bilinear lookup at (u, v) of [0, 1].
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
/// Replaces level 0 by lookups at `lod` at its texels.
void coarsen(Array& a, double lod) {
  const FormatInfo& f = info(a.format);
  const int last = static_cast<int>(a.levels.size()) - 1;
  const double level = std::clamp(lod, 0.0, static_cast<double>(last));
  const int first = static_cast<int>(std::floor(level));
  const Level low = level_of(a, first), high = level_of(a, std::min(first + 1, last));
  const double share = level - first;
  std::byte* to = a.levels[0].edit().data();
  for (int y = 0; y < a.height; ++y)
    for (int x = 0; x < a.width; ++x)
      for (int k = 0; k < f.channels; ++k, to += f.channel_bytes) {
        const double u = (x + 0.5) / a.width, v = (y + 0.5) / a.height;
        const double at_first = filtered(low, u, v, k);
        const auto value = static_cast<float>(share == 0 ? at_first : at_first * (1 - share) + filtered(high, u, v, k) * share);
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
