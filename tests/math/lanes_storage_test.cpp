// Loads and stores of the lanes of every SIMD target against the scalar evaluation.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cstring>
#include <vector>

#include "math/every_target.h"
#include "math/lanes_kernels.h"

namespace rainref::test {
namespace {

using scalar::Scalar;
constexpr Rounding both[] = {Rounding::rne, Rounding::rtz};

/// Numbers that meet every branch of every store: signs of zero, subnormals, ties, both ends, overflow.
std::vector<float> numbers() {
  std::vector<float> x = {0.0f,           -0.0f,           0x1p-149f,  -0x1p-149f,     0x1p-126f,        0x1p-25f,
                          -0x1p-25f,      0x1.000002p-25f, 0x1.8p-24f, 0x1.ffcp-15f,   0x1.ffep-15f,     0x1p-14f,
                          0.1f,           -0.1f,           1.0f / 255, 0.5f / 255,     1.5f / 255,       0.5f,
                          127.5f / 255,   0.999f,          1.0f,       -1.0f,          1.0000001f,       2.0f,
                          1.00048828125f, 1.00146484375f,  3.0f,       65504.0f,       65519.0f,         65520.0f,
                          65536.0f,       -65520.0f,       1e6f,       0x1p100f,       0x1.fffffep127f,  -0x1.fffffep127f,
                          254.5f / 255,   1e-7f,           -1e-30f,    0x1.ffffffp-2f, -0x1.fffffep-26f, -0x1.000002p-25f,
                          -0x1.8p-25f,    -0x1p-24f};
  for (int i = 0; i < 984; ++i) x.push_back(static_cast<float>(i * 7919 % 1009) / 1000.0f - 0.002f);
  return x;
}

template <class T>
bool same_bits(const T& a, const T& b) {
  return std::memcmp(&a, &b, sizeof(T)) == 0;
}

template <class Storage>
void check_stores() {
  Storage mark;
  std::memset(&mark, 0x5a, sizeof mark);
  const std::vector<float> x = numbers();
  for_every_target([&] {
    const int size = lane_count();
    for (const Rounding rounding : both) {
      for (std::size_t first = 0; first + padded_count <= x.size(); first += 5) {
        for (int count = 1; count <= size; ++count) {
          std::array<Storage, padded_count + 2> out;
          out.fill(mark);
          store_by_lanes(out.data() + 1, x.data() + first, rounding, count);
          ASSERT_TRUE(same_bits(out[0], mark));
          for (int i = 0; i <= size; ++i) {
            Storage expected = mark;
            if (i < count) scalar::store(&expected, Scalar<float>(x[first + static_cast<std::size_t>(i)]), rounding);
            ASSERT_TRUE(same_bits(out[static_cast<std::size_t>(i) + 1], expected))
                << x[first + static_cast<std::size_t>(i)] << ", " << name(rounding) << ", " << i << " of " << count;
          }
        }
      }
    }
  });
}

TEST(LanesStore, Float) { check_stores<float>(); }
TEST(LanesStore, Half) { check_stores<Half>(); }
TEST(LanesStore, Unorm8) { check_stores<Unorm8>(); }

TEST(LanesStore, NoNegativeZeroLeavesAKernel) {
  const std::array<float, padded_count> zeros{-0.0f, -0.0f, -0.0f, -0.0f, -0.0f, -0.0f, -0.0f, -0.0f,
                                              -0.0f, -0.0f, -0.0f, -0.0f, -0.0f, -0.0f, -0.0f, -0.0f};
  for_every_target([&] {
    std::array<float, padded_count> f;
    std::array<Half, padded_count> h;
    store_by_lanes(f.data(), zeros.data(), Rounding::rne, lane_count());
    store_by_lanes(h.data(), zeros.data(), Rounding::rne, lane_count());
    for (int i = 0; i < lane_count(); ++i) {
      EXPECT_EQ(std::bit_cast<std::uint32_t>(f[static_cast<std::size_t>(i)]), 0u);
      EXPECT_EQ(h[static_cast<std::size_t>(i)].bits, 0u);
    }
  });
}

template <class Storage>
void check_loads(const std::vector<Storage>& stored) {
  for_every_target([&] {
    std::array<float, padded_count> out{};
    for (std::size_t first = 0; first + padded_count <= stored.size(); first += 3) {
      load_by_lanes(stored.data() + first, out.data());
      for (int i = 0; i < lane_count(); ++i) {
        const auto k = static_cast<std::size_t>(i);
        const float expected = Scalar<float>::load(stored.data() + first + k).v;
        ASSERT_TRUE(same_bits(out[k], expected)) << out[k] << ", expected " << expected;
      }
    }
  });
}

TEST(LanesLoad, FloatKeepsItsBits) { check_loads(numbers()); }
// Infinities too: a store that overflows leaves them.
TEST(LanesLoad, EveryHalfThatIsANumber) {
  std::vector<Half> codes;
  for (unsigned bits = 0; bits < 65536; ++bits) {
    if ((bits & 0x7fff) <= 0x7c00) codes.push_back({static_cast<std::uint16_t>(bits)});
  }
  check_loads(codes);
}
TEST(LanesLoad, EveryUnorm8) {
  std::vector<Unorm8> codes;
  for (unsigned code = 0; code < 256 + padded_count; ++code) codes.push_back({static_cast<std::uint8_t>(code)});
  check_loads(codes);
}

template <class Storage>
std::vector<Storage> stored_numbers() {
  std::vector<Storage> out;
  for (const float x : numbers()) {
    Storage s;
    scalar::store(&s, Scalar<float>(x), Rounding::rtz);
    out.push_back(s);
  }
  return out;
}

template <class Storage>
void check_load4() {
  const std::vector<Storage> texels = stored_numbers<Storage>();
  for_every_target([&] {
    std::array<float, 4 * padded_count> out{};
    for (std::size_t first = 0; first + 4 * padded_count <= texels.size(); first += 4) {
      load4_by_lanes(texels.data() + first, out.data());
      for (std::size_t i = 0; i < static_cast<std::size_t>(lane_count()); ++i) {
        for (std::size_t c = 0; c < 4; ++c) {
          ASSERT_TRUE(same_bits(out[c * padded_count + i], Scalar<float>::load(texels.data() + first + 4 * i + c).v)) << i << ' ' << c;
        }
      }
    }
  });
}
TEST(LanesLoad, FourChannelsOfFloat) { check_load4<float>(); }
TEST(LanesLoad, FourChannelsOfHalf) { check_load4<Half>(); }
TEST(LanesLoad, FourChannelsOfUnorm8) { check_load4<Unorm8>(); }

template <class Storage>
void check_store4() {
  const std::vector<float> x = numbers();
  for_every_target([&] {
    const auto size = static_cast<std::size_t>(lane_count());
    for (const Rounding rounding : both) {
      for (std::size_t first = 0; first + 4 * padded_count <= x.size(); first += 3) {
        std::array<Storage, 4 * padded_count> out{};
        store4_by_lanes(out.data(), x.data() + first, rounding);
        for (std::size_t i = 0; i < size; ++i) {
          for (std::size_t c = 0; c < 4; ++c) {
            Storage expected;
            scalar::store(&expected, Scalar<float>(x[first + c * padded_count + i]), rounding);
            ASSERT_TRUE(same_bits(out[4 * i + c], expected)) << x[first + c * padded_count + i] << ' ' << name(rounding);
          }
        }
      }
    }
  });
}
TEST(LanesStore, FourChannelsOfFloat) { check_store4<float>(); }
TEST(LanesStore, FourChannelsOfHalf) { check_store4<Half>(); }
TEST(LanesStore, FourChannelsOfUnorm8) { check_store4<Unorm8>(); }

}  // namespace
}  // namespace rainref::test
