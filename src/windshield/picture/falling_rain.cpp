#include "windshield/picture/falling_rain.h"

#include <algorithm>

#include "math/constants.h"
#include "math/half.h"
#include "rain/rain.h"
#include "random/counter.h"
#include "random/poisson.h"

namespace rainref::windshield {
namespace {

using scene::Vector3;

constexpr int classes = 10;
constexpr double cell = 1;           // m
constexpr double nearest = 0.3;      // m from the eye
constexpr double outside_by = 0.02;  // m before a pane's outer side
constexpr double least_share = 1.0 / 2048;
constexpr double asymmetry = 0.75;

Vector3 vector_of(const Real3& a) { return {a[0], a[1], a[2]}; }

/// [1/sr], by the cosine of the scattering angle.
double phase(double cosine) {
  const double g = asymmetry, x = 1 + g * g - 2 * g * cosine;
  return (1 - g * g) / (4 * pi * x * __builtin_sqrt(x));
}

/// The picture's plane, and a place on it.
class Projection {
 public:
  explicit Projection(const RainView& v)
      : eye_(v.camera.position),
        basis_(v.camera.basis()),
        width_(v.width),
        height_(v.height),
        texels_(0.5 * v.height / v.camera.half_height()) {}
  double depth(const Vector3& p) const { return glm::dot(p - eye_, basis_.forward); }
  /// Position in texels; depth must be positive.
  void place(const Vector3& p, float (&out)[2]) const {
    const Vector3 d = p - eye_;
    const double scale = texels_ / depth(p);
    out[0] = static_cast<float>(0.5 * width_ + scale * glm::dot(d, basis_.right));
    out[1] = static_cast<float>(0.5 * height_ + scale * glm::dot(d, basis_.up));
  }
  bool sees(const Streak& s) const {
    const float reach = s.radius + 1;
    const auto [left, right] = std::minmax(s.opened[0], s.closed[0]);
    const auto [low, high] = std::minmax(s.opened[1], s.closed[1]);
    return right + reach > 0 && left - reach < static_cast<float>(width_) && high + reach > 0 && low - reach < static_cast<float>(height_);
  }
  /// Texels per metre at depth 1.
  double texels() const { return texels_; }
  /// A box around everything visible up to a depth.
  void box(double far, Vector3& low, Vector3& high) const {
    low = high = eye_;
    for (const double x : {0.0, 1.0 * width_})
      for (const double y : {0.0, 1.0 * height_}) {
        const Vector3 corner =
            eye_ + far * (basis_.forward + (x - 0.5 * width_) / texels_ * basis_.right + (y - 0.5 * height_) / texels_ * basis_.up);
        low = glm::min(low, corner);
        high = glm::max(high, corner);
      }
  }
  const Vector3& eye() const { return eye_; }

 private:
  Vector3 eye_;
  scene::Camera::Basis basis_;
  int width_, height_;
  double texels_;
};

bool is_outside(std::span<const Glass> panes, const Vector3& p) {
  return std::any_of(panes.begin(), panes.end(),
                     [&](const Glass& g) { return glm::dot(p - vector_of(g.origin), vector_of(g.normal)) > outside_by; });
}

Vector3 lit(const Vector3& at, const Vector3& eye, const Vector3& ambient, std::span<const RainLamp> lamps) {
  Vector3 sum = ambient;
  const Vector3 to_eye = scene::normalized(eye - at);
  for (const RainLamp& lamp : lamps) {
    const Vector3 way = at - lamp.position;
    const double far_sq = std::max(glm::dot(way, way), lamp.radius * lamp.radius);
    sum += (pi * lamp.radius * lamp.radius / far_sq * phase(glm::dot(way, to_eye) / __builtin_sqrt(far_sq))) * lamp.radiance;
  }
  return sum;
}

std::uint32_t word(double whole) { return static_cast<std::uint32_t>(static_cast<std::int64_t>(whole)); }

}  // namespace

Vector3 mean_radiance(const Image& colour) {
  constexpr int every = 4;
  Vector3 sum(0);
  int count = 0;
  for (int y = 0; y < colour.height(); y += every)
    for (int x = 0; x < colour.width(); x += every, ++count) {
      const Half* c = colour.row<Half>(y) + 4 * x;
      sum += Vector3(to_float(c[0]), to_float(c[1]), to_float(c[2]));
    }
  return sum / static_cast<double>(count);
}

std::vector<FallingDrop> falling_drops(const FallingRainSettings& s, std::uint64_t seed, const Air& air, const RainView& view,
                                       std::span<const Glass> panes, std::span<const RainLamp> lamps) {
  std::vector<FallingDrop> drops;
  if (!(air.rate > 0)) return drops;
  const Projection picture(view);
  Vector3 low, high;
  picture.box(s.far, low, high);
  const rain::DropSizes sizes(air.rate, s.smallest_drop);
  const double width = (rain::DropSizes::largest_mm - s.smallest_drop) / classes;
  for (int k = 0; k < classes; ++k) {
    const double smallest = s.smallest_drop + k * width, fall = rain::terminal_velocity(smallest + 0.5 * width);
    const double mean = (sizes.in_air(smallest) - sizes.in_air(smallest + width)) * cell * cell * cell;
    const random::PoissonTable number(std::min(mean, random::PoissonTable::max_mean));
    const Vector3 velocity = vector_of(air.wind) - Vector3(0, 0, fall), moved = vector_of(air.moved) - Vector3(0, 0, fall * air.time);
    // Cells of the air, which moved with it.
    const Vector3 first = glm::floor((low - moved) / cell), last = glm::floor((high - moved) / cell);
    for (double i = first.x; i <= last.x; ++i)
      for (double j = first.y; j <= last.y; ++j)
        for (double l = first.z; l <= last.z; ++l) {
          const random::Block place = random::pcg4d({word(i), word(j), word(l), static_cast<std::uint32_t>(k)});
          const random::Block own = random::block(seed, random::Purpose::falling_drop, place[0], place[1]);
          const int count = number.count(own[3]);
          for (int n = 0; n < count; ++n) {
            const random::Block r = random::pcg4d({own[0], own[1], own[2], static_cast<std::uint32_t>(n)});
            FallingDrop d{};
            d.from = moved + cell * Vector3(i + random::uniform(r[0]), j + random::uniform(r[1]), l + random::uniform(r[2]));
            d.to = d.from + s.exposure * velocity;
            const Vector3 middle = 0.5 * (d.from + d.to);
            const double depth = picture.depth(middle);
            if (!(picture.depth(d.from) > nearest && picture.depth(d.to) > nearest && depth < s.far) || !is_outside(panes, middle))
              continue;
            d.radius = 0.5e-3 * (smallest + width * random::uniform(r[3]));
            picture.place(d.from, d.streak.opened);
            picture.place(d.to, d.streak.closed);
            const double texels = picture.texels() / depth, radius = d.radius * texels, x = d.streak.closed[0] - d.streak.opened[0],
                         y = d.streak.closed[1] - d.streak.opened[1];
            d.streak.radius = static_cast<float>(std::max(radius, 0.5));
            if (!picture.sees(d.streak)) continue;
            // A sphere covers a point of its path while it moves by its own width.
            d.time_share = 2 * radius / (2 * radius + __builtin_sqrt(x * x + y * y));
            const double share = d.time_share * std::min(2 * radius, 1.0);
            if (share < least_share) continue;
            d.streak.opacity = static_cast<float>(share);
            d.streak.depth = static_cast<float>(depth);
            d.radiance = s.gain * lit(middle, picture.eye(), air.ambient, lamps);
            for (int c = 0; c < 3; ++c) d.streak.radiance[c] = static_cast<float>(d.radiance[c]);
            drops.push_back(d);
          }
        }
  }
  std::stable_sort(drops.begin(), drops.end(), [](const FallingDrop& a, const FallingDrop& b) { return a.streak.depth > b.streak.depth; });
  return drops;
}

}  // namespace rainref::windshield
