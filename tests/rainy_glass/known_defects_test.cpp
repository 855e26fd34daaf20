// What the article's shader gets wrong, one test each: as-published does it, corrected does not. docs/effects/rainy_glass.md.
#include <algorithm>

#include "rainy_glass/support.h"

namespace rainref::rainy_glass {
namespace {

using test::Double;
using test::Pixel;
using test::settings;

const std::vector<float> flat{0.5f, 0.5f, 0.5f, 0.5f};

TEST(RainyGlassKnownDefects, Defect01_MaskBeforeRemapShiftsTheWholePicture) {
  // Level glass without droplets: nothing should move.
  Pixel published(Variant::as_published, {0.5f, 0.5f, 0, 0}, flat);
  published.set_normal(0, 1, 0);
  EXPECT_NEAR(published.moved()[0], -0.02, 1e-6);
  EXPECT_NEAR(published.moved()[1], -0.02, 1e-6);
  Pixel corrected(Variant::corrected, {0.5f, 0.5f, 0, 0}, flat);
  corrected.set_normal(0, 1, 0);
  EXPECT_EQ(corrected.colour().x.v, -1);  // the scene's own texel
}

TEST(RainyGlassKnownDefects, Defect02_EightBitsHaveNoMiddle) {
  // A flat surface is stored as code 128 = .50196: 2 s - 1 is not 0.
  for (const Variant variant : {Variant::as_published, Variant::corrected}) {
    Settings s = settings(variant, 8, 8);
    s.map_storage = Format::rgba8;
    s.droplet_count = 1;
    s.largest_droplet = s.smallest_droplet = 0.05;
    RainyGlass glass(s, test::surroundings(s), test::executor());
    glass.next_frame();
    const std::vector<float> map = test::texels(glass.raindrops());
    const std::vector<Droplet> droplets = make_droplets(s);
    const Code code = code_of(s, Format::rgba8);
    int flat_texels = 0;
    for (std::size_t i = 0; i < map.size(); i += 4) {
      if (map[i + 3] != 0) continue;
      const float x = map[i], decoded = variant == Variant::corrected
                                            ? (x - static_cast<float>(code.neutral)) * static_cast<float>(1 / code.span)
                                            : 2 * x - 1;
      // The rim's last codes round to height 0, too; away from it the surface is flat.
      const double dx = std::abs((static_cast<double>(i / 4 % 64) + 0.5) / 64 - droplets[0].x),
                   dy = std::abs((static_cast<double>(i / 256) + 0.5) / 64 - droplets[0].y);
      if (std::hypot(std::min(dx, 1 - dx), std::min(dy, 1 - dy)) < 0.08) continue;
      ++flat_texels;
      if (variant == Variant::corrected) {
        ASSERT_EQ(decoded, 0);
      } else {
        ASSERT_NEAR(decoded, 1 / 255.0, 1e-6);
      }
    }
    EXPECT_GT(flat_texels, 1000);
  }
}

TEST(RainyGlassKnownDefects, Defect03_NearestSeedCutsDroplets) {
  // A large droplet beside a small one: the line halfway between their centres cuts the large one.
  const auto droplet = [](float x, float radius, float offset) {
    return Droplet{x, 0.5f, radius, radius / 0.2f, 1 / radius, 0, 1 / radius, offset};
  };
  const Droplet pair[] = {droplet(0.5f, 0.2f, 0.25f), droplet(0.75f, 0.04f, 0.75f)};
  const Settings s = settings(Variant::corrected, 8, 8);
  const BakeRaindropsUniforms u = bake_raindrops_uniforms(s, 2);
  int cut = 0, whole = 0;
  for (int x = 0; x < 64; ++x) {
    const double distance = std::abs((x + 0.5) / 64 - 0.5);
    if (distance >= 0.19) continue;
    cut += scalar::bake_raindrops<Double>(u, false, pair, 2, x, 32).b.v != 0.25;
    whole += scalar::bake_raindrops<Double>(u, true, pair, 2, x, 32).b.v == 0.25;
  }
  EXPECT_GT(cut, 0);
  EXPECT_EQ(whole, 24);
  // And over a whole map of many.
  Settings dense = s;
  dense.map_size = 1024;
  dense.droplet_count = 400;
  dense.smallest_droplet = 0.01;
  for (const bool corrected : {false, true}) {
    const std::vector<Droplet> all = make_droplets(dense);
    const int count = static_cast<int>(all.size());
    int wrong = 0;
    for (int y = 0; y < 64; ++y) {
      for (int x = 0; x < 64; ++x) {
        const auto b = scalar::bake_raindrops<Double>(bake_raindrops_uniforms(s, count), corrected, all.data(), count, x, y);
        if (b.a.v <= 0) continue;
        const auto own = std::find_if(all.begin(), all.end(),
                                      [&](const Droplet& d) { return scalar::bake_raindrops<Double>(u, corrected, &d, 1, x, y).a.v > 0; });
        wrong += own->offset != static_cast<float>(b.b.v);
      }
    }
    if (corrected) {
      EXPECT_EQ(wrong, 0);
    } else {
      EXPECT_GT(wrong, 0);
    }
  }
}

TEST(RainyGlassKnownDefects, Defect04_DropletsAppearAtFullSizeAtOnce) {
  Settings s = settings(Variant::corrected, 8, 8);
  s.fps = 1000;
  s.drop_period = 1;
  const auto shown = [&](int millisecond) {
    return scalar::droplet_shown<Double>(rain_on_glass_uniforms(s, millisecond, {0.5, 0.5}, {0.5, 0.5}), Double(0.3), Double(0.0f),
                                         Double(1.0f))
        .v;
  };
  const auto mask = [](double time) {
    Pixel p(Variant::as_published, {1, 0.5f, 0, 0.3f}, {0, 0, 0, 0}, time);
    p.set_normal(0, 1, 0);
    return p.moved()[0] > 0;
  };
  EXPECT_FALSE(mask(0.999));
  EXPECT_TRUE(mask(0));  // a millisecond later all that is higher than nothing
  EXPECT_EQ(shown(999), 0);
  EXPECT_EQ(shown(0), 0);
  EXPECT_EQ(shown(20), 0);  // the rim comes later than the middle
  EXPECT_EQ(shown(40), 1);
}

TEST(RainyGlassKnownDefects, Defect05_FlowIsUnsignedAndGoesNowhere) {
  // Flow of the whole range moves the lookup to one side only; and on a ramp of the rivulets nothing moves at all (F1).
  EXPECT_EQ(code_of(settings(Variant::as_published, 8, 8), Format::rgba16f).neutral, 0.5);
  std::vector<float> ramp;
  for (int x = 0; x < 64; ++x) ramp.insert(ramp.end(), {static_cast<float>(x) / 64, 0.5f, 0.25f, 0});
  const auto red = [&](Variant variant, double time) {
    Pixel p(variant, {0.5f, 0.5f, 0, 0}, flat, time);
    p.rivulets = TextureData(ramp, 4, 64, 1, Address::repeat, Address::repeat);
    p.at.u = Double(0.04);  // of a tile of 0.2 m: texel 12.8, so that no lookup reaches the edge
    p.uniforms.distortion = 0.02f;
    return p.moved()[0];
  };
  for (const double time : {0.0, 0.2, 0.4, 0.45, 0.7}) EXPECT_NEAR(red(Variant::as_published, time), red(Variant::as_published, 0.1), 1e-5);
  // Corrected: the mean flow is none, and the rivulets scroll down: a ramp along v does move.
  const Settings s = settings(Variant::corrected, 8, 8);
  const BakeRivuletsUniforms u = bake_rivulets_uniforms(s, 0);
  const TextureData lattice(make_lattice(s), Address::repeat, Address::repeat);
  double least = 1, most = -1;
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const double flow = 2 * scalar::bake_rivulets<Double>(u, nullptr, 0, lattice.view(), x, y).b.v - 1;
      least = std::min(least, flow);
      most = std::max(most, flow);
    }
  }
  EXPECT_LT(least, -0.3);
  EXPECT_GT(most, 0.3);
  Settings moving = s;
  moving.fps = 60;
  EXPECT_GT(rain_on_glass_uniforms(moving, 60, {0.5, 0.5}, {0.5, 0.5}).scroll, 0.1f);
}

TEST(RainyGlassKnownDefects, Defect06_OffsetsFollowTheAspect) {
  // One normal, pictures of two shapes: as published a share of each side, so more pixels across than along.
  Pixel p(Variant::as_published, {0.9f, 0.9f, 0, 1}, flat);
  p.set_normal(0, 1, 0);
  const auto moved = p.moved();
  for (const auto& [width, ratio] : {std::pair{100, 1.0}, std::pair{200, 2.0}}) {
    EXPECT_NEAR(moved[0] * width / (moved[1] * 100), ratio, 1e-6);
    Settings s = settings(Variant::corrected, width, 100);
    const RainOnGlassUniforms u = rain_on_glass_uniforms(s, 0, {0.5, 0.5}, {0.5, 0.5});
    const double corrected_across = u.bend / (2 * u.half_width) * width, corrected_along = u.bend / (2 * u.half_height) * 100;
    EXPECT_NEAR(corrected_across / corrected_along, 1, 1e-5);
  }
}

TEST(RainyGlassKnownDefects, Defect07_SlopeMaskIsNotTheSineAndHidesUndersides) {
  // Glass that hangs over, 45 degrees: the published mask takes it for glass that lies, 1 - .7071 both; and droplets land below.
  const auto published = [](double y) {
    Pixel p(Variant::as_published, {0, 0, 0, 0}, {1, 0.5f, 0, 0});
    p.set_normal(0, y, std::sqrt(1 - y * y));
    return (p.moved()[0] / 0.02 + 1) / 2;
  };
  EXPECT_NEAR(published(std::sqrt(0.5)), 1 - std::sqrt(0.5), 1e-6);  // the sine is .7071
  EXPECT_NEAR(published(-std::sqrt(0.5)), 1 - std::sqrt(0.5), 1e-6);
  const auto drop_on = [](Variant variant, double y) {
    Pixel p(variant, {0.9f, 0.5f, 0, 1}, variant == Variant::corrected ? flat : std::vector<float>{0, 0, 0, 0}, 0);
    p.uniforms.drop_phase = 0.1f;
    p.uniforms.rain_amount = 1;
    p.set_normal(0, y, std::sqrt(1 - y * y));
    return variant == Variant::corrected ? p.colour().x.v != -1 : p.moved()[0] > 0;
  };
  EXPECT_TRUE(drop_on(Variant::as_published, -0.95));
  EXPECT_FALSE(drop_on(Variant::corrected, -0.95));  // no rain gets there
  EXPECT_TRUE(drop_on(Variant::corrected, 0.5));
}

TEST(RainyGlassKnownDefects, Defect08_GrabTakesWhatStandsBeforeTheGlass) {
  for (const Variant variant : {Variant::as_published, Variant::corrected}) {
    Settings s = settings(variant, 96, 64);
    Surroundings around = test::surroundings(s);
    for (int y = 0; y < s.height; ++y) {
      for (int x = 0; x < s.width; ++x) {
        const bool near = x > 40 && x < 56;
        around.depth.row<float>(y)[x] = near ? 0.2f : 4.0f;
        around.colour.row<float>(y)[4 * x] = near ? 1000.0f : 0.0f;
      }
    }
    RainyGlass glass(s, around, test::executor());
    glass.next_frame();
    int bled = 0;
    for (int y = 0; y < s.height; ++y) {
      for (int x = 0; x < s.width; ++x) bled += around.depth.row<float>(y)[x] > 1 && to_float(glass.colour().row<Half>(y)[4 * x]) > 0;
    }
    if (variant == Variant::corrected) {
      EXPECT_EQ(bled, 0);
    } else {
      EXPECT_GT(bled, 20);
    }
  }
}

}  // namespace
}  // namespace rainref::rainy_glass
