#include "port_dump/dds.h"

#include <algorithm>
#include <array>
#include <cstring>
#include <utility>

#include <fmt/format.h>

#include "rainref/error.h"

namespace rainref::port_dump {
namespace {

using Kind = FormatInfo::Kind;

constexpr std::size_t header_end = 128, dx10_end = 148;
constexpr std::uint32_t max_side = 65536;

struct PixelFormat {
  std::uint32_t dxgi;
  std::string_view name;
  Kind kind;
  std::size_t channels;
  bool is_bgra = false;
  std::size_t unused_bytes = 0;  // after the channels of a texel
};
// DXGI_FORMAT values. Typeless formats have the name of rainref's type for them.
constexpr std::array<PixelFormat, 23> dxgi_formats{{{1, "R32G32B32A32_TYPELESS", Kind::float32, 4},
                                                    {2, "R32G32B32A32_FLOAT", Kind::float32, 4},
                                                    {6, "R32G32B32_FLOAT", Kind::float32, 3},
                                                    {9, "R16G16B16A16_TYPELESS", Kind::float16, 4},
                                                    {10, "R16G16B16A16_FLOAT", Kind::float16, 4},
                                                    {15, "R32G32_TYPELESS", Kind::float32, 2},
                                                    {16, "R32G32_FLOAT", Kind::float32, 2},
                                                    {27, "R8G8B8A8_TYPELESS", Kind::unorm8, 4},
                                                    {28, "R8G8B8A8_UNORM", Kind::unorm8, 4},
                                                    {29, "R8G8B8A8_UNORM_SRGB", Kind::srgb8, 4},
                                                    {33, "R16G16_TYPELESS", Kind::float16, 2},
                                                    {34, "R16G16_FLOAT", Kind::float16, 2},
                                                    {40, "D32_FLOAT", Kind::float32, 1},
                                                    {41, "R32_FLOAT", Kind::float32, 1},
                                                    {42, "R32_UINT", Kind::uint32, 1},
                                                    {48, "R8G8_TYPELESS", Kind::unorm8, 2},
                                                    {49, "R8G8_UNORM", Kind::unorm8, 2},
                                                    {54, "R16_FLOAT", Kind::float16, 1},
                                                    {61, "R8_UNORM", Kind::unorm8, 1},
                                                    {87, "B8G8R8A8_UNORM", Kind::unorm8, 4, true},
                                                    {88, "B8G8R8X8_UNORM", Kind::unorm8, 3, true, 1},
                                                    {91, "B8G8R8A8_UNORM_SRGB", Kind::srgb8, 4, true},
                                                    {93, "B8G8R8X8_UNORM_SRGB", Kind::srgb8, 3, true, 1}}};

struct Reader {
  std::span<const std::byte> bytes;
  const std::string& file;

  std::uint32_t u32(std::size_t at) const {  // requires at + 4 within the bytes
    std::uint32_t value;
    std::memcpy(&value, bytes.data() + at, sizeof value);
    return value;
  }
  [[noreturn]] void refuse(const std::string& why) const { throw Error(ExitCode::port_files, fmt::format("{}: {}", file, why)); }
};

const PixelFormat* dxgi_format(std::uint32_t dxgi) {
  for (const PixelFormat& format : dxgi_formats) {
    if (format.dxgi == dxgi) return &format;
  }
  return nullptr;
}

bool is_block_compressed(std::uint32_t dxgi) { return (dxgi >= 70 && dxgi <= 84) || (dxgi >= 94 && dxgi <= 99); }

PixelFormat format_of_dx10(const Reader& in) {
  if (in.bytes.size() < dx10_end) in.refuse("truncated in its DX10 header");
  const std::uint32_t dxgi = in.u32(128), dimension = in.u32(132), flags = in.u32(136), array_size = in.u32(140);
  constexpr std::uint32_t texture_2d = 3, cube = 4;
  if (dimension != texture_2d) in.refuse("expected a two-dimensional texture");
  if (flags & cube) in.refuse("a cube; save its faces one by one");
  if (array_size != 1) in.refuse(fmt::format("an array of {} textures; save them one by one", array_size));
  if (is_block_compressed(dxgi)) in.refuse("block compression (BC) is lossy; export it uncompressed");
  const PixelFormat* format = dxgi_format(dxgi);
  if (!format) in.refuse(fmt::format("DXGI format {} is none that a buffer of rainref has", dxgi));
  return *format;
}

PixelFormat format_of_code(const Reader& in, std::uint32_t code) {
  // D3DFMT_R16F ... D3DFMT_A32B32G32R32F, as DXGI formats.
  constexpr std::array<std::uint32_t, 6> floats{54, 34, 10, 41, 16, 2};
  if (code >= 111 && code <= 116) return *dxgi_format(floats[code - 111]);
  std::string text;
  for (int i = 0; i < 4; ++i) {
    const char c = static_cast<char>(code >> 8 * i);
    text += c >= 0x20 && c <= 0x7e ? c : '?';
  }
  if (text.starts_with("DXT") || text.starts_with("ATI") || text.starts_with("BC")) {
    in.refuse(fmt::format("'{}': block compression is lossy; export it uncompressed", text));
  }
  in.refuse(fmt::format("pixel format '{}' (0x{:08x}) is none that a buffer of rainref has; export with a DX10 header", text, code));
}

PixelFormat format_of_header(const Reader& in) {
  constexpr std::uint32_t four_cc = 0x4, rgb = 0x40, luminance = 0x20000;
  const std::uint32_t flags = in.u32(80), code = in.u32(84), bits = in.u32(88);
  const std::array<std::uint32_t, 4> masks{in.u32(92), in.u32(96), in.u32(100), in.u32(104)};
  if (in.u32(76) != 32) in.refuse("damaged: the size of its pixel format is not 32");
  if (flags & four_cc) return code == 0x30315844 ? format_of_dx10(in) : format_of_code(in, code);  // "DX10"
  using Masks = std::array<std::uint32_t, 4>;
  if ((flags & rgb) && bits == 32 && masks == Masks{0xff, 0xff00, 0xff0000, 0xff000000}) return *dxgi_format(28);
  if ((flags & rgb) && bits == 32 && masks == Masks{0xff0000, 0xff00, 0xff, 0xff000000}) return *dxgi_format(87);
  if ((flags & rgb) && bits == 32 && masks == Masks{0xff0000, 0xff00, 0xff, 0}) return *dxgi_format(88);
  if ((flags & luminance) && bits == 8 && masks[0] == 0xff) return *dxgi_format(61);
  in.refuse(
      fmt::format("pixel format of {} bits with masks {:08x} {:08x} {:08x} {:08x} is none that a buffer of rainref has; "
                  "export with a DX10 header",
                  bits, masks[0], masks[1], masks[2], masks[3]));
}

StoredImage level_of(const PixelFormat& format, const std::string& file, std::size_t width, std::size_t height) {
  StoredImage out;
  out.file = file;
  out.width = width;
  out.height = height;
  out.set_channels(format.kind, format.channels);
  if (format.is_bgra) std::swap(out.channels[0].offset, out.channels[2].offset);
  out.texel_bytes += format.unused_bytes;
  out.row_pitch = width * out.texel_bytes;
  return out;
}

}  // namespace

Dds parse_dds(std::span<const std::byte> bytes, const std::string& file) {
  const Reader in{bytes, file};
  if (bytes.empty()) in.refuse("empty file");
  if (std::memcmp(bytes.data(), "DDS ", std::min<std::size_t>(bytes.size(), 4)) != 0) in.refuse("not a DDS file");
  if (bytes.size() < header_end) in.refuse("truncated in its DDS header");
  if (in.u32(4) != 124) in.refuse("damaged: the size of its DDS header is not 124");
  const std::uint32_t flags = in.u32(8), height = in.u32(12), width = in.u32(16), pitch = in.u32(20), caps2 = in.u32(112);
  constexpr std::uint32_t has_pitch = 0x8, has_levels = 0x20000, cube = 0x200, volume = 0x200000;
  if (width < 1 || height < 1 || width > max_side || height > max_side) {
    in.refuse(fmt::format("size {}x{}: each side must be from 1 to {}", width, height, max_side));
  }
  if (caps2 & cube) in.refuse("a cube; save its faces one by one");
  if (caps2 & volume) in.refuse("a volume; save its slices one by one");
  const PixelFormat format = format_of_header(in);
  const std::size_t start = in.u32(80) & 0x4 && in.u32(84) == 0x30315844 ? dx10_end : header_end;
  // Writers omit the flag or the count if there is one level.
  const std::uint32_t count = (flags & has_levels) || in.u32(28) > 1 ? std::max<std::uint32_t>(in.u32(28), 1) : 1;
  if (count > 17) in.refuse(fmt::format("{} mip levels; {}x{} has at most 17", count, width, height));

  Dds out{{}, std::string(format.name), format.kind == Kind::srgb8};
  std::uint64_t expected = 0;
  for (std::uint32_t l = 0; l < count; ++l) {
    out.levels.push_back(level_of(format, file, std::max(width >> l, 1u), std::max(height >> l, 1u)));
    expected += std::uint64_t{out.levels.back().row_pitch} * out.levels.back().height;
  }
  const std::size_t found = bytes.size() - start;
  StoredImage& first = out.levels.front();
  if (found != expected && count == 1 && (flags & has_pitch) && pitch > first.row_pitch && found == std::uint64_t{pitch} * height) {
    first.row_pitch = pitch;
    expected = found;
  }
  if (found != expected) {
    in.refuse(fmt::format("{}: {}x{} {} with {} mip levels needs {} bytes behind the header, found {}",
                          found < expected ? "truncated" : "bytes too many", width, height, format.name, count, expected, found));
  }
  std::size_t at = start;
  for (StoredImage& level : out.levels) {
    level.rows = bytes.subspan(at, level.row_pitch * level.height);
    at += level.row_pitch * level.height;
  }
  return out;
}

}  // namespace rainref::port_dump
