// Pass wave_step: the next level of the wave from the newest and the previous one.

/// Rows of stored values. here, below and above are the newest level, readable `reach` texels to both sides.
template <class Storage>
struct WaveRows {
  const Storage *here, *below, *above, *below_next, *above_next, *previous;
  int reach;           ///< whole texels to the neighbours
  float fraction;      ///< what is left of a fractional offset; *_next are the rows one texel further out
  const float* shore;  ///< corrected: share of the wave that the shore leaves; null: all of it
};

// ---- as published --------------------------------------------------------------------------------------------------
//   d = -(s0 - 1/2) 2 + (s1 + s2 + s3 + s4 - 2),   d *= damping,   d += drops,   stored as d / 2 + 1/2
// s0 is the previous level, s1 ... s4 the newest below, left, right and above (seed 003 names them otherwise).
template <class N>
RAINREF_FN N drop_as_published(const Drop& drop, N x, N y) {
  const N distance = length(N(drop.x) - x, N(drop.y) - y);
  return N(drop.amplitude) * smoothstep(4.0f, 0.5f, distance);
}
template <class N, class Storage>
RAINREF_FN N wave_step_as_published(const WaveStepUniforms& u, const WaveRows<Storage>& in, const Drop* drops, int drop_count, int x,
                                    int y) {
  const int r = in.reach;
  N left = N::load(in.here + x - r), right = N::load(in.here + x + r), down = N::load(in.below + x), up = N::load(in.above + x);
  if (in.fraction != 0.0f) {
    // The texture unit between two texels: a fractional STEP diffuses.
    const N f(in.fraction);
    left = mix(left, N::load(in.here + x - r - 1), f);
    right = mix(right, N::load(in.here + x + r + 1), f);
    down = mix(down, N::load(in.below_next + x), f);
    up = mix(up, N::load(in.above_next + x), f);
  }
  const N velocity = -(N::load(in.previous + x) - N(0.5f)) * N(2.0f);
  N d = velocity + (sum_any_order(down, left, right, up) - N(2.0f));
  d = d * N(u.damping);
  const N fx = N::index(x) + N(0.5f), fy = N(static_cast<float>(y) + 0.5f);
  for (int i = 0; i < drop_count; ++i) {
    if (drops[i].amplitude > 0.01f) d = d + drop_as_published(drops[i], fx, fy);
  }
  return d * N(0.5f) + N(0.5f);
}

// ---- corrected -----------------------------------------------------------------------------------------------------
//   new = (1 + gamma) u - gamma p + C^2 (1 + gamma)/2 L(u) + impulse,     previous = u + impulse
// and on a natural shore new = rest + shore (new - rest), with shore from 1 in the water to 0 on dry ground. L is the five-point Laplacian
// and C the Courant number. The weights of u and p add to 1, so the rest value and the unit of the stored heights cancel out, and the mean
// has the roots 1 and gamma: it is kept. The impulse goes to both levels: a displacement, not a kick. (physics: P3, P7)
//
// The crater of a drop at distance r, with q = r / R < 1: (1 - q^2)^2 (1 - 4 q^2). Its volume is exactly 0.
template <class N>
RAINREF_FN N drop_corrected(const Drop& drop, N x, N y) {
  const N inverse = uniform_quotient(1.0f, drop.radius, N());
  const N s = square((x - N(drop.x)) * inverse) + square((y - N(drop.y)) * inverse);
  const N rim = max(N(1.0f) - s, N(0.0f));
  return N(drop.amplitude) * (square(rim) * (N(1.0f) - N(4.0f) * s));
}
template <class N>
RAINREF_FN N impulse_corrected(const Drop* drops, int drop_count, int x, int y) {
  const N fx = N::index(x) + N(0.5f), fy = N(static_cast<float>(y) + 0.5f);
  N sum(0.0f);
  for (int i = 0; i < drop_count; ++i) sum = sum + drop_corrected(drops[i], fx, fy);
  return sum;
}
template <class N, class Storage>
RAINREF_FN N wave_step_corrected(const WaveStepUniforms& u, const WaveRows<Storage>& in, const Drop* drops, int drop_count, int x, int y) {
  const N here = N::load(in.here + x);
  // In pairs, so that a mirrored or transposed wave keeps its symmetry to the last bit.
  const N around = sum_any_order_in_pairs(N::load(in.here + x - 1), N::load(in.here + x + 1), N::load(in.below + x), N::load(in.above + x));
  const N laplacian = around - N(4.0f) * here;
  const N moving = here + N(u.damping) * (here - N::load(in.previous + x));
  const N next = (moving + N(u.courant_sq) * laplacian) + impulse_corrected<N>(drops, drop_count, x, y);
  return in.shore ? N(u.rest) + N::load(in.shore + x) * (next - N(u.rest)) : next;
}
/// The second output: what becomes the previous level.
template <class N, class Storage>
RAINREF_FN N wave_previous_corrected(const Storage* here, const float* shore, const Drop* drops, int drop_count, int x, int y) {
  const N impulse = impulse_corrected<N>(drops, drop_count, x, y);
  return N::load(here + x) + (shore ? N::load(shore + x) * impulse : impulse);
}
