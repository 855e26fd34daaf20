// rain_on_glass for every number type except lanes: its inputs in the form of the text.
#pragma once

#include "rainy_glass/scalar.h"

namespace rainref::rainy_glass {

struct RainOnGlassText {
  template <class N, bool corrected, class Io>
  static void run(const RainOnGlassUniforms& u, const Io& io, int x, int y) {
    const Texture& scene = *io.scene.texture;
    const float* c = scene.texels + 4 * (static_cast<std::ptrdiff_t>(y) * scene.width[0] + x);
    const scalar::GlassMaps<Texture, Texture, Texture> maps{io.raindrops.texture, io.rivulets.texture, io.scene.texture,
                                                            io.near_depth.texture, io.probe.texture};
    scalar::give_glass<N, corrected>(u, io, scalar::Vec3<N>(N::load(c), N::load(c + 1), N::load(c + 2)), maps, x, y);
  }
};

}  // namespace rainref::rainy_glass
