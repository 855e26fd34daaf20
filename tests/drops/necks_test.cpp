// Which drops get a neck, which one, and for how long.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "drops/motion/necks.h"
#include "support.h"

namespace rainref::drops {
namespace {

using test::drop;
constexpr double dt = 1.0 / 60;

struct Glass {
  Settings settings;
  Merger merger;
  Necks necks;
  parallel::Executor executor;

  float wider = 1;  ///< than drops are

  explicit Glass(double neck_time = 2, int threads = 1) : executor(threads) { settings.neck_time = neck_time; }
  MergeUniforms merging() const {
    MergeUniforms u = merge_uniforms(settings, test::frame, dt, 64, 32, 0);
    u.radius *= wider;
    return u;
  }
  NecksUniforms receding() const {
    NecksUniforms u = necks_uniforms(settings, test::frame, dt);
    u.radius *= wider;
    return u;
  }
  void find(DropArrays& drops) { merger.necks(executor, drops, merging(), receding(), necks); }
  /// The step that both passes make.
  void step(DropArrays& drops) {
    find(drops);
    merger.merge(executor, drops, merging());
  }
  float radius(float mass) const { return scalar::neck_radius(receding(), test::F(mass)).v; }
};

TEST(Necks, OfTwoThatTouchTheLargerGetsTheSmallerOnesPlace) {
  Glass glass;
  const float small = 4000, large = 12000, apart = 0.9f * (glass.radius(small) + glass.radius(large));
  DropArrays drops = test::arrays_of({drop(0.5f, 0.5f, small, 0), drop(0.5f + apart / 1.4f, 0.5f, large, 1)});
  glass.step(drops);
  ASSERT_EQ(glass.necks.list().size(), 1u);
  const Neck n = glass.necks.list()[0];
  EXPECT_EQ(n.id, 1u);
  EXPECT_EQ(n.left, 1);
  EXPECT_EQ(n.share, 0.25f);
  EXPECT_NEAR(n.offset[0], -apart / glass.radius(small + large), 2e-4);  // places are known to 2^-25 of the glass
  EXPECT_EQ(n.offset[1], 0);
  EXPECT_EQ(drops.live(), 1);
  // The radii in the record are those of both drops before.
  const auto r = scalar::footprints(test::F(n.share), test::F(n.left));
  EXPECT_NEAR(r.larger.v, glass.radius(large) / glass.radius(small + large), 1e-6);
  EXPECT_NEAR(r.smaller.v, glass.radius(small) / glass.radius(small + large), 1e-6);
}

TEST(Necks, RecedeAtTheirRateAndEnd) {
  Glass glass(0.5);
  const float mass = 5000, apart = 1.9f * glass.radius(mass);
  DropArrays drops = test::arrays_of({drop(0.5f, 0.5f, mass, 0), drop(0.5f, 0.5f + apart / 0.8f, mass, 1)});
  glass.step(drops);
  int steps = 0;
  for (; !glass.necks.list().empty(); ++steps) {
    // A rounding in each step.
    EXPECT_NEAR(glass.necks.list()[0].left, std::exp(-steps * dt / 0.5), 1e-7 * (steps + 1));
    glass.step(drops);
    ASSERT_LT(steps, 200);
  }
  EXPECT_EQ(steps, static_cast<int>(std::ceil(std::log(64.0) * 0.5 / dt)));
}

TEST(Necks, ADropThatSlidesByItsOwnRadiusHasNone) {
  Glass glass(1000);
  const float mass = 5000, apart = 1.9f * glass.radius(mass), steps = 10;
  const float speed = glass.radius(2 * mass) / (steps * static_cast<float>(dt));
  DropArrays drops = test::arrays_of({drop(0.5f, 0.5f, mass, 0), drop(0.5f, 0.5f + apart / 0.8f, mass, 1)});
  glass.step(drops);
  drops.velocity_v()[0] = -speed / 0.8f;
  for (int k = 0; k < 5; ++k) glass.find(drops);
  ASSERT_EQ(glass.necks.list().size(), 1u);
  EXPECT_NEAR(glass.necks.list()[0].left, 0.5, 1e-3);
  for (int k = 0; k < 5; ++k) glass.find(drops);
  EXPECT_TRUE(glass.necks.list().empty());
}

TEST(Necks, OneThatTheLargerDropCoversGivesNone) {
  Glass glass;
  const float small = 100, large = 100000, covered = 0.95f * (glass.radius(large) - glass.radius(small));
  DropArrays drops = test::arrays_of({drop(0.5f, 0.5f, large, 0), drop(0.5f + covered / 1.4f, 0.5f, small, 1)});
  glass.step(drops);
  EXPECT_TRUE(glass.necks.list().empty());
  EXPECT_EQ(drops.live(), 1);
}

TEST(Necks, ALargerLobeIsNotGivenUpForASmallerOne) {
  Glass glass(1000);
  const float mass = 5000, r = glass.radius(mass), apart = 1.9f * r;
  DropArrays drops(8);
  const std::vector<Drop> two{drop(0.5f, 0.5f, mass, 0), drop(0.5f, 0.5f + apart / 0.8f, mass, 1)};
  drops.place(two);
  glass.step(drops);
  const auto add = [&](float added, std::uint32_t id) {
    const float beside = 0.95f * (glass.radius(drops.mass()[0]) + glass.radius(added)) / 1.4f;
    const std::vector<Drop> one{drop(drops.u()[0] + beside, drops.v()[0], added, id)};
    drops.place(one);
    glass.step(drops);
  };
  add(300, 2);
  ASSERT_EQ(glass.necks.list().size(), 1u);
  EXPECT_EQ(glass.necks.list()[0].share, 0.5f);
  EXPECT_EQ(drops.live(), 1);
  // As the old one recedes, a new one of the same share takes its place.
  add(drops.mass()[0], 3);
  ASSERT_EQ(glass.necks.list().size(), 1u);
  EXPECT_EQ(glass.necks.list()[0].share, 0.5f);
  EXPECT_GT(glass.necks.list()[0].offset[0], 1.4f);
  EXPECT_EQ(glass.necks.list()[0].left, 1);
}

TEST(Necks, EndWithTheirDropAndStayWithItsId) {
  Glass glass(1000);
  const float mass = 5000, apart = 1.9f * glass.radius(mass);
  DropArrays drops(4);
  drops.place(std::vector<Drop>{drop(0.5f, 0.5f, mass, 0), drop(0.5f, 0.5f + apart / 0.8f, mass, 1)});
  glass.step(drops);
  ASSERT_EQ(glass.necks.list().size(), 1u);
  // Another drop in its slot.
  drops.set(0, drop(0.2f, 0.2f, mass, 7));
  glass.step(drops);
  EXPECT_TRUE(glass.necks.list().empty());
}

// The rule as it is said, without grid.
std::map<std::uint32_t, Neck> by_brute_force(const std::vector<Drop>& all, const NecksUniforms& u) {
  using test::F;
  std::vector<Drop> drops = all;
  std::erase_if(drops, [](const Drop& d) { return !(d.life > 0); });
  const auto larger = [](const Drop& a, const Drop& b) { return a.mass > b.mass || (a.mass == b.mass && a.id < b.id); };
  std::map<std::uint32_t, const Drop*> points;
  for (const Drop& d : drops) {
    const Drop*& best = points[d.id];
    for (const Drop& o : drops)
      if (larger(o, d) && (!best || larger(o, *best)) && scalar::overlap(u, test::state_of<F>(d), test::state_of<F>(o))) best = &o;
  }
  const auto to = [&](const Drop& d) { return points[d.id]; };
  std::map<std::uint32_t, Neck> out;
  for (const Drop& d : drops) {
    if (to(d)) continue;
    const Drop* taken = nullptr;
    for (const Drop& o : drops)
      if (to(o) == &d && (!taken || larger(o, *taken))) taken = &o;
    if (!taken) continue;
    const auto n = scalar::joined(u, test::state_of<F>(d), test::state_of<F>(*taken));
    if (scalar::stands_out(n)) out[d.id] = {{n.offset_x.v + 0.0f, n.offset_y.v + 0.0f}, n.share.v, n.left.v, d.id, 0, 0, 0};
  }
  return out;
}

TEST(Necks, AreThoseOfTheRuleWhateverTheSlotsAndThreads) {
  for (std::uint32_t seed = 0; seed < 4; ++seed) {
    std::vector<Drop> list = test::random_drops(700, seed, seed % 2 ? 3e5f : 3e6f);
    Glass first;
    first.wider = 6;
    const std::map<std::uint32_t, Neck> expected = by_brute_force(list, first.receding());
    EXPECT_GT(expected.size(), 10u);
    for (const int threads : {1, 2, 3, 8}) {
      for (std::size_t i = list.size(); i > 1; --i)
        std::swap(
            list[i - 1],
            list[random::block(static_cast<std::uint32_t>(threads), random::Purpose::drop_arrival, 1, static_cast<std::uint32_t>(i))[0] %
                 i]);
      Glass glass(2, threads);
      glass.wider = 6;
      DropArrays drops = test::arrays_of(list);
      glass.step(drops);
      ASSERT_EQ(glass.necks.list().size(), expected.size());
      std::size_t i = 0;
      for (const auto& [id, neck] : expected) {
        const Neck& found = glass.necks.list()[i++];
        ASSERT_EQ(std::memcmp(&found, &neck, sizeof neck), 0) << id;
        EXPECT_EQ(std::count_if(list.begin(), list.end(), [&](const Drop& d) { return d.id == id && d.life > 0; }), 1);
      }
    }
  }
}

// What is found for the necks serves merge: the same drops as without.
TEST(Necks, ChangeNothingOfTheDrops) {
  const std::vector<Drop> list = test::random_drops(3000, 9, 2e6f);
  DropArrays with = test::arrays_of(list), without = test::arrays_of(list);
  Glass glass;
  for (int k = 0; k < 3; ++k) {
    glass.step(with);
    Merger other;
    other.merge(glass.executor, without, glass.merging());
    for (std::int64_t i = 0; i < with.extent(); ++i) {
      const Drop a = with.get(i), b = without.get(i);
      ASSERT_EQ(std::memcmp(&a, &b, sizeof a), 0) << i;
    }
  }
}

}  // namespace
}  // namespace rainref::drops
