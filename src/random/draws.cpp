#include "random/draws.h"

#include <bit>
#include <utility>

namespace rainref::random {
namespace {

thread_local Draws current;

}  // namespace

std::uint32_t joined(std::uint32_t a, std::uint32_t b, Join by) {
  switch (by) {
    case Join::exclusive_or:
      return a ^ b;
    case Join::sum:
      return a + b;
    case Join::either:
      return a | b;
    case Join::left_out:
      break;
  }
  return a;
}
Block Mixing::hashed(Block v) const {
  for (std::uint32_t& x : v) x = x * multiplier + increment;
  const auto stirred = [&] {
    const Block before = v;
    const Block& from = is_stirred_at_once ? before : v;
    for (std::size_t k = 0; k < v.size(); ++k)
      if (static_cast<int>(k) != line_left_out) v[k] = joined(v[k], from[factors[k][0]] * from[factors[k][1]], stir);
  };
  if (stirs[0]) stirred();
  for (std::uint32_t& x : v) x = joined(x, is_shift_left ? x << shift : x >> shift, fold);
  if (stirs[1]) stirred();
  return v;
}
Block Mixing::block(std::uint64_t seed, Purpose purpose, std::uint32_t a, std::uint32_t b) const {
  const Block plain{static_cast<std::uint32_t>(seed), static_cast<std::uint32_t>(seed >> 32), static_cast<std::uint32_t>(purpose), last};
  Block given, key;
  for (std::size_t k = 0; k < given.size(); ++k) given[k] = plain[seed_words[k]];
  const Block whole = is_key_hashed ? hashed(given) : given;
  for (std::size_t k = 0; k < key.size(); ++k) key[k] = whole[key_words[k]];
  return hashed({is_keyed[0] ? joined(a, key[0], keyed_by) : a, is_keyed[1] ? joined(b, key[1], keyed_by) : b, key[2], key[3]});
}

std::uint32_t Draws::other_counter(std::uint32_t counter, std::size_t k) const {
  if (is_counter_0[k]) return 0;
  if (moved[k] > 1) return counter / moved[k] + counter % moved[k] * moved[k];
  return counter / strides[k] + counter % strides[k] + static_cast<std::uint32_t>(counters_off[k]);
}
Block Draws::block(std::uint64_t seed, Purpose purpose, std::uint32_t a, std::uint32_t b) const {
  if (met) met->push_back(purpose);
  if (only != Purpose{} && only != purpose) return random::block(seed, purpose, a, b);
  if (are_counters_swapped) std::swap(a, b);
  if (are_seeds_swapped) seed = seed >> 32 | seed << 32;
  if (are_halves_swapped) a = std::rotl(a, 16);
  a = other_counter(a, 0);
  b = other_counter(b, 1);
  const auto drawn_for = static_cast<Purpose>(static_cast<std::uint32_t>(purpose) + static_cast<std::uint32_t>(purpose_off));
  const Block right = mixing ? mixing->block(seed, drawn_for, a, b) : random::block(seed, drawn_for, a, b);
  Block out;
  for (std::size_t k = 0; k < out.size(); ++k) out[k] = std::rotr(right[words[k]], turned[k]);
  return out;
}

const Draws& draws() { return current; }
DrawsScope::DrawsScope(const Draws& d) : saved_(current) { current = d; }
DrawsScope::~DrawsScope() { current = saved_; }

}  // namespace rainref::random
