// Lists matched by id, on a made-up pass: drops that move, dry up and swallow each other.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <tuple>
#include <utility>

#include "judge/judge.h"
#include "judge/keyed.h"
#include "judge/support.h"
#include "math/path_enumeration.h"
#include "rainref/error.h"

namespace rainref::judge {
namespace {

using namespace test;
using capture::Array;
using capture::KeyedRecord;

struct Bead {
  std::uint32_t id;
  float x, speed, mass;
  std::uint32_t is_large;
};

// ---- the made-up pass ----------------------------------------------------------------------------------------------
constexpr float dt = 0.1f, keep = 0.7f, least = 0.25f, large = 2.0f, reach = 0.5f;

template <class N>
struct Moved {
  N x, speed, mass;
  typename N::Mask lives, is_large;
};
template <class N>
Moved<N> moved(N x, N speed, N mass) {
  const N m = mass * N(keep) + N(0.01f);
  return {x + speed * N(dt), speed, m, m > N(least), m > N(large)};
}
/// Two neighbours: the second is swallowed where they come close.
template <class N>
std::array<Moved<N>, 2> moved_pair(const Bead& a, const Bead& b) {
  std::array<Moved<N>, 2> out{moved<N>(N(a.x), N(a.speed), N(a.mass)), moved<N>(N(b.x), N(b.speed), N(b.mass))};
  const auto touch = abs(out[1].x - out[0].x) < N(reach);
  out[0].mass = select(touch, out[0].mass + out[1].mass, out[0].mass);
  out[1].lives = out[1].lives & !touch;
  return out;
}

class Beads : public capture::KeyedModel {
 public:
  explicit Beads(std::vector<Bead> beads) : beads_(std::move(beads)) {}
  int groups() const override { return static_cast<int>(beads_.size() / 2); }
  const std::vector<capture::FieldRange>& ranges() const override {
    static const std::vector<capture::FieldRange> all{{"x", 0, 100}, {"speed", -9, 9}, {"mass", 0, 4}};
    return all;
  }
  void enclose(int group, std::vector<KeyedRecord>& out) const override {
    using enclosed::Enclosure;
    const auto pair = moved_pair<Enclosure>(first(group), second(group));
    for (int k = 0; k < 2; ++k) {
      const Moved<Enclosure>& m = pair[static_cast<std::size_t>(k)];
      out.push_back({k == 0 ? first(group).id : second(group).id, m.lives, {m.x, m.speed, m.mass}, {m.is_large ? 1u : 0u}});
    }
  }
  /// The list that a number gives; under a profile's variations for a Perturbed.
  template <class N>
  std::vector<Bead> stored() const {
    std::vector<Bead> out;
    for (int group = 0; group < groups(); ++group) {
      const auto pair = moved_pair<N>(first(group), second(group));
      for (int k = 0; k < 2; ++k) {
        const Moved<N>& m = pair[static_cast<std::size_t>(k)];
        if (m.lives) out.push_back({k == 0 ? first(group).id : second(group).id, m.x.v, m.speed.v, m.mass.v, m.is_large ? 1u : 0u});
      }
    }
    return out;
  }

 private:
  const Bead& first(int group) const { return beads_[2 * static_cast<std::size_t>(group)]; }
  const Bead& second(int group) const { return beads_[2 * static_cast<std::size_t>(group) + 1]; }
  std::vector<Bead> beads_;
};

Array array_of(const std::vector<Bead>& beads) {
  using namespace scene;
  Array a;
  a.is_records = true;
  a.record = record<Bead>({member<&Bead::id>("1", "Key."), member<&Bead::x>("texel", "Place."), member<&Bead::speed>("texel/s", "Speed."),
                           member<&Bead::mass>("1", "Mass."), member<&Bead::is_large>("1", "Event.")});
  a.width = static_cast<int>(beads.size());
  a.height = 1;
  a.levels.emplace_back(beads.size() * sizeof(Bead));
  if (!beads.empty()) std::memcpy(a.levels[0].edit().data(), beads.data(), a.levels[0].size());
  return a;
}

std::vector<Bead> some_beads(std::uint32_t pairs) {
  Words words(9);
  std::vector<Bead> beads;
  const auto uniform = [&](float low, float high) { return low + (high - low) * static_cast<float>(words() >> 40) * 0x1p-24f; };
  for (std::uint32_t k = 0; k < pairs; ++k) {
    const float x = uniform(0, 100);
    beads.push_back({2 * k + 7, x, uniform(-9, 9), uniform(0.1f, 4), 0});
    beads.push_back({2 * k + 8, x + uniform(-2, 2), uniform(-9, 9), uniform(0.1f, 4), 0});
  }
  return beads;
}

class Keyed : public testing::Test {
 protected:
  Keyed() { set(some_beads(200)); }
  void set(std::vector<Bead> beads) {
    model.emplace(std::move(beads));
    port = model->stored<scalar::Scalar<float>>();
    expected.name = "beads";
    expected.judge = capture::Judge::keyed;
    expected.range = {0, 100};
    expected.array = array_of(port);
  }
  KeyedJudgement judged(const char* name = "vulkan", bool with_model = true) const {
    return judge_keyed(expected, array_of(port), with_model ? &*model : nullptr, profile(name));
  }
  Bead& with_id(std::uint32_t id) {
    return *std::find_if(port.begin(), port.end(), [&](const Bead& b) { return b.id == id; });
  }
  void expect(const KeyedJudgement& j, const std::string& events) const {
    EXPECT_EQ(j.events.text(), events);
    EXPECT_EQ(j.failing > 0, !events.empty());
    EXPECT_EQ(j.output.failing > 0, !events.empty());
  }

  std::optional<Beads> model;
  std::vector<Bead> port;
  capture::CaseOutput expected;
};

TEST_F(Keyed, TheReferencePassesInAnyOrder) {
  EXPECT_GT(port.size(), 200u);
  EXPECT_LT(port.size(), 380u);  // some dried up, some were swallowed
  for (const char* name : {"ieee", "vulkan"}) {
    std::sort(port.begin(), port.end(), [](const Bead& a, const Bead& b) { return a.x < b.x; });
    expect(judged(name), "");
    std::reverse(port.begin(), port.end());
    expect(judged(name), "");
    expect(judged(name, false), "");
  }
  EXPECT_EQ(judged().groups, 200);
  EXPECT_EQ(judged().output.vacuous, 0);
}

TEST_F(Keyed, ConformingDevicesPass) {
  for (const std::string& name : inexact_profiles()) {
    const perturbed::Variations variations = perturbed::variations_of(profile(name));
    int differing = 0;
    for (int seed = 0; seed < 40; ++seed) {
      perturbed::Behaviour b;
      b.variations = &variations;
      b.random = Words(static_cast<std::uint64_t>(seed))();
      const perturbed::Scope scope(b);
      port = model->stored<perturbed::Perturbed>();
      const KeyedJudgement j = judged(name.c_str());
      expect(j, "");
      differing += j.output.differing > 0;
    }
    EXPECT_GT(differing, 30) << name;
  }
}

TEST_F(Keyed, EventsAreNamed) {
  const Bead one = port[5], other = port[8];
  port.erase(port.begin() + 8);
  port.push_back(one);
  port.push_back({99999, 1, 1, 1, 0});
  with_id(port[20].id).is_large ^= 1;
  const std::uint32_t flagged = port[20].id;
  const KeyedJudgement j = judged();
  expect(j, "missing: " + std::to_string(other.id) + "; extra: 99999; duplicate: " + std::to_string(one.id) +
                "; outside: " + std::to_string(flagged));
  EXPECT_EQ(j.failing, 4);
  ASSERT_EQ(j.output.worst.size(), 1u);
  EXPECT_EQ(j.output.worst[0].x, static_cast<int>(flagged));
  EXPECT_EQ(j.output.worst[0].channel, 3);  // x, speed, mass, is_large
}

// Fields, the id left out, of every record in either list; of one that should not be there, or should be, all are outside.
TEST_F(Keyed, FieldsAreCounted) {
  const auto records = static_cast<std::int64_t>(port.size());
  constexpr std::int64_t fields = 4;
  OutputJudgement o = judged().output;
  EXPECT_EQ(o.counted, Counted::fields);
  EXPECT_EQ(std::tuple(o.elements, o.failing, o.differing), std::tuple(fields * records, 0, 0));
  EXPECT_EQ(o.width, records);
  port[3].speed += 1;
  o = judged().output;
  EXPECT_EQ(std::tuple(o.elements, o.failing, o.differing), std::tuple(fields * records, 1, 1));
  port.pop_back();
  o = judged().output;
  EXPECT_EQ(std::tuple(o.elements, o.failing, o.differing), std::tuple(fields * records, 1 + fields, 1 + fields));
  port.push_back({99999, 1, 1, 1, 0});
  port.push_back(port[0]);
  o = judged().output;
  EXPECT_EQ(std::tuple(o.elements, o.failing, o.differing), std::tuple(fields * (records + 2), 1 + 3 * fields, 1 + 3 * fields));
  port.clear();
  o = judged().output;
  EXPECT_EQ(std::tuple(o.elements, o.failing), std::tuple(fields * records, fields * records));
}

// x and mass are computed, speed and the flag are handed on.
TEST_F(Keyed, WidthsAreInCodes) {
  const OutputJudgement exact = judged("ieee").output, open = judged().output;
  EXPECT_EQ(std::tuple(exact.median_width, exact.p99_width), std::tuple(0, 0));
  EXPECT_GT(open.p99_width, 0);
  EXPECT_LT(open.p99_width, 1e4);  // sums that nearly cancel are wide in codes of what is left
}

/// A speed that is bounded within this only.
class Uncertain : public Beads {
 public:
  Uncertain(std::vector<Bead> beads, float extent) : Beads(std::move(beads)), extent_(extent) {}
  void enclose(int group, std::vector<KeyedRecord>& out) const override {
    const std::size_t first = out.size();
    Beads::enclose(group, out);
    for (std::size_t k = first; k < out.size(); ++k)
      out[k].floats[1] = enclosed::Enclosure(out[k].floats[1].lo - extent_ / 2, out[k].floats[1].hi + extent_ / 2);
  }

 private:
  float extent_;
};
// The speed's own range, from -9 to 9, counts, not that of the list, whose places reach 100.
TEST_F(Keyed, ABoundIsVacuousByItsFieldsOwnRange) {
  const auto counts = [&](float extent) {
    const Uncertain wide(some_beads(200), extent);
    const OutputJudgement o = judge_keyed(expected, array_of(port), &wide, profile("vulkan")).output;
    EXPECT_EQ(o.failing, 0);
    return std::pair(o.vacuous, o.loose);
  };
  const auto records = static_cast<std::int64_t>(port.size());
  EXPECT_EQ(counts(18.0f / 256 * 0.99f), std::pair(std::int64_t{0}, std::int64_t{0}));
  EXPECT_EQ(counts(18.0f / 256 * 1.01f), std::pair(std::int64_t{0}, records));
  EXPECT_EQ(counts(18.0f / 16 * 0.99f), std::pair(std::int64_t{0}, records));
  EXPECT_EQ(counts(18.0f / 16 * 1.01f), std::pair(records, records));
}
// The figures of each field, in its unit: of the speed what it was widened by, of the flag nothing.
TEST_F(Keyed, EachFieldHasFiguresOfItsOwn) {
  constexpr float extent = 18.0f / 16 * 1.01f;
  const Uncertain wide(some_beads(200), extent);
  with_id(port[3].id).is_large ^= 1;
  with_id(port[5].id).speed += 2 * extent;
  const OutputJudgement o = judge_keyed(expected, array_of(port), &wide, profile("vulkan")).output;
  const auto records = static_cast<std::int64_t>(port.size());
  ASSERT_EQ(o.quantities.size(), 4u);
  const QuantityJudgement &x = o.quantities[0], &speed = o.quantities[1], &mass = o.quantities[2], &flag = o.quantities[3];
  EXPECT_EQ(std::tuple(x.name, x.unit, x.extent), std::tuple("x", "texel", 100));
  EXPECT_EQ(std::tuple(speed.name, speed.unit, speed.extent), std::tuple("speed", "texel/s", 18));
  EXPECT_EQ(std::tuple(mass.name, mass.unit, mass.extent), std::tuple("mass", "1", 4));
  EXPECT_EQ(std::tuple(flag.name, flag.unit), std::tuple("is_large", "1"));
  for (const QuantityJudgement& q : o.quantities) EXPECT_EQ(q.elements, records) << q.name;
  EXPECT_EQ(std::tuple(x.failing, speed.failing, mass.failing, flag.failing), std::tuple(0, 1, 0, 1));
  EXPECT_EQ(std::tuple(x.vacuous, speed.vacuous, mass.vacuous, flag.vacuous), std::tuple(0, records, 0, 0));
  EXPECT_EQ(std::tuple(x.loose, speed.loose, mass.loose, flag.loose), std::tuple(0, records, 0, 0));
  // Both ends of the speed are rounded to float, to 2^-21 below 16.
  EXPECT_NEAR(speed.median_width, extent, 0x1p-20);
  EXPECT_NEAR(speed.p99_width, extent, 0x1p-20);
  EXPECT_NEAR(speed.farthest, 1.5 * extent, 0x1p-20);
  EXPECT_EQ(std::tuple(flag.median_width, flag.p99_width, flag.farthest), std::tuple(0, 0, 1));
  // x + 0.1 speed: rounded twice, and fused, near 100.
  EXPECT_GT(x.p99_width, 0);
  EXPECT_LT(x.p99_width, 4 * 0x1p-17);
}

// A record that is in one list alone is outside in every field.
TEST_F(Keyed, ALostRecordCountsInEveryField) {
  port.pop_back();
  const OutputJudgement o = judged().output;
  for (const QuantityJudgement& q : o.quantities) EXPECT_EQ(q.failing, 1) << q.name;
}

/// Nobody follows its decisions.
class Hopeless : public Beads {
 public:
  using Beads::Beads;
  void enclose(int group, std::vector<KeyedRecord>& out) const override {
    Beads::enclose(group, out);
    enclosed::give_up();
  }
};
TEST_F(Keyed, NotANumberFailsEvenWhereAnythingElsePasses) {
  const Hopeless hopeless(some_beads(200));
  const auto judge = [&] { return judge_keyed(expected, array_of(port), &hopeless, profile("vulkan")); };
  port[4].speed = 77;
  expect(judge(), "");
  EXPECT_EQ(judge().output.vacuous, judge().output.elements);
  port[4].speed = std::numeric_limits<float>::quiet_NaN();
  expect(judge(), "outside: " + std::to_string(port[4].id));
}
TEST_F(Keyed, AFieldWithoutARangeIsADefect) {
  EXPECT_EQ(extents_of(expected.array.record, *model), (std::vector<double>{100, 18, 4}));
  expected.array.record.members[1].name = "place";
  EXPECT_THROW(judged(), Error);
}

TEST_F(Keyed, NegativeZeroIsAnotherZeroUnderIeeeAlone) {
  std::vector<Bead> beads = some_beads(3);
  beads[0].speed = 0;
  beads[0].mass = 4;
  set(beads);
  with_id(beads[0].id).speed = -0.0f;
  expect(judged(), "");
  EXPECT_EQ(judged().output.differing, 1);
  expect(judged("ieee"), "outside: " + std::to_string(beads[0].id));
  expect(judged("vulkan", false), "outside: " + std::to_string(beads[0].id));
  EXPECT_TRUE(judged("ieee").output.worst[0].got_is_negative_zero);
}

TEST_F(Keyed, AFloatIsHeldToItsEnvelope) {
  Bead& b = port[3];
  const float x = b.x;
  b.x = x * (1 + 0x1p-18f);
  expect(judged(), "outside: " + std::to_string(b.id));
  b.x = std::numeric_limits<float>::quiet_NaN();
  expect(judged(), "outside: " + std::to_string(b.id));
  EXPECT_TRUE(judged().output.worst[0].not_a_number);
  b.x = x;
  b.speed = std::bit_cast<float>(std::bit_cast<std::uint32_t>(b.speed) + 1);  // moved, not computed: one value
  expect(judged(), "outside: " + std::to_string(b.id));
}

// Some mass near (1/4 - 0.01) / 0.7 comes out beside the threshold by less than what may be rounded: both lives are
// right.
TEST_F(Keyed, AnOpenDecisionAllowsBothAnswers) {
  float mass = 0.342857f;
  for (int k = 0; k < 100; ++k, mass = std::nextafterf(mass, 1)) {
    set({{1, 0, 1, mass, 0}, {2, 50, 1, 3, 0}});
    if (judged().ambiguous > 0) break;
  }
  KeyedJudgement j = judged();
  EXPECT_EQ(j.ambiguous, 1);
  expect(j, "");
  const bool lives = port.size() == 2;
  if (lives)
    port.erase(port.begin());
  else
    port.insert(port.begin(), {1, 0.1f, 1, 0.25f + 0x1p-25f, 0});
  j = judged();
  expect(j, "");
  EXPECT_EQ(j.other_branch, 1);
  expect(judged("ieee"), lives ? "missing: 1" : "extra: 1");
}

// Whether the two touch is open: swallowed and heavier, or alive and as before; not half of each.
TEST_F(Keyed, ACaptureIsJudgedWhole) {
  std::vector<Bead> beads{{1, 1, 1, 1, 0}, {2, 1.5f, 1, 1, 0}};
  set(beads);
  EXPECT_EQ(judged().ambiguous, 1);
  const float alone = 1 * keep + 0.01f, together = alone + alone, x = 1 + 1 * dt, far = 1.5f + 1 * dt;
  port = {{1, x, 1, together, 0}};
  expect(judged(), "");
  port = {{1, x, 1, alone, 0}, {2, far, 1, alone, 0}};
  expect(judged(), "");
  port = {{1, x, 1, alone, 0}};  // lost
  EXPECT_EQ(judged().failing, 1);
  port = {{1, x, 1, together, 0}, {2, far, 1, alone, 0}};  // doubled
  EXPECT_EQ(judged().failing, 1);
}

TEST_F(Keyed, WithoutAModelFieldsAreBits) {
  port[2].mass = std::bit_cast<float>(std::bit_cast<std::uint32_t>(port[2].mass) + 1);
  const KeyedJudgement j = judged("vulkan", false);
  expect(j, "outside: " + std::to_string(port[2].id));
  EXPECT_EQ(j.output.worst[0].field, "mass");
}

TEST_F(Keyed, JudgeCaseTakesIt) {
  capture::PassCase c;
  c.effect = "made_up";
  c.pass = "beads";
  c.outputs = {expected};
  const parallel::Executor executor(1);
  const JudgeOptions options{&profile("vulkan"), nullptr, &executor, std::nullopt};
  const CaseJudgement passed = judge_case(c, nullptr, {array_of(port)}, options).judgements[0];
  EXPECT_EQ(passed.status, Status::pass);
  EXPECT_EQ(passed.outputs.size(), 1u);
  const std::uint32_t id = port[0].id;
  port.erase(port.begin());
  const CaseJudgement failed = judge_case(c, nullptr, {array_of(port)}, options).judgements[0];
  EXPECT_EQ(failed.status, Status::fail);
  EXPECT_EQ(failed.reason, "beads, missing: " + std::to_string(id));
}

TEST_F(Keyed, RecordsWithoutAKeyAndDoubledIdsOfThePackAreRefused) {
  expected.array.record.members[0].name = "key";
  EXPECT_THROW(judged(), Error);
  expected.array = array_of({port[0], port[0]});
  EXPECT_THROW(judged(), Error);
}

}  // namespace
}  // namespace rainref::judge
