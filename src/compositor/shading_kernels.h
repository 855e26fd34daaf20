// Operations of shading on many positions at once, in lanes of doubles, with the same bits as the formulas one by one. Arrays are padded to
// whole lanes.
#pragma once

#include <span>

#include "compositor/environments.h"
#include "compositor/ray_columns.h"
#include "compositor/scene.h"

namespace rainref::compositor {

/// PictureEnvironment::radiance.
void look_up(const Texture& texture, bool is_cube, const Rotation& rotation, const EscapedRays& escaped_rays, std::span<Vec> radiance);

/// Some of the rays, in ascending order; the list is padded to whole lanes by repeating the last one. Also values that are the same for all
/// rays.
struct RayList {
  const RayColumns& rays;
  const double* length;  ///< of the directions, by ray; null if they are unit vectors
  std::span<const std::uint32_t> which;
};

/// The lengths of vectors.
void measure(std::size_t count, const VecArrays& vectors, double* lengths);
/// Collects the rays of the list for a lookup of the surroundings.
void collect_escaped(const RayList& list, const VecArraysOut& origin, const VecArraysOut& direction, double* blur);
/// Moves the rays through `medium` to their hits, with arrivals.normal() known: updates their weights, and adds the medium's light to their
/// pixels.
void arrive(const RayList& list, const Hit* hits, const Medium& medium, ArrivalColumns& arrivals, const VecArraysOut& added);
/// The rays that interfaces make of those that arrived, with the reflected ones stored from the column's number `first` on, and the normals
/// that were used, against the rays; smooth_normals may be null.
void cross_interfaces(std::size_t count, const ArrivalColumns& arrivals, const VecArrays* smooth_normals, double ior_outside,
                      double ior_inside, RayColumns& reflected, std::size_t first, RayColumns& refracted, const VecArraysOut& shaded);
/// The light that finishes send to the pixels, the rays that they reflect, stored from `first` on, and the normals of the reflections.
void leave_finishes(std::size_t count, const ArrivalColumns& arrivals, const Finishes& finishes, RayColumns& mirrored, std::size_t first,
                    const VecArraysOut& sent, const VecArraysOut& shaded);

}  // namespace rainref::compositor
