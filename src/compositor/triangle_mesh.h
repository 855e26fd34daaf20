// Triangles from arrays.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "compositor/surface.h"

namespace rainref::compositor {

struct MeshData {
  std::vector<Vec> positions;                           ///< [m]
  std::vector<std::array<std::uint32_t, 3>> triangles;  ///< vertex numbers, counter-clockwise seen from outside
  std::vector<Vec> normals;                             ///< of the vertices, unit; or none
};

/// One part, and one primitive, for each triangle; a ray meets them from both sides. A hit's u and v are the weights of
/// the triangle's second and third vertex.
///
/// Watertight (Woop, Benthin, Wald: "Watertight Ray/Triangle Intersection", JCGT 2013, here in double): each vertex is
/// projected along the ray by an expression of its own alone, and a product is compared with a product, whose roundings
/// cannot exchange them; what they make equal counts as inside. So a ray through a shared edge or vertex meets a triangle.
class TriangleMesh final : public Surface {
 public:
  /// Throws Error(usage) when a triangle names a vertex that is not there, or the normals are neither none nor one each.
  explicit TriangleMesh(MeshData data);

  const MeshData& data() const { return data_; }
  /// The vertices' normals, interpolated and made unit; without them, normal().
  Vec smooth_normal(const Ray& ray, const Hit& hit) const;

  std::uint32_t primitives() const override { return static_cast<std::uint32_t>(data_.triangles.size()); }
  Box bounds(std::uint32_t primitive) const override;
  void meet(std::uint32_t self, std::uint32_t primitive, const Ray& ray, Hit& first) const override;
  Vec normal(const Ray& ray, const Hit& hit) const override;

 private:
  MeshData data_;
};

}  // namespace rainref::compositor
