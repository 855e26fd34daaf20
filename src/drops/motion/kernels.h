// The shells of this room's passes, from ranges of slots to ranges of slots, for the SIMD target in use.
#pragma once

#include <cstdint>
#include <vector>

#include "drops/drops.h"
#include "drops/motion/integrate.pass.h"
#include "drops/motion/merge_grid.h"
#include "drops/records.h"
#include "drops/uniforms.h"

namespace rainref::drops {

/// The arrays of a DropArrays. A range begins at a multiple of 64 slots.
struct Slots {
  float *u, *v, *velocity_u, *velocity_v, *mass, *life;
  explicit Slots(DropArrays& d)
      : u(d.u().data()),
        v(d.v().data()),
        velocity_u(d.velocity_u().data()),
        velocity_v(d.velocity_v().data()),
        mass(d.mass().data()),
        life(d.life().data()) {}
};

/// as-published, the balance counts the ended lives as removed.
MassBalance integrate_range(const IntegrateUniforms& uniforms, bool corrected, const pass::HostIo<IntegratePass>& io, std::int64_t begin,
                            std::int64_t end);

/// Writes plane coordinates and base radius [m] of slots, including free ones, into arrays with room for a whole vector beyond `end`.
void measure_range(const MergeUniforms& uniforms, const Slots& slots, std::int64_t begin, std::int64_t end, float* x, float* y,
                   float* radius);
/// For each of the sorted drops [begin, end): the index of the drop that it points to, or -1.
void find_larger_range(const MergeGrid& grid, std::int64_t begin, std::int64_t end, std::int32_t* larger);

/// Whole mass units for one texel of the film.
struct Deposit {
  std::int32_t column, row;
  float mass_units;
};
/// Takes the trails from the drops and appends them in slot order.
void trail_range(const MergeUniforms& uniforms, const Slots& slots, std::int64_t begin, std::int64_t end, std::vector<Deposit>& deposits);
/// Dries a row of the film and returns the lost mass units.
std::int64_t dry_row(const MergeUniforms& uniforms, float* row, int width);

}  // namespace rainref::drops
