#include "capture/difference.h"

#include <bit>
#include <cstdint>
#include <cstring>

#include <fmt/format.h>

#include "math/half.h"
#include "math/unorm.h"

namespace rainref::capture {
namespace {

template <class T>
T load(const std::byte* at) {
  T value;
  std::memcpy(&value, at, sizeof value);
  return value;
}

std::string channel_text(const std::byte* at, FormatInfo::Kind kind) {
  switch (kind) {
    case FormatInfo::unorm8:
    case FormatInfo::srgb8: {
      const auto code = load<std::uint8_t>(at);
      return fmt::format("{} 0x{:02x}", to_float(Unorm8{code}), code);
    }
    case FormatInfo::float16: {
      const auto bits = load<std::uint16_t>(at);
      return fmt::format("{} 0x{:04x}", to_float(Half{bits}), bits);
    }
    case FormatInfo::float32:
      return scalar_text(at, scene::Scalar::float32);
    case FormatInfo::uint32:
      return scalar_text(at, scene::Scalar::uint32);
  }
  return "";
}

// One scalar of an element: a channel, a component of a record's member, or padding.
struct Part {
  std::string name;
  std::size_t offset, bytes;
  std::string (*text)(const std::byte* at);
};
template <scene::Scalar Kind>
std::string text_of(const std::byte* at) {
  return scalar_text(at, Kind);
}
template <FormatInfo::Kind Kind>
std::string text_of(const std::byte* at) {
  return channel_text(at, Kind);
}

std::vector<Part> parts_of(const Array& array) {
  std::vector<Part> parts;
  if (array.is_records) {
    for (const scene::Member& m : scene::with_padding(array.record)) {
      auto* const text = m.scalar == scene::Scalar::float32 ? text_of<scene::Scalar::float32>
                         : m.scalar == scene::Scalar::int32 ? text_of<scene::Scalar::int32>
                                                            : text_of<scene::Scalar::uint32>;
      for (int k = 0; k < m.components; ++k) {
        parts.push_back({m.components == 1 ? fmt::format("field {}", m.name) : fmt::format("field {}[{}]", m.name, k),
                         m.offset + 4 * static_cast<std::size_t>(k), 4, text});
      }
    }
    return parts;
  }
  const FormatInfo& format = info(array.format);
  std::string (*text)(const std::byte*) = nullptr;
  switch (format.kind) {
    case FormatInfo::unorm8:
    case FormatInfo::srgb8:
      text = text_of<FormatInfo::unorm8>;
      break;
    case FormatInfo::float16:
      text = text_of<FormatInfo::float16>;
      break;
    case FormatInfo::float32:
      text = text_of<FormatInfo::float32>;
      break;
    case FormatInfo::uint32:
      text = text_of<FormatInfo::uint32>;
      break;
  }
  const auto bytes = static_cast<std::size_t>(format.channel_bytes);
  for (int c = 0; c < format.channels; ++c)
    parts.push_back({fmt::format("channel {}", c), bytes * static_cast<std::size_t>(c), bytes, text});
  return parts;
}

}  // namespace

std::string scalar_text(const std::byte* at, scene::Scalar scalar) {
  const auto bits = load<std::uint32_t>(at);
  switch (scalar) {
    case scene::Scalar::float32:
      return fmt::format("{} 0x{:08x}", std::bit_cast<float>(bits), bits);
    case scene::Scalar::int32:
      return fmt::format("{} 0x{:08x}", std::bit_cast<std::int32_t>(bits), bits);
    case scene::Scalar::uint32:
      return fmt::format("{} 0x{:08x}", bits, bits);
  }
  return "";
}

bool same_shape(const Array& a, const Array& b) {
  if (a.is_records != b.is_records || a.width != b.width || a.height != b.height || a.levels.size() != b.levels.size()) return false;
  return a.is_records ? a.record.name == b.record.name && a.record.size == b.record.size : a.format == b.format;
}

std::string shape_text(const Array& array) {
  if (array.is_records) return fmt::format("{} record{} {}", array.width, array.width == 1 ? "" : "s", array.record.name);
  const std::string text = fmt::format("{} {}x{}", info(array.format).name, array.width, array.height);
  return array.levels.size() > 1 ? fmt::format("{} with {} levels", text, array.levels.size()) : text;
}

std::optional<Difference> first_difference(const Array& a, const Array& b) {
  if (a.levels == b.levels) return std::nullopt;
  const std::vector<Part> parts = parts_of(a);
  const std::size_t element = a.element_bytes();
  Difference out{};
  for (std::size_t level = 0; level < a.levels.size(); ++level) {
    const std::byte *left = a.levels[level].data(), *right = b.levels[level].data();
    const std::size_t elements = a.levels[level].size() / element;
    const auto columns = static_cast<std::size_t>(a.is_records ? a.width : a.level_width(static_cast<int>(level)));
    out.of += elements * parts.size();
    for (std::size_t i = 0; i < elements; ++i) {
      for (const Part& part : parts) {
        const std::size_t at = i * element + part.offset;
        if (std::memcmp(left + at, right + at, part.bytes) == 0 || out.count++ > 0) continue;
        out.place =
            a.is_records ? fmt::format("record {}, {}", i, part.name) : fmt::format("x {}, y {}, {}", i % columns, i / columns, part.name);
        if (level > 0) out.place = fmt::format("level {}, {}", level, out.place);
        out.a = part.text(left + at);
        out.b = part.text(right + at);
      }
    }
  }
  return out;
}

}  // namespace rainref::capture
