// blur_pyramid bound to captured cases.
#include <algorithm>

#include "blur_pyramid/every_evaluation.h"
#include "capture/bound_texture.h"
#include "drops/framed.h"
#include "windshield/evaluations.h"

namespace rainref::windshield {
namespace {

using capture::BoundTexture;
using capture::PassCase;
using capture::PassModel;
using drops::sized_input;

// ---- blur_pyramid --------------------------------------------------------------------------------------------------
struct FogLevel {
  int width, height, values = 4;
  blur_pyramid::BlurUniforms uniforms;
  BoundTexture colour, depth;

  template <class N>
  void operator()(int x, int y, N* out) const {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(y) * width + x;
    const float* texel = colour.view().texels + 4 * at;
    const plain::Vec3<N> c = blur_pyramid::every::fogged<N>(
        uniforms, plain::Vec3<N>(N::load(texel), N::load(texel + 1), N::load(texel + 2)), N::load(depth.view().texels + at));
    out[0] = c.x;
    out[1] = c.y;
    out[2] = c.z;
    out[3] = N(1.0f);
  }
};
struct HalvedLevel {
  int width, height, values = 4;
  blur_pyramid::BlurUniforms uniforms;
  bool corrected;
  BoundTexture above;

  template <class N>
  void operator()(int x, int y, N* out) const {
    const Texture t = above.view();
    const auto held = [](int i, int uniform, int size) { return std::clamp(i, 0, std::clamp(uniform, 1, size) - 1); };
    for (int k = 0; k < 4; ++k) {
      const auto tap = [&](int i, int j) {
        const int column = held(2 * x + i, uniforms.source_size[0], t.width[0]),
                  row = held(2 * y + j, uniforms.source_size[1], t.height[0]);
        return N::load(t.texels + 4 * (static_cast<std::ptrdiff_t>(row) * t.width[0] + column) + k);
      };
      out[k] = corrected ? blur_pyramid::every::halved_corrected<N>(uniforms, tap, x, y) : blur_pyramid::every::halved_as_published<N>(tap);
    }
  }
};

}  // namespace

std::unique_ptr<PassModel> bind_blur_pyramid(const PassCase& c) {
  const int width = c.outputs.front().array.width, height = c.outputs.front().array.height;
  const auto uniforms = capture::uniforms_of<blur_pyramid::BlurUniforms>(c);
  if (c.level == 0) {
    FogLevel m;
    m.width = width;
    m.height = height;
    m.uniforms = uniforms;
    m.colour = BoundTexture(sized_input(c, "scene_colour"));
    m.depth = BoundTexture(sized_input(c, "scene_depth"));
    return capture::model_of(std::move(m));
  }
  HalvedLevel m;
  m.width = width;
  m.height = height;
  m.uniforms = uniforms;
  m.corrected = c.corrected();
  m.above = BoundTexture(capture::image_input(c, "blurred"));
  return capture::model_of(std::move(m));
}

}  // namespace rainref::windshield
