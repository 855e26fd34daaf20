#include "compositor/water_layer.h"

#include <algorithm>

#include <fmt/format.h>

#include "compositor/packet.h"
#include "math/half.h"
#include "rainref/error.h"

namespace rainref::compositor {

WaterLayer::WaterLayer(const Image& height) : width_(height.width()), height_(height.height()) {
  if (height.format() != Format::r16f && height.format() != Format::r32f)
    throw Error(ExitCode::usage, "height of the water: expected an r16f or r32f image");
  if (width_ < 3 || height_ < 3)
    throw Error(ExitCode::usage, fmt::format("height of the water: expected at least 3x3 texels, found {}x{}", width_, height_));
  const std::size_t columns = static_cast<std::size_t>(width_);
  metres_.assign(columns * static_cast<std::size_t>(height_), 0);
  wet_.assign(metres_.size(), 0);
  for (int j = 1; j < height_ - 1; ++j) {
    for (int i = 1; i < width_ - 1; ++i) {
      const float mm = height.format() == Format::r16f ? to_float(height.row<Half>(j)[i]) : height.row<float>(j)[i];
      if (!(mm > 0)) continue;
      const std::size_t here = static_cast<std::size_t>(j) * columns + static_cast<std::size_t>(i);
      metres_[here] = static_cast<float>(1e-3 * mm);
      highest_ = std::max(highest_, static_cast<double>(metres_[here]));
      for (const std::size_t cell : {here, here - 1, here - columns, here - columns - 1}) wet_[cell] = 1;
    }
  }
}

bool WaterLayer::is_wet(double u, double v) const {
  const double x = u * width_ - 0.5, y = v * height_ - 0.5;
  if (!(x >= 0 && y >= 0 && x < width_ - 1 && y < height_ - 1)) return false;
  return is_wet_cell(static_cast<int>(x), static_cast<int>(y));
}

double WaterLayer::texel(int i, int j) const {
  i = std::clamp(i, 0, width_ - 1);
  j = std::clamp(j, 0, height_ - 1);
  return metres_[static_cast<std::size_t>(j) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(i)];
}

double WaterLayer::at(double u, double v) const {
  const double x = std::clamp(u * width_ - 0.5, 0.0, width_ - 1.0), y = std::clamp(v * height_ - 0.5, 0.0, height_ - 1.0);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const double a = x - i, b = y - j;
  return (1 - b) * ((1 - a) * texel(i, j) + a * texel(i + 1, j)) + b * ((1 - a) * texel(i, j + 1) + a * texel(i + 1, j + 1));
}

double WaterLayer::surface(double u, double v) const {
  if (!is_wet(u, v)) return -1;
  const double x = u * width_ - 0.5, y = v * height_ - 0.5;
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  const double a = x - i, b = y - j, right = texel(i + 1, j), up = texel(i, j + 1);
  // The diagonal runs from the right texel to the upper one.
  const double corner = a + b <= 1 ? texel(i, j) : texel(i + 1, j + 1), along = a + b <= 1 ? a : 1 - a, aloft = a + b <= 1 ? b : 1 - b;
  const double across = a + b <= 1 ? right : up, above = a + b <= 1 ? up : right;
  return corner + along * (across - corner) + aloft * (above - corner) + clearance;
}

WaterLayer::Rise WaterLayer::rise(double u, double v) const {
  const double x = std::clamp(u * width_ - 0.5, 0.0, width_ - 1.0), y = std::clamp(v * height_ - 0.5, 0.0, height_ - 1.0);
  const int i = static_cast<int>(x), j = static_cast<int>(y);
  Rise sum{0, 0};
  for (const int dj : {0, 1}) {
    for (const int di : {0, 1}) {
      const double weight = (di == 0 ? 1 - (x - i) : x - i) * (dj == 0 ? 1 - (y - j) : y - j);
      sum.u += weight * (texel(i + di + 1, j + dj) - texel(i + di - 1, j + dj));
      sum.v += weight * (texel(i + di, j + dj + 1) - texel(i + di, j + dj - 1));
    }
  }
  return {0.5 * width_ * sum.u, 0.5 * height_ * sum.v};
}

Vec SlopedWater::normal(const Ray& ray, const Hit& hit) const {
  const WaterLayer::Rise rise = water_->rise(hit.u, hit.v);
  const Vec face = pane().normal(hit.u), sloped = pane().tilted(hit.u, rise.u, rise.v);
  return dot(ray.direction, face) * dot(ray.direction, sloped) > 0 ? sloped : face;
}

namespace {

// A texel's centre is a vertex.
HeightfieldFrame frame_of(const Pane& pane, const WaterLayer& water) {
  if (!pane.is_flat()) throw Error(ExitCode::usage, "displaced water: expected a flat pane, found a bent one");
  const double w = water.width(), h = water.height();
  return {pane.point(0.5 / w, 0.5 / h, WaterLayer::clearance), ((w - 1) / w) * pane.shape().e_u, ((h - 1) / h) * pane.shape().e_v,
          pane.normal(0)};
}

}  // namespace

DisplacedWater::DisplacedWater(const Pane& pane, std::shared_ptr<const WaterLayer> water, const parallel::Executor& executor,
                               std::function<bool(const Vec&)> is_hidden)
    : water_(std::move(water)),
      is_hidden_(std::move(is_hidden)),
      field_(frame_of(pane, *water_), water_->width() - 1, water_->height() - 1) {
  field_.assign(water_->metres(), executor);
}

bool DisplacedWater::is_there(const Ray& ray, const Hit& hit) const {
  const int cell = static_cast<int>(hit.part / 2), columns = field_.columns();
  return water_->is_wet_cell(cell % columns, cell / columns) && !(is_hidden_ && is_hidden_(ray.at(hit.t)));
}

void DisplacedWater::meet(std::uint32_t self, std::uint32_t primitive, const Ray& ray, Hit& first) const {
  Ray rest = ray;
  // A dry cell is level, so the ray crosses the sheet there once; behind it another cell may be wet. The step behind the crossing starts at
  // a rounding of t and grows, because the walk's own rounding may find the same crossing again.
  for (double step = 0x1p-52; step < 1; step *= 2) {
    Hit hit = first;
    field_.meet(self, primitive, rest, hit);
    if (hit.surface != self || hit.t == first.t) return;
    if (is_there(ray, hit)) {
      first = hit;
      return;
    }
    rest.nearest = hit.t + step * (hit.t < 1e-3 ? 1e-3 : hit.t);
  }
}

std::uint32_t DisplacedWater::meet_packet(std::uint32_t self, std::uint32_t primitive, std::uint32_t lanes, Packet& packet) const {
  Hit before[Packet::slots];
  for_each_lane(lanes, [&](std::uint32_t slot) { before[slot] = packet.first[slot]; });
  std::uint32_t changed = field_.meet_packet(self, primitive, lanes, packet);
  for_each_lane(changed, [&](std::uint32_t slot) {
    if (is_there(packet.ray(slot), packet.first[slot])) return;
    Hit first = before[slot];
    meet(self, primitive, packet.ray(slot), first);
    packet.set_first(slot, first);
    if (first.t == before[slot].t && first.surface == before[slot].surface) changed &= ~(1u << slot);
  });
  return changed;
}

std::function<Vec(const Place&)> water_normal(const Pane& pane, std::shared_ptr<const WaterLayer> water) {
  return [pane, water = std::move(water)](const Place& place) {
    const PaneCoordinates foot = pane.coordinates(place.point);
    const WaterLayer::Rise rise = water->rise(foot.u, foot.v);
    return pane.tilted(foot.u, rise.u, rise.v);
  };
}

}  // namespace rainref::compositor
