// normals, composite, blur_pyramid and display of the windshield, by hand from docs/effects/windshield.md.
#pragma once

#include "faults/hand_made.h"

namespace rainref::faults::hand {

inline bool windshield_normals(const Run& r, int x, int y, float* out) {
  const bool corrected = r.taken().corrected();
  const Address wrap = Address::repeat;
  const Address* const address = r.is("wraps at the edge") ? &wrap : nullptr;
  const auto height = [&](int dx, int dy) {
    if (r.is("columns and rows swapped")) std::swap(dx, dy);
    if (r.is("one-sided differences") && (dx < 0 || dy < 0)) dx = dy = 0;
    if (r.is("two texels apart")) dx *= 2, dy *= 2;
    const float h = r.at("height", x + dx, y + dy, 0, 0, address), m = r.at("mask", x + dx, y + dy, 0, 0, address);
    if (r.is("mask's sense")) return corrected ? h : h * m;
    return corrected || r.is("mask forgotten") ? h : h * (1 - m);
  };
  const float dx = height(1, 0) - height(-1, 0), dy = height(0, 1) - height(0, -1);
  float kept = corrected && !r.is("mask forgotten") ? 1 - r.at("mask", x, y) : 1;
  if (corrected && r.is("mask's sense")) kept = r.at("mask", x, y);
  float sx = r.u("slope_x"), sy = r.u("slope_y"), shear = corrected ? r.u("slope_shear") : 0;
  if (r.is("slopes swapped")) std::swap(sx, sy);
  if (r.is("shear forgotten")) shear = 0;
  if (r.is("slope doubled")) sx *= 2, sy *= 2, shear *= 2;
  Float3 n{-kept * (sx * dx), -kept * (shear * dx + sy * dy), 1};
  if (r.is("y the other way")) n.y = -n.y;
  if (r.is("both the other way")) n.x = -n.x, n.y = -n.y;
  const float size = length(n);
  out[0] = n.x / size;
  out[1] = n.y / size;
  out[2] = n.z / size;
  out[3] = 1;
  if (r.is("packed for 8 bits"))
    for (int k = 0; k < 3; ++k) out[k] = out[k] * 0.5f + 0.5f;
  if (r.is("y up")) std::swap(out[1], out[2]);
  return true;
}

inline bool fog_level(const Run& r, int x, int y, float* out) {
  if (r.taken().level != 0) return false;
  const Float3 colour = r.rgb("scene_colour", x, y);
  float depth = r.at("scene_depth", x, y), density = r.u("fog_density");
  if (r.is("depth of the row above")) depth = r.at("scene_depth", x, y + 1);
  float share = exponential(-(density * std::max(depth, 0.0f)));
  if (r.is("base 2")) share = static_cast<float>(std::exp2(-static_cast<double>(density * depth)));
  if (r.is("squared fog")) share = exponential(-(density * depth) * (density * depth));
  if (r.is("sign of the exponent")) share = exponential(density * depth);
  if (r.is("linear fog")) share = 1 - density * depth;
  Float3 fogged = mix(r.u3("fog_colour"), colour, share);
  if (r.is("ends swapped")) fogged = mix(colour, r.u3("fog_colour"), share);
  if (r.is("fog added")) fogged = colour + (1 - share) * r.u3("fog_colour");
  if (r.is("fog's blue first")) fogged = mix({r.u("fog_colour", 2), r.u("fog_colour", 1), r.u("fog_colour", 0)}, colour, share);
  if (r.is("blended in gamma space")) {
    const Float3 fog = r.u3("fog_colour");
    const auto blend = [&](float a, float b) { return power(mix(power(a, 1 / 2.2f), power(b, 1 / 2.2f), share), 2.2f); };
    fogged = {blend(fog.x, colour.x), blend(fog.y, colour.y), blend(fog.z, colour.z)};
  }
  out[0] = fogged.x;
  out[1] = fogged.y;
  out[2] = fogged.z;
  out[3] = 1;
  return true;
}

inline bool composite_published(const Run& r, int x, int y, float* out) {
  const float half = r.is("pixel corner") ? 0 : 0.5f;
  const Float3 q{static_cast<float>(x) + half, static_cast<float>(y) + half, 1};
  const float m = dot(r.u3("w_row"), q), k = 1 / std::max(m, 1e-6f);
  float u = dot(r.u3("u_row"), q) * k, v = dot(r.u3("v_row"), q) * k;
  if (r.is("glass coordinates not divided")) u = dot(r.u3("u_row"), q), v = dot(r.u3("v_row"), q);
  const bool on = m > 1e-6f && u >= 0 && u <= 1 && v >= 0 && v <= 1;
  u = saturate(u);
  v = saturate(v);
  float gx = q.x * r.u("pixel", 0) - r.u("half_size", 0), gy = q.y * r.u("pixel", 1) - r.u("half_size", 1);
  if (r.is("aspect forgotten")) gx = gx * (r.u("half_size", 1) / r.u("half_size", 0));
  const Float3 stored = r.is("nearest normals") ? r.nearest3("normal", u, v) : r.linear3("normal", u, v);
  const Float3 n{stored.x, stored.y, std::max(stored.z, 0.05f)};
  const float height = r.is("height and mask swapped") ? r.linear("mask", u, v) : r.linear("height", u, v);
  const float mask = saturate(r.is("height and mask swapped") ? r.linear("height", u, v) : r.linear("mask", u, v));
  const float wet = r.is("wet is the mask") ? mask : 1 - mask;
  const float from = r.u("visible_from"), to = r.u("visible_to");
  float vis = smoothstep(from, to, height) * wet;
  if (r.is("visibility upside down")) vis = smoothstep(to, from, height) * wet;
  if (r.is("linear visibility")) vis = saturate((height - from) / (to - from)) * wet;
  const float su = 0.5f + gx * r.u("scene_scale", 0),
              sv = r.is("scene upside down") ? 0.5f - gy * r.u("scene_scale", 1) : 0.5f + gy * r.u("scene_scale", 1);
  float offset = r.u("refraction") * vis;
  if (r.is("refraction the other way")) offset = -offset;
  if (r.is("offset does not fade")) offset = r.u("refraction");
  const float lod = r.is("one level too coarse") ? r.u("blur_lod") + 1 : r.u("blur_lod");
  const Float3 behind = r.linear3("blurred", su, sv), blur = r.trilinear3("blurred", su, sv, lod);
  const Float3 sharp = r.linear3("blurred", su + offset * n.x, sv + offset * n.y);
  float wetness = r.u("wetness") * wet;
  if (r.is("wetness forgotten")) wetness = wet;
  Float3 colour = mix(mix(behind, blur, wetness), sharp, vis);
  if (r.is("film over drops")) colour = mix(mix(behind, sharp, vis), blur, wetness);
  const Float3 ray{gx, gy, 1}, eye = (-1 / length(ray)) * ray;
  Float3 facing = -1.0f * (n.x * r.u3("plane_x") + n.y * r.u3("plane_y") + n.z * r.u3("outward"));
  if (r.is("highlight from behind")) facing = -1.0f * facing;
  for (int g = 0; g < r.whole("glint_count") && vis > 0; ++g) {
    const Float3 light{r.of("glints", g, "direction", 0), r.of("glints", g, "direction", 1), r.of("glints", g, "direction", 2)},
        radiance{r.of("glints", g, "radiance", 0), r.of("glints", g, "radiance", 1), r.of("glints", g, "radiance", 2)};
    const Float3 h = light + eye;
    const float cosine = std::max(saturate(dot(facing, h) / std::max(length(h), 1e-4f)), 1e-4f);
    colour = colour + power(cosine, r.u("shininess")) * (r.u("glint_strength") * vis) * radiance;
  }
  colour = mix(r.u3("cabin"), colour, on || r.is("cabin forgotten") ? 1 : 0);
  out[0] = colour.x;
  out[1] = colour.y;
  out[2] = colour.z;
  out[3] = 1;
  return true;
}

inline bool exposed_display(const Run& r, int x, int y, float* out) {
  const Float3 colour = r.rgb("colour", r.is("one column off") ? x + 1 : x, y);
  const float exposure = r.is("exposure forgotten") ? 1 : r.is("exposure divided") ? 1 / r.u("exposure") : r.u("exposure");
  const float* const in = &colour.x;
  for (int k = 0; k < 3; ++k) {
    float v = exposure * in[k];
    if (r.is("tone mapped")) v = v / (1 + v);
    out[k] = srgb(saturate(v));
  }
  out[3] = 1;
  return true;
}

inline std::vector<Pass> windshield_passes() {
  return {
      {"windshield-corrected",
       "normals",
       windshield_normals,
       {
           {"wraps at the edge", {"repeated beyond its edge"}},
           {"columns and rows swapped", {"neighbours with x and y exchanged", "height with u and v"}},
           {"one-sided differences", {"height neighbours on one side alone"}},
           {"two texels apart", {"neighbours two texels away"}},
           {"mask's sense", {"input mask from 1 down", "complement left out: 1 - mask"}},
           {"mask forgotten", {"factor left out: 1 - mask", "term left out: mask", "input mask without its x"}},
           {"slopes swapped", {"uniforms slope_x and slope_y exchanged"}},
           {"shear forgotten", {"uniform slope_shear is zero", "=slope_shear left out", "term left out: slope_shear"}},
           {"slope doubled", {"input height doubled", "height - height: "}},
           {"y the other way", {"normal with its y negated"}},
           {"both the other way",
            {"neighbours on both sides mirrored", "input height with its x negated", "difference the other way: height - height"}},

           {"packed for 8 bits", {"packed as v / 2 + 1/2"}},
           {"y up", {"normal with its second and third channel swapped", "normal with its y and z exchanged"}},
       }},
      {"windshield-as-published",
       "normals",
       windshield_normals,
       {
           {"mask forgotten", {"factor left out: 1 - mask", "term left out: mask", "input mask without its x"}},
           {"y the other way",
            {"normal with its y negated", "slope_y negated", "slope_y with the other sign", "sign of a product: slope_y"}},
           {"one-sided differences", {"neighbours on one side alone"}},
       }},
      {"windshield-corrected",
       "blur_pyramid",
       fog_level,
       {
           {"depth of the row above", {"scene_depth read a row further on", "scene_depth read one row up"}},
           {"base 2", {"exp2 for exp", "another value of fog_density"}},
           {"squared fog", {"squared: fog_density"}},
           {"sign of the exponent",
            {"fog_density with the other sign", "uniform fog_density negated", "sign of a product: fog_density",
             "sign of a term: fog_density"}},
           {"linear fog", {"linear for an exponential"}},
           {"ends swapped", {"mix ends swapped"}},
           {"fog added", {"added for mixed"}},
           {"fog's blue first", {"uniform fog_colour.zyx", "uniform fog_colour reversed"}},
           {"blended in gamma space", {"blended in gamma space"}},
       }},
      {"windshield-as-published",
       "composite",
       composite_published,
       {
           {"pixel corner", {"half a texel of the pixel's centre missing"}},
           {"glass coordinates not divided", {"factor left out: 1 /", "division left out: by max(("}},
           {"aspect forgotten", {"without the aspect ratio"}},
           {"nearest normals", {"nearest for linear: normal"}},
           {"height and mask swapped", {"inputs height and mask exchanged"}},
           {"wet is the mask", {"input mask from 1 down", "complement left out: 1 - min(max(mask"}},
           {"visibility upside down", {"smoothstep's edges swapped", "uniforms visible_from and visible_to exchanged"}},
           {"linear visibility", {"linear for smoothstep"}},
           {"scene upside down", {"scene_scale.y with the other sign", "uniform scene_scale y negated", "scene_scale.y"}},
           {"refraction the other way",
            {"sign of a term: (refraction", "refraction with the other sign", "uniform refraction negated", "sign of a product: refraction",
             "sign of a term: refraction"}},

           {"one level too coarse",
            {"mip level above: blurred", "blur_lod one more", "another value of blur_lod", "input blurred one level above"}},
           {"wetness forgotten", {"wetness left out of a product", "factor left out: wetness"}},
           {"film over drops", {"the mixes the other way round"}},
           {"highlight from behind", {"sign of a product: -1", "-1 with the other sign", "radiance of glints"}},
           {"cabin forgotten", {"mix left out: mix(cabin", "condition left out"}},
       }},
      {"windshield-as-published",
       "display",
       exposed_display,
       {
           {"one column off", {"one column off", "a column to the", "one column to the"}},
           {"exposure forgotten", {"exposure left out of a product", "factor left out: exposure"}},
           {"exposure divided", {"exposure inverted", "divided for multiplied: exposure", "exposure halved"}},
           {"tone mapped", {"tone"}},
       }},
  };
}

}  // namespace rainref::faults::hand
