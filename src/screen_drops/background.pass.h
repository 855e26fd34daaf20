// Pass background: the scene out of focus, without water.
#ifndef RAINREF_FN
#ifndef RAINREF_SCREEN_DROPS_BACKGROUND_PASS_H_
#define RAINREF_SCREEN_DROPS_BACKGROUND_PASS_H_
#include "pass/definition.h"
#include "scene/uniform_block.h"
#include "screen_drops/uniforms.h"

namespace rainref::screen_drops {

struct BackgroundPass : pass::Takes<BackgroundUniforms> {
  static constexpr pass::About about{"background", "The scene out of focus, without water. Once, before frame 0.", {1}, {1}};
  static scene::UniformBlock uniforms() {
    return block({member<&U::resolution>("pixel", scene::whole(1, 65536), "as-published: columns and rows of the picture."),
                  member<&U::level>("1", {0, 16}, "Mip level of the lookups."),
                  member<&U::weight>("1", scene::share, "corrected: of a tap."),
                  member<&U::scale>("1", scene::share, "corrected: texture coordinates of the scene in a pixel."),
                  member<&U::offset>("1", scene::share, "corrected: those of the picture's corner."),
                  member<&U::tap_count>("1", {0, 4096}, "corrected: taps in the list.")});
  }
  template <class B>
  struct Io {
    typename B::template Stored<Format::rgba16f> scene = pass::In{.name = "scene", .filter = Filter::linear, .mip_filter = Filter::linear};
    typename B::template Records<Tap> taps = pass::In{.name = "taps", .variant = "corrected", .count = "tap_count"};
    typename B::template Result<Format::rgba16f> background = pass::Out{.name = "background",
                                                                        .sentence = "The scene out of focus: linear radiance, alpha 1.",
                                                                        .colour_space = "linear Rec. 709",
                                                                        .alpha = "1"};
  };
};

}  // namespace rainref::screen_drops
#endif
#else

/// The scene as published, whose wrap is a key. Each rule is a texture of its own, so that a lookup decides once.
template <class Clamped, class Repeated, class Mirrored>
struct WrappedScene {
  Clamped clamped;
  Repeated repeated;
  Mirrored mirrored;
  Address rule;  ///< of this run
};
// clang before 17 does not deduce aggregates.
template <class Clamped, class Repeated, class Mirrored>
WrappedScene(Clamped, Repeated, Mirrored, Address) -> WrappedScene<Clamped, Repeated, Mirrored>;
template <class Scene>
RAINREF_FN auto wrapped_scene(const Scene& scene) {
  return WrappedScene{scene.template fixed<Address::clamp, Address::clamp, 4>(),
                      scene.template fixed<Address::repeat, Address::repeat, 4>(),
                      scene.template fixed<Address::mirror, Address::mirror, 4>(), scene.rule()};
}
/// lookup(texture), by the rule of the run.
template <class T, class Lookup>
RAINREF_FN auto by_rule(const T& scene, const Lookup& lookup) {
  return lookup(scene);
}
template <class Clamped, class Repeated, class Mirrored, class Lookup>
RAINREF_FN auto by_rule(const WrappedScene<Clamped, Repeated, Mirrored>& scene, const Lookup& lookup) {
  switch (scene.rule) {
    case Address::repeat:
      return lookup(scene.repeated);
    case Address::mirror:
      return lookup(scene.mirrored);
    case Address::clamp:
    case Address::border:
      break;
  }
  return lookup(scene.clamped);
}

template <class N, class T>
RAINREF_FN Vec3<N> scene_at(const T& scene, N u, N v, N level) {
  return by_rule(scene, [&](const auto& texture) RAINREF_LAMBDA {
    const auto s = sample_trilinear<0, 3, N>(texture, u, v, level);
    return Vec3<N>(s[0], s[1], s[2]);
  });
}
/// Its finest level alone.
template <class N, class T>
RAINREF_FN Vec3<N> sharp_scene_at(const T& scene, N u, N v) {
  return by_rule(scene, [&](const auto& texture) RAINREF_LAMBDA {
    const auto s = sample_bilinear<0, 3, N>(texture, u, v);
    return Vec3<N>(s[0], s[1], s[2]);
  });
}

/// textureLod(scene, pixel / resolution, level)
template <class N, class T>
RAINREF_FN Vec3<N> background_as_published(const BackgroundUniforms& b, const T& scene, int column, int row) {
  return scene_at<N>(scene, (N::index(column) + N(0.5f)) / N(b.resolution[0]), N(static_cast<float>(row) + 0.5f) / N(b.resolution[1]),
                     N(b.level));
}

/// The mean over a uniform disc: a far point as a camera focused on the glass sees it.
template <class N, class T>
RAINREF_FN Vec3<N> background_corrected(const BackgroundUniforms& b, const T& scene, const Tap* taps, int column, int row) {
  const N u = (N::index(column) + N(0.5f)) * N(b.scale[0]) + N(b.offset[0]),
          v = N(static_cast<float>(row) + 0.5f) * N(b.scale[1]) + N(b.offset[1]), zero(0.0f);
  Vec3<N> sum(zero, zero, zero);
  for (int k = 0; k < b.tap_count; ++k) sum = sum + scene_at<N>(scene, u + N(taps[k].x), v + N(taps[k].y), N(b.level));
  return N(b.weight) * sum;
}

struct BackgroundPassText {
  template <class Io>
  static RAINREF_FN auto views(const Io& io) {
    return wrapped_scene(io.scene);
  }
  template <class N, bool corrected, class Io, class Scene>
  static RAINREF_FN void run(const BackgroundUniforms& u, const Io& io, const Scene& scene, int column, int row) {
    if constexpr (corrected)
      io.background(background_corrected<N>(u, scene, io.taps.data(), column, row), N(1.0f));
    else
      io.background(background_as_published<N>(u, scene, column, row), N(1.0f));
  }
};
#endif
