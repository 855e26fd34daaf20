// Pass wipe_drops, corrected: the film that the blades sweep goes to drops, to the unit.
#include <gtest/gtest.h>

#include "image/images.h"
#include "windshield/sweep_geometry.h"

namespace rainref::windshield {
namespace {

using N = scalar::Scalar<float>;

std::uint64_t mass_units_in(const Image& film) {
  std::uint64_t sum = 0;
  for (int y = 0; y < film.height(); ++y) {
    for (int x = 0; x < film.width(); ++x) sum += static_cast<std::uint64_t>(film.row<float>(y)[x]);
  }
  return sum;
}
std::uint64_t mass_units_in(const DropArrays& d) {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < d.size(); ++i) sum += d.life[i] > 0 ? static_cast<std::uint64_t>(d.mass[i]) : 0;
  return sum;
}
// Film and drops lose to the unit what is returned, whatever the sizes, with drops that can hold no more.
TEST(MotionFilm, WaterIsConservedToTheQuantum) {
  std::mt19937 random(10);
  for (const auto& [columns, rows] : {std::pair{64, 40}, std::pair{257, 129}, std::pair{1, 1}, std::pair{3, 500}}) {
    for (const char* arrangement : {"tandem", "opposed"}) {
      WiperSettings s = default_wipers(default_glass(), arrangement);
      Image film(Format::r32f, columns, rows);
      DropArrays drops = random_drops(2000, static_cast<std::uint32_t>(columns));
      for (std::size_t i = 0; i < drops.size(); i += 3) drops.mass[i] = 0x1p24f - static_cast<float>(random() % 1000);
      std::uint64_t taken = 0, removed_in_all = 0;
      for (int n = 0; n < 90; ++n) {
        for (int y = 0; y < rows; ++y) {
          for (int x = 0; x < columns; ++x) film.row<float>(y)[x] = static_cast<float>(random() % 7 == 0 ? 1u << 24 : random() % 3000);
        }
        const std::uint64_t film_before = mass_units_in(film), drops_before = mass_units_in(drops);
        const std::uint64_t removed = wipe(drops, wipers_between(s, default_glass().plane(), n / 60.0, (n + 1) / 60.0, corrected), film);
        ASSERT_EQ(film_before + drops_before, mass_units_in(film) + mass_units_in(drops) + removed)
            << columns << "x" << rows << " step " << n;
        for (const float m : drops.mass) ASSERT_LE(m, 0x1p24f);
        taken += mass_units_in(drops) > drops_before;
        removed_in_all += removed;
      }
      if (columns > 1) {
        EXPECT_GT(taken, 10u);
        EXPECT_GT(removed_in_all, 0u);
      }
    }
  }
}

// Film is cleared exactly where the pass says so, everywhere on the image: the box that saves time hides no texel.
TEST(MotionFilm, FilmIsClearedWhereItIsSwept) {
  for (const char* arrangement : {"tandem", "opposed"}) {
    for (const double fps : {3.0, 20.0, 60.0}) {
      for (const double t : {0.0, 0.31, 0.66, 1.0}) {
        const std::vector<Wiper> records =
            wipers_between(default_wipers(default_glass(), arrangement), default_glass().plane(), t, t + 1 / fps, corrected);
        Image film = make_image(Format::r32f, 131, 77, [](int, int, int) { return 3.0f; });
        DropArrays drops(1);
        drops.life[0] = 0;
        const std::uint64_t removed = wipe(drops, records, film);
        const WipeDropsUniforms u = uniforms_of(records, corrected, film.width(), film.height());
        std::uint64_t swept = 0;
        for (int y = 0; y < film.height(); ++y) {
          for (int x = 0; x < film.width(); ++x) {
            const bool is_swept = scalar::swept_texel<N>(u, records.data(), x, y).wiper.v >= 0;
            ASSERT_EQ(film.row<float>(y)[x], is_swept ? 0 : 3) << x << "," << y;
            swept += is_swept;
          }
        }
        EXPECT_EQ(removed, 3 * swept);
        EXPECT_GT(swept, 0u);
      }
    }
  }
}

// Where two sweeps overlap, the first record has the texel.
TEST(MotionFilm, TheFirstRecordTakesATexel) {
  const std::vector<Wiper> records = wipers_between(default_wipers(default_glass(), "opposed"), default_glass().plane(), 0, 0.5, corrected);
  const WipeDropsUniforms u = uniforms_of(records, corrected, 140, 80);
  int shared = 0;
  for (int y = 0; y < 80; ++y) {
    for (int x = 0; x < 140; ++x) {
      const Real2 p = default_glass().plane().to_plane({(x + 0.5) / 140, (y + 0.5) / 80});
      // Inside of both by more than rounding.
      bool in_both = true;
      for (const Wiper& w : records) {
        if (w.direction != 0) in_both = in_both && sweep_distance(w, {p[0], p[1]}) < w.half_width - 1e-6;
      }
      if (!in_both) continue;
      ++shared;
      ASSERT_EQ(scalar::swept_texel<N>(u, records.data(), x, y).wiper.v, 0) << x << "," << y;
    }
  }
  EXPECT_GT(shared, 100);
}

// The lowest id in the bin takes it, wherever it lies in memory.
TEST(MotionFilm, TheLowestIdTakesTheFilm) {
  const WiperSettings s = inner_blade();
  const std::vector<Wiper> records = wipers_between(s, default_glass().plane(), 0.25, 0.25 + 1.0 / 60, corrected);
  const double angle = wiper_angle(s.blades[0], 60, 0.25 + 0.5 / 60);
  const Real2 place = default_glass().plane().to_glass({0.7 + 0.4 * std::cos(angle), 0.08 + 0.4 * std::sin(angle)});
  DropArrays drops(3);
  drops.id = {9, 2, 5};
  for (int i = 0; i < 3; ++i) {
    drops.u[i] = static_cast<float>(place[0]);
    drops.v[i] = static_cast<float>(place[1]);
    drops.mass[i] = 100;
  }
  Image film = make_image(Format::r32f, 700, 400, [](int, int, int) { return 1.0f; });
  const std::uint64_t before = mass_units_in(film);
  const std::uint64_t removed = wipe(drops, records, film);
  EXPECT_EQ(drops.mass[0], 100);
  EXPECT_EQ(drops.mass[2], 100);
  EXPECT_GT(drops.mass[1], 100);
  EXPECT_EQ(before - mass_units_in(film), removed + static_cast<std::uint64_t>(drops.mass[1]) - 100);
  // A bin is 1/64 of the blade's length: its share of the swept film is as much of r^2.
  const double near = 0.15 - 0.008, far = 0.6 + 0.008, width = (far - near) / film_bins;
  const double r0 = near + width * std::floor((0.4 - near) / width), r1 = r0 + width;
  const double turn = wiper_angle(s.blades[0], 60, 0.25 + 1.0 / 60) - wiper_angle(s.blades[0], 60, 0.25), texel = 1.4 / 700 * 0.8 / 400;
  const double share = ((r1 * r1 - r0 * r0) / 2 * turn + 2 * 0.008 * width) / texel;
  EXPECT_NEAR(drops.mass[1] - 100, share, 0.15 * share);  // some hundred texels: their outline is rough
}

}  // namespace
}  // namespace rainref::windshield
