// display, fog and the ground: gamma, vignette, Beer's fog, checkerboard, image ground, noise (P11).
#include <map>

#include "image/colour.h"
#include "puddle/scene_support.h"

namespace rainref::puddle::test {
namespace {

// The passes' constants (0.4545, 2.2, the sRGB numbers) are floats: relative 6e-8, times a logarithm of at most 10.
constexpr double constant_error = 1e-6;

DisplayUniforms plain_display(double vignette = 0, int width = 1, int height = 1) {
  Settings s = corrected(width, height);
  s.vignette = vignette;
  return display_uniforms(s);
}
double published_code(double x) {
  static const DisplayUniforms u = plain_display();
  const Double v(x);
  return scalar::display_as_published(u, Vec3<Double>(v, v, v), 0, 0).y.v;
}
double corrected_code(double x) {
  static const DisplayUniforms u = plain_display();
  const Double v(x);
  return scalar::display_corrected(u, Vec3<Double>(v, v, v), 0, 0).y.v;
}

struct Extreme {
  double value = 0, at = 0;
  void take(bool better, double v, double x) {
    if (better) *this = {v, x};
  }
};

TEST(PuddleDisplay, CurvesAreThePowerAndSrgb) {
  for (double x = 0.001; x <= 1; x += 0.001) {
    EXPECT_NEAR(published_code(x), std::pow(x, 0.4545), constant_error) << x;
    EXPECT_NEAR(corrected_code(x), x <= 0.0031308 ? 12.92 * x : 1.055 * std::pow(x, 1 / 2.4) - 0.055, constant_error) << x;
    EXPECT_NEAR(decode_srgb(corrected_code(x)), x, 2 * constant_error) << "the host's decoder is its inverse";
  }
  EXPECT_EQ(published_code(0), 0);
  EXPECT_EQ(corrected_code(0), 0);
  EXPECT_NEAR(corrected_code(1), 1, constant_error);
  EXPECT_EQ(corrected_code(7), corrected_code(1)) << "clamped";
  EXPECT_EQ(corrected_code(-1), 0);
}

TEST(PuddleDisplay, ExtremesOfThePowerAgainstSrgb) {
  Extreme high, low;
  for (double x = 1e-5; x <= 1; x += 2e-5) {
    const double d = published_code(x) - corrected_code(x);
    high.take(d > high.value, d, x);
    low.take(d < low.value, d, x);
  }
  // Half of the last digit of the table.
  EXPECT_NEAR(high.value, .0335, 5e-5);
  EXPECT_NEAR(high.at, .0022, 1e-4);
  EXPECT_NEAR(low.value, -.0058, 5e-5);
  EXPECT_NEAR(low.at, .414, 5e-3);
}

TEST(PuddleDisplay, ExtremesOfDecodingByThePowerAgainstSrgb) {
  double high = 0, low = 0;
  for (double code = 0; code <= 1; code += 1e-4) {
    const double d = scalar::decode_gamma(Vec3<Double>(Double(code), Double(code), Double(code))).x.v - decode_srgb(code);
    high = std::max(high, d);
    low = std::min(low, d);
  }
  EXPECT_NEAR(high, .0085, 5e-5);
  EXPECT_NEAR(low, -.0042, 5e-5);
}

TEST(PuddleDisplay, VignetteFallsLinearlyToTheCorner) {
  constexpr int width = 1000, height = 1000;
  for (const double v : {0.2, 0.4, 1.0, 1.4142135}) {
    const DisplayUniforms u = plain_display(v, width, height);
    const auto at = [&](int x, int y) { return scalar::vignette<Double>(u, x, y).v; };
    // The corner's pixel centre lies half a pixel inside: sqrt(1/2) (1 - 1/1000) from the middle.
    for (const auto& [x, y] : {std::pair{0, 0}, {width - 1, 0}, {0, height - 1}, {width - 1, height - 1}}) {
      EXPECT_NEAR(at(x, y), 1 - v * 0.70710678 * (1 - 1.0 / width), constant_error);
    }
    EXPECT_NEAR(at(500, 500), 1 - v * 0.70710678 / width, constant_error);
    EXPECT_NEAR(at(0, 500), 1 - v * std::hypot(0.5 - 0.5 / width, 0.5 / height), constant_error);
  }
}

TEST(PuddleDisplay, VignetteAndExposureScaleTheRadiance) {
  Settings s = corrected(2, 2);
  s.vignette = 0.4;
  s.exposure = 1;
  const Vec3<Double> grey(Double(0.1), Double(0.1), Double(0.1));
  // Centres of a 2x2 picture lie sqrt(1/8) from the middle.
  const double factor = 1 - 0.4 * std::sqrt(0.125);
  EXPECT_NEAR(scalar::display_corrected(display_uniforms(s), grey, 0, 1).x.v, corrected_code(0.2 * factor), constant_error);
  EXPECT_NEAR(scalar::display_as_published(display_uniforms(s), grey, 0, 1).x.v, published_code(0.1 * factor), constant_error)
      << "exposure is not published";
}

// ---- fog -----------------------------------------------------------------------------------------------------------

double seen_through_fog(Settings s, double density) {
  s = looking_down(s, 20);
  s.fog_depth = density;
  Puddle p(s, uniform_surroundings(1, 0.5f), executor());
  p.render();
  return colour_of(p, 0, 0, 0);
}

TEST(PuddleDisplay, PublishedFogDarkensToSevenTenths) {
  // mix(0.7 c, c, exp(-b d)); d is 15.5, from y = 20 to the water at 4.5. Two half-stored colours.
  const double clear = seen_through_fog(as_published(1, 1), 0);
  EXPECT_NEAR(seen_through_fog(as_published(1, 1), 10) / clear, 0.7, 2 * half_error);
  const double through = std::exp(-0.05 * 15.5);
  EXPECT_NEAR(seen_through_fog(as_published(1, 1), 0.05) / clear, 0.7 + 0.3 * through, 2 * half_error);
}

TEST(PuddleDisplay, CorrectedFogEndsInTheAmbientRadiance) {
  EXPECT_NEAR(seen_through_fog(corrected(1, 1), 10), 1, half_error + 4e-4);
  const double clear = seen_through_fog(corrected(1, 1), 0), through = std::exp(-0.05 * 20);
  EXPECT_NEAR(seen_through_fog(corrected(1, 1), 0.05), through * clear + (1 - through), 2 * half_error + 4e-4);
}

// ---- ground --------------------------------------------------------------------------------------------------------

TEST(PuddleGround, CheckerboardAlternatesOnBothSidesOfZero) {
  const float scale = 0.5f;
  for (int j = -4; j < 4; ++j) {
    for (int i = -4; i < 4; ++i) {
      const auto c = scalar::checkerboard(Double((i + 0.3) / 0.5), Double((j + 0.6) / 0.5), scale);
      const bool light = (i + j) % 2 != 0;  // mod(-1, 2) is 1 in GLSL
      EXPECT_FLOAT_EQ(static_cast<float>(c.x.v), light ? 0.25f : 0.15f) << i << " " << j;
      EXPECT_FLOAT_EQ(static_cast<float>(c.y.v), light ? 0.22f : 0.12f) << i << " " << j;
      EXPECT_FLOAT_EQ(static_cast<float>(c.z.v), light ? 0.20f : 0.10f) << i << " " << j;
    }
  }
}

// As published the ground shows through water by 0.7 (1 - w), w = 0.3 at reflectivity 0, with no sky and no turbidity.
constexpr double ground_weight = 0.7 * 0.7;

TEST(PuddleGround, PublishedImageIsDecodedByThePowerAndDarkened) {
  for (const float code : {0.1f, 0.5f, 1.0f}) {
    Settings s = looking_down(as_published(1, 1), 20);
    s.reflectivity = s.water_turbidity = 0;
    Surroundings around = uniform_surroundings(0, 0);
    around.ground = uniform_image(2, 2, code, code, code);
    around.ground_is_encoded = true;
    Puddle p(s, around, executor());
    p.render();
    const double expected = ground_weight * 0.6 * std::pow(static_cast<double>(code), 2.2);
    EXPECT_NEAR(colour_of(p, 0, 0, 0), expected, expected * half_error + constant_error) << code;
    // A linear picture is encoded first, so that it shows as itself.
    around.ground_is_encoded = false;
    Puddle linear(s, around, executor());
    linear.render();
    EXPECT_NEAR(colour_of(linear, 0, 0, 0), ground_weight * 0.6 * code, code * half_error + constant_error) << code;
  }
}

TEST(PuddleGround, ImageIsATileOfGroundScaleAMetre) {
  // Columns 0 and 1 of the tile are dark and bright; the eye stands over the middle of each of several columns.
  for (int column = -3; column < 4; ++column) {
    Settings s = looking_down(as_published(1, 1), 20);
    s.reflectivity = s.water_turbidity = 0;
    s.ground_scale = 0.25;  // a tile of 4 m, columns of 2 m
    s.camera_position[0] = s.camera_target[0] = (column + 0.5) * 2;
    Surroundings around = uniform_surroundings(0, 0);
    for (int y = 0; y < 2; ++y) {
      for (int k = 0; k < 3; ++k) around.ground.row<float>(y)[4 + k] = 1;
    }
    Puddle p(s, around, executor());
    p.render();
    const bool bright = (column & 1) != 0;
    EXPECT_NEAR(colour_of(p, 0, 0, 0), bright ? ground_weight * 0.6 : 0, half_error) << column;
  }
}

// The last content of each single-image buffer of a render.
class Buffers : public Recorder {
 public:
  void pass(const PassCall& call) override {
    for (const PassOutput& out : call.outputs) {
      if (!std::holds_alternative<BufferView>(out.content)) continue;
      const BufferView& view = std::get<BufferView>(out.content);
      if (view.format != Format::r32f) continue;
      std::vector<float>& floats = r32f[std::string(out.name)];
      for (int y = 0; y < view.height(); ++y) {
        const float* row = view.parts.front()->row<float>(y);
        floats.insert(floats.end(), row, row + view.width());
      }
    }
  }
  std::map<std::string, std::vector<float>> r32f;
};

TEST(PuddleGround, NoiseIsUniformInItsRange) {
  Settings s = as_published(64, 36);
  s.camera_target = {-6, 10, 10};  // the upper part of the picture sees the sky
  Puddle p(s, uniform_surroundings(1, 0.5f), executor());
  p.simulate();
  Buffers buffers;
  p.render(&buffers);
  const std::vector<float>& noise = buffers.r32f.at("noise");
  double sum = 0;
  int on_ground = 0, low = 0;
  for (int y = 0; y < 36; ++y) {
    for (int x = 0; x < 64; ++x) {
      const float n = noise[static_cast<std::size_t>(y) * 64 + x];
      ASSERT_TRUE(0 <= n && n < 1) << n;
      if (hit_of(p, x, y)[7] == 0) continue;  // shade shows the sky there, whatever the noise
      ++on_ground;
      sum += n;
      low += n < 0.25f;
    }
  }
  ASSERT_GT(on_ground, 500);
  ASSERT_LT(on_ground, 64 * 36);
  // Means of `on_ground` uniform numbers: 4 standard deviations.
  EXPECT_NEAR(sum / on_ground, 0.5, 4 * std::sqrt(1.0 / 12 / on_ground));
  EXPECT_NEAR(static_cast<double>(low) / on_ground, 0.25, 4 * std::sqrt(0.25 * 0.75 / on_ground));
}

TEST(PuddleGround, NoiseOfARayThatMeetsNoGroundIsItsMean) {
  const GroundNoiseUniforms u = ground_noise_uniforms(as_published(1, 1));
  const Vec3<Double> under(Double(0.0f), Double(-u.puddle_depth - 1.0), Double(0.0f)), up(Double(0.0f), Double(1.0f), Double(0.0f));
  EXPECT_EQ(scalar::ground_noise_as_published(u, scalar::Surface<Double>{under, up, Double(1.0f)}, 0, 0).v, 0.5);
}

TEST(PuddleGround, NoiseShiftsTheCheckerboardByUpToAFortieth) {
  const ShadeUniforms u = [] {
    Settings s = as_published(1, 1);
    s.use_checkerboard = true;
    s.reflectivity = s.water_turbidity = 0;
    ShadeUniforms v = shade_uniforms(s);
    v.camera = single_ray({1, 10, 1}, {0, -1, 0});
    return v;
  }();
  const Vec3<Double> up(Double(0.0f), Double(1.0f), Double(0.0f));
  const scalar::Surface<Double> surface{Vec3<Double>(Double(1.0), Double(4.5), Double(1.0)), up, Double(1.0f)};
  const TextureData black(std::vector<float>(4, 0.0f), 4, 1, 1, Address::repeat, Address::clamp);
  const auto red = [&](double noise) {
    return scalar::shade_as_published(u, black.view(), black.view(), surface, Double(noise), 0, 0).x.v;
  };
  EXPECT_NEAR(red(0.5), ground_weight * 0.15, constant_error);
  EXPECT_NEAR(red(1.0) - red(0.5), ground_weight * 0.025, constant_error);
  EXPECT_NEAR(red(0.5) - red(0.0), ground_weight * 0.025, constant_error);
}

}  // namespace
}  // namespace rainref::puddle::test
