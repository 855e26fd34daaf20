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

}  // namespace rainref::windshield
