// The shells of the puddle's passes, from rows of texels to rows of texels, for the SIMD target in use. They load, call the pass and store;
// they contain no arithmetic.
#pragma once

#include <span>
#include <vector>

#include "image/code_steps.h"
#include "pass/definition.h"
#include "puddle/shade.pass.h"
#include "puddle/uniforms.h"
#include "rainref/executor.h"
#include "rainref/image.h"
#include "rainref/puddle.h"

namespace rainref::puddle {

struct WaveJob {
  WaveStepUniforms uniforms;
  bool corrected;
  Rounding rounding;
  Boundary boundary;
  Image* newest;          ///< ghost columns filled; corrected: wave_previous_rows adds the drops to it
  Image* previous;        ///< in: the previous level; out: the next one, ghost columns filled
  const Image* rest_row;  ///< one row at rest, for Boundary::fixed
  const Image* shore;     ///< r32f, or null
  std::span<const Drop> drops;
};

/// A drop adds exactly nothing beyond its radius, so every selection of drops that includes those reaching a place gives the same bits
/// there.
inline bool reaches_rows(const Drop& d, int y0, int y1) {
  return d.y + d.radius >= static_cast<float>(y0) && d.y - d.radius <= static_cast<float>(y1);
}
/// The address rule beyond the edge of the wave.
constexpr Address address_of(Boundary boundary) {
  return boundary == Boundary::periodic ? Address::repeat : boundary == Boundary::fixed ? Address::border : Address::clamp;
}

/// Encodes stored values, `width` to a row, into a plane, ghost columns included.
void encode_rows(const float* stored, Image& plane, Boundary boundary, float rest, Rounding rounding);

/// Rows [y0, y1) of both levels that a later call will read.
struct RowsAhead {
  int y0 = 0, y1 = 0;
};
/// wave_step over whole rows; the tile must span the width. It also prefetches rows of `ahead`, as many as it has time for, so that later
/// calls need not wait for memory. Returns the rows that are left.
RowsAhead wave_step_rows(const WaveJob& job, const parallel::Tile& tile, RowsAhead ahead = {});
/// The second output of the corrected wave_step: adds the drops to `newest`, in place, where they touch it. Call it after all steps that
/// read these rows.
void wave_previous_rows(const WaveJob& job, const parallel::Tile& tile);
/// Decodes rows of a single-channel plane to floats, `width` to a row.
void decode_rows(const Image& plane, float* out, const parallel::Tile& tile);
/// Largest |s - rest| of a block of cells, and largest difference between one of them and its neighbour to the right or below, both of
/// stored values; beyond the edge of the plane the neighbour is at rest.
struct Extent {
  float height, difference;
};
constexpr int extent_block = 32;  ///< cells on a side of a block
/// The extents of the blocks in one row of blocks, left to right; the tile holds these rows, whole.
void extents_of_rows(const float* decoded, int width, int height, float rest, const parallel::Tile& tile, Extent* blocks);

/// as published: drop i of the frame for i in [0, uniforms.drop_count).
std::vector<Drop> raindrops_as_published(const RaindropsUniforms& uniforms);

/// shade, corrected, with a ground_reach. It has the output of the pass, but is faster where only the surroundings' own ground is visible.
/// No texel of the environment or the ground may be 1e12 or larger. colour: the image that io writes. kept: an image of its size and
/// format, zero at first; pass the same one for the same uniforms, environment and rounding.
void shade_or_background(const ShadeUniforms& u, Rounding rounding, const pass::HostIo<ShadePass>& io, Image& colour, Image& kept,
                         const parallel::Tile& tile);
/// display, corrected, for a radiance that already includes exposure and vignette: the codes of [0, 1].
CodeSteps display_steps(Rounding rounding);
/// The same for each of count numbers, by the pass's own arithmetic.
void display_codes(Rounding rounding, const float* x, std::uint8_t* code, int count);
/// display, corrected, by these steps, with the output of the pass.
void display_by_steps(const DisplayUniforms& u, const CodeSteps& steps, const Image& colour, Image& picture, const parallel::Tile& tile);

/// Several steps over the whole wave. The two levels alternate: `newest` of one job is `previous` of the next. The bits are those of
/// separate steps, in less time, because rows pass through all steps while they are in a cache.
void step_wave(std::span<const WaveJob> jobs, const parallel::Executor& executor);

}  // namespace rainref::puddle
