#include "rainy_glass/info.h"

#include <algorithm>

#include <fmt/format.h>

#include "capture/bound_texture.h"
#include "capture/other_angles_model.h"
#include "pass/display.h"
#include "pass/model.h"
#include "rainref/error.h"
#include "rainy_glass/host.h"
#include "rainy_glass/rain_on_glass_text.h"

namespace rainref::rainy_glass {
namespace {

using capture::BoundTexture;
using capture::PassCase;
using capture::PassModel;

std::unique_ptr<PassModel> bind_rain_on_glass(const PassCase& c) {
  auto m = pass::bound<RainOnGlassPass, RainOnGlassText>(c);
  if (m.uniforms.use_probe != 0) capture::image_input(c, "probe");  // required in that case
  return capture::model_of(std::move(m));
}

/// Checks whether near_depth was made from this scene_depth.
std::string doubt_near_depth(const PassCase& c) {
  if (!c.corrected()) return "";
  const BoundTexture depth(capture::image_input(c, "scene_depth")), near(capture::image_input(c, "near_depth"));
  const Texture d = depth.view(), n = near.view();
  if (d.width[0] != n.width[0] || d.height[0] != n.height[0]) return "in.near_depth has another size than in.scene_depth";
  Image image(Format::r32f, d.width[0], d.height[0]);
  for (int y = 0; y < image.height(); ++y)
    std::copy_n(d.texels + static_cast<std::ptrdiff_t>(y) * image.width(), image.width(), image.row<float>(y));
  const Image expected = near_depth(image);
  const float* given = n.texels;
  for (int y = 0; y < expected.height(); ++y) {
    for (int x = 0; x < expected.width(); ++x, ++given) {
      if (*given > expected.row<float>(y)[x])
        return fmt::format("in.near_depth at ({}, {}) is {:.6g} m, above the least depth of scene_depth around it, {:.6g} m", x, y, *given,
                           expected.row<float>(y)[x]);
    }
  }
  return "";
}

}  // namespace

const std::vector<capture::PassEvaluations>& evaluations() {
  static const std::vector<capture::PassEvaluations> all{
      {"bake_raindrops", pass::bind<BakeRaindropsPass, scalar::BakeRaindropsPassText>},
      {"bake_rivulets", pass::bind<BakeRivuletsPass, scalar::BakeRivuletsPassText>},
      {"rain_on_glass", bind_rain_on_glass, nullptr, doubt_near_depth, {capture::by_other_angles<bind_rain_on_glass>()}},
      {"display", pass::bind_display}};
  return all;
}

}  // namespace rainref::rainy_glass
