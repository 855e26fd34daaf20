// Passes ground_noise and shade: from hit and normal to linear radiance. Their arithmetic needs surface_hit.pass.h for the view ray.
#ifndef RAINREF_FN
#ifndef RAINREF_PUDDLE_SHADE_PASS_H_
#define RAINREF_PUDDLE_SHADE_PASS_H_
#include <string>

#include <fmt/format.h>

#include "math/constants.h"
#include "pass/definition.h"
#include "puddle/camera_members.h"
#include "puddle/checkerboard.h"

namespace rainref::puddle {

/// The published sine hash, which no GPU reproduces.
struct GroundNoisePass : pass::Takes<GroundNoiseUniforms> {
  static constexpr pass::About about{"ground_noise",
                                     "The sine hash of the ground point, which shade takes as data.",
                                     {1, capture::Judge::input_only},
                                     {},
                                     {"dot", "length", "normalize"}};
  static scene::UniformBlock uniforms() {
    return block(with_camera<Uniforms>({member<&U::puddle_depth>("m", {0, 100}, "Depth of the ground under y = 0.")}));
  }
  template <class B>
  struct Io {
    typename B::template Texels<Format::rgba32f> hit = pass::In{.name = "hit", .from = "surface_hit"};
    typename B::template Texels<Format::rgba16f> normal = pass::In{.name = "normal", .from = "surface_hit"};
    typename B::template Result<Format::r32f> noise = pass::Out{.name = "noise", .sentence = "Noise of the ground point in [0, 1)."};
  };
};

struct ShadePass : pass::Takes<ShadeUniforms> {
  static constexpr pass::About about{
      "shade", "Reflection, refraction, water and ground: linear radiance.", {1}, {2}, {"dot", "length", "normalize"}};
  static scene::UniformBlock uniforms() {
    return block(with_camera<U>(
        {member<&U::tint>("1", scene::share, "Colour of the water's body, linear RGB."),
         member<&U::reflectivity>("1", scene::share, "Weight of the reflection."),
         member<&U::rotation>("1", scene::component, "Cosine and sine of env_rotation."),
         member<&U::ground_scale>("1/m", {0, 100}, "Tiles of the ground in a metre."),
         member<&U::water_turbidity>("1/m", {0, 1000}, "Extinction of light in the water."),
         member<&U::puddle_depth>("m", {0, 100}, "as-published: depth of the ground under y = 0."),
         member<&U::fog_depth>("1/m", {0, 10}, "Extinction of the fog."),
         member<&U::use_checkerboard>("1", scene::flag, "1: checkerboard ground, 0: image."),
         member<&U::environment_is_cube>("1", scene::flag, "1: cube faces, 0: latitude/longitude."),
         member<&U::ambient>("1", scene::radiance, "corrected: radiance of a white diffuse level ground."),
         member<&U::gloss_level>("1", scene::mip_level, "corrected: mip level of the environment in wet ground."),
         member<&U::inverse_size>("1/m", {0, 1e5}, "corrected: 1 over the puddle's extent in x and z."),
         member<&U::shore_width>("m", scene::share, "corrected: depth over which wet ground turns into water."),
         member<&U::ground_footprint>("1/m", {0, 1e9}, "corrected: texels of the ground under a pixel at distance 1."),
         member<&U::fog_colour>("1", scene::radiance, "corrected: radiance of the fog."),
         member<&U::exact_fresnel>("1", scene::flag, "corrected: 1: Fresnel's equations, 0: Schlick."),
         member<&U::wetness>("1", scene::share, "corrected: reflectance of the wet ground over that of water."),
         member<&U::background_level>("1", scene::mip_level, "corrected: mip level of the environment behind the scene.")
             .guarded("the host always gives 0"),
         member<&U::mirror_level>("1", scene::mip_level, "corrected: mip level of the environment in the water.")
             .guarded("the host always gives 1"),
         member<&U::ground_reach>("1", {0, 1000},
                                  "corrected: extents of the puddle over which the ground turns into the environment's; 0: never.")}));
  }
  template <class Bound>
  static std::string fault(const Bound& b) {
    const Texture& around = b.captured.environment.texture;
    if (b.uniforms.environment_is_cube == 0 || around.height[0] == 6 * around.width[0]) return "";
    return fmt::format("uniform environment_is_cube is {}, but in.environment is {}x{}: six faces below each other were expected",
                       b.uniforms.environment_is_cube, around.width[0], around.height[0]);
  }
  template <class B>
  struct Io {
    typename B::template Texels<Format::rgba32f> hit = pass::In{.name = "hit", .from = "surface_hit"};
    typename B::template Texels<Format::rgba16f> normal = pass::In{.name = "normal", .from = "surface_hit"};
    typename B::template Texels<Format::r32f> noise = pass::In{.name = "noise", .from = "ground_noise", .variant = "as-published"};
    typename B::Sampled environment = pass::In{.name = "environment", .filter = Filter::linear};
    typename B::Sampled ground = pass::In{.name = "ground", .filter = Filter::linear};
    typename B::Sampled relief =
        pass::In{.name = "relief", .variant = "corrected", .filter = Filter::linear, .mip_filter = Filter::nearest};
    typename B::Sampled bed = pass::In{.name = "bed", .variant = "corrected", .filter = Filter::linear};
    typename B::template Result<Format::rgba16f> colour =
        pass::Out{.name = "colour", .sentence = "Linear radiance, alpha 1.", .colour_space = "linear Rec. 709", .alpha = "1"};
  };
};

}  // namespace rainref::puddle
#endif
#else
#include "puddle/ground_level-inl.h"

constexpr float water_ior = static_cast<float>(water_refractive_index);

/// Hit and normal of a pixel, as shade reads them from their buffers.
template <class N>
struct Surface {
  Vec3<N> position, normal;
  N flag;
};
template <class N, class Io>
RAINREF_FN Surface<N> surface_of(const Io& io) {
  N p[4], n[4];
  io.hit.load(p);
  io.normal.load(n);
  return {Vec3<N>(p[0], p[1], p[2]), Vec3<N>(n[0], n[1], n[2]), n[3]};
}

// ---- as published --------------------------------------------------------------------------------------------------
/// Distance along d from p to the plane y = height, or -1.
template <class N>
RAINREF_FN N intersect_plane(const Vec3<N>& p, const Vec3<N>& d, N height) {
  const auto parallel = abs(d.y) < N(0.0001f);
  const N t = (height - p.y) / select(parallel, N(1.0f), d.y);
  return select((t > N(0.0f)) & !parallel, t, N(-1.0f));
}
template <class N>
struct GroundPoint {
  N distance, x, z;
};
template <class N>
RAINREF_FN GroundPoint<N> ground_as_published(const Vec3<N>& view, const Surface<N>& s, float puddle_depth) {
  const Vec3<N> bent = guard<N>(refract(view, s.normal, 1.0f / water_ior), "the ray enters the denser medium");
  const N distance = intersect_plane(s.position, bent, N(-puddle_depth));
  return {distance, s.position.x + bent.x * distance, s.position.z + bent.z * distance};
}
/// The sine hash of the ground point. No GPU reproduces it, so shade takes it as data.
template <class N>
RAINREF_FN N ground_noise_as_published(const GroundNoiseUniforms& u, const Surface<N>& s, int px, int py) {
  const Vec3<N> view = camera_ray(u.camera, N::index(px), N(static_cast<float>(py)));
  const GroundPoint<N> g = ground_as_published(view, s, u.puddle_depth);
  const N noise = fract(sin(g.x * N(12.9898f) + g.z * N(78.233f)) * N(43758.5453f));
  return select(g.distance > N(0.0f), noise, N(0.5f));
}

template <class N>
RAINREF_FN Vec3<N> rotate_y(const Vec3<N>& v, const float* rotation) {
  const N c(rotation[0]), s(rotation[1]);
  return Vec3<N>{c * v.x + s * v.z, v.y, c * v.z - s * v.x};
}
template <class N>
RAINREF_FN Vec3<N> decode_gamma(const Vec3<N>& c) {
  return pow(c, N(2.2f));
}
template <class N>
RAINREF_FN Vec3<N> environment_as_published(const ShadeUniforms& u, const Texture& environment, const Vec3<N>& d) {
  return decode_gamma(sample_environment(environment, u.environment_is_cube != 0, rotate_y(d, u.rotation), N(0.0f)));
}
template <class N>
RAINREF_FN Vec3<N> checkerboard(N x, N z, float scale) {
  const N parity = floor(x * N(scale)) + floor(z * N(scale));
  // Multiplied by 1/2 instead of divided by 2: a GPU's quotient need not be exact, and floor would amplify the error.
  const N odd = parity - N(2.0f) * floor(parity * N(0.5f));
  const auto tile = [](const double* c) RAINREF_LAMBDA {
    return Vec3<N>{N(static_cast<float>(c[0])), N(static_cast<float>(c[1])), N(static_cast<float>(c[2]))};
  };
  return mix(tile(checkerboard_dark), tile(checkerboard_light), odd);
}

template <class N>
RAINREF_FN Vec3<N> shade_as_published(const ShadeUniforms& u, const Texture& environment, const Texture& ground, const Surface<N>& s,
                                      N noise, int px, int py) {
  const Vec3<N> view = camera_ray(u.camera, N::index(px), N(static_cast<float>(py)));
  const N zero(0.0f), one(1.0f);
  const float f0 = reflectance_straight_on(water_ior);
  const N f = fresnel_schlick(min(abs(dot(view, s.normal)), one), f0);
  const auto hit = s.flag > N(0.5f);
  const Vec3<N> reflected = environment_as_published(u, environment, select(hit, reflect(view, s.normal), view));

  const GroundPoint<N> g = ground_as_published(view, s, u.puddle_depth);
  const auto on_ground = g.distance > zero;
  const N gx = select(on_ground, g.x, zero), gz = select(on_ground, g.z, zero);
  Vec3<N> base;
  if (u.use_checkerboard != 0) {
    const N wobble = (noise - N(0.5f)) * N(0.05f);
    base = checkerboard(gx, gz, u.ground_scale) + Vec3<N>(wobble, wobble, wobble);
  } else {
    const auto texel = sample_bilinear<0, 3, N>(fixed_texture<Address::repeat, Address::repeat, 4>(ground), gx * N(u.ground_scale),
                                                gz * N(u.ground_scale));
    base = N(0.6f) * decode_gamma(Vec3<N>(texel[0], texel[1], texel[2]));
  }
  const Vec3<N> tint(u.tint);
  const N visibility = transmittance(N(u.water_turbidity), max(g.distance, zero));
  const Vec3<N> filter = N(0.7f) * (Vec3<N>(one, one, one) - N(0.5f) * tint);
  const Vec3<N> below = select(on_ground, filter * mix(tint, base, visibility), N(0.3f) * tint);

  const N reflection = mix(N(0.3f), N(0.8f), N(u.reflectivity));
  Vec3<N> colour = mix(below, reflected, f * (reflection - N(0.3f)) + N(0.3f));
  colour = colour + (N(0.15f) * (one - f)) * tint;
  const N depth = length(s.position - Vec3<N>(u.camera.position));
  const N fog = transmittance(N(u.fog_depth), depth);
  colour = mix(N(0.7f) * colour, colour, fog);
  return select(hit, colour, reflected);
}

// ---- corrected -----------------------------------------------------------------------------------------------------
/// The light along a view ray that hits neither water nor ground of the puddle.
template <class N>
RAINREF_FN Vec3<N> background(const ShadeUniforms& u, const Texture& environment, const Vec3<N>& view) {
  return sample_environment(environment, u.environment_is_cube != 0, rotate_y(view, u.rotation), N(u.background_level));
}
/// The share of the surroundings' own ground at a position, in extents of the puddle: 0 over its rectangle, 1 from ground_reach on.
template <class N>
RAINREF_FN N share_beyond(const ShadeUniforms& u, N across, N along) {
  const N half(0.5f), zero(0.0f);
  const N out_x = max(abs(across) - half, zero), out_z = max(abs(along) - half, zero);
  return guard_below<N>(smoothstep(0.0f, u.ground_reach, sqrt(square(out_x) + square(out_z))), "a distance is nowhere negative");
}
// Water over a bed of varying depth, wet ground around it. Coverage w goes from 0 (wet ground) to 1 (water) over the first shore_width
// metres of depth; normal, gloss and the refracted offset are scaled by w, so the shore has no seam.
//   L = F E(reflected) + (1 - F) [T albedo + (1 - T) tint] ambient,   T = exp(-turbidity (path down + path up))
template <class N>
RAINREF_FN Vec3<N> shade_corrected(const ShadeUniforms& u, const Texture& environment, const Texture& ground, const Texture& relief,
                                   const Texture& bed, const Surface<N>& s, int px, int py) {
  const Vec3<N> view = camera_ray(u.camera, N::index(px), N(static_cast<float>(py)));
  const N zero(0.0f), one(1.0f), half(0.5f);
  const auto hit = s.flag > half;
  if (!any(hit)) return background(u, environment, view);
  const Vec3<N>& p = s.position;
  const N across = p.x * N(u.inverse_size[0]), along = p.z * N(u.inverse_size[1]);  // within 1/2: over the puddle's rectangle
  const N depth = sample_bilinear<0, 1, N>(fixed_texture<Address::border, Address::border, 1>(bed), across + half, along + half)[0];
  const N water = smoothstep(0.0f, u.shore_width, depth);
  const auto emerges = hit & (water < one);

  const N distance = length(p - Vec3<N>(u.camera.position));
  const N lod = ground_level(N(u.ground_footprint), distance, -view.y);
  Vec3<N> normal = s.normal;
  if (any(emerges)) {
    const auto tilt = sample_mip<0, 2, N>(fixed_texture<Address::repeat, Address::repeat, 2>(relief), p.x * N(u.ground_scale),
                                          p.z * N(u.ground_scale), lod);
    const Vec3<N> rough(tilt[0], one, tilt[1]);
    normal = select(emerges, normalize(mix(rough, s.normal, water)), normal);
  }

  const N cosine = clamp(-dot(view, normal), N(1e-3f), one);
  const float f0 = reflectance_straight_on(water_ior);
  const N fresnel = (u.exact_fresnel != 0 ? fresnel_dielectric(cosine, water_ior) : fresnel_schlick(cosine, f0)) *
                    (N(u.reflectivity) * mix(N(u.wetness), one, water));
  const Vec3<N> mirrored = reflect(view, normal);
  // A mirrored ray below the horizon would meet the water again, so it is turned up.
  const Vec3<N> up_mirrored{mirrored.x, abs(mirrored.y), mirrored.z};
  const Vec3<N> look = rotate_y(guard<N>(select(hit, up_mirrored, view), for_lanes), u.rotation);
  const N gloss = guard<N>(select(hit, mix(N(u.gloss_level), N(u.mirror_level), water), N(u.background_level)), for_lanes);
  const Vec3<N> reflected = sample_environment(environment, u.environment_is_cube != 0, look, gloss);

  const Vec3<N> bent = guard<N>(refract(view, normal, 1.0f / water_ior), "the ray enters the denser medium");
  const N column = max(depth, zero), path = column / max(-bent.y, N(0.05f));
  const N gx = p.x + path * bent.x, gz = p.z + path * bent.z;
  Vec3<N> albedo;
  if (u.use_checkerboard != 0) {
    albedo = checkerboard(gx, gz, u.ground_scale);
  } else {
    const auto texel = sample_mip<0, 3, N>(fixed_texture<Address::repeat, Address::repeat, 4>(ground), gx * N(u.ground_scale),
                                           gz * N(u.ground_scale), lod);
    albedo = Vec3<N>(texel[0], texel[1], texel[2]);
  }
  const auto under_water = column > zero;
  if (any(under_water)) {
    const Vec3<N> dimmed = mix(Vec3<N>(u.tint), albedo, transmittance(N(u.water_turbidity), path + column));
    albedo = guard<N>(select(under_water, dimmed, albedo), for_lanes);
  }
  const Vec3<N> body = albedo * Vec3<N>(u.ambient);
  Vec3<N> surface = fresnel * reflected + (one - fresnel) * body;
  if (u.fog_depth > 0.0f) surface = mix(Vec3<N>(u.fog_colour), surface, transmittance(N(u.fog_depth), distance));
  if (u.ground_reach > 0.0f) {
    // The generated asphalt ends where the surroundings' own ground begins; without a hit this is unused.
    const N own = share_beyond(u, across, along);
    const auto leaves = hit & (own > zero);
    if (any(leaves)) {
      surface = select(leaves, mix(surface, background(u, environment, view), own), surface);
    }
  }
  return guard<N>(select(hit, surface, reflected), for_lanes);
}

struct GroundNoisePassText {
  template <class N, bool, class Io>
  static RAINREF_FN void run(const GroundNoiseUniforms& u, const Io& io, int px, int py) {
    io.noise(ground_noise_as_published<N>(u, surface_of<N>(io), px, py));
  }
};
struct ShadePassText {
  template <class N, bool corrected, class Io>
  static RAINREF_FN void run(const ShadeUniforms& u, const Io& io, int px, int py) {
    const Surface<N> s = surface_of<N>(io);
    if constexpr (corrected)
      io.colour(shade_corrected<N>(u, io.environment, io.ground, io.relief, io.bed, s, px, py), N(1.0f));
    else
      io.colour(shade_as_published<N>(u, io.environment, io.ground, s, io.noise(), px, py), N(1.0f));
  }
};
#endif
