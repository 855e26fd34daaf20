// background and drops of screen_drops, and splash of edge_splash, by hand from docs/effects.
#pragma once

#include "faults/hand_made.h"

namespace rainref::faults::hand {

inline bool background_published(const Run& r, int x, int y, float* out) {
  const float half = r.is("pixel corner") ? 0 : 0.5f;
  float u = (static_cast<float>(x) + half) / r.u("resolution", r.is("height for width") ? 1 : 0),
        v = (static_cast<float>(y) + half) / r.u("resolution", 1);
  if (r.is("upside down")) v = 1 - v;
  float level = r.u("level");
  if (r.is("level 3.5")) level = 3.5f;
  if (r.is("level 0")) level = 0;
  if (r.is("nearest level")) level = 3;
  const Float3 colour = r.trilinear3("scene", u, v, level);
  out[0] = colour.x;
  out[1] = colour.y;
  out[2] = colour.z;
  if (r.is("decoded again"))
    for (int k = 0; k < 3; ++k) out[k] = power(out[k], 2.2f);
  out[3] = 1;
  return true;
}

inline bool splash_corrected(const Run& r, int x, int y, float* out) {
  const auto q = [&](int dx, int dy) { return r.u("depth_scale") * r.at("depth", x + dx, y + dy) + r.u("depth_bias"); };
  const float here = q(0, 0);
  const int most = static_cast<int>(r.u("reach_max"));
  const float nearest = std::max({here, q(most, 0), q(-most, 0), q(0, most), q(0, -most)});
  const float reach = r.is("reach of this texel alone") ? r.u("reach") * here : r.u("reach") * nearest;
  float held = std::floor(std::min(std::max(reach, r.u("reach_min")), r.u("reach_max")) + 0.5f);
  if (r.is("reach cut")) held = std::floor(std::min(std::max(reach, r.u("reach_min")), r.u("reach_max")));
  const int t = static_cast<int>(held);
  const auto z = [&](int i, int j) { return r.is("inverse distances") ? q(i * t, j * t) : 1 / q(i * t, j * t); };
  const float weight = r.is("Prewitt for Sobel") ? 1.0f : 2.0f;
  float gx = ((z(1, -1) - z(-1, -1)) + weight * (z(1, 0) - z(-1, 0))) + (z(1, 1) - z(-1, 1));
  float gy = ((z(-1, 1) - z(-1, -1)) + weight * (z(0, 1) - z(0, -1))) + (z(1, 1) - z(1, -1));
  if (r.is("y down")) gy = -gy;
  const float g = std::sqrt(gx * gx + gy * gy);
  const float up = q(0, t), down = q(0, -t), left = q(-t, 0), right = q(t, 0);
  const float largest = std::max({here, up, down, left, right});
  const float bend = std::max(std::abs((up + down) - 2 * here), std::abs((left + right) - 2 * here)) / largest;
  float edge = smoothstep(r.u("step_low"), r.u("step_high"), g) * smoothstep(r.u("bend_low"), r.u("bend_high"), bend);
  if (r.is("bend forgotten")) edge = smoothstep(r.u("step_low"), r.u("step_high"), g);
  if (r.is("hard edge")) edge = g >= r.u("step_low") ? smoothstep(r.u("bend_low"), r.u("bend_high"), bend) : 0;
  const float X = (static_cast<float>(x) + 0.5f) * r.u("pixel", 0) - r.u("half_size", 0),
              Y = (static_cast<float>(y) + 0.5f) * r.u("pixel", 1) - r.u("half_size", 1);
  const Float3 camera_up = r.u3("up");
  float ux = camera_up.x - X * camera_up.z, uy = camera_up.y - Y * camera_up.z;
  if (r.is("no perspective")) ux = camera_up.x, uy = camera_up.y;
  const float cosine = ((gx * ux + gy * uy) / std::max(g, r.u("step_low"))) / std::max(std::sqrt(ux * ux + uy * uy), 1e-4f);
  float angle = smoothstep(r.u("cosine_low"), r.u("cosine_high"), cosine);
  if (r.is("edges of the cosine swapped")) angle = smoothstep(r.u("cosine_high"), r.u("cosine_low"), cosine);
  float nu = (static_cast<float>(x) + 0.5f) * r.u("noise_scale", 0) + r.u("noise_offset", 0),
        nv = (static_cast<float>(y) + 0.5f) * r.u("noise_scale", 1) + r.u("noise_offset", 1);
  if (r.is("noise stands still")) nu -= r.u("noise_offset", 0), nv -= r.u("noise_offset", 1);
  const Address clamped = Address::clamp;
  const float noise =
      smoothstep(r.u("noise_low"), r.u("noise_high"), r.linear("noise_map", nu, nv, 0, 0, r.is("noise clamped") ? &clamped : nullptr));
  const float alpha = r.u("drop_color", 3), layer = r.at("layer", x, y);
  float weight_of_drop = ((edge * angle) * noise) * (layer * alpha);
  if (r.is("alpha forgotten")) weight_of_drop = ((edge * angle) * noise) * layer;
  if (r.is("layer forgotten")) weight_of_drop = ((edge * angle) * noise) * alpha;
  if (r.is("angle twice")) weight_of_drop = ((edge * angle) * angle * noise) * (layer * alpha);
  const Float3 scene = r.rgb("scene", x, y), drop = r.u3("drop_color");
  const Float3 colour = r.is("added for mixed") ? scene + weight_of_drop * drop : mix(scene, drop, weight_of_drop);
  out[0] = edge;
  out[1] = angle;
  out[2] = noise;
  out[3] = colour.x;
  out[4] = colour.y;
  out[5] = colour.z;
  out[6] = r.at("scene", x, y, 3);
  if (r.is("masks exchanged")) std::swap(out[0], out[1]);
  return true;
}

inline std::vector<Pass> picture_passes() {
  return {
      {"screen_drops-as-published",
       "background",
       background_published,
       {
           {"pixel corner", {"half a texel of the pixel's centre missing"}},
           {"height for width", {"resolution.y for each component", "resolution.x without the aspect"}},
           {"upside down", {"upside down", "the pixel's y from the other end", "input scene upside down"}},
           {"level 3.5", {"one level above", "level one more", "mip level above", "another value of level"}},
           {"level 0", {"without mip levels", "level is zero", "mip level 0", "=level left out"}},
           {"nearest level", {"rounding for floor: min(max(level", "another value of level", "mix left out: mix(scene"}},
           {"decoded again", {"power of 2.2"}},
       }},
      {"edge_splash-corrected",
       "splash",
       splash_corrected,
       {
           {"reach of this texel alone", {"max left out"}},
           {"reach cut", {"term left out: 0.5"}},
           {"inverse distances", {"quotient upside down: 1 / ((depth", "multiplied for divided: 1 / ((depth"}},
           {"Prewitt for Sobel", {"factor left out: 2", "half as large: 2 *"}},
           {"y down", {"up.y"}},
           {"bend forgotten", {"bend_low, bend_high)"}},
           {"hard edge", {"step_high is step_low"}},
           {"no perspective", {"=up.z left out", "uniform up.z", "term left out: "}},
           {"edges of the cosine swapped", {"smoothstep's edges swapped", "uniforms cosine_low and cosine_high exchanged"}},
           {"noise stands still", {"uniform noise_offset is zero", "noise_offset"}},
           {"noise clamped", {"noise_map clamped beyond its edge", "clamp address mode"}},
           {"alpha forgotten", {"factor left out: drop_color.w", "drop_color.w left out of a product"}},
           {"layer forgotten", {"factor left out: layer"}},
           {"angle twice", {"factor twice: smoothstep"}},
           {"added for mixed", {"added for mixed"}},

           {"masks exchanged", {"edge and angle exchanged"}},
       }},
  };
}

}  // namespace rainref::faults::hand
