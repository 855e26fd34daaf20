#include "drops/info.h"

#include <cmath>

#include "drops/motion/passes.h"
#include "drops/motion/scalar.h"
#include "drops/motion/spawn.pass.h"
#include "drops/splat/scalar.h"
#include "pass/record_model.h"

namespace rainref::drops {

const enclosed::Profile& loosest_profile() {
  static const enclosed::Profile p = [] {
    enclosed::Profile loose;
    loose.name = "loosest";
    loose.reference = false;
    loose.basic = enclosed::BasicRounding::either;
    loose.contraction = true;
    loose.flush = enclosed::Flush::may;
    loose.division = loose.sqrt = loose.inverse_sqrt = {.ulp = 16, .relative = 0x1p-18};
    loose.pow.relative = 0x1p-14;
    return loose;
  }();
  return p;
}

Surroundings::Surroundings(const float (&frame)[3], const Drop& drop, double base) {
  const double u = drop.position[0], v = drop.position[1], x_of_u = frame[0] * u, x_of_v = frame[1] * v;
  x = x_of_u + x_of_v;
  y = frame[2] * v;
  // A radius is a power, known to 2^-14 at worst; a place a sum of two products, each within a few roundings of its own size.
  radius = 1.01 * base + 0x1p-18 * (std::abs(x_of_u) + std::abs(x_of_v) + std::abs(y));
}
bool Surroundings::meets(const Surroundings& other) const {
  const double dx = x - other.x, dy = y - other.y, reach = radius + other.radius;
  return dx * dx + dy * dy < reach * reach;
}

std::unique_ptr<capture::PassModel> bind_integrate(const capture::PassCase& c) {
  return pass::bind_records<IntegratePass, scalar::IntegratePassText>(c);
}
std::unique_ptr<capture::PassModel> bind_splat(const capture::PassCase& c) { return pass::bind<SplatPass, scalar::SplatPassText>(c); }

std::vector<capture::Array> recompute_spawn(const capture::PassCase& c) {
  const pass::Inputs<SpawnPass> in = pass::inputs_of<SpawnPass>(c);
  std::vector<Drop> drops = in.captured.drops.records;
  const std::vector<Drop> arrivals = arrivals_of(in.uniforms, in.captured.count_thresholds.records, in.captured.spawn_masses.records);
  drops.insert(drops.end(), arrivals.begin(), arrivals.end());
  capture::Array out = c.outputs.front().array;
  out.width = static_cast<int>(drops.size());
  out.levels = {pass::bytes_of(drops)};
  return {out};
}
capture::PassEvaluations spawn_evaluations() {
  capture::PassEvaluations all{"spawn", nullptr, recompute_spawn};
  all.of_state = {"first_id", "room"};
  return all;
}

}  // namespace rainref::drops
