// Pictures from rows of light: the mean of several samples per pixel, and its code.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "rainref/executor.h"
#include "rainref/image.h"
#include "scene/config.h"

namespace rainref::simulation {

/// Rows of a tile in loops over a picture.
inline constexpr int tile_rows = 8;

/// Light emitted by an sRGB display for a code, in [0, 1], and back. No libm.
double light_of(std::uint8_t code);
/// The code whose light is nearest.
std::uint8_t nearest_code(double light);
/// Returns one of the two codes around the light: the upper one if `u`, uniform in [0, 1), is below the position of the light between them.
/// The mean of the shown light is therefore the light. The light of a code gives that code.
std::uint8_t dithered_code(double light, double u);

/// Writes the light of row y of the samples: red, green, blue, sample by sample.
using RowOfLight = std::function<void(int y, std::span<double> light)>;
/// The codes of a pixel's light.
using CodesOf = std::function<void(int x, int y, const double* light, std::uint8_t* codes)>;

/// rgba8, alpha 1, width x height. Each pixel is the mean of the light around it, weighted by a tent that ends at the neighbours' centres,
/// n x n samples per pixel; n = 1 uses the samples themselves. Edge samples repeat outside. Both functions are called by any thread.
Image picture_of_means(int width, int height, int n, const RowOfLight& row_of, const CodesOf& codes_of, const parallel::Executor& executor);

/// The configuration that the effect is built with: run.size times run.supersample. Throws Error(usage) if that is too large.
scene::Config config_at_pass_size(const scene::Config& config);

/// rgba8 display codes at 1/n of the size in both directions. Each pixel is the mean of the light (sRGB decoded) around it, weighted by a
/// tent that ends at the neighbours' centres, n x n samples per pixel. Edge samples repeat outside. Light above white counts as white, so
/// that one bright sample does not dominate a pixel. Alpha is 1. n >= 2; n = 2 has weights 1 3 3 1 along each axis.
Image tent_mean(const Image& picture, int n, const parallel::Executor& executor);

}  // namespace rainref::simulation
