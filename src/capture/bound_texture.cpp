#include "capture/bound_texture.h"

#include <algorithm>
#include <map>
#include <mutex>
#include <tuple>

#include <fmt/format.h>

#include "image/colour.h"
#include "math/half.h"
#include "math/unorm.h"
#include "rainref/error.h"

namespace rainref::capture {
namespace {

/// Appends the decoded values of a level.
template <class Stored, class Decode>
void decode_all(const std::vector<std::byte>& bytes, std::vector<float>& out, Decode decode) {
  const std::size_t before = out.size(), count = bytes.size() / sizeof(Stored);
  out.resize(before + count);
  float* const to = out.data() + before;
  for (std::size_t i = 0; i < count; ++i) {
    Stored s;
    std::memcpy(&s, bytes.data() + i * sizeof(Stored), sizeof(Stored));
    to[i] = decode(s);
  }
}
void add_decoded(const Array& image, int level, std::vector<float>& out) {
  const std::vector<std::byte>& bytes = image.levels.at(static_cast<std::size_t>(level));
  switch (info(image.format).kind) {
    case FormatInfo::unorm8:
      return decode_all<Unorm8>(bytes, out, [](Unorm8 u) { return to_float(u); });
    case FormatInfo::srgb8:
      return decode_all<Unorm8>(bytes, out, [](Unorm8 u) { return static_cast<float>(decode_srgb(u.code / 255.0)); });
    case FormatInfo::float16:
      return decode_all<Half>(bytes, out, [](Half h) { return to_float(h); });
    case FormatInfo::float32:
      return decode_all<float>(bytes, out, [](float x) { return x; });
    case FormatInfo::uint32:
      return decode_all<std::uint32_t>(bytes, out, [](std::uint32_t i) { return static_cast<float>(i); });
  }
}
const CaseInput& input_of(const PassCase& c, std::string_view name, bool records) {
  const CaseInput* input = c.input(name);
  if (!input) throw Error(ExitCode::port_files, fmt::format("{}: input '{}' is missing", c.folder(), name));
  if (input->array.is_records != records)
    throw Error(ExitCode::port_files, fmt::format("{}: input '{}': expected {}", c.folder(), name, records ? "records" : "an image"));
  return *input;
}

std::vector<float> taken_of(const Array& a, int levels, int first, int taken) {
  const auto channels = static_cast<std::size_t>(info(a.format).channels), count = static_cast<std::size_t>(taken);
  std::size_t elements = 0;
  for (int l = 0; l < levels; ++l) elements += a.levels[static_cast<std::size_t>(l)].size() / a.element_bytes();
  std::vector<float> texels;
  texels.reserve(elements * count);
  for (int l = 0; l < levels; ++l) {
    if (count == channels) {
      add_decoded(a, l, texels);
      continue;
    }
    const std::vector<float> all = decoded(a, l);
    for (std::size_t i = static_cast<std::size_t>(first); i + count <= all.size(); i += channels)
      texels.insert(texels.end(), all.begin() + static_cast<std::ptrdiff_t>(i), all.begin() + static_cast<std::ptrdiff_t>(i + count));
  }
  return texels;
}

// Decoded texels and the bytes that they come from: while these are held, nobody can write them.
struct Decoded {
  std::vector<float> texels;
  std::vector<Bytes> of;
};
using Texels = std::shared_ptr<const Decoded>;
// By the first level; an entry is valid while somebody holds it.
using Known = std::map<std::tuple<const std::byte*, Format, int, int, int>, std::weak_ptr<const Decoded>>;
Texels shared_texels(const Array& a, int levels, int first, int taken) {
  const auto made = [&] {
    return std::make_shared<const Decoded>(Decoded{taken_of(a, levels, first, taken), {a.levels.begin(), a.levels.begin() + levels}});
  };
  constexpr std::size_t large = 1 << 16;
  if (levels == 0 || a.levels[0].size() < large) return made();
  static std::mutex& mutex = *new std::mutex;
  static Known& known = *new Known;
  const Known::key_type key{a.levels[0].data(), a.format, levels, first, taken};
  {
    const std::lock_guard lock(mutex);
    if (const auto found = known.find(key); found != known.end()) {
      const Texels texels = found->second.lock();
      const auto is_level = [](const Bytes& one, const Bytes& other) { return one.shares(other); };
      if (texels && std::equal(texels->of.begin(), texels->of.end(), a.levels.begin(), is_level)) return texels;
    }
  }
  const Texels texels = made();
  const std::lock_guard lock(mutex);
  std::erase_if(known, [](const auto& one) { return one.second.expired(); });
  known[key] = texels;
  return texels;
}
/// A pointer to the values that keeps the whole alive.
std::shared_ptr<const std::vector<float>> values_of(const Texels& texels) { return {texels, &texels->texels}; }

}  // namespace

std::vector<float> decoded(const Array& image, int level) {
  std::vector<float> out;
  add_decoded(image, level, out);
  return out;
}

void require_certain(const CaseInput& input) {
  if (input.array.uncertain)
    throw Error(
        ExitCode::usage,
        fmt::format("in.{}: the pass reads it at other places than its own texel, so it cannot be judged without the values that the "
                    "port computed: expected files of the pass that gives it, found none",
                    input.name));
}

std::shared_ptr<const std::vector<float>> shared_decoded(const Array& image) {
  return values_of(shared_texels(image, 1, 0, info(image.format).channels));
}

BoundTexture::BoundTexture(const CaseInput& input, int first, int count) {
  require_certain(input);
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
  std::int32_t texels = 0;
  for (int l = 0; l < view_.levels; ++l) {
    view_.width[l] = a.level_width(l);
    view_.height[l] = a.level_height(l);
    view_.offset[l] = texels;
    texels += static_cast<std::int32_t>(a.levels[static_cast<std::size_t>(l)].size() / a.element_bytes());
  }
  texels_ = values_of(shared_texels(a, view_.levels, first, taken));
}
Texture BoundTexture::view() const {
  Texture t = view_;
  if (texels_) t.texels = texels_->data();
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
