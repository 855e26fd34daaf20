// What the tests of the waves share: small settings, water as heights in double, exact modes, bounds of rounding.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <random>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <gmock/gmock.h>

#include "base/error_of.h"
#include "math/half.h"
#include "math/unorm.h"
#include "rainref/executor.h"
#include "puddle/host.h"
#include "puddle/oracle.h"
#include "rainref/puddle.h"
#include "settings.h"

namespace rainref::puddle {

inline constexpr double pi = 3.14159265358979323846;
inline constexpr double ulp_float = 0x1p-24, ulp_double = 0x1p-53;  // half the spacing of numbers in [1, 2)

using Field = std::vector<double>;  // row-major heights: as-published decoded units, corrected metres

// ---- settings ------------------------------------------------------------------------------------------------------

/// Images as small as they may be: waves do not see them.
inline Surroundings tiny_surroundings() {
  Surroundings s;
  s.environment = Image(Format::rgba32f, 4, 2);
  s.ground = Image(Format::rgba32f, 4, 2);
  return s;
}

inline Settings no_rain(Variant variant, int width, int height) {
  Settings s = rainref::test::puddle_settings();
  s.variant = variant;
  s.width = variant == Variant::as_published ? width : 8;
  s.height = variant == Variant::as_published ? height : 6;
  s.grid = {width, height};
  s.drop_intensity = variant == Variant::as_published ? 0 : 1;
  s.rain_rate = 0;
  s.shape = Shape::basin;
  s.storage = Format::rg32f;
  s.camera_position = {0, 1, 1};
  return s;
}
/// One frame is one step.
inline Settings as_published(int width, int height, double gamma, Boundary boundary = Boundary::reflecting) {
  Settings s = no_rain(Variant::as_published, width, height);
  s.damping = gamma;
  s.boundary = boundary;
  return s;
}
/// One frame is one step of 1/60 s, so that gamma is the damping; cells of 1/60 m, so that the Courant number is the speed.
inline Settings corrected(int width, int height, double gamma, double courant, Boundary boundary = Boundary::reflecting) {
  Settings s = no_rain(Variant::corrected, width, height);
  s.damping = gamma;
  s.boundary = boundary;
  s.fps = s.step_rate = 60;
  s.cell_size = 1.0 / 60;
  s.wave_speed = courant;
  return s;
}
inline constexpr double courant_limit = 0x1.6a09e667f3bcdp-1;  // sqrt(1/2)
inline constexpr Boundary boundaries[] = {Boundary::reflecting, Boundary::periodic, Boundary::fixed};
inline constexpr Variant variants[] = {Variant::as_published, Variant::corrected};

inline std::string text(const Settings& s) {
  const char* const boundary[] = {"reflecting", "periodic", "fixed"};
  return fmt::format("{} {} {} {} step {}", s.variant == Variant::corrected ? "corrected" : "as-published", info(s.storage).name,
                     name(s.rounding), boundary[static_cast<int>(s.boundary)], s.step);
}

// ---- water ---------------------------------------------------------------------------------------------------------

inline const parallel::Executor& two_threads() {
  static const parallel::Executor executor(2);
  return executor;
}
inline Puddle puddle_of(const Settings& settings) { return Puddle(settings, tiny_surroundings(), two_threads()); }

inline std::size_t cells_of(const Settings& s) { return static_cast<std::size_t>(wave_size(s)[0]) * wave_size(s)[1]; }

inline Field make_field(int width, int height, const std::function<double(int x, int y)>& height_at) {
  Field field;
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) field.push_back(height_at(x, y));
  }
  return field;
}
/// Evenly spread in [-amplitude, amplitude).
inline Field noise(std::size_t cells, unsigned seed, double amplitude = 1) {
  std::mt19937 words(seed);
  Field field(cells);
  for (double& x : field) x = amplitude * (words() * 0x1p-31 - 1);
  return field;
}

/// Stored values of a plane, exactly.
inline Field stored_values(const Image& plane) {
  Field out;
  for (int y = 0; y < plane.height(); ++y) {
    for (int x = 0; x < plane.width(); ++x) {
      switch (info(plane.format()).kind) {
        case FormatInfo::float16:
          out.push_back(to_float(plane.row<Half>(y)[x]));
          break;
        case FormatInfo::float32:
          out.push_back(plane.row<float>(y)[x]);
          break;
        default:
          out.push_back(to_float(plane.row<Unorm8>(y)[x]));
      }
    }
  }
  return out;
}
inline Field heights(Field stored, const Settings& settings) {
  const Encoding e = encoding(settings);
  for (double& s : stored) s = e.scale * s + e.bias;
  return stored;
}
inline Field heights(const Image& plane, const Settings& settings) { return heights(stored_values(plane), settings); }

inline void put(OracleWave& wave, const Settings& settings, const Field& newest, const Field& previous) {
  const Encoding e = encoding(settings);
  for (std::size_t i = 0; i < newest.size(); ++i) {
    wave.newest[i] = (newest[i] - e.bias) / e.scale;
    wave.previous[i] = (previous[i] - e.bias) / e.scale;
  }
}
inline OracleWave oracle_of(const Settings& settings, const Field& newest, const Field& previous) {
  OracleWave wave(settings);
  put(wave, settings, newest, previous);
  return wave;
}
inline void put(Puddle& puddle, const Field& newest, const Field& previous) {
  puddle.set_water({newest.begin(), newest.end()}, {previous.begin(), previous.end()});
}

// ---- measures ------------------------------------------------------------------------------------------------------

inline double dot(const Field& a, const Field& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += a[i] * b[i];
  return sum;
}
inline double mean(const Field& a) {
  double sum = 0;
  for (const double x : a) sum += x;
  return sum / static_cast<double>(a.size());
}
inline double rms(const Field& a) { return std::sqrt(dot(a, a) / static_cast<double>(a.size())); }
inline Field minus(Field a, const Field& b) {
  for (std::size_t i = 0; i < a.size(); ++i) a[i] -= b[i];
  return a;
}
inline double largest(const Field& a) {
  double top = 0;
  for (const double x : a) top = std::max(top, std::abs(x));
  return top;
}
/// A measured figure for the report of the run.
inline void record(const std::string& key, double value) { testing::Test::RecordProperty(key, fmt::format("{:.6g}", value)); }

// ---- theory --------------------------------------------------------------------------------------------------------

/// An eigenfunction of the neighbour sum: the four neighbours of a texel add to 2 (cos kx + cos ky) times its value.
struct Mode {
  double kx, ky;
  Field shape;  // no larger than 1
  double sum() const { return std::cos(kx) + std::cos(ky); }
  double amplitude(const Field& u) const { return puddle::dot(u, shape) / puddle::dot(shape, shape); }
};
/// Mode (p, q), 0 <= p < width, 0 <= q < height. Reflecting: cos kx (i + 1/2), kx = p pi / N. Periodic: a plane wave and its
/// quadrature, kx = 2 pi p / N. Fixed: sin kx (i + 1), kx = (p + 1) pi / (N + 1).
inline Mode mode(Boundary boundary, int width, int height, int p, int q) {
  // cos and sin of n pi / d, the phase reduced in integers first: shapes to a few roundings everywhere.
  const auto angle = [](int n, int d) { return n % (2 * d) * pi / d; };
  if (boundary == Boundary::reflecting) {
    return {p * pi / width, q * pi / height, make_field(width, height, [&](int x, int y) {
              return std::cos(angle(p * (2 * x + 1), 2 * width)) * std::cos(angle(q * (2 * y + 1), 2 * height));
            })};
  }
  if (boundary == Boundary::periodic) {
    return {2 * pi * p / width, 2 * pi * q / height, make_field(width, height, [&](int x, int y) {
              const double phase = angle(2 * p * x, width) + angle(2 * q * y, height);
              return std::sqrt(0.5) * (std::cos(phase) + std::sin(phase));
            })};
  }
  return {(p + 1) * pi / (width + 1), (q + 1) * pi / (height + 1), make_field(width, height, [&](int x, int y) {
            return std::sin(angle((p + 1) * (x + 1), width + 1)) * std::sin(angle((q + 1) * (y + 1), height + 1));
          })};
}

/// Roots of z^2 - b z + gamma = 0; the first is the one that lasts, or the upper one of a pair.
struct Roots {
  std::complex<double> first, second;
};
inline Roots roots(double b, double gamma) {
  const std::complex<double> half_gap = std::sqrt(std::complex<double>(b * b / 4 - gamma));
  const std::complex<double> first = b >= 0 || half_gap.imag() != 0 ? b / 2 + half_gap : b / 2 - half_gap;
  return {first, gamma / first};
}
/// Sum b of the roots of mode S = cos kx + cos ky, from the uniforms that the step really takes.
inline double root_sum(const Settings& s, const WaveStepUniforms& u, double S) {
  const double gamma = u.damping;
  return s.variant == Variant::corrected ? (1 + gamma) + static_cast<double>(u.courant_sq) * (2 * S - 4) : gamma * S;
}
/// The solution Re z^n of a_{n+1} = b a_n - gamma a_{n-1}, with z the first root.
inline double closed_form(double b, double gamma, int n) {
  if (std::abs(b) < 2 * std::sqrt(gamma)) return std::pow(gamma, n * 0.5) * std::cos(n * std::acos(b / (2 * std::sqrt(gamma))));
  const double z = roots(b, gamma).first.real();
  return std::pow(std::abs(z), n) * (z < 0 && n % 2 != 0 ? -1 : 1);
}

/// Most rounding that one step adds to a height of a wave no higher than 1, in units of ulp_float or ulp_double.
/// as-published: sums of four stored values up to 4 (2 + 2 + 4), velocity plus sum (2), damping (1), encoding (2).
/// corrected: the neighbours (1 + 2 + 2) and the Laplacian (4) times C^2 <= 1/2, their product (2), the rest (1 + 1 + 2 + 2).
inline constexpr double step_rounding = 13;
/// What `steps` steps make of a unit added in each. The m-th answer to a unit, (z1^m - z2^m) / (z1 - z2), is at most
/// 1 + gamma + ... + gamma^(m-1); as published, where |z| = sqrt(gamma) and sin w >= sqrt(1 - gamma), at most
/// gamma^((m-1)/2) / sqrt(1 - gamma) too. It bounds the root mean square of the error, mode by mode.
inline double growth(const Settings& s, int steps) {
  const double gamma = s.damping;
  double sum = 0, answer = 0;
  for (int m = 1; m <= steps; ++m) {
    answer = 1 + gamma * answer;
    const bool rings = s.variant == Variant::as_published && gamma < 1;
    sum += rings ? std::min(answer, std::pow(gamma, (m - 1) * 0.5) / std::sqrt(1 - gamma)) : answer;
  }
  return sum;
}

}  // namespace rainref::puddle
