#include "capture/npy_write.h"

#include <cstring>
#include <string>

#include <fmt/format.h>

namespace rainref::capture {
namespace {

const char* type_text(FormatInfo::Kind kind) {
  switch (kind) {
    case FormatInfo::unorm8:
    case FormatInfo::srgb8:
      return "|u1";
    case FormatInfo::float16:
      return "<f2";
    case FormatInfo::float32:
      return "<f4";
    case FormatInfo::uint32:
      return "<u4";
  }
  return "";
}
const char* type_text(scene::Scalar scalar) {
  switch (scalar) {
    case scene::Scalar::float32:
      return "<f4";
    case scene::Scalar::int32:
      return "<i4";
    case scene::Scalar::uint32:
      return "<u4";
  }
  return "";
}

std::string record_text(const scene::UniformBlock& record) {
  std::string text = "[";
  std::size_t at = 0;
  const auto gap = [&](std::size_t to) {
    if (to > at) text += fmt::format("('', '|V{}'), ", to - at);
  };
  for (const scene::Member& m : record.members) {
    gap(m.offset);
    text += fmt::format("('{}', '{}'{}), ", m.name, type_text(m.scalar), m.components == 1 ? "" : fmt::format(", ({},)", m.components));
    at = m.offset + m.size();
  }
  gap(record.size);
  text.resize(text.size() - 2);
  return text + "]";
}

std::string header(const Array& array, int level) {
  std::string type, shape;
  if (array.is_records) {
    type = record_text(array.record);
    shape = fmt::format("({},)", array.width);
  } else {
    const FormatInfo& format = info(array.format);
    type = fmt::format("'{}'", type_text(format.kind));
    shape = fmt::format("({}, {}", array.level_height(level), array.level_width(level));
    shape += format.channels == 1 ? ")" : fmt::format(", {})", format.channels);
  }
  std::string text = fmt::format("{{'descr': {}, 'fortran_order': False, 'shape': {}, }}", type, shape);
  // Magic, version and length have ten bytes; the data start at a multiple of 64.
  constexpr std::size_t before = 10, alignment = 64;
  const std::size_t end = (before + text.size() + 1 + alignment - 1) / alignment * alignment;
  text.append(end - before - text.size() - 1, ' ');
  text += '\n';
  std::string out("\x93NUMPY\x01\x00", 8);
  out += static_cast<char>(text.size() & 0xff);
  out += static_cast<char>(text.size() >> 8);
  return out + text;
}

}  // namespace

std::vector<std::byte> npy_bytes(const Array& array, int level) {
  const std::string head = header(array, level);
  const std::vector<std::byte>& data = array.levels[static_cast<std::size_t>(level)];
  std::vector<std::byte> out(head.size() + data.size());
  std::memcpy(out.data(), head.data(), head.size());
  if (!data.empty()) std::memcpy(out.data() + head.size(), data.data(), data.size());
  return out;
}

}  // namespace rainref::capture
