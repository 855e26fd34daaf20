// Perturbed words: an integer pass evaluated with them draws random numbers like a port with a mistake.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "math/perturbed.h"
#include "random/words.h"

namespace rainref::random {

/// How one word is combined with another.
enum class Join : std::uint8_t { exclusive_or, sum, either, left_out };
std::uint32_t joined(std::uint32_t a, std::uint32_t b, Join by);

/// pcg4d and the key of a block, correct (counter.h) or with a mistake in one of the constants, operators or operands.
struct Mixing {
  std::uint32_t multiplier = pcg4d_multiplier, increment = pcg4d_increment;
  int shift = pcg4d_shift;
  bool is_shift_left = false;
  Join fold = Join::exclusive_or;                                                        ///< combines x and x >> shift
  Join stir = Join::sum;                                                                 ///< combines a word with the product of two others
  std::array<std::array<std::uint8_t, 2>, 4> factors{{{1, 3}, {2, 0}, {0, 1}, {1, 2}}};  ///< factors of that product, for each word
  std::array<bool, 2> stirs{true, true};                                                 ///< before and after the fold
  bool is_stirred_at_once = false;                                                       ///< each line uses the words from before the stir
  int line_left_out = -1;                                                                ///< a word that neither stir changes; -1: none
  Join keyed_by = Join::exclusive_or;                  ///< combines the counters with the first two words of the key
  std::array<bool, 2> is_keyed{true, true};            ///< for each counter: whether it is combined with the key
  std::array<std::uint8_t, 4> key_words{0, 1, 2, 3};   ///< source of each word of the key
  std::array<std::uint8_t, 4> seed_words{0, 1, 2, 3};  ///< the same for (seed's low word, high word, purpose, 0)
  std::uint32_t last = 0;                              ///< in place of that 0
  bool is_key_hashed = true;                           ///< false: the key is (seed's low word, high word, purpose, 0) itself

  Block hashed(Block v) const;
  Block block(std::uint64_t seed, Purpose purpose, std::uint32_t a, std::uint32_t b) const;
};

/// Correct, or with a mistake of a port, which the diagnosis tries.
struct Draws {
  std::array<std::uint8_t, 4> words{0, 1, 2, 3};  ///< source of each word of a block
  bool are_counters_swapped = false;              ///< block(seed, purpose, b, a)
  bool are_seeds_swapped = false;                 ///< swaps the words of the seed
  int purpose_off = 0;
  std::array<std::int32_t, 2> counters_off{0, 0};  ///< added to the two counters
  Purpose only{};                                  ///< the only blocks that the five members above affect; Purpose{}: all
  bool is_place_of_low_bits = false;               ///< a position uses the low bits of its word
  bool is_choice_of_low_bits = false;              ///< a class uses the low bits of its word
  int choice_shift = -1;                           ///< a class uses the bits from this one on; -1: the upper bits
  bool is_row_of_buffer = false;                   ///< a counter uses the row of the buffer instead of the row of a layer
  bool are_halves_swapped = false;                 ///< a first counter that is i | j << 16 is j | i << 16
  std::optional<Mixing> mixing = {};               ///< another hash
  std::array<std::uint8_t, 4> turned{};  ///< number of low bits of each word that are moved above the others, and so used as the upper bits
  bool counts_above = false;             ///< counts the thresholds above the word instead of those that are not
  bool counts_one_draw = false;          ///< only the first of several draws counts
  std::array<bool, 2> is_whole{};        ///< the column or the row of a position loses its fraction

  std::vector<Purpose>* met = nullptr;  ///< collects the purposes of the drawn words

  std::array<std::uint32_t, 2> strides{1, 1};  ///< a counter s a + b has lost the factor s and is a + b
  std::array<bool, 2> is_counter_0{};          ///< this counter is left out and 0
  std::array<std::uint32_t, 2> moved{1, 1};    ///< a counter s a + b is a + s b: the factor is at the other term
  int place_bits = 0;                          ///< number of upper bits of a position that are used, the others are 0; 0: all

  Block block(std::uint64_t seed, Purpose purpose, std::uint32_t a, std::uint32_t b) const;
  /// The upper bits of a word, used as a position.
  std::uint32_t place(std::uint32_t word, int bits) const {
    const std::uint32_t all = upper(word, bits, is_place_of_low_bits);
    return place_bits > 0 && place_bits < bits ? all >> (bits - place_bits) << (bits - place_bits) : all;
  }
  /// The upper bits of a word, used as the number of a class.
  std::uint32_t choice(std::uint32_t word, int bits) const {
    return upper(choice_shift < 0 ? word : word << (32 - bits - choice_shift), bits, is_choice_of_low_bits);
  }

 private:
  std::uint32_t other_counter(std::uint32_t counter, std::size_t k) const;
  static std::uint32_t upper(std::uint32_t word, int bits, bool is_low) { return is_low ? word & ((1u << bits) - 1) : word >> (32 - bits); }
};

/// The draws of the calling thread.
const Draws& draws();
/// Sets the draws for a scope.
class DrawsScope {
 public:
  explicit DrawsScope(const Draws& d);
  ~DrawsScope();
  DrawsScope(const DrawsScope&) = delete;
  DrawsScope& operator=(const DrawsScope&) = delete;

 private:
  Draws saved_;
};

/// A product of the upper bits of word `number` of a block, with this number of fractional binary digits.
struct Scaled {
  std::uint32_t v;
  int digits;
  std::size_t number;
  Scaled operator>>(int n) const { return {v >> n, digits - n, number}; }
  operator std::uint32_t() const { return v; }
  /// A column (word 0) or a row (word 1) may lose its fraction.
  explicit operator float() const {
    const auto& is_whole = draws().is_whole;
    return static_cast<float>(number < is_whole.size() && is_whole[number] ? v >> digits << digits : v);
  }
};
/// The upper bits of a word; the operation applied to them determines their use.
struct UpperBits {
  std::uint32_t word;
  int bits;
  std::size_t number;  ///< of the word in its block
  operator std::uint32_t() const { return word >> (32 - bits); }
  /// A class: the index of a table.
  operator std::size_t() const { return draws().choice(word, bits); }
  /// A position: a fraction of `of`, or a comparison value in a random decision.
  Scaled operator*(std::uint32_t of) const { return {draws().place(word, bits) * of, bits, number}; }
  bool operator>=(std::uint32_t open) const { return draws().place(word, bits) >= open; }
  /// A presence test: true below the given share.
  bool operator<(std::uint32_t share) const { return (word >> (32 - bits) < share) != draws().counts_above; }
};
struct PerturbedWord {
  std::uint32_t v, b;  ///< b: the second counter of its block
  std::size_t number;
  UpperBits operator>>(int n) const { return {v, 32 - n, number}; }
};
struct PerturbedBlock {
  Block words;
  std::uint32_t b;
  PerturbedWord operator[](std::size_t k) const { return {words[k], b, k}; }
  /// No further mistakes apply to these words.
  operator Block() const { return words; }
};
/// Like Words, perturbed by draws().
struct PerturbedWords {
  static PerturbedBlock block(std::uint64_t seed, Purpose purpose, std::uint32_t a, std::uint32_t b) {
    return {draws().block(seed, purpose, a, b), b};
  }
  static float uniform(const PerturbedWord& word) { return random::uniform(draws().place(word.v, 24) << 8); }
  template <class T, class Of = std::identity>
  static std::int32_t count(const PerturbedWord& word, std::int32_t first, std::span<const T> thresholds, Of threshold = {}) {
    if (draws().counts_one_draw && word.b > 0) return 0;
    const std::int32_t passed = Words::count(word.v, 0, thresholds, threshold);
    return first + (draws().counts_above ? static_cast<std::int32_t>(thresholds.size()) - passed : passed);
  }
  static std::uint32_t counted_from(std::int32_t first, std::int32_t at) {
    return draws().is_row_of_buffer ? static_cast<std::uint32_t>(at) : Words::counted_from(first, at);
  }
};
template <>
struct WordsOf<perturbed::Perturbed> {
  using type = PerturbedWords;
};

}  // namespace rainref::random
