// wave_step and display of the puddle, by hand from docs/effects/puddle.md.
#pragma once

#include "faults/hand_made.h"

namespace rainref::faults::hand {

/// Share of the wave that the rim leaves at a texel.
inline float kept_in_rim(const Run& r, int x, int y) {
  const float half = r.is("rim from the texel's corner") ? 0 : 0.5f;
  const float cx = static_cast<float>(x) + half, cy = static_cast<float>(y) + half;
  const float edge = std::min(std::min(cx, r.u("size", 0) - cx), std::min(cy, r.u("size", 1) - cy));
  float depth = std::max(1 - r.u("rim_inverse") * edge, 0.0f);
  if (r.is("depth without its clamp")) depth = 1 - r.u("rim_inverse") * edge;
  return 1 - r.u("rim_damping") * (r.is("depth not squared") ? depth : depth * depth);
}
inline bool wave_step_corrected(const Run& r, int x, int y, float* out) {
  int step = r.is("neighbours two texels away") ? 2 : 1;
  const Address wrap = Address::repeat;
  const Address* const address = r.is("wraps at the edge") ? &wrap : nullptr;
  const auto u = [&](int dx, int dy) { return r.at("wave", x + dx * step, y + dy * step, 0, 0, address); };
  const float here = u(0, 0);
  float p = r.is("previous is newest") ? here : r.at("wave", x, y, 1);
  float sum = (u(-1, 0) + u(1, 0)) + (u(0, -1) + u(0, 1));
  if (r.is("diagonal neighbours")) sum = (u(-1, -1) + u(1, 1)) + (u(1, -1) + u(-1, 1));
  if (r.is("right neighbour forgotten")) sum = u(-1, 0) + (u(0, -1) + u(0, 1));
  if (r.is("left neighbour twice")) sum = (u(-1, 0) + u(-1, 0)) + (u(0, -1) + u(0, 1));
  float laplacian = sum - 4 * here;
  if (r.is("centre weight 3")) laplacian = sum - 3 * here;
  if (r.is("centre forgotten")) laplacian = sum;
  if (r.is("laplacian halved")) laplacian = 0.5f * laplacian;
  if (r.is("laplacian's sign")) laplacian = -laplacian;
  float damping = r.u("damping"), courant = r.u("courant_sq");
  if (r.is("uniforms swapped")) std::swap(damping, courant);
  if (r.is("damping forgotten")) damping = 1;
  if (r.is("damping as 1 - damping")) damping = 1 - damping;
  if (r.is("courant not squared")) courant = std::sqrt(courant);
  const bool has_rim = r.u("rim_damping") > 0 && !r.is("rim forgotten"), has_shore = r.taken().input("shore") != nullptr;
  const float rest = r.u("rest"), kept = has_rim ? kept_in_rim(r, x, y) : 1, shore = has_shore ? r.at("shore", x, y) : 1;
  const float previous = p;
  if (has_rim && !r.is("rim of the new level alone")) p = rest + kept * (p - rest);
  float velocity = here - p;
  if (r.is("velocity the other way")) velocity = p - here;
  float craters = 0;
  for (int d = 0; d < r.count("drops"); ++d) {
    float radius = r.of("drops", d, "radius"), cx = r.of("drops", d, "x"), cy = r.of("drops", d, "y");
    if (r.is("radius is the diameter")) radius = radius / 2;
    if (r.is("drop's x and y swapped")) std::swap(cx, cy);
    const float half = r.is("drop's texel corner") ? 0 : 0.5f, k = 1 / radius;
    const float dx = (static_cast<float>(x) + half - cx) * k, dy = (static_cast<float>(y) + half - cy) * k;
    float s = dx * dx + dy * dy;
    if (r.is("distance for its square")) s = std::sqrt(s);
    float rim = std::max(1 - s, 0.0f);
    if (r.is("crater without its clamp")) rim = 1 - s;
    float crater = rim * rim * (1 - 4 * s);
    if (r.is("rim not squared")) crater = rim * (1 - 4 * s);
    if (r.is("crater 2 s for 4 s")) crater = rim * rim * (1 - 2 * s);
    craters += r.of("drops", d, "amplitude") * crater;
  }
  if (r.is("craters' sign")) craters = -craters;
  if (r.is("laplacian damped")) laplacian = damping * laplacian;
  float next = ((here + damping * velocity) + courant * laplacian) + craters;
  if (r.is("velocity for the laplacian")) next = ((here + damping * velocity) + courant * velocity) + craters;
  if (r.is("damping of all")) next = damping * (here + velocity + courant * laplacian) + craters;
  if (r.is("craters forgotten")) next = next - craters;
  if (has_rim || has_shore) next = rest + (shore * (r.is("rim of the previous level alone") ? 1 : kept)) * (next - rest);
  out[0] = next;
  out[1] = r.is("craters in one level") || r.is("craters forgotten") ? here : here + shore * craters;
  if (r.is("levels swapped")) std::swap(out[0], out[1]);
  if (r.is("previous not shifted")) out[1] = previous + craters;
  return true;
}

inline bool wave_step_published(const Run& r, int x, int y, float* out) {
  const int step = static_cast<int>(r.u("step"));
  const auto s = [&](int dx, int dy) { return r.at("wave", x + dx * step, y + dy * step); };
  float s0 = r.at("wave", x, y, 1);
  if (r.is("s0 from the newest")) s0 = r.at("wave", x, y);
  const float sum = ((s(0, -1) + s(-1, 0)) + s(1, 0)) + s(0, 1);
  float velocity = -2 * (s0 - 0.5f);
  if (r.is("factor 2 forgotten")) velocity = -(s0 - 0.5f);
  if (r.is("centre of s0 forgotten")) velocity = -2 * s0;
  float d = (velocity + (sum - 2)) * r.u("damping");
  if (r.is("damping of the neighbours only")) d = velocity + (sum - 2) * r.u("damping");
  for (int k = 0; k < r.count("drops"); ++k) {
    const float amplitude = r.of("drops", k, "amplitude");
    if (!(amplitude > 0.01f)) continue;
    const float dx = r.of("drops", k, "x") - (static_cast<float>(x) + 0.5f), dy = r.of("drops", k, "y") - (static_cast<float>(y) + 0.5f);
    const float distance = std::sqrt(dx * dx + dy * dy);
    float shape = smoothstep(4, 0.5f, distance);
    if (r.is("edges swapped")) shape = smoothstep(0.5f, 4, distance);
    if (r.is("linear ramp")) shape = saturate((distance - 4) / (0.5f - 4));
    if (r.is("wider drops")) shape = smoothstep(6, 0.5f, distance);
    d += amplitude * shape;
  }
  out[0] = d * 0.5f + 0.5f;
  if (r.is("not packed")) out[0] = d;
  out[1] = s(0, 0);
  return true;
}

inline bool puddle_display(const Run& r, int x, int y, float* out) {
  const bool corrected = r.taken().corrected();
  float width = r.u("width"), height = r.u("height");
  if (r.is("width and height swapped")) std::swap(width, height);
  const float half = r.is("pixel corner") ? 0 : 0.5f;
  float px = (static_cast<float>(x) + half) / width - 0.5f, py = (static_cast<float>(y) + half) / height - 0.5f;
  if (r.is("vignette from the corner")) px += 0.5f, py += 0.5f;
  float distance = std::sqrt(px * px + py * py);
  if (r.is("distance squared")) distance = px * px + py * py;
  float vignette = 1 - r.u("vignette") * distance;
  if (r.is("vignette's sign")) vignette = 1 + r.u("vignette") * distance;
  if (r.is("vignette forgotten")) vignette = 1;
  const Float3 colour = r.rgb("colour", x, y);
  const float* const in = &colour.x;
  for (int k = 0; k < 3; ++k) {
    if (!corrected) {
      float exponent = 0.4545f;
      if (r.is("exponent 2.2")) exponent = 2.2f;
      if (r.is("exponent 1/2.4")) exponent = 1 / 2.4f;
      out[k] = r.is("not encoded") ? vignette * in[k] : power(vignette * in[k], exponent);
      continue;
    }
    float exposure = r.u("exposure");
    if (r.is("exposure squared")) exposure = exposure * exposure;
    const float linear = saturate(std::max(vignette, 0.0f) * exposure * in[k]);
    out[k] = r.is("not encoded")                 ? linear
             : r.is("encoded twice")             ? srgb(srgb(linear))
             : r.is("power 1/2.2 for sRGB")      ? power(linear, 1 / 2.2f)
             : r.is("offset 0.55 for 0.055")     ? (linear <= 0.0031308f ? 12.92f * linear : 1.055f * power(linear, 1 / 2.4f) - 0.0055f)
             : r.is("1.505 for 1.055")           ? (linear <= 0.0031308f ? 12.92f * linear : 1.505f * power(linear, 1 / 2.4f) - 0.055f)
             : r.is("exponent 1/2 in the curve") ? (linear <= 0.0031308f ? 12.92f * linear : 1.055f * power(linear, 0.5f) - 0.055f)
                                                 : srgb(linear);
  }
  if (r.is("result squared"))
    for (int k = 0; k < 3; ++k) out[k] = out[k] * out[k];
  if (r.is("green for all")) out[0] = out[2] = out[1];
  if (r.is("blue first")) std::swap(out[0], out[2]);
  if (r.is("green for blue")) out[2] = out[1];
  out[3] = 1;
  return true;
}

inline std::vector<Pass> puddle_passes() {
  return {
      {"puddle-corrected",
       "wave_step",
       wave_step_corrected,
       {
           {"neighbours two texels away", {"neighbours two texels away"}},
           {"wraps at the edge", {"repeated beyond its edge"}},
           {"diagonal neighbours", {"diagonal neighbours"}},
           {"right neighbour forgotten", {"term left out: wave.x"}},
           {"left neighbour twice", {"neighbour (1, 0) the one opposite"}},
           {"centre weight 3", {"another value of the literal 4", "literal 4 one less"}},
           {"centre forgotten", {"term left out: 4", "literal 4 left out"}},
           {"laplacian halved", {"courant_sq halved", "half as large: courant_sq"}},
           {"laplacian's sign",
            {"courant_sq with the other sign", "uniform courant_sq negated", "sign of a product: courant_sq", "sign of a term: courant_sq",
             "difference the other way: ((wave.x"}},
           {"uniforms swapped", {"uniforms damping and courant_sq exchanged"}},
           {"damping forgotten", {"damping left out of a product", "factor left out: damping"}},
           {"damping as 1 - damping", {"damping taken from 1"}},
           {"courant not squared", {"courant_sq without its square"}},
           {"velocity the other way",
            {"damping with the other sign", "uniform damping negated", "difference the other way: wave.x - wave.y",
             "sign of a term: damping", "sign of a product: damping"}},
           {"previous is newest",
            {"uniform damping is zero", "=damping left out", "wave read in x for y", "input wave with its first channel for both",
             "term left out: damping"}},
           {"radius is the diameter", {"radius of drops halved"}},
           {"drop's x and y swapped", {"x and y of drops exchanged"}},
           {"drop's texel corner", {"half a texel of the pixel's centre missing"}},
           {"distance for its square", {"root for square"}},
           {"crater without its clamp", {"max left out", "lower clamp missing"}},
           {"rim not squared", {"not squared: max"}},
           {"crater 2 s for 4 s", {"half as large: 4 *"}},
           {"craters' sign",
            {"amplitude of drops with the other sign", "sign of a product: amplitude of drops", "sign of a term: amplitude of drops",
             "sign of a product: square(max", "difference the other way: 1 - (4"}},
           {"damping of all", {"a factor of all terms: damping"}},
           {"craters forgotten", {"input drops left out", "=amplitude of drops left out", "term left out: amplitude of drops"}},
           {"craters in one level", {"takes its y from wave.x", "term left out: amplitude of drops"}},
           {"levels swapped", {"wave with its first two channels swapped"}},
           {"previous not shifted", {"wave keeps its y", "wave read in y for x"}},
       }},
      {"puddle-shore",
       "wave_step",
       wave_step_corrected,
       {
           {"rim forgotten", {"rim_damping"}},
           {"rim of the new level alone", {"rim_damping"}},
           {"rim of the previous level alone", {"rim_damping"}},
           {"rim from the texel's corner", {"half a texel"}},
           {"depth not squared", {"not squared"}},
           {"depth without its clamp", {"max left out", "lower clamp missing"}},
       }},
      {"puddle-as-published",
       "wave_step",
       wave_step_published,
       {
           {"s0 from the newest", {"wave read in x for y", "input wave with its first channel for both"}},
           {"factor 2 forgotten", {"factor left out: 2"}},
           {"centre of s0 forgotten", {"term left out: 0.5"}},
           {"damping of the neighbours only", {"a factor of some terms: damping", "factor of one term: damping"}},
           {"edges swapped", {"smoothstep's edges swapped"}},
           {"linear ramp", {"linear for smoothstep"}},
           {"wider drops", {"another value of the literal 4"}},
           {"not packed", {"unpacked as 2 v - 1"}},
       }},
      {"puddle-corrected",
       "display",
       puddle_display,
       {
           {"width and height swapped", {"uniforms width and height exchanged"}},

           {"vignette from the corner", {"term left out: 0.5", "literal 0.5 left out"}},
           {"distance squared", {"root left out", "root missing", "factor twice: sqrt(square"}},
           {"vignette's sign", {"vignette with the other sign", "uniform vignette negated", "sign of a term: vignette"}},
           {"vignette forgotten",
            {"uniform vignette is zero", "factor left out: max(1 - (vignette", "=vignette left out", "term left out: vignette"}},
           {"exposure squared", {"exposure taken twice", "factor twice: exposure"}},
           {"not encoded", {"encoding left out"}},
           {"encoded twice", {"sRGB encoded"}},
           {"power 1/2.2 for sRGB", {"power of 1/2.2 for sRGB"}},
           {"offset 0.55 for 0.055", {"another value of the literal 0.055"}},
           {"exponent 1/2 in the curve", {"another value of the literal 0.41"}},
           {"blue first", {"picture as BGRA"}},
           {"green for blue", {"picture with its y for z"}},
       }},
      {"puddle-as-published",
       "display",
       puddle_display,
       {
           {"exponent 2.2", {"another value of the literal 0.4545", "exponent inverted", "literal 0.4545 inverted"}},
           {"exponent 1/2.4", {"another value of the literal 0.4545"}},
           {"not encoded", {"power left out", "literal 0.4545 left out of a product", "power of 2.2"}},
           {"vignette's sign", {"vignette with the other sign", "uniform vignette negated", "sign of a term: vignette"}},
       }},
  };
}

}  // namespace rainref::faults::hand
