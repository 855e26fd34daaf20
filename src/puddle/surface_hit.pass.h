// Pass surface_hit: where the view ray of a pixel meets the water, and the normal there.

template <class N>
RAINREF_FN Vec3<N> camera_ray(const CameraUniforms& c, N px, N py) {
  const N sx = N(c.plane_left) + (px + N(0.5f)) * N(c.pixel_scale), sy = N(c.plane_bottom) + (py + N(0.5f)) * N(c.pixel_scale);
  return normalize(Vec3<N>(c.forward) + sx * Vec3<N>(c.right) + sy * Vec3<N>(c.up));
}

template <class N>
struct SurfaceHit {
  Vec3<N> position;
  N iterations;
  Vec3<N> normal;
  N flag;
  RAINREF_FN SurfaceHit() {}  // an implicit one would not be compiled for the SIMD target
};

// ---- as published --------------------------------------------------------------------------------------------------
// Sphere tracing of a box whose top is displaced by the previous level, still encoded and with the sign that the
// article prints. `wave` holds that one channel.
template <class N>
RAINREF_FN N scene_distance(const SurfaceHitUniforms& u, const Texture& wave, const Vec3<N>& p) {
  const N s = N(0.5f) * (p.x / N(u.half_size[0]) + N(1.0f)), t = N(0.5f) * (p.z / N(u.half_size[2]) + N(1.0f));
  const N d = sample_bilinear<0, 1, N>(wave, s, t)[0], zero(0.0f);
  return length(Vec3<N>(max(abs(p.x) - N(u.half_size[0]), zero), max(abs(p.y + d) - N(u.half_size[1]), zero),
                        max(abs(p.z) - N(u.half_size[2]), zero)));
}

template <class N>
struct MarchState {
  Vec3<N> position;
  N distance, iterations;
  template <class M>
  friend RAINREF_FN MarchState select(M m, const MarchState& a, const MarchState& b) {
    return {select(m, a.position, b.position), select(m, a.distance, b.distance), select(m, a.iterations, b.iterations)};
  }
};

template <class N>
RAINREF_FN SurfaceHit<N> surface_hit_as_published(const SurfaceHitUniforms& u, const Texture& wave, int px, int py) {
  const Vec3<N> origin(u.camera.position);
  const Vec3<N> direction = camera_ray(u.camera, N::index(px), N(static_cast<float>(py)));
  const N epsilon(u.epsilon);
  // The distance to a convex box is convex along a ray: one that is further away than this never comes back, so leaving
  // the loop changes nothing but keeps the position finite.
  const N gone(1000.0f);
  MarchState<N> state{origin, N(1.0f), N(0.0f)};
  state = advance_while(u.max_steps, state, N(0.0f) < N(1.0f), [&](int round, const MarchState<N>& s) RAINREF_LAMBDA {
    const N d = scene_distance(u, wave, s.position);
    const auto go = (d >= epsilon) & (d < gone);
    const MarchState<N> next{select(go, s.position + d * direction, s.position), d, N(static_cast<float>(round))};
    return Round<decltype(go), MarchState<N>>{go, next};
  });
  const auto hit = state.distance < epsilon;
  SurfaceHit<N> out;
  out.position = select(hit, state.position, origin);
  out.iterations = select(hit, state.iterations, N(static_cast<float>(u.max_steps - 1)));
  const N s = N(0.5f) * (out.position.x / N(u.half_size[0]) + N(1.0f)), t = N(0.5f) * (out.position.z / N(u.half_size[2]) + N(1.0f));
  const N du(u.texel[0]), dv(u.texel[1]);
  const N left = sample_bilinear<0, 1, N>(wave, s - du, t)[0], right = sample_bilinear<0, 1, N>(wave, s + du, t)[0];
  const N down = sample_bilinear<0, 1, N>(wave, s, t - dv)[0], up = sample_bilinear<0, 1, N>(wave, s, t + dv)[0];
  out.normal = normalize(Vec3<N>((left - right) * N(u.normal_gain), N(1.0f), (down - up) * N(u.normal_gain)));
  out.flag = select(hit, N(1.0f), N(0.0f));
  return out;
}

// ---- corrected -----------------------------------------------------------------------------------------------------
// An infinite sheet at y = 0, displaced by the newest level inside the puddle's rectangle. `bounds` says for each block
// of cells that around it no height is above `top` and no slope above S; the uniforms say so of all the water, for rays
// that run further under `top` than a texel of bounds reaches. With that the gap e between a ray and the water closes by at most fall + S |d_xz| per unit of length and
// opens by at most S |d_xz| - fall, fall = -d_y. So a step is proven not to cross the water if it is no longer than
//   e / (fall + S |d_xz|) + e' / (S |d_xz| - fall),
// e' the gap at its end (over-relaxed sphere tracing: Keinert et al., Enhanced Sphere Tracing, 2014, 3.1). The march
// tries e / (fall + S |d_xz| / 2), which level water always proves, and where the proof fails goes back and takes the
// first term alone. Closer than epsilon, one step of Newton's method along the ray ends the march: its error is of the
// order of epsilon squared.
template <class N, class T>
RAINREF_FN N water_height(const SurfaceHitUniforms& u, const T& wave, N s, N t) {
  return N(u.height_scale) * sample_bilinear<0, 1, N>(wave, s, t)[0] + N(u.height_bias);
}

/// The last place that the ray is proven to reach above the water, the gap there, and the step to try next.
template <class N>
struct DescentState {
  N t, above, step, iterations;
  template <class M>
  friend RAINREF_FN DescentState select(M m, const DescentState& a, const DescentState& b) {
    return {select(m, a.t, b.t), select(m, a.above, b.above), select(m, a.step, b.step), select(m, a.iterations, b.iterations)};
  }
};

template <class N>
RAINREF_FN SurfaceHit<N> surface_hit_corrected(const SurfaceHitUniforms& u, const Texture& water, const Texture& bounds, int px, int py) {
  const auto wave = fixed_texture<Address::clamp, Address::clamp, 1>(water);
  const Vec3<N> origin(u.camera.position);
  const Vec3<N> d = camera_ray(u.camera, N::index(px), N(static_cast<float>(py)));
  const N zero(0.0f), one(1.0f), half(0.5f), epsilon(u.epsilon), far(1e4f);
  // Rays that do not go down meet nothing.
  const N fall = max(-d.y, N(1e-4f)), inverse_fall = one / fall;
  const auto down = -d.y > N(1e-4f);
  SurfaceHit<N> out;
  out.position = origin;
  out.iterations = out.flag = zero;
  out.normal = Vec3<N>(zero, one, zero);
  if (!any(down)) return out;
  const N t_plane = origin.y * inverse_fall;
  // Texture coordinates grow linearly along the ray.
  const N s0 = origin.x * N(u.inverse_size[0]) + half, ds = d.x * N(u.inverse_size[0]);
  const N r0 = origin.z * N(u.inverse_size[1]) + half, dr = d.z * N(u.inverse_size[1]);
  const N s = s0 + t_plane * ds, r = r0 + t_plane * dr, run = length(d.x, d.z);
  const auto local = sample_nearest<0, 2, N>(fixed_texture<Address::clamp, Address::clamp, 2>(bounds), s * N(u.bounds_scale[0]), r * N(u.bounds_scale[1]));
  const auto holds = (local[0] * run <= N(u.bounds_reach) * fall) & (s >= zero) & (s <= one) & (r >= zero) & (r <= one);
  const N top = select(holds, local[0], N(u.surface_top)), slope = select(holds, local[1], N(u.surface_slope));
  // The stretch of the ray over the rectangle and under `top`.
  const auto slab = [&](N o, N dir, float half_side, N& t_in, N& t_out) RAINREF_LAMBDA {
    const N inverse = one / select(abs(dir) < N(1e-8f), N(1e-8f), dir);
    const N a = (N(-half_side) - o) * inverse, b = (N(half_side) - o) * inverse;
    t_in = max(t_in, min(a, b));
    t_out = min(t_out, max(a, b));
  };
  N t_in = zero, t_out = min((origin.y + top) * inverse_fall, far);
  slab(origin.x, d.x, u.half_size[0], t_in, t_out);
  slab(origin.z, d.z, u.half_size[2], t_in, t_out);
  // A ray that meets the sheet before the rectangle goes no further.
  const auto over_rectangle = t_in <= t_plane;
  t_in = max(t_in, (origin.y - top) * inverse_fall);
  const auto enters = (t_in < t_out) & over_rectangle & down;

  const N climb = slope * run;
  const N stride = one / (fall + climb), back = one / max(climb - fall, N(1e-4f)), bold = one / (fall + half * climb);
  DescentState<N> state{select(enters, t_in, t_plane), zero, zero, zero};
  state = advance_while(u.max_steps, state, enters, [&](int round, const DescentState<N>& now) RAINREF_LAMBDA {
    const N t = now.t + now.step;
    const N above = (origin.y + t * d.y) - water_height(u, wave, s0 + t * ds, r0 + t * dr);
    const N safe = now.above * stride;
    const auto proven = now.step <= safe + max(above, zero) * back;
    const DescentState<N> next{select(proven, t, now.t), select(proven, above, now.above), select(proven, above * bold, safe),
                               N(static_cast<float>(round))};
    const auto go = ((above >= epsilon) & (t < t_out)) | (!proven);
    return Round<decltype(go), DescentState<N>>{go, next};
  });
  const auto on_water = enters & (state.t < t_out);
  const N t = select(on_water, state.t, t_plane);
  N hit_t = t;
  if (any(on_water)) {
    const Neighbours<N> near = sample_neighbours<0, N>(wave, s0 + t * ds, r0 + t * dr);
    const N gain = N(u.normal_gain) * N(u.height_scale), gx = (near.left - near.right) * gain, gz = (near.down - near.up) * gain;
    // gx and gz are the negative slopes. A ray that runs along a flank keeps its place, and so does one that enters
    // through the side under the water. Twice the safe stride bounds the step: it ends no more than epsilon under and
    // three epsilon above the water, whatever the water does between its texels.
    const N closing = fall - (gx * d.x + gz * d.z), least = half * fall;
    const auto close = on_water & (state.above < epsilon) & (state.above >= zero) & (closing >= least);
    hit_t = select(close, t + state.above * min(one / max(closing, least), N(2.0f) * stride), t);
    out.normal = select(on_water, normalize(Vec3<N>(gx, one, gz)), out.normal);
  }
  out.position = select(down, origin + hit_t * d, origin);
  out.iterations = state.iterations;
  out.flag = select(down, one, zero);
  return out;
}
