// The word type of an integer pass, as a number type is for other passes: it draws random words and interprets them.
#pragma once

#include <algorithm>
#include <functional>
#include <span>

#include "random/counter.h"

namespace rainref::random {

/// The reference's words. PerturbedWords (draws.h) makes a port's mistakes.
struct Words {
  static constexpr Block block(std::uint64_t seed, Purpose purpose, std::uint32_t a, std::uint32_t b) {
    return random::block(seed, purpose, a, b);
  }
  static constexpr float uniform(std::uint32_t word) { return random::uniform(word); }
  /// The count drawn by a word: `first` plus the number of ascending thresholds at or below the word.
  template <class T, class Of = std::identity>
  static std::int32_t count(std::uint32_t word, std::int32_t first, std::span<const T> thresholds, Of threshold = {}) {
    const auto is_below = [&](std::uint32_t w, const T& t) { return w < std::invoke(threshold, t); };
    return first + static_cast<std::int32_t>(std::upper_bound(thresholds.begin(), thresholds.end(), word, is_below) - thresholds.begin());
  }
  /// `at` as a term of a counter that begins at `first`.
  static constexpr std::uint32_t counted_from(std::int32_t first, std::int32_t at) { return static_cast<std::uint32_t>(at - first); }
};
/// The words that match a number type.
template <class N>
struct WordsOf {
  using type = Words;
};

}  // namespace rainref::random
