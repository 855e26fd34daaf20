#include "windshield/picture/interior.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "math/half.h"
#include "math/smooth_step.h"
#include "windshield/motion/glass.h"

namespace rainref::windshield {
namespace {

using scene::Vector3;

constexpr double hood_half = 0.24, hood_flat = 0.25;       // its half width at distance 1, and the share of it that is level
constexpr double mirrored_fades = 0.05, rim_fades = 0.02;  // on the image plane at distance 1
constexpr std::array<double, 3> tone{0.92, 0.95, 1.0};     // of what the night lights

/// exp(-x) within some percent: a shade that nobody measures.
double fading(double x) {
  const double y = 1 + std::max(x, 0.0) / 4;
  return 1 / (y * y * y * y);
}

/// A point of the image plane at distance 1, and its depth.
struct Seen {
  double x, y, depth;
};

/// An edge through two points: how far a point lies on its dark side, on the image plane.
struct Edge {
  double x, y, nx, ny;  // a point, and the unit normal toward the dark side
  double depth;         // of the glass there [m]
  bool is_there = false;
  double into(double px, double py) const { return (px - x) * nx + (py - y) * ny; }
};
Edge edge_of(const Seen& a, const Seen& b) {
  Edge e{};
  const double dx = b.x - a.x, dy = b.y - a.y, length = __builtin_sqrt(dx * dx + dy * dy);
  if (!(a.depth > 0.05 && b.depth > 0.05 && length > 1e-6)) return e;
  return {a.x, a.y, -dy / length, dx / length, 0.5 * (a.depth + b.depth), true};
}

class Inside {
 public:
  Inside(const InteriorSettings& s, const PictureSettings& picture, const Corners& corners) : settings_(s) {
    const scene::Camera eye = camera(picture);
    const scene::Camera::Basis basis = eye.basis();
    const auto vector = [](const std::array<double, 3>& a) { return Vector3(a[0], a[1], a[2]); };
    const Vector3 p0 = vector(corners[0]), e_u = vector(corners[1]) - p0, e_v = vector(corners[2]) - p0;
    const auto seen = [&](double u, double v) {
      const Vector3 p = p0 + u * e_u + v * e_v - eye.position;
      const double depth = glm::dot(p, basis.forward);
      return Seen{glm::dot(p, basis.right) / depth, glm::dot(p, basis.up) / depth, depth};
    };
    if (s.pillar[0] > 0 || s.pillar[1] > 0) pillar_ = edge_of(seen(s.pillar[0], 0), seen(s.pillar[1], 1));
    if (s.dashboard > 0) dashboard_ = edge_of(seen(1, s.dashboard), seen(0, s.dashboard));
    const double ahead = basis.forward.x;  // the car's x axis, seen by the camera
    hood_at_ = ahead > 0.05 ? basis.right.x / ahead : std::numeric_limits<double>::infinity();
  }

  /// Light and coverage of the ray (x, y, 1); texel: its width at distance 1.
  void at(double x, double y, double texel, float* out) const {
    double light = 0, hidden = 0;
    if (dashboard_.is_there) {
      // The hood goes over into the level edge with slope 0 at both ends.
      const double across = std::abs(x - hood_at_) / hood_half;
      const double raised = settings_.binnacle * (1 - smooth_step((across - hood_flat) / (1 - hood_flat)));
      const double into = dashboard_.into(x, y - raised);
      hidden = covered(into, dashboard_.depth, texel);
      const double surface = 0.08 + 0.6 * fading(std::max(into, 0.0) / rim_fades);
      light = hidden * surface + (1 - hidden) * settings_.reflection * fading(-into / mirrored_fades);
    }
    if (pillar_.is_there) {
      const double into = pillar_.into(x, y), over = covered(into, pillar_.depth, texel);
      const double surface = 0.1 + 0.3 * fading(std::max(into, 0.0) / 0.03);
      light = over * surface + (1 - over) * light;
      hidden = over + (1 - over) * hidden;
    }
    for (std::size_t k = 0; k < 3; ++k) out[k] = static_cast<float>(light * tone[k]);
    out[3] = static_cast<float>(hidden);
  }

 private:
  static double covered(double into, double depth, double texel) {
    return std::clamp(into / std::max(pupil / depth, 1.5 * texel) + 0.5, 0.0, 1.0);
  }
  InteriorSettings settings_;
  Edge pillar_{}, dashboard_{};
  double hood_at_ = 0;
};

}  // namespace

InteriorUniforms interior_uniforms(const InteriorSettings& s) {
  InteriorUniforms u{};
  u.light = static_cast<float>(s.light);
  return u;
}

Image draw_interior(const InteriorSettings& settings, const PictureSettings& picture, const Corners& glass,
                    const parallel::Executor& executor) {
  Image image(Format::rgba16f, picture.width, picture.height);
  const Inside inside(settings, picture, glass);
  const double half_height = camera(picture).half_height(), half_width = half_height * picture.width / picture.height;
  const double step_x = 2 * half_width / picture.width, step_y = 2 * half_height / picture.height;
  executor.for_tiles(picture.width, picture.height, picture.width, 8, [&](const parallel::Tile& tile) {
    for (int row = tile.y0; row < tile.y1; ++row) {
      for (int column = 0; column < picture.width; ++column) {
        float texel[4];
        inside.at((column + 0.5) * step_x - half_width, (row + 0.5) * step_y - half_height, step_y, texel);
        for (std::size_t k = 0; k < 4; ++k) image.row<Half>(row)[4 * column + static_cast<int>(k)] = to_half(texel[k], Rounding::rne);
      }
    }
  });
  return image;
}

}  // namespace rainref::windshield
