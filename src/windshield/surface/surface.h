// The passes on the windshield's textures, persist, wipe_texture and normals: the host's values and state.
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

struct SmearSettings {
  bool on = false;
  double wear = 0.3;        ///< 0 a new blade, 1 a ragged one: more and thicker streaks
  double drying = 0.6;      ///< time in which the thickest streak dries [s]
  double most = 0.8;        ///< share of the light that the thickest streak scatters
  double spread_deg = 3.5;  ///< angle beyond which none is turned
};

/// Everything but the number of wipers. In double, each rounded once.
SmearUniforms smear_uniforms(const SmearSettings& settings, const SurfaceSettings& surface);
/// Of a pane that is seen so, before a picture of the scene of this width.
SoftenUniforms soften_uniforms(const SmearSettings& settings, const CompositeUniforms& seen, int scene_width);
/// To both sides in even steps; the weights fall as the square of what is left to the spread, and their sum is 1.
std::vector<Deflection> deflections(const SmearSettings& settings);
/// r16f, one row: thickness of the film along a blade, from its inner end to its outer one, between 0 and 1: a thin film with a grain,
/// streaks at hashed places, and more at both ends, where the blade is pressed least. Chosen to look like it.
Image smear_profile(const SmearSettings& settings, std::uint64_t seed);
/// Glass that no blade passed.
Image make_laid(const SurfaceSettings& surface);

struct CondensationSettings {
  bool on = false;
  double tau = 20;      ///< time constant of its growth [s]
  double most = 0.85;   ///< what it grows to: share of the light that it scatters
  double water = 0.02;  ///< height of water that takes all of it up [mm]
  double blur_lod = 4;  ///< what shows through it is blurred over a disc whose radius is a texel of this level
  double veil = 0.25;   ///< share of the scattered light that comes from the scene as a whole
};

/// For the frame. In double, each rounded once.
CondenseUniforms condense_uniforms(const CondensationSettings& settings, const SurfaceSettings& surface, int frame);
/// Of a pane that is seen so.
MistUniforms mist_uniforms(const CondensationSettings& settings, const CompositeUniforms& seen);
/// What its blur is the mean of, of a picture of the scene of this size: the middle of a disc, whose radius R is a texel of level blur_lod,
/// and eight places at 3/4 R. They have the variance of the disc, R^2 / 4 on each axis, as a bilinear lookup in that level has.
std::vector<Tap> mist_taps(const CondensationSettings& settings, int scene_width, int scene_height);
/// Glass that was never cleared: clear_time at its limit.
Image make_clear_time(const CondensationSettings& settings, const SurfaceSettings& surface);

}  // namespace rainref::windshield
