// What a hostile or broken exporter could make of a small pack: a program of edits, read from the fuzzer's bytes.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "capture/pass_case.h"
#include "capture/pass_info.h"

namespace rainref::fuzz {

/// The fuzzer's bytes, one number after the other; zeros behind their end.
class Program {
 public:
  explicit Program(std::span<const std::byte> bytes) : bytes_(bytes) {}
  bool ended() const { return at_ >= bytes_.size(); }
  std::uint32_t next() { return ended() ? 0 : static_cast<std::uint32_t>(bytes_[at_++]); }
  /// Below `limit`, which is at least 1.
  std::size_t below(std::size_t limit) { return (limit > 256 ? next() << 8 | next() : next()) % limit; }
  template <class T>
  const T& one_of(const std::vector<T>& all) {
    return all[below(all.size())];
  }
  float number() {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    constexpr std::array all{0.0f,   -0.0f,   1.0f,    -1.0f,    0.5f,    2.0f,    200.0f,    -200.0f,
                             1e5f,   -1e5f,   1e9f,    -1e9f,    3e38f,   -3e38f,  1e-45f,    1e-30f,
                             7.25f,  64.0f,   4096.0f, 65536.0f, 0x1p24f, 0x1p31f, -0x1p31f,  1e-7f,
                             0.999f, -0.001f, 1.0001f, infinity, 1e-3f,   3.0f,    -infinity, std::bit_cast<float>(0x7fc00000u)};
    const std::uint32_t kind = next();
    if (kind < 240) return all[kind % all.size()];
    return std::bit_cast<float>(next() | next() << 8 | next() << 16 | next() << 24);
  }
  std::uint32_t word() {
    constexpr std::array<std::uint32_t, 12> all{0, 1, 2, 3, 7, 100, 4096, 65536, 1u << 24, 0x7fffffffu, 0x80000000u, 0xffffffffu};
    return all[next() % all.size()];
  }

 private:
  std::span<const std::byte> bytes_;
  std::size_t at_ = 0;
};

inline capture::Array& array_of(capture::PassCase& c, Program& p) {
  const std::size_t count = c.inputs.size() + c.outputs.size(), at = p.below(count);
  return at < c.inputs.size() ? c.inputs[at].array : c.outputs[at - c.inputs.size()].array;
}
/// The array in another size, its values cut off, or repeated.
inline void resize(capture::Array& a, int width, int height) {
  const std::vector<capture::Bytes> old = a.levels;
  const int old_width = a.width, old_height = std::max(a.is_records ? 1 : a.height, 1);
  a.width = width;
  a.height = height;
  const std::size_t size = a.element_bytes();
  for (std::size_t l = 0; l < a.levels.size(); ++l) {
    const int level = static_cast<int>(l), w = a.is_records ? width : a.level_width(level), h = a.is_records ? 1 : a.level_height(level);
    const int from_w = std::max(a.is_records ? old_width : old_width >> level, 1), from_h = std::max(old_height >> level, 1);
    std::vector<std::byte> to(static_cast<std::size_t>(w) * static_cast<std::size_t>(h) * size);
    for (int y = 0; y < h && !old[l].empty(); ++y)
      for (int x = 0; x < w; ++x) {
        const std::size_t from =
            (static_cast<std::size_t>(y % from_h) * static_cast<std::size_t>(from_w) + static_cast<std::size_t>(x % from_w)) * size;
        if (from + size > old[l].size()) continue;  // of a format that was changed
        std::memcpy(&to[(static_cast<std::size_t>(y) * static_cast<std::size_t>(w) + static_cast<std::size_t>(x)) * size], &old[l][from],
                    size);
      }
    a.levels[l] = std::move(to);
  }
}

/// One change of what a case holds; its files and the manifest will agree with it.
inline void edit_case(capture::PassCase& c, const scene::UniformBlock& block, Program& p) {
  switch (p.below(7)) {
    case 0:
    case 1: {  // a uniform
      const scene::Member& m = p.one_of(block.members);
      std::byte* at = c.uniforms.data() + m.offset + 4 * p.below(static_cast<std::size_t>(m.components));
      const float number = p.number();
      const std::uint32_t word = p.word();
      std::memcpy(at, m.scalar == scene::Scalar::float32 ? static_cast<const void*>(&number) : &word, 4);
      return;
    }
    case 2: {  // a size
      capture::Array& a = array_of(c, p);
      constexpr int sides[] = {0, 1, 2, 3, 5, 8, 13, 17, 64, 256};
      const int width = sides[p.below(std::size(sides))], height = sides[p.below(std::size(sides))];
      if (a.is_records)
        resize(a, width, 1);
      else
        resize(a, std::max(width, 1), std::max(height, 1));
      return;
    }
    case 3: {  // a value
      capture::Array& a = array_of(c, p);
      std::vector<std::byte>& bytes = a.levels[p.below(a.levels.size())].edit();
      const float number = p.number();
      const std::size_t at = p.below(std::max<std::size_t>(bytes.size() / 4, 1)) * 4;
      // The upper half of a float is much like a half of the same kind.
      if (bytes.size() >= at + 4)
        std::memcpy(&bytes[at], &number, 4);
      else if (bytes.size() >= 2)
        std::memcpy(bytes.data(), reinterpret_cast<const char*>(&number) + 2, 2);
      return;
    }
    case 4: {  // a format
      capture::Array& a = array_of(c, p);
      if (a.is_records) return;
      constexpr Format formats[] = {Format::r8,      Format::rg8,  Format::rgba8, Format::r16f,    Format::rg16f,
                                    Format::rgba16f, Format::r32f, Format::rg32f, Format::rgba32f, Format::r32ui};
      a.format = formats[p.below(std::size(formats))];
      for (std::size_t l = 0; l < a.levels.size(); ++l) {
        const int level = static_cast<int>(l);
        a.levels[l].edit().resize(static_cast<std::size_t>(a.level_width(level)) * static_cast<std::size_t>(a.level_height(level)) *
                                  a.element_bytes());
      }
      return;
    }
    case 5: {  // mip levels
      capture::Array& a = array_of(c, p);
      if (a.is_records) return;
      a.levels.resize(1 + p.below(7));
      for (std::size_t l = 1; l < a.levels.size(); ++l) {
        const int level = static_cast<int>(l);
        a.levels[l].edit().resize(static_cast<std::size_t>(a.level_width(level)) * static_cast<std::size_t>(a.level_height(level)) *
                                  a.element_bytes());
      }
      return;
    }
    case 6: {  // rules
      if (c.inputs.empty()) return;
      capture::CaseInput& input = c.inputs[p.below(c.inputs.size())];
      input.address_u = static_cast<Address>(p.below(4));
      input.address_v = static_cast<Address>(p.below(4));
      input.filter = static_cast<Filter>(p.below(3));
      input.mip_filter = static_cast<Filter>(p.below(3));
      c.level = static_cast<int>(p.below(4)) - 1;
      return;
    }
  }
}

/// One change of the manifest, wherever in it.
inline void edit_manifest(nlohmann::ordered_json& manifest, Program& p) {
  nlohmann::ordered_json* at = &manifest;
  const nlohmann::ordered_json::json_pointer first_case("/cases/0");
  if (p.below(4) > 0 && manifest.is_object() && manifest.contains(first_case)) at = &manifest[first_case];
  while (at->is_structured() && !at->empty()) {
    nlohmann::ordered_json& child = *std::next(at->begin(), static_cast<std::ptrdiff_t>(p.below(at->size())));
    if (!child.is_structured() || p.below(4) == 0) {
      switch (p.below(8)) {
        case 0:
          at->erase(std::next(at->begin(), static_cast<std::ptrdiff_t>(p.below(at->size()))));
          return;
        case 1:
          child = p.word();
          return;
        case 2:
          child = -1;
          return;
        case 3:
          child = nullptr;
          return;
        case 4:
          child = "envelope";
          return;
        case 5:
          child = "records";
          return;
        case 6:
          if (at->is_array()) {
            const nlohmann::ordered_json copy = child;
            at->push_back(copy);
          } else {
            child = nlohmann::ordered_json::array();
          }
          return;
        default: {
          const nlohmann::ordered_json& other = *std::next(at->begin(), static_cast<std::ptrdiff_t>(p.below(at->size())));
          const nlohmann::ordered_json copy = other;
          child = copy;
          return;
        }
      }
    }
    at = &child;
  }
}

}  // namespace rainref::fuzz
