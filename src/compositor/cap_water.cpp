#include "compositor/cap_water.h"

#include <algorithm>
#include <cmath>

#include "compositor/packet.h"
#include "compositor/reals.h"
#include "math/constants.h"
#include "math/real64.h"
#include "rainref/error.h"
#include "scene/camera.h"

namespace rainref::compositor {
namespace {

int whole_within(double a, int count) { return std::clamp(static_cast<int>(a), 0, count - 1); }

PaneShape part_of(const Pane& pane, const CapWater::Layer& layer) {
  PaneShape shape = pane.shape();
  const Vec right = rainref::scene::normalized(shape.e_u), up = rainref::scene::normalized(shape.e_v);
  shape.corner = shape.corner + layer.low[0] * right + layer.low[1] * up;
  shape.e_u = layer.extent[0] * right;
  shape.e_v = layer.extent[1] * up;
  return shape;
}

}  // namespace

CapWater::CapWater(const Pane& pane, std::vector<CapBase> caps, double contact_angle_deg, const Layer& height)
    : pane_(pane),
      caps_(std::move(caps)),
      height_(height),
      width_(root(dot(pane.shape().e_u, pane.shape().e_u))),
      length_(root(dot(pane.shape().e_v, pane.shape().e_v))) {
  if (!pane.is_flat() || !(std::abs(dot(pane.shape().e_u, pane.shape().e_v)) <= 1e-9 * width_ * length_))
    throw Error(ExitCode::usage, "caps of water: expected a flat pane with perpendicular edges");
  const Real64 angle(contact_angle_deg * degree);
  sine_ = sin_real(angle).v;
  cosine_ = cos_real(angle).v;
  if (caps_.empty()) {
    first_ = {0, 0};
    return;
  }
  // About one bucket per cap.
  side_ = std::max({root(width_ * length_ / static_cast<double>(caps_.size())), width_ / 4096, length_ / 4096});
  columns_ = static_cast<int>(width_ / side_) + 1;
  rows_ = static_cast<int>(length_ / side_) + 1;
  const auto visit = [&](const CapBase& c, const auto& take) {
    const double reach = c.radius * (1 + 1e-9);
    for (int j = whole_within((c.y - reach) / side_, rows_); j <= whole_within((c.y + reach) / side_, rows_); ++j) {
      for (int i = whole_within((c.x - reach) / side_, columns_); i <= whole_within((c.x + reach) / side_, columns_); ++i)
        take(static_cast<std::size_t>(j) * columns_ + i);
    }
  };
  first_.assign(static_cast<std::size_t>(columns_) * rows_ + 1, 0);
  for (const CapBase& c : caps_) visit(c, [&](std::size_t b) { ++first_[b + 1]; });
  for (std::size_t b = 1; b < first_.size(); ++b) first_[b] += first_[b - 1];
  listed_.resize(first_.back());
  std::vector<std::uint32_t> next(first_.begin(), first_.end() - 1);
  for (std::uint32_t id = 0; id < caps_.size(); ++id) visit(caps_[id], [&](std::size_t b) { listed_[next[b]++] = id; });
}

std::size_t CapWater::bucket(double x, double y) const {
  return static_cast<std::size_t>(whole_within(y / side_, rows_)) * columns_ + whole_within(x / side_, columns_);
}

double CapWater::height_of(std::uint32_t cap, double x, double y) const {
  const CapBase& c = caps_[cap];
  const double dx = x - c.x, dy = y - c.y, d = dx * dx + dy * dy;
  if (!(d < c.radius * c.radius)) return -1;
  const double r = sphere(cap);
  return root(r * r - d) + centre_lift(cap);
}

std::uint32_t CapWater::owner(double x, double y) const {
  std::uint32_t best = dry;
  double highest = -1;
  const std::size_t b = bucket(x, y);
  for (std::uint32_t k = first_[b]; k < first_[b + 1]; ++k) {
    const double h = height_of(listed_[k], x, y);
    if (h > highest) {
      highest = h;
      best = listed_[k];
    }
  }
  if (!height_.height) return best;
  const double h = height_.height->surface((x - height_.low[0]) / height_.extent[0], (y - height_.low[1]) / height_.extent[1]);
  return h > highest ? layer : best;
}

Vec CapSurface::centre(std::uint32_t cap) const {
  const CapBase& c = water_->base(cap);
  return water_->pane().point(c.x / water_->width(), c.y / water_->length(), water_->centre_lift(cap));
}

Box CapSurface::bounds(std::uint32_t cap) const {
  const CapBase& c = water_->base(cap);
  const Vec n = water_->pane().normal(0), top = (water_->sphere(cap) + water_->centre_lift(cap)) * n;
  Box box{Vec(1e300), Vec(-1e300)};
  for (const double dx : {-c.radius, c.radius}) {
    for (const double dy : {-c.radius, c.radius}) {
      const Vec foot = water_->pane().point((c.x + dx) / water_->width(), (c.y + dy) / water_->length());
      for (const Vec& p : {foot, foot + top}) {
        for (int k = 0; k < 3; ++k) {
          box.low[k] = std::min(box.low[k], p[k]);
          box.high[k] = std::max(box.high[k], p[k]);
        }
      }
    }
  }
  return box;
}

void CapSurface::meet(std::uint32_t self, std::uint32_t cap, const Ray& ray, Hit& first) const {
  const double r = water_->sphere(cap);
  const Vec from = ray.origin - centre(cap);
  const double a = dot(ray.direction, ray.direction), b = dot(from, ray.direction), c = dot(from, from) - r * r,
               discriminant = b * b - a * c;
  if (!(discriminant > 0)) return;
  const double q = b < 0 ? root(discriminant) - b : -root(discriminant) - b;
  const double t0 = q / a, t1 = q == 0 ? t0 : c / q;
  for (const double t : {std::min(t0, t1), std::max(t0, t1)}) {
    if (!(t >= ray.nearest && t <= ray.farthest)) continue;
    const PaneCoordinates p = water_->pane().coordinates(ray.at(t));
    if (!(p.lift > 0) || water_->owner(p.u * water_->width(), p.v * water_->length()) != cap) continue;
    const Hit hit{t, self, cap, p.u, p.v};
    if (precedes(hit, first)) first = hit;
  }
}

Vec CapSurface::normal(const Ray& ray, const Hit& hit) const { return rainref::scene::normalized(ray.at(hit.t) - centre(hit.part)); }

void add_cap_pane(Scene& scene, std::shared_ptr<const CapWater> water, std::shared_ptr<const Opaque> rim,
                  const parallel::Executor& executor, const PaneMedia& media) {
  add_faces(
      scene, water->pane(), [water](double u, double v) { return water->is_wet(u, v); }, media);
  Material surface = Material::interface_of(media.outside, media.water);
  surface.is_masked = true;
  if (water->caps() > 0) scene.add(std::make_shared<CapSurface>(water), surface);
  if (water->height().height) {
    const Pane part(part_of(water->pane(), water->height()));
    surface.smooth_normals = normals_of(water_normal(part, water->height().height));
    scene.add(std::make_shared<DisplacedWater>(part, water->height().height, executor,
                                               [water](const Vec& place) {
                                                 const PaneCoordinates p = water->pane().coordinates(place);
                                                 return water->owner(p.u * water->width(), p.v * water->length()) < water->caps();
                                               }),
              surface);
  }
  scene.add(std::make_shared<PaneRim>(water->pane(), 2 * WaterLayer::clearance), Material::of(std::move(rim)));
}

}  // namespace rainref::compositor
