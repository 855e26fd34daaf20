#include "spirv/stored_image.h"

#include <cstring>

#include <fmt/format.h>

#include "math/half.h"
#include "math/unorm.h"
#include "rainref/error.h"

namespace rainref::spirv {
namespace {

// Calls f with a channel's storage type.
template <class F>
void with_stored(FormatInfo::Kind kind, const F& f) {
  if (kind == FormatInfo::float16) return f(Half{});
  if (kind == FormatInfo::unorm8) return f(Unorm8{});
  f(float{});
}

}  // namespace

StoredImage::StoredImage(const capture::CaseOutput& output)
    : StorageImage(output.array.width, output.array.height),
      array_(output.array),
      format_(info(output.array.format)),
      rounding_(output.store_rounding) {
  if (format_.kind == FormatInfo::srgb8 || format_.kind == FormatInfo::uint32)
    throw Error(ExitCode::port_files, fmt::format("output '{}': a shader stores no {}", output.name, format_.name));
  const auto texels = static_cast<std::size_t>(width()) * static_cast<std::size_t>(height());
  array_.levels.assign(1, std::vector<std::byte>(texels * array_.element_bytes()));
}

std::size_t StoredImage::offset(int x, int y, int channel) const {
  const auto texel = static_cast<std::size_t>(y) * static_cast<std::size_t>(width()) + static_cast<std::size_t>(x);
  return texel * array_.element_bytes() + static_cast<std::size_t>(channel * format_.channel_bytes);
}
void StoredImage::write(int x, int y, const Float* texel, int count) {
  for (int k = 0; k < format_.channels && k < count; ++k) {
    with_stored(format_.kind, [&](auto stored) {
      scalar::store(&stored, texel[k], rounding_);
      std::memcpy(array_.levels[0].edit().data() + offset(x, y, k), &stored, sizeof stored);
    });
  }
}
void StoredImage::read(int x, int y, Float* texel) const {
  for (int k = 0; k < 4; ++k) {
    texel[k] = Float(k == 3 ? 1.0f : 0.0f);
    if (k >= format_.channels) continue;
    with_stored(format_.kind, [&](auto stored) {
      std::memcpy(&stored, array_.levels[0].data() + offset(x, y, k), sizeof stored);
      texel[k] = Float::load(&stored);
    });
  }
}

}  // namespace rainref::spirv
