#include "night_street/shade.h"

#include "night_street/cars.h"
#include "night_street/city.h"
#include "night_street/facade.h"
#include "night_street/sky.h"
#include "night_street/tubes.h"
#include "night_street/wet_ground.h"

namespace rainref::night_street {

namespace {

enum class Bounce : std::uint8_t { none, mirror, rough };  ///< origin of the ray

Vec surface(const City& city, const Ray& ray, const Hit& hit, Bounce bounce);

double fifth(double a) { return a * a * a * a * a; }

/// Light along a reflected ray, including haze; the caller adds halos.
Vec reflected(const City& city, const Ray& ray, Bounce bounce, Hit& hit) {
  hit = trace(city, ray, bounce == Bounce::mirror);
  if (!hit.is_surface()) return sky_gradient(ray.direction);
  return mix(haze_glow, surface(city, ray, hit, bounce), clear_share(hit.t));
}

Vec ground_radiance(const City& city, const Ray& ray, const Hit& hit, Bounce bounce) {
  const Vec p = ray.at(hit.t);
  const Vec light = city.light().ground(p.x, p.z) + Vec{0.006, 0.005, 0.008};
  const double steep = clamp01(-ray.direction.y), fresnel = 0.02 + 0.98 * fifth(1 - steep);
  if (bounce != Bounce::none) return 0.05 * light + (0.5 * fresnel) * haze_glow;

  const WetGround ground = wet_ground(city, hit.kind, p, hit.t);
  const double rough = ground.roughness;
  // At grazing view a rough film reflects less in the mirror direction, because its slopes shadow each other.
  const double share = (0.02 + 0.98 * fifth(1 - steep) / (1 + 3.5 * rough)) * mix(0.8, 1, ground.water);

  // Slopes distributed like the film's, in pairs that lean in opposite directions; keyed by position, so that all pictures of the street
  // agree. The key is finer than any texel.
  const std::uint64_t place = pair_key(floor_int(p.x * 32768), floor_int(p.z * 32768));
  const std::uint64_t bits = random_bits(city.seed, place, Purpose::jitter);
  const auto draw = [bits](int shift) { return static_cast<double>(bits >> shift & 0xffff) * (1.0 / 65536); };
  const double spread = 0.55 * rough;
  const Vec lean{spread * (draw(0) - draw(16)), 0, spread * (draw(32) - draw(48))};
  const auto off_ground = [](Vec direction) {
    direction.y = magnitude(direction.y) + 1e-4;
    return unit(direction);
  };
  Vec sum;
  Hit first;
  const int samples = ground.water > 0.9 ? 1 : 2;
  for (int i = 0; i < samples; ++i) {
    const Vec tilted = unit(ground.normal + (i == 0 ? 1.0 : -1.0) * lean);
    Hit met;
    sum = sum + reflected(city, Ray(p, off_ground(reflect(ray.direction, tilted))), Bounce::rough, met);
    if (i == 0) first = met;
  }
  const Ray mean(p, off_ground(reflect(ray.direction, ground.normal)));
  const double end = first.is_surface() ? first.t : 400;
  const Vec mirror = (1.0 / samples) * sum + city.lights.halo(mean, end);
  // Luminaires emit more light down to the road than toward a viewer.
  Vec highlight = 1.7 * city.lights.highlight(p, -1.0 * ray.direction, ground.normal, rough);
  // An object on the road hides the lamps behind it.
  if (first.kind == Hit::solid && first.t < 6) highlight = mix(0.15, 1, first.t / 6) * highlight;
  return ground.albedo * light + share * mirror + mix(0.75, 1, ground.water) * highlight;
}

Vec solid_radiance(const City& city, const Ray& ray, const Hit& hit, Bounce bounce) {
  const Solid& solid = city.solids[static_cast<std::size_t>(hit.index)];
  const Material& material = city.materials[static_cast<std::size_t>(solid.material)];
  if (material.emission.x > 0) return material.emission;
  const Vec p = ray.at(hit.t);
  const double soft = bounce == Bounce::rough ? 1 : smooth_step(45, 110, hit.t);
  Vec emitted;
  if (solid.sign >= 0 && magnitude(hit.normal.z) > 0.5) {
    const Sign& sign = city.signs[static_cast<std::size_t>(solid.sign)];
    const double width = solid.b.x - solid.a.x, u = hit.normal.z > 0 ? p.x - solid.a.x : solid.b.x - p.x;
    emitted = tube_radiance(sign, width, solid.b.y - solid.a.y, u, p.y - solid.a.y, soft);
  }
  // The map contains light from above; sides get about half of it, undersides the light reflected by the wet road.
  const double side = 0.42 + 0.38 * hit.normal.y;
  const Vec light = side * city.light().ground(p.x, p.z) + Vec{0.006, 0.005, 0.008};
  const Vec middle = 0.5 * (solid.a + solid.b);
  const bool glass = material.glass && in_window(p.x - middle.x, p.y, p.z - middle.z, hit.normal);
  const Vec albedo = glass ? Vec{0.004, 0.004, 0.005} : material.albedo;
  Vec radiance = emitted + albedo * light;
  if (material.shine > 0) {
    // Bodywork is curved: the flat faces of the solid are shaded as if convex, which bends their reflections.
    Vec normal = hit.normal;
    if (solid.shape == Solid::convex) {
      const Vec half = 0.5 * (solid.b - solid.a), from_middle = p - middle;
      normal = unit(normal + 0.3 * Vec{from_middle.x / half.x, from_middle.y / half.y, from_middle.z / half.z});
    }
    const double facing = clamp01(-dot(ray.direction, normal));
    const double fresnel = material.shine + (1 - material.shine) * 0.8 * fifth(1 - facing);
    Vec direction = reflect(ray.direction, normal);
    // Not into the solid.
    direction = unit(direction + (max_of(0, 0.02 - dot(direction, hit.normal))) * hit.normal);
    Vec mirror = 1.5 * sky_gradient(direction) + 0.12 * light;
    if (bounce == Bounce::none && material.shine >= 0.05 && solid.shape == Solid::convex) {
      Hit met;
      mirror = reflected(city, Ray(p + 1e-4 * hit.normal, direction), Bounce::mirror, met);
    }
    radiance = radiance + fresnel * mirror;
  }
  return radiance;
}

Vec surface(const City& city, const Ray& ray, const Hit& hit, Bounce bounce) {
  switch (hit.kind) {
    case Hit::road:
    case Hit::pavement:
      return ground_radiance(city, ray, hit, bounce);
    case Hit::kerb: {
      const Vec p = ray.at(hit.t);
      return 0.10 * city.light().ground(p.x, p.z) + Vec{0.001, 0.001, 0.0012};
    }
    case Hit::building: {
      const double soft = bounce == Bounce::rough ? 1 : smooth_step(30, 90, hit.t);
      return building_radiance(city, hit, ray.at(hit.t), ray.direction, soft);
    }
    case Hit::solid:
      return solid_radiance(city, ray, hit, bounce);
    case Hit::skyline:
      return skyline_radiance(city, -hit.normal.z, ray.at(hit.t));
    case Hit::sky:
      break;
  }
  return {};
}

}  // namespace

Seen look(const City& city, const Ray& ray) {
  Seen seen;
  seen.hit = trace(city, ray);
  if (seen.hit.is_surface()) {
    seen.radiance = mix(haze_glow, surface(city, ray, seen.hit, Bounce::none), clear_share(seen.hit.t));
  } else {
    seen.radiance = sky(city, ray.direction);
  }
  seen.radiance = seen.radiance + city.lights.halo(ray, seen.hit.is_surface() ? seen.hit.t : 400);
  return seen;
}

}  // namespace rainref::night_street
