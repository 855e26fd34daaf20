// merge bound to captured cases.
//
// Drops that may touch, directly or through others, are one group: mergers are decided within it, and each pair whose touching is open
// gives two alternatives. Trails leave whole mass units on the film, rounded down. With thousands of them this rounding is open for most
// drops, so it is not an alternative but an interval of the drop's mass and of the texel's water. Agreement of the two is not judged.
#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <type_traits>

#include "drops/motion/scalar.h"
#include "drops/info.h"
#include "math/whole.h"
#include "pass/record_model.h"

namespace rainref::drops {
namespace {

using capture::KeyedRecord;
using capture::PassCase;
using enclosed::Enclosure;
using perturbed::Perturbed;
using Number = scalar::Scalar<float>;
using State = scalar::DropState<Enclosure>;

template <class N>
double mass_of(const scalar::DropState<N>& d) {
  return static_cast<double>(d.mass.v);
}
double mass_of(const State& d) { return d.mass.lo; }

/// Integers that bound an integer.
struct MassRange {
  std::int64_t least = 0, most = 0;
};
struct PossibleDeposit {
  int x0 = 0, x1 = 0, y0 = 0, y1 = 0;  ///< texels where it may fall, including the last ones
  MassRange mass_units;
};

class Merging {
 public:
  explicit Merging(pass::Inputs<MergePass> in)
      : u_(in.uniforms), drops_(std::move(in.captured.drops.records)), film_(std::move(in.captured.film.texels)) {
    std::erase_if(drops_, [](const Drop& d) { return !(d.life > 0); });
    std::sort(drops_.begin(), drops_.end(), [](const Drop& a, const Drop& b) { return a.id < b.id; });
    make_groups();
    find_texels();
  }
  const MergeUniforms& uniforms() const { return u_; }
  int groups() const { return static_cast<int>(groups_.size()); }
  /// Calls f(group) with the groups that may leave water in a texel, ascending.
  template <class F>
  void each_group_over(int x, int y, const F& f) const {
    for (const int g : over_[block_of(x, y)])
      if (groups_[static_cast<std::size_t>(g)].leaves.holds(x, y)) f(g);
  }
  const float& film(int texel) const { return (*film_)[static_cast<std::size_t>(texel)]; }

  /// A drop after the merge: `state` without its trail.
  template <class N>
  struct Member {
    const Drop* drop;
    bool lives = true;
    scalar::DropState<N> state;
  };
  template <class N>
  std::vector<Member<N>> merged(int group) const {
    const Group& g = groups_[static_cast<std::size_t>(group)];
    std::vector<Member<N>> all;
    for (const std::size_t i : g.drops) all.push_back({&drops_[i], true, state_of<N>(drops_[i])});
    Pairs touching_ones;
    for (const auto& [a, b] : g.pairs)
      if (touching(all[a].state, all[b].state)) touching_ones.emplace_back(a, b);
    merge(all, touching_ones);
    return all;
  }
  /// All groups together, whichever drops touch; with a mistake, drops that are far apart may merge.
  template <class N>
  std::vector<Member<N>> merged_from_anywhere() const {
    std::vector<Member<N>> all;
    std::vector<Base<N>> bases;
    for (const Drop& d : drops_) bases.push_back(base_of(all.emplace_back(Member<N>{&d, true, state_of<N>(d)}).state));
    Pairs touching_ones;
    for (std::size_t a = 0; a < bases.size(); ++a)
      for (std::size_t b = a + 1; b < bases.size(); ++b)
        if (touching(bases[a], bases[b])) touching_ones.emplace_back(a, b);
    merge(all, touching_ones);
    return all;
  }
  std::size_t drops() const { return drops_.size(); }

  template <class N>
  scalar::Trail<N> trail(const scalar::DropState<N>& d) const {
    return scalar::trail(u_, d);
  }
  /// The trail without a decision about its rounding; its mass is subtracted from `d`.
  PossibleDeposit take_trail(State& d) const {
    const scalar::Trail<Enclosure> t = scalar::tail(u_, d);
    PossibleDeposit out;
    if (t.mass_units.is_vacuous() || t.u.is_vacuous() || t.v.is_vacuous()) {
      enclosed::give_up();
      return out;
    }
    const auto whole = [&](float left) {
      const double below = left > 0 ? std::floor(std::min(static_cast<double>(left), 0x1p40)) : 0;
      const double most = static_cast<double>(d.mass.lo) - 1;
      return most > 0 ? static_cast<std::int64_t>(std::min(most, below)) : 0;
    };
    out.mass_units = {whole(t.mass_units.lo), whole(t.mass_units.hi)};
    if (out.mass_units.most == 0) return out;
    const auto texels = [](Enclosure x, int size, int& from, int& last) {
      x = x * Enclosure(static_cast<float>(size));
      from = whole_within(x.lo, 0, size - 1);
      last = whole_within(x.hi, 0, size - 1);
    };
    texels(t.u, u_.film[0], out.x0, out.x1);
    texels(t.v, u_.film[1], out.y0, out.y1);
    d.mass = Enclosure(d.mass.lo - static_cast<float>(out.mass_units.most), d.mass.lo - static_cast<float>(out.mass_units.least));
    return out;
  }

 private:
  using Pairs = std::vector<std::pair<std::size_t, std::size_t>>;

  /// A box of texels, the last ones included; empty at first.
  struct Box {
    int x0 = 0, y0 = 0, x1 = -1, y1 = -1;
    bool holds(int x, int y) const { return x0 <= x && x <= x1 && y0 <= y && y <= y1; }
  };
  struct Group {
    std::vector<std::size_t> drops;  ///< ascending
    Pairs pairs;                     ///< pairs that may touch, as indices into `drops`
    Box leaves;                      ///< texels where it may leave water
  };

  template <class N>
  static void merge(std::vector<Member<N>>& all, const Pairs& touching_ones) {
    constexpr std::size_t none = ~std::size_t{0};
    std::vector<std::size_t> to(all.size(), none);
    for (const auto& [a, b] : touching_ones) {
      const auto [small, large] = is_larger(*all[b].drop, *all[a].drop) ? std::pair(a, b) : std::pair(b, a);
      if (to[small] == none || is_larger(*all[large].drop, *all[to[small]].drop)) to[small] = large;
    }
    // In ascending id, as drops_ are.
    for (std::size_t i = 0; i < all.size(); ++i) {
      if (to[i] == none) continue;
      std::size_t root = to[i];
      while (to[root] != none) root = to[root];
      Member<N>&into = all[root], &from = all[i];
      if (mass_of(into.state) + static_cast<double>(from.drop->mass) > most_mass) continue;
      into.state = scalar::absorb(into.state, from.state);
      from.lives = false;
    }
  }

  /// A drop's position on the glass, as a circle.
  template <class N>
  struct Base {
    N x, y, radius;
  };
  template <class N>
  Base<N> base_of(const scalar::DropState<N>& d) const {
    return {scalar::plane_x(u_, d.u, d.v), scalar::plane_y(u_, d.v), scalar::base_radius(u_, d.mass)};
  }
  template <class N>
  static bool touching(const Base<N>& a, const Base<N>& b) {
    return scalar::touches(a.x, a.y, a.radius, b.x, b.y, b.radius);
  }
  template <class N>
  bool touching(const scalar::DropState<N>& a, const scalar::DropState<N>& b) const {
    return scalar::touches(scalar::plane_x(u_, a.u, a.v), scalar::plane_y(u_, a.v), scalar::base_radius(u_, a.mass),
                           scalar::plane_x(u_, b.u, b.v), scalar::plane_y(u_, b.v), scalar::base_radius(u_, b.mass));
  }
  bool may_touch(const Drop& a, const Drop& b) const {
    bool may = false;
    const State s = state_of<Enclosure>(a), t = state_of<Enclosure>(b);
    enclosed::PathEnumeration paths;
    const bool whole = paths.for_each_alternative([&] { may |= touching(s, t); });
    return may || !whole;
  }

  void make_groups() {
    const enclosed::ProfileScope scope(loosest_profile());
    std::vector<std::pair<Surroundings, std::size_t>> from_left;
    for (std::size_t i = 0; i < drops_.size(); ++i)
      from_left.emplace_back(Surroundings(u_.frame, drops_[i], scalar::base_radius(u_, Number(drops_[i].mass)).v), i);
    std::sort(from_left.begin(), from_left.end(), [](const auto& a, const auto& b) { return a.first.x < b.first.x; });
    std::vector<Surroundings> around;
    for (const auto& drop : from_left) around.push_back(drop.first);
    Pairs pairs;
    for (const auto& [k, m] : meeting_ones(around)) {
      const std::size_t i = from_left[k].second, j = from_left[m].second;
      if (may_touch(drops_[i], drops_[j])) pairs.emplace_back(i, j);
    }
    std::vector<std::size_t> to(drops_.size());
    std::iota(to.begin(), to.end(), 0);
    const auto root = [&](std::size_t i) {
      while (to[i] != i) i = to[i] = to[to[i]];
      return i;
    };
    for (const auto& [a, b] : pairs) to[root(a)] = root(b);
    std::map<std::size_t, std::size_t> number;
    std::vector<std::size_t> place(drops_.size());
    for (std::size_t i = 0; i < drops_.size(); ++i) {
      const auto [at, is_new] = number.emplace(root(i), groups_.size());
      if (is_new) groups_.emplace_back();
      Group& g = groups_[at->second];
      place[i] = g.drops.size();
      g.drops.push_back(i);
    }
    for (const auto& [a, b] : pairs) groups_[number.at(root(a))].pairs.emplace_back(place[a], place[b]);
  }

  // A merged drop lies between its parts, and its tail within the sum of their radii.
  void find_texels() {
    over_.resize(block_of(u_.film[0] - 1, u_.film[1] - 1) + 1);
    for (std::size_t g = 0; g < groups_.size(); ++g) {
      double u0 = 2, u1 = -1, v0 = 2, v1 = -1, mass = 0;
      bool moves = false;
      for (const std::size_t i : groups_[g].drops) {
        const Drop& d = drops_[i];
        u0 = std::min<double>(u0, d.position[0]);
        u1 = std::max<double>(u1, d.position[0]);
        v0 = std::min<double>(v0, d.position[1]);
        v1 = std::max<double>(v1, d.position[1]);
        mass += d.mass;
        moves |= d.velocity[0] != 0 || d.velocity[1] != 0;
      }
      if (!moves) continue;
      const auto total = static_cast<float>(mass);
      const double radius = 1.01 * scalar::base_radius(u_, Number(total)).v, shear = u_.frame[1] / u_.frame[2];
      const double reach_v = radius / u_.frame[2], reach_u = radius * (1 + (shear < 0 ? -shear : shear)) / u_.frame[0];
      const auto texel = [](double at, int size) { return whole_within(at * size, 0, size - 1); };
      // One more texel on each side, for rounding.
      Box& b = groups_[g].leaves;
      b = {std::max(0, texel(u0 - reach_u, u_.film[0]) - 1), std::max(0, texel(v0 - reach_v, u_.film[1]) - 1),
           std::min(u_.film[0] - 1, texel(u1 + reach_u, u_.film[0]) + 1), std::min(u_.film[1] - 1, texel(v1 + reach_v, u_.film[1]) + 1)};
      for (int y = b.y0 / block; y <= b.y1 / block; ++y)
        for (int x = b.x0 / block; x <= b.x1 / block; ++x) over_[block_of(x * block, y * block)].push_back(static_cast<int>(g));
    }
  }
  std::size_t block_of(int x, int y) const {
    const int columns = (u_.film[0] + block - 1) / block;
    return static_cast<std::size_t>(y / block) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x / block);
  }

  static constexpr int block = 16;  // texels a side

  MergeUniforms u_;
  std::vector<Drop> drops_;  ///< live ones, in ascending id
  std::shared_ptr<const std::vector<float>> film_;
  std::vector<Group> groups_;
  std::vector<std::vector<int>> over_;  ///< of each block, the groups that may leave water in it
};

class MergedDrops : public capture::KeyedModel {
 public:
  explicit MergedDrops(const Merging& merging) : m_(merging) {}
  int groups() const override { return m_.groups(); }
  const std::vector<capture::FieldRange>& ranges() const override { return Drop::ranges(true); }
  void enclose(int group, std::vector<KeyedRecord>& out) const override {
    for (Merging::Member<Enclosure>& one : m_.merged<Enclosure>(group)) {
      if (one.lives) m_.take_trail(one.state);
      out.push_back(pass::keyed_record(one.state, one.lives, one.drop->id));
    }
  }
  std::optional<std::vector<std::byte>> reference() const override { return list<Number>(); }
  std::optional<std::vector<std::byte>> perturbed() const override { return list<Perturbed>(); }

 private:
  template <class N>
  std::vector<std::byte> list() const {
    std::vector<Drop> out;
    const auto add = [&](const std::vector<Merging::Member<N>>& members) {
      for (const Merging::Member<N>& one : members) {
        if (!one.lives) continue;
        scalar::DropState<N> left = one.state;
        left.mass = left.mass - m_.trail(left).mass_units;
        out.push_back(pass::stored(left, *one.drop));
      }
    };
    constexpr std::size_t most_for_all_pairs = 512;
    // Only a mistake merges drops that are far apart; devices and coverage test the same pairs as the pass.
    const perturbed::Behaviour& how = perturbed::behaviour();
    const bool is_mistaken = how.fault != perturbed::Fault::none || how.follows();
    if (std::is_same_v<N, Perturbed> && is_mistaken && m_.drops() <= most_for_all_pairs)
      add(m_.merged_from_anywhere<N>());
    else
      for (int group = 0; group < groups(); ++group) add(m_.merged<N>(group));
    std::sort(out.begin(), out.end(), [](const Drop& a, const Drop& b) { return a.id < b.id; });  // the same order with and without groups
    return pass::bytes_of(out);
  }
  const Merging& m_;
};

class MergeModel : public capture::PassModel {
 public:
  explicit MergeModel(pass::Inputs<MergePass> in) : PassModel(in.width, in.height, in.values), merging_(std::move(in)), drops_(merging_) {}
  void evaluate(int x, int y, Number* out) const override { value(x, y, out); }
  void evaluate(int x, int y, scalar::Scalar<double>* out) const override { value(x, y, out); }
  void evaluate(int x, int y, Perturbed* out) const override { value(x, y, out); }
  void enclose(int x, int y, const float*, Enclosure* out) const override {
    const int texel = y * width() + x;
    MassRange sum;
    merging_.each_group_over(x, y, [&](int group) {
      const MassRange more = left_by(group, x, y);
      sum.least += more.least;
      sum.most += more.most;
    });
    const Enclosure dry = scalar::dried(merging_.uniforms(), Enclosure::load(&merging_.film(texel)));
    const auto with = [](float before, std::int64_t added) {
      return static_cast<float>(std::min(before + static_cast<double>(added), static_cast<double>(most_mass)));
    };
    out[0] = Enclosure(with(dry.lo, sum.least), with(dry.hi, sum.most));
  }
  const capture::KeyedModel* keyed(std::string_view output) const override { return output == "drops" ? &drops_ : nullptr; }

 private:
  /// Under every alternative of the group.
  MassRange left_by(int group, int x, int y) const {
    std::vector<MassRange> all;
    enclosed::PathEnumeration paths;
    const bool whole = paths.for_each_alternative([&] {
      MassRange& sum = all.emplace_back();
      for (Merging::Member<Enclosure>& one : merging_.merged<Enclosure>(group)) {
        if (!one.lives) continue;
        const PossibleDeposit d = merging_.take_trail(one.state);
        if (x < d.x0 || x > d.x1 || y < d.y0 || y > d.y1) continue;
        if (d.x0 == d.x1 && d.y0 == d.y1) sum.least += d.mass_units.least;
        sum.most += d.mass_units.most;
      }
    });
    if (!whole) enclosed::give_up();
    MassRange out = all.front();
    for (const MassRange& q : all) out = {std::min(out.least, q.least), std::max(out.most, q.most)};
    return out;
  }
  template <class N>
  void value(int x, int y, N* out) const {
    const int texel = y * width() + x;
    const MergeUniforms& u = merging_.uniforms();
    double sum = scalar::dried(u, N::load(&merging_.film(texel))).v;
    const auto falls_here = [](N at, int size, int here) {
      return whole_within((at * N(static_cast<float>(size))).v, 0, size - 1) == here;
    };
    merging_.each_group_over(x, y, [&](int group) {
      for (const Merging::Member<N>& one : merging_.merged<N>(group)) {
        if (!one.lives) continue;
        const scalar::Trail<N> t = merging_.trail(one.state);
        if (t.mass_units.v > 0 && falls_here(t.u, u.film[0], x) && falls_here(t.v, u.film[1], y)) sum += t.mass_units.v;
      }
    });
    const auto water = static_cast<float>(std::min(sum, static_cast<double>(most_mass)));
    out[0] = N::load(&water);
  }

  Merging merging_;
  MergedDrops drops_;
};

}  // namespace

std::unique_ptr<capture::PassModel> bind_merge(const PassCase& c) { return std::make_unique<MergeModel>(pass::inputs_of<MergePass>(c)); }

}  // namespace rainref::drops
