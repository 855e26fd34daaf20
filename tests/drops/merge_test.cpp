// W8: coalescence, its order, and the trails.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "support.h"

namespace rainref::drops {
namespace {

using test::drop;
using test::F;

const MergeUniforms uniforms = merge_uniforms(Settings(), test::frame, 1.0 / 60, 64, 32, 4);
float radius_of(float mass) { return scalar::base_radius(uniforms, F(mass)).v; }

std::vector<Drop> merged(std::vector<Drop> drops, const MergeUniforms& u = uniforms, int threads = 1, std::int64_t* ended = nullptr) {
  const parallel::Executor executor(threads);
  DropArrays a = test::arrays_of(drops);
  Merger merger;
  const std::int64_t n = merger.merge(executor, a, u);
  if (ended) *ended = n;
  a.gather(drops, executor);
  std::sort(drops.begin(), drops.end(), [](const Drop& x, const Drop& y) { return x.id < y.id; });
  return drops;
}
bool same(const std::vector<Drop>& a, const std::vector<Drop>& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(Drop)) == 0;
}

TEST(Merge, TwoDropsBecomeOneWithTheirMassAndMomentum) {
  const Drop a = drop(0.5f, 0.5f, 300000, 4, 0.25f, -0.5f, 10), b = drop(0.5005f, 0.5f, 100000, 2, -0.75f, 0.5f, 90);
  const auto out = merged({b, a});
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(out[0].id, 4u);
  EXPECT_EQ(out[0].mass, 400000);
  EXPECT_EQ(out[0].life, 10);
  EXPECT_EQ(out[0].velocity[0], 0.0f);  // (3 * 1/4 - 3/4) / 4
  EXPECT_EQ(out[0].velocity[1], -0.25f);
  EXPECT_NEAR(out[0].position[0], 0.500125f, 1e-7);
  // r^3 = r1^3 + r2^3, the same contact angle.
  EXPECT_NEAR(std::pow(radius_of(400000), 3), std::pow(radius_of(300000), 3) + std::pow(radius_of(100000), 3),
              1e-6 * std::pow(radius_of(400000), 3));
  // Kinetic energy lost: m1 m2 / (2 m) |v1 - v2|^2.
  const auto energy = [](const Drop& d) { return 0.5 * d.mass * (d.velocity[0] * d.velocity[0] + d.velocity[1] * d.velocity[1]); };
  EXPECT_NEAR(energy(a) + energy(b) - energy(out[0]), 300000.0 * 100000 / (2 * 400000.0) * 2, 1e-2);
}

TEST(Merge, TouchingBeginsWhereTheBasesMeet) {
  const float m1 = 250000, m2 = 90000, reach = radius_of(m1) + radius_of(m2);
  for (const float share : {0.999f, 1.001f}) {
    const float du = share * reach / static_cast<float>(test::glass_width), dv = share * reach / static_cast<float>(test::glass_height);
    EXPECT_EQ(merged({drop(0.5f, 0.5f, m1, 0), drop(0.5f + du, 0.5f, m2, 1)}).size(), share < 1 ? 1u : 2u);
    EXPECT_EQ(merged({drop(0.5f, 0.5f, m1, 0), drop(0.5f, 0.5f - dv, m2, 1)}).size(), share < 1 ? 1u : 2u);
  }
}

TEST(Merge, OfEqualDropsTheOlderOneStays) {
  const auto out = merged({drop(0.5f, 0.5f, 1000, 9), drop(0.50001f, 0.5f, 1000, 3)});
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(out[0].id, 3u);
}

// a touches b, b touches c, a and c are apart: a -> b -> c ends in c, whatever the slots.
TEST(Merge, ChainsEndInTheirLargestDrop) {
  const float step = 1.2f * radius_of(100000) / static_cast<float>(test::glass_width);
  std::vector<Drop> chain{drop(0.5f, 0.5f, 100000, 0, 0.1f, 0), drop(0.5f + step, 0.5f, 110000, 1, 0.2f, 0),
                          drop(0.5f + 2 * step, 0.5f, 120000, 2, 0.3f, 0)};
  std::vector<Drop> expected;
  std::sort(chain.begin(), chain.end(), [](const Drop& a, const Drop& b) { return a.id < b.id; });
  do {
    const auto out = merged(chain);
    ASSERT_EQ(out.size(), 1u);
    EXPECT_EQ(out[0].id, 2u);
    EXPECT_EQ(out[0].mass, 330000);
    if (expected.empty()) expected = out;
    EXPECT_TRUE(same(out, expected));
  } while (std::next_permutation(chain.begin(), chain.end(), [](const Drop& a, const Drop& b) { return a.id < b.id; }));
}

// Two small drops beside a large one and beside each other: both go to the large one, not to each other.
TEST(Merge, GoesToTheLargestThatTouches) {
  const float reach = 0.9f * radius_of(1e6f) / static_cast<float>(test::glass_width);
  const auto out = merged({drop(0.5f + reach, 0.5f, 2000, 0), drop(0.5f + 1.01f * reach, 0.5f, 3000, 1), drop(0.5f, 0.5f, 1e6f, 2)});
  ASSERT_EQ(out.size(), 1u);
  EXPECT_EQ(out[0].id, 2u);
  EXPECT_EQ(out[0].mass, 1005000);
}

TEST(Merge, BeyondTheLargestMassItDoesNotHappen) {
  std::int64_t ended = 0;
  const auto out = merged({drop(0.5f, 0.5f, 0x1p24f - 100, 0), drop(0.5f, 0.5f, 60, 1), drop(0.5f, 0.5f, 50, 2), drop(0.5f, 0.5f, 40, 3)},
                          uniforms, 1, &ended);
  // 60 fits, then 50 does not, 40 does: exactly 2^24.
  ASSERT_EQ(out.size(), 2u);
  EXPECT_EQ(out[0].mass, 0x1p24f);
  EXPECT_EQ(out[1].id, 2u);
  EXPECT_EQ(ended, 2);
}

// 2^24 + 1 is no float: a sum that is rounded before it is compared would lose a mass unit.
TEST(Merge, AFullDropTakesNotEvenOneQuantum) {
  const auto out = merged({drop(0.5f, 0.5f, most_mass, 0), drop(0.5001f, 0.5f, 1, 1)});
  ASSERT_EQ(out.size(), 2u);
  EXPECT_EQ(out[0].mass, most_mass);
  EXPECT_EQ(out[1].mass, 1);
}

TEST(Merge, FreeSlotsTakeNoPart) {
  auto out = merged({drop(0.5f, 0.5f, 1000, 0), drop(0.5f, 0.5f, 5000, 1, 0, 0, 0), drop(0.7f, 0.5f, 1000, 2)});
  EXPECT_EQ(out.size(), 2u);
  EXPECT_TRUE(merged({drop(0.5f, 0.5f, 5000, 1, 0, 0, 0)}).empty());
}

// Every pair compared, as the rule says it, without grid or classes.
std::vector<Drop> by_brute_force(std::vector<Drop> drops, const MergeUniforms& u) {
  std::erase_if(drops, [](const Drop& d) { return !(d.life > 0); });
  const auto larger = [](const Drop& a, const Drop& b) { return a.mass > b.mass || (a.mass == b.mass && a.id < b.id); };
  std::map<std::uint32_t, std::uint32_t> to;
  std::map<std::uint32_t, Drop> all;
  for (const Drop& d : drops) {
    all[d.id] = d;
    const Drop* best = nullptr;
    const auto x = scalar::plane_x(u, F(d.position[0]), F(d.position[1])), y = scalar::plane_y(u, F(d.position[1])),
               r = scalar::base_radius(u, F(d.mass));
    for (const Drop& o : drops) {
      const auto ox = scalar::plane_x(u, F(o.position[0]), F(o.position[1])), oy = scalar::plane_y(u, F(o.position[1])),
                 orad = scalar::base_radius(u, F(o.mass));
      if (larger(o, d) && scalar::touches(x, y, r, ox, oy, orad) && (!best || larger(o, *best))) best = &o;
    }
    if (best) to[d.id] = best->id;
  }
  const std::map<std::uint32_t, Drop> before = all;
  for (const auto& [id, next] : to) {  // ascending ids
    std::uint32_t root = next;
    while (to.contains(root)) root = to[root];
    Drop& r = all[root];
    const Drop& d = before.at(id);
    if (d.mass > most_mass - r.mass) continue;
    const auto s = scalar::absorb(test::state_of<F>(r), test::state_of<F>(d));
    r = {{s.u.v, s.v.v}, {s.velocity_u.v + 0.0f, s.velocity_v.v + 0.0f}, s.mass.v, s.life.v, root, 0};
    all[id].life = 0;
  }
  std::vector<Drop> out;
  for (const auto& [id, d] : all) {
    if (d.life > 0) out.push_back(d);
  }
  return out;
}

TEST(Merge, IsWhatEveryPairComparedGives) {
  int chains = 0;
  for (std::uint32_t seed = 0; seed < 16; ++seed) {
    // From a sprinkle to a crowd, masses over the whole range; sheared and flipped glass too.
    const float most = seed % 3 == 0 ? 300 : seed % 3 == 1 ? 3e5f : 1.6e7f;
    auto drops = test::random_drops(700, seed, most);
    MergeUniforms u = uniforms;
    if (seed % 2) u.frame[1] = seed % 4 == 1 ? 0.5f : -0.7f;
    if (seed > 7) u.radius *= 12;
    if (seed > 11) {
      // The largest of their class, and so crowded that the cells are as small as their reach allows.
      u.radius = 0.0027f;
      for (Drop& d : drops) d.mass = static_cast<float>(4095 - d.id % 50);
    }
    const auto expected = by_brute_force(drops, u);
    ASSERT_TRUE(same(merged(drops, u), expected)) << seed;
    chains += expected.size() < drops.size() * 7 / 8;
  }
  EXPECT_GT(chains, 3);  // or nothing was tested
}

TEST(Merge, DoesNotDependOnSlots) {
  auto drops = test::random_drops(5000, 99, 2e6f);
  const auto expected = merged(drops);
  ASSERT_LT(expected.size(), 4300u);
  for (std::uint32_t k = 1; k <= 5; ++k) {
    for (std::size_t i = drops.size(); i > 1; --i)
      std::swap(drops[i - 1], drops[random::block(k, random::Purpose::drop_arrival, 1, static_cast<std::uint32_t>(i))[0] % i]);
    ASSERT_TRUE(same(merged(drops, uniforms, 2), expected));
  }
}

TEST(Merge, KeepsWaterExactlyAndMomentumToRounding) {
  const auto drops = test::random_drops(20000, 4, 3e5f);
  const auto out = merged(drops);
  std::int64_t water = 0, water_out = 0;
  double momentum = 0, momentum_out = 0, sum = 0;
  for (const Drop& d : drops) {
    if (!(d.life > 0)) continue;
    water += static_cast<std::int64_t>(d.mass);
    momentum += static_cast<double>(d.mass) * d.velocity[0];
    sum += d.mass;
  }
  for (const Drop& d : out) {
    water_out += static_cast<std::int64_t>(d.mass);
    momentum_out += static_cast<double>(d.mass) * d.velocity[0];
  }
  EXPECT_EQ(water, water_out);
  EXPECT_NEAR(momentum, momentum_out, 1e-6 * sum * 0.2);  // a few roundings of speeds up to 0.2
}

TEST(Trails, LieUnderTheTailAndTheDropKeepsTheRest) {
  const parallel::Executor executor(1);
  Image film(Format::r32f, 64, 32);
  const float mass = 1e6f, speed_y = -0.25f;
  DropArrays a = test::arrays_of({drop(0.5f, 0.5f, mass, 0, 0, speed_y)});
  const MassBalance balance = leave_trails(executor, a, uniforms, film);
  // 2 radius * thickness * way of water.
  const double radius = radius_of(mass), way = 0.25 * test::glass_height / 60, mass_units = 2 * radius * 2e-6 * way * 998.2 / mass_unit;
  EXPECT_NEAR(static_cast<double>(balance.to_film), mass_units, 1.5);
  EXPECT_EQ(a.mass()[0], mass - static_cast<float>(balance.to_film));
  EXPECT_EQ(film_water(film), balance.to_film);
  const int row = static_cast<int>((0.5 + radius / test::glass_height) * 32);
  EXPECT_EQ(film.row<float>(row)[32], static_cast<float>(balance.to_film));
}

TEST(Trails, RestingOrTinyDropsLeaveNothingAndNoneLosesItsLastQuantum) {
  const parallel::Executor executor(1);
  Image film(Format::r32f, 64, 32);
  DropArrays a = test::arrays_of({drop(0.5f, 0.5f, 1e6f, 0), drop(0.2f, 0.5f, 1, 1, 1, 1), drop(0.3f, 0.5f, 5, 2, 40, 40),
                                  drop(0.999f, 0.5f, 1e6f, 3, -1, 0), drop(0.5f, 0.5f, 1e6f, 4, 1, 1, 0)});
  const MassBalance balance = leave_trails(executor, a, uniforms, film);
  EXPECT_EQ(a.mass()[0], 1e6f);
  EXPECT_EQ(a.mass()[1], 1);
  EXPECT_EQ(a.mass()[2], 1);
  EXPECT_EQ(a.mass()[3], 1e6f);  // its tail lies beyond the edge
  EXPECT_EQ(balance.to_film, 4);
}

TEST(Film, OverflowAndDryingAreAccountedFor) {
  const parallel::Executor executor(2);
  Image film(Format::r32f, 64, 32);
  const float mass = 1e6f;
  DropArrays a = test::arrays_of({drop(0.5f, 0.5f, mass, 0, 0.25f, 0)});
  const int column = static_cast<int>((0.5 - radius_of(mass) / test::glass_width) * 64);
  film.row<float>(16)[column] = most_mass - 3;
  const MassBalance trail = leave_trails(executor, a, uniforms, film);
  EXPECT_EQ(trail.to_film, 3);
  EXPECT_GT(trail.removed, 10);
  EXPECT_EQ(static_cast<float>(trail.to_film + trail.removed), mass - a.mass()[0]);
  film.row<float>(3)[5] = 2;
  film.row<float>(3)[6] = 9;
  const MassBalance dried = dry_film(executor, uniforms, film);
  EXPECT_EQ(dried.evaporated, 2 + 4 + 4);
  EXPECT_EQ(dried.to_film, -10);
  EXPECT_EQ(film.row<float>(3)[5], 0);
  EXPECT_EQ(film.row<float>(3)[6], 5);
}

TEST(Film, DriesAtItsRateInTheLongRun) {
  const Settings s;
  const double area = 1.12 / (1024 * 592), rate = s.film_drying * area * 998.2 / mass_unit;
  for (const double fps : {30.0, 144.0}) {
    std::int64_t sum = 0;
    for (int n = 0; n < static_cast<int>(100 * fps); ++n) sum += film_loss(s, area, n, fps);
    EXPECT_NEAR(static_cast<double>(sum), 100 * rate, 1);
  }
}

}  // namespace
}  // namespace rainref::drops
