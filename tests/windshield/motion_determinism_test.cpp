// The determinism proof of these passes: every SIMD target, 1, 2, 3 and 8 threads, shuffled tiles, 1 to 33 drops and
// columns give the bits of one plain float after another; and how far they are from the double evaluation.
#include <gtest/gtest.h>

#include <bit>

#include "image/images.h"
#include "math/simd_target.h"
#include "windshield/motion/kernels.h"
#include "windshield/scalar.h"
#include "windshield/support.h"

namespace rainref::windshield {
namespace {

template <class N>
scalar::DropState<N> drop_of(const DropArrays& d, std::size_t i) {
  scalar::DropState<N> drop;
  drop.u = N(d.u[i]);
  drop.v = N(d.v[i]);
  drop.velocity_u = N(d.velocity_u[i]);
  drop.velocity_v = N(d.velocity_v[i]);
  drop.mass = N(d.mass[i]);
  drop.life = N(d.life[i]);
  return drop;
}
template <class N>
scalar::WipedDrop<N> wiped(const WipeDropsUniforms& u, bool corrected, const std::vector<Wiper>& w, const DropArrays& d, std::size_t i) {
  return corrected ? scalar::wipe_drop_corrected<N>(u, w.data(), drop_of<N>(d, i))
                   : scalar::WipedDrop<N>(scalar::wipe_drop_as_published<N>(u, w.data(), drop_of<N>(d, i)));
}
void same_bits(float a, float b) { ASSERT_EQ(std::bit_cast<std::uint32_t>(a), std::bit_cast<std::uint32_t>(b + 0.0f)) << a << " " << b; }

struct Step {
  std::vector<Wiper> wipers;
  WipeDropsUniforms uniforms;
};
Step step(bool corrected, int columns, int rows, double t = 0.3, double dt = 0.5) {
  const Glass glass = make_glass({{{1.9, 0.7, 1.0}, {1.9, -0.7, 1.1}, {1.2, 0.8, 1.4}}});  // sheared
  WiperSettings s = default_wipers(glass);
  Step out{wipers_between(s, corrected ? glass.plane() : glass.axes(), t, t + dt, corrected), {}};
  out.uniforms = wipe_drops_uniforms(glass, corrected, static_cast<int>(out.wipers.size()), {}, radius_scale, columns, rows);
  return out;
}
Image film_of(int columns, int rows) {
  return make_image(Format::r32f, columns, rows, [](int x, int y, int) { return static_cast<float>((31 * x + 17 * y) % 1000); });
}

void expect_plain_bits(bool corrected, std::size_t count, int columns, int rows, const parallel::Executor& executor) {
  const Step s = step(corrected, columns, rows);
  ASSERT_EQ(s.wipers.size(), corrected ? 4u : 2u);
  DropArrays drops = random_drops(count, static_cast<std::uint32_t>(count));
  const DropArrays before = drops;
  Image film = film_of(columns, rows);
  const std::uint64_t removed = wipe_drops(s.uniforms, corrected, s.wipers, drops.spans(), corrected ? &film : nullptr, executor);

  // The same, one at a time; then the film by record and bin.
  using F = scalar::Scalar<float>;
  std::vector<scalar::WipedDrop<F>> expected;
  for (std::size_t i = 0; i < count; ++i) expected.push_back(wiped<F>(s.uniforms, corrected, s.wipers, before, i));
  std::uint64_t expected_removed = 0;
  if (corrected) {
    std::vector<std::uint64_t> mass_units(s.wipers.size() * film_bins);
    const Image was = film_of(columns, rows);
    for (int y = 0; y < rows; ++y) {
      for (int x = 0; x < columns; ++x) {
        const auto swept = scalar::swept_texel<F>(s.uniforms, s.wipers.data(), x, y);
        const float held = was.row<float>(y)[x];
        same_bits(film.row<float>(y)[x], swept.wiper.v >= 0 ? 0.0f : held);
        if (swept.wiper.v >= 0)
          mass_units[static_cast<std::size_t>(swept.wiper.v) * film_bins + static_cast<std::size_t>(swept.bin.v)] +=
              static_cast<std::uint64_t>(held);
      }
    }
    for (std::size_t k = 0; k < mass_units.size(); ++k) {
      std::int64_t first = -1;  // ids ascend with slots here
      for (std::size_t i = 0; i < count && first < 0; ++i) {
        if (expected[i].wiper.v >= 0 && static_cast<std::size_t>(expected[i].wiper.v * film_bins + expected[i].bin.v) == k)
          first = static_cast<std::int64_t>(i);
      }
      if (first >= 0)
        expected[static_cast<std::size_t>(first)].mass =
            F(expected[static_cast<std::size_t>(first)].mass.v + static_cast<float>(mass_units[k]));
      else
        expected_removed += mass_units[k];
    }
    for (std::size_t i = 0; i < count; ++i) expected_removed += expected[i].wiper.v == -2 ? static_cast<std::uint64_t>(before.mass[i]) : 0;
  }
  ASSERT_EQ(removed, expected_removed);
  for (std::size_t i = 0; i < count; ++i) {
    same_bits(drops.u[i], expected[i].u.v);
    same_bits(drops.v[i], expected[i].v.v);
    same_bits(drops.velocity_u[i], expected[i].velocity_u.v);
    same_bits(drops.velocity_v[i], expected[i].velocity_v.v);
    same_bits(drops.mass[i], expected[i].mass.v);
    same_bits(drops.life[i], expected[i].life.v);
  }
}

TEST(MotionDeterminism, EveryTargetAndThreadCountGivesPlainBits) {
  for (const std::string& target : simd_targets()) {
    SCOPED_TRACE(target);
    select_simd_target(target);
    for (const int threads : {1, 2, 3, 8}) {
      parallel::Executor executor(threads);
      executor.shuffle_tiles(static_cast<std::uint64_t>(threads));
      for (const bool corrected : {false, true}) {
        for (int count = 1; count <= 33; ++count) expect_plain_bits(corrected, static_cast<std::size_t>(count), count, 5, executor);
        expect_plain_bits(corrected, 5000, 61, 70, executor);
      }
    }
  }
  select_simd_target("");
}

TEST(MotionDeterminism, TheFrameHasPlainBits) {
  VehicleSettings settings;
  settings.key_frames = "0 3 0.1; 4 12 0.9; 9 6 -0.6";
  const Vehicle car(settings);
  for (const std::string& target : simd_targets()) {
    SCOPED_TRACE(target);
    select_simd_target(target);
    for (const bool corrected : {false, true}) {
      for (double t = 0; t < 9; t += 0.7) {
        const WindshieldFrameUniforms u = windshield_frame_uniforms(default_glass(), car.at(t), {1, 2, -0.5}, 9.8, corrected);
        using F = scalar::Scalar<float>;
        const auto expected = corrected ? scalar::windshield_frame_corrected<F>(u) : scalar::windshield_frame_as_published<F>(u);
        const drops::GlassFrame out = windshield_frame(u, corrected);
        for (int k = 0; k < 2; ++k) {
          same_bits(out.gravity[k], expected.gravity[k].v);
          same_bits(out.wind[k], expected.wind[k].v);
          same_bits(out.acceleration[k], expected.acceleration[k].v);
        }
        for (int k = 0; k < 4; ++k) {
          same_bits(out.spin[k], expected.spin[k].v);
          same_bits(out.coriolis[k], expected.coriolis[k].v);
        }
      }
    }
  }
  select_simd_target("");
}

// Where both evaluations decide alike they differ by the rounding of a few operations on metres: 4 ULP of 1 in place, as
// much of 3 m/s over 0.8 m in velocity. They decide alike but for drops within 1e-6 m of an outline.
TEST(MotionDeterminism, FloatsAreNearTheDoubleReading) {
  for (const bool corrected : {false, true}) {
    const Step s = step(corrected, 0, 0);
    const DropArrays drops = random_drops(20000, 11);
    int different = 0, moved = 0;
    for (std::size_t i = 0; i < drops.size(); ++i) {
      const auto f = wiped<scalar::Scalar<float>>(s.uniforms, corrected, s.wipers, drops, i);
      const auto d = wiped<scalar::Scalar<double>>(s.uniforms, corrected, s.wipers, drops, i);
      const bool alike = corrected ? f.wiper.v == d.wiper.v
                                   : (f.mass.v == drops.mass[i]) == (d.mass.v == drops.mass[i]) && std::abs(f.mass.v - d.mass.v) < 0.03;
      if (!alike) {
        ++different;
        continue;
      }
      moved += f.u.v != drops.u[i];
      EXPECT_NEAR(f.u.v, d.u.v, 5e-7);
      EXPECT_NEAR(f.v.v, d.v.v, 5e-7);
      EXPECT_NEAR(f.velocity_u.v, d.velocity_u.v, 3e-6);
      EXPECT_NEAR(f.velocity_v.v, d.velocity_v.v, 3e-6);
    }
    EXPECT_GT(moved, 1000);
    EXPECT_LE(different, 5);
  }
}

}  // namespace
}  // namespace rainref::windshield
