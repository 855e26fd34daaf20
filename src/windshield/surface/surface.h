// The host's values and state of the passes on the windshield's textures: persist, wipe_texture and normals.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "rainref/image.h"
#include "windshield/picture/mist.pass.h"
#include "windshield/picture/soften.pass.h"
#include "windshield/surface/condense.pass.h"
#include "windshield/surface/normals.pass.h"
#include "windshield/surface/persist.pass.h"
#include "windshield/surface/smear.pass.h"
#include "windshield/surface/wipe_texture.pass.h"
#include "windshield/uniforms.h"

namespace rainref::windshield {

/// Settings of these passes.
struct SurfaceSettings {
  bool corrected = false;
  int width = 1024, height = 592;  ///< of the textures [texel]
  Rounding rounding = Rounding::rne;
  double fps = 60;
  /// Frame of the glass [m]: as-published |e_u|, 0, |e_v|; corrected the plane frame.
  std::array<double, 3> frame{1, 0, 1};
  double half_width = 6e-3;   ///< of the narrowest blade [m]
  double wipe_strength = 10;  ///< as-published: height removed by full coverage [mm]
  double height_tau = 0;      ///< as-published: time constant of a persistent height texture; 0: it is cleared each frame [s]
  double mask_tau = 4;        ///< time constant of the mask [s]
};

/// Step of the times since a wipe: a power of two of about tau / 2^19 [s]. Times are whole multiples of it, so float sums of them are exact
/// up to wiped_limit (about 32 tau) at any frame rate.
double wiped_grid(double tau);
float wiped_limit(double tau);
/// The duration of a frame as a difference of two whole multiples of the grid, so that the frames add up to the elapsed time.
float whole_step(double fps, int frame, double grid);

/// Everything except the number of wipers, for the frame. In double, each rounded once.
WipeTextureUniforms wipe_texture_uniforms(const SurfaceSettings& settings, int frame);
NormalsUniforms normals_uniforms(const SurfaceSettings& settings);
/// Requires height_tau above 0.
PersistUniforms persist_uniforms(const SurfaceSettings& settings);

/// State and outputs of wipe_texture; height is splat's output.
struct WipedTextures {
  Image* height;  ///< r16f [mm]
  Image* mask;    ///< r16f
  Image* wiped;   ///< corrected: r32f, time since the last wipe [s]; else null
};
/// Dry glass, or glass that was never wiped: mask 0, wiped at its limit.
Image make_mask(const SurfaceSettings& settings);
Image make_wiped(const SurfaceSettings& settings);

/// One run of the pass, in place. uniforms.wiper_count is set from the wipers.
pass::HostIo<WipeTexturePass> wipe_texture_io(bool corrected, std::span<const Wiper> wipers, const WipedTextures& textures);

struct SmearSettings {
  bool on = false;
  double wear = 0.3;        ///< 0: a new blade, 1: a ragged one, with more and thicker streaks
  double drying = 0.6;      ///< time in which the thickest streak dries [s]
  double most = 0.8;        ///< share of the light that the thickest streak scatters
  double spread_deg = 3.5;  ///< largest angle of deflection
};

/// Everything except the number of wipers. In double, each rounded once.
SmearUniforms smear_uniforms(const SmearSettings& settings, const SurfaceSettings& surface);
/// For a pane with this composite, before a picture of the scene of this width.
SoftenUniforms soften_uniforms(const SmearSettings& settings, const CompositeUniforms& seen, int scene_width);
/// Deflections to both sides in equal steps. The weights fall as the square of the remaining angle to the spread, and their sum is 1.
std::vector<Deflection> deflections(const SmearSettings& settings);
/// r16f, one row: thickness of the film along a blade, from its inner to its outer end, between 0 and 1. It is a thin grainy film with
/// streaks at hashed positions, thicker at both ends, where the blade presses least. The values are chosen by eye.
Image smear_profile(const SmearSettings& settings, std::uint64_t seed);
/// Glass that no blade has passed.
Image make_laid(const SurfaceSettings& surface);

struct CondensationSettings {
  bool on = false;
  double tau = 20;      ///< time constant of its growth [s]
  double most = 0.85;   ///< its final value: share of the light that it scatters
  double water = 0.02;  ///< height of water that takes up all of it [mm]
  double blur_lod = 4;  ///< the blur behind it is over a disc whose radius is a texel of this level
  double veil = 0.25;   ///< share of the scattered light that comes from the whole scene
};

/// For the frame. In double, each rounded once.
CondenseUniforms condense_uniforms(const CondensationSettings& settings, const SurfaceSettings& surface, int frame);
/// For a pane with this composite.
MistUniforms mist_uniforms(const CondensationSettings& settings, const CompositeUniforms& seen);
/// Taps of its blur, for a picture of the scene of this size: the centre of a disc, whose radius R is a texel of level blur_lod, and eight
/// points at 3/4 R. They have the variance of the disc, R^2 / 4 on each axis, which a bilinear lookup in that level also has.
std::vector<Tap> mist_taps(const CondensationSettings& settings, int scene_width, int scene_height);
/// Glass that was never cleared: clear_time at its limit.
Image make_clear_time(const CondensationSettings& settings, const SurfaceSettings& surface);

}  // namespace rainref::windshield
