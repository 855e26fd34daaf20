// Rays in a scene and their hits, component by component.
#pragma once

#include "compositor/columns.h"

namespace rainref::compositor {

/// Rays, and their weights in the pixels.
class RayColumns {
 public:
  static constexpr int count = 12;
  void make_room(std::size_t rays) { columns_.make_room(rays); }
  VecArraysOut origin() { return columns_.vectors(0); }
  VecArraysOut direction() { return columns_.vectors(3); }
  VecArraysOut weight() { return columns_.vectors(6); }  ///< share of its radiance in the pixel
  double* nearest() { return columns_[9]; }
  double* travelled() { return columns_[10]; }  ///< [m] of the previous rays, from the eye
  double* blur() { return columns_[11]; }
  VecArrays origin() const { return columns_.vectors(0); }
  VecArrays direction() const { return columns_.vectors(3); }
  VecArrays weight() const { return columns_.vectors(6); }
  const double* nearest() const { return columns_[9]; }
  const double* travelled() const { return columns_[10]; }
  const double* blur() const { return columns_[11]; }
  double* column(int i) { return columns_[i]; }
  const double* column(int i) const { return columns_[i]; }

 private:
  Columns<count> columns_;
};

/// Hits of rays on one surface, each with its ray.
class ArrivalColumns {
 public:
  void make_room(std::size_t places) { columns_.make_room(places); }
  VecArraysOut point() { return columns_.vectors(0); }
  VecArraysOut direction() { return columns_.vectors(3); }  ///< unit
  VecArraysOut normal() { return columns_.vectors(6); }     ///< geometric, on the surface's outside
  VecArraysOut weight() { return columns_.vectors(9); }     ///< the weight after absorption in the medium
  double* distance() { return columns_[12]; }               ///< [m] from the eye
  double* path() { return columns_[13]; }                   ///< [m] from the origin of the ray
  double* facing() { return columns_[14]; }                 ///< direction . normal: negative if the ray comes from outside
  double* blur() { return columns_[15]; }
  VecArrays point() const { return columns_.vectors(0); }
  VecArrays direction() const { return columns_.vectors(3); }
  VecArrays normal() const { return columns_.vectors(6); }
  VecArrays weight() const { return columns_.vectors(9); }
  const double* distance() const { return columns_[12]; }
  const double* path() const { return columns_[13]; }
  const double* facing() const { return columns_[14]; }
  const double* blur() const { return columns_[15]; }

 private:
  Columns<16> columns_;
};

}  // namespace rainref::compositor
