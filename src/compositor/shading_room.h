// Working memory of shading for a generation of rays.
#pragma once

#include <array>
#include <vector>

#include "compositor/path_batches.h"
#include "compositor/ray_columns.h"

namespace rainref::compositor {

/// Destination of a ray: nowhere, out of the scene, or a ray of the next generation.
inline constexpr std::uint32_t nowhere = ~std::uint32_t{0}, has_escaped = std::uint32_t{1} << 31;

struct Rays {
  RayColumns columns;
  std::vector<Path> paths;
  std::size_t count = 0;
};

/// Memory for the rays of one call, kept by each thread for its next call.
struct ShadingRoom {
  Rays now, next;
  std::vector<double> length, farthest, endless;
  std::vector<Hit> hits;
  std::vector<std::uint32_t> again;
  std::vector<Ray> rays_again;
  std::vector<Hit> hits_again;
  PathBatches batches;
  std::vector<std::uint32_t> order, next_order;  // order in which the paths' light is added up
  // By slot: light added by the medium and sent by the surface; the reflected ray, and the refracted one.
  Columns<6> terms;
  std::vector<std::array<std::uint32_t, 2>> children;
  // For a batch.
  ArrivalColumns arrivals;
  Columns<16> surface;  // smooth normals, shaded normals, a finish
  RayColumns refracted;
  std::vector<std::uint32_t> kept;
  // For a generation: rays that hit nothing, then rays that were cut off, with their share in the pixel.
  Columns<7> escaped_rays;
  std::size_t escaped_count = 0;
  std::vector<Vec> cut_share, arrived;
};

}  // namespace rainref::compositor
