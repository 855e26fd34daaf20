// The glass in the camera's view: position, distance and normal at each pixel.
#include <algorithm>

#include "math/constants.h"
#include "math/half.h"
#include "math/real64.h"
#include "rainy_glass/host.h"

namespace rainref::rainy_glass {
namespace {

using scene::Vector3;

struct Hit {
  double u = 0, v = 0, distance = 0;
  Vector3 normal{0, 0, 0};
};

Hit on_pane(const Vector3& ray, const Vector3& forward, const Vector3& normal, double distance) {
  const double toward = glm::dot(ray, normal), plane = distance * glm::dot(forward, normal);
  if (!(toward > 1e-6) || !(plane > 0)) return {};
  const double t = plane / toward;
  const Vector3 at = t * ray - distance * forward, across = glm::cross(Vector3(0, 1, 0), normal);
  return {glm::dot(at, across), at.y, t, normal};
}
Hit on_sphere(const Vector3& ray, const Vector3& centre, double radius) {
  const double a = glm::dot(ray, ray), b = glm::dot(ray, centre), c = glm::dot(centre, centre) - radius * radius,
               discriminant = b * b - a * c;
  if (!(discriminant > 0)) return {};
  const double t = (b - __builtin_sqrt(discriminant)) / a;
  if (!(t > 0)) return {};
  const Vector3 n = (1 / radius) * (t * ray - centre);
  const double level = __builtin_sqrt(n.x * n.x + n.z * n.z);
  return {radius * atan2_real(Real64(n.x), Real64(n.z)).v, radius * atan2_real(Real64(n.y), Real64(level)).v, t, n};
}
// A picture of normals has no positions; those of a plane perpendicular to the view are used.
Hit on_image(const float* texel, double x, double y, const Vector3& ray, double distance) {
  if (!(texel[3] > 0.5f)) return {};
  const Vector3 n(texel[0], texel[1], texel[2]);
  return {glm::dot(ray, n) > 0 ? -x * distance : x * distance, y * distance, distance, n};
}

}  // namespace

scene::Vector3 level_forward(const Settings& s) {
  const Vector3 forward = camera(s).basis().forward, level(forward.x, 0, forward.z);
  return glm::dot(level, level) > 1e-12 ? scene::normalized(level) : Vector3(0, 0, -1);
}

scene::Vector3 facing(const Settings& s) {
  const Vector3 level = level_forward(s);
  if (s.shape != Shape::pane) return -level;
  const Real64 angle(s.yaw_deg * degree);
  const double c = cos_real(angle).v, k = sin_real(angle).v;
  return {c * level.x + k * level.z, 0, c * level.z - k * level.x};
}

void make_surface(const Settings& s, const Image& normals, Image& surface, Image& orientation, const Rows& rows) {
  surface = Image(Format::rgba32f, s.width, s.height);
  orientation = Image(Format::rgba16f, s.width, s.height);
  const scene::Camera eye = camera(s);
  const auto basis = eye.basis();
  const double half_height = eye.half_height(), half_width = half_height * s.width / s.height;
  const Vector3 normal = facing(s), level = level_forward(s);
  const TextureData decoded = s.shape == Shape::image ? TextureData(normals, Address::clamp, Address::clamp) : TextureData();
  rows(s.height, [&](int begin, int end) {
    for (int row = begin; row < end; ++row) {
      for (int column = 0; column < s.width; ++column) {
        const double x = ((2 * column + 1.0) / s.width - 1) * half_width, y = ((2 * row + 1.0) / s.height - 1) * half_height;
        const Vector3 ray = basis.forward + x * basis.right + y * basis.up;
        const Hit h =
            s.shape == Shape::pane ? on_pane(ray, level, normal, s.distance)
            : s.shape == Shape::sphere
                ? on_sphere(ray, s.distance * basis.forward, s.radius)
                : on_image(decoded.view().texels + 4 * (static_cast<std::ptrdiff_t>(row) * s.width + column), x, y, ray, s.distance);
        float* place = surface.row<float>(row) + 4 * column;
        place[0] = static_cast<float>(h.u);
        place[1] = static_cast<float>(h.v);
        place[2] = static_cast<float>(h.distance);
        Half* n = orientation.row<Half>(row) + 4 * column;
        for (int k = 0; k < 3; ++k) n[k] = to_half(static_cast<float>(h.normal[k]));
        n[3] = to_half(h.distance > 0 ? 1.0f : 0.0f);
      }
    }
  });
}

Image near_depth(const Image& depth, const Rows& rows) {
  const int width = depth.width(), height = depth.height();
  Image out(Format::r32f, width, height);
  rows(height, [&](int begin, int end) {
    std::vector<float> least(static_cast<std::size_t>(width));  // of three rows
    for (int y = begin; y < end; ++y) {
      const float *here = depth.row<float>(y), *below = depth.row<float>(std::max(0, y - 1)),
                  *above = depth.row<float>(std::min(height - 1, y + 1));
      for (int x = 0; x < width; ++x) least[static_cast<std::size_t>(x)] = std::min(std::min(here[x], below[x]), above[x]);
      const float* column = least.data();
      float* to = out.row<float>(y);
      for (int x = 0; x < width; ++x)
        to[x] = std::min(std::min(column[x], column[std::max(0, x - 1)]), column[std::min(width - 1, x + 1)]) * (1 - 0x1p-16f);
    }
  });
  return out;
}

}  // namespace rainref::rainy_glass
