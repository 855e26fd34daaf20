// Pass smear: the thin film that blades leave in streaks, and its drying. Needs wipe_texture.pass.h.
#ifndef RAINREF_FN
#ifndef RAINREF_WINDSHIELD_SMEAR_PASS_H_
#define RAINREF_WINDSHIELD_SMEAR_PASS_H_
#include <cstdint>
#include <span>
#include <vector>

#include "rainref/executor.h"
#include "windshield/surface/wipe_texture.pass.h"
#include "windshield/surface/wiper_reach.h"

namespace rainref::windshield {

struct SmearUniforms {
  float frame[3], edge_width;
  float inverse_water, drying;
  std::int32_t wiper_count;
  float padding0;
};
static_assert(sizeof(SmearUniforms) == 32);

/// Runs if the scene asks for it. In place.
struct SmearPass : pass::Takes<SmearUniforms> {
  static constexpr pass::About about{
      "smear", "The thin film that blades leave in streaks along their way, and what of it is not dry yet.", {}, {1}, {"dot", "length"}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::frame>("m/texel", {-1e4, 1e4}, "Plane coordinates of a step: x of a column, x and y of a row."),
                  member<&U::edge_width>("m", {0, 1e4}, "Width over which coverage falls at a blade's edge."),
                  member<&U::inverse_water>("1/mm", {0, 1e6}, "1 over the height of water that takes all of the film up."),
                  member<&U::drying>("1/s", {0, 1000}, "What of the thickness dries in a second."),
                  member<&U::wiper_count>("1", {0, 65536}, "Wipers in the list.")});
  }
  /// The number given by the uniform, or all: a port that lost some may have fewer.
  static std::span<const Wiper> counted(const Uniforms& u, std::span<const Wiper> all) {
    const auto said = static_cast<std::size_t>(u.wiper_count);
    return u.wiper_count < 0 || said > all.size() ? all : all.first(said);
  }
  /// The records that may cover a texel of the tile, in order.
  static std::vector<Wiper> near(const Uniforms& u, std::span<const Wiper> all, bool, int, const parallel::Tile& t) {
    Reach tile;
    for (const int x : {t.x0, t.x1}) {
      for (const int y : {t.y0, t.y1}) {
        const auto column = static_cast<float>(x), row = static_cast<float>(y);
        tile.hold(u.frame[0] * column + u.frame[1] * row, u.frame[2] * row);
      }
    }
    std::vector<Wiper> some;
    for (const Wiper& w : counted(u, all)) {
      const Reach r = sector_reach(w, u.edge_width);
      if (r.x0 <= tile.x1 && tile.x0 <= r.x1 && r.y0 <= tile.y1 && tile.y0 <= r.y1) some.push_back(w);
    }
    return some;
  }
  template <class B>
  struct Io {
    typename B::template Texels<Format::r16f> height = pass::In{.name = "height", .from = "wipe_texture", .variant = "corrected"};  // [mm]
    typename B::template Texels<Format::r32f> wiped = pass::In{.name = "wiped", .from = "wipe_texture", .variant = "corrected"};
    typename B::template Texels<Format::rgba16f> laid = pass::In{.name = "laid", .from = "smear", .previous = true, .variant = "corrected"};
    typename B::template Records<Wiper> wipers = pass::In{.name = "wipers", .variant = "corrected"};
    typename B::template Stored<Format::r16f> profile = pass::In{.name = "profile", .variant = "corrected", .filter = Filter::linear};
    typename B::template Result<Format::rgba16f> smear = pass::Out{.name = "smear",
                                                                   .sentence = "As laid, but the thickness that has not dried yet.",
                                                                   .range = {-1, 1},
                                                                   .alpha = "1",
                                                                   .variant = "corrected"};
    typename B::template Result<Format::rgba16f> new_laid =
        pass::Out{.name = "laid",
                  .sentence =
                      "The film as the last blade left it: x, y the unit vector along that blade in the plane, z its thickness, "
                      "in thicknesses of the thickest streak; alpha 1.",
                  .range = {-1, 1},
                  .alpha = "1",
                  .variant = "corrected"};
  };
};

}  // namespace rainref::windshield
#endif
#else

// Each blade in turn lays its profile over the existing film, by its coverage. Drops and trails take up the film. The rest dries at a
// constant rate, so that the thin film goes first and streaks last. The time since the wipe comes from wipe_texture, so that no sum of
// small steps is kept.
template <class Values>
struct SmearTextures {
  Values profile;
};
template <class Values>
SmearTextures(Values) -> SmearTextures<Values>;
struct SmearPassText {
  template <class Io>
  static RAINREF_FN auto views(const Io& io) {
    constexpr Address edge = Address::clamp;
    return SmearTextures{io.profile.template fixed<edge, edge, 1>()};
  }
  template <class N, bool corrected, class Io, class Textures>
  static RAINREF_FN void run(const SmearUniforms& u, const Io& io, const Textures& t, int x, int y) {
    const PlanePoint<N> p = texel_in_plane<N>(u, x, y);
    const N one(1.0f);
    Vec3<N> film = io.laid.rgb();
    const Wiper* wipers = io.wipers.data();
    for (int i = 0; i < io.wipers.size(); ++i) {
      const Wiper& w = wipers[i];
      const N covered = coverage_at(sector_distance(w, p.x, p.y), N(w.half_width), N(u.edge_width));
      const N rx = p.x - N(w.pivot[0]), ry = p.y - N(w.pivot[1]), r = length(rx, ry), inverse = one / max(r, N(1e-6f));
      const N along = (r - N(w.inner_radius)) / (N(w.outer_radius) - N(w.inner_radius));
      const N thickness = sample_bilinear<0, 1, N>(t.profile, saturate(along), N(0.5f))[0];
      film = mix(film, Vec3<N>{rx * inverse, ry * inverse, thickness}, covered);
    }
    const N taken = min(io.height() * N(u.inverse_water), one);
    const N left = film.z * (one - taken);
    io.smear(Vec3<N>{film.x, film.y, max(left - N(u.drying) * io.wiped(), N(0.0f))}, one);
    io.new_laid(Vec3<N>{film.x, film.y, left}, one);
  }
};
#endif
