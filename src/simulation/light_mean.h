// Pictures out of rows of light: the mean of several samples a pixel, and the code that shows it.
#pragma once

#include <cstdint>
#include <functional>
#include <span>

#include "rainref/executor.h"
#include "rainref/image.h"
#include "scene/config.h"

namespace rainref::simulation {

/// Of the tiles in loops over a picture.
inline constexpr int tile_rows = 8;

/// Light that a code of an sRGB display gives off, in [0, 1], and back. No libm.
double light_of(std::uint8_t code);
/// The code whose own is nearest to that of the light.
std::uint8_t nearest_code(double light);
/// One of the two codes beside the light, the upper one when `u`, uniform in [0, 1), is below the light's share of the way between them:
/// the mean of what is shown is the light. Light of a code gives that code.
std::uint8_t dithered_code(double light, double u);

/// Writes the light of row y of the samples: red, green, blue of one after the other.
using RowOfLight = std::function<void(int y, std::span<double> light)>;
/// The codes of a pixel's light.
using CodesOf = std::function<void(int x, int y, const double* light, std::uint8_t* codes)>;

/// rgba8, alpha 1, of width x height: each pixel the mean of the light around it, weighed by a tent that ends at the neighbours' centres,
/// n x n samples a pixel; n = 1 takes the samples themselves. Beyond an edge the edge's samples repeat. Both are called by any thread.
Image picture_of_means(int width, int height, int n, const RowOfLight& row_of, const CodesOf& codes_of, const parallel::Executor& executor);

/// The configuration that the effect is built with: run.size times run.supersample. Throws Error(usage) where that is too large.
scene::Config config_at_pass_size(const scene::Config& config);

/// rgba8 display codes of 1/n of the size in both directions: the mean of the light (sRGB decoded) around each pixel, weighed by a tent
/// that ends at the neighbours' centres, n x n samples a pixel. Beyond an edge the edge's samples repeat. Light above white counts as
/// white, so one bright sample does not outshine a pixel. Alpha is 1. n from 2; n = 2 has weights 1 3 3 1 along each axis.
Image tent_mean(const Image& picture, int n, const parallel::Executor& executor);

}  // namespace rainref::simulation
