#include "puddle/scenery.h"

#include <algorithm>
#include <cstring>
#include <optional>

#include <fmt/format.h>

#include "cache/prepared.h"
#include "image/colour.h"
#include "image/memory.h"
#include "math/constants.h"
#include "puddle/ground.h"
#include "rainref/error.h"

namespace rainref::puddle {
namespace {

Sky make_sky(const Rows& rows, const Image& environment, const bool& is_cube, const bool& is_encoded, const Variant& variant) {
  Sky sky{prepare_environment(environment, is_cube, is_encoded, variant, rows), {}};
  if (variant == Variant::corrected) sky.ambient = ambient_radiance(sky.environment.view(), is_cube);
  return sky;
}

/// From the image, or if there is none from asphalt with this seed. In as-published a checkerboard hides the asphalt; corrected ground
/// always has relief.
Ground make_ground(const Rows& rows, const Image& image, const bool& is_encoded, const std::uint64_t& seed, const bool& is_hidden,
                   const Variant& variant) {
  const bool is_own = image.empty();
  const Image made = !is_own ? Image() : is_hidden ? Image(Format::rgba32f, 1, 1) : make_asphalt(seed);
  Ground ground{prepare_ground(is_own ? made : image, is_own ? false : is_encoded, variant, rows), {}};
  if (variant == Variant::corrected) ground.relief = make_relief(ground.tile, is_own, rows);
  return ground;
}

using BedReads = cache::Only<&Settings::shape, &Settings::seed, &Settings::grid, &Settings::cell_size, &Settings::puddle_depth,
                             &Settings::bed_columns, &Settings::shore_width>;
Bed make_bed_and_shore(const int&, const BedReads& reads) {
  Bed bed{make_bed(reads.of), {}};
  if (reads.of.shape == Shape::natural) bed.shore = make_shore(reads.of, bed.depths.view());
  return bed;
}

}  // namespace

std::shared_ptr<const Sky> sky_of(const Settings& s, const Surroundings& around, const Rows& rows) {
  return cache::prepared("puddle sky", rows, make_sky, around.environment, around.environment_is_cube, around.environment_is_encoded,
                         s.variant);
}
std::shared_ptr<const Ground> ground_of(const Settings& s, const Surroundings& around, const Rows& rows) {
  const bool is_own = around.ground.empty(), is_hidden = is_own && s.variant == Variant::as_published && s.use_checkerboard;
  return cache::prepared("puddle ground", rows, make_ground, around.ground, around.ground_is_encoded, is_own ? s.seed : 0, is_hidden,
                         s.variant);
}
std::shared_ptr<const Bed> bed_of(const Settings& s) { return cache::prepared("puddle bed", 0, make_bed_and_shore, s); }

namespace {

// 4-channel floats of an image in the code that this variant's pass expects.
zeroed::Array<float> recode(const Image& image, bool is_encoded, Variant variant, const Rows& rows) {
  // Floats are read in place.
  const bool is_plain = info(image.format()).kind == FormatInfo::float32;
  std::optional<TextureData> decoded;
  if (!is_plain) decoded.emplace(image, Address::clamp, Address::clamp, rows);
  const int c = image.channels();
  const std::size_t width = static_cast<std::size_t>(image.width());
  const std::size_t texels = width * image.height() * 4;
  zeroed::Array<float> out;
  // Reserves room for build_mips, because otherwise all texels would be copied.
  out.reserve(texels + (variant == Variant::corrected ? mip_bytes(image.width(), image.height(), 4) / sizeof(float) : 0));
  out.resize(texels);
  rows(image.height(), [&](int begin, int end) {
    for (int y = begin; y < end; ++y) {
      const std::size_t first = static_cast<std::size_t>(y) * width;
      const float* in = is_plain ? image.row<float>(y) : decoded->view().texels + first * c;
      float* to = out.data() + first * 4;
      for (std::size_t i = 0; i < width; ++i) {
        for (int k = 0; k < 3; ++k) {
          // Resampled panoramas have slightly negative texels; radiance has none.
          const float x = std::max(in[i * c + (k < c ? k : 0)], 0.0f);
          if (is_encoded == (variant == Variant::as_published))
            to[i * 4 + k] = x;
          else
            to[i * 4 + k] = static_cast<float>(is_encoded ? decode_srgb(x) : encode_gamma22(x));
        }
        to[i * 4 + 3] = c == 4 ? in[i * c + 3] : 1;
      }
    }
  });
  return out;
}

}  // namespace

TextureData prepare_environment(const Image& image, bool is_cube, bool is_encoded, Variant variant, const Rows& rows) {
  if (image.empty()) throw Error(ExitCode::usage, "environment.image: expected an image, found none");
  zeroed::Array<float> texels = recode(image, is_encoded, variant, rows);
  int width = image.width(), height = image.height();
  if (is_cube) {
    if (width == 6 * height) {
      zeroed::Array<float> column(texels.size());
      const std::size_t face_row = static_cast<std::size_t>(height) * 4;
      for (int face = 0; face < 6; ++face) {
        for (int y = 0; y < height; ++y) {
          std::memcpy(column.data() + (static_cast<std::size_t>(face) * height + y) * face_row,
                      texels.data() + (static_cast<std::size_t>(y) * 6 + face) * face_row, face_row * sizeof(float));
        }
      }
      texels.swap(column);
      width = height;
      height = 6 * width;
    }
    if (height != 6 * width) {
      throw Error(ExitCode::usage, fmt::format("environment.image: a cube needs six square faces in a row or a column, found {}x{}",
                                               image.width(), image.height()));
    }
  }
  const Address around = is_cube ? Address::clamp : Address::repeat;
  TextureData texture(std::move(texels), 4, width, height, around, Address::clamp);
  if (variant == Variant::corrected) {
    // A cube's levels end when a face is one texel.
    int levels = Texture::max_levels;
    if (is_cube) {
      levels = 1;
      for (int side = width; side > 1 && side % 2 == 0; side /= 2) ++levels;
    }
    texture.build_mips(levels, rows);
  }
  return texture;
}

TextureData prepare_ground(const Image& ground, bool is_encoded, Variant variant, const Rows& rows) {
  TextureData texture(recode(ground, is_encoded, variant, rows), 4, ground.width(), ground.height(), Address::repeat, Address::repeat);
  if (variant == Variant::corrected) texture.build_mips(Texture::max_levels, rows);
  return texture;
}

std::array<float, 3> ambient_radiance(const Texture& t, bool is_cube) {
  const int w = t.width[0], h = t.height[0];
  double sum[3] = {};
  for (int y = 0; y < h; ++y) {
    double row[3] = {};
    const float* texels = t.texels + static_cast<std::size_t>(y) * w * t.channels;
    if (is_cube) {
      const int face = y / w;
      const double r = 2 * (y % w + 0.5) / w - 1;
      for (int x = 0; x < w; ++x) {
        const double s = 2 * (x + 0.5) / w - 1, length_sq = 1 + s * s + r * r;
        const double up = face == 2 ? 1 : face == 3 ? -1 : -r;
        if (up <= 0) continue;
        const double weight = up / (length_sq * length_sq) * 4 / (static_cast<double>(w) * w);  // cos(theta) d(omega)
        for (int k = 0; k < 3; ++k) row[k] += weight * texels[x * t.channels + k];
      }
    } else {
      // The integral of sin cos over the row's elevations, exactly: half the difference of the squared sines.
      const double low = std::max(0.0, (static_cast<double>(y) / h - 0.5) * pi), high = ((y + 1.0) / h - 0.5) * pi;
      if (high <= low) continue;
      const double sine_low = sin_real(Real64(low)).v, sine_high = sin_real(Real64(high)).v;
      const double weight = 0.5 * (sine_high * sine_high - sine_low * sine_low) * (2 * pi / w);
      for (int x = 0; x < w; ++x) {
        for (int k = 0; k < 3; ++k) row[k] += weight * texels[x * t.channels + k];
      }
    }
    for (int k = 0; k < 3; ++k) sum[k] += row[k];
  }
  return {static_cast<float>(sum[0] / pi), static_cast<float>(sum[1] / pi), static_cast<float>(sum[2] / pi)};
}

}  // namespace rainref::puddle
