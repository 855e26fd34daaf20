// Members of uniform blocks and records, and their float components.
#pragma once

#include <cstddef>
#include <cstring>
#include <string>
#include <vector>

#include "scene/uniform_block.h"

namespace rainref::faults {

inline bool is_padding(const scene::Member& m) { return m.name.starts_with("padding"); }
/// True for a level of detail.
inline bool is_level(const scene::Member& m) { return m.name.ends_with("lod") || m.name.ends_with("level"); }
inline bool is_colour(const scene::Member& m) { return m.name.ends_with("color"); }
/// True if the names differ only in their axis, such as e_u and e_v.
inline bool are_axes(const scene::Member& u, const scene::Member& v) {
  return u.name.ends_with("_u") && v.name == u.name.substr(0, u.name.size() - 1) + "v";
}
/// Equal for members that are easily confused: the name without its last word, and the unit.
inline std::string family(const scene::Member& m) { return m.name.substr(0, m.name.find_last_of('_') + 1) + m.unit; }

inline std::string component_name(int k) { return std::string(1, "xyzw"[k & 3]); }
/// Name of component k: "wind.x"; for a scalar its own name.
inline std::string part_name(const scene::Member& m, int k) { return m.components == 1 ? m.name : m.name + "." + component_name(k); }
inline std::size_t offset_of(const scene::Member& m, int k) { return m.offset + 4 * static_cast<std::size_t>(k); }

/// A float of a block or record.
struct Part {
  std::string name, unit;
  std::size_t offset;
};
/// All float components but padding.
inline std::vector<Part> float_parts(const scene::UniformBlock& layout) {
  std::vector<Part> out;
  for (const scene::Member& m : layout.members)
    for (int k = 0; m.scalar == scene::Scalar::float32 && !is_padding(m) && k < m.components; ++k)
      out.push_back({part_name(m, k), m.unit, offset_of(m, k)});
  return out;
}

template <class T>
T number_at(const std::byte* bytes, std::size_t offset) {
  T out;
  std::memcpy(&out, bytes + offset, sizeof out);
  return out;
}
template <class T>
void put_number(std::byte* bytes, std::size_t offset, T number) {
  std::memcpy(bytes + offset, &number, sizeof number);
}

}  // namespace rainref::faults
