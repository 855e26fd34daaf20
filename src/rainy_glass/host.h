// Uniforms and records of the bakes, computed on the host in double, each rounded once; and the geometry of the glass.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "base/memory.h"
#include "base/rows.h"
#include "cache/recipe.h"
#include "image/texture.h"
#include "rainref/image.h"
#include "rainref/rainy_glass.h"
#include "rainy_glass/uniforms.h"
#include "scene/camera.h"

namespace rainref::rainy_glass {

/// Storage of a number n of [-1, 1] in a map: neutral + span n. With 8 bits, corrected, code 128 is exactly 0.
struct Code {
  double neutral, span;
};
Code code_of(const Settings& settings, Format stored);

/// Throws Error(usage) with the first problem for settings that cannot run.
void check(const Settings& settings);
/// The same for images.
void check(const Settings& settings, const Surroundings& surroundings);
void check_scene(const Settings& settings, const Image& colour, const Image& depth);

scene::Camera camera(const Settings& settings);
/// The horizontal direction of the view; -z if it is vertical.
scene::Vector3 level_forward(const Settings& settings);
/// Horizontal unit vector against the wind that carries the rain: the normal of upright glass that faces it.
scene::Vector3 facing(const Settings& settings);

/// Droplets that do not overlap, largest first; droplets without room are left out.
std::vector<Droplet> make_droplets(const Settings& settings);
std::vector<Trail> make_trails(const Settings& settings);
/// Unit gradients, 2 flow_cells a side: channels 0, 1 for the flow across the glass, 2, 3 along it.
Image make_lattice(const Settings& settings);

BakeRaindropsUniforms bake_raindrops_uniforms(const Settings& settings, int droplet_count);
BakeRivuletsUniforms bake_rivulets_uniforms(const Settings& settings, int trail_count);
/// raindrops, rivulets: formats of the maps before they were stored (8-bit files keep their own neutral code).
RainOnGlassUniforms rain_on_glass_uniforms(const Settings& settings, int frame, Code raindrops, Code rivulets);

/// The droplets of `all`, in order, that may count in texels [x0, x1) x [y0, y1) of a map of `size` texels, because they cover some of it
/// or are nearest to some of it. Leaving out the others changes no bit.
std::vector<Droplet> droplets_near(std::span<const Droplet> all, bool corrected, int size, int x0, int y0, int x1, int y1);
/// The trails whose water may reach there.
std::vector<Trail> trails_near(std::span<const Trail> all, int size, int x0, int y0, int x1, int y1);

/// Inputs of the glass besides normals.
using GlassReads =
    cache::Only<&Settings::width, &Settings::height, &Settings::shape, &Settings::distance, &Settings::yaw_deg, &Settings::radius,
                &Settings::camera_position, &Settings::camera_target, &Settings::camera_up, &Settings::vertical_fov_deg>;
/// Fills surface (rgba32f) and orientation (rgba16f) of the picture's size.
void make_surface(const Settings& settings, const Image& normals, Image& surface, Image& orientation, const Rows& rows = rows_here);
/// Smallest depth of each texel and its eight neighbours, minus a margin for rounding. If a bilinear lookup gives more than z, it reads no
/// texel of depth z or less.
Image near_depth(const Image& depth, const Rows& rows = rows_here);

/// Columns and rows of the pictures that have their own size.
struct PictureSizes {
  std::array<int, 2> probe{1024, 512};
  std::array<int, 2> raindrops{0, 0}, rivulets{0, 0};  ///< 0: baked
};
PictureSizes sizes_of(const Surroundings& surroundings);

/// Memory of the constructor and of frames, without the pictures, which belong to the caller.
MemoryPeak memory(const Settings& settings, const PictureSizes& sizes = {});
/// Throws Error(usage) if it does not fit.
void check_memory(const Settings& settings, const PictureSizes& sizes = {});

/// Four channels as halves, to nearest even. Negative colours, which resampled pictures may have, become 0; those above the largest half
/// become 65504.
Image colour_as_half(const Image& image, const Rows& rows = rows_here);
/// A map in its storage format, to nearest even.
Image stored_map(const Image& map, Format format);

}  // namespace rainref::rainy_glass
