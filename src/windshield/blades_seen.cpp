#include "windshield/blades_seen.h"

#include <algorithm>
#include <cmath>

#include "math/half.h"

namespace rainref::windshield {
namespace {

using scene::Vector3;

constexpr double blade_height = 0.012, arm_height = 0.025;  ///< of their middles before the glass [m]
constexpr double pupil = 0.005, arm_at_pivot = 0.014, arm_at_blade = 0.006;
constexpr std::array<double, 3> rubber{0.004, 0.004, 0.0045};  ///< radiance

Vector3 three(const Real3& a) { return {a[0], a[1], a[2]}; }

/// Share of a disc `soft` wide that lies in [low, high], roughly: its edges are straight.
double covered(double at, double low, double high, double soft) {
  return std::clamp((at - low) / soft + 0.5, 0.0, 1.0) * std::clamp((high - at) / soft + 0.5, 0.0, 1.0);
}

struct Cover {
  double share = 0, depth = 0;
};
/// What a blade hides of the ray (x, y, 1), a texel `texel` wide at distance 1.
Cover cover_of(const SeenBlade& b, double x, double y, double texel) {
  Cover cover;
  const Vector3 ray(x, y, 1);
  const double towards = glm::dot(b.out, ray);
  if (!(towards > 1e-3)) return cover;
  for (const bool is_arm : {false, true}) {
    const double depth = (glm::dot(b.pivot, b.out) + (is_arm ? arm_height : blade_height)) / towards;
    if (!(depth > 0)) continue;
    const Vector3 p = depth * ray - b.pivot;
    const double along = glm::dot(p, b.along), across = glm::dot(p, b.across), soft = std::max(pupil, 1.5 * depth * texel);
    const double end = 0.5 * (b.inner + b.outer);
    const double half = is_arm ? arm_at_pivot + (arm_at_blade - arm_at_pivot) * std::clamp(along / end, 0.0, 1.0) : b.half_width;
    const double share = covered(along, is_arm ? -0.02 : b.inner, is_arm ? end : b.outer, soft) * covered(across, -half, half, soft);
    if (share > cover.share) cover = {share, depth};
  }
  return cover;
}

}  // namespace

void add_seen(std::vector<SeenBlade>& seen, std::span<const Wiper> wipers, const Glass& glass, const scene::Camera& camera) {
  const scene::Camera::Basis basis = camera.basis();
  const auto in_camera = [&](const Vector3& v) {
    return Vector3(glm::dot(v, basis.right), glm::dot(v, basis.up), glm::dot(v, basis.forward));
  };
  const Vector3 e_u = three(glass.e_u), e_v = three(glass.e_v), x = scene::normalized(e_u),
                y = scene::normalized(e_v - glm::dot(e_v, x) * x), origin = three(glass.origin) - camera.position;
  for (std::size_t i = 0; i < wipers.size(); ++i) {
    const Wiper& w = wipers[i];
    const auto same_pivot = [&](const Wiper& other) { return other.pivot[0] == w.pivot[0] && other.pivot[1] == w.pivot[1]; };
    if (std::any_of(wipers.begin() + static_cast<std::ptrdiff_t>(i) + 1, wipers.end(), same_pivot)) continue;  // a later one has it
    const double c = w.axis[0], s = w.axis[1];
    const Vector3 pivot = origin + static_cast<double>(w.pivot[0]) * x + static_cast<double>(w.pivot[1]) * y;
    seen.push_back({in_camera(pivot), in_camera(c * x + s * y), in_camera(c * y - s * x), in_camera(three(glass.normal)), w.inner_radius,
                    w.outer_radius, w.half_width});
  }
}

void draw_blades(std::span<const SeenBlade> blades, const std::array<double, 2>& half_size, SceneView& view,
                 const parallel::Executor& executor) {
  const int width = view.colour.width(), height = view.colour.height();
  const double step_x = 2 * half_size[0] / width, step_y = 2 * half_size[1] / height;
  executor.for_tiles(width, height, width, 8, [&](const parallel::Tile& tile) {
    for (int row = tile.y0; row < tile.y1; ++row)
      for (int column = 0; column < width; ++column) {
        const double x = (column + 0.5) * step_x - half_size[0], y = (row + 0.5) * step_y - half_size[1];
        Cover cover;
        for (const SeenBlade& b : blades) {
          const Cover more = cover_of(b, x, y, step_y);
          if (more.share > cover.share) cover = more;
        }
        if (cover.share <= 0) continue;
        Half* colour = view.colour.row<Half>(row) + 4 * column;
        for (std::size_t k = 0; k < 3; ++k) {
          const double behind = to_float(colour[k]);
          colour[k] = to_half(static_cast<float>(behind + cover.share * (rubber[k] - behind)), Rounding::rne);
        }
        if (cover.share > 0.5) view.depth.row<float>(row)[column] = static_cast<float>(cover.depth);
      }
  });
}

}  // namespace rainref::windshield
