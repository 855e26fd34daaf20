// The effect against theory: alpha erosion, phases of the flow, masks by slope, refraction, tiles without an edge.
#include <algorithm>

#include "image/images.h"
#include "rainy_glass/support.h"

namespace rainref::rainy_glass {
namespace {

using test::Double;
using test::pi;
using test::Pixel;
using test::settings;

/// One round droplet of this radius and height in the middle of a map of 512 texels, floats.
std::vector<float> one_droplet(double radius, double height) {
  BakeRaindropsUniforms u{};
  u.inverse_size[0] = u.inverse_size[1] = 1.0f / 512;
  u.normal_scale = 0.01f;
  u.neutral = u.span = 0.5f;
  const auto inverse = static_cast<float>(1 / radius);
  const Droplet d{0.5f, 0.5f, static_cast<float>(radius), static_cast<float>(height), inverse, 0, inverse, 0};
  std::vector<float> map;
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 512; ++x) {
      const auto b = scalar::bake_raindrops<Double>(u, true, &d, 1, x, y);
      for (const Double v : {b.r, b.g, b.b, b.a}) map.push_back(static_cast<float>(v.v));
    }
  }
  return map;
}

// A1: with alpha a0 (1 - r^2 / R^2) the mask's area is pi R^2 (1 - timer / a0), linear in time, gone at timer = a0. As published
// the timer erodes; the passes' own texts decide each texel. Tolerance 2 / R for the texels that the rim cuts.
TEST(RainyGlassErosion, AreaIsLinearInTime) {
  const double radius = 0.4, peak = 0.8, texels = radius * 512;
  const std::vector<float> map = one_droplet(radius, peak);
  for (const double timer : {0.0, 0.1, 0.25, 0.4, 0.6, 0.79, 0.81}) {
    Pixel p(Variant::as_published, {1, 0.5f, 0, 0}, {0, 0, 0, 0}, timer);
    p.set_normal(0, 1, 0);  // no rivulets
    int covered = 0;
    for (std::size_t i = 0; i < map.size(); i += 4) {
      p.raindrops.texels()[2] = map[i + 2];
      p.raindrops.texels()[3] = map[i + 3];
      const bool is_covered = p.moved()[0] > 0;  // 2 mask 1 - 1
      covered += is_covered;
      if (map[i + 3] == 0) {
        ASSERT_FALSE(is_covered);
      }
    }
    EXPECT_NEAR(covered / (pi * texels * texels), std::max(0.0, 1 - timer / peak), 2 / texels) << timer;
  }
}
// Corrected: the threshold max(1 - t / i, (t - i) / (1 - i)) falls, then rises; the area follows it. rain.rim takes none of it
// at half visibility: h - threshold = rim / 2.
TEST(RainyGlassErosion, CorrectedSpreadsThenDries) {
  Settings s = settings(Variant::corrected, 8, 8);
  s.fps = 1000;
  s.drop_period = 1;
  for (const double t : {0.0, 0.01, 0.03, 0.04, 0.2, 0.5, 0.9}) {
    const RainOnGlassUniforms u = rain_on_glass_uniforms(s, static_cast<int>(std::lround(1000 * t)), {0.5, 0.5}, {0.5, 0.5});
    const double threshold = std::max(1 - t / s.impact, (t - s.impact) / (1 - s.impact));
    for (double h = 0.05; h < 1; h += 0.05) {
      const double shown = scalar::droplet_shown<Double>(u, Double(h), Double(0.0f), Double(1.0f)).v;
      EXPECT_NEAR(shown, std::clamp((h - threshold) / s.rim, 0.0, 1.0), 1e-4) << t << ' ' << h;  // uniforms are floats, over rim
    }
  }
}
// The baked map as a whole: each droplet an ellipse of area pi R^2 / det(R M) and height R / largest, so the share of the tile
// that is above a level is the sum of theirs. Counted on 512 x 512 texels: two thirds of a texel's rim for each.
TEST(RainyGlassErosion, CoverageOfTheBakedMapFollowsItsDroplets) {
  Settings s = settings(Variant::as_published, 8, 8);
  s.map_size = 512;
  s.map_storage = Format::rgba16f;
  s.droplet_count = 100;
  RainyGlass glass(s, test::surroundings(s), test::executor());
  glass.next_frame();
  const std::vector<float> map = test::texels(glass.raindrops());
  const std::vector<Droplet> droplets = make_droplets(s);
  EXPECT_GT(droplets.size(), 40u);
  for (const double level : {0.0, 0.2, 0.5, 0.9}) {
    double area = 0, rim = 0;
    for (const Droplet& d : droplets) {
      if (d.height <= level) continue;
      area += pi / (d.m00 * d.m11 - d.m01 * d.m01) * (1 - level / d.height);
      rim += 2 * pi * d.radius;
    }
    double covered = 0;
    for (std::size_t i = 3; i < map.size(); i += 4) covered += map[i] > level;
    EXPECT_NEAR(covered / (512 * 512), area, 0.1 * rim / 512 + 1e-4) << level;
  }
}

// A2: offsets are uniform. Chi-square of 2000 droplets in 100 classes: 99 degrees of freedom, above 148 once in a thousand.
TEST(RainyGlassErosion, TimeOffsetsAreUniform) {
  Settings s = settings(Variant::corrected, 8, 8);
  s.droplet_count = 2000;
  s.map_size = 2048;  // the gap between droplets is of two texels
  s.largest_droplet = s.smallest_droplet = 0.002;
  const std::vector<Droplet> droplets = make_droplets(s);
  ASSERT_EQ(droplets.size(), 2000u);
  std::array<int, 100> count{};
  for (const Droplet& d : droplets) ++count[static_cast<std::size_t>(d.offset * 100)];
  double chi = 0;
  for (const int c : count) chi += (c - 20.0) * (c - 20.0) / 20;
  EXPECT_LT(chi, 148);
  EXPECT_GT(chi, 60);  // nor evenly spaced
}

// F1: weights sum to 1, each is 0 where its phase resets, and on a ramp the flow stands still: w1 p1 + w2 p2 = 1/2 at all times.
TEST(RainyGlassFlow, PhasesHideTheirResets) {
  for (int k = 0; k < 1000; ++k) {
    const auto f = scalar::flow_phases<Double>(Double(k / 1000.0));
    const double second = f.weight.v, first = 1 - second;
    EXPECT_NEAR(first * f.first.v + second * f.second.v, 0.5, 1e-15);
    if (f.first.v < 0.01) {
      EXPECT_LT(first, 0.0201);
    }
    if (f.second.v < 0.01) {
      EXPECT_LT(second, 0.0201);
    }
  }
  EXPECT_EQ(scalar::flow_phases<Double>(Double(0.0f)).weight.v, 1);
  EXPECT_EQ(scalar::flow_phases<Double>(Double(0.5f)).weight.v, 0);
}
// F2: contrast of two uncorrelated phases sqrt(w^2 + (1 - w)^2): at least .7071, on average (1 + asinh(1) / sqrt 2) / 2.
TEST(RainyGlassFlow, ContrastBeatsTwiceACycle) {
  double sum = 0, least = 2;
  constexpr int n = 100000;
  for (int k = 0; k < n; ++k) {
    const double w = scalar::flow_phases<Double>(Double((k + 0.5) / n)).weight.v, contrast = std::sqrt(w * w + (1 - w) * (1 - w));
    sum += contrast;
    least = std::min(least, contrast);
  }
  EXPECT_NEAR(least, std::sqrt(0.5), 1e-5);
  EXPECT_NEAR(sum / n, (1 + std::asinh(1.0) / std::sqrt(2.0)) / 2, 1e-6);
}
// F3: the masks' means over a sphere are 1/2 and pi / 4; at 27 degrees from level .109 and .454. The weight of a rivulet is read
// off the picture: as published off a flat map, corrected off a tilted one.
double published_weight(double nx, double ny, double nz) {
  Pixel p(Variant::as_published, {0, 0, 0, 0}, {1, 0.5f, 0, 0});
  p.set_normal(nx, ny, nz);
  return (p.moved()[0] / 0.02 + 1) / 2;
}
double corrected_weight(double nx, double ny, double nz) {
  // The slope lies along v here, so that what is seen of it is its weight times its tilt on the screen.
  Pixel p(Variant::corrected, {0.5f, 0.5f, 0, 0}, {0.5f, 0.6f, 0.5f, 0.5f});
  const Pixel upright = p;
  p.set_normal(nx, ny, nz);
  const double level = std::hypot(nx, nz);
  return p.moved()[1] / upright.moved()[1] / level;  // v's share of the screen's up is its level part
}
TEST(RainyGlassFlow, RivuletsKeepToSteepGlass) {
  double published = 0, corrected = 0;
  constexpr int n = 2000;
  for (int k = 0; k < n; ++k) {
    const double y = (k + 0.5) / n * 1.98 - 0.99, level = std::sqrt(1 - y * y);  // bands of equal area; poles have no direction
    published += published_weight(0, y, level) / n;
    corrected += corrected_weight(0, y, level) / n;
  }
  // Of the sphere less its polar caps: mean of 1 - |y| over |y| < .99, of sqrt(1 - y^2) likewise.
  EXPECT_NEAR(published, 1 - 0.99 / 2, 1e-3);
  EXPECT_NEAR(corrected, (std::asin(0.99) + 0.99 * std::sqrt(1 - 0.99 * 0.99)) / (2 * 0.99), 2e-3);
  const double tilt = 27 * pi / 180;
  EXPECT_NEAR(published_weight(0, std::cos(tilt), std::sin(tilt)), 0.109, 5e-4);
  EXPECT_NEAR(corrected_weight(0, std::cos(tilt), std::sin(tilt)), 0.454, 5e-4);
}

// Corrected rivulets move down at the speed asked for: the mean over a cycle at any flow, because the phases are centred.
TEST(RainyGlassFlow, RivuletsRunDownAtTheirSpeed) {
  Settings s = settings(Variant::corrected, 8, 8);
  s.fps = 100;
  const auto at = [&](int frame) { return rain_on_glass_uniforms(s, frame, {0.5, 0.5}, {0.5, 0.5}); };
  EXPECT_NEAR(at(150).scroll, 1.5 * s.rivulet_speed / s.rivulet_tile, 1e-7);
  // After three and a half hours still within a float of the fraction.
  const double tiles = 1e6 / s.fps * s.rivulet_speed / s.rivulet_tile;
  EXPECT_NEAR(at(1000000).scroll, tiles - std::floor(tiles), 1e-6);
  // Held back at most to a stand: speed (1 - run) and (1 + run) at full flow.
  EXPECT_NEAR(at(0).run_strength / s.flow_period * s.rivulet_tile, s.run * s.rivulet_speed, 1e-7);
}

// W15: a thin sheet of slope s bends by (n - 1) s toward the thicker side; at infinity the lookup moves by that on the image
// plane, at the glass not at all, between by 1 - glass / scene.
TEST(RainyGlassRefraction, IsThatOfAThinPrism) {
  const double slope = 0.3, n = 1 / std::sqrt(1 + slope * slope);
  // Water that rises with u: its normal leans to -u.
  const std::vector<float> drop{static_cast<float>(0.5 - 0.5 * slope * n), 0.5f, 0, 1};
  Pixel p(Variant::corrected, drop, {0.5f, 0.5f, 0.5f, 0.5f}, 0.5);
  p.uniforms.impact = 0.25f;
  p.uniforms.drop_phase = 0.25f;  // the whole droplet shows
  p.uniforms.rain_amount = 1;
  const double plane = 0.333 * slope / (2 * p.uniforms.half_width);
  for (const double depth : {1e9, 10.0, 2.0, 1.01}) {
    p.at.own_depth = Double(depth);
    EXPECT_NEAR(p.moved()[0], plane * (1 - 1 / depth), 1e-5) << depth;  // the map's floats, over a slope of .3
    EXPECT_NEAR(p.moved()[1], 0, 1e-6);
  }
}
// How far the prism of small angles is off where angles are not small: the numbers of docs/effects/rainy_glass.md and compositor.md. Light
// through flat glass leaves a sheet of slope tan a at asin(n sin a) - a.
TEST(RainyGlassRefraction, FallsShortOfSnellsLawAsTheDocumentsSay) {
  struct Known {
    double slope, snell, prism, share;  ///< degrees; what the prism is short by
  };
  for (const Known& k : {Known{0.3, 5.82, 5.71, 0.02}, {0.5, 10.03, 9.45, 0.06}, {1, 25.5, 18.4, 0.28}}) {
    const double a = std::atan(k.slope), degree = pi / 180;
    EXPECT_NEAR((std::asin(1.333 * std::sin(a)) - a) / degree, k.snell, 0.05);
    RainOnGlassUniforms u = rain_on_glass_uniforms(settings(Variant::corrected, 8, 8), 0, {0.5, 0.5}, {0.5, 0.5});
    const scalar::Two<Double> moved = scalar::prism(u, scalar::Vec3<Double>(Double(0.0), Double(0.0), Double(1.0)), Double(1.0),
                                                    scalar::Two<Double>(Double(k.slope), Double(0.0)));
    const double bent = std::atan(std::hypot(moved.a.v, moved.b.v)) / degree;
    EXPECT_NEAR(bent, k.prism, 0.05);
    EXPECT_NEAR(1 - bent / k.snell, k.share, 0.006);
  }
}
// The same droplet moves the picture by the same angle in both directions, whatever the aspect.
TEST(RainyGlassRefraction, IsTheSameInBothDirections) {
  for (const int width : {64, 128, 227}) {
    Settings s = settings(Variant::corrected, width, 64);
    const RainOnGlassUniforms u = rain_on_glass_uniforms(s, 0, {0.5, 0.5}, {0.5, 0.5});
    // Pixels for one unit of the image plane.
    EXPECT_NEAR(width / (2 * u.half_width), 64 / (2 * u.half_height), 1e-3);
  }
}

// No texel nearer than the glass is ever looked up: near things are painted in a colour that nothing else has, before a wall
// behind; no pixel of glass that shows the wall has any of it.
TEST(RainyGlassRefraction, NeverReachesBeforeTheGlass) {
  Settings s = settings(Variant::corrected, 96, 64);
  s.contact_angle_deg = 70;
  for (const Shape shape : {Shape::pane, Shape::sphere}) {
    s.shape = shape;
    Surroundings around = test::surroundings(s);
    for (int y = 0; y < s.height; ++y) {
      for (int x = 0; x < s.width; ++x) {
        const bool near = (x / 7 + y / 5) % 4 == 0 || (x * 31 + y * 17) % 41 == 0;
        around.depth.row<float>(y)[x] = near ? 0.2f : 4.0f;
        float* c = around.colour.row<float>(y) + 4 * x;
        c[0] = near ? 1000.0f : 0.0f;
        c[1] = near ? 0.0f : 1.0f;
        c[2] = 0.01f * static_cast<float>(x);
      }
    }
    RainyGlass glass(s, around, test::executor());
    int wet = 0;
    for (int frame = 0; frame < 40; ++frame) {
      glass.next_frame();
      for (int y = 0; y < s.height; ++y) {
        for (int x = 0; x < s.width; ++x) {
          if (around.depth.row<float>(y)[x] < 1) continue;
          const Half* c = glass.colour().row<Half>(y) + 4 * x;
          ASSERT_EQ(to_float(c[0]), 0) << frame << ' ' << x << ' ' << y;
          wet += std::abs(to_float(c[2]) - 0.01f * static_cast<float>(x)) > 0.01f;
        }
      }
    }
    EXPECT_GT(wet, 1000);  // the water does bend
  }
}
// near_depth: a bilinear lookup above z touches no texel of depth z or less. Random depths, random places.
TEST(RainyGlassRefraction, NearDepthIsBelowEveryTexelOfALookup) {
  const Image depth =
      make_image(Format::r32f, 33, 21, [](int x, int y, int) { return 0.1f + static_cast<float>((x * 193 + y * 389) % 97); });
  const TextureData near(near_depth(depth), Address::clamp, Address::clamp);
  for (int k = 0; k < 20000; ++k) {
    const double u = std::fmod(k * 0.61803398875, 1.2) - 0.1, v = std::fmod(k * 0.7548776662, 1.2) - 0.1;
    const float found =
        scalar::sample_bilinear<0, 1>(near.view(), test::Single(static_cast<float>(u)), test::Single(static_cast<float>(v)))[0].v;
    const double x = std::clamp(u * 33 - 0.5, 0.0, 32.0), y = std::clamp(v * 21 - 0.5, 0.0, 20.0);
    for (int j = 0; j < 2; ++j) {
      for (int i = 0; i < 2; ++i) {
        const int column = std::min(static_cast<int>(x) + i, 32), row = std::min(static_cast<int>(y) + j, 20);
        ASSERT_LT(found, depth.row<float>(row)[column]);
      }
    }
  }
}
// Where nothing lies on the glass the picture is the scene, to the bit.
TEST(RainyGlassRefraction, DryGlassIsClear) {
  Settings s = settings(Variant::corrected, 64, 48);
  s.droplet_count = s.trail_count = 0;
  for (const Format storage : {Format::rgba8, Format::rgba16f}) {
    s.map_storage = storage;
    const Surroundings around = test::surroundings(s);
    RainyGlass glass(s, around, test::executor());
    glass.next_frame();
    for (int y = 0; y < s.height; ++y) {
      for (int x = 0; x < s.width; ++x) {
        for (int k = 0; k < 3; ++k)
          ASSERT_EQ(glass.colour().row<Half>(y)[4 * x + k].bits, to_half(around.colour.row<float>(y)[4 * x + k]).bits);
      }
    }
  }
}

// A tile has no edge: moving all records by some texels, round the tile, moves the map by as many, bit for bit. Places are
// multiples of 2^-16 and the map's side is a power of two, so differences are exact.
TEST(RainyGlassTile, HasNoEdge) {
  Settings s = settings(Variant::corrected, 8, 8);
  const int size = s.map_size;
  std::vector<Droplet> droplets = make_droplets(s);
  std::vector<Trail> trails = make_trails(s);
  const int count = static_cast<int>(droplets.size());
  const auto moved = [](float at, int texels, int of) {
    const float to = at + static_cast<float>(texels) / static_cast<float>(of);
    return to - std::floor(to);
  };
  const TextureData lattice(make_lattice(s), Address::repeat, Address::repeat);
  std::vector<Droplet> other = droplets;
  std::vector<Trail> others = trails;
  for (const auto& [dx, dy] : {std::pair{5, 11}, std::pair{40, 63}}) {
    for (std::size_t i = 0; i < droplets.size(); ++i)
      other[i].x = moved(droplets[i].x, dx, size), other[i].y = moved(droplets[i].y, dy, size);
    for (std::size_t i = 0; i < trails.size(); ++i) others[i].x = moved(trails[i].x, dx, size), others[i].y = moved(trails[i].y, dy, size);
    for (const bool corrected : {false, true}) {
      const BakeRaindropsUniforms u = bake_raindrops_uniforms(s, count);
      const BakeRivuletsUniforms r = bake_rivulets_uniforms(s, static_cast<int>(trails.size()));
      for (int y = 0; y < size; ++y) {
        for (int x = 0; x < size; ++x) {
          const auto a = scalar::bake_raindrops<test::Single>(u, corrected, droplets.data(), count, x, y);
          const auto b = scalar::bake_raindrops<test::Single>(u, corrected, other.data(), count, (x + dx) % size, (y + dy) % size);
          ASSERT_EQ(a.r.v, b.r.v) << x << ' ' << y;
          ASSERT_EQ(a.g.v, b.g.v);
          ASSERT_EQ(a.b.v, b.b.v);
          ASSERT_EQ(a.a.v, b.a.v);
          const auto c = scalar::bake_rivulets<test::Single>(r, trails.data(), static_cast<int>(trails.size()), lattice.view(), x, y);
          const auto d = scalar::bake_rivulets<test::Single>(r, others.data(), static_cast<int>(trails.size()), lattice.view(),
                                                             (x + dx) % size, (y + dy) % size);
          ASSERT_EQ(c.r.v, d.r.v) << x << ' ' << y;
          ASSERT_EQ(c.g.v, d.g.v);
        }
      }
    }
  }
}
// The flow's noise likewise, by whole cells of its lattice.
TEST(RainyGlassTile, FlowHasNoEdge) {
  const Settings s = settings(Variant::corrected, 8, 8);
  const Image lattice = make_lattice(s);
  const int side = lattice.width();
  const BakeRivuletsUniforms u = bake_rivulets_uniforms(s, 0);
  const auto noise = [&](const TextureData& t, int cells, int x, int y) {
    return scalar::gradient_noise<0>(t.view(), cells, scalar::texel_centre_x<test::Single>(u.inverse_size, x),
                                     scalar::texel_centre_y<test::Single>(u.inverse_size, y))
        .v;
  };
  const TextureData original(lattice, Address::repeat, Address::repeat);
  Image rolled(Format::rgba32f, side, side);
  for (int y = 0; y < side; ++y) {
    for (int i = 0; i < 4 * side; ++i) rolled.row<float>((y + 1) % side)[(i + 12) % (4 * side)] = lattice.row<float>(y)[i];
  }
  const TextureData other(rolled, Address::repeat, Address::repeat);
  const int cell = s.map_size / side;
  for (int y = 0; y < s.map_size; ++y) {
    for (int x = 0; x < s.map_size; ++x)
      ASSERT_EQ(noise(original, side, x, y), noise(other, side, (x + 3 * cell) % s.map_size, (y + cell) % s.map_size));
  }
}
// Droplets do not overlap, not even round the edges, and all lie within what they claim.
TEST(RainyGlassTile, DropletsKeepApart) {
  const std::vector<Droplet> droplets = make_droplets(settings(Variant::corrected, 8, 8));
  for (std::size_t i = 0; i < droplets.size(); ++i) {
    const Droplet& a = droplets[i];
    const double trace = a.m00 + a.m11, det = a.m00 * a.m11 - a.m01 * a.m01,
                 least = trace / 2 - std::sqrt(std::max(0.0, trace * trace / 4 - det));
    EXPECT_GE(least * a.radius, 1 - 1e-4);  // the longest half axis is the radius
    for (std::size_t j = 0; j < i; ++j) {
      double dx = std::abs(a.x - droplets[j].x), dy = std::abs(a.y - droplets[j].y);
      dx = std::min(dx, 1 - dx), dy = std::min(dy, 1 - dy);
      EXPECT_GT(std::hypot(dx, dy), a.radius + droplets[j].radius);
    }
  }
}
// A pane's u, v and distance are those of the ray's point; a sphere's lie on the sphere.
TEST(RainyGlassSurface, IsWhereTheRayMeetsTheGlass) {
  Settings s = settings(Variant::corrected, 40, 30);
  s.camera_position = {1, 2, 3};
  s.camera_target = {2, 1.7, -4};
  const auto eye = camera(s);
  const auto basis = eye.basis();
  for (const Shape shape : {Shape::pane, Shape::sphere}) {
    s.shape = shape;
    s.yaw_deg = 25;
    Image surface, orientation;
    make_surface(s, {}, surface, orientation);
    int covered = 0;
    for (int y = 0; y < s.height; ++y) {
      for (int x = 0; x < s.width; ++x) {
        const float* p = surface.row<float>(y) + 4 * x;
        const Half* n = orientation.row<Half>(y) + 4 * x;
        if (to_float(n[3]) == 0) continue;
        ++covered;
        const double h = eye.half_height(), w = h * s.width / s.height;
        const scene::Vector3 at = static_cast<double>(p[2]) * (basis.forward + ((2 * x + 1.0) / s.width - 1) * w * basis.right +
                                                               ((2 * y + 1.0) / s.height - 1) * h * basis.up);
        const scene::Vector3 normal(to_float(n[0]), to_float(n[1]), to_float(n[2]));
        EXPECT_NEAR(glm::length(normal), 1, 2e-3);  // halves
        if (shape == Shape::pane) {
          const scene::Vector3 centre = s.distance * level_forward(s);
          EXPECT_NEAR(glm::dot(at - centre, facing(s)), 0, 1e-6);
          EXPECT_NEAR(p[0], glm::dot(at - centre, glm::cross(scene::Vector3(0, 1, 0), facing(s))), 1e-6);
          EXPECT_NEAR(p[1], at.y, 1e-6);
        } else {
          const scene::Vector3 out = at - s.distance * basis.forward;
          EXPECT_NEAR(glm::length(out), s.radius, 1e-6);
          EXPECT_NEAR(std::sin(p[1] / s.radius), out.y / s.radius, 1e-5);
          EXPECT_NEAR(glm::dot(out, normal), s.radius, 1e-3);
        }
      }
    }
    EXPECT_GT(covered, 100);
  }
}

}  // namespace
}  // namespace rainref::rainy_glass
