#include "compositor/triangle_mesh.h"

#include <fmt/format.h>
#include <glm/geometric.hpp>

#include "rainref/error.h"

namespace rainref::compositor {

namespace {

double magnitude(double a) { return a < 0 ? -a : a; }

}  // namespace

TriangleMesh::TriangleMesh(MeshData data) : data_(std::move(data)) {
  for (std::size_t i = 0; i < data_.triangles.size(); ++i) {
    for (const std::uint32_t vertex : data_.triangles[i]) {
      if (vertex >= data_.positions.size())
        throw Error(ExitCode::usage, fmt::format("triangle {} names vertex {}, but the mesh has {}", i, vertex, data_.positions.size()));
    }
  }
  if (!data_.normals.empty() && data_.normals.size() != data_.positions.size()) {
    throw Error(ExitCode::usage, fmt::format("a mesh of {} vertices has {} normals", data_.positions.size(), data_.normals.size()));
  }
}

Box TriangleMesh::bounds(std::uint32_t primitive) const {
  const auto& [a, b, c] = data_.triangles[primitive];
  Box box{data_.positions[a], data_.positions[a]};
  for (const std::uint32_t vertex : {b, c}) {
    for (int k = 0; k < 3; ++k) {
      box.low[k] = std::min(box.low[k], data_.positions[vertex][k]);
      box.high[k] = std::max(box.high[k], data_.positions[vertex][k]);
    }
  }
  return box;
}

void TriangleMesh::meet(std::uint32_t self, std::uint32_t primitive, const Ray& ray, Hit& first) const {
  const Vec& d = ray.direction;
  const double dx = magnitude(d.x), dy = magnitude(d.y), dz = magnitude(d.z);
  const int z = dx > dy ? (dx > dz ? 0 : 2) : (dy > dz ? 1 : 2), x = (z + 1) % 3, y = (z + 2) % 3;
  const double shear_x = d[x] / d[z], shear_y = d[y] / d[z], scale = 1 / d[z];
  double px[3], py[3], pz[3];
  for (int k = 0; k < 3; ++k) {
    const Vec p = data_.positions[data_.triangles[primitive][static_cast<std::size_t>(k)]] - ray.origin;
    px[k] = p[x] - shear_x * p[z];
    py[k] = p[y] - shear_y * p[z];
    pz[k] = scale * p[z];
  }
  const double a = px[2] * py[1] - py[2] * px[1], b = px[0] * py[2] - py[0] * px[2], c = px[1] * py[0] - py[1] * px[0];
  if ((a < 0 || b < 0 || c < 0) && (a > 0 || b > 0 || c > 0)) return;
  const double sum = a + b + c;
  if (sum == 0) return;  // edge-on: its neighbours are met
  const double t = (a * pz[0] + b * pz[1] + c * pz[2]) / sum + 0.0;
  if (!(t >= ray.nearest && t <= ray.farthest)) return;
  const Hit hit{t, self, primitive, b / sum + 0.0, c / sum + 0.0};
  if (precedes(hit, first)) first = hit;
}

Vec TriangleMesh::normal(const Ray&, const Hit& hit) const {
  const auto& [a, b, c] = data_.triangles[hit.part];
  const Vec n = cross(data_.positions[b] - data_.positions[a], data_.positions[c] - data_.positions[a]);
  return n / glm::length(n);
}

Vec TriangleMesh::smooth_normal(const Ray& ray, const Hit& hit) const {
  if (data_.normals.empty()) return normal(ray, hit);
  const auto& [a, b, c] = data_.triangles[hit.part];
  const Vec n = (1 - hit.u - hit.v) * data_.normals[a] + hit.u * data_.normals[b] + hit.v * data_.normals[c];
  const double length = glm::length(n);
  return length > 0 ? n / length : normal(ray, hit);
}

}  // namespace rainref::compositor
