// windshield_frame and wipe_drops bound to captured cases.
#include <algorithm>
#include <map>
#include <numeric>
#include <set>

#include "drops/info.h"
#include "math/whole.h"
#include "pass/record_model.h"
#include "windshield/info.h"
#include "windshield/motion/kernels.h"
#include "windshield/scalar.h"

namespace rainref::windshield {
namespace {

using capture::KeyedRecord;
using capture::PassCase;
using capture::PassModel;
using drops::Drop;
using enclosed::Enclosure;
using perturbed::Perturbed;
using Number = scalar::Scalar<float>;

using WipedPass = pass::Bound<WipeDropsPass, scalar::WipeDropsPassText>;

/// Inputs of wipe_drops corrected.
struct Sweep {
  const WipedPass& pass;
  const WipeDropsUniforms& uniforms = pass.uniforms;
  std::span<const Wiper> wipers = WipeDropsPass::wipers(pass);
  const std::vector<Drop>& drops = pass.captured.drops.records;

  int column(int texel) const { return texel % uniforms.columns; }
  int row(int texel) const { return texel / uniforms.columns; }
  float film(int texel) const { return *pass.captured.film.at(column(texel), row(texel)); }
  template <class N>
  scalar::WipedDrop<N> wiped(const Drop& drop) const {
    return pass.record<N, true>(drop);
  }
  template <class N>
  scalar::SweptTexel<N> swept(int texel) const {
    return scalar::swept_texel<N>(uniforms, wipers.data(), column(texel), row(texel));
  }
  /// Texels with water that a record may sweep.
  std::vector<int> wet_texels() const {
    std::set<int> found;
    for (const Wiper& w : wipers) {
      const TexelBox box = swept_texels(w, uniforms);
      for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x)
          if (const int texel = y * uniforms.columns + x; film(texel) > 0) found.insert(texel);
    }
    return {found.begin(), found.end()};
  }
};

constexpr std::uint64_t most_units = static_cast<std::uint64_t>(drops::most_mass);
/// Integer mass units, as in the pass.
std::uint64_t mass_units_of(float x) { return x > 0 ? static_cast<std::uint64_t>(std::min(x, drops::most_mass)) : 0; }

/// A record and one of its radial bins; none: no water is handed on.
using Place = int;
constexpr Place none = -1;
Place place_of(const WipeDropsUniforms& u, float wiper, float bin) {
  if (!(wiper >= 0)) return none;
  return whole_within(wiper, 0, u.wiper_count - 1) * u.bin_count + whole_within(bin, 0, u.bin_count - 1);
}
/// The place of a drop or texel on one path.
template <class Swept>
Place decided_place(const WipeDropsUniforms& u, const Swept& s) {
  if (s.wiper.is_point() && s.bin.is_point()) return place_of(u, s.wiper.lo, s.bin.lo);
  enclosed::give_up();
  return none;
}
/// All results of `decide`, ascending. False if there are too many.
template <class Decide>
bool places(Decide decide, std::vector<Place>& out) {
  enclosed::PathEnumeration paths;
  out.clear();
  const bool whole = paths.for_each_alternative([&] { out.push_back(decide()); });
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return whole;
}

/// The drops after the sweep. A texel of the film hands on whole mass units, so the water of a place is a sum of integers: of the texels
/// that certainly go there, and of texels beside a border, each of which may or may not. Drops that may get the water of one place form a
/// group, because the receiver depends on the positions of the others.
class SweptDrops : public capture::KeyedModel {
 public:
  explicit SweptDrops(const WipedPass& pass) : s_{pass} {
    const enclosed::ProfileScope scope(drops::loosest_profile());
    share_film();
    make_groups();
  }
  int groups() const override { return static_cast<int>(groups_.size()); }
  const std::vector<capture::FieldRange>& ranges() const override { return Drop::ranges(true); }

  void enclose(int group, std::vector<KeyedRecord>& out) const override {
    std::map<Place, std::size_t> takers;  // of the lowest id
    const std::size_t first = out.size();
    for (const std::size_t i : groups_[static_cast<std::size_t>(group)]) {
      const Drop& drop = s_.drops[i];
      const scalar::WipedDrop<Enclosure> d = s_.wiped<Enclosure>(drop);
      const Place place = decided_place(s_.uniforms, d);
      // It was settled beforehand that the others of this place are in the group.
      if (!std::binary_search(places_[i].begin(), places_[i].end(), place)) enclosed::give_up();
      out.push_back(pass::keyed_record<scalar::DropState<Enclosure>>(d, d.lives(), drop.id));
      if (place == none) continue;
      const auto [taker, is_first] = takers.emplace(place, out.size() - 1);
      if (!is_first && drop.id < out[taker->second].id) taker->second = out.size() - 1;
    }
    for (const auto& [place, at] : takers) {
      if (at < first) continue;
      Enclosure& mass = out[at].floats[4];
      const std::uint64_t have = mass_units_of(mass.lo);
      const auto [least, greatest] = film_of(place);
      const auto with = [&](std::uint64_t gained) { return static_cast<float>(std::min(have + gained, most_units)); };
      mass = Enclosure(with(least), with(greatest));
    }
  }
  std::optional<std::vector<std::byte>> reference() const override { return list<Number>(); }
  std::optional<std::vector<std::byte>> perturbed() const override { return list<Perturbed>(); }

 private:
  struct Share {
    std::uint64_t sure = 0;
    std::vector<int> open;  ///< texels
  };

  void share_film() {
    std::vector<Place> found;
    for (const int texel : s_.wet_texels()) {
      const bool whole = places([&] { return decided_place(s_.uniforms, s_.swept<Enclosure>(texel)); }, found);
      if (!whole) {
        found.resize(s_.wipers.size() * static_cast<std::size_t>(s_.uniforms.bin_count));
        std::iota(found.begin(), found.end(), 0);
      }
      for (const Place place : found) {
        if (place == none) continue;
        if (whole && found.size() == 1)
          shares_[place].sure += mass_units_of(s_.film(texel));
        else
          shares_[place].open.push_back(texel);
      }
    }
  }
  void make_groups() {
    const std::size_t n = s_.drops.size();
    std::vector<std::size_t> to(n);
    std::iota(to.begin(), to.end(), 0);
    const auto root = [&](std::size_t i) {
      while (to[i] != i) i = to[i] = to[to[i]];
      return i;
    };
    std::map<Place, std::size_t> first;
    places_.resize(n);
    std::vector<std::size_t> anywhere;
    for (std::size_t i = 0; i < n; ++i) {
      if (!places([&] { return decided_place(s_.uniforms, s_.wiped<Enclosure>(s_.drops[i])); }, places_[i])) {
        anywhere.push_back(i);
        places_[i].clear();
      }
      for (const Place place : places_[i]) {
        if (place == none) continue;
        const auto [other, is_first] = first.emplace(place, i);
        if (!is_first) to[root(i)] = root(other->second);
      }
    }
    // A drop that may be anywhere belongs to all groups, so its group is given up.
    for (const std::size_t i : anywhere)
      for (const auto& [place, other] : first) to[root(other)] = root(i);
    std::map<std::size_t, std::size_t> number;
    for (std::size_t i = 0; i < n; ++i) {
      const auto [at, is_new] = number.emplace(root(i), groups_.size());
      if (is_new) groups_.emplace_back();
      groups_[at->second].push_back(i);
    }
  }
  /// Minimum and maximum water of a place under the current profile.
  std::pair<std::uint64_t, std::uint64_t> film_of(Place place) const {
    const auto found = shares_.find(place);
    if (found == shares_.end()) return {0, 0};
    std::uint64_t least = found->second.sure, greatest = least;
    std::vector<Place> all;
    for (const int texel : found->second.open) {
      const bool whole = places([&] { return decided_place(s_.uniforms, s_.swept<Enclosure>(texel)); }, all);
      const std::uint64_t water = mass_units_of(s_.film(texel));
      const bool may = !whole || std::binary_search(all.begin(), all.end(), place);
      if (may) greatest += water;
      if (may && whole && all.size() == 1) least += water;
    }
    return {least, greatest};
  }

  template <class N>
  std::vector<std::byte> list() const {
    std::map<Place, std::uint64_t> film;
    for (const int texel : s_.wet_texels()) {
      const scalar::SweptTexel<N> swept = s_.swept<N>(texel);
      const Place place = place_of(s_.uniforms, swept.wiper.v, swept.bin.v);
      if (place != none) film[place] += mass_units_of(s_.film(texel));
    }
    std::vector<Drop> out;
    std::map<Place, std::size_t> takers;
    for (const Drop& drop : s_.drops) {
      const scalar::WipedDrop<N> d = s_.wiped<N>(drop);
      if (!d.lives()) continue;
      out.push_back(pass::stored<scalar::DropState<N>>(d, drop));
      const Place place = place_of(s_.uniforms, d.wiper.v, d.bin.v);
      if (place == none) continue;
      const auto [taker, is_first] = takers.emplace(place, out.size() - 1);
      if (!is_first && drop.id < out[taker->second].id) taker->second = out.size() - 1;
    }
    for (const auto& [place, at] : takers)
      out[at].mass = static_cast<float>(std::min(mass_units_of(out[at].mass) + film[place], most_units));
    return pass::bytes_of(out);
  }

  Sweep s_;
  std::map<Place, Share> shares_;
  std::vector<std::vector<Place>> places_;  ///< of each drop
  std::vector<std::vector<std::size_t>> groups_;
};

class WipeCorrected : public capture::ModelOf<WipedPass> {
 public:
  explicit WipeCorrected(WipedPass wiped) : ModelOf(std::move(wiped)), drops_(pass()) {}
  const capture::KeyedModel* keyed(std::string_view output) const override { return output == "drops" ? &drops_ : nullptr; }

 private:
  SweptDrops drops_;
};

}  // namespace

std::unique_ptr<PassModel> bind_windshield_frame(const PassCase& c) {
  return pass::bind_records<WindshieldFramePass, scalar::WindshieldFramePassText>(c);
}

std::unique_ptr<PassModel> bind_wipe_drops(const PassCase& c) {
  if (!c.corrected()) return pass::bind_records<WipeDropsPass, scalar::WipeDropsPassText>(c);
  return std::make_unique<WipeCorrected>(pass::bound<WipeDropsPass, scalar::WipeDropsPassText>(c));
}

}  // namespace rainref::windshield
