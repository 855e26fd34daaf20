#include "rainy_glass/evaluations.h"

#include <algorithm>

#include <fmt/format.h>

#include "capture/bound_texture.h"
#include "pass/display.h"
#include "pass/model.h"
#include "rainref/error.h"
#include "rainy_glass/host.h"
#include "rainy_glass/plain.h"

namespace rainref::rainy_glass {
namespace {

using capture::BoundTexture;
using capture::PassCase;
using capture::PassModel;

constexpr int block = 8;  // texels a side for which the records that may count are chosen once, as the host does for its tiles

template <class N>
void put(const scalar::Baked<N>& b, N* out) {
  out[0] = b.r;
  out[1] = b.g;
  out[2] = b.b;
  out[3] = b.a;
}
/// A map's records by block.
template <class Record>
struct Chosen {
  int columns = 0;
  std::vector<std::vector<Record>> blocks;
  template <class Choose>
  void choose(int width, int height, const Choose& near) {
    columns = (width + block - 1) / block;
    for (int y = 0; y < height; y += block) {
      for (int x = 0; x < width; x += block) blocks.push_back(near(x, y, std::min(x + block, width), std::min(y + block, height)));
    }
  }
  const std::vector<Record>& at(int x, int y) const {
    return blocks[static_cast<std::size_t>(y / block) * static_cast<std::size_t>(columns) + static_cast<std::size_t>(x / block)];
  }
};
const capture::Array& square_output(const PassCase& c, const char* name) {
  const capture::CaseOutput* out = c.output(name);
  if (out == nullptr || out->array.width != out->array.height)
    throw Error(ExitCode::port_files, fmt::format("{}: expected a square output {}", c.folder(), name));
  return out->array;
}

// ---- bake_raindrops --------------------------------------------------------------------------------------------------
struct BakeRaindrops {
  int width, height, values = 4;
  BakeRaindropsUniforms uniforms;
  bool corrected;
  Chosen<Droplet> droplets;

  template <class N>
  void operator()(int x, int y, N* out) const {
    const std::vector<Droplet>& near = droplets.at(x, y);
    put(scalar::bake_raindrops<N>(uniforms, corrected, near.data(), static_cast<int>(near.size()), x, y), out);
  }
};
std::unique_ptr<PassModel> bind_bake_raindrops(const PassCase& c) {
  BakeRaindrops m;
  m.width = m.height = square_output(c, "raindrops").width;
  m.uniforms = capture::uniforms_of<BakeRaindropsUniforms>(c);
  m.corrected = c.corrected();
  const auto all = capture::records_of<Droplet>(capture::record_input(c, "droplets"));
  m.droplets.choose(m.width, m.height,
                    [&](int x0, int y0, int x1, int y1) { return droplets_near(all, m.corrected, m.width, x0, y0, x1, y1); });
  return capture::model_of(std::move(m));
}

// ---- bake_rivulets ---------------------------------------------------------------------------------------------------
struct BakeRivulets {
  int width, height, values = 4;
  BakeRivuletsUniforms uniforms;
  Chosen<Trail> trails;
  BoundTexture lattice;

  template <class N>
  void operator()(int x, int y, N* out) const {
    const std::vector<Trail>& near = trails.at(x, y);
    put(scalar::bake_rivulets<N>(uniforms, near.data(), static_cast<int>(near.size()), lattice.view(), x, y), out);
  }
};
std::unique_ptr<PassModel> bind_bake_rivulets(const PassCase& c) {
  BakeRivulets m;
  m.width = m.height = square_output(c, "rivulets").width;
  m.uniforms = capture::uniforms_of<BakeRivuletsUniforms>(c);
  const auto all = capture::records_of<Trail>(capture::record_input(c, "trails"));
  m.trails.choose(m.width, m.height, [&](int x0, int y0, int x1, int y1) { return trails_near(all, m.width, x0, y0, x1, y1); });
  m.lattice = BoundTexture(capture::image_input(c, "lattice"));
  const std::int64_t side = 2 * std::int64_t{m.uniforms.flow_cells};
  if (side < 2)
    throw Error(ExitCode::port_files, fmt::format("{}: flow_cells: expected 1 or more, found {}", c.folder(), m.uniforms.flow_cells));
  if (m.lattice.view().width[0] < side || m.lattice.view().height[0] < side) {
    throw Error(ExitCode::port_files, fmt::format("{}: in.lattice: expected {} texels a side, found {}x{}", c.folder(), side,
                                                  m.lattice.view().width[0], m.lattice.view().height[0]));
  }
  return capture::model_of(std::move(m));
}

// ---- rain_on_glass ---------------------------------------------------------------------------------------------------
struct RainOnGlassText {
  template <class N, bool corrected, class Io>
  static void run(const RainOnGlassUniforms& u, const Io& io, int x, int y) {
    const Texture& scene = *io.scene.texture;
    const float* c = scene.texels + 4 * (static_cast<std::ptrdiff_t>(y) * scene.width[0] + x);
    const scalar::GlassMaps<Texture, Texture, Texture> maps{io.raindrops.texture, io.rivulets.texture, io.scene.texture,
                                                            io.near_depth.texture, io.probe.texture};
    scalar::give_glass<N, corrected>(u, io, plain::Vec3<N>(N::load(c), N::load(c + 1), N::load(c + 2)), maps, x, y);
  }
};
std::unique_ptr<PassModel> bind_rain_on_glass(const PassCase& c) {
  auto m = pass::bound<RainOnGlassPass, RainOnGlassText>(c);
  if (m.uniforms.use_probe != 0) capture::image_input(c, "probe");  // needed then
  return capture::model_of(std::move(m));
}

/// near_depth is made from scene_depth: whether it is this one's.
std::string doubt_near_depth(const PassCase& c) {
  if (!c.corrected()) return "";
  const BoundTexture depth(capture::image_input(c, "scene_depth")), near(capture::image_input(c, "near_depth"));
  const Texture d = depth.view(), n = near.view();
  if (d.width[0] != n.width[0] || d.height[0] != n.height[0]) return "in.near_depth has another size than in.scene_depth";
  Image image(Format::r32f, d.width[0], d.height[0]);
  for (int y = 0; y < image.height(); ++y)
    std::copy_n(d.texels + static_cast<std::ptrdiff_t>(y) * image.width(), image.width(), image.row<float>(y));
  const std::vector<float> expected = near_depth(image);
  for (std::size_t i = 0; i < expected.size(); ++i) {
    if (n.texels[i] > expected[i]) {
      return fmt::format("in.near_depth at ({}, {}) is {:.6g} m, above the least depth of scene_depth around it, {:.6g} m",
                         i % static_cast<std::size_t>(image.width()), i / static_cast<std::size_t>(image.width()), n.texels[i],
                         expected[i]);
    }
  }
  return "";
}

}  // namespace

const std::vector<capture::PassEvaluations>& evaluations() {
  static const std::vector<capture::PassEvaluations> all{{"bake_raindrops", bind_bake_raindrops},
                                                         {"bake_rivulets", bind_bake_rivulets},
                                                         {"rain_on_glass", bind_rain_on_glass, nullptr, doubt_near_depth},
                                                         {"display", pass::bind_display}};
  return all;
}

}  // namespace rainref::rainy_glass
