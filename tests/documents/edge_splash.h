// edge_splash, from docs/effects/edge_splash.md.
#pragma once

#include "documents/written.h"
#include "faults/mistakes_pictures.h"
#include "faults/mistakes_windshield.h"

namespace rainref::documents {

/// The display of every effect but the puddle.
inline bool display_of_document(const Run& r, int x, int y, float* out) {
  const Float3 colour = r.rgb("colour", x, y);
  const float* const in = &colour.x;
  for (int k = 0; k < 3; ++k) {
    const float exposure = r.u("exposure"), before = r.unless("exposure after the curve", exposure, 1.0f);
    const float v = saturate(before * in[k]);
    out[k] = v <= 0.0031308f ? 12.92f * v : constant(r, 1.055f, 1.1f) * power(v, r.unless("exponent 2.4", 1 / 2.4f, 2.4f)) - 0.055f;
    out[k] = r.unless("exposure after the curve", out[k], exposure * out[k]);
  }
  out[3] = 1;
  return true;
}

inline bool splash_published(const Run& r, int x, int y, float* out) {
  const int thickness = r.whole("thickness");
  const float whole_t = static_cast<float>(thickness);
  const float scene[]{r.at("scene", x, y, 0), r.at("scene", x, y, 1), r.at("scene", x, y, 2), r.at("scene", x, y, 3)};
  if (x < thickness || y < thickness || x + thickness >= r.whole("width") || y + thickness >= r.whole("height")) {
    out[0] = out[1] = out[2] = 0;
    for (int k = 0; k < 4; ++k) out[3 + k] = saturate(scene[k]);
    return true;
  }
  const auto cut = [](float v) { return static_cast<int>(v); };
  const auto device = [&](int i, int j) { return r.at("depth", i, j); };
  const float d = device(x, y), s = whole_t * r.unless("the same reach everywhere", d * d, 1.0f), fx = static_cast<float>(x);
  const int row = cut(static_cast<float>(y) - s), left = cut(fx - s), right = cut(fx + s), low = cut(static_cast<float>(row) - s),
            high = cut(static_cast<float>(row) + s);
  const float p6 = device(left, high), p0 = r.unless("the bottom left read", p6, device(left, low)), p1 = device(x, row - thickness),
              p2 = device(right, low), p3 = device(left, row), p5 = device(right, row), p7 = device(x, high), p8 = device(right, high);
  const float gx = -p0 - 2 * p3 - p6 + p2 + 2 * p5 + p8, gy = -p0 - 2 * p1 - p2 + p6 + 2 * p7 + p8;
  const float edge = std::sqrt(gx * gx + gy * gy) >= r.u("edge_threshold") ? 1.0f : 0.0f;
  const float pi = 3.14159265f;
  const float angle = (arc(gy, gx) + r.unless("angle from -pi", pi, 0.0f)) / (2 * pi) <= constant(r, 0.5f, 0.4f) ? 1.0f : 0.0f;
  const auto modulo = [](float a, float w) {
    float rest = a - w * static_cast<float>(static_cast<int>(a / w));
    if (a >= 0 && rest < 0) rest += w;
    if (a >= 0 && rest >= w) rest -= w;
    if (a < 0 && rest > 0) rest -= w;
    if (a < 0 && rest <= -w) rest += w;
    return rest;
  };
  const float moved = r.u("time") * r.u("drop_speed");
  const int nx = cut(modulo(fx + moved, static_cast<float>(r.whole("noise_width")))),
            ny = cut(modulo(static_cast<float>(y) + r.unless("noise scrolls across alone", moved, 0.0f),
                            static_cast<float>(r.whole("noise_height"))));
  const bool is_drop = r.at("noise_map", nx, ny) >= r.u("rain_drop_scale");
  const float noise = is_drop != r.is("noise below its threshold") ? 1.0f : 0.0f;
  out[0] = edge;
  out[1] = angle;
  out[2] = noise;
  const float weight = edge * angle * angle * noise * r.u("drop_color", 3);
  for (int k = 0; k < 4; ++k) out[3 + k] = saturate(mix(scene[k], r.u("drop_color", k), weight));
  return true;
}

inline std::vector<Written> edge_splash_passes() {
  return {
      {{"edge_splash-as-published"}, "splash", "wrong constant", splash_published},
      {{"edge_splash-corrected"}, "splash", "Prewitt for Sobel", splash_corrected},
      {{"edge_splash-as-published", "edge_splash-corrected"}, "display", "wrong constant", display_of_document},
  };
}

}  // namespace rainref::documents
