#include "windshield/surface/surface.h"

#include <algorithm>
#include <bit>

#include "math/real64.h"

namespace rainref::windshield {
namespace {

/// A multiple of the grid, a power of two: the quotient is exact and below 2^51.
double nearest(double time, double grid) {
  const double biased = time / grid + whole_bias;
  return (biased - whole_bias) * grid;
}

}  // namespace

double wiped_grid(double tau) {
  // The power of two not above tau, over 2^19.
  constexpr std::uint64_t exponent = 0x7ff0000000000000u;
  return std::bit_cast<double>(std::bit_cast<std::uint64_t>(tau) & exponent) * 0x1p-19;
}
float whole_step(double fps, int frame, double grid) {
  return static_cast<float>(nearest((frame + 1) / fps, grid) - nearest(frame / fps, grid));
}
float wiped_limit(double tau) { return static_cast<float>(wiped_grid(tau) * 0x1p24); }

WipeTextureUniforms wipe_texture_uniforms(const SurfaceSettings& s, int frame) {
  WipeTextureUniforms u{};
  const double column = s.frame[0] / s.width, shear = s.frame[1] / s.height, row = s.frame[2] / s.height;
  u.frame[0] = static_cast<float>(column);
  u.frame[1] = static_cast<float>(shear);
  u.frame[2] = static_cast<float>(row);
  // A texel, but no wider than a blade: what two sweeps in turn cover by halves would stay as a seam.
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
  // Twice a texel is the span of a difference; heights are in mm. Plane axes: dh/dx = h_u / f0, dh/dy = (h_v - h_u f1 / f0) / f2.
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

}  // namespace rainref::windshield
