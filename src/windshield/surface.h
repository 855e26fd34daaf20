// The passes on the windshield's textures, wipe_texture and normals: the host's values, and wipe_texture with its declaration.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "capture/pass_info.h"
#include "rainref/executor.h"
#include "rainref/image.h"
#include "scene/config.h"
#include "scene/parameter.h"
#include "windshield/normals.pass.h"
#include "windshield/uniforms.h"

namespace rainref::windshield {

struct WipeTextureUniforms {
  float frame[3];    ///< plane coordinates of a step in the texture: x of a column, x and y of a row [m/texel]
  float edge_width;  ///< over which coverage falls at a blade's edge [m]
  float axis_length[2];  ///< as-published: |e_u|, |e_v| [m]
  float strength;        ///< as-published: what full coverage takes off [mm]
  float keep;            ///< as-published: share of the mask that a frame leaves
  float dt;              ///< corrected: time since the frame before, whole on the grid of wiped_grid [s]
  float inverse_tau;     ///< corrected [1/s]
  float wiped_limit;     ///< corrected: what `wiped` grows to at most; never wiped [s]
  std::int32_t wiper_count;
};
static_assert(sizeof(WipeTextureUniforms) == 48);

/// What both passes need to know.
struct SurfaceSettings {
  bool corrected = false;
  int width = 1024, height = 592;  ///< of the textures [texel]
  Rounding rounding = Rounding::rne;
  double fps = 60;
  /// Of the glass [m]: as-published |e_u|, 0, |e_v|; corrected the plane frame.
  std::array<double, 3> frame{1, 0, 1};
  double half_width = 6e-3;  ///< of the narrowest blade [m]
  double wipe_strength = 10;  ///< as-published: what full coverage takes off [mm]
  double mask_tau = 4;       ///< time constant of the mask [s]
};
/// The scene keys wipe_strength and mask_tau, behind "prefix."; the rest of SurfaceSettings comes from elsewhere.
std::vector<scene::Parameter> surface_parameters(const std::string& prefix);
void read_surface(const scene::Config& config, const std::string& prefix, SurfaceSettings& settings);

/// Times since a wipe are whole multiples of this power of two, about tau / 2^19, so that float sums of them are exact up to
/// wiped_limit (about 32 tau), whatever the frame rate. [s]
double wiped_grid(double tau);
float wiped_limit(double tau);

/// Everything but the number of wipers, for the frame. In double, each rounded once.
WipeTextureUniforms wipe_texture_uniforms(const SurfaceSettings& settings, int frame);
NormalsUniforms normals_uniforms(const SurfaceSettings& settings);

/// State and outputs of wipe_texture; height is splat's.
struct WipedTextures {
  Image* height;  ///< r16f [mm]
  Image* mask;    ///< r16f
  Image* wiped;   ///< corrected: r32f, time since the last wipe [s]; else null
};
/// Dry or never wiped glass: mask 0, wiped at its limit.
Image make_mask(const SurfaceSettings& settings);
Image make_wiped(const SurfaceSettings& settings);

/// The pass, in place. uniforms.wiper_count is taken from the wipers.
void wipe_texture(const parallel::Executor& executor, WipeTextureUniforms uniforms, bool corrected, Rounding rounding,
                  std::span<const Wiper> wipers, const WipedTextures& textures);

capture::PassInfo wipe_texture_info();
/// mask and wiped; height is splat's, wipers another's.
std::vector<capture::BufferInfo> surface_buffers();

// The shells; tiles of whole rows.
void wipe_texture_rows(const WipeTextureUniforms& uniforms, bool corrected, Rounding rounding, const Wiper* wipers,
                       const WipedTextures& textures, const parallel::Tile& tile);

}  // namespace rainref::windshield
