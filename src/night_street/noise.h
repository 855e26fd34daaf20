// Randomness of the street: integer hashes of (seed, object, purpose), and smooth noise on an integer lattice.
#pragma once

#include <cstdint>

#include "base/scramble.h"
#include "night_street/vec.h"

namespace rainref::night_street {

/// Purposes of random numbers: one object draws one number for each.
enum class Purpose : std::uint32_t {
  alley,
  asphalt,
  awning,
  awning_cover,
  blade,
  blade_colour,
  car_paint,
  car_place,
  car_present,
  clouds,
  clouds_large,
  display,
  fascia_word,
  goods,
  goods_tone,
  jitter,
  lamp_kind,
  lamp_offset,
  lot_bays,
  lot_height,
  lot_light,
  lot_lit,
  lot_setback,
  lot_shop,
  lot_storey,
  lot_style,
  lot_tone,
  lot_wall,
  lot_width,
  lot_window,
  lot_window_height,
  puddles,
  ring,
  ripple,
  shop_door,
  sign_colour,
  sign_fault,
  sign_place,
  sign_word,
  signal_state,
  skyline,
  stain,
  umbrella,
  umbrella_colour,
  walker_coat,
  walker_place,
  walker_stride,
  window_blind,
  window_level,
  window_lit,
  window_tone,
  walker_heading,  // add new ones at the end, so that the numbers of the others stay
  walker_size
};

inline std::uint64_t random_bits(std::uint64_t seed, std::uint64_t object, Purpose purpose) {
  const std::uint64_t salted = seed + scramble_step * (static_cast<std::uint64_t>(purpose) + 1);
  return scramble(scramble(salted) ^ (object * 0xd1342543de82ef95u + 0x632be59bd9b4e019u));
}
/// Uniform in [0, 1), a multiple of 2^-53.
inline double random01(std::uint64_t seed, std::uint64_t object, Purpose purpose) {
  return static_cast<double>(random_bits(seed, object, purpose) >> 11) * 0x1p-53;
}

/// One key for a pair of integers; the order matters.
inline std::uint64_t pair_key(std::int64_t a, std::int64_t b) {
  return static_cast<std::uint64_t>(a) * scramble_step ^ scramble(static_cast<std::uint64_t>(b) + 0x7f4a7c15u);
}

/// A field of smooth noise. The salt is mixed once; a lattice point costs one 32-bit hash.
class Noise {
 public:
  Noise(std::uint64_t seed, Purpose purpose) : salt_(static_cast<std::uint32_t>(random_bits(seed, 0, purpose) >> 32)) {}

  /// In [0, 1), a hash of the lattice point.
  double lattice(std::int64_t x, std::int64_t y) const {
    std::uint32_t h = salt_ ^ (static_cast<std::uint32_t>(x) * 0x85ebca6bu) ^ (static_cast<std::uint32_t>(y) * 0xc2b2ae35u);
    h = (h ^ (h >> 16)) * 0x7feb352du;
    h = (h ^ (h >> 15)) * 0x846ca68bu;
    return static_cast<double>(h ^ (h >> 16)) * 0x1p-32;
  }
  /// In [0, 1): lattice values at integers, continuous with continuous slope between them.
  double value(double x, double y) const {
    const std::int64_t i = floor_int(x), j = floor_int(y);
    const double u = x - static_cast<double>(i), v = y - static_cast<double>(j);
    const double su = u * u * (3 - 2 * u), sv = v * v * (3 - 2 * v);
    return mix(mix(lattice(i, j), lattice(i + 1, j), su), mix(lattice(i, j + 1), lattice(i + 1, j + 1), su), sv);
  }
  /// In [0, 1): octaves of value() at doubled frequency and halved weight.
  double layered(double x, double y, int octaves) const {
    double sum = 0, weight = 0.5, total = 0;
    for (int i = 0; i < octaves; ++i) {
      sum += weight * value(x, y);
      total += weight;
      weight *= 0.5;
      x = 2 * x + 17.3;
      y = 2 * y - 9.1;
    }
    return sum / total;
  }

 private:
  std::uint32_t salt_;
};

}  // namespace rainref::night_street
