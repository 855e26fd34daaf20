// What shading asks of many places at once, evaluated in lanes of doubles: the bits of the same formulas one by one.
// Arrays go on to whole lanes.
#pragma once

#include <span>

#include "compositor/environments.h"
#include "compositor/ray_columns.h"
#include "compositor/scene.h"

namespace rainref::compositor {

/// PictureEnvironment::radiance.
void look_up(const Texture& texture, bool is_cube, const Rotation& rotation, const EscapedRays& escaped_rays, std::span<Vec> radiance);

/// Some of the rays, in ascending order; the list goes on to whole lanes, repeating the last one. Beside it what is the same
/// for all rays.
struct RayList {
  const RayColumns& rays;
  const double* length;  ///< of the directions, by ray; null where they are unit
  std::span<const std::uint32_t> which;
};

/// The lengths of vectors.
void measure(std::size_t count, const VecArrays& vectors, double* lengths);
/// The rays of the list, for a lookup of what they see.
void collect_escaped(const RayList& list, const VecArraysOut& origin, const VecArraysOut& direction, double* blur);
/// Where the rays met a surface, arrivals.normal() being known, and through `medium`: what is left of their weights, and what it added to
/// their pixels.
void arrive(const RayList& list, const Hit* hits, const Medium& medium, ArrivalColumns& arrivals, const VecArraysOut& added);
/// The rays that an interface makes of those that arrived, the reflected ones put from the column's `first` number on, and the
/// normals that decided, against the rays; smooth_normals may be null.
void cross_interfaces(std::size_t count, const ArrivalColumns& arrivals, const VecArrays* smooth_normals, double ior_outside,
                      double ior_inside, RayColumns& reflected, std::size_t first, RayColumns& refracted, const VecArraysOut& shaded);
/// What finishes send to the pixels, the rays that they mirror, put from `first` on, and about which normals.
void leave_finishes(std::size_t count, const ArrivalColumns& arrivals, const Finishes& finishes, RayColumns& mirrored, std::size_t first,
                    const VecArraysOut& sent, const VecArraysOut& shaded);

}  // namespace rainref::compositor
