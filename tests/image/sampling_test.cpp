// Lookups by the scalar evaluation against a straightforward implementation in double.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>

#include "image/sampling_kernels.h"
#include "image/straightforward.h"

namespace rainref::test {
namespace {

constexpr Address addresses[] = {Address::clamp, Address::repeat, Address::mirror, Address::border};
const char* text(Address a) { return std::array{"clamp", "repeat", "mirror", "border"}[static_cast<std::size_t>(a)]; }

std::vector<Place> places(float reach, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto next = [&] { return (static_cast<float>(random() >> 8) * 0x1p-23f - 1.0f) * reach + 0.5f; };
  std::vector<Place> out;
  for (int i = 0; i < 400; ++i) {
    const float u = next(), v = next();
    out.push_back({u, v, 0, next() * 2});
  }
  return out;
}
/// The rounding of u * size, twice, times the largest slope: neighbouring texels differ by 8 at most, at the border.
double tolerance(const Texture& t, const Place& p) {
  return 8 * 0x1p-23 * ((1 + std::fabs(p.u)) * t.width[0] + (1 + std::fabs(p.v)) * t.height[0]);
}

template <class F>
void for_each_address(F f) {
  for (const Address u : addresses) {
    for (const Address v : addresses) {
      SCOPED_TRACE(std::string(text(u)) + " x " + text(v));
      for (const auto& [w, h] : {std::pair{7, 5}, {8, 4}, {1, 3}, {1, 1}, {33, 2}}) f(noise_texture(w, h, 4, u, v));
    }
  }
}

TEST(Sampling, Bilinear) {
  for_each_address([](const TextureData& data) {
    const Texture& t = data.view();
    for (const float reach : {0.5f, 3.0f, 40.0f}) {
      for (const Place& p : places(reach, 5)) {
        const Texel got = look_up_by_plain(Lookup::bilinear, t, p);
        for (int c = 0; c < 4; ++c) ASSERT_NEAR(got.c[c], bilinear_at(t, 0, p.u, p.v, c), tolerance(t, p)) << p.u << ' ' << p.v;
      }
    }
  });
}

TEST(Sampling, Nearest) {
  for_each_address([](const TextureData& data) {
    const Texture& t = data.view();
    const auto near_edge = [](double x) { return std::fabs(x - std::nearbyint(x)) < 1e-4; };
    for (const Place& p : places(3.0f, 6)) {
      if (near_edge(double{p.u} * t.width[0]) || near_edge(double{p.v} * t.height[0])) continue;
      const Texel got = look_up_by_plain(Lookup::nearest, t, p);
      for (int c = 0; c < 4; ++c) ASSERT_EQ(got.c[c], nearest_at(t, p.u, p.v, c)) << p.u << ' ' << p.v;
    }
  });
}

TEST(Sampling, Trilinear) {
  for_each_address([](const TextureData& data) {
    const Texture& t = data.view();
    for (Place p : places(2.0f, 7)) {
      const Texel got = look_up_by_plain(Lookup::trilinear, t, p);
      for (int c = 0; c < 4; ++c)
        ASSERT_NEAR(got.c[c], trilinear_at(t, p.u, p.v, p.lod, c), tolerance(t, p)) << p.u << ' ' << p.v << ' ' << p.lod;
    }
  });
}

TEST(Sampling, AWholeLevelIsThatLevelAlone) {
  const TextureData data = noise_texture(16, 8, 1, Address::repeat, Address::clamp);
  for (Place p : places(1.0f, 8)) {
    p.lod = 0;
    EXPECT_EQ(look_up_by_plain(Lookup::trilinear, data.view(), p).c[0], look_up_by_plain(Lookup::bilinear, data.view(), p).c[0]);
    p.lod = -5;
    EXPECT_EQ(look_up_by_plain(Lookup::trilinear, data.view(), p).c[0], look_up_by_plain(Lookup::bilinear, data.view(), p).c[0]);
    p.lod = 1;
    EXPECT_EQ(look_up_by_plain(Lookup::trilinear, data.view(), p).c[0], look_up_by_plain(Lookup::bilinear_of_level_1, data.view(), p).c[0]);
    p.lod = 1e30f;
    EXPECT_EQ(look_up_by_plain(Lookup::trilinear, data.view(), p).c[0], data.view().texels[data.view().offset[4]]);
  }
}

TEST(Sampling, MipIsTheNearestLevel) {
  const TextureData data = noise_texture(37, 18, 1, Address::repeat, Address::clamp);
  for (const Place& p : places(1.0f, 12)) {
    if (std::fabs(p.lod - std::floor(p.lod) - 0.5f) < 1e-5f) continue;
    const double level = std::clamp(std::round(double{p.lod}), 0.0, data.view().levels - 1.0);
    EXPECT_NEAR(look_up_by_plain(Lookup::mip, data.view(), p).c[0], trilinear_at(data.view(), p.u, p.v, level, 0),
                tolerance(data.view(), p));
  }
}

TEST(Sampling, TheMiddleChannelsAreThoseOfTheWholeTexel) {
  const TextureData data = noise_texture(7, 5, 4, Address::border, Address::mirror);
  for (const Place& p : places(2.0f, 9)) {
    const Texel all = look_up_by_plain(Lookup::bilinear, data.view(), p), some = look_up_by_plain(Lookup::middle_channels, data.view(), p);
    EXPECT_EQ(some.c[1], all.c[1]);
    EXPECT_EQ(some.c[2], all.c[2]);
  }
}

// With a side that is a power of two the centre's coordinate is exact, so the weights are 1 and 0.
TEST(Sampling, AtATexelCentreItIsTheTexelBitForBit) {
  for (const Address address : addresses) {
    for (const auto& [w, h] : {std::pair{8, 4}, {1, 1}, {64, 2}, {1, 16}}) {
      const TextureData data = noise_texture(w, h, 1, address, address, 2);
      for (int y = 0; y < h; ++y) {
        for (int x = 0; x < w; ++x) {
          const Place p{(static_cast<float>(x) + 0.5f) / static_cast<float>(w), (static_cast<float>(y) + 0.5f) / static_cast<float>(h), 0,
                        0};
          const float texel = data.view().texels[y * w + x];
          for (const Lookup lookup : {Lookup::bilinear, Lookup::nearest, Lookup::trilinear}) {
            ASSERT_EQ(std::bit_cast<std::uint32_t>(look_up_by_plain(lookup, data.view(), p).c[0]), std::bit_cast<std::uint32_t>(texel))
                << text(address) << ' ' << x << ' ' << y;
          }
        }
      }
    }
  }
}

// With other sides the quotient is rounded; a small side still comes out exact, any side almost.
TEST(Sampling, AtATexelCentreOfAnySideItIsTheTexelAlmost) {
  for (int w = 1; w <= 200; ++w) {
    const TextureData data = noise_texture(w, 1, 1, Address::clamp, Address::clamp, 3);
    for (int x = 0; x < w; ++x) {
      const Place p{(static_cast<float>(x) + 0.5f) / static_cast<float>(w), 0.5f, 0, 0};
      ASSERT_NEAR(look_up_by_plain(Lookup::bilinear, data.view(), p).c[0], data.view().texels[x], w * 0x1p-23) << w << ' ' << x;
      ASSERT_EQ(look_up_by_plain(Lookup::nearest, data.view(), p).c[0], data.view().texels[x]) << w << ' ' << x;
    }
  }
}

TEST(Sampling, TheSeamOfATileMixesBothEnds) {
  const TextureData data(std::vector<float>{1, 2, 3, 9}, 1, 4, 1, Address::repeat, Address::clamp);
  for (const float u : {0.0f, 1.0f, -1.0f, 17.0f, -64.0f}) {
    EXPECT_EQ(look_up_by_plain(Lookup::bilinear, data.view(), {u, 0.5f, 0, 0}).c[0], 5.0f) << u;
    EXPECT_EQ(look_up_by_plain(Lookup::nearest, data.view(), {u, 0.5f, 0, 0}).c[0], 1.0f) << u;
    EXPECT_EQ(look_up_by_plain(Lookup::bilinear, data.view(), {u + 0.0625f, 0.5f, 0, 0}).c[0], 3.0f) << u;
    EXPECT_EQ(look_up_by_plain(Lookup::bilinear, data.view(), {u - 0.0625f, 0.5f, 0, 0}).c[0], 7.0f) << u;
  }
}

TEST(Sampling, AMirrorTurnsBackAtEachEdge) {
  const TextureData data(std::vector<float>{1, 2, 3, 9}, 1, 4, 1, Address::mirror, Address::clamp);
  for (const float u : {0.0625f, 0.3f, 0.875f, 0.96875f}) {
    const float here = look_up_by_plain(Lookup::bilinear, data.view(), {u, 0.5f, 0, 0}).c[0];
    for (const float image : {-u, 2 - u, 2 + u, 4 - u}) {
      EXPECT_NEAR(look_up_by_plain(Lookup::bilinear, data.view(), {image, 0.5f, 0, 0}).c[0], here, 1e-5) << image;
    }
  }
  EXPECT_EQ(look_up_by_plain(Lookup::bilinear, data.view(), {1.0f, 0.5f, 0, 0}).c[0], 9.0f);
  EXPECT_EQ(look_up_by_plain(Lookup::bilinear, data.view(), {0.0f, 0.5f, 0, 0}).c[0], 1.0f);
}

TEST(Sampling, ABorderFadesInOverOneTexel) {
  TextureData data(std::vector<float>{2, 4}, 1, 2, 1, Address::border, Address::clamp);
  const auto at = [&](float u) { return look_up_by_plain(Lookup::bilinear, data.view(), {u, 0.5f, 0, 0}).c[0]; };
  EXPECT_EQ(at(0.0f), 1.0f);  // half border, which is zero by default
  EXPECT_EQ(at(-0.25f), 0.0f);
  EXPECT_EQ(at(1.0f), 2.0f);
  EXPECT_EQ(at(1.25f), 0.0f);
  data.set_border(10, 0, 0, 0);
  EXPECT_EQ(at(0.0f), 6.0f);
  EXPECT_EQ(at(-7.0f), 10.0f);
  EXPECT_EQ(at(1e9f), 10.0f);
  EXPECT_EQ(look_up_by_plain(Lookup::nearest, data.view(), {-0.01f, 0.5f, 0, 0}).c[0], 10.0f);
  EXPECT_EQ(look_up_by_plain(Lookup::nearest, data.view(), {0.01f, 0.5f, 0, 0}).c[0], 2.0f);
  EXPECT_EQ(look_up_by_plain(Lookup::nearest, data.view(), {1.0f, 0.5f, 0, 0}).c[0], 10.0f);
}

TEST(Sampling, HugeCoordinatesKeepToTheRule) {
  const std::vector<float> texels{1, 2, 3, 9};
  for (const float far : {1e6f, 0x1p31f, 1e20f, 0x1.fffffep127f}) {
    const TextureData clamped(texels, 1, 4, 1, Address::clamp, Address::clamp);
    TextureData border(texels, 1, 4, 1, Address::border, Address::border);
    border.set_border(-1, 0, 0, 0);
    for (const Lookup lookup : {Lookup::nearest, Lookup::bilinear}) {
      EXPECT_EQ(look_up_by_plain(lookup, clamped.view(), {far, far, 0, 0}).c[0], 9);
      EXPECT_EQ(look_up_by_plain(lookup, clamped.view(), {-far, -far, 0, 0}).c[0], 1);
      EXPECT_EQ(look_up_by_plain(lookup, border.view(), {far, 0.5f, 0, 0}).c[0], -1);
      EXPECT_EQ(look_up_by_plain(lookup, border.view(), {0.5f, -far, 0, 0}).c[0], -1);
      for (const Address address : {Address::repeat, Address::mirror}) {  // a whole even number of tiles away
        const TextureData tiled(texels, 1, 4, 1, address, Address::clamp);
        for (const float u : {far, -far}) {
          EXPECT_EQ(look_up_by_plain(lookup, tiled.view(), {u, 0.5f, 0, 0}).c[0],
                    look_up_by_plain(lookup, tiled.view(), {0.0f, 0.5f, 0, 0}).c[0])
              << text(address) << ' ' << u;
        }
      }
    }
  }
}

// The largest float below a whole number: fract rounds to 1, which must wrap and not read beyond the row.
TEST(Sampling, JustBelowAWholeTileStaysInTheTile) {
  const TextureData data(std::vector<float>{1, 2, 3, 9}, 1, 4, 1, Address::repeat, Address::repeat);
  for (const float u : {-0x1p-149f, -0x1p-30f, -1e-9f, 1.0f - 0x1p-24f, 2.0f - 0x1p-23f}) {
    const float x = look_up_by_plain(Lookup::bilinear, data.view(), {u, 0.5f, 0, 0}).c[0];
    EXPECT_NEAR(x, 5, 1e-5) << u;
    const float n = look_up_by_plain(Lookup::nearest, data.view(), {u, u, 0, 0}).c[0];
    EXPECT_TRUE(n == 1 || n == 9) << u;
  }
}

}  // namespace
}  // namespace rainref::test
