// What shading holds of a generation of rays.
#pragma once

#include <array>
#include <vector>

#include "compositor/path_batches.h"
#include "compositor/ray_columns.h"

namespace rainref::compositor {

/// Where a ray leads: nowhere, out of the scene, or to a ray of the next generation.
inline constexpr std::uint32_t nowhere = ~std::uint32_t{0}, has_escaped = std::uint32_t{1} << 31;

struct Rays {
  RayColumns columns;
  std::vector<Path> paths;
  std::size_t count = 0;
};

/// Room for the rays of one call, kept by each thread for its next one.
struct ShadingRoom {
  Rays now, next;
  std::vector<double> length, farthest, endless;
  std::vector<Hit> hits;
  std::vector<std::uint32_t> again;
  std::vector<Ray> rays_again;
  std::vector<Hit> hits_again;
  PathBatches batches;
  std::vector<std::uint32_t> order, next_order;  // of the paths: in which their light is added up
  // By slot: what the medium added and what the surface sent; the ray that is reflected or mirrored, and the refracted one.
  Columns<6> terms;
  std::vector<std::array<std::uint32_t, 2>> children;
  // Of a batch.
  ArrivalColumns arrivals;
  Columns<16> surface;  // smooth normals, shaded normals, a finish
  RayColumns refracted;
  std::vector<std::uint32_t> kept;
  // Of a generation: what met nothing, and then what was cut off, with its share in the pixel.
  Columns<7> escaped_rays;
  std::size_t escaped_count = 0;
  std::vector<Vec> cut_share, arrived;
};

}  // namespace rainref::compositor
