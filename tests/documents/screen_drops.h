// screen_drops, from docs/effects/screen_drops.md; its flowing drops are those of drops_on_glass.h.
#pragma once

#include "documents/edge_splash.h"
#include "documents/puddle_corrected.h"
#include "faults/mistakes_drops_and_maps.h"

namespace rainref::documents {

inline bool background_corrected(const Run& r, int x, int y, float* out) {
  const float level = r.is("wrong constant") ? 2 : r.u("level");
  const Float2 at{(static_cast<float>(x) + 0.5f) * r.u("scale", 0) + r.unless("margin forgotten", r.u("offset", 0), 0.0f),
                  (static_cast<float>(y) + 0.5f) * r.u("scale", 1) + r.unless("margin forgotten", r.u("offset", 1), 0.0f)};
  Float3 sum;
  for (int k = 0; k < r.whole("tap_count"); ++k)
    sum = sum + r.trilinear3("scene", at.x + r.of("taps", k, "x"), at.y + r.unless("taps in a row", r.of("taps", k, "y"), 0.0f), level);
  sum = r.unless("taps not averaged", r.u("weight"), 1.0f) * sum;
  return give_opaque(out, sum);
}

inline bool cells(const Run& r, int i, int j, float* out) {
  std::fill(out, out + 4, 0.0f);
  for (int l = 0; l < 4; ++l) {
    const int row = j - r.whole("first_row", l);
    if (row < 0 || row >= r.whole("rows", l) || i >= r.whole("columns", l)) continue;
    const auto layer = static_cast<std::uint32_t>(l), id = static_cast<std::uint32_t>(i) | static_cast<std::uint32_t>(row) << 16;
    const Words own = block(r, 62, id, layer);
    const std::uint32_t length = word(r, "shortest") + ((own[0] >> 16) * word(r, "span") >> 16), start = (own[1] >> 16) * length >> 16;
    const std::uint32_t time = word(r, "tick") + start, cycle = time / length;
    const Words drop = block(r, 63, id, 4 * cycle + layer);
    if (drop[0] >> 16 >= word(r, "keep")) return true;
    const auto share_of = [](std::uint32_t bits) { return static_cast<float>(bits) / 65536; };
    const float size = share_of(drop[1] >> 16), x = share_of(drop[2] >> 16), y = share_of(drop[3] >> 16),
                phase = share_of(((time % length) << 16) / length), impact = r.u("impact");
    const float radius = r.u("largest") / std::sqrt(1 + constant(r, 3, 4) * size);
    const float share = std::min(phase * (1 / impact), (1 - phase) * (1 / (1 - impact)));
    const float inside = r.unless("drops over the cell's side", 1 - 2 * radius, 1.0f);
    out[0] = 0.5f + (x - 0.5f) * inside;
    out[1] = 0.5f + (y - 0.5f) * inside;
    out[2] = radius * r.unless("radius linear in time", std::sqrt(std::max(share, 0.0f)), std::max(share, 0.0f));
    out[3] = phase;
  }
  return true;
}

inline bool drops_corrected(const Run& r, int i, int j, float* out) {
  const Float2 p{static_cast<float>(i) + 0.5f, static_cast<float>(j) + 0.5f};
  Float2 s;
  float cover = 0, level = 0;
  const auto blend = [&](Float2 slope, float at_level, float k) {
    s = mix(s, slope, k);
    cover = mix(cover, 1, k);
    level = mix(level, at_level, k);
  };
  for (int turn = 3; turn >= 0; --turn) {
    const int l = r.unless("small drops over large", turn, 3 - turn);
    const Float2 q = r.u("cells_per_pixel", l) * p + Float2{r.u("offset_x", l), r.u("offset_y", l)};
    const int column = static_cast<int>(std::floor(q.x)), row = static_cast<int>(std::floor(q.y)) + r.whole("first_row", l);
    const Float2 d = Float2{fract(q.x), fract(q.y)} - Float2{r.at("cells", column, row, 0), r.at("cells", column, row, 1)};
    const float radius = r.unless("diameter for radius", 1.0f, 0.5f) * r.at("cells", column, row, 2), pixels = r.u("pixels_per_cell", l);
    const float k = saturate((radius - length(d)) * pixels + 0.5f) * std::min(2 * radius * pixels, 1.0f);
    const float share = r.unless("sine forgotten", r.u("sine"), 1.0f) / std::max(radius, 1e-3f);
    blend(share * d, r.u("level", l), k);
  }
  if (r.whole("has_flow") != 0) {
    const Float2 at{p.x * r.u("flow_pixel", 0), p.y * r.u("flow_pixel", 1)}, texel = u2(r, "flow_texel");
    const float left = r.linear("height", at.x - texel.x, at.y), right = r.linear("height", at.x + texel.x, at.y),
                down = r.linear("height", at.x, at.y - texel.y), up = r.linear("height", at.x, at.y + texel.y);
    const float k = smoothstep(r.u("visible_from"), r.u("visible_to"), 0.25f * (left + right + down + up));
    const Float2 g{(right - left) * r.u("flow_slope", 0), r.unless("flow's y down", up - down, down - up) * r.u("flow_slope", 1)};
    blend((-1 / std::sqrt(1 + g.x * g.x + g.y * g.y)) * g, r.u("flow_level"), k);
  }
  const float ior = constant(r, 1, 1.05f) * r.u("water_ior");
  const Float3 v = normalize({p.x * r.u("pixel", 0) - r.u("half_size", 0), p.y * r.u("pixel", 1) - r.u("half_size", 1), 1});
  const Float3 n = normalize({s.x, s.y, std::sqrt(std::max(1 - s.x * s.x - s.y * s.y, 0.04f))});
  const Float3 b = refract(refract(v, {0, 0, -1}, r.unless("index the other way", 1 / ior, ior)), -1.0f * n, ior);
  const float f = exact_fresnel(saturate(dot(b, n)), ior), ahead = std::max(b.z, 0.05f);
  const float scale_y = r.u("scene_scale", r.unless("scene as wide as high", 1, 0));
  const Float3 seen = r.trilinear3("scene", 0.5f + b.x / ahead * r.u("scene_scale", 0), 0.5f + b.y / ahead * scale_y, level);
  const Float3 background = r.rgb("background", i, j);
  const Float3 colour =
      cover > 0 ? mix(background, mix(seen, r.unless("inner forgotten", r.u("inner"), 1.0f) * background, f), cover) : background;
  out[0] = cover;
  out[1] = colour.x;
  out[2] = colour.y;
  out[3] = colour.z;
  out[4] = 1;
  return true;
}

inline std::vector<Written> screen_drops_passes() {
  return {
      {{"screen_drops-as-published"}, "background", "level 3.5", background_published},
      {{"screen_drops-as-published"}, "drops", "threshold 0.3", screen_drops_published},
      {{"screen_drops-corrected"}, "background", "wrong constant", background_corrected},
      {{"screen_drops-corrected"}, "cells", "wrong constant", cells},
      {{"screen_drops-corrected"}, "drops", "wrong constant", drops_corrected},
      {{"screen_drops-as-published", "screen_drops-corrected"}, "display", "wrong constant", display_of_document},
  };
}

}  // namespace rainref::documents
