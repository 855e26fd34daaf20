// The puddle as published, from docs/effects/puddle.md.
#pragma once

#include "documents/written.h"
#include "faults/mistakes_puddle.h"

namespace rainref::documents {

/// puddle.md, "Conventions".
inline Float3 view_ray(const Run& r, int i, int j) {
  const float scale = r.u("camera_pixel_scale"), half = r.unless("rays through corners", 0.5f, 0.0f);
  const float left = r.u(r.unless("bottom for left", "camera_plane_left", "camera_plane_bottom"));
  const float right = left + (static_cast<float>(i) + half) * scale,
              up = r.u("camera_plane_bottom") + (static_cast<float>(j) + half) * scale;
  if (r.is("ray not normalized")) return (r.u3("camera_forward") + right * r.u3("camera_right")) + up * r.u3("camera_up");
  return normalize((r.u3("camera_forward") + right * r.u3("camera_right")) + up * r.u3("camera_up"));
}

struct Crater {
  float x, y, amplitude, radius;
};

inline void raindrops_published(const Run& r, Given& out) {
  const float shift = r.is("33 for 33.33") ? 33.0f : 33.33f;
  const auto hash = [shift](float x, float y, float a, float b, float c) {
    const Float3 p{fract(x * a), fract(y * b), fract(x * c)};
    const float d = dot(p, Float3{p.y + shift, p.z + shift, p.x + shift});
    return Float3{p.x + d, p.y + d, p.z + d};
  };
  const float t = r.u("time") * r.u("rain_speed");
  for (int i = 0; i < r.whole("drop_count"); ++i) {
    const float offset = 0.3711f * static_cast<float>(i);
    const float sx = std::floor(t) + offset, sy = 17.3f * static_cast<float>(i);
    const Float3 q = hash(sx, sy, 0.1031f, 0.1030f, 0.0973f), s = hash(sx + 1, sy + 1, 0.1031f, 0.1031f, 0.1031f);
    const float strength = r.u("drop_intensity") * (0.5f + 0.5f * fract((s.x + s.y) * s.z));
    const float pulse = fract(t + 0.7f * offset);
    out.append("drops", Crater{fract((q.x + q.y) * q.z) * r.u("width"), fract((q.x + q.z) * q.y) * r.u("height"),
                               strength * (smoothstep(0, 0.15f, pulse) * smoothstep(0.35f, 0.2f, pulse)), 4});
  }
}

/// As the hand-made one, with neighbours between texels.
inline bool wave_step_published_of_document(const Run& r, int x, int y, float* out) {
  const float step = r.u("step"), f = in_branch(r, 1, 0.8f) * fract(step);
  if (f == 0) return wave_step_published(r, x, y, out);
  const int k = static_cast<int>(step);
  const auto s = [&](int dx, int dy) {
    return mix(r.at("wave", x + dx * k, y + dy * k), r.at("wave", x + dx * (k + 1), y + dy * (k + 1)), f);
  };
  float d = -2 * (r.at("wave", x, y, 1) - 0.5f) + ((((s(0, -1) + s(-1, 0)) + s(1, 0)) + s(0, 1)) - 2);
  d = d * r.u("damping");
  for (int i = 0; i < r.count("drops"); ++i) {
    if (!(r.of("drops", i, "amplitude") > 0.01f)) continue;
    const Float2 away{r.of("drops", i, "x") - (static_cast<float>(x) + 0.5f), r.of("drops", i, "y") - (static_cast<float>(y) + 0.5f)};
    d = d + r.of("drops", i, "amplitude") * smoothstep(4, 0.5f, length(away));
  }
  out[0] = d * 0.5f + 0.5f;
  out[1] = r.at("wave", x, y);
  return true;
}

inline bool surface_hit_published(const Run& r, int x, int y, float* out) {
  const Float3 eye = r.u3("camera_position"), d = view_ray(r, x, y), half = r.u3("half_size");
  const float epsilon = r.u("epsilon");
  const int max_steps = r.whole("max_steps");
  const auto u = [&](Float3 p) { return r.unless("place not halved", 0.5f, 1.0f) * (p.x / half.x + 1); };
  const auto v = [&](Float3 p) { return 0.5f * (p.z / half.z + 1); };
  const auto s = [&](float at_u, float at_v) { return r.linear("wave", at_u, at_v, r.unless("newest level", 1, 0)); };
  Float3 p = eye;
  float distance = 0;
  int steps = 0;
  for (int round = 0; round < max_steps; ++round) {
    const auto beyond = [](float a, float h) { return std::max(std::abs(a) - h, 0.0f); };
    distance = length(
        Float3{beyond(p.x, half.x), beyond(p.y + r.unless("wave downwards", 1.0f, -1.0f) * s(u(p), v(p)), half.y), beyond(p.z, half.z)});
    steps = round;
    if (distance < epsilon || distance >= 1000) break;
    p = p + distance * d;
  }
  const bool is_hit = distance < epsilon;
  if (!is_hit) {
    p = eye;
    steps = max_steps - 1;
  }
  const float du = r.u("texel", 0), dv = r.u("texel", 1), gain = r.is("wrong constant") ? 2 : r.u("normal_gain");
  Float3 n = normalize({gain * (s(u(p) - du, v(p)) - s(u(p) + du, v(p))), 1, gain * (s(u(p), v(p) - dv) - s(u(p), v(p) + dv))});
  if (r.is("normal's axes exchanged")) std::swap(n.x, n.z);
  const float values[]{p.x, p.y, p.z, static_cast<float>(steps), n.x, n.y, n.z, is_hit ? 1.0f : 0.0f};
  std::copy(std::begin(values), std::end(values), out);
  return true;
}

/// Where the refracted ray meets the ground; t ≤ 0: nowhere.
struct PublishedGround {
  float t = -1, x = 0, z = 0;
};
inline PublishedGround ground_of(const Run& r, Float3 p, Float3 n, Float3 v) {
  const Float3 b = refract(v, n, r.unless("into air", 1 / 1.333f, 1.333f));
  PublishedGround g;
  if (std::abs(b.y) >= 0.0001f) g.t = (-r.u("puddle_depth") - p.y) / b.y;
  if (g.t <= 0) return {};
  g.x = p.x + g.t * b.x;
  g.z = p.z + g.t * b.z;
  return g;
}

inline bool ground_noise_published(const Run& r, int x, int y, float* out) {
  out[0] = 0.5f;
  const PublishedGround g = ground_of(r, r.rgb("hit", x, y), r.rgb("normal", x, y), view_ray(r, x, y));
  if (g.t > 0) out[0] = fract(sine(12.9898f * g.x + 78.233f * g.z) * 43758.5453f);
  return true;
}

inline Float3 rotated(const Run& r, Float3 d) {
  const float c = r.u("rotation", 0), s = r.unless("turned the other way", 1.0f, -1.0f) * r.u("rotation", 1);
  return {c * d.x + s * d.z, d.y, c * d.z - s * d.x};
}
/// Face and coordinates on it as OpenGL, Vulkan and Direct3D have them.
inline Float3 cube(const Run& r, Float3 d, float lod) {
  const float ax = std::abs(d.x), ay = std::abs(d.y), az = std::abs(d.z), most = std::max({ax, ay, az});
  int face;
  float s, t;
  if (most == ax) {
    face = d.x >= 0 ? 0 : 1, s = d.x >= 0 ? -d.z : d.z, t = -d.y;
  } else if (most == ay) {
    face = d.y >= 0 ? 2 : 3, s = d.x, t = d.y >= 0 ? d.z : -d.z;
  } else {
    face = d.z >= 0 ? 4 : 5, s = d.z >= 0 ? d.x : -d.x, t = -d.y;
  }
  const int levels = static_cast<int>(r.input("environment").array.levels.size());
  const int level = std::clamp(static_cast<int>(std::floor(lod + 0.5f)), 0, levels - 1);
  const float side = static_cast<float>(r.input("environment").array.level_width(level)), inside = 0.5f / side;
  const auto held = [&](float c) { return std::min(std::max(in_branch(r, 0.5f, 0.4f) * (c / most) + 0.5f, inside), 1 - inside); };
  return r.linear3("environment", held(s), (static_cast<float>(face) + held(t)) / 6, level);
}
inline Float3 environment(const Run& r, Float3 d, float lod) {
  if (r.whole("environment_is_cube") != 0) return cube(r, d, lod);
  const float per_turn = 0.159154943f, per_half_turn = 0.318309886f;
  if (r.is("azimuth from z")) std::swap(d.x, d.z);
  return r.trilinear3("environment", 0.5f + arc(d.z, d.x) * per_turn, 0.5f + arc(d.y, std::sqrt(d.x * d.x + d.z * d.z)) * per_half_turn,
                      lod);
}
inline Float3 checkerboard(float x, float z, float scale) {
  const float k = std::floor(x * scale) + std::floor(z * scale);
  return mix({0.15f, 0.12f, 0.10f}, {0.25f, 0.22f, 0.20f}, k - 2 * std::floor(k * 0.5f));
}
inline float schlick(float cosine, float n = 1.333f) {
  const float ratio = (1 - n) / (1 + n), f0 = ratio * ratio, m = 1 - cosine;
  return f0 + (1 - f0) * ((m * m) * (m * m) * m);
}

inline bool shade_published(const Run& r, int x, int y, float* out) {
  const float exponent = r.unless("not decoded", 2.2f, 1.0f);
  const auto decoded = [&](Float3 c) { return Float3{power(c.x, exponent), power(c.y, exponent), power(c.z, exponent)}; };
  const auto give = [&](Float3 c) { return out[0] = c.x, out[1] = c.y, out[2] = c.z, out[3] = 1, true; };
  const Float3 v = view_ray(r, x, y), n = r.rgb("normal", x, y), p = r.rgb("hit", x, y), eye = r.u3("camera_position");
  if (!(r.at("normal", x, y, 3) > 0.5f)) return give(decoded(environment(r, rotated(r, v), 0)));
  const float f = schlick(std::min(std::abs(dot(v, n)), 1.0f));
  const Float3 mirror = decoded(environment(r, rotated(r, reflect(v, n)), 0));
  const PublishedGround g = ground_of(r, p, n, v);
  const Float3 tint = r.u3("tint");
  Float3 below = constant(r, 0.3f, 0.4f) * tint;
  if (g.t > 0) {
    const float scale = r.unless("ground's scale divides", r.u("ground_scale"), 1 / r.u("ground_scale")),
                grain = (r.at("noise", x, y) - 0.5f) * 0.05f;
    const Float3 ground = r.whole("use_checkerboard") != 0
                              ? checkerboard(g.x, g.z, scale) + Float3{grain, grain, grain}
                              : in_branch(r, 0.6f, 0.5f) * decoded(r.linear3("ground", g.x * scale, g.z * scale));
    const float share = exponential(-(r.unless("turbidity forgotten", r.u("water_turbidity"), 1.0f) * std::max(g.t, 0.0f)));
    below = (constant(r, 0.7f, 0.75f) * (Float3{1, 1, 1} - 0.5f * tint)) * mix(tint, ground, share);
  }
  Float3 colour = mix(below, mirror, f * (mix(0.3f, 0.8f, r.u("reflectivity")) - 0.3f) + 0.3f) + (0.15f * (1 - f)) * tint;
  const float distance = r.unless("fog of the squared distance", length(p - eye), dot(p - eye, p - eye));
  return give(mix(0.7f * colour, colour, exponential(-(r.u("fog_depth") * distance))));
}

inline std::vector<Written> puddle_published_passes() {
  return {
      {{"puddle-as-published"}, "raindrops", "33 for 33.33", nullptr, raindrops_published},
      {{"puddle-as-published"}, "wave_step", "wider drops", wave_step_published_of_document},
      {{"puddle-as-published"}, "surface_hit", "wrong constant", surface_hit_published},
      {{"puddle-as-published"}, "ground_noise", "", ground_noise_published},
      {{"puddle-as-published"}, "shade", "wrong constant", shade_published},
      {{"puddle-as-published"}, "display", "exponent 1/2.4", puddle_display},
  };
}

}  // namespace rainref::documents
