#include "drops/evaluations.h"

#include "drops/passes.h"
#include "drops/scalar.h"
#include "drops/spawn.pass.h"
#include "drops/splat_scalar.h"
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
