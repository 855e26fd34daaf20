// Passes written from the documents alone. The functions are plain loops of floats that share nothing with the pass texts;
// written_test.cpp judges what they give. Who changes a formula of a document writes its function again.
#pragma once

#include <array>
#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <vector>

#include "capture/pass_case.h"
#include "faults/hand_made.h"
#include "judge/slots.h"

namespace rainref::documents {

using namespace faults::hand;
using faults::hand::dot, faults::hand::length, faults::hand::mix;  // beside those of Float2 below

/// What a pass gives for a case: images of zeros, empty lists.
class Given {
 public:
  /// `stores`: how halves are rounded; either: as the reference does.
  explicit Given(const capture::PassCase& c, judge::HalfMode stores = judge::HalfMode::either) : case_(c), stores_(stores) {
    for (const capture::CaseOutput& o : c.outputs) {
      capture::Array a = o.array;
      if (a.is_records) {
        a.levels = {{}};
        a.width = 0;
      } else {
        for (std::byte& b : a.levels[0].edit()) b = std::byte{0};
      }
      arrays.push_back(a);
    }
  }
  std::vector<capture::Array> arrays;

  int width(std::size_t output = 0) const { return arrays[output].width; }
  int height(std::size_t output = 0) const { return arrays[output].height; }
  std::size_t index(std::string_view name) const {
    for (std::size_t o = 0; o < case_.outputs.size(); ++o)
      if (case_.outputs[o].name == name) return o;
    throw std::runtime_error("no output " + std::string(name));
  }

  /// Stores as a device does.
  void store(std::size_t output, int x, int y, int k, float v) {
    capture::Array& a = arrays[output];
    const FormatInfo& f = info(a.format);
    const judge::Slot slot{
        static_cast<int>(output), k, f.kind, f.channel_bytes, f.texel_bytes(), a.width, case_.outputs[output].store_rounding, 1};
    judge::store_value(slot, v, judge::rounding_of(slot, stores_), a.levels[0].edit().data() + slot.offset(x, y));
  }
  template <class Record>
  void append(std::string_view list, const Record& record) {
    capture::Array& a = arrays[index(list)];
    if (sizeof record != a.record.size) throw std::runtime_error("another record " + a.record.name);
    const auto* bytes = reinterpret_cast<const std::byte*>(&record);
    a.levels[0].edit().insert(a.levels[0].end(), bytes, bytes + sizeof record);
    ++a.width;
  }

 private:
  const capture::PassCase& case_;
  judge::HalfMode stores_;
};

/// Every texel of the images by one loop, whose values lie in the order of outputs and channels.
inline void give_texels(Loop loop, const Run& run, Given& out) {
  std::array<float, 16> values{};
  for (int y = 0; y < out.height(); ++y)
    for (int x = 0; x < out.width(); ++x) {
      loop(run, x, y, values.data());
      std::size_t v = 0;
      for (std::size_t o = 0; o < out.arrays.size(); ++o)
        for (int k = 0; k < info(out.arrays[o].format).channels; ++k) out.store(o, x, y, k, values[v++]);
    }
}

/// A pass as one document prints it.
struct Written {
  std::vector<std::string> packs;
  std::string pass;
  std::string wrong;    ///< the mistake that is judged FAIL; "": the pass is data that no port is judged by
  Loop loop = nullptr;  ///< or:
  void (*give)(const Run& run, Given& out) = nullptr;
};

/// A texel of this colour and an alpha of 1.
inline bool give_opaque(float* out, Float3 colour) {
  out[0] = colour.x;
  out[1] = colour.y;
  out[2] = colour.z;
  out[3] = 1;
  return true;
}

/// A constant, and the wrong one of the negative control.
inline float constant(const Run& r, float right, float wrong) { return r.is("wrong constant") ? wrong : right; }

/// A number in a way that the small packs do not take, and the wrong one of branches_test.cpp.
inline float in_branch(const Run& r, float right, float wrong) { return r.is("wrong branch") ? wrong : right; }

// What every pass stands on, by docs/porting.md: functions here and in hand_made.h, lookups there. First what it takes from GLSL.
inline Float3 normalize(Float3 a) { return (1 / length(a)) * a; }
inline Float3 reflect(Float3 i, Float3 n) { return i - (2 * dot(n, i)) * n; }
inline Float3 refract(Float3 i, Float3 n, float eta) {
  const float cosine = dot(n, i), k = 1 - eta * eta * (1 - cosine * cosine);
  if (k < 0) return {};
  return eta * i - (eta * cosine + std::sqrt(k)) * n;
}
inline Float3 cross(Float3 a, Float3 b) { return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x}; }
inline float sine(float x) { return static_cast<float>(std::sin(static_cast<double>(x))); }
inline float cosine(float x) { return static_cast<float>(std::cos(static_cast<double>(x))); }
/// Formulas of the angle of a unit vector that engineers write instead; other_formulas_test.cpp asks for them.
enum class Arc : std::uint8_t { tangent, sine, cosine, polynomial };
inline thread_local Arc arc_formula = Arc::tangent;
/// acos as compilers for HLSL and Mesa have it (Abramowitz and Stegun, 4.4.45).
inline float arc_cosine_by_polynomial(float x) {
  const float a = std::abs(x), y = std::sqrt(1 - a) * (1.5707288f + a * (-0.2121144f + a * (0.0742610f + a * -0.0187293f)));
  return x < 0 ? 3.14159265f - y : y;
}
inline float arc(float y, float x) {
  const double r = std::sqrt(static_cast<double>(y) * y + static_cast<double>(x) * x);
  const bool is_unit = std::abs(r - 1) < 1e-5 && x >= 0;
  const auto held = [](double s) { return static_cast<float>(std::clamp(s, -1.0, 1.0)); };
  const float sine = held(is_unit ? y : y / r), cosine = held(x / r), sign = y < 0 ? -1.0f : 1.0f;
  switch (arc_formula) {
    case Arc::sine:
      if (x >= 0) return static_cast<float>(std::asin(static_cast<double>(sine)));
      break;
    case Arc::cosine:
      return is_unit ? 1.57079633f - static_cast<float>(std::acos(static_cast<double>(sine)))
                     : sign * static_cast<float>(std::acos(static_cast<double>(cosine)));
    case Arc::polynomial:
      return is_unit ? 1.57079633f - arc_cosine_by_polynomial(sine) : sign * arc_cosine_by_polynomial(cosine);
    case Arc::tangent:
      break;
  }
  return static_cast<float>(std::atan2(static_cast<double>(y), static_cast<double>(x)));
}
inline float cube_root(float x) { return power(x, 1 / 3.0f); }

struct Float2 {
  float x = 0, y = 0;
};
inline Float2 operator+(Float2 a, Float2 b) { return {a.x + b.x, a.y + b.y}; }
inline Float2 operator-(Float2 a, Float2 b) { return {a.x - b.x, a.y - b.y}; }
inline Float2 operator*(float s, Float2 a) { return {s * a.x, s * a.y}; }
inline float dot(Float2 a, Float2 b) { return a.x * b.x + a.y * b.y; }
inline float length(Float2 a) { return std::sqrt(dot(a, a)); }
inline float cross(Float2 a, Float2 b) { return a.x * b.y - a.y * b.x; }
inline Float2 mix(Float2 a, Float2 b, float t) { return {mix(a.x, b.x, t), mix(a.y, b.y, t)}; }
inline Float2 u2(const Run& r, std::string_view name) { return {r.u(name, 0), r.u(name, 1)}; }
inline Float2 linear2(const Run& r, std::string_view name, Float2 at, int k = 0) {
  return {r.linear(name, at.x, at.y, k), r.linear(name, at.x, at.y, k + 1)};
}

// Numbers without state, of puddle.md; other effects name it.
using Words = std::array<std::uint32_t, 4>;
inline Words pcg4d(Words v) {
  for (std::uint32_t& word : v) word = word * 1664525u + 1013904223u;
  const auto stir = [&] {
    v[0] += v[1] * v[3];
    v[1] += v[2] * v[0];
    v[2] += v[0] * v[1];
    v[3] += v[1] * v[2];
  };
  stir();
  for (std::uint32_t& word : v) word ^= word >> 16;
  stir();
  return v;
}
inline std::uint32_t word(const Run& r, std::string_view name, int k = 0) { return static_cast<std::uint32_t>(r.whole(name, k)); }
inline Words block(const Run& r, std::uint32_t purpose, std::uint32_t a, std::uint32_t b) {
  const Words k = pcg4d({word(r, "seed", 0), word(r, "seed", 1), purpose, 0});
  return pcg4d({a ^ k[0], b ^ k[1], k[2], k[3]});
}
/// A word of record i.
inline std::uint32_t word_of(const Run& r, std::string_view list, int i, std::string_view member) {
  return std::bit_cast<std::uint32_t>(r.of(list, i, member));
}

}  // namespace rainref::documents
