#include "windshield/info.h"

#include "blur_pyramid/blur_pyramid.h"
#include "drops/info.h"
#include "pass/display.h"
#include "pass/model.h"
#include "windshield/scalar.h"

namespace rainref::windshield {

const std::vector<capture::PassEvaluations>& evaluations() {
  static const std::vector<capture::PassEvaluations> all{
      {"windshield_frame", bind_windshield_frame},
      drops::spawn_evaluations(),
      {"integrate", drops::bind_integrate},
      {"wipe_drops", bind_wipe_drops},
      {"necks", drops::bind_necks},
      {"merge", drops::bind_merge},
      {"splat", drops::bind_splat},
      {"persist", pass::bind<PersistPass, scalar::PersistPassText>},
      {"wipe_texture",
       pass::bind<WipeTexturePass, scalar::WipeTexturePassText>,
       nullptr,
       nullptr,
       {{"the blades' ends from the other members of their records",
         "a record has the ends of its blade as places on the glass and as pivot, axis and "
         "radii, rounded each; the pass takes the others than the port",
         bind_wipe_from_ends}}},
      {"smear", pass::bind<SmearPass, scalar::SmearPassText>},
      {"condense", pass::bind<CondensePass, scalar::CondensePassText>},
      {"normals", pass::bind<NormalsPass, scalar::NormalsPassText>},
      {"blur_pyramid", blur_pyramid::bind_blur},
      {"falling_rain", pass::bind<FallingRainPass, scalar::FallingRainPassText>},
      {"composite", pass::bind<CompositePass, scalar::CompositePassText>},
      {"soften", pass::bind<SoftenPass, scalar::SoftenPassText>},
      {"mist", pass::bind<MistPass, scalar::MistPassText>},
      {"join_panes", pass::bind<JoinPanesPass, scalar::JoinPanesPassText>},
      {"interior", pass::bind<InteriorPass, scalar::InteriorPassText>},
      {"display", pass::bind_display}};
  return all;
}

namespace {

using scalar::PlanePoint;

/// Plane coordinates of a point on the glass, for a texture of this number of texels.
template <class N>
PlanePoint<N> place_in_plane(const WipeTextureUniforms& u, const float* place, int width, int height) {
  const N column = N(place[0]) * N(static_cast<float>(width)), row = N(place[1]) * N(static_cast<float>(height));
  return PlanePoint<N>(N(u.frame[0]) * column + N(u.frame[1]) * row, N(u.frame[2]) * row);
}
template <class N>
N distance_between(const PlanePoint<N>& p, const PlanePoint<N>& a, const PlanePoint<N>& b) {
  return scalar::segment_distance(p.x, p.y, a.x, a.y, b.x, b.y);
}
template <class N>
N sector_distance_from_ends(const WipeTextureUniforms& u, const Wiper& w, const PlanePoint<N>& p, int width, int height) {
  const auto place = [&](const float* at) { return place_in_plane<N>(u, at, width, height); };
  return scalar::sector_distance(w, p.x - N(w.pivot[0]), p.y - N(w.pivot[1]),
                                 distance_between(p, place(w.previous_inner), place(w.previous_outer)),
                                 distance_between(p, place(w.inner), place(w.outer)));
}
template <class N>
N distance_from_pivot(const Wiper& w, const PlanePoint<N>& p) {
  const auto end = [&](float radius) {
    return PlanePoint<N>(N(w.pivot[0]) + N(radius) * N(w.axis[0]), N(w.pivot[1]) + N(radius) * N(w.axis[1]));
  };
  return distance_between(p, end(w.inner_radius), end(w.outer_radius));
}

struct WipeFromEnds {
  pass::Bound<WipeTexturePass, scalar::WipeTexturePassText> of;
  int width = of.width, height = of.height, values = of.values;

  template <class N>
  void operator()(int x, int y, N* out) const {
    const WipeTextureUniforms& u = of.uniforms;
    of.with_cursors(x, y, out, [&](const auto& io) {
      const PlanePoint<N> p = scalar::texel_in_plane<N>(u, x, y);
      N coverage(0.0f);
      for (int i = 0; i < u.wiper_count; ++i) {
        const Wiper& w = io.wipers.data()[i];
        const N distance = of.corrected ? sector_distance_from_ends(u, w, p, width, height) : distance_from_pivot(w, p);
        coverage = max(coverage, scalar::coverage_at(distance, N(w.half_width), N(u.edge_width)));
      }
      if (of.corrected) {
        const N since = scalar::time_since_wipe(u, io.wiped(), coverage);
        io.new_height(scalar::wiped_height_corrected(io.height(), coverage));
        io.new_mask(scalar::wiped_mask_corrected(u, since));
        io.new_wiped(since);
      } else {
        io.new_height(scalar::wiped_height_as_published(u, io.height(), coverage));
        io.new_mask(scalar::wiped_mask_as_published(u, io.mask(), coverage));
      }
    });
  }
};

}  // namespace

std::unique_ptr<capture::PassModel> bind_wipe_from_ends(const capture::PassCase& c) {
  return capture::model_of(WipeFromEnds{pass::bound<WipeTexturePass, scalar::WipeTexturePassText>(c)});
}

}  // namespace rainref::windshield
