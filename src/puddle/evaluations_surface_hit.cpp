// Judging of surface_hit. A march accumulates rounding errors until an interval is useless, so its end is enclosed instead, by conditions
// that every march must satisfy.
#include <algorithm>

#include "capture/bound_texture.h"
#include "puddle/corrected_descent.h"
#include "puddle/info.h"
#include "puddle/published_march.h"
#include "puddle/scalar.h"

namespace rainref::puddle {
namespace {

using capture::BoundTexture;
using capture::PassCase;
using enclosed::Enclosure;

struct MarchedPass {
  int width, height, values = 8;
  SurfaceHitUniforms uniforms;
  bool corrected;
  BoundTexture wave, bounds;
  float lowest;  ///< texel of the wave

  template <class N>
  void operator()(int x, int y, N* out) const {
    write(corrected ? scalar::surface_hit_corrected<N>(uniforms, wave.view(), bounds.view(), x, y)
                    : scalar::surface_hit_as_published<N>(uniforms, wave.view(), x, y),
          out);
  }
  template <class N>
  static void write(const scalar::SurfaceHit<N>& hit, N* out) {
    const N all[8] = {hit.position.x, hit.position.y, hit.position.z, hit.iterations, hit.normal.x, hit.normal.y, hit.normal.z, hit.flag};
    std::copy(all, all + 8, out);
  }
};

class SurfaceHitModel : public capture::ModelOf<MarchedPass> {
 public:
  using ModelOf::ModelOf;
  bool needs_port() const override { return true; }
  std::optional<std::array<double, 2>> free_range(int v) const override {
    if (v != 3 || !pass().corrected) return std::nullopt;
    return std::array<double, 2>{0, static_cast<double>(pass().uniforms.max_steps)};
  }

  int parts() const override { return pass().corrected ? 2 : 0; }
  bool enclose_part(int part, int x, int y, const float* port, Enclosure* out) const override {
    const MarchedPass& p = pass();
    const Texture wave = p.wave.view();
    const CorrectedDescent descent(p.uniforms, wave);
    const std::optional<scalar::SurfaceHit<Enclosure>> hit =
        part == 0 ? descent.between_members(p.bounds.view(), x, y) : descent.hit_beside_reference(p.bounds.view(), x, y, port);
    if (hit) MarchedPass::write(*hit, out);
    return hit.has_value();
  }
  void enclose(int x, int y, const float* port, Enclosure* out) const override {
    const MarchedPass& p = pass();
    // Under exact rules the march itself is the only result.
    if (enclosed::profile().reference) return p(x, y, out);
    const Texture wave = p.wave.view();
    if (p.corrected) return MarchedPass::write(CorrectedDescent(p.uniforms, wave).hit(p.bounds.view(), x, y, port), out);
    const PublishedMarch march(p.uniforms, wave, p.lowest, x, y);
    const std::vector<PublishedMarch::End> ends = march.ends();
    if (ends.empty()) return enclosed::give_up();
    MarchedPass::write(march.at(PublishedMarch::nearest(ends, port), port), out);
  }
};

}  // namespace

std::unique_ptr<capture::PassModel> bind_surface_hit(const PassCase& c) {
  MarchedPass p;
  const capture::CaseOutput* hit = c.output("hit");
  p.width = hit->array.width;
  p.height = hit->array.height;
  p.uniforms = capture::uniforms_of<SurfaceHitUniforms>(c);
  p.corrected = c.corrected();
  p.wave = BoundTexture(capture::image_input(c, "wave"), p.corrected ? 0 : 1, 1);
  const Texture wave = p.wave.view();
  p.lowest = *std::min_element(wave.texels, wave.texels + static_cast<std::ptrdiff_t>(wave.width[0]) * wave.height[0]);
  if (p.corrected) p.bounds = BoundTexture(capture::image_input(c, "bounds"));
  return std::make_unique<SurfaceHitModel>(std::move(p));
}

}  // namespace rainref::puddle
