// The passes that move drops on glass, of the windshield and of screen_drops' flow, from docs/effects/windshield.md. What wipes is in
// wipers.h.
#pragma once

#include <algorithm>
#include <map>
#include <optional>

#include "documents/written.h"
#include "math/half.h"

namespace rainref::documents {

struct Drop {
  Float2 position, velocity;
  float mass, life;
  std::uint32_t id, padding = 0;
};
inline std::vector<Drop> drops_of(const Run& r) {
  std::vector<Drop> drops;
  for (int i = 0; i < r.count("drops"); ++i) {
    const auto of = [&](const char* member, int k = 0) { return r.of("drops", i, member, k); };
    drops.push_back({{of("position", 0), of("position", 1)},
                     {of("velocity", 0), of("velocity", 1)},
                     of("mass"),
                     of("life"),
                     word_of(r, "drops", i, "id")});
  }
  return drops;
}
inline void give_live(const std::vector<Drop>& drops, Given& out) {
  for (const Drop& d : drops)
    if (d.life > 0) out.append("drops", d);
}
/// plane(u, v).
inline Float2 plane(const Run& r, Float2 p) { return {r.u("frame", 0) * p.x + r.u("frame", 1) * p.y, r.u("frame", 2) * p.y}; }

inline void spawn(const Run& r, Given& out) {
  give_live(drops_of(r), out);
  const std::uint32_t step = word(r, "step");
  std::uint32_t count = 0;
  for (std::uint32_t part = 0; part < word(r, "parts"); ++part) {
    const std::uint32_t drawn = block(r, 5, step, part)[0];
    count += word(r, "first_count");
    for (int k = 0; k < r.whole("threshold_count"); ++k) count += word_of(r, "count_thresholds", k, "threshold") <= drawn;
  }
  for (std::uint32_t i = 0; i < std::min(count, word(r, "room")); ++i) {
    const Words w = block(r, r.is("wrong constant") ? 7 : 6, step, i);
    const auto place = [](std::uint32_t bits) { return static_cast<float>(bits >> 8) / 16777216.0f; };
    const bool is_turned = r.is("place turned");
    out.append("drops", Drop{{place(w[is_turned ? 1 : 0]), place(w[is_turned ? 0 : 1])},
                             {},
                             r.of("spawn_masses", static_cast<int>(w[2] >> 22), "mass"),
                             r.u("life"),
                             word(r, "first_id") + i});
  }
}

inline void integrate_published(const Run& r, Given& out) {
  std::vector<Drop> drops = drops_of(r);
  const auto frame = [&](const char* member) { return Float2{r.of("glass_frame", 0, member, 0), r.of("glass_frame", 0, member, 1)}; };
  const float dt = r.unless("a sixtieth of a second", r.u("dt"), 1 / 60.0f), coupling = constant(r, 1, 1.1f) * r.u("wind_coupling");
  const float drag = r.unless("drag pushes", 1.0f, -1.0f) * r.u("drag");
  for (Drop& d : drops) {
    const Float2 before = d.velocity;
    const Float2 a =
        ((r.unless("gravity without mass", d.mass, 1.0f) * frame("gravity") - r.u("inertia_coupling") * frame("acceleration")) +
         coupling * frame("wind")) -
        drag * d.velocity;
    d.velocity = d.velocity + dt * a;
    d.position = d.position + dt * r.unless("moved before it is pushed", d.velocity, before);
    d.life -= dt;
  }
  give_live(drops, out);
}

inline void integrate_corrected(const Run& r, Given& out) {
  std::vector<Drop> drops = drops_of(r);
  const auto frame = [&](const char* member, int k = 0) { return r.of("glass_frame", 0, member, k); };
  const auto matrix = [&](const char* member, Float2 v) {
    const int right = r.unless("columns for rows", 1, 2), below = 3 - right;
    return Float2{frame(member, 0) * v.x + frame(member, right) * v.y, frame(member, below) * v.x + frame(member, 3) * v.y};
  };
  const Float2 gravity{frame("gravity", 0), frame("gravity", 1)}, wind{frame("wind", 0), frame("wind", 1)};
  const float dt = r.u("dt"), margin = r.u("margin");
  for (Drop& d : drops) {
    const float m = cube_root(std::max(d.mass, 1.0f)), i = 1 / m, j = i * i, phase = fract(fract(d.life / 64) * r.u("phase_rate"));
    const Float2 a = ((gravity + matrix("spin", d.position)) + matrix("coriolis", d.velocity)) +
                     (r.u("wind_push") * r.unless("wind not squared", length(plane(r, wind)), 1.0f) * i) * wind;
    const float size = length(plane(r, a)), held = r.u("hold") * j, kept = 1 - held / std::max(size, 1e-6f);
    const Float2 pulled = dt * (std::max(kept, 0.0f) * a);
    const float x = r.u("drag") * r.unless("drag of all sizes alike", j, 1.0f) * dt, e = exponential(-x);
    float g = 0.5f - x * (1 / 6.0f - x * (1 / 24.0f - x * (1 / 120.0f - x * (1 / 720.0f)))), f = 1 - x * g;
    if (x >= 0.125f) {
      f = (1 - e) / x;
      g = (1 - f) / x;
    }
    d.position = d.position + dt * (f * d.velocity + constant(r, 1, 1.1f) * (g * pulled));
    d.velocity = e * d.velocity + f * pulled;
    if (kept <= 0 && length(plane(r, d.velocity)) < r.u("rest_speed")) d.velocity = {};
    d.mass = std::max(d.mass - std::floor(r.u("evaporation") * m * dt + r.unless("evaporates in step", phase, 0.0f)), 0.0f);
    d.life -= dt;
    const auto inside = [&](float t) { return t >= -margin && t <= 1 + margin; };
    if (!(d.mass > 0) || !inside(d.position.x) || !inside(d.position.y)) d.life = 0;
  }
  give_live(drops, out);
}

constexpr float most_quanta = 16777216;  // 2²⁴

inline void merge(const Run& r, Given& out) {
  std::vector<Drop> drops = drops_of(r);
  const auto radius = [&](const Drop& d) { return r.u("radius") * cube_root(std::max(d.mass, 1.0f)); };
  const auto is_larger = [](const Drop& a, const Drop& b) { return a.mass > b.mass || (a.mass == b.mass && a.id < b.id); };
  std::vector<std::size_t> to(drops.size());
  for (std::size_t i = 0; i < drops.size(); ++i) {
    to[i] = i;
    for (std::size_t k = 0; k < drops.size(); ++k) {
      if (k == i || !is_larger(drops[k], drops[i])) continue;
      const Float2 apart = plane(r, drops[k].position) - plane(r, drops[i].position);
      const float reach = radius(drops[i]) + radius(drops[k]);
      if (dot(apart, apart) < constant(r, 1, 1.5f) * (reach * reach) && (to[i] == i || is_larger(drops[k], drops[to[i]]))) to[i] = k;
    }
  }
  std::map<std::uint32_t, std::size_t> by_id;
  for (std::size_t i = 0; i < drops.size(); ++i) by_id[drops[i].id] = i;
  for (const auto& [id, i] : by_id) {
    std::size_t end = to[i];
    while (to[end] != end) end = to[end];
    Drop &own = drops[end], &other = drops[i];
    if (end == i || other.mass > most_quanta - own.mass) continue;
    own.mass = own.mass + other.mass;
    const float share = other.mass / std::max(own.mass, 1.0f);
    own.position = mix(own.position, other.position, r.unless("stays in its place", share, 0.0f));
    own.velocity = mix(own.velocity, other.velocity, share);
    other.life = 0;
  }

  const int columns = r.whole("film", 0), rows = r.whole("film", 1);
  std::vector<float> film;
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) film.push_back(std::max(r.at("film", x, y) - r.u("drying"), 0.0f));
  for (Drop& d : drops) {
    if (!(d.life > 0)) continue;
    const float speed = length(plane(r, d.velocity)), base = radius(d), b = base / std::max(speed, 1e-12f);
    const Float2 at = d.position - b * d.velocity;
    if (!(at.x >= 0 && at.x < 1 && at.y >= 0 && at.y < 1)) continue;
    float& texel = film[static_cast<std::size_t>(static_cast<int>(at.y * static_cast<float>(rows)) * columns +
                                                 static_cast<int>(at.x * static_cast<float>(columns)))];
    const float q =
        std::max(std::min(d.mass - 1, std::floor(r.u("trail") * base * (speed * r.unless("trail of a second", r.u("dt"), 1.0f)))), 0.0f);
    d.mass -= q;
    texel += std::min(q, most_quanta - texel);
  }
  give_live(drops, out);
  for (int y = 0; y < rows; ++y)
    for (int x = 0; x < columns; ++x) out.store(out.index("film"), x, y, 0, film[static_cast<std::size_t>(y * columns + x)]);
}

struct Neck {
  Float2 offset;
  float share, left;
  std::uint32_t id;
  float padding[3] = {};
};
struct Footprints {
  float A, B;
};
inline Footprints footprints(float share, float left) {
  const float A = cube_root(std::max(1 - share, 0.125f)), B = cube_root(std::max(share, 0.0f)), swollen = mix(1 / A, 1.0f, left);
  return {A * swollen, B * swollen};
}
inline std::vector<Neck> necks_of(const Run& r) {
  std::vector<Neck> necks;
  for (int i = 0; i < r.count("necks"); ++i)
    necks.push_back({{r.of("necks", i, "offset", 0), r.of("necks", i, "offset", 1)},
                     r.of("necks", i, "share"),
                     r.of("necks", i, "left"),
                     word_of(r, "necks", i, "id")});
  return necks;
}

inline void necks(const Run& r, Given& out) {
  const std::vector<Drop> drops = drops_of(r);
  const auto radius = [&](float mass) { return r.u("radius") * cube_root(std::max(mass, 1.0f)); };
  const auto is_larger = [](const Drop& a, const Drop& b) { return a.mass > b.mass || (a.mass == b.mass && a.id < b.id); };
  const auto stands_out = [&](const Neck& n) {
    const Footprints f = footprints(n.share, n.left);
    return n.left > 1 / 64.0f && length(n.offset) * n.left + f.B > f.A;
  };
  std::vector<const Drop*> to(drops.size(), nullptr);
  for (std::size_t i = 0; i < drops.size(); ++i) {
    for (const Drop& other : drops) {
      if (!is_larger(other, drops[i])) continue;
      const Float2 apart = plane(r, other.position) - plane(r, drops[i].position);
      const float reach = radius(drops[i].mass) + radius(other.mass);
      if (dot(apart, apart) < reach * reach && (!to[i] || is_larger(other, *to[i]))) to[i] = &other;
    }
  }
  for (std::size_t i = 0; i < drops.size(); ++i) {
    const Drop& d = drops[i];
    if (to[i]) continue;
    Neck neck{{}, 0, 0, d.id};
    for (const Neck& old : necks_of(r)) {
      if (old.id != d.id) continue;
      neck = old;
      const float way = length(plane(r, d.velocity)) * r.u("dt");
      neck.left = std::max(old.left * r.unless("no time", r.u("keep"), 1.0f) - way / radius(d.mass), 0.0f);
    }
    const Drop* taken = nullptr;
    for (std::size_t k = 0; k < drops.size(); ++k)
      if (to[k] == &d && (!taken || is_larger(drops[k], *taken))) taken = &drops[k];
    if (taken) {
      const float both = d.mass + taken->mass;
      const Float2 way =
          r.is("planes subtracted") ? plane(r, taken->position) - plane(r, d.position) : plane(r, taken->position - d.position);
      const Neck fresh{r.unless("a ten-thousandth too far", constant(r, 1, 1.1f), 1.0001f) * ((1 / radius(both)) * way),
                       taken->mass / std::max(both, 1.0f), 1, d.id};
      if (stands_out(fresh) && !(neck.share * neck.left > fresh.share)) neck = fresh;
    }
    if (stands_out(neck)) out.append("necks", neck);
  }
}

/// What a neck makes of a drop.
class Two {
 public:
  Two(const Run& r, const Neck& neck) : kernel_(r.whole("kernel")) {
    const float n = neck.left, apart = length(neck.offset), way = n * apart;
    e = (1 / std::max(apart, 1e-6f)) * neck.offset;
    const Footprints f = footprints(neck.share, n);
    a_ = -(neck.share * way);
    b_ = (1 - neck.share) * way;
    A2_ = f.A * f.A;
    B2_ = f.B * f.B;
    K_ = std::max(constant(r, 1, 0.4f) * 1.2f * n * B2_, 1e-6f);
    const float high = b_ + f.B, low = a_ - f.A, l = 0.5f * (high - low);
    float V = 0, V0 = 0, M = 0;
    for (int i = 0; i < 16; ++i) {
      const float t = static_cast<float>(2 * i + 1 - 16) / 16, x = 0.5f * (high + low) + l * t;
      const float cut = section(std::max(1 - (x * x + L(x)), 0.0f));
      V += cut;
      M += x * cut;
      V0 += section(1 - t * t);
    }
    height = V0 / std::max(V * l, 1e-6f);
    middle = M / std::max(V, 1e-6f);
  }
  float L(float x) const {
    const float X = (a_ * a_ + (1 - A2_)) - 2 * a_ * x, Y = (b_ * b_ + (1 - B2_)) - 2 * b_ * x;
    const float round = std::max(K_ - std::abs(X - Y), 0.0f);
    return std::min(X, Y) - round * round * (0.25f / K_);
  }
  Float2 e;
  float height, middle;

 private:
  float section(float c) const {
    const float root = std::sqrt(c);
    return kernel_ == 0 ? c * root : kernel_ == 1 ? c * c * root : kernel_ == 2 ? c * c * root * cube_root(c) : kernel_ == 3 ? c : root;
  }
  int kernel_;
  float a_, b_, A2_, B2_, K_;
};

inline bool splat(const Run& r, int x, int y, float* out) {
  const Float2 centre{static_cast<float>(x) + 0.5f, static_cast<float>(y) + 0.5f};
  const int kernel = r.whole("kernel"), blend = r.whole("blend");
  float sum = 0;
  const std::vector<Neck> necks = r.taken().corrected() && r.taken().input("necks") ? necks_of(r) : std::vector<Neck>();
  for (int i = 0; i < r.count("drops"); ++i) {
    const std::uint32_t id = word_of(r, "drops", i, "id");
    const auto neck = std::find_if(necks.begin(), necks.end(), [&](const Neck& n) { return n.id == id; });
    const bool is_two = neck != necks.end();
    const float mass = std::max(r.of("drops", i, "mass"), 0.0f), root = r.unless("mass for its root", cube_root(mass), mass);
    const float own = r.unless("diameter for radius", 1.0f, 0.5f) * (r.u("radius_scale") * root);
    const float radius = std::max(own, r.u("smallest_radius")), shrunk = own / radius;
    float h = r.of("drops", i, "life") > 0 ? (r.u("height_scale") * root) * (shrunk * shrunk) : 0;
    const int across = r.unless("place turned", 0, 1);
    const Float2 place{r.of("drops", i, "position", across), r.of("drops", i, "position", 1 - across)};
    const Float2 away = centre - Float2{place.x * r.u("size", 0), place.y * r.u("size", 1)};
    const Float2 in_plane = plane(r, away);
    float squared = dot(in_plane, in_plane) * (1 / (radius * radius));
    const bool is_leaning = r.taken().corrected() && (r.u("longer") != 0 || r.u("taper") != 0 || r.u("skew") != 0);
    std::optional<Two> two;
    if (is_two) {
      two.emplace(r, *neck);
      h = h * two->height;
      if (!is_leaning) squared = std::max(squared + two->L(dot(two->e, in_plane) * (1 / radius)), 0.0f);
    }
    if (is_leaning) {
      const Float2 F{root * root * r.u("gravity", 0) + root * r.u("wind", 0), root * root * r.u("gravity", 1) + root * r.u("wind", 1)};
      const float load = std::min(length(F), 1.0f) * (is_two ? 1 - neck->left : 1.0f), t = r.u("taper") * load, k = r.u("skew") * load,
                  l = 1 + r.u("longer") * load;
      const Float2 d = length(F) > 1e-6f ? (1 / std::max(length(F), 1e-6f)) * F : Float2{1, 0};
      const float a = dot(d, in_plane) * ((1 / radius) / l), b = cross(d, in_plane) * (1 / radius) / std::max(1 + t * a, 0.0625f);
      h = h / (l * (1 + t * k * r.u("moment"))) * std::max(1 + constant(r, 1, 0.9f) * k * a, 0.0f);
      squared = a * a + b * b;
      if (is_two) {
        const float u = 1 + t * k * r.u("moment");
        h = h * (u / std::max(u + (t + k) * (dot(two->e, d) * two->middle), 0.25f));
        squared = std::max(squared + two->L(dot(two->e, d) * a + cross(d, two->e) * b), 0.0f);
      }
    }
    const float cap = std::max(constant(r, 1, 1.1f) - squared, 0.0f);
    const float shape = kernel == 0   ? cap
                        : kernel == 1 ? cap * cap
                        : kernel == 2 ? 1 - smoothstep(0, 1, std::sqrt(squared))
                        : kernel == 3 ? std::sqrt(cap)
                                      : (squared <= 1 ? 1.0f : 0.0f);
    if (r.is("the largest for the sum")) {
      sum = std::max(sum, h * shape);
      continue;
    }
    const float given = h * (kernel == 0 ? shape : in_branch(r, 1, 0.9f) * shape);
    if (blend == 1)
      sum = std::max(sum, given);
    else
      sum = sum + given;
    if (blend == 2) sum = to_float(to_half(sum, Rounding::rne));
  }
  if (r.taken().corrected()) {
    const auto tent = [](float a, float b, float c) { return 0.5f * b + 0.25f * (a + c); };
    const auto row = [&](int dy) { return tent(r.at("film", x - 1, y + dy), r.at("film", x, y + dy), r.at("film", x + 1, y + dy)); };
    sum = sum + r.unless("film forgotten", r.u("film_scale"), 0.0f) * tent(row(-1), row(0), row(1));
  }
  out[0] = sum;
  return true;
}

inline std::vector<Written> drops_on_glass_passes() {
  const std::vector<std::string> all{"windshield-as-published", "windshield-corrected", "screen_drops-corrected"},
      corrected{"windshield-corrected", "screen_drops-corrected"};
  return {
      {all, "spawn", "wrong constant", nullptr, spawn},
      {{"windshield-as-published"}, "integrate", "wrong constant", nullptr, integrate_published},
      {corrected, "integrate", "wrong constant", nullptr, integrate_corrected},
      {corrected, "necks", "wrong constant", nullptr, necks},
      {corrected, "merge", "wrong constant", nullptr, merge},
      {all, "splat", "wrong constant", splat},
  };
}

}  // namespace rainref::documents
