// The shells of windshield_frame and wipe_drops, for the SIMD target in use. They load, call the pass and store; they
// know no arithmetic.
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

/// Drops as a structure of arrays, a slot each; all of one size. Slots with life <= 0 are left alone.
struct DropSpans {
  std::span<float> u, v, velocity_u, velocity_v, mass, life;
  std::span<const std::uint32_t> id;
};

/// wipe_drops for the slots [begin, end). corrected: wiper and bin, room for these slots, take what WipedDrop says of the live ones; else
/// they may be null.
void wipe_drops_range(const WipeDropsUniforms& uniforms, bool corrected, const pass::HostIo<WipeDropsPass>& io, float* wiper, float* bin,
                      std::int64_t begin, std::int64_t end);

/// Texels outside of which a record sweeps none.
struct TexelBox {
  int x0, y0, x1, y1;
};
/// corrected: sets what is swept of the texels [x0, x1) of row y to 0 and adds what they held to mass_units[wiper * bin_count + bin].
void wipe_film_row(const WipeDropsUniforms& uniforms, const Wiper* wipers, Image& film, int y, int x0, int x1, std::uint64_t* mass_units);

/// Texels of the film outside of which a record sweeps none, with more than a texel to spare.
TexelBox swept_texels(const Wiper& wiper, const WipeDropsUniforms& uniforms);

/// Moves the drops that the records sweep, in place. Returns the mass units of water that left the glass.
///
/// corrected: `film` (r32f, whole mass units in each texel, at most 2^24) becomes 0 where a record sweeps a texel's centre.
/// What it held goes to the captured drop of lowest id in the same radial bin of that record, up to 2^24 mass units of
/// mass; the rest, and all of a bin without a drop, is removed. So is a drop between two blades that meet. Drops + film
/// + what is returned is the same before and after, to the unit. as-published: film is not read and may be null;
/// returns 0.
std::uint64_t wipe_drops(const WipeDropsUniforms& uniforms, bool corrected, std::span<const Wiper> wipers, const DropSpans& drops,
                         Image* film, const parallel::Executor& executor);

}  // namespace rainref::windshield
