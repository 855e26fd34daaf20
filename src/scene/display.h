// The last pass of every effect but the puddle, which has a vignette: linear radiance to sRGB codes. The scene key is
// display.exposure; capture/display.h declares the pass and binds it.
#pragma once

#include "image/code_table.h"
#include "rainref/executor.h"
#include "rainref/image.h"
#include "rainref/storage.h"

namespace rainref::scene {

struct DisplayUniforms {
  float exposure;  ///< factor of the radiance
  float padding0, padding1, padding2;
};
static_assert(sizeof(DisplayUniforms) == 16);

/// exposure: [EV].
DisplayUniforms display_uniforms(double exposure);

/// colour: rgba16f; picture: rgba8, alpha 1.
void display_rows(const DisplayUniforms& uniforms, Rounding rounding, const Image& colour, Image& picture, const parallel::Tile& tile);
/// The same by table, for pictures of this size.
CodeTable display_table(int width, int height, double exposure, Rounding rounding);

}  // namespace rainref::scene
