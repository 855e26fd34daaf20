// Uniforms, taps, noise and layout of the layers, computed on the host in double, each rounded once.
#pragma once

#include <array>
#include <vector>

#include "base/memory.h"
#include "base/rows.h"
#include "rainref/screen_drops.h"
#include "scene/camera.h"
#include "screen_drops/uniforms.h"

namespace rainref::screen_drops {

/// Throws Error(usage) with the first problem for settings that cannot run.
void check(const Settings& settings);
/// The same for images.
void check(const Settings& settings, const Inputs& inputs);
void check_scene(const Settings& settings, const Image& colour);

scene::Camera camera(const Settings& settings);
/// The camera of the scene's picture; for corrected, wider than the picture's by scene_margin.
scene::Camera scene_camera(const Settings& settings);

/// The grids of the corrected window. Layer l has cells with a side of cell_over_radius largest_radius / 2^l.
constexpr double cell_over_radius = 2.5;
struct Layer {
  double cells_per_pixel;
  std::array<float, 2> offset;  ///< of the picture's corner [cell]; multiples of 2^-16, from the seed
  int columns, rows, first_row;
};
std::array<Layer, layers> make_layers(const Settings& settings);
/// Columns and rows of the buffer of cells.
std::array<int, 2> cells_size(const std::array<Layer, layers>& all);

/// Points uniformly spread over a disc: tap k is at radius sqrt((k + 1/2) / count), rotated by the golden angle from the last (H. Vogel, "A
/// better way to construct the sunflower head", 1979).
std::vector<Tap> make_taps(const Settings& settings);
BackgroundUniforms background_uniforms(const Settings& settings);
PublishedDropsUniforms published_drops_uniforms(const Settings& settings, int frame);
CellsUniforms cells_uniforms(const Settings& settings, const std::array<Layer, layers>& all, int frame);
/// flow: columns and rows of the height of flowing water over the whole picture; 0: none.
DropsUniforms drops_uniforms(const Settings& settings, const std::array<Layer, layers>& all, const std::array<int, 2>& flow);

/// White noise, rgba8, each byte drawn from the seed.
Image make_noise(std::uint64_t seed, int side);
/// The noise as the passes read it: rgba8.
Image stored_noise(const Image& noise);
/// The scene and its mip levels as rgba16f, each level computed from the halves of the last. Negative colours become 0, those above the
/// largest half 65504.
std::vector<Image> scene_levels(const Image& colour, const Rows& rows = rows_here);

/// Memory of the constructor and of frames, with noise of noise_size texels a side, without the inputs, which belong to the caller. flow:
/// of the effect, after this many seconds of rain.
MemoryPeak memory(const Settings& settings, const FlowSettings* flow = nullptr, double seconds = 0);

}  // namespace rainref::screen_drops
