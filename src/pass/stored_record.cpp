#include "pass/stored_record.h"

#include <algorithm>

#include <fmt/format.h>

namespace rainref::pass {

std::vector<std::size_t> float_offsets(const scene::UniformBlock& record) {
  std::vector<std::size_t> all;
  for (const scene::Member& m : record.members)
    for (int k = 0; k < m.components && m.scalar == scene::Scalar::float32; ++k)
      all.push_back(m.offset + sizeof(float) * static_cast<std::size_t>(k));
  return all;
}

std::string ids_fault(std::string_view list, std::vector<std::uint32_t> ids) {
  std::sort(ids.begin(), ids.end());
  const auto twice = std::adjacent_find(ids.begin(), ids.end());
  return twice == ids.end() ? "" : fmt::format("in.{}: expected each id once, found {} twice", list, *twice);
}

}  // namespace rainref::pass
