// The puddle, corrected, from docs/effects/puddle.md.
#pragma once

#include "documents/puddle_published.h"

namespace rainref::documents {

inline void raindrops_corrected(const Run& r, Given& out) {
  const std::uint32_t step = word(r, "step");
  const int boundary = r.whole("boundary");
  const std::uint32_t drawn = block(r, 1, step, 0)[0];
  int count = r.whole("first_count");
  for (int k = 0; k < r.whole("threshold_count"); ++k) count += word_of(r, "count_thresholds", k, "threshold") <= drawn;
  if (!r.taken().input("craters") || r.count("craters") == 0) count = 0;
  const float columns = static_cast<float>(word(r, "columns")), rows = static_cast<float>(word(r, "rows"));
  for (int i = 0; i < count; ++i) {
    const Words w = block(r, r.is("wrong constant") ? 3 : 2, step, static_cast<std::uint32_t>(i));
    if (const std::uint32_t columns_of_shelter = word(r, "shelter_columns"); columns_of_shelter > 0) {
      const std::uint32_t column = (w[0] >> 16) * columns_of_shelter >> 16, row = (w[1] >> 16) * word(r, "shelter_rows") >> 16;
      const std::uint32_t open = word_of(r, "shelter", static_cast<int>(column + columns_of_shelter * row), "open");
      if (r.is("sheltered where it is open") ? w[3] >> 16 < open : w[3] >> 16 >= open) continue;
    }
    const int size = static_cast<int>(w[2] >> 22);
    const Crater drop{static_cast<float>((w[0] >> 16) * word(r, "columns") >> 8) / 256,
                      static_cast<float>((w[1] >> 16) * word(r, r.unless("columns for rows", "rows", "columns")) >> 8) / 256,
                      r.of("craters", size, "amplitude"), r.of("craters", size, "radius")};
    out.append("drops", drop);
    if (boundary == 2) continue;
    const auto images = [&](float x, float extent) {
      return boundary == 0 ? std::array{x, -x, 2 * extent - x} : std::array{x, x - extent, x + extent};
    };
    const auto reaches = [&](float x, float extent) { return x + drop.radius > 0 && x - drop.radius < extent; };
    const auto xs = images(drop.x, columns), ys = images(drop.y, rows);
    for (std::size_t k = r.is("wrong branch") ? 2 : 1; k < 9; ++k)
      if (reaches(xs[k % 3], columns) && reaches(ys[k / 3], rows))
        out.append("drops", Crater{xs[k % 3], ys[k / 3], drop.amplitude, drop.radius});
  }
  for (int i = r.is("the first object left out") ? 1 : 0; i < r.whole("object_count"); ++i)
    out.append("drops",
               Crater{r.of("objects", i, "x"), r.of("objects", i, "y"), r.of("objects", i, "amplitude"), r.of("objects", i, "radius")});
}

/// As the hand-made one, whose shore and rim may be wrong.
inline bool wave_step_of_document(const Run& r, int x, int y, float* out) {
  wave_step_corrected(r, x, y, out);
  const bool has_rim = r.u("rim_damping") > 0;
  if (has_rim || r.taken().input("shore")) out[0] = in_branch(r, 1, 0.9f) * out[0];
  return true;
}

inline bool surface_hit_corrected(const Run& r, int x, int y, float* out) {
  const Float3 o = r.u3("camera_position"), d = view_ray(r, x, y);
  const auto give = [&](Float3 p, int steps, Float3 n, float flag) {
    const float values[]{p.x, p.y, p.z, static_cast<float>(steps), n.x, n.y, n.z, flag};
    std::copy(std::begin(values), std::end(values), out);
    return true;
  };
  const Float3 up{0, 1, 0};
  if (-d.y <= 1e-4f) return give(o, 0, up, 0);
  const float f = std::max(-d.y, 1e-4f), ray = std::sqrt(d.x * d.x + d.z * d.z);
  const Float2 inverse = u2(r, "inverse_size");
  const auto s = [&](float t) {
    return Float2{(o.x * inverse.x + 0.5f) + t * (d.x * inverse.x), (o.z * inverse.y + 0.5f) + t * (d.z * inverse.y)};
  };
  const auto height = [&](Float2 at) { return r.u("height_scale") * r.linear("wave", at.x, at.y) + r.u("height_bias"); };
  const float per_fall = 1 / f, t0 = o.y * per_fall;
  const auto no_water = [&](int steps) { return give(o + t0 * d, steps, up, 1); };

  const Float2 place = s(t0);
  float top = r.u("surface_top"), slope = r.u("surface_slope");
  if (place.x >= 0 && place.x <= 1 && place.y >= 0 && place.y <= 1) {
    const Float2 scaled{place.x * r.u("bounds_scale", 0), place.y * r.u("bounds_scale", 1)};
    const Float3 bounds{r.at("bounds", static_cast<int>(std::floor(scaled.x * static_cast<float>(r.width("bounds")))),
                             static_cast<int>(std::floor(scaled.y * static_cast<float>(r.height("bounds"))))),
                        r.at("bounds", static_cast<int>(std::floor(scaled.x * static_cast<float>(r.width("bounds")))),
                             static_cast<int>(std::floor(scaled.y * static_cast<float>(r.height("bounds")))), 1)};
    if (!(bounds.x * ray > r.u("bounds_reach") * f)) top = bounds.x, slope = bounds.y;
  }

  float t1 = 0, t2 = std::min((o.y + top) * per_fall, 1e4f);
  const auto cut = [&](float from, float along, float half) {
    const float k = 1 / (std::abs(along) < 1e-8f ? 1e-8f : along);
    const float a = (-half - from) * k, b = (half - from) * k;
    t1 = std::max(t1, std::min(a, b));
    t2 = std::min(t2, std::max(a, b));
  };
  cut(o.x, d.x, r.u("half_size", 0));
  cut(o.z, d.z, r.u("half_size", 2));
  if (t1 > t0) return no_water(0);
  t1 = std::max(t1, (o.y - top) * per_fall);
  if (t1 >= t2) return no_water(0);

  const float h = slope * ray, epsilon = r.u("epsilon");
  float t = t1, e = 0, delta = 0;
  int steps = 0;
  for (int i = 0; i < r.whole("max_steps"); ++i) {
    const float ahead = (o.y + (t + delta) * d.y) - height(s(t + delta)), safe = e * (1 / (f + h));
    steps = i;
    if (delta <= safe + std::max(ahead, 0.0f) * (1 / std::max(h - f, 1e-4f))) {
      t = t + delta;
      e = ahead;
      delta = e * (1 / (f + h / 2));
      if (e < epsilon || t >= t2) break;
    } else {
      delta = safe;
    }
  }
  if (t >= t2) return no_water(steps);

  const Float2 at = s(t);
  const auto wave = [&](int across, int along) { return r.linear("wave", at.x, at.y, 0, 0, nullptr, across, along); };
  const float gain = constant(r, 1, 0.8f) * (r.unless("slopes the other way", 1.0f, -1.0f) * r.u("normal_gain") * r.u("height_scale"));
  const Float2 g{gain * (wave(-1, 0) - wave(1, 0)), gain * (wave(0, -1) - wave(0, 1))};
  const float c = f - (g.x * d.x + g.y * d.z);
  if (0 <= e && e < epsilon && c >= f / 2) t = t + e * std::min(1 / c, 2 * (1 / (f + h)));
  return give(o + t * d, steps, normalize({g.x, 1, g.y}), 1);
}

inline float exact_fresnel(float c, float n) {
  const float t = std::sqrt(std::max(1 - (1 - c * c) * (1 / (n * n)), 0.0f));
  const float across = (n * c - t) / (n * c + t), along = (c - n * t) / (c + n * t);
  return 0.5f * (across * across + along * along);
}

inline bool shade_corrected(const Run& r, int x, int y, float* out) {
  const auto give = [&](Float3 c) { return out[0] = c.x, out[1] = c.y, out[2] = c.z, out[3] = 1, true; };
  const Float3 v = view_ray(r, x, y), stored = r.rgb("normal", x, y), p = r.rgb("hit", x, y), eye = r.u3("camera_position");
  if (!(r.at("normal", x, y, 3) > 0.5f)) return give(environment(r, rotated(r, v), r.u("background_level")));
  const float depth = r.linear("bed", p.x * r.u("inverse_size", 0) + 0.5f, p.z * r.u("inverse_size", 1) + 0.5f);
  const float w = smoothstep(0, r.u("shore_width"), depth);
  const float distance = length(r.unless("distance from the origin", p - eye, p));
  int lod = 0;
  const float footprint = r.u("ground_footprint") * distance / std::max(-v.y, 0.02f);
  float edge = 1.41421356f;
  for (int k = 0; k < 12; ++k, edge *= 2) lod += footprint >= edge;
  const auto level = [&](std::string_view name) { return std::min(lod, static_cast<int>(r.input(name).array.levels.size()) - 1); };
  const float scale = r.u("ground_scale");
  Float3 n = stored;
  if (w < 1) {
    const Float3 relief{r.linear("relief", p.x * scale, p.z * scale, 0, level("relief")), 1,
                        r.linear("relief", p.x * scale, p.z * scale, 1, level("relief"))};
    n = normalize(mix(relief, n, w));
  }
  const float c = std::min(std::max(-dot(v, n), 0.001f), 1.0f);
  const float reflected = r.u("reflectivity") * mix(r.u("wetness"), 1, w);
  const float f =
      (r.whole("exact_fresnel") != 0 ? exact_fresnel(c, constant(r, 1.333f, 1.4f)) : schlick(c, in_branch(r, 1.333f, 1.5f))) * reflected;
  Float3 m = reflect(v, n);
  m.y = std::abs(m.y);
  const Float3 mirror = environment(r, rotated(r, m), mix(r.u("gloss_level"), r.u("mirror_level"), r.unless("gloss for mirror", w, 1 - w)));
  const Float3 b = refract(v, n, 1 / 1.333f);
  const float column = std::max(depth, 0.0f), path = column / std::max(-b.y, 0.05f);
  const float gx = p.x + path * b.x, gz = p.z + path * b.z;
  Float3 albedo =
      r.whole("use_checkerboard") != 0 ? checkerboard(gx, gz, scale) : r.linear3("ground", gx * scale, gz * scale, level("ground"));
  if (column > 0)
    albedo =
        mix(r.u3("tint"), albedo, exponential(-(r.u("water_turbidity") * (path + r.unless("light's way down forgotten", column, 0.0f)))));
  const Float3 ambient = r.unless("ambient forgotten", r.u3("ambient"), Float3{1, 1, 1});
  const Float3 light = f * mirror + (1 - r.unless("all light enters", f, 0.0f)) * (albedo * ambient);
  const float fog = r.unless("no fog", r.u("fog_depth"), 0.0f);
  const Float3 fogged = fog > 0 ? mix(r.u3("fog_colour"), light, exponential(-(fog * distance))) : light;
  const float reach = r.u("ground_reach");
  if (!(reach > 0)) return give(fogged);
  const float ox = std::max(std::abs(p.x * r.u("inverse_size", 0)) - 0.5f, 0.0f);
  const float oz = std::max(std::abs(p.z * r.u("inverse_size", 1)) - 0.5f, 0.0f);
  return give(mix(fogged, environment(r, rotated(r, v), r.u("background_level")), smoothstep(0, reach, std::sqrt(ox * ox + oz * oz))));
}

inline std::vector<Written> puddle_corrected_passes() {
  return {
      {{"puddle-corrected"}, "raindrops", "wrong constant", nullptr, raindrops_corrected},
      {{"puddle-corrected"}, "wave_step", "crater 2 s for 4 s", wave_step_of_document},
      {{"puddle-corrected"}, "surface_hit", "wrong constant", surface_hit_corrected},
      {{"puddle-corrected"}, "shade", "wrong constant", shade_corrected},
      {{"puddle-corrected"}, "display", "offset 0.55 for 0.055", puddle_display},
  };
}

}  // namespace rainref::documents
