#include "edge_splash/info.h"

#include <algorithm>
#include <array>

#include "edge_splash/scalar.h"
#include "pass/display.h"
#include "pass/model.h"

namespace rainref::edge_splash {
namespace {

using capture::PassCase;
using capture::PassModel;
using enclosed::Enclosure;
using enclosed::Rearranged;

// ---- splash, as published --------------------------------------------------------------------------------------------
// Many decisions lead to few masks: where the scroll ends on a whole texel each coordinate of the noise may be one of two texels, and in a
// flat place the angle is only rounding. So enclosures and rearrangements compute the set of possible masks, and decide once among these.
template <class N, std::size_t Count>
class MaskSet {
 public:
  /// body() returns masks of 0 and 1, and makes its decisions.
  template <class Body>
  explicit MaskSet(const Body& body) {
    enclosed::PathEnumeration paths;
    const bool is_whole = paths.for_each_alternative([&] {
      const std::array<N, Count> masks = body();
      std::size_t word = 0;
      for (std::size_t k = 0; k < Count; ++k) word |= static_cast<std::size_t>(!is_zero(masks[k])) << k;
      if (std::find(words_.begin(), words_.end(), word) == words_.end()) words_.push_back(word);
    });
    if (!is_whole) enclosed::give_up();
  }
  std::array<N, Count> decide() const {
    const std::size_t word = words_[words_.size() < 2 ? 0 : static_cast<std::size_t>(enclosed::choose(static_cast<int>(words_.size())))];
    std::array<N, Count> masks;
    for (std::size_t k = 0; k < Count; ++k) masks[k] = N(word >> k & 1 ? 1.0f : 0.0f);
    return masks;
  }

 private:
  static bool is_zero(const Enclosure& mask) { return mask.lo == 0; }
  static bool is_zero(const Rearranged& mask) { return is_zero(mask.settled()); }
  std::vector<std::size_t> words_;
};
using Published = pass::Bound<PublishedSplashPass, scalar::PublishedSplashPassText>;
class PublishedModel : public capture::ModelOf<Published> {
 public:
  using ModelOf::ModelOf;
  void enclose(int column, int row, const float*, Enclosure* out) const override { decide(column, row, out); }
  bool rearrange(int column, int row, const float*, Enclosure* out) const override {
    std::vector<Rearranged> all(static_cast<std::size_t>(values()));
    decide(column, row, all.data());
    for (const Rearranged& r : all) *out++ = r.settled();
    return true;
  }

 private:
  template <class N>
  void decide(int column, int row, N* out) const {
    const Published& p = pass();
    const Texture &depth = p.captured.depth.texture, &noise_map = p.captured.noise_map.texture;
    const N x = N::index(column), y = N::index(row);
    const auto edge_and_angle = MaskSet<N, 2>([&] {
                                  const scalar::EdgeMasks<N> m = scalar::edge_masks(p.uniforms, depth, x, y);
                                  return std::array{m.edge, m.angle};
                                }).decide();
    const auto noise = MaskSet<N, 1>([&] { return std::array{scalar::noise_mask(p.uniforms, noise_map, x, y)}; }).decide();
    p.with_cursors(column, row, out, [&](const auto& io) {
      scalar::give(
          io, scalar::blend_as_published<N>(p.uniforms, {edge_and_angle[0], edge_and_angle[1]}, noise[0], scalar::scene_of<N>(io), x, y));
    });
  }
};
std::unique_ptr<PassModel> bind_splash(const PassCase& c) {
  if (c.corrected()) return pass::bind<SplashPass, scalar::SplashPassText>(c);
  return std::make_unique<PublishedModel>(pass::bound<PublishedSplashPass, scalar::PublishedSplashPassText>(c));
}

}  // namespace

const std::vector<capture::PassEvaluations>& evaluations() {
  static const std::vector<capture::PassEvaluations> all{{"splash", bind_splash}, {"display", pass::bind_display}};
  return all;
}

}  // namespace rainref::edge_splash
