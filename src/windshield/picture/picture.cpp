#include "windshield/picture/picture.h"

#include <cmath>

#include <fmt/format.h>

#include "math/real64.h"
#include "rainref/error.h"

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
// t = ((P0 - E) . n) / (d . n), where u = (E + t d - P0) . U, U the dual vector of e_u; all are quotients of what is linear
// in the pixel.
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

}  // namespace rainref::windshield
