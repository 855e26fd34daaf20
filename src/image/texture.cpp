#include "image/texture.h"

#include <algorithm>
#include <limits>

#include <fmt/format.h>

#include "image/memory.h"
#include "math/half.h"
#include "math/unorm.h"
#include "rainref/error.h"

namespace rainref {
namespace {

template <class Storage>
void decode_rows(const Image& image, zeroed::Array<float>& out, const Rows& rows) {
  const std::size_t row = static_cast<std::size_t>(image.width()) * image.channels();
  rows(image.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const Storage* in = image.row<Storage>(y);
      float* to = out.data() + y * row;
      for (std::size_t i = 0; i < row; ++i) {
        if constexpr (std::is_same_v<Storage, float>)
          to[i] = in[i];
        else
          to[i] = to_float(in[i]);
      }
    }
  });
}

// The part of texel `i` of the larger side that falls into texel `o` of the smaller, as a share of the smaller texel.
double overlap(int i, int o, int larger, int smaller) {
  const double scale = static_cast<double>(larger) / smaller;
  const double low = std::max<double>(i, o * scale), high = std::min<double>(i + 1.0, (o + 1) * scale);
  return std::max(0.0, high - low) / scale;
}

// The texels of the larger side that a texel of the smaller one covers: at most three.
struct Footprint {
  int first, count;
  double share[3];
};
std::vector<Footprint> footprints(int larger, int smaller) {
  std::vector<Footprint> all(static_cast<std::size_t>(smaller));
  for (int o = 0; o < smaller; ++o) {
    Footprint& f = all[static_cast<std::size_t>(o)];
    f = {static_cast<int>(static_cast<std::int64_t>(o) * larger / smaller), 0, {}};
    for (int i = 0; i < std::min(larger - f.first, 3); ++i) {
      f.share[i] = overlap(f.first + i, o, larger, smaller);
      if (f.share[i] > 0) f.count = i + 1;
    }
  }
  return all;
}

}  // namespace

TextureData::TextureData(const std::vector<float>& texels, int channels, int width, int height, Address u, Address v)
    : TextureData(zeroed::Array<float>(texels.begin(), texels.end()), channels, width, height, u, v) {}
TextureData::TextureData(std::initializer_list<float> texels, int channels, int width, int height, Address u, Address v)
    : TextureData(zeroed::Array<float>(texels), channels, width, height, u, v) {}
TextureData::TextureData(zeroed::Array<float> texels, int channels, int width, int height, Address u, Address v)
    : texels_(std::move(texels)) {
  if (texels_.size() > static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max())) {
    throw Error(ExitCode::usage, fmt::format("image {}x{}: too large to be sampled", width, height));
  }
  view_.channels = channels;
  view_.levels = 1;
  view_.width[0] = width;
  view_.height[0] = height;
  view_.address_u = u;
  view_.address_v = v;
  refresh();
}

TextureData::TextureData(const Image& image, Address u, Address v, const Rows& rows)
    : TextureData(zeroed::Array<float>(static_cast<std::size_t>(image.width()) * image.height() * image.channels()), image.channels(),
                  image.width(), image.height(), u, v) {
  switch (info(image.format()).kind) {
    case FormatInfo::unorm8:
    case FormatInfo::srgb8:
      decode_rows<Unorm8>(image, texels_, rows);
      break;
    case FormatInfo::float16:
      decode_rows<Half>(image, texels_, rows);
      break;
    case FormatInfo::float32:
      decode_rows<float>(image, texels_, rows);
      break;
    case FormatInfo::uint32:
      throw Error(ExitCode::internal, "an integer image cannot be sampled");
  }
}

void TextureData::set_border(float r, float g, float b, float a) {
  view_.border[0] = r;
  view_.border[1] = g;
  view_.border[2] = b;
  view_.border[3] = a;
}

void TextureData::build_mips(int levels, const Rows& rows) {
  const int last = view_.levels - 1;
  texels_.reserve(texels_.size() + mip_bytes(view_.width[last], view_.height[last], view_.channels, levels - last) / sizeof(float));
  while (view_.levels < levels && (view_.width[view_.levels - 1] > 1 || view_.height[view_.levels - 1] > 1)) {
    const int above = view_.levels - 1, c = view_.channels;
    const int w0 = view_.width[above], h0 = view_.height[above], w = std::max(1, w0 / 2), h = std::max(1, h0 / 2);
    const std::size_t from = view_.offset[above], to = from + static_cast<std::size_t>(w0) * h0;
    texels_.resize((to + static_cast<std::size_t>(w) * h) * c);
    const float* in = texels_.data() + from * c;
    float* out = texels_.data() + to * c;
    const std::vector<Footprint> columns = footprints(w0, w), lines = footprints(h0, h);
    rows(h, [&](int begin, int end) {
      for (int y = begin; y < end; ++y) {
        const Footprint& line = lines[static_cast<std::size_t>(y)];
        for (int x = 0; x < w; ++x) {
          const Footprint& column = columns[static_cast<std::size_t>(x)];
          for (int k = 0; k < c; ++k) {
            double sum = 0;
            for (int j = 0; j < line.count; ++j) {
              for (int i = 0; i < column.count; ++i)
                sum += column.share[i] * line.share[j] * in[(static_cast<std::size_t>(line.first + j) * w0 + (column.first + i)) * c + k];
            }
            out[(static_cast<std::size_t>(y) * w + x) * c + k] = static_cast<float>(sum);
          }
        }
      }
    });
    view_.width[view_.levels] = w;
    view_.height[view_.levels] = h;
    view_.offset[view_.levels] = static_cast<std::int32_t>(to);
    ++view_.levels;
  }
  refresh();
}

}  // namespace rainref
