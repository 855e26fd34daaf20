// Uniforms and textures, computed on the host from the settings and the inputs, in double, each rounded once.
#pragma once

#include <string>

#include "base/memory.h"
#include "base/rows.h"
#include "edge_splash/uniforms.h"
#include "image/texture.h"
#include "rainref/edge_splash.h"
#include "scene/camera.h"

namespace rainref::edge_splash {

/// Throws Error(usage) with the first problem for settings that cannot run.
void check(const Settings& settings);
scene::Camera camera(const Settings& settings);

PublishedSplashUniforms published_splash_uniforms(const Settings& settings, int frame, int noise_width, int noise_height);
SplashUniforms splash_uniforms(const Settings& settings, int frame, int noise_width, int noise_height);

/// Offset of a scroll of `velocity` tiles per second at frame / fps, in [0, 1). A product and a quotient of doubles, then the exact
/// fraction: the error is at most 2^-52 of the scrolled tiles.
double scrolled(double velocity, int frame, double fps);

/// Converts an image of four channels to rgba16f linear radiance.
Image prepare_scene(const Image& colour, bool is_encoded, const Rows& rows = rows_here);
/// Device depth, r32f, of the colour's size, from the first channel. Throws Error(usage) with the first value outside its range.
Image prepare_depth(const Image& depth, bool is_distance, const Image& colour, const DepthRange& range, const Rows& rows = rows_here);
/// r8, of the colour's size.
Image prepare_layer(const Image& layer, const Image& colour);
/// The noise as splash samples it: as published the map itself, r8; corrected the map at half its resolution, r32f.
Image prepare_noise(const Image& noise, const Settings& settings);
/// "" or a sentence: the map differs several times as much across its seams as between neighbours.
std::string seam_warning(const Image& noise);

/// A tile of gradient noise, side x side, r8, like that of the article's online tool.
Image make_noise(std::uint64_t seed, int side = 256);

inline constexpr int crown_side = 512;
/// A tile of splash crowns at this time [s], side x side, r32f: 0 where there is none, up to 1.
Image make_crowns(std::uint64_t seed, double time, int side = crown_side);

/// Storage format of colour: corrected has one alone.
inline Format colour_format(const Settings& s) { return s.variant == Variant::as_published ? s.storage : Format::rgba16f; }

/// Memory of the constructor and of frames, with a noise map of noise_side texels a side, without the inputs, which belong to the caller.
MemoryPeak memory(const Settings& settings, int noise_side = 256);

}  // namespace rainref::edge_splash
