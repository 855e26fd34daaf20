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
inline const From curve_of_display{
    "docs/effects/puddle.md",
    R"(**display**: srgb(clamp((max(1 − vignette · length(as above), 0) · exposure) · colour, 0, 1)); srgb(x) = 12.92 x for x ≤ .0031308, else 1.055 x^(1/2.4) − .055.)"};

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
  const std::string document = "docs/effects/edge_splash.md";
  return {
      {{"edge_splash-as-published"},
       "splash",
       "wrong constant",
       splash_published,
       nullptr,
       {{document,
         R"(T = thickness, D the device depth (0 outside the picture), d = D at pixel (x, y), whole numbers; s = T (d d); int() cuts toward zero:
x < T, y < T, x + T ≥ width or y + T ≥ height:  masks 0, colour = saturate(scene)
y' = int(y − s);   left = int(x − s), right = int(x + s), low = int(y' − s), high = int(y' + s)
p0 = p6 = D(left, high),  p1 = D(x, y' − T),  p2 = D(right, low),  p3 = D(left, y'),  p5 = D(right, y'),  p7 = D(x, high),  p8 = D(right, high)
gx = −p0 − 2 p3 − p6 + p2 + 2 p5 + p8          gy = −p0 − 2 p1 − p2 + p6 + 2 p7 + p8          from left to right
edge   = √(gx² + gy²) ≥ edge_threshold
angle  = (atan2(gy, gx) + π) / 2π ≤ ½,  π = 3.14159265
noise  = noise_map(int((x + t v) % W), int((y + t v) % H)) ≥ rain_drop_scale        0 outside the map; t v = time · drop_speed
colour = saturate(mix(scene, drop_color, edge · angle · angle · noise · drop_color.a)), alpha too
a % W  = a − W int(a / W), moved by W into the interval that has the sign of a where the quotient was rounded over an integer)"}}},
      {{"edge_splash-corrected"},
       "splash",
       "Prewitt for Sobel",
       splash_corrected,
       nullptr,
       {{document,
         R"(| image plane | X = (i + ½) pixel.x − half_size.x to the right, Y likewise upward, at distance 1 |
q(x, y) = depth_scale · d + depth_bias = 1 / z                     d beyond the edge: the edge's texel
r       = floor(clamp(reach · max(q here, q of the four places reach_max away), reach_min, reach_max) + ½)
g       = Sobel's sums of z = 1/q over taps r apart:  (−1 0 1, −2 0 2, −1 0 1) and its transpose, y up
bend    = max(|(q(up) + q(down)) − 2q|, |(q(left) + q(right)) − 2q|) / max of these five q
edge    = smoothstep(step_low, step_high, |g|) · smoothstep(bend_low, bend_high, bend)
u       = (up.x − X up.z, up.y − Y up.z),   up in camera axes
angle   = smoothstep(cosine_low, cosine_high, ((g · u) / max(|g|, step_low)) / max(|u|, 10⁻⁴))
noise   = smoothstep(noise_low, noise_high, noise_map((x + ½) noise_scale.x + noise_offset.x, (y + ½) noise_scale.y + noise_offset.y))
colour  = mix(scene, drop_color, ((edge · angle) · noise) · (layer · drop_color.a));   the scene's alpha
`noise_map` is bilinear and repeats. The host: reach = band · height / (2 tan(fov / 2)) texels at 1 m, held between `smallest_band` and `largest_band`)"}}},
      {{"edge_splash-as-published", "edge_splash-corrected"},
       "display",
       "wrong constant",
       display_of_document,
       nullptr,
       {curve_of_display,
        {document,
         R"(Each runs once a frame and is judged by `envelope`. `display` is srgb(clamp(exposure · colour, 0, 1)), srgb as in [puddle](puddle.md#corrected).)"}}},
  };
}

}  // namespace rainref::documents
