// The film that blades leave behind them: what a scene says of it, and the host's values and state.
#pragma once

#include <cstdint>
#include <vector>

#include "rainref/image.h"
#include "windshield/picture/soften.pass.h"
#include "windshield/surface/smear.pass.h"
#include "windshield/surface/surface.h"

namespace rainref::windshield {

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

}  // namespace rainref::windshield
