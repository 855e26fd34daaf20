// The rim that swallows waves: what comes back of a packet, against the same water without an edge in reach; energy, levels, uniforms.
#include <cstring>

#include "puddle/support.h"

namespace rainref::puddle {
namespace {

constexpr int size = 128;  // of the water in both directions
constexpr double courant = 0.6;

Settings with_rim(Settings s, double cells) {
  s.rim_width = cells * s.cell_size;
  return s;
}
double kept(const WaveStepUniforms& u, int width, int height, int x, int y) {
  const double edge = std::min({x + 0.5, width - (x + 0.5), y + 0.5, height - (y + 0.5)});
  const double depth = std::max(1 - u.rim_inverse * edge, 0.0);
  return 1 - u.rim_damping * depth * depth;
}
/// - <L a, b> of the five-point Laplacian: what the springs between cells hold.
double springs(const Field& a, const Field& b, int width, int height, Boundary boundary) {
  const auto at = [&](int x, int y) {
    if (boundary == Boundary::periodic) return a[static_cast<std::size_t>((y + height) % height) * width + (x + width) % width];
    if (boundary == Boundary::fixed && (x < 0 || y < 0 || x >= width || y >= height)) return 0.0;
    return a[static_cast<std::size_t>(std::clamp(y, 0, height - 1)) * width + std::clamp(x, 0, width - 1)];
  };
  double sum = 0;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x)
      sum += (4 * at(x, y) - at(x - 1, y) - at(x + 1, y) - at(x, y - 1) - at(x, y + 1)) * b[static_cast<std::size_t>(y) * width + x];
  return sum;
}
/// Of a wave without damping: half of |new - old|^2 + C^2 <grad new, grad old>, which leapfrog keeps to rounding.
double energy(const Field& now, const Field& before, int width, int height) {
  const Field change = minus(now, before);
  return 0.5 * (dot(change, change) + courant * courant * springs(now, before, width, height, Boundary::reflecting));
}

// ---- what comes back -------------------------------------------------------------------------------------------------

/// A packet of waves of this length [cells] around (cx, cy) that runs at an angle to the x axis, `steps` steps from its start.
Field packet(int width, double cx, double cy, double length, double angle, int steps) {
  const double k = 2 * pi / length, kx = k * std::cos(angle), ky = k * std::sin(angle);
  // The scheme's own frequency; the envelope goes with the wave speed.
  const double w = 2 * std::asin(courant * std::hypot(std::sin(kx / 2), std::sin(ky / 2))), way = courant * steps;
  return make_field(width, width, [&](int i, int j) {
    const double x = i + 0.5 - cx, y = j + 0.5 - cy, along = x - way * std::cos(angle), across = y - way * std::sin(angle);
    return std::exp(-(along * along + across * across) / (2 * length * length)) * std::cos(kx * x + ky * y - w * steps);
  });
}
Field part(const Field& u, int width, int from, int count) {
  return make_field(count, count, [&](int x, int y) { return u[static_cast<std::size_t>(y + from) * width + x + from]; });
}
/// Share of the packet's energy that is back in the water between the rims when it has gone to the right edge and as far again; what
/// the packet has left there without any edge is taken off.
double share_returned(double rim_cells, double length, double angle, Boundary boundary = Boundary::reflecting) {
  constexpr int wide = 3 * size;  // no wave gets to its edges and back into the middle
  const double cx = size / 2, cy = angle == 0 ? size / 2 : size / 4;
  const int steps = static_cast<int>(size / (courant * std::cos(angle)));
  const Settings s = with_rim(corrected(size, size, 1, courant, boundary), rim_cells), free = corrected(wide, wide, 1, courant);
  const Field now = packet(size, cx, cy, length, angle, 0), before = packet(size, cx, cy, length, angle, -1);
  OracleWave edged = oracle_of(s, now, before);
  OracleWave edgeless =
      oracle_of(free, packet(wide, size + cx, size + cy, length, angle, 0), packet(wide, size + cx, size + cy, length, angle, -1));
  for (int n = 0; n < steps; ++n) {
    edged.step();
    edgeless.step();
  }
  const int rim = static_cast<int>(std::ceil(rim_cells)), inside = size - 2 * rim;
  const auto echo = [&](const std::vector<double>& of_edged, const std::vector<double>& of_edgeless) {
    return minus(part(of_edged, size, rim, inside), part(of_edgeless, wide, size + rim, inside));
  };
  return energy(echo(edged.newest, edgeless.newest), echo(edged.previous, edgeless.previous), inside, inside) /
         energy(now, before, size, size);
}

// In theory the way in and out leaves 1e-3 of the height at normal incidence, 1e-6 of the energy, and less at 45 degrees, where it is
// longer; the ramp itself scatters long waves back. A ramp of two wavelengths stays within ten times the theory.
TEST(WaveRim, SwallowsAPacketAtNormalIncidenceAndAt45Degrees) {
  for (const Boundary boundary : {Boundary::reflecting, Boundary::fixed}) {
    for (const double angle : {0.0, pi / 4}) {
      const double share = share_returned(24, 12, angle, boundary);
      record(fmt::format("share at {:.0f} degrees, boundary {}", angle * 180 / pi, static_cast<int>(boundary)), share);
      EXPECT_LT(share, 1e-5) << angle << ", boundary " << static_cast<int>(boundary);
    }
  }
}
TEST(WaveRim, AWaveAlmostAsLongAsTheRimIsWideReturnsATenthOfAPerMille) {
  for (const double angle : {0.0, pi / 4}) {
    const double share = share_returned(24, 20, angle);
    record(fmt::format("share at {:.0f} degrees", angle * 180 / pi), share);
    EXPECT_LT(share, 1e-4) << angle;
  }
}
TEST(WaveRim, WithoutARimAllComesBack) {
  // At 45 degrees the packet's first edge sends it towards the upper one; all of it is still in the water.
  for (const double angle : {0.0, pi / 4}) EXPECT_GT(share_returned(0, 12, angle), 0.95) << angle;
}

// ---- energy and levels -----------------------------------------------------------------------------------------------

// With A = 2 / (G (1 + gamma)) and B = 2 gamma G / (1 + gamma) a step is A new - 2 u + B p = C^2 L(u). Times (new - p) / 2 and summed:
// half of |new - u|^2 + C^2 <grad new, grad u> + sum r (new^2 + u^2), r = (A + B) / 2 - 1 >= 0, changes by - sum (A - B) / 4 (new - p)^2.
TEST(WaveRim, NoRimLetsTheEnergyGrowAtTheLimit) {
  const int width = 21, height = 16;
  for (const Boundary boundary : boundaries) {
    for (const double gamma : {1.0, 0.98}) {
      for (const double cells : {0.0, 1.0, 5.0, 400.0}) {
        const Settings s = with_rim(corrected(width, height, gamma, courant_limit, boundary), cells);
        const WaveStepUniforms u = wave_step_uniforms(s);
        const double damping = u.damping, spring = 2 * u.courant_sq / (1 + damping);
        OracleWave wave = oracle_of(s, noise(cells_of(s), 3), noise(cells_of(s), 4));
        const auto energy_now = [&] {
          const Field change = minus(wave.newest, wave.previous);
          double sum = dot(change, change) + spring * springs(wave.newest, wave.previous, width, height, boundary);
          for (int y = 0; y < height; ++y) {
            for (int x = 0; x < width; ++x) {
              const std::size_t i = static_cast<std::size_t>(y) * width + x;
              const double g = kept(u, width, height, x, y), r = (1 / g + damping * g) / (1 + damping) - 1;
              EXPECT_GE(r, -1e-15);
              sum += r * (wave.newest[i] * wave.newest[i] + wave.previous[i] * wave.previous[i]);
            }
          }
          return sum / 2;
        };
        const double first = energy_now();
        double last = first;
        for (int n = 0; n < 500; ++n) {
          wave.step();
          const double next = energy_now();
          // Sums of some 300 cells whose roundings are 2^-53 of the first energy at most.
          ASSERT_LE(next, last + 1e-12 * first) << text(s) << ", " << cells << " cells, step " << n;
          last = next;
        }
        if (cells > 1) {
          EXPECT_LT(last, 0.5 * first) << text(s) << ", " << cells << " cells";
        }
      }
    }
  }
}

// Level water that stands too high runs off over an open edge; a basin keeps it.
TEST(WaveRim, AHighLevelRunsOff) {
  for (const double cells : {0.0, 12.0}) {
    const Settings s = with_rim(corrected(48, 48, 1, courant), cells);
    const Field high(cells_of(s), 0.01);
    OracleWave wave = oracle_of(s, high, high);
    for (int n = 0; n < 4000; ++n) wave.step();
    if (cells == 0) {
      EXPECT_NEAR(mean(wave.newest), 0.01, 1e-12) << "4000 roundings";
    } else {
      EXPECT_LT(largest(wave.newest), 1e-5);
    }
  }
}

// ---- one step, uniforms ----------------------------------------------------------------------------------------------

TEST(WaveRim, AStepIsTheFreeOneInsideAndTheFormulaInTheRim) {
  const int width = 30, height = 23;
  for (const double cells : {4.0, 6.5}) {
    const Settings free = corrected(width, height, 0.98, 0.6), s = with_rim(free, cells);
    const WaveStepUniforms u = wave_step_uniforms(s);
    const Field newest = noise(cells_of(s), 5), previous = noise(cells_of(s), 6);
    OracleWave with = oracle_of(s, newest, previous), without = oracle_of(free, newest, previous);
    // The same previous level as the rim leaves it.
    OracleWave shrunk = without;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) shrunk.previous[static_cast<std::size_t>(y) * width + x] *= kept(u, width, height, x, y);
    for (OracleWave* wave : {&with, &without, &shrunk}) wave->step();
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        const std::size_t i = static_cast<std::size_t>(y) * width + x;
        const double g = kept(u, width, height, x, y), edge = std::min({x + 0.5, width - x - 0.5, y + 0.5, height - y - 0.5});
        ASSERT_EQ(g < 1, edge < cells) << x << ", " << y;
        if (g == 1) {
          ASSERT_EQ(with.newest[i], without.newest[i]) << x << ", " << y;
        }
        ASSERT_NEAR(with.newest[i], g * shrunk.newest[i], 1e-15) << "a rounding of each factor of kept: " << x << ", " << y;
      }
    }
  }
}

// The integral of sigma / c over the way to the edge and back is ln 1000, whatever cells, speed and step rate are.
TEST(WaveRim, TheWayInAndOutLeavesAThousandth) {
  for (const double cells : {12.0, 24.0, 60.0}) {
    for (const double speed : {0.1, 0.3, 0.7}) {
      const Settings s = with_rim(corrected(200, 200, 1, speed), cells);
      const WaveStepUniforms u = wave_step_uniforms(s);
      double log_kept = 0;
      for (int x = 0; x < cells; ++x) log_kept += 2 / speed * std::log(kept(u, 200, 200, x, 100));
      // kept is the chord 1 - (1 - e^-a) q of e^(-a q), q = depth^2, a = 1.5 ln 1000 speed / cells: a^2 q (1 - q) / 2 above it, and
      // q (1 - q) is 2 / 15 on average. A tenth for the next order, and for the midpoint sum ln 1000 / (4 cells^2).
      const double echo = std::log(1e-3), chord = 0.3 * echo * echo * speed / cells;
      EXPECT_NEAR(log_kept, echo + chord, 0.1 * chord + 0.25 * -echo / (cells * cells)) << cells << " cells, Courant number " << speed;
    }
  }
}
TEST(WaveRim, ARimOfNoCellLeavesTheUniformsAsTheyAre) {
  const Settings s = corrected(40, 30, 0.98, 0.6);
  const WaveStepUniforms without = wave_step_uniforms(s);
  EXPECT_EQ(without.rim_damping, 0);
  EXPECT_EQ(without.rim_inverse, 0);
  // Below half a cell there is no centre in it; a division by so little would overflow.
  for (const double width : {0.5 * s.cell_size, 1e-300}) {
    Settings narrow = s;
    narrow.rim_width = width;
    const WaveStepUniforms u = wave_step_uniforms(narrow);
    EXPECT_EQ(std::memcmp(&u, &without, sizeof u), 0) << width;
  }
  Settings published = as_published(40, 30, 0.98);
  published.rim_width = 0.1;
  EXPECT_EQ(wave_step_uniforms(published).rim_damping, 0);
}

}  // namespace
}  // namespace rainref::puddle
