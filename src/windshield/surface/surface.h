// The passes on the windshield's textures, persist, wipe_texture and normals: the host's values and state.
#pragma once

#include <array>
#include <span>

#include "rainref/image.h"
#include "windshield/surface/normals.pass.h"
#include "windshield/surface/persist.pass.h"
#include "windshield/surface/wipe_texture.pass.h"
#include "windshield/uniforms.h"

namespace rainref::windshield {

/// What these passes need to know.
struct SurfaceSettings {
  bool corrected = false;
  int width = 1024, height = 592;  ///< of the textures [texel]
  Rounding rounding = Rounding::rne;
  double fps = 60;
  /// Of the glass [m]: as-published |e_u|, 0, |e_v|; corrected the plane frame.
  std::array<double, 3> frame{1, 0, 1};
  double half_width = 6e-3;   ///< of the narrowest blade [m]
  double wipe_strength = 10;  ///< as-published: what full coverage takes off [mm]
  double height_tau = 0;      ///< as-published: time constant of a height texture that persists; 0: it is cleared each frame [s]
  double mask_tau = 4;        ///< time constant of the mask [s]
};

/// Times since a wipe are whole multiples of this power of two, about tau / 2^19, so that float sums of them are exact up to
/// wiped_limit (about 32 tau), whatever the frame rate. [s]
double wiped_grid(double tau);
float wiped_limit(double tau);
/// The time of a frame as a difference of two whole multiples of the grid, so that all frames together make the time that has passed.
float whole_step(double fps, int frame, double grid);

/// Everything but the number of wipers, for the frame. In double, each rounded once.
WipeTextureUniforms wipe_texture_uniforms(const SurfaceSettings& settings, int frame);
NormalsUniforms normals_uniforms(const SurfaceSettings& settings);
/// height_tau above 0.
PersistUniforms persist_uniforms(const SurfaceSettings& settings);

/// State and outputs of wipe_texture; height is splat's.
struct WipedTextures {
  Image* height;  ///< r16f [mm]
  Image* mask;    ///< r16f
  Image* wiped;   ///< corrected: r32f, time since the last wipe [s]; else null
};
/// Dry or never wiped glass: mask 0, wiped at its limit.
Image make_mask(const SurfaceSettings& settings);
Image make_wiped(const SurfaceSettings& settings);

/// One run of the pass, in place. uniforms.wiper_count is that of the wipers.
pass::HostIo<WipeTexturePass> wipe_texture_io(bool corrected, std::span<const Wiper> wipers, const WipedTextures& textures);

}  // namespace rainref::windshield
