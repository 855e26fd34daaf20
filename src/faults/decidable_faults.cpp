// Mistakes that need no search: the byte layout of an image, the effect of another format, of an exporter or of blending on its values, and
// a hash of fractions in half precision.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <set>
#include <string>
#include <vector>

#include "faults/generators.h"
#include "faults/image_faults.h"
#include "faults/members.h"
#include "judge/rearrange.h"
#include "math/half.h"

namespace rainref::faults {

using capture::Array;
using judge::Slot;
using perturbed::Op;
using perturbed::Substitution;
using perturbed::Trace;

namespace {

/// Row pitches that devices and APIs use for rows of `row` bytes.
std::set<std::size_t> usual_pitches(std::size_t row, std::size_t texel) {
  std::set<std::size_t> out;
  const auto add = [&](std::size_t multiple) {
    const std::size_t pitch = (row + multiple - 1) / multiple * multiple;
    if (pitch > row && pitch % texel == 0) out.insert(pitch);
  };
  for (const std::size_t bytes : {16, 32, 64, 128, 256, 512, 1024, 4096}) add(bytes);
  for (const std::size_t texels : {4, 8, 16, 32, 64, 128}) add(texels * texel);
  std::size_t texels = 1;
  while (texels * texel < row) texels *= 2;
  add(texels * texel);
  return out;
}

/// Memory with rows `pitch` bytes apart and zeros between, copied as if it were contiguous.
void take_as_tight(Array& a, std::size_t pitch) {
  const std::vector<std::byte> right = a.levels[0];
  std::vector<std::byte>& out = a.levels[0].edit();
  const std::size_t row = static_cast<std::size_t>(a.width) * a.element_bytes();
  std::fill(out.begin(), out.end(), std::byte{0});
  for (std::size_t y = 0; y * pitch < out.size(); ++y)
    std::memcpy(out.data() + y * pitch, right.data() + y * row, std::min(row, out.size() - y * pitch));
}
/// Contiguous memory, copied as if its rows were `pitch` bytes apart. Zeros follow its end.
void take_as_padded(Array& a, std::size_t pitch) {
  const std::vector<std::byte> right = a.levels[0];
  std::vector<std::byte>& out = a.levels[0].edit();
  const std::size_t row = static_cast<std::size_t>(a.width) * a.element_bytes();
  std::fill(out.begin(), out.end(), std::byte{0});
  for (std::size_t y = 0; y * row < out.size() && y * pitch < right.size(); ++y)
    std::memcpy(out.data() + y * row, right.data() + y * pitch, std::min(row, right.size() - y * pitch));
}

}  // namespace

void add_layout_faults(std::vector<Fault>& out, const capture::PassCase& c, const std::vector<Array>& port) {
  std::set<std::size_t> pitches;  // of all images
  for (const std::size_t o : enveloped_images(c)) {
    const Array& a = c.outputs[o].array;
    pitches.merge(usual_pitches(static_cast<std::size_t>(a.width) * a.element_bytes(), a.element_bytes()));
  }
  const auto has = [](const Array& a, std::size_t pitch) {
    const std::size_t row = static_cast<std::size_t>(a.width) * a.element_bytes();
    return usual_pitches(row, a.element_bytes()).contains(pitch);
  };
  const auto row_text = [](const Array& a) { return std::to_string(static_cast<std::size_t>(a.width) * a.element_bytes()); };
  for (const std::size_t pitch : pitches) {
    const auto add = [&](Kind kind, void (*relaid)(Array&, std::size_t)) {
      add_to_images(
          out, c, port,
          [=](const Array& a) {
            return What{kind, {std::to_string(pitch), row_text(a)}};
          },
          [=](Array& a, const Array&) {
            if (!has(a, pitch)) return false;
            relaid(a, pitch);
            return true;
          });
    };
    add(Kind::rows_taken_as_tight, take_as_tight);
    add(Kind::rows_taken_as_padded, take_as_padded);
  }
  add_to_images(out, c, port, Kind::half_a_turn, [](Array& a, const Array&) {
    judge::flip_rows(a);
    judge::flip_columns(a);
    return true;
  });
}

namespace {

/// Rounds to an unsigned float with `mantissa_bits` explicit mantissa bits and a half's exponent.
float unsigned_float(float v, int mantissa_bits, bool to_nearest) {
  if (!(v > 0)) return 0;
  if (std::isinf(v)) return v;
  int exponent;
  std::frexp(v, &exponent);
  const double step = std::ldexp(1.0, std::max(exponent - 1, -14) - mantissa_bits);
  const double steps = static_cast<double>(v) / step;
  return static_cast<float>((to_nearest ? std::nearbyint(steps) : std::floor(steps)) * step);
}

/// Changes every value before the store, for images of three or four channels of half or float.
void add_formats(std::vector<Fault>& out, const capture::PassCase& c) {
  const auto is_wide = [](const capture::PassCase& in, const Slot& s) {
    const Array& a = in.outputs[static_cast<std::size_t>(s.output)].array;
    return info(a.format).channels >= 3 && (s.kind == FormatInfo::float16 || s.kind == FormatInfo::float32);
  };
  const std::vector<Slot> slots = judge::slots_of(c);
  if (std::none_of(slots.begin(), slots.end(), [&](const Slot& s) { return is_wide(c, s); })) return;
  const auto add = [&](Kind kind, std::function<float(float, int channel)> change) {
    Fault& d = out.emplace_back(What{kind});
    std::vector<int> of;
    for (const Slot& s : slots)
      if (is_wide(c, s)) of.push_back(s.output);
    d.alter_value = [of, change](float v, const Slot& s) {
      return std::find(of.begin(), of.end(), s.output) != of.end() ? change(v, s.channel) : v;
    };
    d.stores = judge::HalfMode::rne;  // conversion to halves by another program is not the device's store
  };
  add(Kind::through_10_bits, [](float v, int channel) {
    const double most = channel == 3 ? 3 : 1023;
    return static_cast<float>(std::floor(std::clamp<double>(v, 0, 1) * most + 0.5) / most);
  });
  for (const bool to_nearest : {true, false})
    add(to_nearest ? Kind::through_11_bits : Kind::through_11_bits_cut,
        [to_nearest](float v, int channel) { return channel == 3 ? 1 : unsigned_float(v, channel == 2 ? 5 : 6, to_nearest); });
}

/// 10:10:10:2 codes read as four 8-bit codes: where they equal the reference's, the port's own bytes are explained.
void add_packed_codes(std::vector<Fault>& out, const capture::PassCase& c, const std::vector<Array>& port) {
  for (const bool is_red_first : {true, false})
    add_to_images(out, c, port, is_red_first ? Kind::rgb10_read_as_rgba8 : Kind::bgr10_read_as_rgba8, [=](Array& a, const Array& stored) {
      if (info(a.format).channels != 4 || info(a.format).channel_bytes != 1) return false;
      for (std::size_t t = 0; t + 4 <= a.levels[0].size(); t += 4) {
        std::uint32_t packed;
        std::memcpy(&packed, stored.levels[0].data() + t, 4);
        bool is_same = true;
        for (std::size_t k = 0; k < 4; ++k) {
          const std::uint32_t shift = k == 3 ? 30 : static_cast<std::uint32_t>(10 * (is_red_first ? k : 2 - k));
          const double code = k == 3 ? 85.0 * (packed >> 30) : (packed >> shift & 1023) * (255.0 / 1023);
          is_same &= std::abs(code - std::to_integer<int>(a.levels[0][t + k])) <= 1.25;
        }
        if (is_same) std::memcpy(a.levels[0].edit().data() + t, &packed, 4);
      }
      return true;
    });
}

/// Calls change(channel, alpha) for the three colours of each texel of an image with four channels of half or float.
template <class Change>
bool change_colours(Array& a, Change change) {
  const FormatInfo& f = info(a.format);
  if (a.is_records || f.channels != 4 || (f.kind != FormatInfo::float16 && f.kind != FormatInfo::float32)) return false;
  judge::each_texel(a, [&](std::byte* t) {
    const float alpha = channel_at(f, t + 3 * f.channel_bytes);
    for (int k = 0; k < 3; ++k) put_channel(f, t + k * f.channel_bytes, change(channel_at(f, t + k * f.channel_bytes), alpha));
  });
  return true;
}
void add_alpha(std::vector<Fault>& out, const Probed& p, const std::vector<Array>& port) {
  const capture::PassCase& c = p.c;
  for (const bool is_multiplied : {true, false}) {
    const auto change = [is_multiplied](float v, float alpha) { return is_multiplied ? v * alpha : alpha > 0 ? v / alpha : v; };
    const auto kind = [&](Kind multiplied, Kind divided) { return is_multiplied ? multiplied : divided; };
    add_to_images(out, c, port, kind(Kind::multiplied_by_alpha, Kind::divided_by_alpha),
                  [change](Array& a, const Array&) { return change_colours(a, change); });
    for (const capture::CaseInput& in : c.inputs) {
      if (in.array.is_records || info(in.array.format).channels != 4) continue;
      out.emplace_back(What{kind(Kind::input_multiplied_by_alpha, Kind::input_divided_by_alpha), {in.name}}).alter_case =
          [input = in.name, change](capture::PassCase& altered) {
            for (capture::CaseInput& i : altered.inputs)
              if (i.name == input) change_colours(i.array, change);
          };
    }
    for (const scene::Member& m : p.pass.block.members) {
      if (m.scalar != scene::Scalar::float32 || m.components != 4 || !is_colour(m)) continue;
      out.emplace_back(What{kind(Kind::uniform_multiplied_by_alpha, Kind::uniform_divided_by_alpha), {m.name}}).alter_case =
          [offset = m.offset, change](capture::PassCase& altered) {
            auto colour = number_at<std::array<float, 4>>(altered.uniforms.data(), offset);
            for (std::size_t k = 0; k < 3; ++k) colour[k] = change(colour[k], colour[3]);
            put_number(altered.uniforms.data(), offset, colour);
          };
    }
  }
}

}  // namespace

void add_format_faults(std::vector<Fault>& out, const Probed& p, const std::vector<Array>& port) {
  const capture::PassCase& c = p.c;
  add_formats(out, c);
  add_packed_codes(out, c, port);
  add_alpha(out, p, port);
  add_to_images(out, c, port, Kind::without_subnormals, [](Array& a, const Array&) {
    if (info(a.format).kind != FormatInfo::float16) return false;
    for (capture::Bytes& shared : a.levels) {
      std::vector<std::byte>& level = shared.edit();
      for (std::size_t at = 0; at + 2 <= level.size(); at += 2) {
        Half h;
        std::memcpy(&h, level.data() + at, 2);
        if ((h.bits & 0x7c00u) == 0) h.bits &= 0x8000u;
        std::memcpy(level.data() + at, &h, 2);
      }
    }
    return true;
  });
}

namespace {

/// Marks the nodes that depend on a fraction, in the order of the trace.
std::vector<bool> made_of_fractions(const Trace& trace) {
  std::vector<bool> out(trace.nodes.size(), false);
  for (std::size_t k = 0; k < trace.nodes.size(); ++k)
    for (const std::int32_t of : trace.nodes[k].of)
      if (of >= 0 && (out[static_cast<std::size_t>(of)] || trace.nodes[static_cast<std::size_t>(of)].op == Op::fract)) out[k] = true;
  return out;
}

/// Adds a fraction and its operands, down to the fractions inside and their arguments.
void gather(const Trace& trace, const std::vector<bool>& is_made_of, std::int32_t node, std::set<std::int32_t>& out) {
  if (node < 0 || !out.insert(node).second) return;
  const Trace::Node& n = trace.nodes[static_cast<std::size_t>(node)];
  for (const std::int32_t of : n.of) {
    if (of < 0) continue;
    const auto k = static_cast<std::size_t>(of);
    const bool is_leaf = trace.nodes[k].op == Op::constant || trace.nodes[k].op == Op::load || trace.nodes[k].op == Op::index;
    if (is_made_of[k] || trace.nodes[k].op == Op::fract)
      gather(trace, is_made_of, of, out);
    else if (n.op == Op::fract && !is_leaf)
      out.insert(of);
  }
}

/// Nodes of hashes: a fraction of a product that depends on three fractions or more, and all its operands.
std::set<std::int32_t> hashes_of(const Trace& trace) {
  const std::vector<bool> is_made_of = made_of_fractions(trace);
  std::set<std::int32_t> out;
  for (std::size_t k = 0; k < trace.nodes.size(); ++k) {
    if (trace.nodes[k].op != Op::fract || !is_made_of[k]) continue;
    std::set<std::int32_t> own;
    gather(trace, is_made_of, static_cast<std::int32_t>(k), own);
    std::size_t fractions = 0, products = 0;
    for (const std::int32_t node : own) {
      const Op op = trace.nodes[static_cast<std::size_t>(node)].op;
      fractions += op == Op::fract;
      products += op == Op::product;
    }
    if (fractions > 3 && products > 3) out.merge(own);
  }
  return out;
}

}  // namespace

void add_hash_faults(std::vector<Fault>& out, const Probed& p, Texel at) {
  const Trace trace = trace_of(p.model, at);
  const std::set<std::int32_t> hashes = hashes_of(trace);
  if (hashes.empty()) return;
  Fault d(What{Kind::hash_in_half});
  for (const std::int32_t node : hashes) {
    const Trace::Node& n = trace.nodes[static_cast<std::size_t>(node)];
    const auto round = [&](std::int8_t operand) {
      Substitution s;
      s.shape = n.shape;
      s.occurrence = n.occurrence;
      s.operand = operand;
      s.number = 1;
      s.how = perturbed::Put::times;
      s.last = perturbed::Change::as_half;
      d.substitutions.push_back(s);
    };
    for (std::size_t k = 0; k < n.of.size(); ++k)
      if (n.of[k] >= 0 && !hashes.contains(n.of[k])) round(static_cast<std::int8_t>(k));
    round(Substitution::result);
  }
  out.push_back(std::move(d));
}

}  // namespace rainref::faults
