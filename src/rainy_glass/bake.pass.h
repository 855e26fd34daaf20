// Passes bake_raindrops and bake_rivulets: the maps of water on a tile of glass. u and v run from 0 to 1 over the tile and
// join at its edges; v points up the glass.
#ifndef RAINREF_FN
#ifndef RAINREF_RAINY_GLASS_BAKE_PASS_H_
#define RAINREF_RAINY_GLASS_BAKE_PASS_H_
#include <string>

#include <fmt/format.h>

#include "pass/definition.h"
#include "rainref/executor.h"
#include "rainy_glass/host.h"
#include "scene/uniform_block.h"

namespace rainref::rainy_glass {

/// A map: the formats that maps.storage selects from, and the meaning of its channels.
template <class B>
using Map = typename B::template Result<Format::rgba8, Format::rgba16f>;
constexpr pass::Out map_of(std::string_view name, std::string_view channels, std::string_view encoding) {
  return {.name = name, .sentence = channels, .encoding = encoding, .format_key = "maps.storage"};
}

struct BakeRaindropsPass : pass::Takes<BakeRaindropsUniforms> {
  static constexpr pass::About about{"bake_raindrops",
                                     "The raindrop map: normals, time offsets and heights of droplets on a tile. Once, before frame 0.",
                                     {1},
                                     {1},
                                     {"1 + slope squared"}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::inverse_size>("1", scene::share, "1 over the map's columns and rows."),
                  member<&U::droplet_count>("1", {0, 1 << 16}, "Droplets in the list."),
                  member<&U::normal_scale>("1", {0, 10}, "Slope of the water over the gradient of the height."),
                  member<&U::neutral>("1", scene::share, "Stored value of a flat surface's normal."),
                  member<&U::span>("1", scene::share, "Stored value of a unit less neutral.")});
  }
  static std::vector<Droplet> near(const Uniforms&, std::span<const Droplet> all, bool corrected, int columns, const parallel::Tile& t) {
    return droplets_near(all, corrected, columns, t.x0, t.y0, t.x1, t.y1);
  }
  template <class Bound>
  static std::string fault(const Bound& b) {
    return b.width == b.height ? "" : "expected a square output raindrops";
  }
  template <class B>
  struct Io {
    static constexpr std::string_view channels = "Normal x, normal y, time offset, height.";
    typename B::template Records<Droplet> droplets = pass::In{.name = "droplets"};
    Map<B> map = {map_of("raindrops", channels, "normals: n = 2 s - 1"),
                  map_of("raindrops", channels, "normals: n = 2 s - 1; rgba8: (255 s - 128) / 127")};
  };
};

struct BakeRivuletsPass : pass::Takes<BakeRivuletsUniforms> {
  static constexpr pass::About about{
      "bake_rivulets", "The rivulet map: normals of rivulets, and their flow. Once, before frame 0.", {1}, {1}, {"1 + slope squared"}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::inverse_size>("1", scene::share, "1 over the map's columns and rows."),
                  member<&U::trail_count>("1", {0, 1 << 16}, "Rivulets in the list."),
                  member<&U::normal_scale>("1", {0, 1e4}, "Slope of the water over the gradient of the height."),
                  member<&U::neutral>("1", scene::share, "Stored value of 0."),
                  member<&U::span>("1", scene::share, "Stored value of 1 less neutral."),
                  member<&U::flow_cells>("1", {1, 256}, "Cells of the flow's coarser octave along a side."),
                  member<&U::flow_gain>("1", {0, 10}, "Factor of the noise before it is held in [-1, 1].")});
  }
  static std::vector<Trail> near(const Uniforms&, std::span<const Trail> all, bool, int columns, const parallel::Tile& t) {
    return trails_near(all, columns, t.x0, t.y0, t.x1, t.y1);
  }
  template <class Bound>
  static std::string fault(const Bound& b) {
    if (b.width != b.height) return "expected a square output rivulets";
    const Texture& lattice = b.captured.lattice.texture;
    const std::int64_t side = 2 * std::int64_t{b.uniforms.flow_cells};
    if (side < 2) return fmt::format("flow_cells: expected 1 or more, found {}", b.uniforms.flow_cells);
    if (lattice.width[0] >= side && lattice.height[0] >= side) return "";
    return fmt::format("in.lattice: expected {} texels a side, found {}x{}", side, lattice.width[0], lattice.height[0]);
  }
  template <class B>
  struct Io {
    static constexpr std::string_view channels = "Normal x, normal y, flow across, flow along.";
    typename B::template Records<Trail> trails = pass::In{.name = "trails"};
    typename B::Sampled lattice = pass::In{.name = "lattice"};
    Map<B> map = {map_of("rivulets", channels, "normals: n = 2 s - 1; flow unsigned"),
                  map_of("rivulets", channels, "all n = 2 s - 1; rgba8: (255 s - 128) / 127")};
  };
};

}  // namespace rainref::rainy_glass
#endif
#else

/// Four channels of a map as stored values.
template <class N>
struct Baked {
  N r, g, b, a;
};
template <class N, class Result>
RAINREF_FN void give_map(const Baked<N>& b, const Result& map) {
  map(Vec3<N>(b.r, b.g, b.b), b.a);
}

template <class N>
RAINREF_FN N texel_centre_x(const float* inverse_size, int x) {
  return (N::index(x) + N(0.5f)) * N(inverse_size[0]);
}
template <class N>
RAINREF_FN N texel_centre_y(const float* inverse_size, int y) {
  return N(static_cast<float>(y) + 0.5f) * N(inverse_size[1]);
}
/// The difference of two positions, the short way round the tile.
template <class N>
RAINREF_FN N around(N difference) {
  return difference - floor(difference + N(0.5f));
}

/// Stored normal of a surface that rises with (gx, gy).
template <class N>
RAINREF_FN Two<N> stored_normal(N gx, N gy, float scale, float neutral, float span) {
  const N sx = N(scale) * gx, sy = N(scale) * gy;
  const N inverse = N(1.0f) / sqrt(sum_any_order(N(1.0f), square(sx), square(sy)));
  return Two<N>{N(neutral) - N(span) * (sx * inverse), N(neutral) - N(span) * (sy * inverse)};
}

// ---- bake_raindrops ------------------------------------------------------------------------------------------------
// Droplets are distorted paraboloids h = height (1 - |q|^2); the highest one counts. R, G: normal. A: height. B: time offset of the nearest
// droplet. as published nearest is by the distance to the centre, which cuts droplets beside a larger one. corrected it is by distance^2 -
// radius^2: its cells contain their whole droplets, because droplets do not overlap.
template <class N>
RAINREF_FN Baked<N> bake_raindrops(const BakeRaindropsUniforms& u, bool corrected, const Droplet* droplets, int count, int x, int y) {
  const N px = texel_centre_x<N>(u.inverse_size, x), py = texel_centre_y<N>(u.inverse_size, y);
  N height(0.0f), gx(0.0f), gy(0.0f), nearest(4.0f), offset(0.0f);
  for (int k = 0; k < count; ++k) {
    const Droplet& d = droplets[k];
    const N dx = around(px - N(d.x)), dy = around(py - N(d.y));
    const N qx = N(d.m00) * dx + N(d.m01) * dy, qy = N(d.m01) * dx + N(d.m11) * dy;
    const N h = N(d.height) * (N(1.0f) - (square(qx) + square(qy)));
    const auto higher = h > height;
    const N slope(-2.0f * d.height);
    height = select(higher, h, height);
    gx = select(higher, slope * (N(d.m00) * qx + N(d.m01) * qy), gx);
    gy = select(higher, slope * (N(d.m01) * qx + N(d.m11) * qy), gy);
    const N apart = square(dx) + square(dy);
    const N measure = corrected ? apart - N(d.radius * d.radius) : apart;
    const auto nearer = measure < nearest;
    nearest = select(nearer, measure, nearest);
    offset = select(nearer, N(d.offset), offset);
  }
  const Two<N> normal = stored_normal(gx, gy, u.normal_scale, u.neutral, u.span);
  return {normal.a, normal.b, offset, height};
}
struct BakeRaindropsPassText {
  template <class N, bool corrected, class Io>
  static RAINREF_FN void run(const BakeRaindropsUniforms& u, const Io& io, int x, int y) {
    give_map(bake_raindrops<N>(u, corrected, io.droplets.data(), io.droplets.size(), x, y), io.map);
  }
};

// ---- bake_rivulets -------------------------------------------------------------------------------------------------
/// Gradient noise of `cells` cells along a side: gradients of the lattice's channels First and First + 1, Perlin's fade.
template <int First, class N>
RAINREF_FN N gradient_noise(const Texture& lattice, int cells, N u, N v) {
  const N x = u * N(static_cast<float>(cells)), y = v * N(static_cast<float>(cells)), x0 = floor(x), y0 = floor(y), fx = x - x0,
          fy = y - y0;
  // x0 lies in [0, cells); clamped, so that no evaluation of this text leaves the lattice.
  const auto columns = N::uniform_int(cells < lattice.width[0] ? cells : lattice.width[0]),
             rows = N::uniform_int(cells < lattice.height[0] ? cells : lattice.height[0]);
  const auto column = clamp_index(to_int(x0), columns), row = clamp_index(to_int(y0), rows);
  const auto left = column * 4, right = wrap_index(column + 1, columns) * 4;
  const auto low = row * (4 * lattice.width[0]), high = wrap_index(row + 1, rows) * (4 * lattice.width[0]);
  const auto corner = [&](const auto& line, const auto& texel, N dx, N dy) RAINREF_LAMBDA {
    const auto place = line + texel;
    return fetch(lattice.texels + First, place, N()) * dx + fetch(lattice.texels + First + 1, place, N()) * dy;
  };
  const N one(1.0f);
  const N a = corner(low, left, fx, fy), b = corner(low, right, fx - one, fy), c = corner(high, left, fx, fy - one),
          d = corner(high, right, fx - one, fy - one);
  const auto fade = [](N t) RAINREF_LAMBDA { return t * t * t * (t * (t * N(6.0f) - N(15.0f)) + N(10.0f)); };
  return mix(mix(a, b, fade(fx)), mix(c, d, fade(fx)), fade(fy));
}
/// Two octaves, in [-1, 1], stored.
template <int First, class N>
RAINREF_FN N stored_flow(const BakeRivuletsUniforms& u, const Texture& lattice, N px, N py) {
  const N noise = gradient_noise<First>(lattice, u.flow_cells, px, py) + N(0.5f) * gradient_noise<First>(lattice, 2 * u.flow_cells, px, py);
  return N(u.neutral) + N(u.span) * clamp(N(u.flow_gain) * noise, N(-1.0f), N(1.0f));
}
/// R, G: normal of the highest rivulet. B, A: flow across and along the glass. Below the head's centre h = height (1 - (dx^2 +
/// dy^2) / half_width^2), above it height (1 - dy / length - dx^2 / half_width^2): the tail tapers to a point.
template <class N>
RAINREF_FN Baked<N> bake_rivulets(const BakeRivuletsUniforms& u, const Trail* trails, int count, const Texture& lattice, int x, int y) {
  const N px = texel_centre_x<N>(u.inverse_size, x), py = texel_centre_y<N>(u.inverse_size, y);
  N height(0.0f), gx(0.0f), gy(0.0f);
  for (int k = 0; k < count; ++k) {
    const Trail& t = trails[k];
    const N dy = fract(py - N(t.y) + N(0.125f)) - N(0.125f);
    const float two_pi = 0x1.921fb6p+2f;
    // Within half a turn, because some devices guarantee the sine only there.
    const N angle = N(two_pi) * around(N(t.wiggle_rate) * dy + N(t.wiggle_phase));
    const N dx = around(px - N(t.x)) - N(t.wiggle) * sin(angle);
    const N inverse_sq = uniform_quotient(1.0f, t.half_width * t.half_width, N()), steepness = N(-2.0f * t.height) * inverse_sq;
    const auto tail = dy >= N(0.0f);
    const N along = select(tail, dy * N(t.inverse_length), square(dy) * inverse_sq);
    const N h = N(t.height) * (N(1.0f) - along - square(dx) * inverse_sq);
    const auto higher = h > height;
    height = select(higher, h, height);
    const N across = steepness * dx;
    const N lengthwise = select(tail, N(-t.height * t.inverse_length), steepness * dy);
    gx = select(higher, across, gx);
    gy = select(higher, lengthwise - across * (N(two_pi * t.wiggle * t.wiggle_rate) * cos(angle)), gy);
  }
  const Two<N> normal = stored_normal(gx, gy, u.normal_scale, u.neutral, u.span);
  return {normal.a, normal.b, stored_flow<0>(u, lattice, px, py), stored_flow<2>(u, lattice, px, py)};
}
struct BakeRivuletsPassText {
  template <class N, bool, class Io>
  static RAINREF_FN void run(const BakeRivuletsUniforms& u, const Io& io, int x, int y) {
    give_map(bake_rivulets<N>(u, io.trails.data(), io.trails.size(), io.lattice, x, y), io.map);
  }
};
#endif
