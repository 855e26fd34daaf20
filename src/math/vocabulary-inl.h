// The named functions of passes, written once for any number type N and included by every evaluation.
//
// Text only: no guard, no includes, no namespace. scalar.h and lanes-inl.h include it inside their namespaces, with RAINREF_FN as the
// linkage of a function and RAINREF_LAMBDA as the attribute of a lambda.

// any(mask) says whether the mask is set in some lane. It may skip work whose result is selected by the same mask; so it saves time but
// never chooses a value.

// ---- guards --------------------------------------------------------------------------------------------------------
// guard<N>(max(x, least), "why") is max(x, least), and states why no scene takes its other side: the second side of min, max and select,
// total reflection of refract, the range beyond the ends of a clamp or a lookup. A number type that counts decisions records the reason.
template <class N, class T>
RAINREF_FN T guard(T decision, const char* reason) {
  if constexpr (requires { N::guarded(reason); }) N::guarded(reason);
  return decision;
}
/// The same for the lower end only.
template <class N, class T>
RAINREF_FN T guard_below(T decision, const char* reason) {
  if constexpr (requires { N::guarded(reason, 0); }) N::guarded(reason, 0);
  return decision;
}
inline constexpr char for_lanes[] = "one invocation alone has left before, where this does not hold: the other side is for lanes";

// ---- sums ----------------------------------------------------------------------------------------------------------
// The order of these sums is free to a GPU. The reference adds from left to right.
template <class N>
RAINREF_FN N sum_any_order(N a, N b, N c) {
  return (a + b) + c;
}
template <class N>
RAINREF_FN N sum_any_order(N a, N b, N c, N d) {
  return ((a + b) + c) + d;
}
/// (a + b) + (c + d): symmetric in the pairs and within each.
template <class N>
RAINREF_FN N sum_any_order_in_pairs(N a, N b, N c, N d) {
  return (a + b) + (c + d);
}

/// a - 4 b, |b| < 2^126: the product is exact. Lanes fuse the two.
template <class N>
RAINREF_FN N minus_four_times(N a, N b) {
  return a - N(4.0f) * b;
}

// ---- uniforms ------------------------------------------------------------------------------------------------------
/// a / b of two uniforms: the same for every element, but in the arithmetic of the device.
template <class N>
RAINREF_FN N uniform_quotient(float a, float b, N) {
  return N(a / b);
}

// ---- shaping -------------------------------------------------------------------------------------------------------
template <class N>
RAINREF_FN N clamp(N x, N low, N high) {
  return min(max(x, low), high);
}
template <class N>
RAINREF_FN N saturate(N x) {
  return clamp(x, N(0.0f), N(1.0f));
}
/// t t (3 - 2 t) with t = saturate((x - edge0) / (edge1 - edge0)). Also defined for edge0 > edge1, which GLSL leaves undefined.
template <class N>
RAINREF_FN N smoothstep(float edge0, float edge1, N x) {
  const N t = saturate((x - N(edge0)) / N(edge1 - edge0));
  return t * t * (N(3.0f) - N(2.0f) * t);
}

/// floor(log2(x) + 1/2), clamped to [0, 12]: the mip level for x texels per pixel. It compares with the powers of two halfway between whole
/// levels, so it is exact.
template <class N>
RAINREF_FN N nearest_octave(N x) {
  N level(0.0f);
  float threshold = 0x1.6a09e6p+0f;  // sqrt(2)
  for (int k = 0; k < 12; ++k, threshold *= 2.0f) level = level + select(x >= N(threshold), N(1.0f), N(0.0f));
  return level;
}

// ---- vectors -------------------------------------------------------------------------------------------------------
template <class N>
struct Vec3 {
  N x, y, z;
  RAINREF_FN Vec3() {}
  RAINREF_FN Vec3(N x_, N y_, N z_) : x(x_), y(y_), z(z_) {}
  explicit RAINREF_FN Vec3(const float* uniform) : x(uniform[0]), y(uniform[1]), z(uniform[2]) {}
  friend RAINREF_FN Vec3 operator+(const Vec3& a, const Vec3& b) { return Vec3{a.x + b.x, a.y + b.y, a.z + b.z}; }
  friend RAINREF_FN Vec3 operator-(const Vec3& a, const Vec3& b) { return Vec3{a.x - b.x, a.y - b.y, a.z - b.z}; }
  friend RAINREF_FN Vec3 operator*(const Vec3& a, const Vec3& b) { return Vec3{a.x * b.x, a.y * b.y, a.z * b.z}; }
  friend RAINREF_FN Vec3 operator*(N s, const Vec3& a) { return Vec3{s * a.x, s * a.y, s * a.z}; }
};
template <class N>
RAINREF_FN N dot(const Vec3<N>& a, const Vec3<N>& b) {
  return sum_any_order(a.x * b.x, a.y * b.y, a.z * b.z);
}
template <class N>
RAINREF_FN N length(N x, N y) {
  return sqrt(square(x) + square(y));
}
template <class N>
RAINREF_FN N length(const Vec3<N>& a) {
  return sqrt(sum_any_order(square(a.x), square(a.y), square(a.z)));
}
/// a / |a|, by one division; a must not be zero.
template <class N>
RAINREF_FN Vec3<N> normalize(const Vec3<N>& a) {
  return (N(1.0f) / length(a)) * a;
}
template <class M, class N>
RAINREF_FN Vec3<N> select(M m, const Vec3<N>& a, const Vec3<N>& b) {
  return Vec3<N>{select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
template <class N>
RAINREF_FN Vec3<N> mix(const Vec3<N>& a, const Vec3<N>& b, N t) {
  return Vec3<N>{mix(a.x, b.x, t), mix(a.y, b.y, t), mix(a.z, b.z, t)};
}
/// Component by component. Lanes evaluate the three side by side.
template <class N>
RAINREF_FN Vec3<N> pow(const Vec3<N>& a, N b) {
  return Vec3<N>{pow(a.x, b), pow(a.y, b), pow(a.z, b)};
}
/// Two arguments of one function; lanes evaluate them side by side.
template <class N>
struct Two {
  N a, b;
  RAINREF_FN Two(N a_, N b_) : a(a_), b(b_) {}
};
template <class N>
RAINREF_FN Two<N> atan2(const Two<N>& y, const Two<N>& x) {
  return Two<N>{atan2(y.a, x.a), atan2(y.b, x.b)};
}
/// v - 2 (n . v) n
template <class N>
RAINREF_FN Vec3<N> reflect(const Vec3<N>& v, const Vec3<N>& n) {
  return v - (N(2.0f) * dot(n, v)) * n;
}
/// Snell's refraction of unit v at unit n (against v), eta = n1 / n2; zero vector at total internal reflection. The ratio is a float, or a
/// double if N accepts one.
template <class N, class Ratio>
RAINREF_FN Vec3<N> refract(const Vec3<N>& v, const Vec3<N>& n, Ratio eta) {
  const N cosine = dot(n, v);
  const N k = N(1.0f) - N(eta) * N(eta) * (N(1.0f) - square(cosine));
  const Vec3<N> bent = N(eta) * v - (N(eta) * cosine + sqrt(max(k, N(0.0f)))) * n;
  const N zero(0.0f);
  return select(k < zero, Vec3<N>(zero, zero, zero), bent);
}

// ---- loops ---------------------------------------------------------------------------------------------------------
/// At most `limit` rounds of state = body(round, state).state, for every lane whose rounds have all returned `go` so far. body returns {go,
/// state}; the state of a round that stops still counts. The state type has its own select(mask, a, b).
template <class M, class State>
struct Round {
  M go;
  State state;
};
template <class State, class M, class Body>
RAINREF_FN State advance_while(int limit, State state, M active, Body body) {
  for (int round = 0; round < limit && any(active); ++round) {
    const auto next = body(round, state);
    state = select(active, next.state, state);
    active = active & next.go;
  }
  return state;
}
