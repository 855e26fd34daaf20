// The lanes of every SIMD target against the scalar evaluation: equal bits for finite inputs, the sign of zero included.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <vector>

#include "math/every_target.h"
#include "math/lanes_kernels.h"

namespace rainref::test {
namespace {

std::uint32_t bits_of(float x) { return std::bit_cast<std::uint32_t>(x); }
float moved(float x, int ulps) { return std::bit_cast<float>(bits_of(x) + static_cast<std::uint32_t>(ulps)); }
std::uint32_t hashed(std::uint32_t x) {
  x = (x ^ (x >> 16)) * 0x7feb352du;
  x = (x ^ (x >> 15)) * 0x846ca68bu;
  return x ^ (x >> 16);
}

std::vector<float> tricky_values() {
  std::vector<float> values = {0.0f,           0x1p-149f,      0x1.8p-148f,    0x1p-127f, 0x1.fffffcp-127f,
                               0x1p-126f,      0x1p-75f,       0x1p-64f,       1e-20f,    0x1p-25f,
                               0x1p-24f,       0x1p-23f,       0.1f,           0.25f,     1.0f / 3,
                               0.4999999f,     0.5f,           2.5f,           3.5f,      0x1.921fb6p1f,
                               100.0f,         127.5f,         255.0f,         65504.0f,  65520.0f,
                               0x1p22f,        0x1p22f + 0.5f, 0x1p23f - 0.5f, 0x1p23f,   0x1p23f + 1,
                               0x1p24f,        0x1p31f,        0x1p32f,        0x1p52f,   0x1p63f,
                               0x1p64f,        1e20f,          0x1p100f,       0x1p126f,  0x1p127f,
                               0x1.fffffep127f};
  for (int n = 1; n <= 16; ++n) {  // whole numbers and their neighbours
    for (const int ulps : {-1, 0, 1}) values.push_back(moved(static_cast<float>(n), ulps));
  }
  const std::size_t positive = values.size();
  for (std::size_t i = 0; i < positive; ++i) values.push_back(-values[i]);
  return values;
}

float in_domain(Domain domain, float x) {
  if (domain == Domain::any || domain == Domain::moved) return x;
  const float limit = domain == Domain::index ? 16.0f : 0x1p20f;
  if (domain == Domain::index) x = std::fabs(x);
  return std::fabs(x) < limit ? x : std::fmod(x, limit);
}

struct Inputs {
  std::vector<float> a, b, c;
  void add(Domain domain, float x, float y, float z) {
    if (domain == Domain::moved) y = std::isfinite(y) ? y : x;
    a.push_back(in_domain(domain, x));
    b.push_back(in_domain(domain, y));
    c.push_back(in_domain(domain, z));
  }
};

Inputs inputs_for(Domain domain) {
  Inputs in;
  const std::vector<float> values = tricky_values();
  std::uint32_t random = 1;
  const auto next = [&](bool wide) {
    random = hashed(random + 0x9e3779b9u);
    const float x = std::bit_cast<float>(wide ? random : (random & 0x83ffffffu) + 0x3c000000u);  // all, or 2^-7 to 2
    return std::isfinite(x) ? x : 1.0f;
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (domain == Domain::moved) {
      for (int ulps = -2; ulps <= 2; ++ulps) {
        in.add(domain, values[i], moved(values[i], ulps), 0);
        in.add(domain, values[i], -moved(values[i], ulps), 0);
      }
      continue;
    }
    for (std::size_t j = 0; j < values.size(); ++j) in.add(domain, values[i], values[j], values[(i * 31 + j * 17) % values.size()]);
  }
  for (int i = 0; i < 4000; ++i) {
    const float x = next(i % 2 == 0), y = domain == Domain::moved ? moved(x, i % 5 - 2) : next(i % 2 == 0), z = next(i % 2 == 0);
    in.add(domain, x, y, z);
  }
  while (in.a.size() % padded_count != 0) in.add(domain, 1, 1, 1);
  return in;
}

TEST(Lanes, EveryOperationHasTheBitsOfTheScalarEvaluation) {
  std::array<Inputs, 4> inputs;
  for (const Domain d : {Domain::any, Domain::small, Domain::index, Domain::moved}) inputs[static_cast<std::size_t>(d)] = inputs_for(d);
  for (const OperationInfo& op : operations) {
    const Inputs& in = inputs[static_cast<std::size_t>(op.domain)];
    std::vector<float> expected(in.a.size()), got(in.a.size());
    for (std::size_t i = 0; i < in.a.size(); ++i) expected[i] = apply_by_plain(op.operation, in.a[i], in.b[i], in.c[i]);
    for_every_target([&] {
      apply_by_lanes(op.operation, in.a.data(), in.b.data(), in.c.data(), got.data(), in.a.size());
      int different = 0;
      for (std::size_t i = 0; i < in.a.size() && different < 3; ++i) {
        // Finite inputs may still overflow and then cancel; which NaN comes out is the processor's choice.
        if (std::isnan(expected[i]) && std::isnan(got[i])) continue;
        if (bits_of(expected[i]) == bits_of(got[i])) continue;
        ++different;
        ADD_FAILURE() << op.name << '(' << std::hexfloat << in.a[i] << ", " << in.b[i] << ", " << in.c[i] << ") = " << got[i] << ", plain "
                      << expected[i];
      }
    });
  }
}

// A lane's result must not hang on its place in the vector or on its neighbours.
TEST(Lanes, AnElementDoesNotDependOnItsNeighbours) {
  Inputs in = inputs_for(Domain::any);
  const std::size_t count = in.a.size();
  std::vector<float> straight(count), turned(count), back(count);
  const auto turn = [&](std::vector<float> v) {
    std::rotate(v.begin(), v.begin() + 5, v.end());
    return v;
  };
  const std::vector<float> a = turn(in.a), b = turn(in.b), c = turn(in.c);
  for (const OperationInfo& op : operations) {
    if (op.domain != Domain::any) continue;
    for_every_target([&] {
      apply_by_lanes(op.operation, in.a.data(), in.b.data(), in.c.data(), straight.data(), count);
      apply_by_lanes(op.operation, a.data(), b.data(), c.data(), turned.data(), count);
      int different = 0;
      for (std::size_t i = 0; i < count; ++i) {
        const float x = straight[(i + 5) % count];
        different += bits_of(x) != bits_of(turned[i]) && !(std::isnan(x) && std::isnan(turned[i]));
      }
      EXPECT_EQ(different, 0) << op.name;
    });
  }
}

TEST(Lanes, IndexCountsFromTheFirst) {
  for_every_target([&] {
    std::array<float, padded_count> out{};
    for (const int first : {0, 1, 7, 1000, -5, (1 << 24) - 16}) {
      index_by_lanes(first, out.data());
      for (int i = 0; i < lane_count(); ++i) ASSERT_EQ(out[static_cast<std::size_t>(i)], static_cast<float>(first + i));
    }
  });
}

TEST(Lanes, AnyIsTrueWhenOneLaneIs) {
  for_every_target([&] {
    std::array<float, padded_count> a, b;
    a.fill(1);
    b.fill(1);
    EXPECT_FALSE(any_less_by_lanes(a.data(), b.data()));
    for (int i = 0; i < lane_count(); ++i) {
      b.fill(1);
      b[static_cast<std::size_t>(i)] = 2;
      EXPECT_TRUE(any_less_by_lanes(a.data(), b.data())) << i;
    }
  });
}

}  // namespace
}  // namespace rainref::test
