// Draws drops into a height texture: the settings of an effect, its uniforms, the pass and its declarations.
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
  bool half_accumulation = true;  ///< as-published: round to half after each drop, as a blending unit does; else once, after the last
  Rounding rounding = Rounding::rne;
  double drop_radius = 4e-3;     ///< as-published: for a drop of mass 1 [m]
  double drop_height = 0.8;      ///< as-published: for a drop of mass 1 [mm]
  double smallest_radius = 1.5;  ///< corrected: smallest radius with which a drop is drawn [texel]
  double lean = 0;               ///< corrected: strength of the lean of held drops; 0: all are round
};
/// The scene keys of SplatKeys, with "prefix." before them.
std::vector<scene::Parameter> splat_parameters(const std::string& prefix);
/// rounding: for an effect that has it under another key and lacks prefix.rounding.
SplatKeys splat_keys(const scene::Config& config, const std::string& prefix, std::optional<Rounding> rounding = {});

struct SplatSettings {
  bool corrected = false;
  SplatKeys keys;
  /// Frame of the glass [m]: as-published |e_u|, 0, |e_v|; corrected the plane frame.
  std::array<double, 3> frame{1, 0, 1};
  double contact_angle = 0.6;  ///< corrected: of the caps of the drops, in (0, pi) [rad]
};
/// The pull on the drops of a glass divided by what hysteresis holds, for a drop of one mass unit, in axes of the plane.
struct Pull {
  std::array<double, 2> gravity{}, wind{};
  Wetting wetting{};  ///< slopes of drops at their advancing and receding sides
};
/// glass: the frame that integrate takes, of a corrected glass.
Pull pull_on_drops(const Settings& settings, const PlaneFrame& frame, const GlassFrame& glass);

/// Base radius [m] of a spherical cap of one mass unit of water; for m mass units it is m^(1/3) times as large.
double cap_radius(double contact_angle);
/// Volume under a kernel of radius 1 and height 1.
double kernel_volume(SplatKernel kernel);
/// Mean of the squared distance from a line through its centre, under such a kernel.
double kernel_moment(SplatKernel kernel);
/// Everything except the number of drops. In double, each rounded once.
SplatUniforms splat_uniforms(const SplatSettings& settings);
/// The same with drops that lean as the settings say. A drop that is just held is 1.3 times as long as a round one; this value and its
/// taper are chosen. Its slopes at both ends have the ratio of the tangents of the contact angles.
SplatUniforms splat_uniforms(const SplatSettings& settings, const Pull& pull);

/// Working memory of splat, kept between frames.
struct SplatScratch {
  std::vector<StampChunk> chunks;
};
/// The pass: clears height (r16f, of uniforms.size) and draws it again. Drops are in slot order; dead ones draw nothing.
/// uniforms.drop_count is set from them. film: r32f of the same size, or null for none; corrected only, with float accumulation. necks: for
/// some of the drops, in ascending id; corrected only.
void splat(const parallel::Executor& executor, SplatUniforms uniforms, bool half_accumulation, Rounding rounding,
           std::span<const Drop> drops, std::span<const Neck> necks, const Image* film, Image& height, SplatScratch& scratch);

}  // namespace rainref::drops
