// Pass wipe_drops over all drops and the film.
#pragma once

#include <cstdint>
#include <span>

#include "windshield/motion/kernels.h"

namespace rainref::windshield {

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
