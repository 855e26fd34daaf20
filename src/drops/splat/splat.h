// Drops drawn into a height texture: what an effect sets, its uniforms, the pass itself, its declarations.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drops/host.h"
#include "drops/physics.h"
#include "drops/records.h"
#include "drops/splat/kernels.h"
#include "rainref/executor.h"
#include "rainref/image.h"
#include "scene/config.h"
#include "scene/parameter.h"

namespace rainref::drops {

struct SplatKeys {
  int width = 1024, height = 592;  ///< of the height texture [texel]
  SplatKernel kernel = SplatKernel::paraboloid;
  SplatBlend blend = SplatBlend::add;
  bool half_accumulation = true;  ///< as-published: each drop is rounded to half as a blending unit does; else once, after the last
  Rounding rounding = Rounding::rne;
  double drop_radius = 4e-3;     ///< as-published: of a drop of mass 1 [m]
  double drop_height = 0.8;      ///< as-published: of a drop of mass 1 [mm]
  double smallest_radius = 1.5;  ///< corrected: what a drop is drawn with at least [texel]
  double lean = 0;               ///< corrected: share in which held drops lean; 0: all are round
};
/// The scene keys of SplatKeys, behind "prefix.".
std::vector<scene::Parameter> splat_parameters(const std::string& prefix);
/// rounding: of an effect that says it under another key, and has no prefix.rounding.
SplatKeys splat_keys(const scene::Config& config, const std::string& prefix, std::optional<Rounding> rounding = {});

struct SplatSettings {
  bool corrected = false;
  SplatKeys keys;
  /// Of the glass [m]: as-published |e_u|, 0, |e_v|; corrected the plane frame.
  std::array<double, 3> frame{1, 0, 1};
  double contact_angle = 0.6;  ///< corrected: of the drops' caps, in (0, pi) [rad]
};
/// What pulls on the drops of a glass, over what hysteresis holds, for a drop of one mass unit; in axes of the plane.
struct Pull {
  std::array<double, 2> gravity{}, wind{};
  Wetting wetting{};  ///< how steep drops are where they advance and recede
};
/// glass_frame as integrate takes it, of a corrected glass.
Pull pull_on_drops(const Settings& settings, const PlaneFrame& frame, const GlassFrame& glass);

/// Base radius of a spherical cap of one mass unit of water [m]; that of m mass units is m^(1/3) times as large.
double cap_radius(double contact_angle);
/// Volume under a kernel of radius 1 and height 1.
double kernel_volume(SplatKernel kernel);
/// Mean of the squared distance from a line through its middle, under such a kernel.
double kernel_moment(SplatKernel kernel);
/// Everything but the number of drops. In double, each rounded once.
SplatUniforms splat_uniforms(const SplatSettings& settings);
/// With drops that lean, as far as the settings say. One that is just held is 1.3 times as long as round, which is chosen, as its taper
/// is; its slopes at both ends are as the tangents of the contact angles.
SplatUniforms splat_uniforms(const SplatSettings& settings, const Pull& pull);

/// Room that splat works in, kept from frame to frame.
struct SplatScratch {
  std::vector<StampChunk> chunks;
};
/// The pass: height (r16f, of uniforms.size) is cleared and drawn anew. Drops in slot order; dead ones draw nothing.
/// uniforms.drop_count is taken from them. film: r32f of the same size, or null for none; corrected only, with float
/// accumulation. necks: in ascending id, of some of the drops; corrected only.
void splat(const parallel::Executor& executor, SplatUniforms uniforms, bool half_accumulation, Rounding rounding,
           std::span<const Drop> drops, std::span<const Neck> necks, const Image* film, Image& height, SplatScratch& scratch);

}  // namespace rainref::drops
