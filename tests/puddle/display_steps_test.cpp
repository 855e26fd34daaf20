// display by steps against the pass itself.
#include <bit>
#include <cstdlib>
#include <vector>

#include <gtest/gtest.h>

#include "math/every_target.h"
#include "math/unorm.h"
#include "pass/run.h"
#include "puddle/display.pass.h"
#include "puddle/host.h"
#include "puddle/kernels.h"
#include "puddle/scalar.h"
#include "settings.h"

namespace rainref::puddle {
namespace {

int looked_up(const CodeSteps& steps, std::uint32_t bits) {
  const CodeSteps::Bucket& b = steps.data()[std::max((static_cast<std::int32_t>(bits) >> CodeSteps::shift) - CodeSteps::first, 0)];
  return b.code + (std::bit_cast<float>(bits) >= b.step ? 1 : 0);
}

// The code never falls: so the table, which knows its steps alone, has every code. Tried around each step, and through all floats of [0, 1]
// in strides; RAINREF_STRIDE=1 takes every one of them (half a minute).
TEST(PuddleDisplaySteps, HaveTheCodesOfThePass) {
  const char* wanted = std::getenv("RAINREF_STRIDE");
  const std::uint32_t stride = wanted ? static_cast<std::uint32_t>(std::atoi(wanted)) : 1021, end = std::bit_cast<std::uint32_t>(1.0f) + 1;
  for (const Rounding rounding : {Rounding::rne, Rounding::rtz}) {
    const CodeSteps steps = display_steps(rounding);
    ASSERT_FALSE(steps.empty());
    std::vector<std::uint32_t> bits;
    std::vector<float> x;
    std::vector<std::uint8_t> code;
    const auto compare = [&] {
      x.resize(bits.size());
      code.resize(bits.size());
      for (std::size_t k = 0; k < bits.size(); ++k) x[k] = std::bit_cast<float>(bits[k]);
      display_codes(rounding, x.data(), code.data(), static_cast<int>(x.size()));
      for (std::size_t k = 0; k < bits.size(); ++k) ASSERT_EQ(looked_up(steps, bits[k]), code[k]) << x[k];
      bits.clear();
    };
    for (int k = 0; k < CodeSteps::buckets; ++k) {
      const float step = steps.data()[k].step;
      if (step > 1) continue;
      const std::uint32_t at = std::bit_cast<std::uint32_t>(step);
      for (std::uint32_t i = at - 200; i < at + 200 && i < end; ++i) bits.push_back(i);
    }
    compare();
    for (std::uint64_t i = 0; i < end; i += stride) {
      bits.push_back(static_cast<std::uint32_t>(i));
      if (bits.size() == 1 << 16) compare();
    }
    compare();
  }
}

// What is stored as half may be anything: no number, infinite, negative.
TEST(PuddleDisplaySteps, GiveThePictureOfThePassOnEveryTarget) {
  Settings s = rainref::test::puddle_settings();
  s.variant = Variant::corrected;
  s.vignette = 1.4;
  s.width = 256;
  s.height = 128;
  const DisplayUniforms u = display_uniforms(s);
  Image colour(Format::rgba16f, s.width, s.height), expected(Format::rgba8, s.width, s.height), found(Format::rgba8, s.width, s.height);
  for (int y = 0; y < s.height; ++y)
    for (int x = 0; x < 4 * s.width; ++x)
      colour.row<Half>(y)[x].bits = static_cast<std::uint16_t>((y * 4 * s.width + x) * (x % 4 == 0 ? 1 : 40503));
  const parallel::Tile all{0, 0, s.width, s.height};
  for (const Rounding rounding : {Rounding::rne, Rounding::rtz}) {
    test::for_every_target([&] {
      pass::HostIo<DisplayPass> io;
      io.colour = colour;
      io.picture = expected;
      pass::Run<DisplayPass>(u, true, rounding, io).tile(all);
      display_by_steps(u, display_steps(rounding), colour, found, all);
      for (int y = 0; y < s.height; ++y)
        for (int x = 0; x < 4 * s.width; ++x)
          ASSERT_EQ(found.row<Unorm8>(y)[x].code, expected.row<Unorm8>(y)[x].code) << x << ',' << y << ' ' << colour.row<Half>(y)[x].bits;
    });
  }
}

}  // namespace
}  // namespace rainref::puddle
