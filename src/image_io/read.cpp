#include "image_io/read.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/path_text.h"
#include "base/read_file.h"
#include "image/flipped.h"
#include "image_io/decode.h"
#include "image_io/hdr_header.h"
#include "image_io/quantity.h"
#include "math/half.h"
#include "rainref/error.h"

namespace rainref::image_io {

namespace {

std::optional<FileKind> kind_of(std::span<const std::byte> bytes) {
  const auto starts_with = [&](std::string_view signature) {
    return bytes.size() >= signature.size() && std::memcmp(bytes.data(), signature.data(), signature.size()) == 0;
  };
  if (starts_with("\x76\x2f\x31\x01")) return FileKind::exr;
  if (starts_with("\x89PNG\r\n\x1a\n")) return FileKind::png;
  if (starts_with("#?RADIANCE") || starts_with("#?RGBE")) return FileKind::hdr;
  if (starts_with("\xff\xd8\xff")) return FileKind::jpeg;
  return std::nullopt;
}

/// Reads bytes at any address as a T.
template <class T>
T load(const std::byte* from) {
  T value;
  std::memcpy(&value, from, sizeof value);
  return value;
}

float load_float(const std::byte* from, Sample sample) {
  switch (sample) {
    case Sample::u8:
      return static_cast<float>(load<std::uint8_t>(from)) / 255.0f;
    // Both numbers are exact in float, so the division rounds once.
    case Sample::u16:
      return static_cast<float>(load<std::uint16_t>(from)) / 65535.0f;
    case Sample::half:
      return to_float(load<Half>(from));
    case Sample::float32:
      return load<float>(from);
  }
  return 0;
}

/// Fills the image from samples of type T, which is what the image stores.
template <class T>
void copy_texels(const Decoded& in, T one, Image& out) {
  const std::byte* texel = in.texels.get();
  for (int y = 0; y < in.height; ++y) {
    T* row = out.row<T>(y);
    for (int x = 0; x < in.width; ++x, texel += in.texel_bytes) {
      for (const Channel& c : in.channels) *row++ = c.offset >= 0 ? load<T>(texel + c.offset) : c.one ? one : T{};
    }
  }
}

/// Fills an rgba32f image from samples of any type.
void widen_texels(const Decoded& in, Image& out) {
  const std::byte* texel = in.texels.get();
  for (int y = 0; y < in.height; ++y) {
    float* row = out.row<float>(y);
    for (int x = 0; x < in.width; ++x, texel += in.texel_bytes) {
      for (const Channel& c : in.channels) {
        *row++ = c.offset >= 0 ? load_float(texel + c.offset, c.sample) : c.one ? 1.0f : 0.0f;
      }
    }
  }
}

Image to_image(const Decoded& in) {
  const auto all = [&](Sample sample) {
    return std::ranges::all_of(in.channels, [&](const Channel& c) { return c.offset < 0 || c.sample == sample; });
  };
  if (all(Sample::u8)) {
    Image out(Format::rgba8, in.width, in.height);
    copy_texels<std::uint8_t>(in, 255, out);
    return out;
  }
  if (all(Sample::half)) {
    Image out(Format::rgba16f, in.width, in.height);
    copy_texels<std::uint16_t>(in, 0x3c00, out);
    return out;
  }
  Image out(Format::rgba32f, in.width, in.height);
  widen_texels(in, out);
  return out;
}

/// Refuses the first NaN or infinity, row by row from the top; for a depth only the first NaN or -infinity.
template <class T>
void require_finite(const std::string& file, const Decoded& in, const Image& image, bool is_depth) {
  for (int y = 0; y < image.height(); ++y) {
    const T* row = image.row<T>(y);
    for (int i = 0; i < 4 * image.width(); ++i) {
      float value;
      if constexpr (std::is_same_v<T, Half>) {
        value = to_float(row[i]);
      } else {
        value = row[i];
      }
      if (std::isfinite(value) || (is_depth && value > 0)) continue;
      throw Error(ExitCode::usage, fmt::format("{}: {} at x {}, y {} (from the top), channel '{}'", file,
                                               std::isnan(value) ? "NaN" : "infinity", i / 4, y, in.channels[i % 4].name));
    }
  }
}

bool is_lossy(FileKind kind, std::string_view compression) {
  if (kind == FileKind::hdr || kind == FileKind::jpeg) return true;
  constexpr std::array<std::string_view, 5> codes{"dwaa", "dwab", "b44", "b44a", "pxr24"};
  return std::ranges::find(codes, compression.substr(0, compression.find(':'))) != codes.end();
}

Hash128 canonical_hash(const Image& image) {
  const BufferView view(image);
  std::vector<std::byte> row(view.row_bytes());
  Hasher hasher;
  for (int y = 0; y < image.height(); ++y) {
    view.copy_row(y, row.data());
    hasher.add(row);
  }
  return hasher.finish();
}

std::string quoted(const std::filesystem::path& path) { return fmt::format("'{}'", path_text(path)); }
FileKind known_kind(const std::string& file, std::span<const std::byte> bytes) {
  if (bytes.empty()) throw Error(ExitCode::usage, file + ": empty file");
  const std::optional<FileKind> kind = kind_of(bytes);
  if (!kind) throw Error(ExitCode::usage, file + ": not an EXR, PNG, Radiance HDR or JPEG file");
  return *kind;
}
/// Converts the stored values of a Radiance picture to radiance.
void divide(const std::array<double, 3>& factors, Image& image) {
  for (int y = 0; y < image.height(); ++y) {
    float* row = image.row<float>(y);
    for (int i = 0; i < 4 * image.width(); ++i)
      if (i % 4 < 3) row[i] = static_cast<float>(row[i] / factors[static_cast<std::size_t>(i % 4)]);
  }
}
constexpr std::array<double, 3> no_factors{1, 1, 1};

bool is_alone(const Decoded& decoded) {
  return std::ranges::all_of(decoded.channel_names, [&](const std::string& name) {
    return letter_of(name) == 'A' || std::ranges::any_of(decoded.channels, [&](const Channel& c) { return c.name == name; });
  });
}

Picture described(FileKind kind, const Decoded& decoded, Content content, const std::array<double, 3>& factors) {
  Picture picture;
  picture.channel_names = decoded.channel_names;
  picture.srgb_encoded = (kind == FileKind::png || kind == FileKind::jpeg) && !decoded.declared_linear;
  picture.lossy = is_lossy(kind, decoded.compression);
  picture.compression = decoded.compression;
  picture.file_width = decoded.width;
  picture.file_height = decoded.height;
  if (decoded.orientation >= 5) std::swap(picture.file_width, picture.file_height);
  if (content != Content::colour) {
    picture.taken = decoded.channels[0].name;
    // If others were read too, they are equal.
    if (!is_alone(decoded))
      picture.remarks.push_back(fmt::format("channel {} of {} is taken", picture.taken, fmt::join(picture.channel_names, " ")));
  }
  if (factors != no_factors)
    picture.remarks.push_back(fmt::format("its pixels are divided by {:g}, {:g} and {:g}, by which its header says they were multiplied",
                                          factors[0], factors[1], factors[2]));
  return picture;
}

}  // namespace

Picture inspect(const std::filesystem::path& path, std::span<const std::byte> bytes, Content content) {
  const std::string file = quoted(path);
  const FileKind kind = known_kind(file, bytes);
  const std::array<double, 3> factors = kind == FileKind::hdr ? hdr_factors(file, bytes) : no_factors;
  return described(kind, decode(file, kind, bytes, {}, content, Texels::left), content, factors);
}

Picture read(const std::filesystem::path& path, std::string_view layer, Content content) {
  const std::vector<std::byte> bytes = read_file(path);
  const std::string file = quoted(path);
  const FileKind kind = known_kind(file, bytes);
  const std::array<double, 3> factors = kind == FileKind::hdr ? hdr_factors(file, bytes) : no_factors;
  const Decoded decoded = decode(file, kind, bytes, layer, content);

  Picture picture = described(kind, decoded, content, factors);
  picture.image = to_image(decoded);
  if (decoded.orientation != 1) picture.image = turned(picture.image, decoded.orientation);
  if (factors != no_factors) divide(factors, picture.image);
  const bool is_depth = content == Content::depth;
  if (picture.image.format() == Format::rgba16f) require_finite<Half>(file, decoded, picture.image, is_depth);
  if (picture.image.format() == Format::rgba32f) require_finite<float>(file, decoded, picture.image, is_depth);
  if (content != Content::colour)
    require_alike(file, picture.image, {decoded.channels[0].name, decoded.channels[1].name, decoded.channels[2].name});
  picture.decoded_hash = canonical_hash(picture.image);
  return picture;
}

}  // namespace rainref::image_io
