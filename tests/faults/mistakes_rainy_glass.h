// rain_on_glass as published, by hand from docs/effects/rainy_glass.md. Written last, when the diagnosis knew what it knows: the
// share that is named right here was not worked on.
#pragma once

#include "faults/hand_made.h"

namespace rainref::faults::hand {

inline bool rain_on_glass_published(const Run& r, int x, int y, float* out) {
  const float half = r.is("pixel corner") ? 0 : 0.5f;
  const float sx = (static_cast<float>(x) + half) * r.u("pixel", 0), sy = (static_cast<float>(y) + half) * r.u("pixel", 1);
  out[3] = 1;
  if (!(r.at("orientation", x, y, 3) > 0.5f)) {
    for (int k = 0; k < 3; ++k) out[k] = r.at("scene", x, y, k);
    return true;
  }
  const float u = r.at("surface", x, y, r.is("u and v swapped") ? 1 : 0), v = r.at("surface", x, y, r.is("u and v swapped") ? 0 : 1);
  float du = u * r.u("drop_tiles"), dv = v * r.u("drop_tiles");
  if (r.is("drops in the rivulets' tiles")) du = u * r.u("rivulet_tiles"), dv = v * r.u("rivulet_tiles");
  const auto drops = [&](int k) { return r.linear("raindrops", du, dv, k); };
  float red = drops(0), green = drops(1);
  if (r.is("red and green swapped")) std::swap(red, green);
  float timer = fract(r.u("time") * r.u("drop_rate") + drops(2));
  if (r.is("timer without its offset")) timer = fract(r.u("time") * r.u("drop_rate"));
  if (r.is("timer backwards")) timer = fract(drops(2) - r.u("time") * r.u("drop_rate"));
  float eroded = drops(3) - (1 - r.u("rain_amount")) - timer;
  if (r.is("amount upside down")) eroded = drops(3) - r.u("rain_amount") - timer;
  if (r.is("not eroded by time")) eroded = drops(3) - (1 - r.u("rain_amount"));
  const float mask = eroded > 0 ? 1.0f : 0.0f;
  const float ru = u * r.u("rivulet_tiles"), rv = v * r.u("rivulet_tiles");
  float fx = r.linear("rivulets", ru, rv, 2), fy = r.linear("rivulets", ru, rv, 3);
  if (r.is("flow across for along")) std::swap(fx, fy);
  const float p1 = fract(r.u("time") * r.u("flow_rate")), p2 = fract(r.u("time") * r.u("flow_rate") + (r.is("phases alike") ? 0.0f : 0.5f));
  float w = std::abs(1 - 2 * p1);
  if (r.is("weight of the first for the second")) w = 1 - w;
  const float strength = r.is("flow against") ? -r.u("flow_strength") : r.u("flow_strength");
  const auto rivulet = [&](int k) {
    const float a = r.linear("rivulets", ru + fx * (strength * p1), rv + fy * (strength * p1), k),
                b = r.linear("rivulets", ru + fx * (strength * p2), rv + fy * (strength * p2), k);
    return mix(a, b, w);
  };
  float upright = 1 - std::abs(r.at("orientation", x, y, 1));
  if (r.is("normal's z for its y")) upright = 1 - std::abs(r.at("orientation", x, y, 2));
  const float dx = mask * red + upright * rivulet(0), dy = mask * green + upright * rivulet(1);
  float distortion = r.u("distortion");
  if (r.is("distortion tenfold")) distortion *= 10;
  float ox = distortion * (2 * dx - 1), oy = distortion * (2 * dy - 1);
  if (r.is("not unpacked")) ox = distortion * dx, oy = distortion * dy;
  if (r.is("picture moved the other way")) ox = -ox, oy = -oy;
  if (r.is("green not turned")) oy = -oy;
  const Float3 colour = r.linear3("scene", sx + ox, sy + oy);
  out[0] = colour.x;
  out[1] = colour.y;
  out[2] = colour.z;
  return true;
}

inline std::vector<Pass> rainy_glass_passes() {
  return {
      {"rainy_glass-as-published",
       "rain_on_glass",
       rain_on_glass_published,
       {
           {"pixel corner", {"half a texel of the pixel's centre missing"}},
           {"u and v swapped", {"input surface with its first two channels swapped", "surface with its x and y exchanged"}},
           {"drops in the rivulets' tiles", {"uniform drop_tiles is rivulet_tiles"}},
           {"red and green swapped", {"input raindrops with its first two channels swapped"}},
           {"timer without its offset", {"term left out: raindrops.z", "input raindrops without its z"}},
           {"timer backwards",
            {"drop_rate with the other sign", "uniform drop_rate negated", "time with the other sign", "uniform time negated",
             "sign of a"}},
           {"amount upside down", {"rain_amount taken from 1", "term left out: 1"}},
           {"not eroded by time", {"term left out: fract"}},
           {"flow across for along", {"input rivulets with its z and w exchanged"}},
           {"phases alike", {"term left out: 0.5", "literal 0.5 left out"}},
           {"weight of the first for the second", {"mix ends swapped"}},

           {"flow against",
            {"sign of a term: rivulets.z * (flow_strength", "flow_strength with the other sign", "uniform flow_strength negated",
             "sign of a product: flow_strength"}},

           {"normal's z for its y",
            {"orientation read in z for y", "input orientation with its z for y", "input orientation with its y and z exchanged"}},
           {"distortion tenfold", {"another value of distortion"}},
           {"not unpacked", {"2 *"}},
           {"picture moved the other way",
            {"distortion with the other sign", "uniform distortion negated", "sign of a product: distortion"}},
           {"green not turned", {"sign of a"}},
       }},
  };
}

}  // namespace rainref::faults::hand
