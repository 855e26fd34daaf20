#include "drops/info.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <type_traits>

#include "drops/motion/passes.h"
#include "drops/motion/scalar.h"
#include "drops/motion/spawn.pass.h"
#include "drops/splat/scalar.h"
#include "pass/record_model.h"
#include "random/draws.h"

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
  const std::vector<Drop> arrivals =
      arrivals_of<random::PerturbedWords>(in.uniforms, in.captured.count_thresholds.records, in.captured.spawn_masses.records);
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

namespace {

using capture::KeyedRecord;
using enclosed::Enclosure;
using perturbed::Perturbed;
using Number = scalar::Scalar<float>;

class NecksOfDrops : public capture::KeyedModel {
 public:
  explicit NecksOfDrops(pass::Inputs<NecksPass> in) : u_(in.uniforms), drops_(std::move(in.captured.drops.records)) {
    std::erase_if(drops_, [](const Drop& d) { return !(d.life > 0); });
    std::sort(drops_.begin(), drops_.end(), [](const Drop& a, const Drop& b) { return a.id < b.id; });
    for (const Neck& n : in.captured.necks.records) necks_.emplace(n.id, n);
    find_near();
  }
  int groups() const override { return static_cast<int>(drops_.size()); }
  const std::vector<capture::FieldRange>& ranges() const override { return Neck::ranges(true); }
  void enclose(int group, std::vector<KeyedRecord>& out) const override { add<Enclosure>(group, out); }
  bool rearrange(int group, std::vector<KeyedRecord>& out) const override {
    add<enclosed::Rearranged>(group, out);
    return true;
  }
  std::optional<std::vector<std::byte>> reference() const override { return list<Number>(); }
  std::optional<std::vector<std::byte>> perturbed() const override { return list<Perturbed>(); }

 private:
  template <class N>
  using State = scalar::NeckState<N>;
  using Places = std::vector<std::size_t>;

  template <class N>
  void add(int group, std::vector<KeyedRecord>& out) const {
    const auto i = static_cast<std::size_t>(group);
    const std::optional<State<N>> neck = neck_of<N>(i, near_[i]);
    const bool lives = neck && scalar::stands_out(*neck);
    out.push_back(lives ? pass::keyed_record(*neck, true, drops_[i].id) : KeyedRecord{drops_[i].id, false, {}, {}});
  }
  template <class N>
  bool touching(std::size_t a, std::size_t b) const {
    const auto s = state_of<N>(drops_[a]), t = state_of<N>(drops_[b]);
    return scalar::overlap(u_, s, t);
  }
  /// The drop into which this one merges or whose chain it follows; none if it stays.
  template <class N>
  std::optional<std::size_t> larger_of(std::size_t i, const Places& others) const {
    std::optional<std::size_t> to;
    for (const std::size_t k : others)
      if (k != i && is_larger(drops_[k], drops_[i]) && (!to || is_larger(drops_[k], drops_[*to])) && touching<N>(i, k)) to = k;
    return to;
  }
  template <class N>
  std::optional<State<N>> neck_of(std::size_t i, const Places& others) const {
    if (larger_of<N>(i, others)) return std::nullopt;
    std::optional<State<N>> neck;
    const Drop& d = drops_[i];
    if (const auto own = necks_.find(d.id); own != necks_.end())
      neck = scalar::receded(u_, pass::loaded<State<N>>(own->second), state_of<N>(d));
    std::optional<std::size_t> taken;
    for (const std::size_t k : others) {
      if (k == i || !is_larger(d, drops_[k]) || (taken && is_larger(drops_[*taken], drops_[k])) || !touching<N>(i, k)) continue;
      if (larger_of<N>(k, others == all_ ? all_ : near_[k]) == i) taken = k;
    }
    if (!taken) return neck;
    const State<N> fresh = scalar::joined(u_, state_of<N>(d), state_of<N>(drops_[*taken]));
    return neck ? scalar::more_seen(*neck, fresh) : fresh;
  }
  template <class N>
  std::vector<std::byte> list() const {
    // As in merge: only a mistake merges drops that are far apart. Each tried mistake tests all pairs again, which takes the diagnosis a
    // minute for 240 drops. In longer lists only nearby drops are tested, so a mistake that reaches far ones is not reproduced.
    constexpr std::size_t most_for_all_pairs = 128;
    const perturbed::Behaviour& how = perturbed::behaviour();
    const bool from_anywhere =
        std::is_same_v<N, Perturbed> && (how.fault != perturbed::Fault::none || how.follows()) && drops_.size() <= most_for_all_pairs;
    std::vector<Neck> out;
    for (std::size_t i = 0; i < drops_.size(); ++i) {
      const std::optional<State<N>> neck = neck_of<N>(i, from_anywhere ? all_ : near_[i]);
      if (neck && scalar::stands_out(*neck)) out.push_back(pass::stored(*neck, Neck{{}, 0, 0, drops_[i].id, 0, 0, 0}));
    }
    return pass::bytes_of(out);
  }

  void find_near() {
    std::vector<Surroundings> around;
    for (const Drop& d : drops_) around.emplace_back(u_.frame, d, scalar::neck_radius(u_, Number(d.mass)).v);
    all_.resize(drops_.size());
    std::iota(all_.begin(), all_.end(), 0);
    near_.resize(drops_.size());
    for (const auto& [a, b] : meeting_ones(around)) {
      near_[a].push_back(b);
      near_[b].push_back(a);
    }
  }

  NecksUniforms u_;
  std::vector<Drop> drops_;  ///< live ones, in ascending id
  std::map<std::uint32_t, Neck> necks_;
  std::vector<Places> near_;  ///< that may touch
  Places all_;
};

}  // namespace

std::unique_ptr<capture::PassModel> bind_necks(const capture::PassCase& c) {
  return std::make_unique<capture::ListPass>("necks", std::make_unique<NecksOfDrops>(pass::inputs_of<NecksPass>(c)));
}

}  // namespace rainref::drops
