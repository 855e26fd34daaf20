#include "edge_splash/shapes.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "cache/kept_images.h"
#include "math/real64.h"

namespace rainref::edge_splash {
namespace {

using Vec = scene::Vector3;

double root(double x) { return x > 0 ? __builtin_sqrt(x) : 0; }
double size_of(const Vec& v) { return root(glm::dot(v, v)); }

struct Hit {
  double t = 1e30;
  Vec normal{0, 0, 0}, albedo{0, 0, 0};
};

/// An axis-aligned box, or a rod: a cylinder with round ends.
struct Solid {
  bool is_box;
  Vec a, b;       // corners of a box, ends of a rod
  double radius;  // of a rod
  Vec albedo;

  Vec centre() const { return 0.5 * (a + b); }
  double bound() const { return 0.5 * size_of(b - a) + radius; }

  void meet(const Vec& from, const Vec& way, Hit& hit) const {
    if (is_box)
      meet_box(from, way, hit);
    else
      meet_rod(from, way, hit);
  }

 private:
  void meet_box(const Vec& from, const Vec& way, Hit& hit) const {
    double enter = -1e30, leave = 1e30;
    int face = 0;
    for (int k = 0; k < 3; ++k) {
      const double d = std::abs(way[k]) < 1e-12 ? (way[k] < 0 ? -1e-12 : 1e-12) : way[k];
      const double t0 = (a[k] - from[k]) / d, t1 = (b[k] - from[k]) / d;
      const double low = std::min(t0, t1), high = std::max(t0, t1);
      if (low > enter) {
        enter = low;
        face = k;
      }
      leave = std::min(leave, high);
    }
    if (!(enter > 1e-6 && enter < leave && enter < hit.t)) return;
    Vec normal{0, 0, 0};
    normal[face] = way[face] > 0 ? -1 : 1;
    hit = {enter, normal, albedo};
  }
  // A cylinder between two spheres.
  void meet_rod(const Vec& from, const Vec& way, Hit& hit) const {
    const Vec axis = b - a, off = from - a;
    const double aa = glm::dot(axis, axis), aw = glm::dot(axis, way), ao = glm::dot(axis, off);
    const double p = aa - aw * aw, q = aa * glm::dot(off, way) - ao * aw, r = aa * glm::dot(off, off) - ao * ao - radius * radius * aa;
    const double disc = q * q - p * r;
    if (disc < 0) return;
    if (p > 1e-12) {
      const double t = (-q - root(disc)) / p, along = ao + t * aw;
      if (along > 0 && along < aa) {
        if (t > 1e-6 && t < hit.t) {
          const Vec n = (1 / radius) * (off + t * way - (along / aa) * axis);
          hit = {t, n, albedo};
        }
        return;
      }
    }
    for (const Vec& end : {a, b}) {
      const Vec c = from - end;
      const double h = glm::dot(c, way), d = h * h - glm::dot(c, c) + radius * radius;
      if (d < 0) continue;
      const double t = -h - root(d);
      if (t > 1e-6 && t < hit.t) hit = {t, (1 / radius) * (c + t * way), albedo};
    }
  }
};

constexpr double fog_density = 0.06;  // [1/m]
Vec sky(const Vec& way) {
  const double t = std::clamp(0.5 + 1.6 * way.y, 0.0, 1.0), s = t * t * (3 - 2 * t);
  const Vec below(0.0045, 0.0075, 0.0105), above(0.062, 0.090, 0.106);
  return below + s * (above - below);
}

std::vector<Solid> solids() {
  std::vector<Solid> all;
  const Vec wood(0.10, 0.075, 0.055), steel(0.16, 0.17, 0.18), stone(0.115, 0.115, 0.11), rope(0.09, 0.08, 0.07);
  const auto box = [&](Vec a, Vec b, const Vec& albedo) { all.push_back({true, a, b, 0, albedo}); };
  const auto rod = [&](Vec a, Vec b, double radius, const Vec& albedo) { all.push_back({false, a, b, radius, albedo}); };

  // The track bends to the left and climbs: z from 0 to -60.
  const auto middle = [](double z) { return Vec(-0.0085 * z * z, 0.10 + 0.0009 * z * z, z); };
  const auto beside = [&](double z, double side) {
    const Vec tangent(-0.017 * z, 0, 1), across = (1 / size_of(tangent)) * Vec(1, 0, 0.017 * z);
    return middle(z) + side * across;
  };
  for (double z = 0; z > -60; z -= 1) {
    for (const double side : {-0.55, 0.55}) rod(beside(z, side), beside(z - 1, side), 0.05, steel);
  }
  for (double z = -0.8; z > -60; z -= 0.8) {
    const Vec l = beside(z, -0.95), r = beside(z, 0.95);
    rod(l - Vec(0, 0.14, 0), r - Vec(0, 0.14, 0), 0.085, wood);
  }
  // Trestles.
  for (double z = -4; z > -60; z -= 6) {
    for (const double side : {-0.8, 0.8}) {
      const Vec top = beside(z, side) - Vec(0, 0.25, 0), foot = beside(z, 1.9 * side) - Vec(0, 9, 0);
      rod(top, foot, 0.11, wood);
    }
    rod(beside(z, -1.1) - Vec(0, 0.3, 0), beside(z, 1.1) - Vec(0, 0.3, 0), 0.12, wood);
    rod(beside(z, -1.15) - Vec(0, 2.2, 0), beside(z, 1.15) - Vec(0, 2.2, 0), 0.08, wood);
  }
  // Posts with wires on the right; the wires sag.
  std::vector<Vec> tops;
  for (double z = -2.5; z > -60; z -= 7) {
    const Vec foot = beside(z, 2.1);
    rod(foot - Vec(0, 9, 0), foot + Vec(0, 2.9, 0), 0.085, wood);
    rod(foot + Vec(-0.55, 2.55, 0), foot + Vec(0.55, 2.55, 0), 0.05, wood);
    tops.push_back(foot + Vec(0, 2.62, 0));
  }
  for (std::size_t i = 0; i + 1 < tops.size(); ++i) {
    for (const double side : {-0.48, 0.48}) {
      Vec before = tops[i] + Vec(side, 0, 0);
      for (int k = 1; k <= 12; ++k) {
        const double t = k / 12.0;
        const Vec next = tops[i] + t * (tops[i + 1] - tops[i]) + Vec(side, -1.5 * t * (1 - t), 0);
        rod(before, next, 0.018, rope);
        before = next;
      }
    }
  }
  // A handrail on the left, near the eye.
  for (double z = -1.3; z > -14; z -= 1.5) rod(beside(z, -1.35) - Vec(0, 0.5, 0), beside(z, -1.35) + Vec(0, 0.85, 0), 0.045, wood);
  for (double z = 0.2; z > -12; z -= 0.75) {
    rod(beside(z, -1.35) + Vec(0, 0.85, 0), beside(z - 0.75, -1.35) + Vec(0, 0.85, 0), 0.04, wood);
    rod(beside(z, -1.35) + Vec(0, 0.42, 0), beside(z - 0.75, -1.35) + Vec(0, 0.42, 0), 0.028, wood);
  }
  // Ledges: slabs that rise out of the abyss.
  box({2.9, -9, -9.5}, {6.5, 0.15, -5.5}, stone);
  box({4.2, 0.15, -9.0}, {6.5, 0.75, -6.3}, stone);
  box({5.2, 0.75, -8.6}, {6.5, 1.45, -7.0}, stone);
  box({3.2, 0.15, -6.3}, {3.8, 0.5, -5.7}, stone);
  box({-9.5, -9, -15}, {-5.0, 0.6, -8.5}, stone);
  box({-9.5, 0.6, -14}, {-6.6, 1.5, -9.5}, stone);
  box({-8.6, 1.5, -13}, {-7.2, 2.6, -10.4}, stone);
  box({1.5, -9, -26}, {8, 1.0, -19}, stone);
  box({3.5, 1.0, -25}, {8, 2.4, -20}, stone);
  // A cart on the track.
  const Vec cart = middle(-11);
  box(cart + Vec(-0.62, 0.30, -0.7), cart + Vec(0.62, 0.36, 0.7), wood);
  box(cart + Vec(-0.62, 0.36, 0.62), cart + Vec(0.62, 1.0, 0.7), wood);
  box(cart + Vec(-0.62, 0.36, -0.7), cart + Vec(0.62, 1.0, -0.62), wood);
  box(cart + Vec(-0.62, 0.36, -0.62), cart + Vec(-0.54, 1.0, 0.62), wood);
  box(cart + Vec(0.54, 0.36, -0.62), cart + Vec(0.62, 1.0, 0.62), wood);
  return all;
}

/// A solid and its bounding sphere, relative to the eye.
struct Seen {
  const Solid* solid;
  Vec to;  // its centre
  double bound;
};

Vec radiance(const std::vector<Seen>& near, const Vec& from, const Vec& way, double* distance) {
  Hit hit;
  for (const Seen& s : near) s.solid->meet(from, way, hit);
  *distance = hit.t;
  const Vec behind = sky(way);
  if (hit.t >= 1e30) return behind;
  // Light comes from the whole sky above, and a wet surface reflects it toward grazing eyes.
  const double open = 0.5 + 0.5 * hit.normal.y, facing = std::clamp(-glm::dot(way, hit.normal), 0.0, 1.0), m = 1 - facing;
  const Vec mirrored = sky(way - 2 * glm::dot(way, hit.normal) * hit.normal);
  const double gloss = 0.02 + 0.55 * (m * m) * (m * m) * m * open;
  const Vec surface = (0.35 + 1.9 * open * open) * hit.albedo * sky(Vec(0, 1, 0)) + gloss * mirrored;
  const double clear = exp_real(Real64(-fog_density * hit.t)).v;
  return behind + clear * (surface - behind);
}

/// The rays through a rectangle of the picture: a cone from the eye.
struct Cone {
  Vec axis;
  double cosine = 1, sine;  ///< of its half angle

  template <class Way>
  Cone(const Way& way, double x0, double y0, double x1, double y1) : axis(way(0.5 * (x0 + x1), 0.5 * (y0 + y1))) {
    for (const double x : {x0, x1}) {
      for (const double y : {y0, y1}) cosine = std::min(cosine, glm::dot(axis, way(x, y)));
    }
    sine = root(1 - cosine * cosine) + 1e-6;
  }
  /// Copies the solids of `all` that reach into it, in order; leaving out the others changes no ray.
  void keep(const std::vector<Seen>& all, std::vector<Seen>& near) const {
    near.clear();
    for (const Seen& s : all) {
      const double along = glm::dot(s.to, axis), apart = root(glm::dot(s.to, s.to) - along * along);
      if (apart * cosine - along * sine <= 1.001 * s.bound + 1e-6 && along > -s.bound) near.push_back(s);
    }
  }
};

ShapesView rendered(const scene::Camera& camera, int width, int height, double far, const parallel::Executor& executor) {
  constexpr int tile = 16, samples = 4;  // a grid of samples x samples rays to a pixel
  const std::vector<Solid> made = solids();
  std::vector<Seen> all;
  for (const Solid& s : made) all.push_back({&s, s.centre() - camera.position, s.bound()});
  const scene::Camera::Basis basis = camera.basis();
  const double half_height = camera.half_height(), half_width = half_height * width / height;
  const auto way = [&](double x, double y) {
    return scene::normalized(basis.forward + (2 * x / width - 1) * half_width * basis.right +
                             (2 * y / height - 1) * half_height * basis.up);
  };
  ShapesView view{Image(Format::rgba32f, width, height), Image(Format::r32f, width, height)};
  executor.for_tiles(width, height, tile, tile, [&](const parallel::Tile& t) {
    std::vector<Seen> of_tile, near;
    Cone(way, t.x0, t.y0, t.x1, t.y1).keep(all, of_tile);
    for (int y = t.y0; y < t.y1; ++y) {
      for (int x = t.x0; x < t.x1; ++x) {
        Cone(way, x, y, x + 1, y + 1).keep(of_tile, near);
        Vec sum(0, 0, 0);
        double distance;
        for (int k = 0; k < samples * samples; ++k) {
          const double px = x + (k % samples + 0.5) / samples, py = y + (k / samples + 0.5) / samples;
          sum = sum + radiance(near, camera.position, way(px, py), &distance);
        }
        float* out = view.colour.row<float>(y) + 4 * x;
        for (int c = 0; c < 3; ++c) out[c] = static_cast<float>(sum[c] / (samples * samples));
        out[3] = 1;
        const Vec centre = way(x + 0.5, y + 0.5);
        radiance(near, camera.position, centre, &distance);
        view.depth.row<float>(y)[x] =
            static_cast<float>(distance >= 1e30 ? far : std::min(far, distance * glm::dot(centre, basis.forward)));
      }
    }
  });
  return view;
}

std::vector<Image> both(const parallel::Executor& executor, const scene::Camera& camera, const int& width, const int& height,
                        const double& far) {
  ShapesView view = rendered(camera, width, height, far, executor);
  std::vector<Image> all;
  for (Image* image : {&view.colour, &view.depth}) all.push_back(std::move(*image));
  return all;
}

}  // namespace

ShapesView render_shapes(const scene::Camera& camera, int width, int height, double far, const parallel::Executor& executor) {
  std::vector<Image> images = cache::kept("edge_splash shapes", {{Format::rgba32f, width, height}, {Format::r32f, width, height}},
                                          rows_here, executor, both, camera, width, height, far);
  return {std::move(images[0]), std::move(images[1])};
}

}  // namespace rainref::edge_splash
