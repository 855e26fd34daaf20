// Lookups by the lanes of every SIMD target against the scalar evaluation, bit for bit.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>

#include "image/sampling_kernels.h"
#include "image/straightforward.h"
#include "math/every_target.h"

namespace rainref::test {
namespace {

std::vector<Place> tricky_places() {
  std::vector<Place> out;
  const float values[] = {
      0.0f,     -0.0f,  0.5f, 1.0f,   -1.0f, 0x1p-149f, -0x1p-149f, -0x1p-30f, 1 - 0x1p-24f, 1 + 0x1p-23f,    0.25f,
      1.0f / 3, -2.75f, 7.0f, 255.5f, 1e6f,  -1e6f,     0x1p31f,    -0x1p31f,  1e20f,        0x1.fffffep127f, -0x1.fffffep127f};
  for (const float u : values)
    for (const float v : values) out.push_back({u, v, 0.3f, u});
  std::mt19937 random(4);
  const auto next = [&] { return static_cast<float>(random() >> 8) * 0x1p-22f - 2.0f; };
  while (out.size() < 2048) {
    const float u = next(), v = next(), w = next(), lod = next() * 4;
    out.push_back({u, v, w, lod});
  }
  return out;
}

void check(Lookup lookup, const TextureData& data, const std::vector<Place>& places) {
  std::vector<Texel> expected, got(places.size());
  for (const Place& p : places) expected.push_back(look_up_by_plain(lookup, data.view(), p));
  for_every_target([&] {
    look_up_by_lanes(lookup, data.view(), places.data(), got.data(), places.size());
    for (std::size_t i = 0; i < places.size(); ++i) {
      for (int c = 0; c < 4; ++c) {
        ASSERT_EQ(std::bit_cast<std::uint32_t>(got[i].c[c]), std::bit_cast<std::uint32_t>(expected[i].c[c]))
            << "lookup " << static_cast<int>(lookup) << " at " << places[i].u << ' ' << places[i].v << ' ' << places[i].w << ' '
            << places[i].lod << ": " << got[i].c[c] << ", plain " << expected[i].c[c];
      }
    }
  });
}

TEST(SamplingLanes, HaveTheBitsOfTheScalarEvaluationUnderEveryAddressRule) {
  const std::vector<Place> places = tricky_places();
  for (const Address u : {Address::clamp, Address::repeat, Address::mirror, Address::border}) {
    for (const Address v : {Address::clamp, Address::repeat, Address::mirror, Address::border}) {
      const TextureData one = noise_texture(13, 6, 1, u, v), four = noise_texture(8, 16, 4, u, v);
      for (const Lookup lookup : {Lookup::nearest, Lookup::bilinear, Lookup::trilinear}) {
        check(lookup, one, places);
        check(lookup, four, places);
      }
      check(Lookup::bilinear_of_level_1, one, places);
      check(Lookup::mip, one, places);
      check(Lookup::middle_channels, four, places);
    }
  }
}

// The second level is skipped where no lane needs it: mixtures of whole and fractional levels, and runs of whole ones.
TEST(SamplingLanes, DoNotDependOnWhichLanesNeedASecondLevel) {
  std::vector<Place> places = tricky_places();
  const TextureData data = noise_texture(32, 16, 4, Address::repeat, Address::clamp);
  for (std::size_t i = 0; i < places.size(); ++i) {
    const std::size_t run = i / 32 % 4;
    places[i].lod = run == 0 ? 0.0f : run == 1 ? 2.0f : run == 2 ? static_cast<float>(i % 5) : i % 16 == 3 ? 1.5f : 0.0f;
  }
  check(Lookup::trilinear, data, places);
}

// What lanes make sooner of textures with fixed rules: far inside, at each edge, over it, and of images too small for the short ways.
TEST(SamplingLanes, HaveTheBitsOfTheScalarEvaluationUnderFixedRules) {
  std::vector<Place> places = tricky_places(), inside = places;
  for (std::size_t i = 0; i < inside.size(); ++i)
    inside[i] = {0.4f + static_cast<float>(i % 61) / 400, 0.4f + static_cast<float>(i % 53) / 400, 0, static_cast<float>(i / 32 % 5)};
  for (const auto& [width, height] : {std::array{64, 48}, std::array{13, 6}, std::array{4, 4}, std::array{3, 5}, std::array{1, 2}}) {
    for (const std::vector<Place>* some : {&places, &inside}) {
      const TextureData clamped = noise_texture(width, height, 1, Address::clamp, Address::clamp);
      check(Lookup::clamped, clamped, *some);
      check(Lookup::neighbours, clamped, *some);
      TextureData bordered = noise_texture(width, height, 1, Address::border, Address::border);
      check(Lookup::bordered, bordered, *some);
      check(Lookup::bordered,
            TextureData(std::vector<float>(bordered.view().texels, bordered.view().texels + width * height), 1, width, height,
                        Address::border, Address::border),
            *some);
      check(Lookup::pair, noise_texture(width, height, 2, Address::repeat, Address::repeat), *some);
      check(Lookup::colour, noise_texture(width, height, 4, Address::repeat, Address::repeat), *some);
    }
  }
}

TEST(SamplingLanes, HaveTheBitsOfTheScalarEvaluationByDirection) {
  std::vector<Place> places = tricky_places();
  for (Place& p : places) {  // directions of moderate length, their zeros and signs kept
    for (float* x : {&p.u, &p.v, &p.w}) *x = std::fabs(*x) > 4 ? std::copysign(0.75f, *x) : *x;
  }
  const TextureData panorama = noise_texture(32, 16, 4, Address::repeat, Address::clamp);
  check(Lookup::latlong, panorama, places);
  check(Lookup::latlong_mip, panorama, places);
  TextureData faces(std::vector<float>(8 * 48 * 4), 4, 8, 48, Address::clamp, Address::clamp);
  for (int i = 0; i < 8 * 48 * 4; ++i) faces.texels()[i] = static_cast<float>(i * 7919 % 1009) / 1009.0f;
  faces.build_mips(4);
  check(Lookup::cube, faces, places);
}

}  // namespace
}  // namespace rainref::test
