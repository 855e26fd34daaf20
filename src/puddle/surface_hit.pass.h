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
// An infinite sheet at y = 0, displaced by the newest level inside the puddle's rectangle. With no height above `top`
// and no slope above S, a ray that is e above the water may advance e / (-d_y + S |d_xz|) without crossing it.
template <class N>
RAINREF_FN N water_height(const SurfaceHitUniforms& u, const Texture& wave, N x, N z) {
  const N s = N(0.5f) * (x / N(u.half_size[0]) + N(1.0f)), t = N(0.5f) * (z / N(u.half_size[2]) + N(1.0f));
  return N(u.height_scale) * sample_bilinear<0, 1, N>(wave, s, t)[0] + N(u.height_bias);
}

template <class N>
RAINREF_FN SurfaceHit<N> surface_hit_corrected(const SurfaceHitUniforms& u, const Texture& wave, int px, int py) {
  const Vec3<N> origin(u.camera.position);
  const Vec3<N> d = camera_ray(u.camera, N::index(px), N(static_cast<float>(py)));
  const N zero(0.0f), one(1.0f), epsilon(u.epsilon), far(1e4f);
  // Rays that do not go down meet nothing.
  const N fall = max(-d.y, N(1e-4f));
  const auto down = -d.y > N(1e-4f);
  const N t_plane = origin.y / fall;
  // The stretch of the ray over the rectangle and under `top`.
  const auto slab = [&](N o, N dir, float half, N& t_in, N& t_out) RAINREF_LAMBDA {
    const N safe = select(abs(dir) < N(1e-8f), N(1e-8f), dir);
    const N a = (N(-half) - o) / safe, b = (N(half) - o) / safe;
    t_in = max(t_in, min(a, b));
    t_out = min(t_out, max(a, b));
  };
  N t_in = zero, t_out = min((origin.y + N(u.surface_top)) / fall, far);
  slab(origin.x, d.x, u.half_size[0], t_in, t_out);
  slab(origin.z, d.z, u.half_size[2], t_in, t_out);
  // A ray that meets the sheet before the rectangle goes no further.
  const auto over_rectangle = t_in <= t_plane;
  t_in = max(t_in, (origin.y - N(u.surface_top)) / fall);
  const auto enters = (t_in < t_out) & over_rectangle & down;
  const N speed = fall + N(u.surface_slope) * length(d.x, d.z);
  // position.x carries t; the other components stay zero.
  MarchState<N> state{Vec3<N>(select(enters, t_in, t_plane), zero, zero), one, zero};
  state = advance_while(u.max_steps, state, enters, [&](int round, const MarchState<N>& s) RAINREF_LAMBDA {
    const N t = s.position.x;
    const N above = (origin.y + t * d.y) - water_height(u, wave, origin.x + t * d.x, origin.z + t * d.z);
    const auto go = (above >= epsilon) & (t < t_out);
    const MarchState<N> next{Vec3<N>(select(go, t + above / speed, t), zero, zero), above, N(static_cast<float>(round))};
    return Round<decltype(go), MarchState<N>>{go, next};
  });
  const auto on_water = enters & (state.position.x < t_out);
  const N t = select(on_water, state.position.x, t_plane);
  SurfaceHit<N> out;
  out.position = select(down, origin + t * d, origin);
  out.iterations = state.iterations;
  const N x = out.position.x, z = out.position.z, dx(2.0f * u.half_size[0] * u.texel[0]), dz(2.0f * u.half_size[2] * u.texel[1]);
  const N gain(u.normal_gain);
  const N gx = (water_height(u, wave, x - dx, z) - water_height(u, wave, x + dx, z)) * gain;
  const N gz = (water_height(u, wave, x, z - dz) - water_height(u, wave, x, z + dz)) * gain;
  const Vec3<N> up(zero, one, zero);
  out.normal = select(down, normalize(Vec3<N>(gx, one, gz)), up);
  out.flag = select(down, one, zero);
  return out;
}
