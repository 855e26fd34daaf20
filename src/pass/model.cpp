#include "pass/model.h"

#include <cstring>

#include <fmt/format.h>

#include "rainref/error.h"

namespace rainref::pass {

void require_texels(const capture::PassCase& c, const capture::CaseInput& image, Format format) {
  const FormatInfo &expected = info(format), &found = info(image.array.format);
  const capture::Array& like = c.outputs.front().array;
  const bool is_code = expected.kind == FormatInfo::unorm8;
  if (expected.channels == found.channels && is_code == (found.kind == FormatInfo::unorm8) && image.array.width == like.width && image.array.height == like.height) return;
  throw Error(ExitCode::port_files, fmt::format("{}: in.{}: expected {} {}x{}, found {} {}x{}", c.folder(), image.name, expected.name, like.width, like.height, found.name, image.array.width, image.array.height));
}

void require_count(const capture::PassCase& c, const scene::UniformBlock& block, const In& list, std::size_t records) {
  for (const scene::Member& member : block.members) {
    if (member.name != list.count) continue;
    std::int32_t count = 0;
    std::memcpy(&count, c.uniforms.data() + member.offset, sizeof count);
    if (count >= 0 && static_cast<std::size_t>(count) <= records) return;
    throw Error(ExitCode::port_files, fmt::format("{}: uniform {}: expected 0 to {}, the records of in.{}, found {}", c.folder(), list.count, records, list.name, count));
  }
  throw Error(ExitCode::internal, fmt::format("{} has no uniform {}", block.name, list.count));
}

}  // namespace rainref::pass
