// drops of screen_drops as published and bake_raindrops of rainy_glass, by hand from docs/effects.
#pragma once

#include <limits>

#include "faults/hand_made.h"

namespace rainref::faults::hand {

inline bool screen_drops_published(const Run& r, int x, int y, float* out) {
  const float width = r.u("resolution", 0), height = r.u("resolution", 1);
  const float half = r.is("pixel corner") ? 0 : 0.5f;
  const float u = (static_cast<float>(x) + half) / width, v = (static_cast<float>(y) + half) / height;
  const float scale = r.is("noise ten times finer") ? 1 : 0.1f;
  const auto noise = [&](float a, float b, int k) {
    if (r.whole("noise_nearest") == 0) return r.linear("noise", a, b, k);
    return r.at("noise", static_cast<int>(fract(a) * static_cast<float>(r.width("noise"))),
                static_cast<int>(fract(b) * static_cast<float>(r.height("noise"))), k);
  };
  const float middle = r.u("noise_middle"), per_unit = r.u("displacement");
  float nx = noise(u * scale, v * scale, 0), ny = noise(u * scale, v * scale, 1);
  if (r.is("noise's channels swapped")) std::swap(nx, ny);
  float shift_x = (nx - middle) * per_unit, shift_y = (ny - middle) * per_unit;
  if (r.is("shift not doubled")) shift_x = nx - middle, shift_y = ny - middle;
  if (r.is("shift not centred")) shift_x = nx * per_unit, shift_y = ny * per_unit;
  if (r.u("printed_misprint") != 0) shift_x = shift_y = (1 - middle) * per_unit;
  Float3 colour = r.rgb("background", x, y);
  float water = 0;
  const int layers = r.whole("layers");
  for (int layer = r.is("layers the other way") ? 1 : layers; layer >= 1 && layer <= layers;
       layer += r.is("layers the other way") ? 1 : -1) {
    const float l = static_cast<float>(layer), gx = width * l * r.u("grid"), gy = height * l * r.u("grid");
    const float px = r.u("cell_angle") * u * gx + shift_x, py = r.u("cell_angle") * v * gy + shift_y;
    const float cell_x = std::floor((u * gx - 0.25f) + 0.5f) / gx, cell_y = std::floor((v * gy - 0.25f) + 0.5f) / gy;
    const auto d = [&](int k) { return noise(cell_x, cell_y, k); };
    float age = fract(r.u("time") * (d(2) + 0.1f) + d(1));
    if (r.is("age without its start")) age = fract(r.u("time") * (d(2) + 0.1f));
    float fade = std::max(0.0f, 1 - age * 2);
    if (r.is("drops never fade")) fade = 1;
    float t = (static_cast<float>(std::sin(static_cast<double>(px))) + static_cast<float>(std::sin(static_cast<double>(py)))) * fade;
    if (r.is("cosine for sine"))
      t = (static_cast<float>(std::cos(static_cast<double>(px))) + static_cast<float>(std::sin(static_cast<double>(py)))) * fade;
    const float keep = r.is("as many in each layer") ? r.u("keep") : (r.u("keep_from") - l) * r.u("keep");
    if (!(d(0) < keep && t > (r.is("threshold 0.3") ? 0.3f : r.u("threshold")))) continue;
    const auto sideways = [&](float p) {
      const double angle = r.whole("printed_normal") != 0 ? static_cast<float>(std::sin(static_cast<double>(p))) : p;
      return static_cast<float>(std::cos(angle));
    };
    const Float3 w{sideways(px), sideways(py), mix(0.2f, 2, t - 0.5f)};
    Float3 n = w;
    if (r.is("normal not normalized"))
      n = 1.0f * n;
    else
      n = (1 / length(n)) * n;
    float refraction = r.u("refraction");
    if (r.is("refraction's sign")) refraction = -refraction;
    if (r.is("refraction halved")) refraction = refraction / 2;
    const auto squared_stride = [&](float p, bool is_across) {
      const float sine = static_cast<float>(std::sin(static_cast<double>(p))),
                  cosine = static_cast<float>(std::cos(static_cast<double>(p)));
      const float turn = r.whole("printed_normal") != 0 ? static_cast<float>(std::sin(static_cast<double>(sine))) * cosine : sine;
      const float a = r.u("cell_angle") * (l * r.u("grid")), inverse = 1 / length(w);
      const Float3 way = a * Float3{is_across ? -turn : 0, is_across ? 0 : -turn, 1.8f * fade * cosine}, unit = inverse * w;
      const Float3 turned = inverse * (way - dot(unit, way) * unit);
      const float across = (is_across ? 1.0f : 0.0f) + width * refraction * turned.x,
                  along = (is_across ? 0.0f : 1.0f) + height * refraction * turned.y;
      return across * across + along * along;
    };
    float lod = r.u("level");
    if (r.whole("gradient_level") != 0 || r.is("level of the gradient"))
      lod = std::log(std::max(std::max(squared_stride(px, true), squared_stride(py, false)), 1.0f)) * 0.7213475f;
    if (r.is("finest level")) lod = 0;
    colour = r.trilinear3("scene", u + refraction * n.x, v + refraction * n.y, lod);
    water = r.is("layer not scaled") ? l : l * r.u("water_step");
  }
  out[0] = water;
  out[1] = colour.x;
  out[2] = colour.y;
  out[3] = colour.z;
  out[4] = 1;
  return true;
}

inline bool bake_droplets(const Run& r, int x, int y, float* out) {
  const auto wrap = [&](float d) { return r.is("not wrapped") ? d : d - std::floor(d + 0.5f); };
  const float half = r.is("pixel corner") ? 0 : 0.5f;
  const float px = (static_cast<float>(x) + half) * r.u("inverse_size", 0), py = (static_cast<float>(y) + half) * r.u("inverse_size", 1);
  float best = 0, gx = 0, gy = 0, offset = 0, nearest = 4;
  for (int k = 0; k < r.whole("droplet_count"); ++k) {
    const auto of = [&](const char* member) { return r.of("droplets", k, member); };
    const float dx = wrap(px - of("x")), dy = wrap(py - of("y"));
    float m01 = of("m01");
    if (r.is("ellipses upright")) m01 = 0;
    float m00 = of("m00"), m11 = of("m11");
    if (r.is("axes of the ellipse exchanged")) std::swap(m00, m11);
    const float qx = m00 * dx + m01 * dy, qy = m01 * dx + m11 * dy;
    const float squared = qx * qx + qy * qy;
    float h = of("height") * (1 - squared);
    if (r.is("cones")) h = of("height") * (1 - std::sqrt(squared));
    if (r.is("heights alike")) h = 1 - squared;
    if (h > best) {
      best = h;
      const float factor = r.is("gradient not doubled") ? -of("height") : -2 * of("height");
      gx = factor * (m00 * qx + m01 * qy);
      gy = factor * (m01 * qx + m11 * qy);
      if (r.is("gradient of q")) gx = factor * qx, gy = factor * qy;
    }
    float distance = dx * dx + dy * dy;
    if (r.taken().corrected() && !r.is("cells of the distance alone")) distance = distance - of("radius") * of("radius");
    if (r.is("radius not squared")) distance = dx * dx + dy * dy - of("radius");
    if (distance < nearest) nearest = distance, offset = of("offset");
  }
  float wx = r.u("normal_scale") * gx, wy = r.u("normal_scale") * gy;
  if (r.is("scale forgotten")) wx = gx, wy = gy;
  const float size = r.is("normal not normalized") ? 1 : std::sqrt(1 + wx * wx + wy * wy);
  float sign = -1;
  if (r.is("slope for normal")) sign = 1;
  out[0] = r.u("neutral") + sign * r.u("span") * (wx / size);
  out[1] = r.u("neutral") + sign * r.u("span") * (wy / size);
  if (r.is("green turned")) out[1] = r.u("neutral") - sign * r.u("span") * (wy / size);
  out[2] = offset;
  out[3] = best;
  if (r.is("offset and height exchanged")) std::swap(out[2], out[3]);
  return true;
}

inline std::vector<Pass> drops_and_maps_passes() {
  return {
      {"screen_drops-as-published",
       "drops",
       screen_drops_published,
       {
           {"pixel corner", {"half a texel of the pixel's centre missing"}},
           {"noise ten times finer", {"literal 0.1 left out of a product", "factor left out: 0.1"}},
           {"noise's channels swapped", {"input noise with its first two channels swapped"}},
           {"shift not doubled", {"factor left out: 2", "half as large: "}},
           {"shift not centred", {"term left out: 0.5"}},
           {"layers the other way", {"the layers the other way round"}},
           {"age without its start", {"term left out: noise.y", "input noise without its y"}},
           {"drops never fade", {"factor left out: max(", "term left out: fract("}},
           {"cosine for sine", {"cosine for sine"}},
           {"as many in each layer", {"factor left out: 5 - "}},
           {"threshold 0.3", {"another value of the literal 0.5"}},
           {"normal not normalized", {"normalize missing", "factor left out: 1 / sqrt", "division left out: by sqrt"}},
           {"refraction's sign", {"refraction with the other sign", "uniform refraction negated", "* refraction"}},
           {"refraction halved", {"refraction halved", "* refraction"}},
           {"layer not scaled", {"factor left out: 0.25"}},
           {"level of the gradient", {"uniform gradient_level the other way"}},  // as a fragment shader takes it where none is stated
       }},
      {"rainy_glass-corrected",
       "bake_raindrops",
       bake_droplets,
       {
           {"not wrapped", {"term left out: floor"}},
           {"pixel corner", {"half a texel of the pixel's centre missing"}},
           {"ellipses upright", {"=m01 of droplets left out"}},
           {"axes of the ellipse exchanged", {"m00 and m11 of droplets exchanged"}},
           {"cones", {"root for square"}},
           {"heights alike", {"height of droplets left out of a product", "factor left out: height of droplets"}},
           {"gradient not doubled",
            {"half as large: height of droplets", "factor left out: -2", "factor left out: 2", "literal -2", "literal 2",
             "normal_scale halved"}},
           {"gradient of q", {"the gradient without M"}},
           {"cells of the distance alone",
            {"the as-published formula", "=radius of droplets left out", "term left out: square(radius",
             "term left out: radius of droplets"}},
           {"radius not squared", {"not squared: radius of droplets"}},
           {"scale forgotten", {"normal_scale left out of a product", "factor left out: normal_scale"}},
           {"normal not normalized", {"normalize missing", "factor left out: 1 / sqrt", "division left out: by sqrt"}},
           {"slope for normal",
            {"span with the other sign", "uniform span negated", "sign of a term: span", "sign of a product: span",
             "normal_scale with the other sign", "uniform normal_scale negated"}},
           {"green turned", {"1 - v, y of raindrops alone", "sign of a term: span"}},
           {"offset and height exchanged", {"raindrops with its z and w exchanged"}},
       }},
      {"rainy_glass-as-published",
       "bake_raindrops",
       bake_droplets,
       {
           {"axes of the ellipse exchanged", {"m00 and m11 of droplets exchanged"}},
           {"slope for normal",
            {"span with the other sign", "uniform span negated", "sign of a term: span", "sign of a product: span",
             "normal_scale with the other sign", "uniform normal_scale negated"}},
           {"offset and height exchanged", {"raindrops with its z and w exchanged"}},
       }},
  };
}

}  // namespace rainref::faults::hand
