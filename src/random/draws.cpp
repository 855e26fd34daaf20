#include "random/draws.h"

#include <utility>

namespace rainref::random {
namespace {

thread_local Draws current;

}  // namespace

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
  a = other_counter(a, 0);
  b = other_counter(b, 1);
  const Block right =
      random::block(seed, static_cast<Purpose>(static_cast<std::uint32_t>(purpose) + static_cast<std::uint32_t>(purpose_off)), a, b);
  return {right[words[0]], right[words[1]], right[words[2]], right[words[3]]};
}

const Draws& draws() { return current; }
DrawsScope::DrawsScope(const Draws& d) : saved_(current) { current = d; }
DrawsScope::~DrawsScope() { current = saved_; }

}  // namespace rainref::random
