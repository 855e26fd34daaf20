#include "pass/fit.h"

#include <algorithm>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "rainref/error.h"

namespace rainref::pass {

std::string records_fault(const scene::UniformBlock& block, std::span<const std::byte> uniforms, const In& list, std::size_t records) {
  if (list.records != 0 && records != list.records)
    return fmt::format("in.{}: expected {} record{}, found {}", list.name, list.records, list.records == 1 ? "" : "s", records);
  if (list.count.empty()) return "";
  const auto member =
      std::find_if(block.members.begin(), block.members.end(), [&](const scene::Member& m) { return m.name == list.count; });
  if (member == block.members.end()) throw Error(ExitCode::internal, fmt::format("{} has no uniform {}", block.name, list.count));
  std::int32_t count = 0;
  std::memcpy(&count, uniforms.data() + member->offset, sizeof count);
  if (count >= 0 && static_cast<std::size_t>(count) <= records) return "";
  return fmt::format("uniform {}: expected 0 to {}, the records of in.{}, found {}", list.count, records, list.name, count);
}

}  // namespace rainref::pass
