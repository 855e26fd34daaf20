// The windshield's frame of forces, normals, pyramid and picture, from docs/effects/windshield.md.
#pragma once

#include "documents/edge_splash.h"
#include "documents/puddle_corrected.h"
#include "documents/wipers.h"
#include "faults/mistakes_windshield.h"

namespace rainref::documents {

/// A pixel's centre, and where its ray meets a pane.
struct PlaceOnPane {
  Float3 q;
  float u, v;
  bool on;
};
inline PlaceOnPane place_on_pane(const Run& r, int x, int y) {
  const Float3 q{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, 1};
  const float m = dot(r.u3("w_row"), q), k = 1 / std::max(m, 1e-6f), u = dot(r.u3("u_row"), q) * k, v = dot(r.u3("v_row"), q) * k;
  return {q, u, v, m > 1e-6f && u >= 0 && u <= 1 && v >= 0 && v <= 1};
}

struct GlassFrame {
  Float2 gravity, wind, acceleration;
  std::uint32_t id = 0, padding = 0;
  std::array<float, 4> spin{}, coriolis{};
};
inline Float3 apparent_wind(const Run& r) {
  const Float3 w = r.u3("world_wind") - r.unless("wind of the world", r.u3("vehicle_velocity"), Float3{});
  const float c = r.u("heading", 0), s = r.unless("heading the other way", 1.0f, -1.0f) * r.u("heading", 1);
  return {c * w.x + s * w.y, c * w.y - s * w.x, w.z};
}
inline void windshield_frame_published(const Run& r, Given& out) {
  const auto project = [&](Float3 f) {
    return Float2{dot(f, r.u3("e_u")) * r.u("inverse_metric", 0), dot(f, r.u3("e_v")) * r.u("inverse_metric", 2)};
  };
  const float gravity = constant(r, 1, 1.01f) * r.u("gravity");
  out.append("glass_frame", GlassFrame{project({0, 0, -gravity}), project(apparent_wind(r)), project(r.u3("acceleration"))});
}
inline void windshield_frame_corrected(const Run& r, Given& out) {
  const Float3 e_u = r.u3("e_u"), e_v = r.u3("e_v"), a = r.u3("acceleration");
  const float uu = r.u("inverse_metric", 0), uv = r.u("inverse_metric", 1), vv = r.u("inverse_metric", 2);
  const auto project = [&](Float3 f) {
    const float u = dot(f, e_u), v = dot(f, e_v);
    return Float2{uu * u + uv * v, uv * u + vv * v};
  };
  const float omega = r.u("yaw_rate"), alpha = r.u("yaw_acceleration"), squared = omega * omega;
  const float two = constant(r, 2, 1) * omega;
  const auto rotation = [&](Float3 p) { return Float3{alpha * p.y + squared * p.x, squared * p.y - alpha * p.x, 0}; };
  const auto coriolis = [&](Float3 v) { return Float3{two * v.y, -two * v.x, 0}; };
  const Float3 down{-a.x, -a.y, -(r.u("gravity") + a.z)};
  GlassFrame frame{project(down + rotation(r.u3("origin"))), project(apparent_wind(r)), {}};
  const auto columns = [](Float2 of_u, Float2 of_v) { return std::array{of_u.x, of_v.x, of_u.y, of_v.y}; };
  frame.spin = columns(project(rotation(e_u)), project(rotation(e_v)));
  frame.coriolis = columns(project(coriolis(e_u)), project(coriolis(e_v)));
  out.append("glass_frame", frame);
}

inline bool blur_pyramid(const Run& r, int x, int y, float* out) {
  out[3] = 1;
  if (r.taken().level == 0) return fog_level(r, x, y, out);
  for (int k = 0; k < 3; ++k) {
    const int first = r.unless("from one texel on", 0, 1);
    // A mirror at both edges: 0 1 2 2 1 0 0 1 ...
    const auto seen = [&](int i, int n) {
      if (!r.taken().corrected()) return i;
      const int in_turn = (i % (2 * n) + 2 * n) % (2 * n);
      return std::min(in_turn, 2 * n - 1 - in_turn);
    };
    const auto texel = [&](int i, int j) {
      return r.at("blurred", seen(2 * x + i + first, r.width("blurred")), seen(2 * y + j, r.height("blurred")), k);
    };
    if (!r.taken().corrected()) {
      out[k] = r.unless("sum for mean", 0.25f, 1.0f) * ((texel(0, 0) + texel(1, 0)) + (texel(0, 1) + texel(1, 1)));
      continue;
    }
    const auto weighed = [&](int axis, int at, const auto& t) {
      const auto bell = [&](int i) { return (0.375f * t(i) + 0.25f * (t(i - 1) + t(i + 1))) + 0.0625f * (t(i - 2) + t(i + 2)); };
      const float t0 = bell(0), t1 = bell(1), t2 = bell(2);
      const float w1 = r.u("middle", axis), w2 = r.u("last", axis) * static_cast<float>(at + r.unless("columns from 0", 1, 0));
      return t0 + w1 * (t1 - t0) + w2 * (t2 - t0);
    };
    const auto column = [&](int i) { return weighed(1, y, [&](int j) { return texel(i, j); }); };
    out[k] = weighed(0, x, column);
  }
  return true;
}

inline bool persist(const Run& r, int x, int y, float* out) {
  out[0] = std::max(r.at("height", x, y), constant(r, 1, 1.1f) * (r.at("previous_height", x, y) * r.u("keep")));
  return true;
}

inline bool falling_rain(const Run& r, int x, int y, float* out) {
  const Float2 at{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
  Float3 colour = r.rgb("blurred", x, y);
  const auto number = [&](int i, const char* member, int k = 0) { return r.of("streaks", i, member, k); };
  for (int i = 0; i < r.count("streaks"); ++i) {
    const float distance = segment(at, {number(i, "opened"), number(i, "opened", 1)}, {number(i, "closed"), number(i, "closed", 1)});
    const float covered = saturate(0.5f + (constant(r, 1, 3) * number(i, "radius") - distance)),
                before = saturate((r.at("scene_depth", x, y) - number(i, "depth")) * r.u("sharpness"));
    colour = mix(colour, Float3{number(i, "radiance"), number(i, "radiance", 1), number(i, "radiance", 2)},
                 number(i, "opacity") * covered * before);
  }
  return give_opaque(out, colour);
}

inline bool join_panes(const Run& r, int x, int y, float* out) {
  const auto [q, u, v, on] = place_on_pane(r, x, y);
  const Float3 colour = on ? constant(r, 1, 1.1f) * r.rgb("pane_colour", x, y) : r.rgb("colour", x, y);
  return give_opaque(out, colour);
}

inline bool smear(const Run& r, int x, int y, float* out) {
  const Float2 p = plane(r, {static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f});
  Float3 film = r.rgb("laid", x, y);
  for (const Wiper& w : wipers_of(r)) {
    const Float2 away = p - w.pivot;
    const float size = length(away), along = saturate((size - w.inner_radius) / (w.outer_radius - w.inner_radius)),
                inverse = 1 / std::max(size, 1e-6f);
    film = mix(film, Float3{away.x * inverse, away.y * inverse, r.linear("profile", along, 0.5f)}, coverage_of(r, w, p));
  }
  film.z = film.z * (1 - std::min(r.at("height", x, y) * r.u("inverse_water"), 1.0f));
  out[0] = out[4] = film.x;
  out[1] = out[5] = film.y;
  out[2] = std::max(film.z - constant(r, 1, 0.9f) * (r.u("drying") * r.at("wiped", x, y)), 0.0f);
  out[6] = film.z;
  out[3] = out[7] = 1;
  return true;
}

inline bool condense(const Run& r, int x, int y, float* out) {
  const float taken = std::min(r.at("height", x, y) * r.u("inverse_water"), 1.0f), wiped = r.at("wiped", x, y);
  const float grown = std::min(r.at("clear_time", x, y) + r.u("dt"), r.u("limit")) * (1 - constant(r, 1, 0.9f) * taken);
  out[1] = std::min(grown, wiped < r.u("wiped_limit") ? wiped : r.u("limit"));
  out[0] = r.u("most") * (1 - exponential(-(out[1] * r.u("inverse_tau"))));
  return true;
}

inline bool soften(const Run& r, int x, int y, float* out) {
  const auto [q, u, v, on] = place_on_pane(r, x, y);
  const Float3 film = r.linear3("smear", saturate(u), saturate(v));
  const float share = on ? r.u("most") * film.z : 0;
  const Float2 G{q.x * r.u("pixel", 0) - r.u("half_size", 0), q.y * r.u("pixel", 1) - r.u("half_size", 1)};
  const Float2 S{0.5f + G.x * r.u("scene_scale", 0), 0.5f + G.y * r.u("scene_scale", 1)};
  const Float3 A = film.x * r.u3("plane_x") + film.y * r.u3("plane_y");
  const Float2 turned{(A.x - A.z * G.x) * r.u("scene_scale", 0), (A.y - A.z * G.y) * r.u("scene_scale", 1)};
  Float3 colour = r.rgb("colour", x, y), sum;
  for (int i = 0; i < r.whole("deflection_count"); ++i) {
    const float tangent = r.of("deflections", i, "tangent");
    sum = sum + r.of("deflections", i, "weight") * r.trilinear3("blurred", S.x + tangent * turned.x, S.y + tangent * turned.y, r.u("lod"));
  }
  if (share > 0) colour = mix(colour, sum, constant(r, 1, 0.9f) * share);
  return give_opaque(out, colour);
}

inline bool mist(const Run& r, int x, int y, float* out) {
  const auto [q, u, v, on] = place_on_pane(r, x, y);
  const float share = on ? constant(r, 1, 0.9f) * r.linear("condensation", saturate(u), saturate(v)) : 0;
  const Float2 G{q.x * r.u("pixel", 0) - r.u("half_size", 0), q.y * r.u("pixel", 1) - r.u("half_size", 1)};
  const Float2 S{0.5f + G.x * r.u("scene_scale", 0), 0.5f + G.y * r.u("scene_scale", 1)};
  Float3 sum;
  for (int i = 0; i < r.whole("tap_count"); ++i)
    sum = sum + r.trilinear3("blurred", S.x + r.of("taps", i, "x"), S.y + r.of("taps", i, "y"), r.u("lod"));
  const Float3 light = mix(r.u("weight") * sum, r.trilinear3("blurred", S.x, S.y, 15), r.u("veil"));
  const Float3 colour = mix(r.rgb("colour", x, y), light, share);
  return give_opaque(out, colour);
}

inline bool interior(const Run& r, int x, int y, float* out) {
  const float open = 1 - constant(r, 1, 0.9f) * r.at("interior", x, y, 3);
  for (int k = 0; k < 3; ++k) out[k] = r.u("light") * r.at("interior", x, y, k) + open * r.at("colour", x, y, k);
  out[3] = 1;
  return true;
}

inline bool composite_corrected(const Run& r, int x, int y, float* out) {
  const Float3 q{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f, 1};
  const float m = dot(r.u3("w_row"), q), k = 1 / std::max(m, 1e-6f);
  float u = dot(r.u3("u_row"), q) * k, v = dot(r.u3("v_row"), q) * k;
  if (r.is("u and v exchanged")) std::swap(u, v);
  const bool on = m > 1e-6f && u >= 0 && u <= 1 && v >= 0 && v <= 1;
  u = saturate(u);
  v = saturate(v);
  const float from_middle = r.unless("plane from its corner", 1.0f, 0.0f);
  const Float2 g{q.x * r.u("pixel", 0) - from_middle * r.u("half_size", 0), q.y * r.u("pixel", 1) - from_middle * r.u("half_size", 1)};
  const float distance = r.u("glass_distance") * k;
  Float3 n = r.linear3("normal", u, v);
  n.z = std::max(n.z, 0.05f);
  const float mask = saturate(r.linear("mask", u, v)), wet = 1 - mask;
  const float vis = smoothstep(r.u("visible_from"), r.u("visible_to"), r.linear("height", u, v));
  const auto place = [&](Float2 p) { return Float2{0.5f + p.x * r.u("scene_scale", 0), 0.5f + p.y * r.u("scene_scale", 1)}; };
  const Float3 d = normalize({g.x, g.y, 1}), outward = r.u3("outward");
  const Float3 facing = n.x * r.u3("plane_x") + n.y * r.u3("plane_y") + n.z * outward;
  const float ior = constant(r, 1, 1.05f) * r.u("water_ior");
  const Float3 b = refract(refract(d, -1.0f * outward, 1 / ior), -1.0f * facing, ior);
  const float f = exact_fresnel(saturate(dot(b, facing)), ior);
  const Float2 straight = place(g);
  const float far = std::max(r.linear("scene_depth", straight.x, straight.y) - distance, 0.0f),
              share = distance / std::max(distance + far, 1e-3f), ahead = std::max(b.z, 0.05f);
  const Float2 s = place(mix({b.x / ahead, b.y / ahead}, g, share));
  const Float3 sharp = r.linear3("blurred", s.x, s.y),
               blur = r.trilinear3("blurred", s.x, s.y, r.unless("blur of the sharp level", r.u("blur_lod"), 0.0f));
  Float3 colour = mix(mix(sharp, blur, r.u("wetness") * wet * (1 - vis)), r.u("inner") * blur, r.unless("no inner reflection", f, 0.0f));
  const float film = vis * (1 - mask * mask);
  for (int i = 0; i < r.whole("glint_count") && film > 0; ++i) {
    const auto of = [&](const char* member) {
      return Float3{r.of("glints", i, member, 0), r.of("glints", i, member, 1), r.of("glints", i, member, 2)};
    };
    const Float3 h = of("direction") - d;
    const float along = std::max(saturate(dot(-1.0f * facing, h) / std::max(length(h), 1e-4f)), 1e-4f);
    colour = colour + power(along, r.u("shininess")) * (r.u("glint_strength") * film) * of("radiance");
  }
  if (!on) colour = r.u3("cabin");
  return give_opaque(out, colour);
}

inline std::vector<Written> windshield_picture_passes() {
  const std::vector<std::string> both{"windshield-as-published", "windshield-corrected"};
  return {
      {{"windshield-as-published"}, "windshield_frame", "wrong constant", nullptr, windshield_frame_published},
      {{"windshield-corrected"}, "windshield_frame", "wrong constant", nullptr, windshield_frame_corrected},
      {both, "normals", "slope doubled", windshield_normals},
      {both, "blur_pyramid", "base 2", blur_pyramid},
      {{"windshield-as-published"}, "composite", "linear visibility", composite_published},
      {{"windshield-corrected"}, "composite", "wrong constant", composite_corrected},
      {{"windshield-corrected"}, "smear", "wrong constant", smear},
      {{"windshield-corrected"}, "condense", "wrong constant", condense},
      {{"windshield-corrected"}, "soften", "wrong constant", soften},
      {{"windshield-corrected"}, "mist", "wrong constant", mist},
      {{"windshield-as-published"}, "persist", "wrong constant", persist},
      {both, "falling_rain", "wrong constant", falling_rain},
      {both, "join_panes", "wrong constant", join_panes},
      {{"windshield-corrected"}, "interior", "wrong constant", interior},
      {both, "display", "wrong constant", display_of_document},
  };
}

}  // namespace rainref::documents
