
#include <algorithm>

#include <fmt/format.h>

#include "base/floating_point.h"
#include "image/memory.h"
#include "puddle/host.h"
#include "puddle/kernels.h"

namespace rainref::puddle {
namespace {

constexpr int own_ground = 512;  // make_asphalt

/// recode, and the texture made from it.
void hold_picture(MemoryPeak& m, std::array<int, 2> size, bool is_float, bool has_mips) {
  const std::uint64_t texels = texel_bytes(size[0], size[1], 4);
  if (!is_float) m.pass(2 * texels);  // decoded, and in the pass's code
  m.hold(texels);
  if (has_mips) hold_mips(m, size[0], size[1], 4);
}

}  // namespace

PictureSizes sizes_of(const Surroundings& s) {
  return {{s.environment.width(), s.environment.height()},
          s.environment.format() == Format::rgba32f,
          {s.ground.width(), s.ground.height()},
          {s.shelter.width(), s.shelter.height()}};
}

MemoryPeak memory(const Settings& s, const PictureSizes& sizes) {
  const bool corrected = s.variant == Variant::corrected;
  const auto [columns, rows] = wave_size(s);
  const std::uint64_t wave_floats = texel_bytes(columns, rows, 1);
  const Format channel = s.storage == Format::rgba8 ? Format::r8 : s.storage == Format::rg32f ? Format::r32f : Format::r16f;
  MemoryPeak m;
  m.hold(2 * Image::memory_bytes(channel, columns, rows));
  m.pass(wave_floats);  // level water
  hold_picture(m, sizes.environment, sizes.has_float_environment, corrected);
  const bool makes_ground = sizes.ground[0] == 0;
  const int own_side = !corrected && s.use_checkerboard ? 1 : own_ground;
  const std::array<int, 2> ground = makes_ground ? std::array{own_side, own_side} : sizes.ground;
  const std::uint64_t made = makes_ground ? Image::memory_bytes(Format::rgba32f, own_side, own_side) : 0;
  m.hold(made);
  hold_picture(m, ground, makes_ground, corrected);
  if (corrected) {
    m.hold(texel_bytes(ground[0], ground[1], 2));
    hold_mips(m, ground[0], ground[1], 2);
    if (s.shape == Shape::natural) {
      m.hold(
          texel_bytes(s.bed_columns, std::max(1, static_cast<int>(s.bed_columns * static_cast<double>(rows) / columns)), 1));  // make_bed
      m.hold(Image::memory_bytes(Format::r32f, columns, rows));
    }
  }
  m.hold(Image::memory_bytes(Format::rgba32f, s.width, s.height) + 2 * Image::memory_bytes(Format::rgba16f, s.width, s.height) +
         Image::memory_bytes(Format::rgba8, s.width, s.height));
  if (!corrected) m.hold(Image::memory_bytes(Format::r32f, s.width, s.height));
  if (corrected && s.ground_reach > 0)
    m.hold(Image::memory_bytes(Format::rgba16f, s.width, s.height));  // upper bound of the picture
                                                                      // behind
  m.hold(wave_floats);                                                // decoded for lookups
  const std::array<int, 2> shelter = s.shelter.empty() ? sizes.shelter : std::array{columns, rows};
  m.hold(sizeof(ShelterCell) * static_cast<std::uint64_t>(shelter[0]) * static_cast<std::uint64_t>(shelter[1]));
  m.pass(texel_bytes(sizes.shelter[0], sizes.shelter[1], 4));  // decoded
  m.release(made);
  if (corrected) {
    const std::uint64_t blocks = static_cast<std::uint64_t>((columns + extent_block - 1) / extent_block) *
                                 static_cast<std::uint64_t>((rows + extent_block - 1) / extent_block);
    m.pass(blocks * (sizeof(Extent) + 2 * sizeof(float)));
  }
  return m;
}

void check_memory(const Settings& s, const PictureSizes& sizes) {
  const auto [columns, rows] = wave_size(s);
  require_memory(fmt::format("run.size {}x{} with a wave of {}x{}", s.width, s.height, columns, rows), memory(s, sizes).peak());
}

std::uint64_t memory_bytes(const Settings& settings) {
  const FloatingPointGuard guard;
  return memory(settings).peak();
}

}  // namespace rainref::puddle
