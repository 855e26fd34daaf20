#include "image_io/exr_header.h"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <string>

#include <fmt/format.h>

#include "rainref/error.h"

namespace rainref::image_io {
namespace {

constexpr std::array<std::string_view, 10> compressions{"none", "rle", "zips", "zip", "piz", "pxr24", "b44", "b44a", "dwaa", "dwab"};

// OpenEXR reads this number of bytes for these types, ignoring the stored size; with another size it would read the bytes behind as the
// next attribute.
struct FixedSize {
  std::string_view type;
  std::size_t bytes;
};
constexpr FixedSize fixed_sizes[] = {{"box2f", 16},
                                     {"box2i", 16},
                                     {"chromaticities", 32},
                                     {"compression", 1},
                                     {"deepImageState", 1},
                                     {"double", 8},
                                     {"envmap", 1},
                                     {"float", 4},
                                     {"int", 4},
                                     {"keycode", 28},
                                     {"lineOrder", 1},
                                     {"m33d", 72},
                                     {"m33f", 36},
                                     {"m44d", 128},
                                     {"m44f", 64},
                                     {"rational", 8},
                                     {"tiledesc", 9},
                                     {"timecode", 8},
                                     {"v2d", 16},
                                     {"v2f", 8},
                                     {"v2i", 8},
                                     {"v3d", 24},
                                     {"v3f", 12},
                                     {"v3i", 12}};

class Reader {
 public:
  Reader(std::string_view file, std::span<const std::byte> rest) : file_(file), rest_(rest) {}

  [[noreturn]] void refuse(const std::string& why) const { throw Error(ExitCode::port_files, fmt::format("{}: {}", file_, why)); }
  std::span<const std::byte> take(std::size_t count) {
    if (count > rest_.size()) refuse("truncated in its EXR header");
    const auto out = rest_.first(count);
    rest_ = rest_.subspan(count);
    return out;
  }
  template <class T>
  T number() {
    T value;
    std::memcpy(&value, take(sizeof value).data(), sizeof value);
    return value;
  }
  // Names end in a zero byte and have at most 255 others.
  std::string_view name() {
    const std::size_t most = std::min<std::size_t>(rest_.size(), 256);
    const auto* start = reinterpret_cast<const char*>(rest_.data());
    const void* end = most == 0 ? nullptr : std::memchr(start, 0, most);
    if (!end) refuse("truncated or damaged in its EXR header");
    const std::string_view out(start, static_cast<std::size_t>(static_cast<const char*>(end) - start));
    rest_ = rest_.subspan(out.size() + 1);
    return out;
  }
  bool empty() const { return rest_.empty(); }
  std::size_t left() const { return rest_.size(); }

 private:
  std::string_view file_;
  std::span<const std::byte> rest_;
};

/// Channels end with an empty name, strings with the attribute. Both must fill it, because OpenEXR uses their own lengths.
void check_size(std::string_view name, std::string_view type, Reader value) {
  const auto is = [&](const FixedSize& f) { return f.type == type; };
  if (const auto* fixed = std::find_if(std::begin(fixed_sizes), std::end(fixed_sizes), is);
      fixed != std::end(fixed_sizes) && fixed->bytes != value.left()) {
    value.refuse(fmt::format("damaged in its EXR header: attribute '{}' of type {} has {} bytes; expected {}", name, type, value.left(),
                             fixed->bytes));
  }
  if (type == "chlist") {
    constexpr std::size_t behind_name = 16;  // type, two flags, sampling
    while (!value.name().empty()) value.take(behind_name);
    if (!value.empty())
      value.refuse(fmt::format("damaged in its EXR header: {} bytes behind the last channel of '{}'", value.left(), name));
  } else if (type == "stringvector") {
    while (!value.empty()) value.take(value.number<std::uint32_t>());
  }
}

void read_attribute(std::string_view name, std::string_view type, Reader value, ExrHeader& out) {
  check_size(name, type, value);
  if (name == "dataWindow" && type == "box2i") {
    for (auto& side : out.data_window) side = value.number<std::int32_t>();
  } else if (name == "displayWindow" && type == "box2i") {
    for (auto& side : out.display_window) side = value.number<std::int32_t>();
  } else if (name == "compression" && type == "compression") {
    out.compression = value.number<std::uint8_t>();
  } else if (name == "tiles" && type == "tiledesc") {
    out.tile_width = value.number<std::uint32_t>();
    out.tile_height = value.number<std::uint32_t>();
    out.tile_mode = value.number<std::uint8_t>() & 0xf;
  } else if (type == "preview" || type == "idmanifest") {
    // OpenEXR allocates the unpacked size that these state.
    value.refuse(fmt::format("an attribute of type {}; save the image without it", type));
  }
}

/// Calls f(name, type, value) for each attribute of the header; returns the version word.
template <class F>
std::uint32_t for_each_attribute(std::string_view file, std::span<const std::byte> bytes, F&& f) {
  Reader in(file, bytes);
  in.take(4);  // the signature, which the caller has checked
  const auto version = in.number<std::uint32_t>();
  constexpr std::uint32_t deep = 0x800, several_parts = 0x1000;
  if ((version & 0xff) != 2) in.refuse(fmt::format("EXR version {}; expected 2", version & 0xff));
  if (version & deep) in.refuse("deep pixels are not the content of a buffer");
  if (version & several_parts) in.refuse("several parts; save one image a file");
  for (std::string_view name = in.name(); !name.empty(); name = in.name()) {
    const std::string_view type = in.name();
    const auto size = in.number<std::uint32_t>();
    f(name, type, in.take(size));
  }
  return version;
}

}  // namespace

ExrHeader parse_exr_header(std::string_view file, std::span<const std::byte> bytes) {
  constexpr std::uint32_t tiled = 0x200;
  ExrHeader out;
  bool has_window = false, has_display = false;
  const std::uint32_t version = for_each_attribute(file, bytes, [&](auto name, auto type, std::span<const std::byte> value) {
    read_attribute(name, type, Reader(file, value), out);
    has_window = has_window || name == "dataWindow";
    has_display = has_display || name == "displayWindow";
  });
  out.is_tiled = (version & tiled) != 0;
  if (!has_window || !has_display) Reader(file, {}).refuse("an EXR header without its windows");
  return out;
}

std::optional<std::string> find_exr_text(std::string_view file, std::span<const std::byte> bytes, std::string_view wanted) {
  std::optional<std::string> found;
  for_each_attribute(file, bytes, [&](auto name, auto type, std::span<const std::byte> value) {
    if (!found && name == wanted && type == "string") found.emplace(reinterpret_cast<const char*>(value.data()), value.size());
  });
  return found;
}

std::string_view exr_compression_name(int compression) {
  const auto index = static_cast<std::size_t>(compression);
  return index < compressions.size() ? compressions[index] : "unknown";
}

bool is_lossless_exr(int compression) { return compression >= 0 && compression <= 4; }

}  // namespace rainref::image_io
