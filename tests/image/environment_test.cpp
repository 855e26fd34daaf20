// Lookups by direction against a straightforward implementation in double.
#include <gtest/gtest.h>

#include <cmath>

#include "image/sampling_kernels.h"
#include "image/straightforward.h"

namespace rainref::test {
namespace {

std::vector<Place> directions(int count) {
  std::mt19937 random(11);
  const auto next = [&] { return static_cast<float>(random() >> 8) * 0x1p-23f - 1.0f; };
  std::vector<Place> out;
  while (static_cast<int>(out.size()) < count) {
    const float x = next(), y = next(), z = next(), l = std::sqrt(x * x + y * y + z * z);
    if (l > 0.1f && l < 1) out.push_back({x / l, y / l, z / l, 2 * next() + 1.5f});
  }
  return out;
}
/// Six faces above each other, each with its own number, and mips that keep whole faces.
TextureData cube(int side) {
  std::vector<float> texels;
  for (int face = 0; face < 6; ++face) {
    for (int i = 0; i < side * side; ++i) {
      texels.insert(texels.end(), {static_cast<float>(face), static_cast<float>(i % side), static_cast<float>(i / side), 1.0f});
    }
  }
  TextureData t(std::move(texels), 4, side, 6 * side, Address::clamp, Address::clamp);
  t.build_mips(1 + std::countr_zero(static_cast<unsigned>(side)));
  return t;
}

TEST(LatLong, IsTheTextbookLookup) {
  const TextureData data = noise_texture(32, 16, 4, Address::repeat, Address::clamp);
  for (const Place& p : directions(2000)) {
    const Texel sharp = look_up_by_plain(Lookup::latlong, data.view(), p), soft = look_up_by_plain(Lookup::latlong_mip, data.view(), p);
    for (int c = 0; c < 3; ++c) {
      EXPECT_NEAR(sharp.c[c], latlong_at(data.view(), {p.u, p.v, p.w}, 0, c), 2e-5);
      EXPECT_NEAR(soft.c[c], latlong_at(data.view(), {p.u, p.v, p.w}, p.lod, c), 2e-5);
    }
  }
}

TEST(LatLong, PolesAndSeam) {
  std::vector<float> texels;
  for (int y = 0; y < 4; ++y)
    for (int x = 0; x < 8; ++x) texels.insert(texels.end(), {static_cast<float>(x), static_cast<float>(y), 0.0f, 1.0f});
  const TextureData data(std::move(texels), 4, 8, 4, Address::repeat, Address::clamp);
  const auto at = [&](float x, float y, float z) { return look_up_by_plain(Lookup::latlong, data.view(), {x, y, z, 0}); };
  EXPECT_EQ(at(0, -1, 0).c[1], 0.0f);  // row 0 looks straight down
  EXPECT_EQ(at(0, 1, 0).c[1], 3.0f);
  EXPECT_NEAR(at(1, 0, 0).c[0], 3.5f, 1e-5);       // +x in the middle
  EXPECT_NEAR(at(0, 0, 1).c[0], 5.5f, 1e-5);       // +z a quarter further
  EXPECT_NEAR(at(-1, 0, 1e-7f).c[0], 3.5f, 1e-4);  // the seam, between columns 7 and 0
  EXPECT_NEAR(at(-1, 0, -1e-7f).c[0], 3.5f, 1e-4);
}

TEST(Cube, IsTheTextbookLookupAtEveryLevel) {
  const TextureData data = cube(8);
  for (const Place& p : directions(4000)) {
    // A direction on the edge of two faces, or a level between two, may fall to either side.
    const double a = std::fabs(p.u), b = std::fabs(p.v), c = std::fabs(p.w), most = std::max({a, b, c});
    const double second = a + b + c - most - std::min({a, b, c});
    if (most - second < 1e-5 || std::fabs(p.lod - std::floor(p.lod) - 0.5) < 1e-5) continue;
    const Texel got = look_up_by_plain(Lookup::cube, data.view(), p);
    for (int k = 0; k < 3; ++k) {
      EXPECT_NEAR(got.c[k], cube_at(data.view(), {p.u, p.v, p.w}, p.lod, k), 5e-5) << p.u << ' ' << p.v << ' ' << p.w << ' ' << p.lod;
    }
  }
}

TEST(Cube, EachAxisLooksAtTheMiddleOfItsFaceAndNoFaceBleedsIntoAnother) {
  const TextureData data = cube(8);
  const float axes[6][3] = {{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}};
  for (int face = 0; face < 6; ++face) {
    const auto& a = axes[face];
    for (const float lod : {0.0f, 1.0f, 3.0f}) {
      EXPECT_EQ(look_up_by_plain(Lookup::cube, data.view(), {a[0], a[1], a[2], lod}).c[0], static_cast<float>(face));
      for (const float s : {-0.9999f, 0.9999f}) {  // next to an edge
        const float u = a[0] ? a[0] : s, v = a[1] ? a[1] : s, w = a[2] ? a[2] : s;
        EXPECT_NEAR(look_up_by_plain(Lookup::cube, data.view(), {u, v, w, lod}).c[0], static_cast<float>(face), 1e-5) << lod;
      }
    }
    const Texel middle = look_up_by_plain(Lookup::cube, data.view(), {a[0], a[1], a[2], 0});
    EXPECT_EQ(middle.c[1], 3.5f);
    EXPECT_EQ(middle.c[2], 3.5f);
  }
}

}  // namespace
}  // namespace rainref::test
