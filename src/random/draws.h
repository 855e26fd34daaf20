// How a pass of whole numbers draws from the hash. Its arithmetic has no number to replace, so its mistakes stand here.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "random/counter.h"

namespace rainref::random {

/// As it should be, or with a mistake that a port makes, which the diagnosis tries.
struct Draws {
  std::array<std::uint8_t, 4> words{0, 1, 2, 3};  ///< which word of a block is taken for each
  bool are_counters_swapped = false;              ///< block(seed, purpose, b, a)
  bool are_seeds_swapped = false;                 ///< the seed's words
  int purpose_off = 0;
  std::array<std::int32_t, 2> counters_off{0, 0};  ///< added to the two counters
  Purpose only{};                                  ///< the blocks that these five concern; Purpose{}: each
  bool is_place_of_low_bits = false;               ///< a place takes the low bits of its word
  bool is_choice_of_low_bits = false;              ///< a class takes the low bits of its word
  bool counts_above = false;                       ///< thresholds above the word are counted, in place of those that it is not below
  bool counts_one_draw = false;                    ///< of several draws the first alone counts
  std::array<bool, 2> is_whole{};                  ///< of a place, its column or its row loses its fraction

  std::vector<Purpose>* met = nullptr;  ///< collects what words are drawn for

  std::array<std::uint32_t, 2> strides{1, 1};  ///< a counter that is s a + b has lost the factor s: it is a + b
  std::array<bool, 2> is_counter_0{};          ///< a counter is left out
  std::array<std::uint32_t, 2> moved{1, 1};    ///< a counter that is s a + b is a + s b: the factor stands at the other term
  int place_bits = 0;                          ///< of a place so many upper bits count, the others are 0; 0: all

  Block block(std::uint64_t seed, Purpose purpose, std::uint32_t a, std::uint32_t b) const;
  /// The upper bits of a word, as the place of something.
  std::uint32_t place(std::uint32_t word, int bits) const {
    const std::uint32_t all = upper(word, bits, is_place_of_low_bits);
    return place_bits > 0 && place_bits < bits ? all >> (bits - place_bits) << (bits - place_bits) : all;
  }
  /// A column (0) or row (1) in fractions of so many bits.
  std::uint32_t fine(std::uint32_t place, int bits, std::size_t axis) const { return is_whole[axis] ? place >> bits << bits : place; }
  /// The upper bits of a word, as the number of a class.
  std::uint32_t choice(std::uint32_t word, int bits) const { return upper(word, bits, is_choice_of_low_bits); }
  /// Of so many thresholds those that are counted where the word is not below `passed` of them.
  std::uint32_t count(std::uint32_t passed, std::uint32_t all) const { return counts_above ? all - passed : passed; }

 private:
  std::uint32_t other_counter(std::uint32_t counter, std::size_t k) const;
  static std::uint32_t upper(std::uint32_t word, int bits, bool is_low) { return is_low ? word & ((1u << bits) - 1) : word >> (32 - bits); }
};

/// Those of the calling thread.
const Draws& draws();
/// Sets them for a scope.
class DrawsScope {
 public:
  explicit DrawsScope(const Draws& d);
  ~DrawsScope();
  DrawsScope(const DrawsScope&) = delete;
  DrawsScope& operator=(const DrawsScope&) = delete;

 private:
  Draws saved_;
};

}  // namespace rainref::random
