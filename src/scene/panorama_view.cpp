#include "scene/panorama_view.h"

#include <algorithm>

#include <fmt/format.h>

#include "cache/prepared.h"
#include "image/texture.h"
#include "math/constants.h"
#include "math/scalar.h"
#include "math/real64.h"
#include "rainref/error.h"

namespace rainref::scene {
namespace scalar {
using namespace rainref::scalar;

#define RAINREF_FN inline
#define RAINREF_LAMBDA
#include "math/optics-inl.h"
#include "image/sampling-inl.h"
#include "image/environment-inl.h"
#undef RAINREF_FN
#undef RAINREF_LAMBDA

}  // namespace scalar

namespace {

Image traced_view(const parallel::Executor& executor, const Image& panorama, const Camera& camera, const int& width, const int& height) {
  using N = scalar::Scalar<float>;
  constexpr int tile_rows = 8;
  if (panorama.channels() != 4) throw Error(ExitCode::usage, fmt::format("a panorama has four channels, found {}", panorama.channels()));
  TextureData data(panorama, Address::repeat, Address::clamp);
  data.build_mips();
  const Camera::Basis basis = camera.basis();
  const double half_height = camera.half_height(), half_width = half_height * width / height;
  const double texels = 2 * half_height / height * panorama.height() / pi;  // along a pixel
  const N level(static_cast<float>(log_real(Real64(std::max(texels, 1.0))).v / log_real(Real64(2)).v));
  const auto texture = fixed_texture<Address::repeat, Address::clamp, 4>(data.view());
  Image out(Format::rgba32f, width, height);
  executor.for_tiles(width, height, width, tile_rows, [&](const parallel::Tile& tile) {
    for (int y = tile.y0; y < tile.y1; ++y) {
      float* to = out.row<float>(y);
      for (int x = tile.x0; x < tile.x1; ++x, to += 4) {
        const Vector3 way =
            basis.forward + ((2 * x + 1.0) / width - 1) * half_width * basis.right + ((2 * y + 1.0) / height - 1) * half_height * basis.up;
        const scalar::Vec3<N> seen = scalar::sample_latlong(
            texture, scalar::Vec3<N>(N(static_cast<float>(way.x)), N(static_cast<float>(way.y)), N(static_cast<float>(way.z))), level);
        to[0] = seen.x.v;
        to[1] = seen.y.v;
        to[2] = seen.z.v;
        to[3] = 1;
      }
    }
  });
  return out;
}

}  // namespace

Image panorama_view(const Image& panorama, const Camera& camera, int width, int height, const parallel::Executor& executor) {
  return cache::prepared("panorama view", executor, traced_view, panorama, camera, width, height)->shared();
}

}  // namespace rainref::scene
