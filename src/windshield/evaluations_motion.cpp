// windshield_frame and wipe_drops bound to captured cases.
#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>
#include <numeric>
#include <set>

#include <fmt/format.h>

#include "capture/bound_texture.h"
#include "drops/evaluations.h"
#include "math/whole.h"
#include "rainref/error.h"
#include "windshield/motion_scalar.h"
#include "windshield/evaluations.h"
#include "windshield/wipe_drops.h"

namespace rainref::windshield {
namespace {

using capture::KeyedRecord;
using capture::PassCase;
using capture::PassModel;
using drops::Drop;
using drops::ListedDrop;
using enclosed::Enclosure;
using perturbed::Perturbed;
using Number = scalar::Scalar<float>;

// ---- windshield_frame ----------------------------------------------------------------------------------------------
class Frame : public capture::KeyedModel {
 public:
  Frame(const WindshieldFrameUniforms& uniforms, bool corrected) : uniforms_(uniforms), corrected_(corrected) {}
  int groups() const override { return 1; }
  const std::vector<capture::FieldRange>& ranges() const override { return drops::frame_ranges(); }
  void enclose(int, std::vector<KeyedRecord>& out) const override {
    out.push_back(record_of(forces<Enclosure>(), [](const Enclosure& e) { return e; }));
  }
  bool rearrange(int, std::vector<KeyedRecord>& out) const override {
    out.push_back(record_of(forces<enclosed::Rearranged>(), [](const enclosed::Rearranged& r) { return r.settled(); }));
    return true;
  }
  std::optional<std::vector<std::byte>> reference() const override { return list<Number>(); }
  std::optional<std::vector<std::byte>> perturbed() const override { return list<Perturbed>(); }

 private:
  template <class N>
  motion_scalar::GlassForces<N> forces() const {
    return corrected_ ? motion_scalar::windshield_frame_corrected<N>(uniforms_)
                      : motion_scalar::windshield_frame_as_published<N>(uniforms_);
  }
  template <class N, class F>
  static KeyedRecord record_of(const motion_scalar::GlassForces<N>& f, const F& enclosure_of) {
    KeyedRecord r;
    const auto put = [&](const N* from, int count) { std::transform(from, from + count, std::back_inserter(r.floats), enclosure_of); };
    put(f.gravity, 2);
    put(f.wind, 2);
    put(f.acceleration, 2);
    put(f.spin, 4);
    put(f.coriolis, 4);
    return r;
  }
  template <class N>
  std::vector<std::byte> list() const {
    const auto f = forces<N>();
    drops::GlassFrame frame{};
    const auto put = [](const N* from, float* to, int count) {
      for (int k = 0; k < count; ++k) to[k] = from[k].v + 0.0f;  // stored zeros are positive
    };
    put(f.gravity, frame.gravity, 2);
    put(f.wind, frame.wind, 2);
    put(f.acceleration, frame.acceleration, 2);
    put(f.spin, frame.spin, 4);
    put(f.coriolis, frame.coriolis, 4);
    std::vector<std::byte> bytes(sizeof frame);
    std::memcpy(bytes.data(), &frame, sizeof frame);
    return bytes;
  }

  WindshieldFrameUniforms uniforms_;
  bool corrected_;
};

// ---- wipe_drops ----------------------------------------------------------------------------------------------------
template <class N>
motion_scalar::WipedDrop<N> loaded(const Drop& d) {
  motion_scalar::WipedDrop<N> w;
  w.u = N::load(&d.position[0]);
  w.v = N::load(&d.position[1]);
  w.velocity_u = N::load(&d.velocity[0]);
  w.velocity_v = N::load(&d.velocity[1]);
  w.mass = N::load(&d.mass);
  w.life = N::load(&d.life);
  return w;
}
template <class N>
ListedDrop<N> listed(const motion_scalar::WipedDrop<N>& w) {
  return {w.u, w.v, w.velocity_u, w.velocity_v, w.mass, w.life, w.life > N(0.0f)};
}

struct WipePublished {
  WipeDropsUniforms uniforms;
  std::vector<Wiper> wipers;

  template <class N>
  ListedDrop<N> operator()(const Drop& drop) const {
    return listed(motion_scalar::wipe_drop_as_published<N>(uniforms, wipers.data(), loaded<N>(drop)));
  }
};

/// What wipe_drops corrected takes.
struct Sweep {
  WipeDropsUniforms uniforms;
  std::vector<Wiper> wipers;
  std::vector<Drop> drops;
  std::vector<float> film;

  int column(int texel) const { return texel % uniforms.columns; }
  int row(int texel) const { return texel / uniforms.columns; }
  template <class N>
  motion_scalar::WipedDrop<N> wiped(const Drop& drop) const {
    return motion_scalar::wipe_drop_corrected<N>(uniforms, wipers.data(), loaded<N>(drop));
  }
  template <class N>
  motion_scalar::SweptTexel<N> swept(int texel) const {
    return motion_scalar::swept_texel<N>(uniforms, wipers.data(), column(texel), row(texel));
  }
  /// Texels with water that a record may sweep.
  std::vector<int> wet_texels() const {
    std::set<int> found;
    for (const Wiper& w : wipers) {
      const TexelBox box = swept_texels(w, uniforms);
      for (int y = box.y0; y < box.y1; ++y)
        for (int x = box.x0; x < box.x1; ++x)
          if (film[static_cast<std::size_t>(y) * static_cast<std::size_t>(uniforms.columns) + static_cast<std::size_t>(x)] > 0)
            found.insert(y * uniforms.columns + x);
    }
    return {found.begin(), found.end()};
  }
};

constexpr std::uint64_t most = static_cast<std::uint64_t>(drops::most_mass);
/// Whole mass units, as the pass has them.
std::uint64_t mass_units_of(float x) { return x > 0 ? static_cast<std::uint64_t>(std::min(x, drops::most_mass)) : 0; }

/// A record and one of its radial bins; none: nothing is handed on there.
using Place = int;
constexpr Place none = -1;
Place place_of(const WipeDropsUniforms& u, float wiper, float bin) {
  if (!(wiper >= 0)) return none;
  return whole_within(wiper, 0, u.wiper_count - 1) * u.bin_count + whole_within(bin, 0, u.bin_count - 1);
}
/// The place of a drop or texel in one run of a paths.
template <class Swept>
Place decided_place(const WipeDropsUniforms& u, const Swept& s) {
  if (s.wiper.is_point() && s.bin.is_point()) return place_of(u, s.wiper.lo, s.bin.lo);
  enclosed::give_up();
  return none;
}
/// Every place that `decide` comes to, ascending. False where there are too many.
template <class Decide>
bool places(Decide decide, std::vector<Place>& out) {
  enclosed::PathEnumeration paths;
  out.clear();
  const bool whole = paths.for_each_alternative([&] { out.push_back(decide()); });
  std::sort(out.begin(), out.end());
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return whole;
}

/// The drops after the sweep. What a texel of the film hands on is whole mass units, so the water that a place gets is a sum
/// of integers: of the texels that surely go there, and of those beside a border, each of which may or may not. Drops that
/// may get the water of one place are one group, because which of them gets it hangs on where the others are.
class SweptDrops : public capture::KeyedModel {
 public:
  explicit SweptDrops(std::shared_ptr<const Sweep> sweep) : s_(std::move(sweep)) {
    const enclosed::ProfileScope scope(drops::loosest_profile());
    share_film();
    make_groups();
  }
  int groups() const override { return static_cast<int>(groups_.size()); }
  const std::vector<capture::FieldRange>& ranges() const override { return drops::drop_ranges(true); }

  void enclose(int group, std::vector<KeyedRecord>& out) const override {
    std::map<Place, std::size_t> takers;  // of the lowest id
    const std::size_t first = out.size();
    for (const std::size_t i : groups_[static_cast<std::size_t>(group)]) {
      const Drop& drop = s_->drops[i];
      const motion_scalar::WipedDrop<Enclosure> d = s_->wiped<Enclosure>(drop);
      const Place place = decided_place(s_->uniforms, d);
      // That the others of this place are in the group was settled beforehand.
      if (!std::binary_search(places_[i].begin(), places_[i].end(), place)) enclosed::give_up();
      out.push_back(drops::enclosed_record(listed(d), drop.id));
      if (place == none) continue;
      const auto [taker, is_first] = takers.emplace(place, out.size() - 1);
      if (!is_first && drop.id < out[taker->second].id) taker->second = out.size() - 1;
    }
    for (const auto& [place, at] : takers) {
      if (at < first) continue;
      Enclosure& mass = out[at].floats[4];
      const std::uint64_t have = mass_units_of(mass.lo);
      const auto [least, greatest] = film_of(place);
      const auto with = [&](std::uint64_t gained) { return static_cast<float>(std::min(have + gained, most)); };
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
    for (const int texel : s_->wet_texels()) {
      const bool whole = places([&] { return decided_place(s_->uniforms, s_->swept<Enclosure>(texel)); }, found);
      if (!whole) {
        found.resize(s_->wipers.size() * static_cast<std::size_t>(s_->uniforms.bin_count));
        std::iota(found.begin(), found.end(), 0);
      }
      for (const Place place : found) {
        if (place == none) continue;
        if (whole && found.size() == 1)
          shares_[place].sure += mass_units_of(s_->film[static_cast<std::size_t>(texel)]);
        else
          shares_[place].open.push_back(texel);
      }
    }
  }
  void make_groups() {
    const std::size_t n = s_->drops.size();
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
      if (!places([&] { return decided_place(s_->uniforms, s_->wiped<Enclosure>(s_->drops[i])); }, places_[i])) {
        anywhere.push_back(i);
        places_[i].clear();
      }
      for (const Place place : places_[i]) {
        if (place == none) continue;
        const auto [other, is_first] = first.emplace(place, i);
        if (!is_first) to[root(i)] = root(other->second);
      }
    }
    // One that may be anywhere belongs to all of them: its group is given up.
    for (const std::size_t i : anywhere)
      for (const auto& [place, other] : first) to[root(other)] = root(i);
    std::map<std::size_t, std::size_t> number;
    for (std::size_t i = 0; i < n; ++i) {
      const auto [at, is_new] = number.emplace(root(i), groups_.size());
      if (is_new) groups_.emplace_back();
      groups_[at->second].push_back(i);
    }
  }
  /// The least and the most that a place gets under the profile in force.
  std::pair<std::uint64_t, std::uint64_t> film_of(Place place) const {
    const auto found = shares_.find(place);
    if (found == shares_.end()) return {0, 0};
    std::uint64_t least = found->second.sure, greatest = least;
    std::vector<Place> all;
    for (const int texel : found->second.open) {
      const bool whole = places([&] { return decided_place(s_->uniforms, s_->swept<Enclosure>(texel)); }, all);
      const std::uint64_t water = mass_units_of(s_->film[static_cast<std::size_t>(texel)]);
      const bool may = !whole || std::binary_search(all.begin(), all.end(), place);
      if (may) greatest += water;
      if (may && whole && all.size() == 1) least += water;
    }
    return {least, greatest};
  }

  template <class N>
  std::vector<std::byte> list() const {
    std::map<Place, std::uint64_t> film;
    for (const int texel : s_->wet_texels()) {
      const motion_scalar::SweptTexel<N> swept = s_->swept<N>(texel);
      const Place place = place_of(s_->uniforms, swept.wiper.v, swept.bin.v);
      if (place != none) film[place] += mass_units_of(s_->film[static_cast<std::size_t>(texel)]);
    }
    std::vector<Drop> out;
    std::map<Place, std::size_t> takers;
    for (const Drop& drop : s_->drops) {
      const motion_scalar::WipedDrop<N> d = s_->wiped<N>(drop);
      const ListedDrop<N> given = listed(d);
      if (!given.lives) continue;
      out.push_back(drops::stored(given, drop.id));
      const Place place = place_of(s_->uniforms, d.wiper.v, d.bin.v);
      if (place == none) continue;
      const auto [taker, is_first] = takers.emplace(place, out.size() - 1);
      if (!is_first && drop.id < out[taker->second].id) taker->second = out.size() - 1;
    }
    for (const auto& [place, at] : takers) out[at].mass = static_cast<float>(std::min(mass_units_of(out[at].mass) + film[place], most));
    return drops::bytes_of(out);
  }

  std::shared_ptr<const Sweep> s_;
  std::map<Place, Share> shares_;
  std::vector<std::vector<Place>> places_;  ///< of each drop
  std::vector<std::vector<std::size_t>> groups_;
};

/// The film after the sweep: nothing where a record sweeps, else as it was.
struct SweptFilm {
  int width, height, values = 1;
  std::shared_ptr<const Sweep> sweep;

  template <class N>
  void operator()(int x, int y, N* out) const {
    const WipeDropsUniforms& u = sweep->uniforms;
    const int texel = y * width + x;
    const N here = N::load(&sweep->film[static_cast<std::size_t>(texel)]);
    const motion_scalar::Plane<N> p = motion_scalar::texel_centre<N>(u, x, y);
    typename N::Mask swept = false;
    for (const Wiper& w : sweep->wipers)
      if (w.direction != 0) swept = swept | motion_scalar::in_sweep(w, p.x, p.y);
    out[0] = select(swept, N(0.0f), here);
  }
};
class WipeCorrected : public capture::ModelOf<SweptFilm> {
 public:
  explicit WipeCorrected(SweptFilm film) : ModelOf(std::move(film)), drops_(pass().sweep) {}
  const capture::KeyedModel* keyed(std::string_view output) const override { return output == "drops" ? &drops_ : nullptr; }

 private:
  SweptDrops drops_;
};

std::vector<Wiper> wipers_input(const PassCase& c, const WipeDropsUniforms& u) {
  std::vector<Wiper> wipers = capture::records_of<Wiper>(capture::record_input(c, "wipers"));
  if (u.wiper_count < 0 || static_cast<std::size_t>(u.wiper_count) > wipers.size()) {
    throw Error(ExitCode::port_files, fmt::format("{}: uniform wiper_count: expected 0 to {}, the records of in.wipers, found {}",
                                                  c.folder(), wipers.size(), u.wiper_count));
  }
  wipers.resize(static_cast<std::size_t>(u.wiper_count));
  for (std::size_t i = 0; i < wipers.size(); ++i) {
    float numbers[sizeof(Wiper) / sizeof(float)];
    std::memcpy(numbers, &wipers[i], sizeof numbers);
    for (const float x : numbers)
      if (!std::isfinite(x))
        throw Error(ExitCode::port_files, fmt::format("{}/in.wipers: expected finite numbers, found {} in record {}", c.folder(), x, i));
  }
  return wipers;
}

}  // namespace

std::unique_ptr<PassModel> bind_windshield_frame(const PassCase& c) {
  return std::make_unique<capture::ListPass>("glass_frame",
                                             std::make_unique<Frame>(capture::uniforms_of<WindshieldFrameUniforms>(c), c.corrected()));
}

std::unique_ptr<PassModel> bind_wipe_drops(const PassCase& c) {
  const auto u = capture::uniforms_of<WipeDropsUniforms>(c);
  std::vector<Wiper> wipers = wipers_input(c, u);
  if (!c.corrected()) {
    WipePublished pass{u, std::move(wipers)};
    return std::make_unique<capture::ListPass>(
        "drops", std::make_unique<drops::DropByDrop<WipePublished>>(std::move(pass), drops::drops_input(c), false));
  }
  const capture::Array& film = capture::image_input(c, "film").array;
  if (u.columns != film.width || u.rows != film.height || u.bin_count < 1 || u.bin_count > 4096) {
    throw Error(ExitCode::port_files,
                fmt::format("{}: uniforms columns, rows, bin_count: expected {}, {} and 1 to 4096, found {}, {} and {}", c.folder(),
                            film.width, film.height, u.columns, u.rows, u.bin_count));
  }
  auto sweep = std::make_shared<const Sweep>(Sweep{u, std::move(wipers), drops::drops_input(c), capture::decoded(film)});
  return std::make_unique<WipeCorrected>(SweptFilm{film.width, film.height, 1, std::move(sweep)});
}

}  // namespace rainref::windshield
