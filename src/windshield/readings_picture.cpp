// composite bound to captured cases.
#include "capture/bound_texture.h"
#include "windshield/every_reading.h"
#include "windshield/readings.h"

namespace rainref::windshield {
namespace {

using capture::BoundTexture;
using capture::PassCase;
using capture::PassModel;

struct Composite {
  int width, height, values = 4;
  CompositeUniforms uniforms;
  bool corrected;
  BoundTexture pyramid, depth, water, normal, mask;
  std::vector<Glint> glints;

  template <class N>
  void operator()(int x, int y, N* out) const {
    const plain::Vec3<N> c = corrected ? every::composite_corrected<N>(uniforms, pyramid.view(), depth.view(), water.view(), normal.view(), mask.view(), glints.data(), x, y)
                                       : every::composite_as_published<N>(uniforms, pyramid.view(), water.view(), normal.view(), mask.view(), glints.data(), x, y);
    out[0] = c.x;
    out[1] = c.y;
    out[2] = c.z;
    out[3] = N(1.0f);
  }
};

}  // namespace

std::unique_ptr<PassModel> bind_composite(const PassCase& c) {
  const auto texture = [&](const char* name) { return BoundTexture(capture::image_input(c, name)); };
  Composite m;
  const capture::Array& colour = c.outputs.front().array;
  m.width = colour.width;
  m.height = colour.height;
  m.uniforms = capture::uniforms_of<CompositeUniforms>(c);
  m.corrected = c.corrected();
  m.pyramid = texture("blurred");
  m.water = texture("height");
  m.normal = texture("normal");
  m.mask = texture("mask");
  if (m.corrected) m.depth = texture("scene_depth");
  m.glints = capture::records_of<Glint>(capture::record_input(c, "glints"));
  // No more lights than there are.
  if (m.uniforms.glint_count < 0 || m.uniforms.glint_count > static_cast<std::int32_t>(m.glints.size()))
    m.uniforms.glint_count = static_cast<std::int32_t>(m.glints.size());
  return capture::model_of(std::move(m));
}

}  // namespace rainref::windshield
