#include "capture/display.h"

#include <fmt/format.h>

#include "capture/bound_texture.h"
#include "rainref/error.h"
#include "scene/display_every_reading.h"

namespace rainref::capture {
namespace {

using scene::DisplayUniforms;

struct Display {
  int width, height, values = 4;
  DisplayUniforms uniforms;
  BoundTexture colour;

  template <class N>
  void operator()(int x, int y, N* out) const {
    const float* in = colour.view().texels + 4 * (static_cast<std::ptrdiff_t>(y) * width + x);
    const plain::Vec3<N> c = scene::every::display<N>(uniforms, plain::Vec3<N>(N::load(in), N::load(in + 1), N::load(in + 2)));
    out[0] = c.x;
    out[1] = c.y;
    out[2] = c.z;
    out[3] = N(1.0f);
  }
};

}  // namespace

PassInfo display_info(const std::string& from) {
  return {"display", "Display code.", {{"as-published", 1, Judge::envelope, "DisplayUniforms"}, {"corrected", 1, Judge::envelope, "DisplayUniforms"}}, {per_texel({"colour", from})}, {"picture"},
          {scene::uniform_block<DisplayUniforms>("DisplayUniforms", {scene::member<&DisplayUniforms::exposure>("exposure", "1", scene::exposure_factor, "Factor of the radiance.")})}};
}
std::unique_ptr<PassModel> bind_display(const PassCase& c) {
  const CaseInput& colour = image_input(c, "colour");
  const Array& a = colour.array;
  if (info(a.format).channels != 4) throw Error(ExitCode::port_files, fmt::format("{}: in.colour: expected 4 channels, found {}", c.folder(), info(a.format).name));
  return model_of(Display{a.width, a.height, 4, uniforms_of<DisplayUniforms>(c), BoundTexture(colour)});
}

}  // namespace rainref::capture
