// Pass surface_hit: the point where the view ray of a pixel meets the water, and the normal there.
#ifndef RAINREF_FN
#ifndef RAINREF_PUDDLE_SURFACE_HIT_PASS_H_
#define RAINREF_PUDDLE_SURFACE_HIT_PASS_H_
#include "pass/definition.h"
#include "puddle/camera_members.h"

namespace rainref::puddle {

struct SurfaceHitPass : pass::Takes<SurfaceHitUniforms> {
  static constexpr pass::About about{
      "surface_hit", "Where each pixel's view ray meets the water, and the normal there.", {1}, {2}, {"dot", "length", "normalize"}};
  static scene::UniformBlock uniforms() {
    return block(
        with_camera<U>({member<&U::half_size>("m", {0, 1e5}, "Half the puddle's extent."),
                        member<&U::epsilon>("m", {1e-5, 1}, "Distance that counts as a hit."),
                        member<&U::texel>("1", scene::share, "1 over the wave's columns and rows."),
                        member<&U::max_steps>("1", {1, 4096}, "Most steps of the march."),
                        member<&U::normal_gain>("1", {0, 1e5}, "Factor from a height difference to a slope."),
                        member<&U::height_scale>("m", {0, 2}, "corrected: height = scale * stored + bias."),
                        member<&U::height_bias>("m", {-1, 0}, "corrected: see height_scale."),
                        member<&U::surface_top>("m", {0, 1e6}, "corrected: no height lies above this, or below its negative."),
                        member<&U::surface_slope>("1", {0, 1e9}, "corrected: no slope of the surface is above this."),
                        member<&U::inverse_size>("1/m", {0, 1e5}, "corrected: 1 over the puddle's extent in x and z."),
                        member<&U::bounds_scale>("1", scene::share, "corrected: texture coordinates of bounds to one of the water."),
                        member<&U::bounds_reach>("m", {0, 1e6}, "corrected: a texel of bounds holds this far around its points.")}));
  }
  template <class B>
  struct Io {
    static constexpr std::string_view position = "Position x y z [m], march steps.", units = "m, m, m, 1";
    typename B::Sampled wave = pass::In{.name = "wave", .from = "wave_step", .filter = Filter::linear};
    typename B::Sampled bounds = pass::In{.name = "bounds", .variant = "corrected", .filter = Filter::nearest};  // see bounds.h
    typename B::template Result<Format::rgba32f> hit = {pass::Out{.name = "hit", .sentence = position, .unit = units, .range = {-42, 42}},
                                                        pass::Out{.name = "hit", .sentence = position, .unit = units, .range = {-2, 2}}};
    typename B::template Result<Format::rgba16f> normal =
        pass::Out{.name = "normal", .sentence = "Unit normal x y z; 1 where the ray hit, 0 where not.", .range = {-1, 1}};
  };
};

}  // namespace rainref::puddle
#endif
#else

/// Vector from the eye to the pixel's centre on the image plane.
template <class N>
RAINREF_FN Vec3<N> to_image_plane(const CameraUniforms& c, N px, N py) {
  const N sx = N(c.plane_left) + (px + N(0.5f)) * N(c.pixel_scale), sy = N(c.plane_bottom) + (py + N(0.5f)) * N(c.pixel_scale);
  return Vec3<N>(c.forward) + sx * Vec3<N>(c.right) + sy * Vec3<N>(c.up);
}
template <class N>
RAINREF_FN Vec3<N> camera_ray(const CameraUniforms& c, N px, N py) {
  return normalize(to_image_plane(c, px, py));
}

template <class N>
struct SurfaceHit {
  Vec3<N> position;
  N iterations;
  Vec3<N> normal;
  N flag;
  RAINREF_FN SurfaceHit() {}  // not implicit, because that would not be compiled for the SIMD target
};

// ---- as published --------------------------------------------------------------------------------------------------
// Sphere tracing of a box whose top is displaced by the previous level, still encoded and with the sign that the article prints. `wave`
// holds that one channel.
template <class N, class T>
RAINREF_FN N scene_distance(const SurfaceHitUniforms& u, const T& wave, const Vec3<N>& p) {
  const N s = N(0.5f) * (p.x / N(u.half_size[0]) + N(1.0f)), t = N(0.5f) * (p.z / N(u.half_size[2]) + N(1.0f));
  const N d = sample_bilinear<0, 1, N>(wave, s, t)[0], zero(0.0f);
  return length(Vec3<N>{max(abs(p.x) - N(u.half_size[0]), zero), max(abs(p.y + d) - N(u.half_size[1]), zero),
                        max(abs(p.z) - N(u.half_size[2]), zero)});
}

inline constexpr char until_done[] = "one invocation alone ends its march when it is done: the other side is for lanes";
template <class N>
struct MarchState {
  Vec3<N> position;
  N distance, iterations;
  template <class M>
  friend RAINREF_FN MarchState select(M m, const MarchState& a, const MarchState& b) {
    return {guard<N>(select(m, a.position, b.position), until_done), guard<N>(select(m, a.distance, b.distance), until_done),
            guard<N>(select(m, a.iterations, b.iterations), until_done)};
  }
};

/// The normal at a position, by differences of the wave, as published.
template <class N, class T>
RAINREF_FN Vec3<N> normal_as_published(const SurfaceHitUniforms& u, const T& wave, const Vec3<N>& p) {
  const N s = N(0.5f) * (p.x / N(u.half_size[0]) + N(1.0f)), t = N(0.5f) * (p.z / N(u.half_size[2]) + N(1.0f));
  const N du(u.texel[0]), dv(u.texel[1]);
  const N left = sample_bilinear<0, 1, N>(wave, s - du, t)[0], right = sample_bilinear<0, 1, N>(wave, s + du, t)[0];
  const N down = sample_bilinear<0, 1, N>(wave, s, t - dv)[0], up = sample_bilinear<0, 1, N>(wave, s, t + dv)[0];
  return normalize(Vec3<N>{(left - right) * N(u.normal_gain), N(1.0f), (down - up) * N(u.normal_gain)});
}

template <class N, class T>
RAINREF_FN SurfaceHit<N> surface_hit_as_published(const SurfaceHitUniforms& u, const T& wave, int px, int py) {
  const Vec3<N> origin(u.camera.position);
  const Vec3<N> direction = camera_ray(u.camera, N::index(px), N(static_cast<float>(py)));
  const N epsilon(u.epsilon);
  // The distance to a convex box is convex along a ray, so a ray further away than this never comes back. Leaving the loop changes nothing
  // but keeps the position finite.
  const N gone(1000.0f);
  MarchState<N> state{origin, N(1.0f), N(0.0f)};
  state = advance_while(u.max_steps, state, N(0.0f) < N(1.0f), [&](int round, const MarchState<N>& s) RAINREF_LAMBDA {
    const N d = scene_distance(u, wave, s.position);
    const auto go = (d >= epsilon) & (d < gone);
    const MarchState<N> next{select(go, s.position + d * direction, s.position), d, N(static_cast<float>(round))};
    return Round<decltype(go), MarchState<N> >{go, next};
  });
  const auto hit = state.distance < epsilon;
  SurfaceHit<N> out;
  out.position = select(hit, state.position, origin);
  out.iterations = select(hit, state.iterations, N(static_cast<float>(u.max_steps - 1)));
  out.normal = normal_as_published(u, wave, out.position);
  out.flag = select(hit, N(1.0f), N(0.0f));
  return out;
}

// ---- corrected -----------------------------------------------------------------------------------------------------
// An infinite sheet at y = 0, displaced by the newest level inside the puddle's rectangle. For each block of cells, `bounds` states that
// near it no height is above `top` and no slope above S. The uniforms bound all of the water, for rays that run further under `top` than a
// texel of bounds reaches. With fall = -d_y, the gap e between a ray and the water closes by at most fall + S |d_xz| per unit of length and
// opens by at most S |d_xz| - fall. So a step does not cross the water if it is no longer than
//   e / (fall + S |d_xz|) + e' / (S |d_xz| - fall),
// where e' is the gap at its end (over-relaxed sphere tracing: Keinert et al., Enhanced Sphere Tracing, 2014, 3.1). The march tries e /
// (fall + S |d_xz| / 2), which is always proven for level water. If the proof fails, it goes back and takes the first term alone. Closer
// than epsilon, one step of Newton's method along the ray ends the march; its error is of the order of epsilon squared.
template <class N, class T>
RAINREF_FN N water_height(const SurfaceHitUniforms& u, const T& wave, N s, N t) {
  return N(u.height_scale) * sample_bilinear<0, 1, N>(wave, s, t)[0] + N(u.height_bias);
}

/// The last point that the ray is proven to reach above the water, the gap there, and the next step to try.
template <class N>
struct DescentState {
  N t, above, step, iterations;
  template <class M>
  friend RAINREF_FN DescentState select(M m, const DescentState& a, const DescentState& b) {
    return {guard<N>(select(m, a.t, b.t), until_done), guard<N>(select(m, a.above, b.above), until_done),
            guard<N>(select(m, a.step, b.step), until_done), guard<N>(select(m, a.iterations, b.iterations), until_done)};
  }
};

/// The view ray of a pixel, origin + t d, and quantities that are linear along it.
template <class N>
struct Descent {
  Vec3<N> origin, d;
  N fall, inverse_fall, run;  ///< -d_y, guarded; its inverse; |d_xz|
  N t_plane;                  ///< t where the ray meets y = 0
  N s0, ds, r0, dr;           ///< texture coordinates of the water
  typename N::Mask down;      ///< rays that do not go down hit nothing
  RAINREF_FN Descent() {}
};
template <class N>
RAINREF_FN Descent<N> descent(const SurfaceHitUniforms& u, int px, int py) {
  const N half(0.5f);
  Descent<N> ray;
  ray.origin = Vec3<N>(u.camera.position);
  ray.d = camera_ray(u.camera, N::index(px), N(static_cast<float>(py)));
  ray.fall = max(-ray.d.y, N(1e-4f));
  ray.inverse_fall = N(1.0f) / ray.fall;
  ray.down = -ray.d.y > N(1e-4f);
  ray.t_plane = ray.origin.y * ray.inverse_fall;
  ray.s0 = ray.origin.x * N(u.inverse_size[0]) + half;
  ray.ds = ray.d.x * N(u.inverse_size[0]);
  ray.r0 = ray.origin.z * N(u.inverse_size[1]) + half;
  ray.dr = ray.d.z * N(u.inverse_size[1]);
  ray.run = length(ray.d.x, ray.d.z);
  return ray;
}
/// The result for a ray that does not go down.
template <class N>
RAINREF_FN SurfaceHit<N> surface_missed(const Descent<N>& ray) {
  const N zero(0.0f);
  SurfaceHit<N> out;
  out.position = ray.origin;
  out.iterations = out.flag = zero;
  out.normal = Vec3<N>{zero, N(1.0f), zero};
  return out;
}
/// No water along the ray is higher than top or steeper than slope.
template <class N>
struct WaterBounds {
  N top, slope;
};
template <class N>
RAINREF_FN WaterBounds<N> water_bounds(const SurfaceHitUniforms& u, const Texture& bounds, const Descent<N>& ray) {
  const N zero(0.0f), one(1.0f);
  const N s = ray.s0 + ray.t_plane * ray.ds, r = ray.r0 + ray.t_plane * ray.dr;
  const auto local =
      sample_nearest<0, 2, N>(fixed_texture<Address::clamp, Address::clamp, 2>(bounds), s * N(u.bounds_scale[0]), r * N(u.bounds_scale[1]));
  const auto holds = (local[0] * ray.run <= N(u.bounds_reach) * ray.fall) & (s >= zero) & (s <= one) & (r >= zero) & (r <= one);
  return {select(holds, local[0], N(u.surface_top)), select(holds, local[1], N(u.surface_slope))};
}
/// The stretch of the ray over the rectangle and under top, and the step lengths that the slope allows.
template <class N>
struct Stretch {
  N t_in, t_out;
  N stride, back, bold;
  typename N::Mask enters;
  RAINREF_FN Stretch() {}
};
template <class N>
RAINREF_FN Stretch<N> stretch(const SurfaceHitUniforms& u, const Descent<N>& ray, const WaterBounds<N>& bounds) {
  const N zero(0.0f), one(1.0f), far(1e4f);
  const auto slab = [&](N o, N dir, float half_side, N& t_in, N& t_out) RAINREF_LAMBDA {
    const N inverse = one / select(abs(dir) < N(1e-8f), N(1e-8f), dir);
    const N a = (N(-half_side) - o) * inverse, b = (N(half_side) - o) * inverse;
    t_in = max(t_in, min(a, b));
    t_out = min(t_out, max(a, b));
  };
  N t_in = zero, t_out = min((ray.origin.y + bounds.top) * ray.inverse_fall, far);
  slab(ray.origin.x, ray.d.x, u.half_size[0], t_in, t_out);
  slab(ray.origin.z, ray.d.z, u.half_size[2], t_in, t_out);
  // A ray that meets the plane before the rectangle ends there.
  const auto over_rectangle = t_in <= ray.t_plane;
  Stretch<N> out;
  out.t_in = max(t_in, (ray.origin.y - bounds.top) * ray.inverse_fall);
  out.t_out = t_out;
  out.enters = (out.t_in < t_out) & over_rectangle & ray.down;
  const N climb = bounds.slope * ray.run;
  out.stride = one / (ray.fall + climb);
  out.back = one / max(climb - ray.fall, N(1e-4f));
  out.bold = one / (ray.fall + N(0.5f) * climb);
  return out;
}
/// The gap between the ray at t and the water.
template <class N, class T>
RAINREF_FN N gap_above(const SurfaceHitUniforms& u, const T& wave, const Descent<N>& ray, N t) {
  return (ray.origin.y + t * ray.d.y) - water_height(u, wave, ray.s0 + t * ray.ds, ray.r0 + t * ray.dr);
}
/// The last step of a march, and the normal of the water at its start.
template <class N>
struct LastStep {
  N t;
  Vec3<N> normal;
  typename N::Mask is_taken;
  RAINREF_FN LastStep() {}
};
template <class N, class T>
RAINREF_FN LastStep<N> last_step(const SurfaceHitUniforms& u, const T& wave, const Descent<N>& ray, const Stretch<N>& over,
                                 typename N::Mask on_water, N t, N above) {
  const N zero(0.0f), one(1.0f), epsilon(u.epsilon);
  const Neighbours<N> near = sample_neighbours<0, N>(wave, ray.s0 + t * ray.ds, ray.r0 + t * ray.dr);
  const N gain = N(u.normal_gain) * N(u.height_scale), gx = (near.left - near.right) * gain, gz = (near.down - near.up) * gain;
  // gx and gz are the negative slopes. A ray along a flank keeps its position, and so does one that enters through the side under the
  // water. The step is limited to twice the safe stride: it ends at most epsilon under and three epsilon above the water, whatever the
  // water does between its texels.
  const N closing = ray.fall - (gx * ray.d.x + gz * ray.d.z), least = N(0.5f) * ray.fall;
  LastStep<N> out;
  out.is_taken = on_water & (above < epsilon) & (above >= zero) & (closing >= least);
  out.t = select(out.is_taken, t + above * min(one / max(closing, least), N(2.0f) * over.stride), t);
  out.normal = normalize(Vec3<N>(gx, one, gz));
  return out;
}
/// The position of a ray at t.
template <class N>
RAINREF_FN Vec3<N> place_at(const Descent<N>& ray, N t) {
  return ray.origin + t * ray.d;
}
/// The hit of a ray whose march ended at `state`.
template <class N, class T>
RAINREF_FN SurfaceHit<N> landed(const SurfaceHitUniforms& u, const T& wave, const Descent<N>& ray, const Stretch<N>& over,
                                const DescentState<N>& state) {
  const N zero(0.0f), one(1.0f);
  SurfaceHit<N> out;
  out.normal = Vec3<N>(zero, one, zero);
  const auto on_water = over.enters & (state.t < over.t_out);
  const N t = select(on_water, state.t, ray.t_plane);
  N hit_t = t;
  if (any(on_water)) {
    const LastStep<N> last = last_step(u, wave, ray, over, on_water, t, state.above);
    hit_t = last.t;
    out.normal = select(on_water, last.normal, out.normal);
  }
  out.position = guard<N>(select(ray.down, place_at(ray, hit_t), ray.origin), for_lanes);
  out.iterations = state.iterations;
  out.flag = guard<N>(select(ray.down, one, zero), for_lanes);
  return out;
}

/// The end of a ray's march.
template <class N, class T>
RAINREF_FN DescentState<N> marched(const SurfaceHitUniforms& u, const T& wave, const Descent<N>& ray, const Stretch<N>& over) {
  const N zero(0.0f), epsilon(u.epsilon);
  const DescentState<N> start{select(over.enters, over.t_in, ray.t_plane), zero, zero, zero};
  return advance_while(u.max_steps, start, over.enters, [&](int round, const DescentState<N>& now) RAINREF_LAMBDA {
    const N t = now.t + now.step;
    const N above = gap_above(u, wave, ray, t);
    const N safe = now.above * over.stride;
    const auto proven = now.step <= safe + max(above, zero) * over.back;
    const DescentState<N> next{select(proven, t, now.t), select(proven, above, now.above), select(proven, above * over.bold, safe),
                               N(static_cast<float>(round))};
    const auto go = ((above >= epsilon) & (t < over.t_out)) | (!proven);
    return Round<decltype(go), DescentState<N> >{go, next};
  });
}

template <class N>
RAINREF_FN SurfaceHit<N> surface_hit_corrected(const SurfaceHitUniforms& u, const Texture& water, const Texture& bounds, int px, int py) {
  const auto wave = fixed_texture<Address::clamp, Address::clamp, 1>(water);
  const Descent<N> ray = descent<N>(u, px, py);
  if (!any(ray.down)) return surface_missed(ray);
  const Stretch<N> over = stretch(u, ray, water_bounds(u, bounds, ray));
  return landed(u, wave, ray, over, marched(u, wave, ray, over));
}

struct SurfaceHitPassText {
  template <class N, bool corrected, class Io>
  static RAINREF_FN void run(const SurfaceHitUniforms& u, const Io& io, int px, int py) {
    SurfaceHit<N> s;
    const Texture& wave = io.wave;
    if constexpr (corrected)
      s = surface_hit_corrected<N>(u, wave, io.bounds, px, py);
    else
      s = surface_hit_as_published<N>(u, wave, px, py);
    io.hit(s.position, s.iterations);
    io.normal(s.normal, s.flag);
  }
};
#endif
