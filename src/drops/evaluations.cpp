#include "drops/evaluations.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "capture/bound_texture.h"
#include "drops/scalar.h"
#include "drops/passes.h"
#include "rainref/error.h"

namespace rainref::drops {
namespace {

using capture::PassCase;
using enclosed::Enclosure;

// The corrected pass decides who stays and then sets the life of the others to 0: that decision is taken already.
template <class N>
bool is_ended(N life) {
  return life.v == 0;
}
bool is_ended(Enclosure life) { return life.lo == 0 && life.hi == 0; }
bool is_ended(const enclosed::Rearranged& life) { return is_ended(life.settled()); }

struct Integrate {
  IntegrateUniforms uniforms;
  GlassFrame glass;
  bool corrected;

  template <class N>
  ListedDrop<N> operator()(const Drop& drop) const {
    const scalar::DropState<N> before = state_of<N>(drop);
    const scalar::DropState<N> d = corrected ? scalar::integrate_corrected<N>(uniforms, glass, before).drop
                                             : scalar::integrate_as_published<N>(uniforms, glass, before);
    return {d.u, d.v, d.velocity_u, d.velocity_v, d.mass, d.life, corrected ? !is_ended(d.life) : d.life > N(0.0f)};
  }
};

}  // namespace

std::vector<std::byte> bytes_of(const std::vector<Drop>& drops) {
  std::vector<std::byte> bytes(drops.size() * sizeof(Drop));
  if (!drops.empty()) std::memcpy(bytes.data(), drops.data(), bytes.size());
  return bytes;
}

std::vector<Drop> drops_input(const PassCase& c) {
  std::vector<Drop> drops = capture::records_of<Drop>(capture::record_input(c, "drops"));
  std::set<std::uint32_t> ids;
  for (const Drop& d : drops)
    if (!ids.insert(d.id).second)
      throw Error(ExitCode::port_files, fmt::format("{}/in.drops: expected each id once, found {} twice", c.folder(), d.id));
  return drops;
}

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

std::unique_ptr<capture::PassModel> bind_integrate(const PassCase& c) {
  const std::vector<GlassFrame> glass = capture::records_of<GlassFrame>(capture::record_input(c, "glass_frame"));
  if (glass.size() != 1)
    throw Error(ExitCode::port_files, fmt::format("{}/in.glass_frame: expected one record, found {}", c.folder(), glass.size()));
  Integrate pass{capture::uniforms_of<IntegrateUniforms>(c), glass.front(), c.corrected()};
  return std::make_unique<capture::ListPass>("drops", std::make_unique<DropByDrop<Integrate>>(pass, drops_input(c), c.corrected()));
}

std::vector<capture::Array> recompute_spawn(const PassCase& c) {
  std::vector<CountThreshold> thresholds;
  if (c.corrected()) thresholds = capture::records_of<CountThreshold>(capture::record_input(c, "count_thresholds"));
  const std::vector<SpawnMass> masses = capture::records_of<SpawnMass>(capture::record_input(c, "spawn_masses"));
  std::vector<Drop> drops = drops_input(c);
  const std::vector<Drop> arrivals = arrivals_of(capture::uniforms_of<SpawnUniforms>(c), thresholds, masses);
  drops.insert(drops.end(), arrivals.begin(), arrivals.end());
  capture::Array out = c.outputs.front().array;
  out.width = static_cast<int>(drops.size());
  out.levels = {bytes_of(drops)};
  return {out};
}

}  // namespace rainref::drops
