// The level and the wrap of the published drops' lookups: in closed form, and by differences of neighbouring pixels.
#include "image/flipped.h"
#include "math/half.h"
#include "math/unorm.h"
#include "screen_drops/golden_scenes.h"
#include "screen_drops/support.h"

namespace rainref::screen_drops {
namespace {

using test::Double;
using test::Published;

/// Level k is k everywhere, so that a lookup returns its level.
TextureData levels_of_their_number(int side) {
  TextureData scene(std::vector<float>(static_cast<std::size_t>(4 * side * side)), 4, side, side, Address::clamp, Address::clamp);
  scene.build_mips();
  const Texture& t = scene.view();
  for (int l = 0; l < t.levels; ++l) std::fill_n(scene.texels() + 4 * t.offset[l], 4 * t.width[l] * t.height[l], static_cast<float>(l));
  return scene;
}
/// What a pixel shows of such a scene, or -1 where it is dry.
double level_shown(const Published& p, const TextureData& scene, int x, int y) {
  const Double dry(-1.0f);
  return scalar::drops_as_published<Double>(p.u, scene.view(), p.noise.view(), {dry, dry, dry}, x, y).colour.x.v;
}
/// log2 of the longer way of the lookup in a step of one pixel, by central differences; a sampler's own rule without bias.
double level_by_differences(const Published& p, int x, int y) {
  const auto way = [&](int dx, int dy) {
    const auto a = p.at(x - dx, y - dy), b = p.at(x + dx, y + dy);
    return std::hypot((b.u.v - a.u.v) * double{p.u.resolution[0]}, (b.v.v - a.v.v) * double{p.u.resolution[1]}) / 2;
  };
  return std::max(0.0, std::log2(std::max(way(1, 0), way(0, 1))));
}

TEST(ScreenDropsLod, GradientIsTheDerivativeOfTheLookup) {
  for (const bool printed : {false, true}) {
    for (const float refraction : {0.3f, -0.3f, 0.02f}) {
      for (const float time : {0.0f, 0.9f}) {
        Published p(900, 700, 1.0 / 500, {0.5f, 0.02f, 0.1f});  // noise of one value: the shift is constant
        p.u.gradient_level = 1;
        p.u.printed_normal = printed;
        p.u.refraction = refraction;
        p.u.time = time;
        int drops = 0;
        for (int y = 1; y < 699; y += 7) {
          for (int x = 1; x < 899; x += 7) {
            const double layer = p.at(x, y).layer.v;
            const auto is_same = [&](int dx, int dy) { return p.at(x + dx, y + dy).layer.v == layer; };
            if (layer != 1 || !is_same(1, 0) || !is_same(-1, 0) || !is_same(0, 1) || !is_same(0, -1)) continue;
            ++drops;
            // Third derivatives: a pixel is an angle of .013, of whose square the difference is off by a few times.
            ASSERT_NEAR(p.at(x, y).level.v, level_by_differences(p, x, y), 1e-3) << x << ' ' << y << ' ' << printed << ' ' << refraction;
          }
        }
        EXPECT_GT(drops, 1000);
      }
    }
  }
}

// A drop of twice the size in the same picture spreads it half as densely: one level less. Twice the picture with twice the drop has the
// same level. With so strong a refraction the lookup's own step of one texel does not count.
TEST(ScreenDropsLod, GradientFollowsTheSizeOfADrop) {
  const auto level = [](int side, int cell) {
    Published p(side, side, 1.0 / cell, {0.5f, 0, 0});
    p.u.gradient_level = 1;
    p.u.refraction = 100;
    return p.at(cell / 8, cell / 4).level.v;  // between the middle of a drop and its side
  };
  // Pixels' centres lie half a pixel beside these places: an angle of .008 of the smallest drop.
  EXPECT_NEAR(level(4000, 400) - level(4000, 800), 1, 0.02);
  EXPECT_NEAR(level(4000, 400) - level(8000, 800), 0, 0.02);
}

TEST(ScreenDropsLod, ALookupTakesItsLevel) {
  const TextureData scene = levels_of_their_number(64);  // levels 0 to 6
  Published p(300, 300, 1.0 / 60, {0.5f, 0, 0});
  int drops = 0;
  for (int y = 0; y < 300; y += 3) {
    for (int x = 0; x < 300; x += 3) {
      p.u.gradient_level = 0;
      for (const float level : {0.0f, 1.0f, 2.75f, 6.0f, 16.0f}) {
        p.u.level = level;
        EXPECT_EQ(level_shown(p, scene, x, y), p.wet(x, y) ? std::min(level, 6.0f) : -1) << x << ' ' << y;
      }
      p.u.gradient_level = 1;
      const double expected = p.wet(x, y) ? std::min(p.at(x, y).level.v, 6.0) : -1;
      EXPECT_NEAR(level_shown(p, scene, x, y), expected, 1e-12);
      drops += expected > 0.5 && expected < 6;
    }
  }
  EXPECT_GT(drops, 500);
}

/// The as-published scene of the repository in this size.
Settings origin(Lod lod, int width, int height) {
  Settings s = default_settings(Variant::as_published);
  s.seed = 7;
  s.width = width;
  s.height = height;
  s.lod = lod;
  return s;
}
// What a fragment shader takes from its neighbours has also the noise's gradient in it, and the sides of a quad for its middle. In a
// smaller picture the noise changes faster than the drops do.
TEST(ScreenDropsLod, GradientIsNearThatOfAFragmentShader) {
  const Settings s = origin(Lod::gradient, 1280, 720);
  const PublishedDropsUniforms u = published_drops_uniforms(s, 12);
  const TextureData noise(make_noise(s.seed, s.noise_size), Address::repeat, Address::repeat);
  const auto at = [&](int x, int y) { return scalar::published_drop<Double>(u, noise.view(), x, y); };
  int drops = 0, near = 0;
  double sum = 0;
  for (int y = 0; y < s.height; y += 6) {
    for (int x = 0; x < s.width; x += 6) {
      const auto here = at(x, y), right = at(x + 1, y), above = at(x, y + 1);
      if (here.layer.v == 0 || here.layer.v != right.layer.v || here.layer.v != above.layer.v) continue;
      const auto way = [&](const auto& to) { return std::hypot((to.u.v - here.u.v) * s.width, (to.v.v - here.v.v) * s.height); };
      const double quad = std::max(0.0, std::log2(std::max(way(right), way(above))));
      ++drops;
      near += std::abs(quad - here.level.v) < 0.5;
      sum += here.level.v;
    }
  }
  EXPECT_GT(drops, 100);
  EXPECT_GT(near, 0.9 * drops);
  RecordProperty("mean level", std::to_string(sum / drops));
}
TEST(ScreenDropsLod, DropsAreSofterThanAtTheFinestLevel) {
  std::vector<Image> shown;
  Image water;
  for (const Lod lod : {Lod::finest, Lod::gradient}) {
    const Settings s = origin(lod, 320, 180);
    ScreenDrops window(s, golden_inputs(s, test::executor()), test::executor());
    for (int frame = 0; frame <= 12; ++frame) window.simulate();
    window.render();
    shown.push_back(copy_of(window.colour()));
    water = copy_of(window.water());
  }
  int drops = 0, others = 0, dry = 0;
  for (int y = 0; y < 180; ++y) {
    for (int x = 0; x < 320; ++x) {
      double worst = 0;
      for (int k = 0; k < 3; ++k) {
        const double a = to_float(shown[0].row<Half>(y)[4 * x + k]), b = to_float(shown[1].row<Half>(y)[4 * x + k]);
        worst = std::max(worst, std::abs(a - b) / std::max(std::abs(a), 1e-3));
      }
      const bool is_drop = water.row<Unorm8>(y)[x].code > 0;
      drops += is_drop;
      others += is_drop && worst > 0.01;
      dry += !is_drop && worst > 0;
    }
  }
  EXPECT_EQ(dry, 0);
  EXPECT_GT(drops, 100);
  EXPECT_GT(others, 0.5 * drops) << drops;
}

// A drop before a ramp shows its coordinate by the rule: u held, u - floor u, or the distance from the next even number.
class ScreenDropsWrap : public testing::TestWithParam<Address> {};
INSTANTIATE_TEST_SUITE_P(Rules, ScreenDropsWrap, testing::Values(Address::clamp, Address::repeat, Address::mirror),
                         [](const auto& p) { return std::string(name(p.param)); });
TEST_P(ScreenDropsWrap, MovesTheLookupBackIntoThePicture) {
  Settings s = test::settings(Variant::as_published, 128, 64);
  s.refraction = 0.9;
  s.keep = 0.4;
  s.wrap = GetParam();
  Inputs in;
  in.colour = Image(Format::rgba32f, s.width, s.height);
  for (int y = 0; y < s.height; ++y) {
    for (int x = 0; x < s.width; ++x) {
      in.colour.row<float>(y)[4 * x] = (static_cast<float>(x) + 0.5f) / 128;
      in.colour.row<float>(y)[4 * x + 1] = (static_cast<float>(y) + 0.5f) / 64;
    }
  }
  ScreenDrops window(s, in, test::executor());
  window.next_frame();
  const PublishedDropsUniforms u = published_drops_uniforms(s, 0);
  const TextureData noise(make_noise(s.seed, s.noise_size), Address::repeat, Address::repeat);
  const auto expected = [&](double at) {
    const double whole = std::floor(at), part = at - whole;
    if (GetParam() == Address::clamp) return std::clamp(at, 0.0, 1.0);
    return GetParam() == Address::mirror && std::fmod(std::abs(whole), 2.0) == 1 ? 1 - part : part;
  };
  int beyond = 0;
  for (int y = 0; y < s.height; ++y) {
    for (int x = 0; x < s.width; ++x) {
      const auto drop = scalar::published_drop<test::Single>(u, noise.view(), x, y);
      if (drop.layer.v == 0) continue;
      for (const auto& [at, k, side] : {std::tuple(double{drop.u.v}, 0, 128), {double{drop.v.v}, 1, 64}}) {
        const double where = expected(at), texel = 1.0 / side;
        if (GetParam() == Address::repeat && (where < texel || where > 1 - texel)) continue;  // a ramp has a cliff there
        // At the edge a lookup takes the last texel, half a texel inside; the scene and the colour are halves.
        ASSERT_NEAR(to_float(window.colour().row<Half>(y)[4 * x + k]), where, texel / 2 + 1e-3) << x << ' ' << y << ' ' << at;
        beyond += at < -texel || at > 1 + texel;
      }
    }
  }
  EXPECT_GT(beyond, 100);
}
// Level 2.5 of the background reads beyond the edge by the same rule: a mirrored texel is the edge's own, a repeated one is the other
// edge's.
TEST(ScreenDropsBackground, WrapsAsDropsDo) {
  const auto edge = [](Address wrap) {
    Settings s = test::settings(Variant::as_published, 96, 64);
    s.wrap = wrap;
    Inputs in;
    in.colour = Image(Format::rgba32f, s.width, s.height);
    for (int y = 0; y < s.height; ++y)
      for (int x = 48; x < 96; ++x) in.colour.row<float>(y)[4 * x] = 1;
    ScreenDrops window(s, in, test::executor());
    window.next_frame();
    return to_float(window.background().row<Half>(32)[0]);
  };
  EXPECT_EQ(edge(Address::clamp), 0);
  EXPECT_EQ(edge(Address::mirror), 0);
  // Half of each level's first texel centre off: x = u W - 1/2 with u = 1 / 192, W = 24 and 12.
  const double fine = 1 - (24 / 192.0 + 0.5), coarse = 1 - (12 / 192.0 + 0.5);
  EXPECT_NEAR(edge(Address::repeat), (fine + coarse) / 2, 1e-3);
}

TEST(ScreenDropsLod, RefusedBeyondTheirRange) {
  Settings s = test::settings(Variant::as_published, 16, 16);
  s.wrap = Address::border;
  EXPECT_NE(error_of([&] { ScreenDrops(s, test::inputs(s), test::executor()); }).find("scene.wrap: expected clamp, repeat or mirror"),
            std::string::npos);
  for (const char* key : {"drops.lod = 'coarse'", "drops.level = 17", "scene.wrap = 'border'"})
    EXPECT_NE(error_of([&] { config_of("as-published", key); }).find(std::string(key).substr(0, 9)), std::string::npos) << key;
  for (const char* key : {"drops.lod = 'fixed'", "drops.level = 1", "scene.wrap = 'repeat'"})
    EXPECT_NE(error_of([&] { config_of("corrected", key); }), "") << key;
}
// A background of 2 to 3.5, as the origin's variations have it, is in the range.
TEST(ScreenDropsLod, TheBackgroundTakesEachLevel) {
  for (const char* level : {"2", "2.5", "3.5"})
    EXPECT_EQ(background_uniforms(settings_from(config_of("as-published", std::string("background.level = ") + level))).level,
              std::stof(level));
}

}  // namespace
}  // namespace rainref::screen_drops
