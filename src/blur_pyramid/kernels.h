// The shells of blur_pyramid: rows of texels in, rows of texels out, for the SIMD target in use.
#pragma once

#include "blur_pyramid/uniforms.h"
#include "rainref/executor.h"
#include "rainref/image.h"

namespace rainref::blur_pyramid {

/// Level 0. colour: rgba16f; depth: r32f [m]; out: rgba16f, alpha 1.
void fog_rows(const BlurUniforms& uniforms, Rounding rounding, const Image& colour, const Image& depth, Image& out,
              const parallel::Tile& tile);
/// A further level: rows of `out` from the level above; the tile must span the width.
void halve_rows(const BlurUniforms& uniforms, bool corrected, Rounding rounding, const Image& above, Image& out,
                const parallel::Tile& tile);

}  // namespace rainref::blur_pyramid
