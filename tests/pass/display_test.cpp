// The display that four effects share: its curve, its lanes, its table, and how it is bound.
#include <gtest/gtest.h>

#include <cmath>

#include "base/error_of.h"
#include "image/images.h"
#include "math/half.h"
#include "math/simd_target.h"
#include "math/unorm.h"
#include "pass/display.h"
#include "pass/display_scalar.h"

namespace rainref::pass {
namespace {

using F = scalar::Scalar<float>;
using D = scalar::Scalar<double>;

/// Every finite half that is not negative, somewhere, and some below 0; of any width.
Image ramp(int width, int height) {
  return make_image(Format::rgba16f, width, height, [i = std::uint32_t{0}](int, int, int) mutable {
    const Half h{static_cast<std::uint16_t>(i * 31 % 0x7c00u | (i % 97 == 0 ? 0x8000u : 0u))};
    ++i;
    return h;
  });
}

// IEC 61966-2-1, 4.2: C = 12.92 c to 0.0031308, 1.055 c^(1/2.4) - 0.055 above; an exposure of 1 EV doubles the radiance.
TEST(Display, IsTheStandardsCurve) {
  for (const double exposure : {-3.0, 0.0, 1.0}) {
    const DisplayUniforms u = display_uniforms(exposure);
    for (const double c : {0.0, 0.001, 0.003, 0.01, 0.18, 0.4, 0.999}) {
      const double shown = std::min(1.0, c * std::exp2(exposure));
      const double code = shown <= 0.0031308 ? 12.92 * shown : 1.055 * std::pow(shown, 1 / 2.4) - 0.055;
      // The constants of the pass are floats: 3e-8 each.
      EXPECT_NEAR(scalar::display(u, scalar::Vec3<D>(D(0.0f), D{c}, D(1.0f))).y.v, code, 2e-7) << c << " at " << exposure;
    }
  }
  const auto beyond = scalar::display(display_uniforms(0), scalar::Vec3<D>(D{-1.0}, D{7.0}, D{65504.0}));
  EXPECT_EQ(beyond.x.v, 0);
  EXPECT_NEAR(beyond.y.v, 1, 2e-7);
  EXPECT_EQ(beyond.y.v, beyond.z.v);
}

TEST(Display, LanesAndTableGiveThePlainCodes) {
  const DisplayUniforms u = display_uniforms(0.7);
  for (const std::string& target : simd_targets()) {
    select_simd_target(target);
    for (const Rounding rounding : {Rounding::rne, Rounding::rtz}) {
      // Widths that leave every remainder of lanes; the last is large enough for a table.
      for (const int width : {1, 2, 3, 7, 16, 33, 256}) {
        const int height = width == 256 ? 100 : 5;
        const Image colour = ramp(width, height);
        Image rows(Format::rgba8, width, height), table(Format::rgba8, width, height);
        display_run(0.7, rounding, colour, rows).tile(parallel::Tile{0, 0, width, height});
        display_table(width, height, 0.7, rounding).rows(colour, table, 0, height);
        for (int y = 0; y < height; ++y) {
          for (int x = 0; x < width; ++x) {
            const Half* in = colour.row<Half>(y) + 4 * x;
            const auto c = scalar::display(u, scalar::Vec3<F>(F::load(in), F::load(in + 1), F::load(in + 2)));
            const int expected[4] = {to_unorm8(c.x.v, rounding).code, to_unorm8(c.y.v, rounding).code, to_unorm8(c.z.v, rounding).code,
                                     255};
            for (int k = 0; k < 4; ++k) {
              ASSERT_EQ(rows.row<Unorm8>(y)[4 * x + k].code, expected[k]) << target << " " << width << ": " << x << "," << y;
              ASSERT_EQ(table.row<Unorm8>(y)[4 * x + k].code, expected[k]) << target << " " << width << ": " << x << "," << y;
            }
          }
        }
      }
    }
  }
  select_simd_target("");
}

TEST(Display, LanesOfCodesGiveThePlainCodes) {
  const DisplayUniforms u = display_uniforms(0.7);
  for (const std::string& target : simd_targets()) {
    select_simd_target(target);
    for (const Rounding rounding : {Rounding::rne, Rounding::rtz}) {
      for (const int width : {1, 2, 3, 7, 16, 33, 256}) {
        const Image colour = make_image(Format::rgba8, width, 3, [](int x, int y, int k) {
          return Unorm8{static_cast<std::uint8_t>(x + 85 * y + 37 * k)};  // every code in each channel of the widest
        });
        Image found(Format::rgba8, width, 3);
        display_run<DisplayOfCodesPass>(0.7, rounding, colour, found).tile(parallel::Tile{0, 0, width, 3});
        for (int y = 0; y < 3; ++y) {
          for (int x = 0; x < width; ++x) {
            const Unorm8* in = colour.row<Unorm8>(y) + 4 * x;
            const auto c = scalar::display(u, scalar::Vec3<F>(F::load(in), F::load(in + 1), F::load(in + 2)));
            const Unorm8 expected[4] = {to_unorm8(c.x.v, rounding), to_unorm8(c.y.v, rounding), to_unorm8(c.z.v, rounding), {255}};
            for (int k = 0; k < 4; ++k)
              ASSERT_EQ(found.row<Unorm8>(y)[4 * x + k].code, expected[k].code) << target << " " << width << ": " << x << "," << y;
          }
        }
      }
    }
  }
  select_simd_target("");
}

TEST(Display, ACaseOfOtherChannelsIsRefused) {
  capture::PassCase c;
  capture::CaseInput colour;
  colour.name = "colour";
  colour.array.format = Format::r16f;
  colour.array.width = colour.array.height = 1;
  colour.array.levels = {std::vector<std::byte>(2)};
  c.inputs.push_back(colour);
  c.outputs.emplace_back().array = colour.array;
  c.uniforms.resize(sizeof(DisplayUniforms));
  const std::string error = error_of([&] { static_cast<void>(bind_display(c)); });
  EXPECT_NE(error.find("in.colour: expected rgba16f 1x1, found r16f 1x1"), std::string::npos) << error;
}

}  // namespace
}  // namespace rainref::pass
