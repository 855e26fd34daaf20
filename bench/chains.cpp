// Compiled once for each SIMD target.
#include "chains.h"

#define RAINREF_KERNELS "chains.cpp"
#include "math/foreach_target.h"
#include "math/lanes-inl.h"

RAINREF_TARGET_BEGIN(bench)

constexpr int chain_count = 10;  // two at a time, of four or five cycles each

int OperationsOfRound() { return 2 * chain_count * Lanes::size(); }

float Chains(std::int64_t rounds) {
  Lanes x[chain_count];
  for (int k = 0; k < chain_count; ++k) x[k] = Lanes(1.0f + 0.01f * static_cast<float>(k));
  const Lanes factor(0.999f), term(0.001f);
  for (std::int64_t i = 0; i < rounds; ++i) {
    _Pragma("GCC unroll 10") for (int k = 0; k < chain_count; ++k) x[k] = x[k] * factor + term;
  }
  Lanes sum = x[0];
  for (int k = 1; k < chain_count; ++k) sum = sum + x[k];
  return hn::GetLane(sum.v);
}

RAINREF_TARGET_END(bench)

#if RAINREF_ONCE
namespace rainref::bench {

RAINREF_EXPORT(OperationsOfRound);
RAINREF_EXPORT(Chains);

int operations_of_round() { return RAINREF_DISPATCH(OperationsOfRound)(); }
float chains(std::int64_t rounds) { return RAINREF_DISPATCH(Chains)(rounds); }

}  // namespace rainref::bench
#endif
