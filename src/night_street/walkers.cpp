// People on the pavements, in coats, most of them under umbrellas.
#include "night_street/city.h"

namespace rainref::night_street {

namespace {

constexpr double diagonal = 0.7071067811865476;
constexpr std::array<std::array<double, 2>, 8> around{
    {{1, 0}, {diagonal, diagonal}, {0, 1}, {-diagonal, diagonal}, {-1, 0}, {-diagonal, -diagonal}, {0, -1}, {diagonal, -diagonal}}};

/// A person who walks along z. Measures are for a height of 1.75 m: s sideways, y up from the ground, f forward.
struct Walker {
  City& city;
  double x, z, heading, size;

  Vec at(double s, double y, double f) const { return {x + size * s, plan::kerb_height + size * y, z + heading * size * f}; }

  /// A trunk of eight sides between two levels; half widths across and along at the lower and at the upper level.
  void trunk(double y0, double y1, std::array<double, 2> low, std::array<double, 2> high, int material) const {
    std::vector<Plane> planes;
    for (const auto& [cx, cz] : around) {
      // The side touches both ellipses at this angle: its normal is perpendicular to the rim and to the line between the two points.
      const Vec lower = at(low[0] * cx, y0, low[1] * cz), upper = at(high[0] * cx, y1, high[1] * cz);
      const Vec out = unit({cx / low[0], 0, heading * cz / low[1]}), up = unit(upper - lower);
      const Vec normal = unit(out - dot(out, up) * up);
      planes.push_back({normal, dot(normal, lower)});
    }
    const double bottom = at(0, y0, 0).y, top = at(0, y1, 0).y;
    planes.push_back({{0, 1, 0}, top});
    planes.push_back({{0, -1, 0}, -bottom});
    const double wide = size * max_of(low[0], high[0]) * 1.1, deep = size * max_of(low[1], high[1]) * 1.1;
    city.add_convex(planes, {{x - wide, bottom, z - deep}, {x + wide, top, z + deep}}, material);
  }
  /// A rod of six sides that is thicker at its first end.
  void limb(const Vec& from, const Vec& to, double thick, double thin, int material) const {
    const Vec axis = unit(to - from), side = unit(cross(axis, magnitude(axis.x) < 0.7 ? Vec{1, 0, 0} : Vec{0, 0, 1})),
              other = cross(axis, side);
    const double span = length(to - from);
    std::vector<Plane> planes;
    constexpr double half_root3 = 0.8660254037844386;
    for (const auto& [a, b] :
         {std::array{1.0, 0.0}, {0.5, half_root3}, {-0.5, half_root3}, {-1.0, 0.0}, {-0.5, -half_root3}, {0.5, -half_root3}}) {
      const Vec out = a * side + b * other;
      const Vec normal = unit(span * out + (size * (thick - thin)) * axis);
      planes.push_back({normal, dot(normal, from + (size * thick) * out)});
    }
    planes.push_back({axis, dot(axis, to)});
    planes.push_back({-1.0 * axis, -dot(axis, from)});
    const double r = 1.2 * size * thick;
    city.add_convex(planes,
                    {{min_of(from.x, to.x) - r, min_of(from.y, to.y) - r, min_of(from.z, to.z) - r},
                     {max_of(from.x, to.x) + r, max_of(from.y, to.y) + r, max_of(from.z, to.z) + r}},
                    material);
  }
  void ball(const Vec& centre, double radius, int material) const {
    Solid ball;
    ball.shape = Solid::sphere;
    ball.a = centre;
    ball.b = {size * radius, 0, 0};
    city.add(ball, material);
  }
  void shoe(double s, double y, double f, int material) const {
    const Vec a = at(s - 0.042, y, f - 0.05), b = at(s + 0.042, y + 0.06, f + 0.18);
    city.add_box({a.x, a.y, min_of(a.z, b.z)}, {b.x, b.y, max_of(a.z, b.z)}, material);
  }
};

struct Clothes {
  int coat, trousers, skin, hair, shoes;
};

void add_person(const Walker& w, const Clothes& of, bool holds_umbrella) {
  // In mid-stride.
  w.limb(w.at(-0.085, 0.92, 0), w.at(-0.085, 0.50, 0.17), 0.085, 0.06, of.trousers);
  w.limb(w.at(-0.085, 0.52, 0.16), w.at(-0.085, 0.07, 0.26), 0.06, 0.045, of.trousers);
  w.shoe(-0.085, 0, 0.27, of.shoes);
  w.limb(w.at(0.085, 0.92, 0), w.at(0.085, 0.49, 0), 0.085, 0.06, of.trousers);
  w.limb(w.at(0.085, 0.51, 0), w.at(0.085, 0.11, -0.24), 0.06, 0.045, of.trousers);
  w.shoe(0.085, 0.03, -0.27, of.shoes);
  w.trunk(0.60, 1.02, {0.20, 0.17}, {0.165, 0.12}, of.coat);
  w.trunk(1.00, 1.34, {0.165, 0.12}, {0.215, 0.13}, of.coat);
  w.trunk(1.34, 1.46, {0.215, 0.13}, {0.09, 0.08}, of.coat);  // shoulders
  w.limb(w.at(0, 1.42, 0), w.at(0, 1.54, 0.01), 0.055, 0.05, of.skin);
  w.ball(w.at(0, 1.625, 0.015), 0.105, of.skin);
  w.ball(w.at(0, 1.65, -0.02), 0.108, of.hair);
  w.limb(w.at(-0.215, 1.37, 0), w.at(-0.255, 1.10, -0.06), 0.058, 0.048, of.coat);
  w.limb(w.at(-0.255, 1.12, -0.06), w.at(-0.245, 0.88, 0.06), 0.048, 0.04, of.coat);
  w.ball(w.at(-0.245, 0.85, 0.07), 0.045, of.skin);
  if (holds_umbrella) {
    w.limb(w.at(0.215, 1.37, 0), w.at(0.25, 1.12, 0.03), 0.058, 0.05, of.coat);
    w.limb(w.at(0.25, 1.13, 0.02), w.at(0.17, 1.24, 0.24), 0.05, 0.04, of.coat);
    w.ball(w.at(0.165, 1.26, 0.26), 0.045, of.skin);
  } else {
    w.limb(w.at(0.215, 1.37, 0), w.at(0.255, 1.10, 0.05), 0.058, 0.048, of.coat);
    w.limb(w.at(0.255, 1.12, 0.05), w.at(0.245, 0.90, 0.20), 0.048, 0.04, of.coat);
    w.ball(w.at(0.245, 0.87, 0.22), 0.045, of.skin);
  }
}

/// A dome of eight gores over the point where it is held: planes that touch a sphere at three heights.
void add_umbrella(const Walker& w, int canopy, int shaft) {
  const Vec hand = w.at(0.165, 1.20, 0.26);
  const double x = hand.x, z = hand.z, rim = plan::kerb_height + 1.86 * w.size;
  constexpr double sphere = 0.66, below = 0.36;  // its centre lies below the rim, whose radius is 0.553
  w.city.add_pole({x, hand.y, z}, 0.012, rim - hand.y + 0.2, shaft);
  std::vector<Plane> gores;
  // Cosine and sine of the elevations at which planes touch: 36, 52 and 74 degrees.
  for (const auto& [level, up] : {std::array{0.809, 0.588}, {0.616, 0.788}, {0.276, 0.961}})
    for (const auto& [nx, nz] : around) {
      const Vec normal = unit({level * nx, up, level * nz});
      gores.push_back({normal, sphere + dot(normal, {x, rim - below, z})});
    }
  gores.push_back({{0, -1, 0}, -rim});
  w.city.add_convex(gores, {{x - 0.64, rim - 0.01, z - 0.64}, {x + 0.64, rim + 0.34, z + 0.64}}, canopy);
}

}  // namespace

void build_walkers(City& city) {
  constexpr std::array<Vec, 5> canopies{Vec{0.02, 0.02, 0.025}, Vec{0.35, 0.03, 0.03}, Vec{0.03, 0.05, 0.10}, Vec{0.40, 0.28, 0.03},
                                        Vec{0.02, 0.02, 0.02}};
  constexpr std::array<Vec, 5> coats{Vec{0.035, 0.038, 0.05}, Vec{0.16, 0.12, 0.075}, Vec{0.05, 0.06, 0.045}, Vec{0.12, 0.025, 0.025},
                                     Vec{0.075, 0.075, 0.08}};
  for (int i = 0; i < 26; ++i) {
    const auto id = static_cast<std::uint64_t>(3000 + i);
    const double side = i % 2 == 0 ? -1 : 1;
    const double x = side * (5.6 + 1.4 * city.random(id, Purpose::walker_place));
    const double z = -150 + 12 * i + 9 * city.random(id, Purpose::walker_stride);
    if (magnitude(z) < 3) continue;  // room for a camera on the pavement near the origin
    const Walker walker{city, x, z, city.random(id, Purpose::walker_heading) < 0.5 ? -1.0 : 1.0,
                        0.93 + 0.12 * city.random(id, Purpose::walker_size)};
    const double tone = city.random(id, Purpose::walker_coat);
    const Clothes clothes{city.add_material({coats[static_cast<std::size_t>(5 * tone)], {}, 0.02, false}),
                          city.add_material({{0.022, 0.024, 0.032}, {}, 0.02, false}),
                          city.add_material({{0.25, 0.16, 0.12}, {}, 0, false}), city.add_material({{0.03, 0.022, 0.016}, {}, 0.02, false}),
                          city.add_material({{0.012, 0.011, 0.010}, {}, 0.03, false})};
    const bool holds_umbrella = city.random(id, Purpose::umbrella) >= 0.25;
    add_person(walker, clothes, holds_umbrella);
    if (!holds_umbrella) continue;
    const auto pick = static_cast<std::size_t>(5 * city.random(id, Purpose::umbrella_colour));
    add_umbrella(walker, city.add_material({canopies[pick], {}, 0.03, false}), clothes.shoes);
  }
}

}  // namespace rainref::night_street
