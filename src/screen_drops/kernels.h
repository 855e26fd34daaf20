// The shells of the passes: rows of texels in, rows of texels out, for the SIMD target in use. They load, call the pass and
// store; they know no arithmetic.
#pragma once

#include <span>

#include "image/stored_texture.h"
#include "rainref/executor.h"
#include "rainref/image.h"
#include "screen_drops/uniforms.h"

namespace rainref::screen_drops {

/// background: rgba16f, alpha 1. scene: four channels with mips, clamped.
void background_rows(const BackgroundUniforms& uniforms, bool corrected, Rounding rounding, const StoredTexture<Half>& scene, std::span<const Tap> taps, Image& background, const parallel::Tile& tile);

struct DropsInputs {
  StoredTexture<Half> scene;
  const Texture* noise;         ///< as-published, repeats
  StoredTexture<float> cells;   ///< corrected
  StoredTexture<Half> height;   ///< corrected
  const Image* background;
};
/// water: r8; colour: rgba16f, alpha 1.
void drops_rows(const PublishedDropsUniforms& uniforms, Rounding rounding, const DropsInputs& in, Image& water, Image& colour, const parallel::Tile& tile);
void drops_rows(const DropsUniforms& uniforms, Rounding rounding, const DropsInputs& in, Image& water, Image& colour, const parallel::Tile& tile);

}  // namespace rainref::screen_drops
