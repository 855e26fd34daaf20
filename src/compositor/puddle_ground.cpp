#include "compositor/puddle_ground.h"

#include <algorithm>

#include "compositor/interface.h"
#include "compositor/optics.h"

namespace rainref::compositor {

void PuddleGround::finish(std::span<const Place> places, std::span<Finish> finishes) const {
  for (std::size_t i = 0; i < places.size(); ++i) finishes[i] = finish(places[i]);
}

Finish PuddleGround::finish(const Place& place) const {
  using namespace scalar;
  using N = Number;
  const puddle::ShadeUniforms& u = look_.uniforms;
  const Vec& p = place.point;
  const double steep = std::max(-place.direction.y, 0.02);
  const N lod = nearest_octave(N(u.ground_footprint * look_.sample_scale * place.distance / steep));
  const N s(p.x * u.ground_scale), t(p.z * u.ground_scale);
  Vec albedo;
  if (u.use_checkerboard != 0) {
    const bool odd = (static_cast<std::int64_t>(floor(s).v) + static_cast<std::int64_t>(floor(t).v)) % 2 != 0;
    albedo = odd ? Vec(0.25, 0.22, 0.20) : Vec(0.15, 0.12, 0.10);  // shade's checkerboard
  } else {
    const auto texel = sample_mip<0, 3, N>(fixed_texture<Address::repeat, Address::repeat, 4>(*look_.ground), s, t, lod);
    albedo = {texel[0].v, texel[1].v, texel[2].v};
  }
  const Vec ambient(u.ambient[0], u.ambient[1], u.ambient[2]), tint(u.tint[0], u.tint[1], u.tint[2]);
  Finish out;
  if (p.y < 0) {
    // Light comes down through the column of water; the way back is the medium's.
    const double left = transmittance(N(u.water_turbidity), N(-p.y)).v;
    out.radiance = ambient * (left * albedo + (1 - left) * tint);
    return out;
  }
  // Slopes of grains that a pixel does not resolve spread what it mirrors: they are sampled, not averaged away.
  const auto tilt = sample_bilinear<0, 2, N>(fixed_texture<Address::repeat, Address::repeat, 2>(*look_.relief), s, t);
  const double film = smoothstep(0.0f, u.shore_width, N(u.shore_width - p.y)).v;
  const Vec level = sheet_ ? sheet_->smooth_normal(place.hit) : Vec(0, 1, 0);
  const double rough = 1 - film;
  out.mirror_normal = normalize(Vec(level.x / level.y + rough * tilt[0].v, 1, level.z / level.y + rough * tilt[1].v));
  const double cosine = std::clamp(-dot(place.direction, out.mirror_normal), 1e-3, 1.0);
  const double reflectance = fresnel_dielectric(N(cosine), look_.water_ior).v * (u.wetness + (1 - u.wetness) * film);
  out.mirror = Vec(reflectance, reflectance, reflectance);
  out.blur = 2 * rough;
  out.radiance = (1 - reflectance) * ambient * albedo;
  return out;
}

}  // namespace rainref::compositor
