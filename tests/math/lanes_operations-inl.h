// The operations of lanes_operations.h, written once over a number N like a pass.
// Text only: no guard, no includes, no namespace.

template <class N>
RAINREF_FN N refracted(N a, N b, float eta) {
  const Vec3<N> normal = normalize(Vec3<N>(fract(b) - N(0.5f), N(1.0f), fract(a) - N(0.5f)));
  const Vec3<N> out = refract(normalize(Vec3<N>(a, N(-1.0f), b)), normal, eta);
  return out.x + N(2.0f) * out.y + N(4.0f) * out.z;
}

// Rounds of a map that stretches and folds, until it lands high: lanes stop at very different rounds.
template <class N>
struct LoopState {
  N x, rounds;
  template <class M>
  friend RAINREF_FN LoopState select(M m, const LoopState& a, const LoopState& b) {
    return {select(m, a.x, b.x), select(m, a.rounds, b.rounds)};
  }
};
template <class N>
RAINREF_FN auto loop_body(int round, const LoopState<N>& s) {
  const N x = fract(s.x * N(3.7f) + N(static_cast<float>(round) * 0.013f));
  const auto go = x < N(0.97f);
  return Round<decltype(x < x), LoopState<N>>{go, {x, s.rounds + N(1.0f)}};
}
template <class N>
RAINREF_FN N run_loop(N a, N b) {
  const LoopState<N> end = advance_while(100, LoopState<N>{fract(a), N(0.0f)}, a < b,
                                         [](int round, const LoopState<N>& s) RAINREF_LAMBDA { return loop_body<N>(round, s); });
  return end.x + end.rounds;
}

template <class N>
RAINREF_FN N apply_operation(Operation operation, N a, N b, N c) {
  (void)b, (void)c;
  switch (operation) {
#define RAINREF_CASE(name, domain, expression) \
  case Operation::name:                        \
    return expression;
    RAINREF_OPERATIONS(RAINREF_CASE)
#undef RAINREF_CASE
  }
  return a;
}
