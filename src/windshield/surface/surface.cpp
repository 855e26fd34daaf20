#include "windshield/surface/surface.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "math/constants.h"
#include "math/half.h"
#include "math/real64.h"
#include "math/smooth_step.h"
#include "random/counter.h"

namespace rainref::windshield {
namespace {

/// A multiple of the grid, a power of two: the quotient is exact and below 2^51.
double nearest_multiple(double time, double grid) {
  const double biased = time / grid + whole_bias;
  return (biased - whole_bias) * grid;
}

}  // namespace

double wiped_grid(double tau) {
  // The largest power of two not above tau, divided by 2^19.
  constexpr std::uint64_t exponent = 0x7ff0000000000000u;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(tau) & exponent) * 0x1p-19;
}
float whole_step(double fps, int frame, double grid) {
  return static_cast<float>(nearest_multiple((frame + 1) / fps, grid) - nearest_multiple(frame / fps, grid));
}
float wiped_limit(double tau) { return static_cast<float>(wiped_grid(tau) * 0x1p24); }

WipeTextureUniforms wipe_texture_uniforms(const SurfaceSettings& s, int frame) {
  WipeTextureUniforms u{};
  const double column = s.frame[0] / s.width, shear = s.frame[1] / s.height, row = s.frame[2] / s.height;
  u.frame[0] = static_cast<float>(column);
  u.frame[1] = static_cast<float>(shear);
  u.frame[2] = static_cast<float>(row);
  // A texel, but at most the width of a blade, because halves covered by two successive sweeps would leave a seam.
  u.edge_width = static_cast<float>(std::max(1e-6, std::min(std::max(column, row), s.half_width)));
  u.axis_length[0] = static_cast<float>(s.frame[0]);
  u.axis_length[1] = static_cast<float>(s.frame[2]);
  if (s.corrected) {
    u.dt = whole_step(s.fps, frame, wiped_grid(s.mask_tau));
    u.inverse_tau = static_cast<float>(1 / s.mask_tau);
    u.wiped_limit = wiped_limit(s.mask_tau);
  } else {
    u.strength = static_cast<float>(s.wipe_strength);
    u.keep = static_cast<float>(exp_real(Real64(-1 / (s.fps * s.mask_tau))).v);
  }
  return u;
}

PersistUniforms persist_uniforms(const SurfaceSettings& s) {
  PersistUniforms u{};
  u.keep = static_cast<float>(exp_real(Real64(-1 / (s.fps * s.height_tau))).v);
  return u;
}

NormalsUniforms normals_uniforms(const SurfaceSettings& s) {
  // A central difference spans two texels; heights are in mm. Plane axes: dh/dx = h_u / f0, dh/dy = (h_v - h_u f1 / f0) / f2.
  const double metres = 1e-3 / 2;
  NormalsUniforms u{};
  u.slope_x = static_cast<float>(metres * s.width / s.frame[0]);
  u.slope_shear = static_cast<float>(-metres * s.width * s.frame[1] / (s.frame[0] * s.frame[2]));
  u.slope_y = static_cast<float>(metres * s.height / s.frame[2]);
  return u;
}

Image make_mask(const SurfaceSettings& s) { return Image(Format::r16f, s.width, s.height); }
Image make_wiped(const SurfaceSettings& s) {
  Image wiped(Format::r32f, s.width, s.height);
  for (int y = 0; y < s.height; ++y) std::fill_n(wiped.row<float>(y), s.width, wiped_limit(s.mask_tau));
  return wiped;
}

pass::HostIo<WipeTexturePass> wipe_texture_io(bool corrected, std::span<const Wiper> wipers, const WipedTextures& t) {
  pass::HostIo<WipeTexturePass> io;
  io.height = *t.height;
  io.new_height = *t.height;
  if (!corrected) io.mask = *t.mask;
  io.new_mask = *t.mask;
  if (corrected && t.wiped) {
    io.wiped = *t.wiped;
    io.new_wiped = *t.wiped;
  }
  io.wipers = wipers;
  return io;
}

namespace {

constexpr int columns = 256;                     // of the profile: 2 mm each for a usual blade
constexpr int each_side = 16;                    // deflections
constexpr double water = 0.02;                   // height that takes all of the film up [mm]
constexpr double end_share = 0.08;               // of the blade's length, from either end
constexpr double least_streaks = 5, more = 40;   // of a new blade, and the addition for a ragged one
constexpr double narrowest = 0.8, widest = 2.4;  // half their width [columns]

}  // namespace

SmearUniforms smear_uniforms(const SmearSettings& s, const SurfaceSettings& surface) {
  const WipeTextureUniforms wipe = wipe_texture_uniforms(surface, 0);
  SmearUniforms u{};
  std::copy_n(wipe.frame, 3, u.frame);
  u.edge_width = wipe.edge_width;
  u.inverse_water = static_cast<float>(1 / water);
  u.drying = static_cast<float>(1 / s.drying);
  return u;
}

std::vector<Deflection> deflections(const SmearSettings& s) {
  const Real64 angle(s.spread_deg * degree);
  const double tangent = (sin_real(angle) / cos_real(angle)).v;
  const auto weight = [](int k) {
    const double left = 1 - std::abs(k) / (each_side + 1.0);
    return left * left;
  };
  double sum = 0;
  for (int k = -each_side; k <= each_side; ++k) sum += weight(k);
  std::vector<Deflection> all;
  for (int k = -each_side; k <= each_side; ++k)
    all.push_back({static_cast<float>(tangent * k / each_side), static_cast<float>(weight(k) / sum), 0, 0});
  return all;
}

SoftenUniforms soften_uniforms(const SmearSettings& s, const CompositeUniforms& seen, int scene_width) {
  SoftenUniforms u{};
  std::copy_n(seen.u_row, 3, u.u_row);
  std::copy_n(seen.v_row, 3, u.v_row);
  std::copy_n(seen.w_row, 3, u.w_row);
  std::copy_n(seen.plane_x, 3, u.plane_x);
  std::copy_n(seen.plane_y, 3, u.plane_y);
  std::copy_n(seen.pixel, 2, u.pixel);
  std::copy_n(seen.half_size, 2, u.half_size);
  std::copy_n(seen.scene_scale, 2, u.scene_scale);
  u.glass_distance = seen.glass_distance;
  u.most = static_cast<float>(s.most);
  u.deflection_count = 2 * each_side + 1;
  // The whole level whose texels are about as far apart as the lookups.
  const Real64 angle(s.spread_deg * degree);
  const double apart = (sin_real(angle) / cos_real(angle)).v / each_side * seen.scene_scale[0] * scene_width;
  for (double texel = 1.5; texel <= apart; texel *= 2) u.lod += 1;
  return u;
}

Image smear_profile(const SmearSettings& s, std::uint64_t seed) {
  const auto word = [&](int of, int k) {
    return random::block(seed, random::Purpose::wiper_smear, static_cast<std::uint32_t>(of), static_cast<std::uint32_t>(k));
  };
  std::vector<double> film(columns);
  for (int k = 0; k < columns; ++k) {
    const double grain = 0.5 + random::uniform(word(0, k)[0]), end = std::min(k + 0.5, columns - k - 0.5) / columns;
    film[static_cast<std::size_t>(k)] = (0.12 + 0.16 * s.wear) * grain + (0.2 + 0.4 * s.wear) * (1 - smooth_step(end / end_share)) * grain;
  }
  const int streaks = static_cast<int>(least_streaks + more * s.wear);
  for (int i = 0; i < streaks; ++i) {
    const random::Block r = word(1, i);
    const double at = columns * random::uniform(r[0]), half = narrowest + (widest - narrowest) * random::uniform(r[1]);
    const double high = 0.3 + 0.7 * random::uniform(r[2]);
    for (int k = 0; k < columns; ++k) {
      double& here = film[static_cast<std::size_t>(k)];
      here = std::max(here, high * (1 - smooth_step(std::abs(k + 0.5 - at) / (2 * half))));
    }
  }
  Image profile(Format::r16f, columns, 1);
  for (int k = 0; k < columns; ++k) profile.row<Half>(0)[k] = to_half(static_cast<float>(std::min(film[static_cast<std::size_t>(k)], 1.0)));
  return profile;
}

Image make_laid(const SurfaceSettings& surface) { return Image(Format::rgba16f, surface.width, surface.height); }

namespace {

constexpr int taps_on_ring = 8, mist_tap_count = 1 + taps_on_ring;

}  // namespace

CondenseUniforms condense_uniforms(const CondensationSettings& s, const SurfaceSettings& surface, int frame) {
  CondenseUniforms u{};
  u.dt = whole_step(surface.fps, frame, wiped_grid(s.tau));
  u.inverse_tau = static_cast<float>(1 / s.tau);
  u.limit = wiped_limit(s.tau);
  u.wiped_limit = wiped_limit(surface.mask_tau);
  u.most = static_cast<float>(s.most);
  u.inverse_water = static_cast<float>(1 / s.water);
  return u;
}

MistUniforms mist_uniforms(const CondensationSettings& s, const CompositeUniforms& seen) {
  MistUniforms u{};
  std::copy_n(seen.u_row, 3, u.u_row);
  std::copy_n(seen.v_row, 3, u.v_row);
  std::copy_n(seen.w_row, 3, u.w_row);
  std::copy_n(seen.pixel, 2, u.pixel);
  std::copy_n(seen.half_size, 2, u.half_size);
  std::copy_n(seen.scene_scale, 2, u.scene_scale);
  u.glass_distance = seen.glass_distance;
  // A whole level, so one lookup suffices: four texels of it are the disc's radius, and its blur reaches from tap to tap.
  u.lod = static_cast<float>(std::max(std::floor(s.blur_lod - 2 + 0.5), 0.0));
  u.weight = static_cast<float>(1.0 / mist_tap_count);
  u.tap_count = mist_tap_count;
  u.veil = static_cast<float>(s.veil);
  return u;
}

std::vector<Tap> mist_taps(const CondensationSettings& s, int scene_width, int scene_height) {
  const double ring = 0.75 * exp2_real(Real64(s.blur_lod)).v;
  std::vector<Tap> taps{{0, 0, 0, 0}};
  for (int k = 0; k < taps_on_ring; ++k) {
    const Real64 angle(2 * pi * k / taps_on_ring);
    taps.push_back(
        {static_cast<float>(ring * cos_real(angle).v / scene_width), static_cast<float>(ring * sin_real(angle).v / scene_height), 0, 0});
  }
  return taps;
}

Image make_clear_time(const CondensationSettings& s, const SurfaceSettings& surface) {
  Image time(Format::r32f, surface.width, surface.height);
  for (int y = 0; y < surface.height; ++y) std::fill_n(time.row<float>(y), surface.width, wiped_limit(s.tau));
  return time;
}

}  // namespace rainref::windshield
