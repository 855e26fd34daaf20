#include "windshield/picture/picture.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "math/half.h"
#include "math/real64.h"
#include "math/smooth_step.h"
#include "rainref/error.h"
#include "windshield/motion/glass.h"

namespace rainref::windshield {
namespace {

using scene::Vector3;

Vector3 vector(const std::array<double, 3>& a) { return {a[0], a[1], a[2]}; }
void put(const Vector3& v, float* out) {
  out[0] = static_cast<float>(v.x);
  out[1] = static_cast<float>(v.y);
  out[2] = static_cast<float>(v.z);
}

}  // namespace

scene::Camera camera(const PictureSettings& s) {
  return {vector(s.camera_position), vector(s.camera_target), {0, 0, 1}, s.vertical_fov_deg};
}

double widened_fov(const PictureSettings& s) {
  const Real64 tangent(camera(s).half_height() * s.scene_margin);
  return 2 * atan2_real(tangent, Real64(1)).v * 180 / pi;
}

// A ray d = right x + up y + forward from the eye E meets the plane of P0, e_u, e_v with normal n at E + t d,
// t = ((P0 - E) . n) / (d . n), where u = (E + t d - P0) . U, U the dual vector of e_u; all are quotients of linear functions of the pixel.
CompositeUniforms composite_uniforms(const PictureSettings& s, const Corners& corners, std::string_view name) {
  const scene::Camera eye = camera(s);
  const scene::Camera::Basis basis = eye.basis();
  const Vector3 p0 = vector(corners[0]), e_u = vector(corners[1]) - p0, e_v = vector(corners[2]) - p0;
  Vector3 n = -glm::cross(e_u, e_v);  // outward: see make_glass
  const double area_sq = glm::dot(n, n);
  n = scene::normalized(n);
  const double distance = glm::dot(p0 - eye.position, n);
  if (!(std::abs(distance) > 1e-6))
    throw Error(ExitCode::usage,
                fmt::format("camera.position: expected an eye behind {}, found one in its plane ({} m from it)", name, distance));
  if (distance < 0)
    throw Error(ExitCode::usage,
                fmt::format("camera.position: expected an eye behind {}, found one {:g} m before its outer side; seen from inside the "
                            "corners are the lower left, the lower right and the upper left",
                            name, -distance));
  const double guu = glm::dot(e_u, e_u), guv = glm::dot(e_u, e_v), gvv = glm::dot(e_v, e_v);
  const Vector3 dual_u = (gvv / area_sq) * e_u - (guv / area_sq) * e_v, dual_v = (guu / area_sq) * e_v - (guv / area_sq) * e_u;
  const Vector3 x_axis = scene::normalized(e_u), y_axis = scene::normalized(e_v - glm::dot(e_v, x_axis) * x_axis);

  const double half_height = eye.half_height(), half_width = half_height * s.width / s.height;
  const double step_x = 2 * half_width / s.width, step_y = 2 * half_height / s.height;
  const Vector3 d0 = basis.forward - half_width * basis.right - half_height * basis.up, dx = step_x * basis.right, dy = step_y * basis.up;

  CompositeUniforms u{};
  const auto row = [&](const Vector3& dual, float* out) {
    const double offset = glm::dot(eye.position - p0, dual);
    const auto of = [&](const Vector3& d) { return offset * glm::dot(d, n) + distance * glm::dot(d, dual); };
    put({of(dx), of(dy), of(d0)}, out);
  };
  row(dual_u, u.u_row);
  row(dual_v, u.v_row);
  put({glm::dot(dx, n), glm::dot(dy, n), glm::dot(d0, n)}, u.w_row);
  u.glass_distance = static_cast<float>(distance);
  const auto in_camera = [&](const Vector3& v) {
    return Vector3(glm::dot(v, basis.right), glm::dot(v, basis.up), glm::dot(v, basis.forward));
  };
  put(in_camera(x_axis), u.plane_x);
  put(in_camera(y_axis), u.plane_y);
  put(in_camera(n), u.outward);
  u.blur_lod = static_cast<float>(s.blur_lod);
  u.wetness = static_cast<float>(s.wetness);
  u.visible_from = static_cast<float>(s.visible_from);
  u.visible_to = static_cast<float>(s.visible_to);
  u.refraction = static_cast<float>(s.refraction);
  u.pixel[0] = static_cast<float>(step_x);
  u.pixel[1] = static_cast<float>(step_y);
  u.half_size[0] = static_cast<float>(half_width);
  u.half_size[1] = static_cast<float>(half_height);
  u.scene_scale[0] = static_cast<float>(0.5 / (half_width * s.scene_margin));
  u.scene_scale[1] = static_cast<float>(0.5 / (half_height * s.scene_margin));
  u.shininess = static_cast<float>(s.shininess);
  u.glint_strength = static_cast<float>(s.glint_strength);
  put(vector(s.cabin), u.cabin);
  u.glint_count = static_cast<std::int32_t>(s.lights.size());
  u.water_ior = static_cast<float>(s.water_ior);
  u.inner = static_cast<float>(s.inner);
  return u;
}

std::vector<Glint> glints(const PictureSettings& s) {
  const scene::Camera::Basis basis = camera(s).basis();
  std::vector<Glint> out;
  for (const Light& light : s.lights) {
    const Vector3 d = scene::normalized(vector(light.direction));
    Glint g{};
    put({glm::dot(d, basis.right), glm::dot(d, basis.up), glm::dot(d, basis.forward)}, g.direction);
    put(vector(light.radiance), g.radiance);
    out.push_back(g);
  }
  return out;
}

namespace {

using scene::Vector3;

constexpr double hood_half = 0.24, hood_flat = 0.25;       // its half width at distance 1, and the share of it that is level
constexpr double mirrored_fades = 0.05, rim_fades = 0.02;  // on the image plane at distance 1
constexpr std::array<double, 3> tone{0.92, 0.95, 1.0};     // colour of surfaces lit by the night

/// exp(-x) to a few percent, which suffices for shading.
double fading(double x) {
  const double y = 1 + std::max(x, 0.0) / 4;
  return 1 / (y * y * y * y);
}

/// A point of the image plane at distance 1, and its depth.
struct Seen {
  double x, y, depth;
};

/// An edge through two points; measures how far a point lies on its dark side, on the image plane.
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
    const double ahead = basis.forward.x;  // the car's x axis in the camera's view
    hood_at_ = ahead > 0.05 ? basis.right.x / ahead : std::numeric_limits<double>::infinity();
  }

  /// Light and coverage of the ray (x, y, 1); texel: its width at distance 1.
  void at(double x, double y, double texel, float* out) const {
    double light = 0, hidden = 0;
    if (dashboard_.is_there) {
      // The hood joins the level edge with slope 0 at both ends.
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
