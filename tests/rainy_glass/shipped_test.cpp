// The readings of the shader that the article's author ships, one test each, against theory; and the scene that has them all.
#include <fstream>
#include <sstream>

#include <gmock/gmock.h>

#include "rainy_glass/golden_scenes.h"
#include "rainy_glass/support.h"
#include "source_folder.h"

namespace rainref::rainy_glass {
namespace {

using test::Double;
using test::pi;
using test::Pixel;

const std::vector<float> dry_drop{0.5f, 0.5f, 0, 0}, still{0.5f, 0.5f, 0.5f, 0.5f};

/// A pixel as published with other settings.
template <class Change>
Pixel pixel_with(const Change& change, const std::vector<float>& drop, const std::vector<float>& rivulet, double time = 0) {
  Pixel p(Variant::as_published, drop, rivulet, time);
  change(p.settings);
  p.uniforms = rain_on_glass_uniforms(p.settings, static_cast<int>(std::lround(time * p.settings.fps)),
                                      code_of(p.settings, p.settings.map_storage), code_of(p.settings, p.settings.map_storage));
  return p;
}
/// A channel of what is added up, where it is remapped as the article does.
double sum_of(const Pixel& p, std::size_t channel) { return (p.moved()[channel] / p.settings.distortion + 1) / 2; }

/// A map of `columns` x `rows` whose red rises to the right and whose green rises upward, so that both tell the place of a lookup.
TextureData ramp(int columns, int rows, float b, float a) {
  std::vector<float> texels;
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x)
      texels.insert(texels.end(),
                    {static_cast<float>(x) / static_cast<float>(columns), static_cast<float>(y) / static_cast<float>(rows), b, a});
  }
  return {texels, 4, columns, rows, Address::repeat, Address::repeat};
}
/// A map in which no two texels are alike; a is its alpha.
TextureData speckles(float a) {
  std::vector<float> texels;
  for (int k = 0; k < 16 * 16; ++k) {
    const auto share = [&](int step) { return static_cast<float>(k * step % 257) / 257; };
    texels.insert(texels.end(), {share(61), share(101), share(37), a});
  }
  return {texels, 4, 16, 16, Address::repeat, Address::repeat};
}

// Remapped before the mask, what is masked away is 0: dry glass moves nothing, where the article's moves by -distortion. What is not
// masked away counts with its own weight.
TEST(RainyGlassShipped, RemapBeforeTheMaskLeavesDryGlassInPlace) {
  const auto change = [](Settings& s) { s.remap_first = true; };
  EXPECT_NEAR(pixel_with(change, dry_drop, still).moved()[0], 0, 1e-7);
  EXPECT_NEAR(pixel_with([](Settings&) {}, dry_drop, still).moved()[0], 0.02 * (2 * 0.5 - 1), 1e-7);  // upright glass: rivulets of 1/2
  for (const double level : {0.0, 0.25, 1.0}) {
    for (const bool is_wet : {false, true}) {
      Pixel p = pixel_with(change, {0.875f, 0.25f, 0, is_wet ? 1.0f : 0.0f}, {0.75f, 0.625f, 0, 0});
      p.set_normal(0, level, std::sqrt(1 - level * level));
      EXPECT_NEAR(p.moved()[0], 0.02 * (is_wet * 0.75 + (1 - level) * 0.5), 1e-7) << level;
      EXPECT_NEAR(p.moved()[1], 0.02 * (is_wet * -0.5 + (1 - level) * 0.25), 1e-7) << level;
    }
  }
}

// fract(t + 2 B - 1): a droplet with the offset B behaves as one with 2 B, so that B and B + 1/2 appear together.
TEST(RainyGlassShipped, SignedTimeOffsetCountsTwice) {
  const auto shows = [](bool is_signed, double offset, double time) {
    Pixel p = pixel_with([&](Settings& s) { s.signed_offset = is_signed; }, {1, 0.5f, static_cast<float>(offset), 0.5f}, still, time);
    p.set_normal(0, 1, 0);
    return p.moved()[0] > 0;
  };
  int differing = 0;
  for (int k = 0; k < 32; ++k) {
    const double offset = k / 32.0, doubled = std::fmod(2 * offset, 1.0);
    for (int millisecond = 3; millisecond < 1000; millisecond += 41) {
      const double time = millisecond / 1000.0, timer = std::fmod(time + doubled, 1.0);
      EXPECT_EQ(shows(true, offset, time), timer < 0.5) << offset << ' ' << time;  // the height is 1/2
      differing += shows(true, offset, time) != shows(false, offset, time);
    }
  }
  EXPECT_GT(differing, 200);
}

// On a ramp the two phases add up to half the flow at all times (F1), so that a lookup tells the range that B and A stand for.
TEST(RainyGlassShipped, FlowHasARangeOfItsOwnInEachDirection) {
  const auto at = [](float stored, std::size_t channel, double time) {
    Pixel p = pixel_with(
        [](Settings& s) {
          s.flow_across = {-0.1, 0.1};
          s.flow_along = {0, 3};
        },
        dry_drop, still, time);
    p.rivulets = channel == 0 ? ramp(64, 1, stored, 0) : ramp(1, 64, 0.5f, stored);
    p.at.u = p.at.v = Double(0.2 * 0.2);
    return sum_of(p, channel);
  };
  for (const double time : {0.0, 0.2, 0.4, 0.5, 0.8}) {
    for (const float b : {0.0f, 0.25f, 0.5f, 1.0f})
      EXPECT_NEAR(at(b, 0, time) - (0.2 - 0.5 / 64), (-0.1 + 0.2 * b) / 2, 1e-6) << b << ' ' << time;
    for (const float a : {0.0f, 0.125f, 0.25f})  // no phase leaves the ramp
      EXPECT_NEAR(at(a, 1, time) - (0.2 - 0.5 / 64), 3 * a / 2, 1e-6) << a << ' ' << time;
  }
}

// The map moves down as one, its flow with it: where both phases are as at the start, a place shows what lay `speed` t above it.
TEST(RainyGlassShipped, TheRivuletMapScrolls) {
  const auto at = [](double v, double time) {
    Pixel p = pixel_with([](Settings& s) { s.rivulet_speed = 0.07; }, dry_drop, still, time);
    p.rivulets = speckles(0.4f);
    p.at.u = Double(0.031);
    p.at.v = Double(v);
    return p.moved();
  };
  for (const double v : {0.0, 0.013, 0.19}) {
    for (const int cycles : {1, 3, 20}) {
      const auto later = at(v, cycles), above = at(v + 0.07 * cycles, 0);
      for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(later[k], above[k], 1e-6) << v << ' ' << cycles;  // the scroll is a float
    }
    EXPECT_GT(std::abs(at(v, 1)[0] - at(v, 0)[0]), 1e-3) << v;
  }
}

// The square is 1 and 0 where the triangle is, so that both hide the resets; between them the first phase weighs more.
TEST(RainyGlassShipped, SquaredWeightFavoursTheFirstPhase) {
  for (const bool is_squared : {false, true}) {
    for (const double first : {0.0, 0.1, 0.25, 0.4, 0.5, 0.6, 0.9}) {
      Pixel p = pixel_with([&](Settings& s) { s.squared_weight = is_squared; }, dry_drop, still, first);
      p.rivulets = ramp(64, 1, 0.5f, 0);
      p.at.u = Double(0.2 * 0.2);
      const double second = std::fmod(first + 0.5, 1.0), triangle = std::abs(1 - 2 * first),
                   w = is_squared ? triangle * triangle : triangle;
      EXPECT_NEAR(sum_of(p, 0) - (0.2 - 0.5 / 64), 0.5 * ((1 - w) * first + w * second), 1e-6) << first << ' ' << is_squared;
    }
  }
}

// Rivulets are whole up to |n.y| = .85 and fade linearly from there, above and below; over a sphere they are .85 + .15 / 2 on average.
TEST(RainyGlassShipped, RivuletsAreWholeOnTiltedGlass) {
  const auto weight = [](double level, double amount) {
    Pixel p = pixel_with(
        [&](Settings& s) {
          s.fade_from = 0.85;
          s.rivulet_amount = amount;
        },
        {0, 0, 0, 0}, {1, 0.5f, 0, 0});
    p.set_normal(0, level, std::sqrt(1 - level * level));
    return sum_of(p, 0);
  };
  for (const double amount : {0.5, 1.0, 3.0}) {
    for (const double sign : {-1.0, 1.0}) {
      for (const double level : {0.0, 0.5, 0.8499}) EXPECT_NEAR(weight(sign * level, amount), amount, 1e-5) << level;
      for (const double level : {0.86, 0.925, 1.0}) EXPECT_NEAR(weight(sign * level, amount), amount * (1 - level) / 0.15, 1e-5) << level;
    }
  }
  double mean = 0;
  constexpr int n = 1000;
  for (int k = 0; k < n; ++k) mean += weight((2 * k + 1.0) / n - 1, 1) / n;
  EXPECT_NEAR(mean, 0.925, 1e-4);
}

TEST(RainyGlassShipped, TintIsAFactorOfWhatIsSeenThroughTheGlassAlone) {
  const auto tinted = [](Settings& s) { s.tint = {0.88, 0.92, 0.5}; };
  const std::vector<float> drop{0.875f, 0.25f, 0, 1};
  for (const bool is_covered : {true, false}) {
    Pixel with = pixel_with(tinted, drop, still), without = pixel_with([](Settings&) {}, drop, still);
    for (Pixel* p : {&with, &without}) {
      p->at.covered = Double(is_covered ? 1.0 : 0.0);
      p->at.own.z = Double(0.25);
    }
    const auto a = with.colour(), b = without.colour();
    EXPECT_NEAR(a.x.v, (is_covered ? 0.88 : 1) * b.x.v, 1e-7);
    EXPECT_NEAR(a.y.v, (is_covered ? 0.92 : 1) * b.y.v, 1e-7);
    EXPECT_NEAR(a.z.v, (is_covered ? 0.5 : 1) * b.z.v, 1e-7);
  }
}

// A map turned by an angle is looked up where the place is after that turn; the rivulets' own turn is added to that of both maps.
TEST(RainyGlassShipped, MapsTurnOnTheGlass) {
  const double u = 0.053, v = -0.021;
  const auto seen = [](double x, double y, double turn, double own, bool rivulets) {
    Pixel p = pixel_with(
        [&](Settings& s) {
          s.map_turn_deg = turn;
          s.rivulet_turn_deg = own;
        },
        dry_drop, still);
    if (rivulets) {
      p.rivulets = speckles(0.4f);
    } else {
      p.raindrops = speckles(1);
    }
    p.at.u = Double(x);
    p.at.v = Double(y);
    return p.moved();
  };
  for (const bool rivulets : {false, true}) {
    for (const auto& [turn, own] : {std::pair{90.0, 0.0}, {180.0, 0.0}, {20.0, 0.0}, {-130.0, 0.0}, {0.0, 35.0}, {20.0, -55.0}}) {
      const double angle = (turn + (rivulets ? own : 0)) * pi / 180, c = std::cos(angle), s = std::sin(angle);
      const auto found = seen(u, v, turn, own, rivulets), expected = seen(u * c - v * s, u * s + v * c, 0, 0, rivulets);
      for (std::size_t k = 0; k < 2; ++k) EXPECT_NEAR(found[k], expected[k], 1e-6) << turn << ' ' << own;  // cosine and sine are floats
      if (angle != 0) {
        EXPECT_GT(std::abs(found[0] - seen(u, v, 0, 0, rivulets)[0]), 1e-4) << turn << ' ' << own;
      }
    }
  }
}

TEST(RainyGlassShipped, RivuletsFadeSomewhere) {
  Settings s = test::settings(Variant::as_published, 12, 9);
  s.fade_from = 1;
  EXPECT_THAT(error_of([&] { RainyGlass(s, test::surroundings(s), test::executor()); }),
              testing::HasSubstr("rain.fade_from: expected a share below 1, found 1"));
}

// Each is a key of as-published alone; what is of both variants has no other name in either.
TEST(RainyGlassShipped, CorrectedRefusesTheReadings) {
  const auto load = [](const std::string& variant, const std::string& line) { return error_of([&] { config_of(variant, line); }); };
  for (const std::string line :
       {"maps.remap = 'before'", "rain.time_offset = 'signed'", "rain.flow_across = [0, 1]", "rain.flow_along = [0, 1]",
        "rain.flow_weight = 'squared'", "rain.fade_from = 0.5", "glass.tint = [1, 1, 1]", "glass.map_turn = 1", "glass.rivulet_turn = 1"}) {
    EXPECT_EQ(load("as-published", line), "none");
    EXPECT_THAT(load("corrected", line), testing::HasSubstr(line.substr(0, line.find(' '))));
  }
  for (const std::string line : {"rain.rivulet_speed = 0.1", "rain.rivulet_amount = 2"})
    for (const char* variant : {"as-published", "corrected"}) EXPECT_EQ(load(variant, line), "none") << line;
}

// docs/effects/rainy_glass.md has these values in a table.
TEST(RainyGlassShipped, TheSceneHasTheValuesOfTheShader) {
  std::ifstream file(rainref::test::source_folder() + "/scenes/rainy_glass/shipped.toml");
  std::string text, variant;
  for (std::string line; std::getline(file, line);) {
    if (line.starts_with("variant = ")) variant = line;
    if (!line.starts_with("effect = ") && !line.starts_with("variant = ")) text += line + "\n";
  }
  EXPECT_EQ(variant, "variant = \"as-published\"");
  const Settings s = settings_from(config_of("as-published", text));
  const RainOnGlassUniforms u = rain_on_glass_uniforms(s, static_cast<int>(std::lround(s.fps)), {0.5, 0.5}, {0.5, 0.5});  // after a second
  EXPECT_TRUE(u.remap_first == 1 && u.signed_offset == 1 && u.squared_weight == 1);
  EXPECT_FLOAT_EQ(u.drop_rate, 0.3f);
  EXPECT_FLOAT_EQ(u.flow_rate, 0.23f);
  EXPECT_FLOAT_EQ(u.scroll, 0.2f);
  EXPECT_FLOAT_EQ(u.flow_strength * u.flow_from[0], -0.1f);
  EXPECT_FLOAT_EQ(u.flow_strength * (u.flow_from[0] + u.flow_span[0]), 0.1f);
  EXPECT_FLOAT_EQ(u.flow_strength * u.flow_from[1], 0);
  EXPECT_FLOAT_EQ(u.flow_strength * (u.flow_from[1] + u.flow_span[1]), 3);
  EXPECT_NEAR(1 / u.fade_rate, 0.15, 1e-6);
  EXPECT_FLOAT_EQ(u.tint[0], 0.88f);
  EXPECT_FLOAT_EQ(u.tint[1], 0.92f);
  EXPECT_FLOAT_EQ(u.tint[2], 0.92f);
  EXPECT_EQ(u.drop_tiles, u.rivulet_tiles);
  EXPECT_FLOAT_EQ(u.distortion, 0.01f);
}

}  // namespace
}  // namespace rainref::rainy_glass
