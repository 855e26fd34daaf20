// The bed of the puddle, and the asphalt around it. Computed once on the host, in double.
#pragma once

#include "image/texture.h"
#include "rainref/image.h"
#include "rainref/puddle.h"

namespace rainref::puddle {

/// Water depth over the puddle's rectangle [m], r32f, negative where the ground is above the water. Border: dry for a natural shore, the
/// full depth for a basin.
TextureData make_bed(const Settings& settings);

/// Factor of the shore on the wave in each step, on the wave's grid, r32f: 1 where the water is at least twice shore_width deep, 0 on dry
/// ground, smooth between.
Image make_shore(const Settings& settings, const Texture& bed);

/// A tile of asphalt, 512x512 rgba32f, linear albedo in rgb and height in a (0 to 1).
Image make_asphalt(std::uint64_t seed);

/// Slopes (-dh/du, -dh/dv) of a ground tile, two channels with mips. The height is the alpha channel of generated asphalt, or the luminance
/// of a picture.
TextureData make_relief(const TextureData& ground, bool height_in_alpha, const Rows& rows = rows_here);

}  // namespace rainref::puddle
