#include "windshield/scene/blades_seen.h"

#include <algorithm>

#include "math/half.h"
#include "windshield/motion/extent_between.h"

namespace rainref::windshield {
namespace {

using scene::Vector3;

constexpr double blade_height = 0.012, arm_height = 0.025;  ///< distance of their centres before the glass [m]
constexpr double arm_at_pivot = 0.014, arm_at_blade = 0.006;
constexpr std::array<double, 3> rubber{0.004, 0.004, 0.0045};  ///< radiance

Vector3 three(const Real3& a) { return {a[0], a[1], a[2]}; }

/// Approximate share of a disc `soft` wide that lies in [low, high], as if its edges were straight.
double covered(double at, double low, double high, double soft) {
  return std::clamp((at - low) / soft + 0.5, 0.0, 1.0) * std::clamp((high - at) / soft + 0.5, 0.0, 1.0);
}

/// A blade or its arm in the plane of its centre, `height` before the glass: along from `first` to `last`, across at most `half`.
struct Part {
  double height, first, last, half;
};
Part part_of(const SeenBlade& b, bool is_arm) {
  return is_arm ? Part{arm_height, -0.02, 0.5 * (b.inner + b.outer), arm_at_pivot} : Part{blade_height, b.inner, b.outer, b.half_width};
}
double soft_at(double depth, double texel) { return std::max(pupil, 1.5 * depth * texel); }

struct Cover {
  double share = 0, depth = 0;
};
/// The part of the ray (x, y, 1) that a blade, or its arm, hides; the texel is `texel` wide at distance 1.
Cover cover_of(const SeenBlade& b, bool is_arm, double x, double y, double texel) {
  const Vector3 ray(x, y, 1);
  const double towards = glm::dot(b.out, ray);
  if (!(towards > 1e-3)) return {};
  const Part part = part_of(b, is_arm);
  const double depth = (glm::dot(b.pivot, b.out) + part.height) / towards;
  if (!(depth > 0)) return {};
  const Vector3 p = depth * ray - b.pivot;
  const double along = glm::dot(p, b.along), across = glm::dot(p, b.across), soft = soft_at(depth, texel);
  const double half = is_arm ? arm_at_pivot + (arm_at_blade - arm_at_pivot) * std::clamp(along / part.last, 0.0, 1.0) : part.half;
  return {covered(along, part.first, part.last, soft) * covered(across, -half, half, soft), depth};
}

/// Bounds of the hidden area on the plane at distance 1: four corners in order, or everything if one of them is not before the eye.
struct Outline {
  std::array<Corner, 4> corners{};
  bool is_everything = false;
};
Outline outline_of(const SeenBlade& b, bool is_arm, double texel) {
  const Part part = part_of(b, is_arm);
  Outline all;
  all.is_everything = true;
  double soft = pupil;
  for (int go = 0; go < 2; ++go) {  // the softness depends on the depth; a metre beyond it changes little
    Outline outline;
    double deepest = 0;
    const double low = part.first - soft, high = part.last + soft, half = part.half + soft;
    const double places[4][2] = {{low, -half}, {high, -half}, {high, half}, {low, half}};
    for (std::size_t k = 0; k < 4; ++k) {
      const Vector3 p = b.pivot + part.height * b.out + places[k][0] * b.along + places[k][1] * b.across;
      if (!(p.z > 0.05)) return all;
      outline.corners[k] = {p.x / p.z, p.y / p.z};
      deepest = std::max(deepest, p.z);
    }
    if (go == 1) return outline;
    soft = soft_at(deepest + 1, texel);
  }
  return all;
}
/// Range covered in the rows from `low` to `high`; if empty, the first value is above the second.
std::array<double, 2> extent(const Outline& o, double low, double high) {
  if (o.is_everything) return {-1e30, 1e30};
  return extent_between(o.corners, low, high);
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
    if (std::any_of(wipers.begin() + static_cast<std::ptrdiff_t>(i) + 1, wipers.end(), same_pivot))
      continue;  // a later record has this
                 // blade
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
  struct SeenPart {
    const SeenBlade* blade;
    bool is_arm;
    Outline outline;
  };
  std::vector<SeenPart> parts;
  for (const SeenBlade& b : blades)
    for (const bool is_arm : {false, true}) parts.push_back({&b, is_arm, outline_of(b, is_arm, step_y)});
  const auto column_of = [&](double x) { return static_cast<int>((std::clamp(x, -half_size[0], half_size[0]) + half_size[0]) / step_x); };
  executor.for_tiles(width, height, width, 2, [&](const parallel::Tile& tile) {
    std::vector<Cover> covers(static_cast<std::size_t>(width));
    for (int row = tile.y0; row < tile.y1; ++row) {
      const double y = (row + 0.5) * step_y - half_size[1];
      int first = width, last = 0;
      std::fill(covers.begin(), covers.end(), Cover{});
      for (const SeenPart& part : parts) {
        const auto [low, high] = extent(part.outline, y - step_y, y + step_y);
        if (low > high) continue;
        const int begin = std::max(0, column_of(low) - 1), end = std::min(width, column_of(high) + 2);
        for (int column = begin; column < end; ++column) {
          const Cover more = cover_of(*part.blade, part.is_arm, (column + 0.5) * step_x - half_size[0], y, step_y);
          Cover& cover = covers[static_cast<std::size_t>(column)];
          if (more.share > cover.share) cover = more;
        }
        first = std::min(first, begin);
        last = std::max(last, end);
      }
      for (int column = first; column < last; ++column) {
        const Cover& cover = covers[static_cast<std::size_t>(column)];
        if (cover.share <= 0) continue;
        Half* colour = view.colour.row<Half>(row) + 4 * column;
        for (std::size_t k = 0; k < 3; ++k) {
          const double behind = to_float(colour[k]);
          colour[k] = to_half(static_cast<float>(behind + cover.share * (rubber[k] - behind)), Rounding::rne);
        }
        if (cover.share > 0.5) view.depth.row<float>(row)[column] = static_cast<float>(cover.depth);
      }
    }
  });
}

}  // namespace rainref::windshield
