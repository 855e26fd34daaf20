#include "capture/bound_texture.h"

#include <algorithm>

#include <fmt/format.h>

#include "image/colour.h"
#include "math/half.h"
#include "math/unorm.h"
#include "rainref/error.h"

namespace rainref::capture {
namespace {

template <class Stored, class Decode>
void decode_all(const std::vector<std::byte>& bytes, std::vector<float>& out, Decode decode) {
  out.resize(bytes.size() / sizeof(Stored));
  for (std::size_t i = 0; i < out.size(); ++i) {
    Stored s;
    std::memcpy(&s, bytes.data() + i * sizeof(Stored), sizeof(Stored));
    out[i] = decode(s);
  }
}
const CaseInput& input_of(const PassCase& c, std::string_view name, bool records) {
  const CaseInput* input = c.input(name);
  if (!input) throw Error(ExitCode::port_files, fmt::format("{}: input '{}' is missing", c.folder(), name));
  if (input->array.is_records != records)
    throw Error(ExitCode::port_files, fmt::format("{}: input '{}': expected {}", c.folder(), name, records ? "records" : "an image"));
  return *input;
}

}  // namespace

std::vector<float> decoded(const Array& image, int level) {
  const std::vector<std::byte>& bytes = image.levels.at(static_cast<std::size_t>(level));
  std::vector<float> out;
  switch (info(image.format).kind) {
    case FormatInfo::unorm8:
      decode_all<Unorm8>(bytes, out, [](Unorm8 u) { return to_float(u); });
      break;
    case FormatInfo::srgb8:
      decode_all<Unorm8>(bytes, out, [](Unorm8 u) { return static_cast<float>(decode_srgb(u.code / 255.0)); });
      break;
    case FormatInfo::float16:
      decode_all<Half>(bytes, out, [](Half h) { return to_float(h); });
      break;
    case FormatInfo::float32:
      decode_all<float>(bytes, out, [](float x) { return x; });
      break;
    case FormatInfo::uint32:
      decode_all<std::uint32_t>(bytes, out, [](std::uint32_t i) { return static_cast<float>(i); });
      break;
  }
  return out;
}

BoundTexture::BoundTexture(const CaseInput& input, int first, int count) {
  const Array& a = input.array;
  const int channels = info(a.format).channels, taken = count > 0 ? count : channels - first;
  view_.channels = taken;
  view_.levels = std::min(static_cast<int>(a.levels.size()), Texture::max_levels);
  const FormatInfo::Kind kind = info(a.format).kind;
  view_.precision = kind == FormatInfo::float16                               ? TexelPrecision::float16
                    : kind == FormatInfo::unorm8 || kind == FormatInfo::srgb8 ? TexelPrecision::unorm8
                                                                              : TexelPrecision::float32;
  view_.address_u = input.address_u;
  view_.address_v = input.address_v;
  for (int c = 0; c < taken; ++c) view_.border[c] = input.border[static_cast<std::size_t>(first + c)];
  for (int l = 0; l < view_.levels; ++l) {
    view_.width[l] = a.level_width(l);
    view_.height[l] = a.level_height(l);
    view_.offset[l] = static_cast<std::int32_t>(texels_.size() / static_cast<std::size_t>(taken));
    const std::vector<float> all = decoded(a, l);
    for (std::size_t i = 0; i + static_cast<std::size_t>(channels) <= all.size(); i += static_cast<std::size_t>(channels)) {
      for (int c = 0; c < taken; ++c) texels_.push_back(all[i + static_cast<std::size_t>(first + c)]);
    }
  }
}
Texture BoundTexture::view() const {
  Texture t = view_;
  t.texels = texels_.data();
  return t;
}

const CaseInput& image_input(const PassCase& c, std::string_view name) { return input_of(c, name, false); }
const CaseInput& record_input(const PassCase& c, std::string_view name) { return input_of(c, name, true); }

void copy_uniforms(const PassCase& c, void* to, std::size_t bytes) {
  if (c.uniforms.size() != bytes)
    throw Error(ExitCode::port_files, fmt::format("{}: uniform block: expected {} bytes, found {}", c.folder(), bytes, c.uniforms.size()));
  std::memcpy(to, c.uniforms.data(), bytes);
}
const std::byte* record_bytes(const CaseInput& input, std::size_t record_size) {
  const Array& a = input.array;
  if (a.record.size != record_size)
    throw Error(ExitCode::port_files,
                fmt::format("input '{}': expected records of {} bytes, found {}", input.name, record_size, a.record.size));
  return a.levels.at(0).data();
}

}  // namespace rainref::capture
