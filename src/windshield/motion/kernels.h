// The shells of windshield_frame and wipe_drops, for the SIMD target in use. They load, call the pass and store; they contain no
// arithmetic.
#pragma once

#include <cstdint>
#include <span>

#include "drops/records.h"
#include "rainref/executor.h"
#include "rainref/image.h"
#include "windshield/motion/windshield_frame.pass.h"
#include "windshield/motion/wipe_drops.pass.h"

namespace rainref::windshield {

drops::GlassFrame windshield_frame(const WindshieldFrameUniforms& uniforms, bool corrected);

/// Drops as a structure of arrays, one slot each; all arrays have one size. Slots with life <= 0 are not changed.
struct DropSpans {
  std::span<float> u, v, velocity_u, velocity_v, mass, life;
  std::span<const std::uint32_t> id;
};

/// wipe_drops for the slots [begin, end). corrected: wiper and bin, with room for these slots, receive the results of WipedDrop for the
/// live drops; else they may be null.
void wipe_drops_range(const WipeDropsUniforms& uniforms, bool corrected, const pass::HostIo<WipeDropsPass>& io, float* wiper, float* bin,
                      std::int64_t begin, std::int64_t end);

/// Texels outside which a record sweeps nothing.
struct TexelBox {
  int x0, y0, x1, y1;
};
/// corrected: sets the swept texels of [x0, x1) in row y to 0 and adds their contents to mass_units[wiper * bin_count + bin].
void wipe_film_row(const WipeDropsUniforms& uniforms, const Wiper* wipers, Image& film, int y, int x0, int x1, std::uint64_t* mass_units);

/// Texels of the film outside which a record sweeps nothing, with a margin of more than a texel.
TexelBox swept_texels(const Wiper& wiper, const WipeDropsUniforms& uniforms);

/// Moves the swept drops in place. Returns the mass units of water that left the glass.
///
/// corrected: `film` (r32f, whole mass units per texel, at most 2^24) becomes 0 where a record sweeps a texel's centre. Its water goes to
/// the captured drop with the lowest id in the same radial bin of that record, up to a mass of 2^24 mass units. The rest, and the water of
/// a bin without a drop, is removed, and so is a drop between two blades that meet. Drops + film
/// + the returned value is exactly conserved. as-published: film is not read and may be null; returns 0.
std::uint64_t wipe_drops(const WipeDropsUniforms& uniforms, bool corrected, std::span<const Wiper> wipers, const DropSpans& drops,
                         Image* film, const parallel::Executor& executor);

}  // namespace rainref::windshield
