// rainy_glass, from docs/effects/rainy_glass.md.
#pragma once

#include "documents/edge_splash.h"
#include "faults/mistakes_drops_and_maps.h"

namespace rainref::documents {

constexpr float two_pi = 6.28318531f;
inline float wrap(float x) { return x - std::floor(x + 0.5f); }

inline bool bake_rivulets(const Run& r, int i, int j, float* out) {
  const Float2 p{(static_cast<float>(i) + 0.5f) * r.u("inverse_size", 0), (static_cast<float>(j) + 0.5f) * r.u("inverse_size", 1)};
  float best = 0;
  Float2 g;
  for (int k = 0; k < r.whole("trail_count"); ++k) {
    const auto of = [&](const char* member) { return r.of("trails", k, member); };
    const float dy = fract(p.y - of("y") + 0.125f) - 0.125f,
                a = r.unless("wiggle in turns", two_pi, 1.0f) * wrap(of("wiggle_rate") * dy + of("wiggle_phase")),
                dx = wrap(p.x - of("x")) - of("wiggle") * sine(a);
    const bool is_tail = dy >= 0;
    const float height = of("height"), squared = of("half_width") * r.unless("width not squared", of("half_width"), 1.0f);
    const float along = is_tail || r.is("tails at both ends") ? dy * of("inverse_length") : dy * dy / squared,
                h = height * (1 - along - dx * dx / squared);
    if (!(h > best)) continue;
    best = h;
    const float c = constant(r, -2, -1) * height * dx / squared;
    g = {c, (is_tail ? -height * of("inverse_length") : -2 * height * dy / squared) -
                c * (two_pi * of("wiggle") * of("wiggle_rate") * r.unless("wiggle's cosine forgotten", cosine(a), 1.0f))};
  }
  const Float2 w = r.u("normal_scale") * g;
  const float size = std::sqrt(1 + w.x * w.x + w.y * w.y);
  out[0] = r.u("neutral") - r.u("span") * (w.x / size);
  out[1] = r.u("neutral") - r.u("span") * (w.y / size);
  const auto noise = [&](int cells, int channel) {
    const Float2 at = static_cast<float>(cells) * p;
    const int column = static_cast<int>(std::floor(at.x)), row = static_cast<int>(std::floor(at.y));
    const Float2 t{fract(at.x), fract(at.y)};
    const auto corner = [&](int dx, int dy) {
      const int over = r.unless("lattice not wrapped", cells, 2 * cells), x = (column + dx) % over, y = (row + dy) % over;
      return r.at("lattice", x, y, channel) * (t.x - static_cast<float>(dx)) +
             r.at("lattice", x, y, channel + 1) * (t.y - static_cast<float>(dy));
    };
    const auto ease = [&](float s) { return r.unless("cubic blending", s * s * s * (s * (6 * s - 15) + 10), s * s * (3 - 2 * s)); };
    return mix(mix(corner(0, 0), corner(1, 0), ease(t.x)), mix(corner(0, 1), corner(1, 1), ease(t.x)), ease(t.y));
  };
  const int cells = r.whole("flow_cells");
  for (int k = 0; k < 2; ++k) {
    const float flow = r.u("flow_gain") * (noise(cells, 2 * k) + r.unless("one octave", 0.5f, 0.0f) * noise(2 * cells, 2 * k));
    out[2 + k] = r.u("neutral") + r.u("span") * std::min(std::max(flow, -1.0f), 1.0f);
  }
  return true;
}

/// The probe along a direction in world axes.
inline Float3 probe(const Run& r, Float2 at) {
  const Float3 d = (r.u3("forward") + (in_branch(r, 1, 0.8f) * at.x) * r.u3("right")) + at.y * r.u3("up");
  return r.trilinear3("probe", 0.5f + arc(d.z, d.x) * 0.159154943f, 0.5f + arc(d.y, std::sqrt(d.x * d.x + d.z * d.z)) * 0.318309886f,
                      r.u("probe_level"));
}

inline bool rain_on_glass_of_article(const Run& r, int i, int j, float* out) {
  const auto give = [&](Float3 c) { return out[0] = c.x, out[1] = c.y, out[2] = c.z, out[3] = 1, true; };
  if (!(r.at("orientation", i, j, 3) > 0.5f)) return give(r.rgb("scene", i, j));
  const Float2 uv{r.at("surface", i, j, 0), r.at("surface", i, j, 1)};
  const auto turned = [&](const char* by) {
    const Float2 turn = u2(r, by);
    return Float2{uv.x * turn.x - uv.y * turn.y, uv.x * turn.y + uv.y * turn.x};
  };
  const Float2 at_drops = r.u("drop_tiles") * turned("turn"), drop_rg = linear2(r, "raindrops", at_drops),
               drop_ba = linear2(r, "raindrops", at_drops, 2);
  const float offset = r.whole("signed_offset") != 0 ? 2 * drop_ba.x - 1 : drop_ba.x,
              timer = fract(r.u("time") * r.u("drop_rate") + offset);
  const float mask = drop_ba.y - (1 - r.u("rain_amount")) - timer > 0 ? 1.0f : 0.0f;
  const Float2 at = r.u("rivulet_tiles") * turned("rivulet_turn") + Float2{0, r.u("scroll")}, ba = linear2(r, "rivulets", at, 2),
               from = u2(r, "flow_from"), span = u2(r, "flow_span"), flow{from.x + span.x * ba.x, from.y + span.y * ba.y};
  const float p1 = fract(r.u("time") * r.u("flow_rate")), p2 = fract(r.u("time") * r.u("flow_rate") + 0.5f),
              triangle = std::abs(1 - 2 * p1), w = r.whole("squared_weight") != 0 ? triangle * triangle : triangle;
  const auto moved = [&](float p) { return linear2(r, "rivulets", at + (r.u("flow_strength") * p) * flow); };
  const Float2 rivulet = mix(moved(p1), moved(p2), w), one{1, 1};
  const float upright = r.u("rivulet_amount") * std::min((1 - std::abs(r.at("orientation", i, j, 1))) * r.u("fade_rate"), 1.0f);
  const float twice = constant(r, 2, 1), distortion = r.u("distortion");
  const Float2 d = r.whole("remap_first") != 0 ? mask * (twice * drop_rg - one) + upright * (twice * rivulet - one)
                                               : twice * (mask * drop_rg + upright * rivulet) - one;
  const Float2 s{(static_cast<float>(i) + 0.5f) * r.u("pixel", 0) + distortion * d.x,
                 (static_cast<float>(j) + 0.5f) * r.u("pixel", 1) + distortion * d.y};
  const Float3 seen = r.whole("use_probe") == 0 ? r.linear3("scene", s.x, s.y)
                                                : probe(r, {(2 * s.x - 1) * r.u("half_width"), (2 * s.y - 1) * r.u("half_height")}),
               tint = r.u3("tint");
  return give({tint.x * seen.x, tint.y * seen.y, tint.z * seen.z});
}

inline bool rain_on_glass_corrected(const Run& r, int i, int j, float* out) {
  const auto give = [&](Float3 c) { return out[0] = c.x, out[1] = c.y, out[2] = c.z, out[3] = 1, true; };
  const Float3 own = r.rgb("scene", i, j), n = r.rgb("orientation", i, j);
  const float u = r.at("surface", i, j, 0), v = r.at("surface", i, j, 1), distance = r.at("surface", i, j, 2);
  const auto slope = [&](Float2 rg, float neutral, float scale) {
    const Float2 xy{(rg.x - neutral) * scale, (rg.y - neutral) * scale};
    if (r.is("normal for slope")) return -1.0f * xy;
    return (-1 / std::sqrt(std::max(1 - xy.x * xy.x - xy.y * xy.y, 0.04f))) * xy;
  };
  const Float2 at_drops = r.u("drop_tiles") * Float2{u, v};
  const Float2 drop_rg = linear2(r, "raindrops", at_drops), drop_ba = linear2(r, "raindrops", at_drops, 2);
  const float impact = r.u("impact"), amount = r.u("rain_amount") * saturate(dot(n, r.u3("rain_to"))),
              timer = fract(r.u("drop_phase") + drop_ba.x);
  const float dried = std::max(1 - timer * (1 / impact), (timer - impact) * (1 / (1 - impact)));
  const float shown = saturate((drop_ba.y - (1 - amount) - dried) * r.unless("not sharpened", r.u("sharpness"), 1.0f));

  const float neutral = r.u("rivulet_neutral"), scale = r.u("rivulet_scale");
  const Float2 at = r.u("rivulet_tiles") * Float2{u, v}, ba = linear2(r, "rivulets", at, 2);
  const Float2 flow{(ba.x - neutral) * scale * r.u("flow_strength"), (ba.y - neutral) * scale * r.u("run_strength")};
  const float p1 = fract(r.u("flow_phase")), p2 = fract(r.u("flow_phase") + 0.5f), w = std::abs(1 - 2 * p1);
  const auto moved = [&](float p) {
    return linear2(r, "rivulets",
                   (at + Float2{0, r.unless("rivulets stand", r.u("scroll"), 0.0f)}) + (p - r.unless("phases from 0", 0.5f, 0.0f)) * flow);
  };
  const Float2 rivulet_rg = mix(moved(p1), moved(p2), w);

  const float steep = std::sqrt(n.x * n.x + n.z * n.z);
  const Float2 s =
      shown * slope(drop_rg, r.u("drop_neutral"), r.u("drop_scale")) + (r.u("rivulet_amount") * steep) * slope(rivulet_rg, neutral, scale);
  const bool is_wet = s.x * s.x + s.y * s.y > 1e-8f;
  const float k = 1 / std::max(steep, 0.05f);
  const Float3 a{n.z * k, 0, -n.x * k}, b{n.y * a.z, n.z * a.x - n.x * a.z, -n.y * a.x};
  const Float3 rise = s.x * a + s.y * b;
  const float bend = constant(r, 1, 1.2f) * r.unless("bent the other way", 1.0f, -1.0f) * r.u("bend");
  const Float2 bent = bend * Float2{dot(rise, r.u3("right")), dot(rise, r.u3("up"))};

  const float depth = r.at("scene_depth", i, j), half_width = r.u("half_width"), half_height = r.u("half_height");
  if (!(r.at("orientation", i, j, 3) > 0.5f && depth > distance && is_wet)) return give(own);
  const Float2 c{(static_cast<float>(i) + 0.5f) * r.u("pixel", 0), (static_cast<float>(j) + 0.5f) * r.u("pixel", 1)};
  if (r.whole("use_probe") != 0) return give(probe(r, Float2{(2 * c.x - 1) * half_width, (2 * c.y - 1) * half_height} + bent));
  const float share = r.unless("as if far away", saturate(1 - distance / std::max(depth, 1e-3f)), 1.0f);
  const Float2 place{c.x + bent.x * share * r.unless("angle for a share of the picture", 0.5f / half_width, 1.0f),
                     c.y + bent.y * share * r.unless("angle for a share of the picture", 0.5f / half_height, 1.0f)};
  return give(r.linear("near_depth", place.x, place.y) > distance || r.is("near things not left out") ? r.linear3("scene", place.x, place.y)
                                                                                                      : own);
}

inline std::vector<Written> rainy_glass_document_passes() {
  const std::vector<std::string> both{"rainy_glass-as-published", "rainy_glass-corrected"};
  return {
      {both, "bake_raindrops", "axes of the ellipse exchanged", bake_droplets},
      {both, "bake_rivulets", "wrong constant", bake_rivulets},
      {{"rainy_glass-as-published"}, "rain_on_glass", "wrong constant", rain_on_glass_of_article},
      {{"rainy_glass-corrected"}, "rain_on_glass", "wrong constant", rain_on_glass_corrected},
      {both, "display", "wrong constant", display_of_document},
  };
}

}  // namespace rainref::documents
