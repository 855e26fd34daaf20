// Lookups of enclosures: the reference's bits under ieee, every sample that a device may take under the other profiles.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <vector>

#include "image/footprint.h"
#include "image/sampling_kernels.h"
#include "image/straightforward.h"
#include "math/profiles.h"
#include "math/rearranged.h"

namespace rainref::test {
namespace enclosed_reading {
using namespace rainref::scalar;
#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "image/sampling-inl.h"
#include "image/sampling_enclosed-inl.h"
#include "image/sampling_rearranged-inl.h"
#include "image/environment-inl.h"
#include "image/sampling_lookup-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA
}  // namespace enclosed_reading

namespace {

using enclosed::Enclosure;
using enclosed::PathEnumeration;
using enclosed::Profile;
using enclosed::ProfileScope;

constexpr Address addresses[] = {Address::clamp, Address::repeat, Address::mirror, Address::border};

struct Hulls {
  Enclosure c[4];
};
// The alternatives of a lookup; empty when there are too many.
std::vector<Hulls> look_up(Lookup lookup, const Texture& t, Enclosure u, Enclosure v, Enclosure w = 0.0f, Enclosure lod = 0.0f) {
  std::vector<Hulls> found;
  PathEnumeration paths;
  const bool whole = paths.for_each_alternative([&] {
    Hulls h;
    enclosed_reading::look_up<Enclosure>(lookup, t, u, v, w, lod, h.c);
    found.push_back(h);
  });
  if (!whole) found.clear();
  return found;
}
bool holds(const std::vector<Hulls>& alternatives, const double (&value)[4], int channels) {
  return std::any_of(alternatives.begin(), alternatives.end(), [&](const Hulls& h) {
    for (int k = 0; k < channels; ++k) {
      if (!(h.c[k].lo <= value[k] && value[k] <= h.c[k].hi)) return false;
    }
    return true;
  });
}

struct Random {
  std::mt19937 words{7};
  double operator()(double low, double high) { return low + (high - low) * (words() * 0x1p-32); }
};

TEST(SamplingEnclosed, HasTheBitsOfTheScalarEvaluationUnderIeee) {
  Random random;
  std::vector<Place> places;
  const float values[] = {0.0f, -0.0f, 0.5f, 1.0f, -1.0f, 0x1p-149f, -0x1p-30f, 1 - 0x1p-24f, 0.25f, 1.0f / 3, -2.75f, 7.0f, 255.5f, 1e6f};
  for (const float u : values)
    for (const float v : values) places.push_back({u, v, 0.3f, u});
  for (int i = 0; i < 300; ++i) {
    const auto next = [&](double size) { return static_cast<float>(random(-size, size)); };
    places.push_back({next(2), next(2), next(1), next(6)});
  }
  const ProfileScope scope(profile_named("ieee"));
  for (const Address u : addresses) {
    for (const Address v : addresses) {
      const TextureData one = noise_texture(13, 6, 1, u, v), four = noise_texture(8, 16, 4, u, v);
      for (const Lookup lookup :
           {Lookup::nearest, Lookup::bilinear, Lookup::bilinear_of_level_1, Lookup::trilinear, Lookup::mip, Lookup::middle_channels}) {
        const bool of_one = lookup == Lookup::bilinear_of_level_1 || lookup == Lookup::mip;
        const Texture& t = of_one ? one.view() : four.view();
        for (const Place& p : places) {
          const auto alternatives = look_up(lookup, t, p.u, p.v, p.w, p.lod);
          const Texel expected = look_up_by_plain(lookup, t, p);
          ASSERT_EQ(alternatives.size(), 1u);
          for (int k = 0; k < 4; ++k) {
            ASSERT_EQ(std::bit_cast<std::uint32_t>(alternatives[0].c[k].lo), std::bit_cast<std::uint32_t>(expected.c[k]))
                << static_cast<int>(lookup) << " at " << p.u << ' ' << p.v << ' ' << p.lod;
            ASSERT_EQ(alternatives[0].c[k].lo, alternatives[0].c[k].hi);
          }
        }
      }
    }
  }
}

// A device computes its own coordinate: up to a step of its subtexel grid beside the true one, for any u in the
// interval.
TEST(SamplingEnclosed, HoldsEverySampleWithinTheSlackAndLiesWithinTheTexels) {
  Random random;
  for (const Profile& p : profiles()) {
    if (p.reference) continue;  // its one value is the reference's, not the exact one
    const ProfileScope scope(p);
    const double step = p.subtexel_bits > 0 ? std::ldexp(1.0, -p.subtexel_bits) : 0;
    for (const Address a : addresses) {
      const TextureData data = noise_texture(13, 9, 1, a, a);
      const Texture& t = data.view();
      for (int i = 0; i < 400; ++i) {
        const float u = static_cast<float>(random(-1.5, 2.5)), v = static_cast<float>(random(-1.5, 2.5));
        const bool point = i % 4 == 0;
        const float du = point ? 0 : static_cast<float>(random(0, i % 4 == 1 ? 1e-4 : 0.15)), dv = point ? 0 : du / 2;
        const Enclosure eu(u, u + du), ev(v, v + dv);
        const auto alternatives = look_up(Lookup::bilinear, t, eu, ev);
        ASSERT_EQ(alternatives.size(), 1u) << "a filtered lookup decides nothing";
        const Enclosure hull = alternatives[0].c[0];
        double least = 1e30, greatest = -1e30;
        for (int sample = 0; sample < 40; ++sample) {
          const double x = (sample < 4 ? (sample & 1 ? eu.hi : eu.lo) : random(eu.lo, eu.hi)) + random(-step, step) / t.width[0];
          const double y = (sample < 4 ? (sample & 2 ? ev.hi : ev.lo) : random(ev.lo, ev.hi)) + random(-step, step) / t.height[0];
          const double value = bilinear_at(t, 0, x, y, 0);
          ASSERT_TRUE(hull.lo <= value + 1e-12 && value - 1e-12 <= hull.hi)
              << p.name << " address " << static_cast<int>(a) << " at " << x << ' ' << y << ": " << value << " in [" << hull.lo << ", "
              << hull.hi << "]";
        }
        // The texels of the cells in reach, one more to each side where rounding may reach it.
        const auto first = [&](double c, int side) { return static_cast<long long>(std::floor(c * side - 0.5 - step - 1e-3)); };
        for (long long x = first(eu.lo, 13); x <= first(eu.hi + 2 * (step + 1e-3) / 13, 13) + 1; ++x) {
          for (long long y = first(ev.lo, 9); y <= first(ev.hi + 2 * (step + 1e-3) / 9, 9) + 1; ++y) {
            const double texel = texel_at(t, 0, x, y, 0);
            least = std::min(least, texel);
            greatest = std::max(greatest, texel);
          }
        }
        const double rounding = 20 * 0x1p-23 * std::max(-least, greatest);
        ASSERT_GE(hull.lo, least - rounding) << p.name << " address " << static_cast<int>(a) << " from " << u << " " << v << " by " << du
                                             << ", " << least - hull.lo << " above " << rounding;
        ASSERT_LE(hull.hi, greatest + rounding) << p.name;
      }
    }
  }
}

TEST(SamplingEnclosed, HoldsTheScalarEvaluation) {
  Random random;
  for (const Profile& p : profiles()) {
    const ProfileScope scope(p);
    for (const Address a : addresses) {
      const TextureData one = noise_texture(16, 9, 1, a, a), four = noise_texture(64, 32, 4, Address::repeat, Address::clamp);
      const TextureData cube = noise_texture(8, 48, 4, Address::clamp, Address::clamp);
      for (int i = 0; i < 300; ++i) {
        const auto next = [&](double size) { return static_cast<float>(random(-size, size)); };
        const Place place{next(2), next(2), next(1), i % 3 == 0 ? static_cast<float>(i % 5) : next(5)};
        for (const Lookup lookup :
             {Lookup::nearest, Lookup::bilinear, Lookup::trilinear, Lookup::mip, Lookup::latlong, Lookup::latlong_mip, Lookup::cube}) {
          const bool colour = lookup >= Lookup::latlong;
          const Texture& t = lookup == Lookup::cube ? cube.view() : colour ? four.view() : one.view();
          const auto alternatives = look_up(lookup, t, place.u, place.v, place.w, place.lod);
          const Texel expected = look_up_by_plain(lookup, t, place);
          ASSERT_FALSE(alternatives.empty());
          ASSERT_TRUE(holds(alternatives, {expected.c[0], expected.c[1], expected.c[2], expected.c[3]}, 4))
              << p.name << " lookup " << static_cast<int>(lookup) << " at " << place.u << ' ' << place.v << ' ' << place.w << ' '
              << place.lod << ": " << expected.c[0] << " in [" << alternatives[0].c[0].lo << ", " << alternatives[0].c[0].hi << "]";
        }
      }
    }
  }
}

TEST(SamplingEnclosed, NeighboursHoldTheScalarEvaluation) {
  Random random;
  for (const Profile& p : profiles()) {
    const ProfileScope scope(p);
    for (const Address a : addresses) {
      const TextureData data = noise_texture(16, 9, 1, a, a);
      for (int i = 0; i < 400; ++i) {
        const float u = static_cast<float>(random(-0.5, 1.5)), v = static_cast<float>(random(-0.5, 1.5));
        using Single = scalar::Scalar<float>;
        const auto near = enclosed_reading::sample_neighbours<0, Single>(data.view(), Single(u), Single(v));
        PathEnumeration paths;
        ASSERT_TRUE(paths.for_each_alternative([&] {
          const auto held = enclosed_reading::sample_neighbours<0, Enclosure>(data.view(), Enclosure(u), Enclosure(v));
          EXPECT_TRUE(held.left.contains(near.left.v) && held.right.contains(near.right.v) && held.down.contains(near.down.v) &&
                      held.up.contains(near.up.v))
              << p.name << ' ' << static_cast<int>(a) << ' ' << u << ' ' << v;
        }));
        ASSERT_EQ(paths.runs(), 1);
      }
    }
  }
}

TEST(SamplingEnclosed, ARampIsAsWideAsTheStepsOfTheSampler) {
  std::vector<float> texels(64);
  for (int i = 0; i < 64; ++i) texels[i] = static_cast<float>(i);
  const TextureData ramp(texels, 1, 64, 1, Address::clamp, Address::clamp);
  const ProfileScope scope(profile_named("d3d"));
  for (int i = 10; i < 500; ++i) {
    const float u = 0.1f + static_cast<float>(i) * 0.0016f;
    const Enclosure hull = look_up(Lookup::bilinear, ramp.view(), u, 0.5f)[0].c[0];
    // +-1/256 texel, and roundings of values up to 64.
    EXPECT_GE(hull.hi - hull.lo, 2 / 256.0);
    EXPECT_LE(hull.hi - hull.lo, 2 / 256.0 + 64 * 20 * 0x1p-23);
  }
}

TEST(SamplingEnclosed, AnUnfilteredLookupIsDecidedNearEdgesOnly) {
  const TextureData data = noise_texture(16, 16, 1, Address::repeat, Address::clamp);
  const ProfileScope scope(profile_named("vulkan"));
  const auto texels_at = [&](float u, float v) {
    std::vector<float> found;
    for (const Hulls& h : look_up(Lookup::nearest, data.view(), u, v)) {
      EXPECT_TRUE(h.c[0].is_point());
      found.push_back(h.c[0].lo);
    }
    std::sort(found.begin(), found.end());
    return found;
  };
  const auto texels = [&](std::vector<std::array<int, 2>> places) {
    std::vector<float> expected;
    for (const auto& [x, y] : places) expected.push_back(data.view().texels[16 * y + x]);
    std::sort(expected.begin(), expected.end());
    return expected;
  };
  EXPECT_EQ(texels_at(3.5f / 16, 5.5f / 16), texels({{3, 5}}));
  EXPECT_EQ(texels_at(4 / 16.0f, 5.5f / 16), texels({{3, 5}, {4, 5}}));
  EXPECT_EQ(texels_at((4 + 0x1p-7f) / 16, 5.5f / 16), texels({{4, 5}}));
  EXPECT_EQ(texels_at(4 / 16.0f, 6 / 16.0f), texels({{3, 5}, {4, 5}, {3, 6}, {4, 6}}));
  EXPECT_EQ(texels_at(2.0f, 5.5f / 16), texels({{15, 5}, {0, 5}}));  // over the seam
  EXPECT_EQ(texels_at(3.5f / 16, 1.0f), texels({{3, 15}}));          // the edge of a clamped side has one texel
}

TEST(SamplingEnclosed, LevelsAreDecidedBetweenThemAndWholeOnesAreSettled) {
  const TextureData data = noise_texture(16, 16, 1, Address::repeat, Address::repeat);
  for (const Profile& p : profiles()) {
    const ProfileScope scope(p);
    const std::size_t open = p.lod_bits > 0 ? 2 : 1;
    EXPECT_EQ(look_up(Lookup::mip, data.view(), 0.3f, 0.3f, 0.0f, 1.0f).size(), 1u);
    EXPECT_EQ(look_up(Lookup::mip, data.view(), 0.3f, 0.3f, 0.0f, std::nextafter(1.5f, 0.0f)).size(), open) << p.name;
    EXPECT_EQ(look_up(Lookup::mip, data.view(), 0.3f, 0.3f, 0.0f, Enclosure(1.25f, 2.75f)).size(), 3u) << p.name;
    // Trilinear lookups are continuous.
    EXPECT_EQ(look_up(Lookup::trilinear, data.view(), 0.3f, 0.3f, 0.0f, Enclosure(0.25f, 2.75f)).size(), 1u);
  }
}
TEST(SamplingEnclosed, TrilinearHoldsEveryLevelBetween) {
  Random random;
  const TextureData data = noise_texture(32, 16, 1, Address::repeat, Address::repeat);
  for (const Profile& p : profiles()) {
    if (p.reference) continue;
    const ProfileScope scope(p);
    const double step = p.lod_bits > 0 ? std::ldexp(1.0, -p.lod_bits) : 0;
    for (int i = 0; i < 300; ++i) {
      const float u = static_cast<float>(random(-1, 2)), v = static_cast<float>(random(-1, 2)), lod = static_cast<float>(random(-1, 6));
      const Enclosure range(lod, lod + (i % 2 ? 0 : static_cast<float>(random(0, 2))));
      const Enclosure hull = look_up(Lookup::trilinear, data.view(), u, v, 0.0f, range)[0].c[0];
      for (int sample = 0; sample < 20; ++sample) {
        const double value = trilinear_at(data.view(), u, v, random(range.lo, range.hi) + random(-step, step), 0);
        ASSERT_TRUE(hull.lo <= value + 1e-12 && value - 1e-12 <= hull.hi) << p.name << ' ' << u << ' ' << v << ' ' << lod;
      }
    }
  }
}

TEST(SamplingEnclosed, WideCoordinatesGiveTheHullOfTheTexelsOrNothing) {
  const TextureData small = noise_texture(40, 30, 1, Address::repeat, Address::repeat),
                    large = noise_texture(300, 300, 1, Address::repeat, Address::repeat);
  const ProfileScope scope(profile_named("vulkan"));
  const auto [least, greatest] = std::minmax_element(small.view().texels, small.view().texels + 40 * 30);
  const Enclosure all = look_up(Lookup::bilinear, small.view(), Enclosure(-5.0f, 1e6f), Enclosure(0.0f, 2.0f))[0].c[0];
  EXPECT_NEAR(all.lo, *least, 1e-5);
  EXPECT_NEAR(all.hi, *greatest, 1e-5);
  EXPECT_TRUE(look_up(Lookup::bilinear, large.view(), Enclosure(-5.0f, 1e6f), Enclosure(0.0f, 2.0f))[0].c[0].is_vacuous());
  EXPECT_TRUE(look_up(Lookup::bilinear, small.view(), Enclosure::vacuous(), 0.5f)[0].c[0].is_vacuous());
  EXPECT_TRUE(look_up(Lookup::nearest, small.view(), Enclosure(0.0f, 1.0f), 0.5f)[0].c[0].lo >= *least);
}

// A direction straight down has any longitude: the last row's hull, not a hull of branches that an arc tangent takes.
TEST(SamplingEnclosed, ThePoleHoldsItsRow) {
  const TextureData data = noise_texture(64, 32, 4, Address::repeat, Address::clamp);
  const ProfileScope scope(profile_named("vulkan"));
  const auto alternatives = look_up(Lookup::latlong, data.view(), Enclosure(-1e-8f, 1e-8f), Enclosure(-1.0f), Enclosure(-1e-8f, 1e-8f));
  ASSERT_EQ(alternatives.size(), 1u);
  for (int x = 0; x < 64; ++x) EXPECT_TRUE(alternatives[0].c[0].contains(data.view().texels[4 * x])) << x;
  EXPECT_FALSE(alternatives[0].c[0].is_vacuous());
}

}  // namespace
}  // namespace rainref::test
