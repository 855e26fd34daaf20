#include <algorithm>
#include <cmath>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "faults/case_adder.h"
#include "faults/whole_faults.h"
#include "image/colour.h"
#include "judge/rearrange.h"
#include "math/half.h"
#include "math/unorm.h"

namespace rainref::faults {
namespace {

using capture::Array;
using capture::CaseInput;
using capture::PassCase;

/// Passes the colours of every level through a function; codes become floats, which hold the result.
template <class Change>
void recode(Array& a, Change change, bool is_any = false) {
  const FormatInfo f = info(a.format);
  const bool to_floats = f.kind == FormatInfo::unorm8;
  for (std::vector<std::byte>& level : a.levels) {
    std::vector<std::byte> out;
    const std::size_t n = static_cast<std::size_t>(f.channel_bytes);
    for (std::size_t t = 0, k = 0; t + n <= level.size(); t += n, ++k) {
      float v = 0;
      if (f.kind == FormatInfo::float32) {
        std::memcpy(&v, &level[t], 4);
      } else if (f.kind == FormatInfo::float16) {
        Half h;
        std::memcpy(&h, &level[t], 2);
        v = to_float(h);
      } else {
        v = std::to_integer<int>(level[t]) / 255.0f;
      }
      const bool is_alpha = f.channels == 4 && k % 4 == 3;
      if (!is_alpha && (is_any || (v >= 0 && v <= 1))) v = static_cast<float>(change(v));
      if (f.kind == FormatInfo::float16) {
        const Half h = to_half(v);
        std::memcpy(&level[t], &h, 2);
        continue;
      }
      if (!to_floats) {
        std::memcpy(&level[t], &v, 4);
        continue;
      }
      const auto* bytes = reinterpret_cast<const std::byte*>(&v);
      out.insert(out.end(), bytes, bytes + 4);
    }
    if (to_floats) level = std::move(out);
  }
  if (to_floats) a.format = f.channels == 1 ? Format::r32f : Format::rgba32f;
}

/// Level k becomes level k + 1.
void drop_first_level(Array& a) {
  a.levels.erase(a.levels.begin());
  a.width = a.width > 1 ? a.width / 2 : 1;
  a.height = a.height > 1 ? a.height / 2 : 1;
}

void add_image(CaseAdder& add, const PassCase& c, std::size_t i) {
  const std::string name = c.inputs[i].name;
  const Array& a = c.inputs[i].array;
  const FormatInfo& f = info(a.format);
  const auto array = [&](std::string what, std::string sentence, std::function<void(Array&)> alter) {
    add(fmt::format("input {} {}", name, what), std::move(sentence), [i, alter](PassCase& altered) { alter(altered.inputs[i].array); });
  };
  for (const auto& [dx, dy, way] :
       {std::tuple(1, 0, "a column to the right"), {-1, 0, "a column to the left"}, {0, 1, "a row further on"}, {0, -1, "a row before"}})
    array(fmt::format("read {}", way), fmt::format("{} is read {}", name, way),
          [dx = dx, dy = dy](Array& to) { judge::shift(to, dx, dy); });
  if (a.width == a.height)
    array("with u and v exchanged", fmt::format("{} is read with u and v exchanged", name), [](Array& to) { judge::transpose(to); });
  if (a.levels.size() > 1) array("one level above", fmt::format("{} is read one level too coarse", name), drop_first_level);
  for (int from = 0; from < f.channels; ++from)
    for (int to = 0; to < f.channels; ++to) {
      if (from == to) continue;
      if (from < to && !(from == 0 && to == 1))
        array(fmt::format("with its {} and {} exchanged", "xyzw"[from], "xyzw"[to]),
              fmt::format("{} and {} of {} are exchanged", "xyzw"[from], "xyzw"[to], name),
              [from, to](Array& altered) { judge::swap_channels(altered, from, to); });
      if (f.channels > 2)
        array(fmt::format("with its {} for {}", "xyzw"[from], "xyzw"[to]),
              fmt::format("{}.{} is read where {}.{} is meant", name, "xyzw"[from], name, "xyzw"[to]),
              [from, to](Array& altered) { judge::copy_channel(altered, from, to); });
    }
  if (f.kind == FormatInfo::float16 || f.kind == FormatInfo::float32)
    for (int k = 0; k < f.channels; ++k) {
      const int last = (k + 1) * f.channel_bytes - 1, first = k * f.channel_bytes;
      array(fmt::format("with its {} negated", "xyzw"[k]), fmt::format("{}.{} has the other sign", name, "xyzw"[k]),
            [last](Array& altered) { judge::each_texel(altered, [last](std::byte* t) { t[last] ^= std::byte{0x80}; }); });
      array(fmt::format("without its {}", "xyzw"[k]), fmt::format("{}.{} counts as 0", name, "xyzw"[k]), [first, last](Array& altered) {
        judge::each_texel(altered, [first, last](std::byte* t) { std::fill(t + first, t + last + 1, std::byte{0}); });
      });
    }
  if (f.kind == FormatInfo::unorm8 || f.channels >= 3) {
    array("decoded once more", fmt::format("{} is taken for sRGB and decoded", name),
          [](Array& altered) { recode(altered, [](double v) { return decode_srgb(v); }); });
    array("still encoded", fmt::format("{} is not decoded: sRGB is taken for linear", name),
          [](Array& altered) { recode(altered, [](double v) { return encode_srgb(v); }); });
    array("decoded by a power of 2.2", fmt::format("{} is decoded by a power of 2.2", name),
          [](Array& altered) { recode(altered, [](double v) { return decode_gamma22(v); }); });
  }
  array("from 1 down", fmt::format("{} is taken from 1", name), [](Array& altered) { recode(altered, [](double v) { return 1 - v; }); });
  for (const Address address : {Address::clamp, Address::repeat, Address::mirror, Address::border}) {
    if (c.inputs[i].address_u == address && c.inputs[i].address_v == address) continue;
    const char* const words = address == Address::clamp    ? "clamped"
                              : address == Address::repeat ? "repeated"
                              : address == Address::mirror ? "mirrored"
                                                           : "0";
    add(fmt::format("input {} {} beyond its edge", name, words), fmt::format("beyond its edge {} is {}: another address mode", name, words),
        [i, address](PassCase& altered) {
          altered.inputs[i].address_u = altered.inputs[i].address_v = address;
          if (address == Address::border) altered.inputs[i].border = {};
        });
  }
}

/// Every record of a list with one thing of it changed.
void add_records(CaseAdder& add, const PassCase& c, std::size_t i) {
  const std::string name = c.inputs[i].name;
  const scene::UniformBlock record = c.inputs[i].array.record;
  add(fmt::format("input {} left out", name), fmt::format("no record of {} counts", name), [i](PassCase& altered) {
    altered.inputs[i].array.levels[0].clear();
    altered.inputs[i].array.width = 0;
  });
  const std::size_t count = record.size > 0 ? c.inputs[i].array.levels[0].size() / record.size : 0;
  constexpr std::size_t most_records = 40;
  for (std::size_t k = 1; k < std::min(count, most_records); ++k)
    add(fmt::format("loop over {} ends early", name),
        fmt::format("only the first {} records of {} count: the loop ends at one that it should only pass over",
                    k == 1 ? "one of the" : std::to_string(k), name),
        [i, k, size = record.size](PassCase& altered) {
          altered.inputs[i].array.levels[0].resize(k * size);
          altered.inputs[i].array.width = static_cast<int>(k);
        });
  struct Field {
    std::string name;
    std::size_t offset;
    bool is_in_texels;
  };
  std::vector<Field> fields;
  for (const scene::Member& m : record.members)
    for (int k = 0; m.scalar == scene::Scalar::float32 && !m.name.starts_with("padding") && k < m.components; ++k)
      fields.push_back({m.components == 1 ? m.name : fmt::format("{}.{}", m.name, "xyzw"[k]), m.offset + 4 * static_cast<std::size_t>(k),
                        m.unit == "texel"});
  const auto each = [&](std::string what, std::string sentence, std::function<void(std::byte*)> change) {
    add(std::move(what), std::move(sentence), [i, change, size = record.size](PassCase& altered) {
      std::vector<std::byte>& all = altered.inputs[i].array.levels[0];
      for (std::size_t r = 0; r + size <= all.size(); r += size) change(all.data() + r);
    });
  };
  for (const scene::Member& m : record.members) {
    if (m.scalar != scene::Scalar::float32 || m.components < 2) continue;
    each(fmt::format("{} of {} with the other sign", m.name, name), fmt::format("{} of {} points the other way", m.name, name),
         [m](std::byte* r) {
           for (int k = 0; k < m.components; ++k) r[m.offset + 4 * static_cast<std::size_t>(k) + 3] ^= std::byte{0x80};
         });
  }
  // What has four components and no name for each is a matrix of 2 x 2.
  std::vector<std::size_t> matrices;
  for (const scene::Member& m : record.members)
    if (m.scalar == scene::Scalar::float32 && m.components == 4) matrices.push_back(m.offset);
  if (!matrices.empty())
    each(fmt::format("matrices of {} transposed", name), fmt::format("rows and columns of the matrices of {} are exchanged", name),
         [matrices](std::byte* r) {
           for (const std::size_t at : matrices) std::swap_ranges(r + at + 4, r + at + 8, r + at + 8);
         });
  for (const Field& f : fields) {
    const auto scaled = [&](const char* what, const char* sentence, float (*change)(float)) {
      each(fmt::format("{} of {} {}", f.name, name, what), fmt::format("{} of {} {}", f.name, name, sentence),
           [offset = f.offset, change](std::byte* r) {
             float v;
             std::memcpy(&v, r + offset, 4);
             v = change(v);
             std::memcpy(r + offset, &v, 4);
           });
    };
    scaled("left out", "counts as 0", [](float) { return 0.0f; });
    scaled("left out of a product", "counts as 1", [](float) { return 1.0f; });
    scaled("with the other sign", "has the other sign", [](float v) { return -v; });
    scaled("halved", "is taken half as large: a diameter for a radius", [](float v) { return v / 2; });
    scaled("doubled", "is taken twice as large: a radius for a diameter", [](float v) { return v * 2; });
    scaled("squared", "is squared", [](float v) { return v * v; });
    if (f.is_in_texels) scaled("half a texel less", "is half a texel less", [](float v) { return v - 0.5f; });
    if (f.is_in_texels) scaled("half a texel more", "is half a texel more", [](float v) { return v + 0.5f; });
    for (const Field& other : fields)
      if (&other != &f)
        each(fmt::format("{} of {} is {}", f.name, name, other.name),
             fmt::format("of {} {} is read where {} is meant", name, other.name, f.name),
             [to = f.offset, from = other.offset](std::byte* r) { std::memcpy(r + to, r + from, 4); });
    for (const Field& other : fields)
      if (&other > &f)
        each(fmt::format("{} and {} of {} exchanged", f.name, other.name, name),
             fmt::format("of {} {} and {} have each other's value", name, f.name, other.name),
             [a = f.offset, b = other.offset](std::byte* r) { std::swap_ranges(r + a, r + a + 4, r + b); });
  }
}

}  // namespace

void add_scaled_inputs(std::vector<Fault>& out, const Probed& p) {
  CaseAdder add(out);
  for (std::size_t i = 0; i < p.c.inputs.size(); ++i) {
    if (p.c.inputs[i].array.is_records) continue;
    const std::string& name = p.c.inputs[i].name;
    add(fmt::format("input {} doubled", name), fmt::format("{} counts twice", name), [i](PassCase& c) {
      recode(
          c.inputs[i].array, [](double v) { return 2 * v; }, true);
    });
    add(fmt::format("input {} halved", name), fmt::format("{} counts half", name), [i](PassCase& c) {
      recode(
          c.inputs[i].array, [](double v) { return v / 2; }, true);
    });
  }
}

void add_input_mixups(std::vector<Fault>& out, const Probed& p, bool images) {
  CaseAdder add(out);
  const std::string other = p.c.corrected() ? "as-published" : "corrected";
  add(fmt::format("the {} formula", other), fmt::format("this is the {} formula of the pass, not the {} one", other, p.c.variant),
      [other](PassCase& c) { c.variant = other; });
  for (std::size_t i = 0; i < p.c.inputs.size(); ++i) {
    if (p.c.inputs[i].array.is_records) add_records(add, p.c, i);
    if (p.c.inputs[i].array.is_records || !images) continue;
    add_image(add, p.c, i);
    for (std::size_t j = i + 1; j < p.c.inputs.size(); ++j) {
      const Array &a = p.c.inputs[i].array, &b = p.c.inputs[j].array;
      if (a.is_records || b.is_records || info(a.format).channels != info(b.format).channels) continue;
      add(fmt::format("inputs {} and {} exchanged", p.c.inputs[i].name, p.c.inputs[j].name),
          fmt::format("{} and {} are bound in each other's place", p.c.inputs[i].name, p.c.inputs[j].name),
          [i, j](PassCase& c) { std::swap(c.inputs[i].array, c.inputs[j].array); });
      for (const auto& [to, from] : {std::pair(i, j), std::pair(j, i)})
        add(fmt::format("input {} is {}", p.c.inputs[to].name, p.c.inputs[from].name),
            fmt::format("{} is bound where {} is meant", p.c.inputs[from].name, p.c.inputs[to].name),
            [to = to, from = from](PassCase& c) { c.inputs[to].array = c.inputs[from].array; });
    }
  }
}

}  // namespace rainref::faults
