// Antialiasing of whole pictures: the passes run at a multiple of run.size, and the picture is a filtered mean of theirs.
#pragma once

#include "rainref/executor.h"
#include "rainref/image.h"
#include "scene/config.h"

namespace rainref::simulation {

/// The configuration that the effect is built with: run.size times run.supersample. Throws Error(usage) where that is too large.
scene::Config config_at_pass_size(const scene::Config& config);

/// rgba8 display codes of 1/n of the size in both directions: the mean of the light (sRGB decoded) around each pixel, weighed by a tent
/// that ends at the neighbours' centres, n x n samples a pixel. Beyond an edge the edge's samples repeat. Light above white counts as
/// white, so one bright sample does not outshine a pixel. Alpha is 1. n from 2; n = 2 has weights 1 3 3 1 along each axis.
Image tent_mean(const Image& picture, int n, const parallel::Executor& executor);

}  // namespace rainref::simulation
