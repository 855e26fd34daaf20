// The shells of the passes: rows of texels in, rows of texels out, for the SIMD target in use.
#pragma once

#include "edge_splash/uniforms.h"
#include "image/texture.h"
#include "rainref/executor.h"
#include "rainref/image.h"
#include "rainref/storage.h"

namespace rainref::edge_splash {

struct SplashInputs {
  const Image* scene;                  ///< rgba16f
  const Texture *depth, *noise_map;    ///< one channel each; depth: clamp, as-published both: border 0
  const Image* layer;                  ///< r8; as-published does not look at it
};
/// Masks r8, colour rgba16f.
struct SplashOutputs {
  Image *edge, *angle, *noise, *colour;
};
void splash_rows(const PublishedSplashUniforms& uniforms, Rounding rounding, const SplashInputs& in, const SplashOutputs& out, const parallel::Tile& tile);
void splash_rows(const SplashUniforms& uniforms, Rounding rounding, const SplashInputs& in, const SplashOutputs& out, const parallel::Tile& tile);

}  // namespace rainref::edge_splash
