// Counter-based random numbers: integers from integers, no state, the same on a CPU and on every GPU.
#pragma once

#include <array>
#include <cstdint>

namespace rainref::random {

using Block = std::array<std::uint32_t, 4>;

inline constexpr std::uint32_t pcg4d_multiplier = 1664525u, pcg4d_increment = 1013904223u;
inline constexpr int pcg4d_shift = 16;

/// Four hashed words of a four-word counter: pcg4d of Mark Jarzynski and Marc Olano, "Hash Functions for GPU
/// Rendering", JCGT 9(3), 2020. Unsigned multiplication and addition modulo 2^32, so it is exact everywhere.
constexpr Block pcg4d(Block v) {
  for (std::uint32_t& x : v) x = x * pcg4d_multiplier + pcg4d_increment;
  const auto stir = [&v] {
    v[0] += v[1] * v[3];
    v[1] += v[2] * v[0];
    v[2] += v[0] * v[1];
    v[3] += v[1] * v[2];
  };
  stir();
  for (std::uint32_t& x : v) x ^= x >> pcg4d_shift;
  stir();
  return v;
}

/// Purposes of random streams. A new use takes a new number; an old number never changes its meaning.
enum class Purpose : std::uint32_t {
  puddle_drop_count = 1,
  puddle_drop = 2,
  puddle_bed = 3,
  puddle_ground = 4,
  drop_count = 5,
  drop_arrival = 6,
  falling_drop = 7,
  glass_drop = 50,
  glass_trail = 51,
  glass_flow = 52,
  screen_noise = 60,
  screen_layer = 61,
  screen_cell = 62,
  screen_drop = 63,
  splash_crown = 64,
  wiper_smear = 65,
  picture_dither = 70
};

/// The block for (seed, purpose, a, b). The seed's high word enters through a second hash, so that both words count.
constexpr Block block(std::uint64_t seed, Purpose purpose, std::uint32_t a, std::uint32_t b) {
  const Block key =
      pcg4d({static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32), static_cast<std::uint32_t>(purpose), 0});
  return pcg4d({a ^ key[0], b ^ key[1], key[2], key[3]});
}

/// A float in [0, 1) with 24 random bits, exact and equally spaced.
constexpr float uniform(std::uint32_t word) { return static_cast<float>(word >> 8) * 0x1p-24f; }

}  // namespace rainref::random
