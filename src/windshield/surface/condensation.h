// The mist of condensed water on the glass: what a scene says of it, and the host's values and state.
#pragma once

#include <vector>

#include "rainref/image.h"
#include "windshield/picture/mist.pass.h"
#include "windshield/surface/condense.pass.h"
#include "windshield/surface/surface.h"

namespace rainref::windshield {

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
