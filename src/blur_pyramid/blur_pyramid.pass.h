// Pass blur_pyramid: the fogged scene, then each level from the one above. Needs optics-inl.h.
#ifndef RAINREF_FN
#ifndef RAINREF_BLUR_PYRAMID_BLUR_PYRAMID_PASS_H_
#define RAINREF_BLUR_PYRAMID_BLUR_PYRAMID_PASS_H_
#include <algorithm>

#include "blur_pyramid/uniforms.h"
#include "pass/definition.h"
#include "scene/uniform_block.h"

namespace rainref::blur_pyramid {

/// A run for level 0. blur_info names the passes that the scene comes from.
struct FogPass : pass::Takes<BlurUniforms> {
  static constexpr pass::About about{"blur_pyramid", "The scene in fog, and blurred levels of it; one run a level.", {1}, {2}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::fog_colour>("1", scene::radiance, "Linear radiance of the fog."),
                  member<&U::fog_density>("1/m", {0, 10}, "Extinction of light in the fog."),
                  member<&U::middle>("1", scene::share, "corrected: weight of the middle one of three texels, for columns and rows."),
                  member<&U::last>("1", scene::share, "corrected: weight of the last one, over output index + 1."),
                  member<&U::source_size>("texel", {1, 65536}, "Columns and rows of the level above."),
                  member<&U::level>("1", {0, Texture::max_levels}, "0 fogs the scene, further ones halve the level above.")});
  }
  template <class B>
  struct Io {
    typename B::template Texels<Format::rgba16f> scene_colour = pass::In{.name = "scene_colour"};
    typename B::template Texels<Format::r32f> scene_depth = pass::In{.name = "scene_depth"};
    typename B::template Result<Format::rgba16f> blurred = pass::Out{.name = "blurred"};
  };
};
/// A run for a further level. Its lanes are written by hand, rows first: see kernels.cpp.
struct HalvePass {
  static constexpr pass::About about{"blur_pyramid", FogPass::about.sentence, {1}, {2}, {"the four texels"}};
  using Uniforms = BlurUniforms;
  static scene::UniformBlock uniforms() { return FogPass::uniforms(); }
  template <class B>
  struct Io {
    typename B::template Stored<Format::rgba16f> above = pass::In{.name = "blurred", .from = "blur_pyramid"};
    typename B::template Result<Format::rgba16f> blurred = pass::Out{.name = "blurred",
                                                                     .sentence = "Level of the blurred scene: linear radiance, alpha 1.",
                                                                     .colour_space = "linear Rec. 709",
                                                                     .alpha = "1"};
  };
};

/// Texel i of a side of n, i from -2 to n + 2, mirrored at the edges. For a side of less than three, the nearest texel.
inline int mirrored(int i, int n) {
  const int from_first = i < 0 ? -1 - i : i;
  return std::clamp(from_first < n ? from_first : 2 * n - 1 - from_first, 0, n - 1);
}

}  // namespace rainref::blur_pyramid
#endif
#else

/// Level 0: fog (1 - T) + colour T, T = exp(-density depth).
template <class N>
RAINREF_FN Vec3<N> fogged(const BlurUniforms& u, const Vec3<N>& colour, N depth) {
  return mix(Vec3<N>(u.fog_colour), colour, transmittance(N(u.fog_density), guard<N>(max(depth, N(0.0f)), "depth is nowhere negative")));
}

/// as-published: a box of 2 x 2 texels. With an odd size the last column or row of the level above is dropped.
template <class N>
RAINREF_FN N box_of_four(N a, N b, N c, N d) {
  return N(0.25f) * sum_any_order_in_pairs(a, b, c, d);
}

/// corrected: a bell of 1 4 6 4 1 sixteenths over the picture, which is mirrored at its edges. So bright spots become round from level to
/// level and move with the picture; a box alone leaves squares that stand still. Combined with the box of an even side it is 1 5 10 10 5 1,
/// a B-spline of fourth degree. The mean is kept: a texel gives its neighbours as much as it gets from them.
template <class N>
RAINREF_FN N bell_of_five(N t0, N t1, N t2, N t3, N t4) {
  const N middle = N(0.375f) * t2, near = N(0.25f) * (t1 + t3), far = N(0.0625f) * (t0 + t4);
  return (middle + near) + far;
}
/// corrected: a texel of m covers 1 / m of the n texels above. With n = 2 m + 1 it covers three of them, weighted by the overlap: (m - x) /
/// n, m / n, (x + 1) / n. The weights of every texel above have the same sum, so the mean is kept. Written relative to the first tap, so
/// that a constant is unchanged. Columns are combined first, then rows.
template <class N>
RAINREF_FN N box_of_three(N t0, N t1, N t2, N w1, N w2) {
  return (t0 + w1 * (t1 - t0)) + w2 * (t2 - t0);
}
/// Both, from seven texels starting at the second before the first.
template <class N>
RAINREF_FN N round_of_seven(const N (&t)[7], N w1, N w2) {
  const N first = bell_of_five(t[0], t[1], t[2], t[3], t[4]), second = bell_of_five(t[1], t[2], t[3], t[4], t[5]);
  const N third = bell_of_five(t[2], t[3], t[4], t[5], t[6]);
  return box_of_three(first, second, third, w1, w2);
}
/// The weight of the last tap for output index x.
template <class N>
RAINREF_FN N last_weight(float last, N x) {
  return N(last) * (x + N(1.0f));
}

/// Output texel (x, y), one channel. tap(i, j) is input texel (2 x + i, 2 y + j); outside the image as-published uses the nearest texel,
/// corrected the mirrored one, mirrored().
template <class N, class Tap>
RAINREF_FN N halved_as_published(Tap tap) {
  return box_of_four(tap(0, 0), tap(1, 0), tap(0, 1), tap(1, 1));
}
template <class N, class Tap>
RAINREF_FN N halved_corrected(const BlurUniforms& u, Tap tap, int x, int y) {
  const N wy1(u.middle[1]), wy2 = last_weight(u.last[1], N(static_cast<float>(y)));
  N columns[7];
  for (int i = 0; i < 7; ++i) {
    N rows[7];
    for (int j = 0; j < 7; ++j) rows[j] = tap(i - 2, j - 2);
    columns[i] = round_of_seven(rows, wy1, wy2);
  }
  return round_of_seven(columns, N(u.middle[0]), last_weight(u.last[0], N::index(x)));
}

struct FogPassText {
  template <class N, bool, class Io>
  static RAINREF_FN void run(const BlurUniforms& u, const Io& io, int, int) {
    io.blurred(fogged(u, io.scene_colour.rgb(), io.scene_depth()), N(1.0f));
  }
};
struct HalvePassText {
  template <class N, bool corrected, class Io>
  static RAINREF_FN void run(const BlurUniforms& u, const Io& io, int x, int y) {
    const Texture& above = io.above;
    const auto held = [](int i, int uniform, int size) {
      const int texels = std::clamp(uniform, 1, size);
      return corrected ? mirrored(i, texels) : std::clamp(i, 0, texels - 1);
    };
    N c[4];
    for (int k = 0; k < 4; ++k) {
      const auto tap = [&](int i, int j) RAINREF_LAMBDA {
        const int column = held(2 * x + i, u.source_size[0], above.width[0]), row = held(2 * y + j, u.source_size[1], above.height[0]);
        return N::load(above.texels + 4 * (static_cast<std::ptrdiff_t>(row) * above.width[0] + column) + k);
      };
      if constexpr (corrected)
        c[k] = halved_corrected<N>(u, tap, x, y);
      else
        c[k] = halved_as_published<N>(tap);
    }
    io.blurred(Vec3<N>(c[0], c[1], c[2]), c[3]);
  }
};
#endif
