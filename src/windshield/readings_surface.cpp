// splat, wipe_texture, normals and blur_pyramid bound to captured cases.
#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "blur_pyramid/every_reading.h"
#include "capture/bound_texture.h"
#include "drops/splat_every_reading.h"
#include "rainref/error.h"
#include "windshield/half_sum.h"
#include "windshield/readings.h"
#include "windshield/surface_every_reading.h"

namespace rainref::windshield {
namespace {

using capture::BoundTexture;
using capture::PassCase;
using capture::PassModel;

/// An image of one channel whose rows are readable one texel to every side, where the nearest texel stands again.
class Framed {
 public:
  Framed() = default;
  explicit Framed(const capture::CaseInput& input) : width_(input.array.width), height_(input.array.height) {
    const std::vector<float> all = capture::decoded(input.array);
    const std::size_t channels = static_cast<std::size_t>(info(input.array.format).channels);
    for (int y = 0; y < height_; ++y)
      for (int x = -1; x <= width_; ++x)
        texels_.push_back(all[channels * (static_cast<std::size_t>(y) * static_cast<std::size_t>(width_) + static_cast<std::size_t>(std::clamp(x, 0, width_ - 1)))]);
  }
  /// Texel 0 of the row y or the nearest one.
  const float* row(int y) const { return texels_.data() + static_cast<std::ptrdiff_t>(std::clamp(y, 0, height_ - 1)) * (width_ + 2) + 1; }

 private:
  int width_ = 0, height_ = 0;
  std::vector<float> texels_;
};

/// As many as the uniform says, but no more than there are.
template <class Record>
void limit(std::int32_t& count, const std::vector<Record>& records) {
  const auto most = static_cast<std::int32_t>(records.size());
  if (count < 0 || count > most) count = most;
}

// ---- splat ---------------------------------------------------------------------------------------------------------
struct Splat {
  int width, height, values = 1;
  drops::SplatUniforms uniforms;
  bool corrected;
  Rounding rounding;
  std::vector<drops::Drop> drops;
  std::vector<drops::every::Stamp<plain::Plain<float>>> stamps;  // of each drop
  Framed film;

  bool rounds_each() const { return static_cast<drops::SplatBlend>(uniforms.blend) == drops::SplatBlend::add_in_half; }
  template <class N>
  drops::every::Stamp<N> stamp(const drops::Drop& d) const {
    return drops::every::splat_stamp<N>(uniforms, N::load(&d.position[0]), N::load(&d.position[1]), N::load(&d.mass), N::load(&d.life));
  }
  /// Drops whose stamps end a texel and a fiftieth of their radius short of this one surely add nothing, as the kernel knows.
  template <class N>
  std::vector<drops::every::Stamp<N>> near(int x, int y) const {
    std::vector<drops::every::Stamp<N>> out;
    const float* frame = uniforms.frame;
    for (std::size_t i = 0; i < static_cast<std::size_t>(uniforms.drop_count); ++i) {
      const auto& s = stamps[i];
      const float column = static_cast<float>(x) + 0.5f - s.x.v, row = static_cast<float>(y) + 0.5f - s.y.v;
      const float plane_x = frame[0] * column + frame[1] * row, plane_y = frame[2] * row;
      const float reach = 1.02f * s.radius.v + std::abs(frame[0]) + std::abs(frame[1]) + std::abs(frame[2]);
      if (s.height.v > 0 && plane_x * plane_x + plane_y * plane_y < reach * reach) out.push_back(stamp<N>(drops[i]));
    }
    return out;
  }
  template <class N>
  void operator()(int x, int y, N* out) const {
    const std::vector<drops::every::Stamp<N>> some = near<N>(x, y);
    drops::SplatUniforms u = uniforms;
    u.drop_count = static_cast<std::int32_t>(some.size());
    out[0] = drops::every::splat_drops<N>(u, some.data(), x, y, [&](N sum) { return rounds_each() ? half_of(sum, rounding) : sum; });
    if (corrected) out[0] = drops::every::film_height<N>(u, film.row(y - 1), film.row(y), film.row(y + 1), x) + out[0];
  }
};

class SplatModel : public capture::ModelOf<Splat> {
 public:
  using ModelOf::ModelOf;
  bool rounds_inside() const override { return pass().rounds_each(); }
};

// ---- wipe_texture --------------------------------------------------------------------------------------------------
struct WipeTexture {
  int width, height, values;
  WipeTextureUniforms uniforms;
  bool corrected;
  std::vector<Wiper> wipers;
  BoundTexture water, mask, wiped;

  template <class N>
  void operator()(int x, int y, N* out) const {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(y) * width + x;
    const N before = N::load(water.view().texels + at);
    if (corrected) {
      const N coverage = every::wipe_coverage_corrected<N>(uniforms, wipers.data(), x, y);
      out[0] = every::wiped_height_corrected(before, coverage);
      out[2] = every::time_since_wipe(uniforms, N::load(wiped.view().texels + at), coverage);
      out[1] = every::wiped_mask_corrected(uniforms, out[2]);
    } else {
      const N coverage = every::wipe_coverage_as_published<N>(uniforms, wipers.data(), x, y);
      out[0] = every::wiped_height_as_published(uniforms, before, coverage);
      out[1] = every::wiped_mask_as_published(uniforms, N::load(mask.view().texels + at), coverage);
    }
  }
};

// ---- normals -------------------------------------------------------------------------------------------------------
struct Normals {
  int width, height, values = 4;
  NormalsUniforms uniforms;
  bool corrected;
  Framed water, mask;

  template <class N>
  void operator()(int x, int y, N* out) const {
    const every::SurfaceRows<float> rows{water.row(y - 1), water.row(y), water.row(y + 1), mask.row(y - 1), mask.row(y), mask.row(y + 1)};
    const plain::Vec3<N> n = corrected ? every::normal_corrected<N>(uniforms, rows, x) : every::normal_as_published<N>(uniforms, rows, x);
    out[0] = n.x;
    out[1] = n.y;
    out[2] = n.z;
    out[3] = N(1.0f);
  }
};

// ---- blur_pyramid --------------------------------------------------------------------------------------------------
struct FogLevel {
  int width, height, values = 4;
  blur_pyramid::BlurUniforms uniforms;
  BoundTexture colour, depth;

  template <class N>
  void operator()(int x, int y, N* out) const {
    const std::ptrdiff_t at = static_cast<std::ptrdiff_t>(y) * width + x;
    const float* texel = colour.view().texels + 4 * at;
    const plain::Vec3<N> c = blur_pyramid::every::fogged<N>(uniforms, plain::Vec3<N>(N::load(texel), N::load(texel + 1), N::load(texel + 2)), N::load(depth.view().texels + at));
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
        const int column = held(2 * x + i, uniforms.source_size[0], t.width[0]), row = held(2 * y + j, uniforms.source_size[1], t.height[0]);
        return N::load(t.texels + 4 * (static_cast<std::ptrdiff_t>(row) * t.width[0] + column) + k);
      };
      out[k] = corrected ? blur_pyramid::every::halved_corrected<N>(uniforms, tap, x, y) : blur_pyramid::every::halved_as_published<N>(tap);
    }
  }
};

/// Inputs of one image each must have the size of the first output.
const capture::CaseInput& sized_input(const PassCase& c, const char* name) {
  const capture::CaseInput& input = capture::image_input(c, name);
  const capture::Array &a = input.array, &out = c.outputs.front().array;
  if (a.width != out.width || a.height != out.height) {
    throw Error(ExitCode::port_files, fmt::format("{}: in.{} is {}x{}, expected {}x{} as out.{}", c.folder(), name, a.width, a.height, out.width, out.height, c.outputs.front().name));
  }
  return input;
}

}  // namespace

std::unique_ptr<PassModel> bind_splat(const PassCase& c) {
  const capture::CaseOutput& out = c.outputs.front();
  Splat m;
  m.width = out.array.width;
  m.height = out.array.height;
  m.uniforms = capture::uniforms_of<drops::SplatUniforms>(c);
  m.corrected = c.corrected();
  m.rounding = out.store_rounding;
  m.drops = capture::records_of<drops::Drop>(capture::record_input(c, "drops"));
  limit(m.uniforms.drop_count, m.drops);
  for (const drops::Drop& d : m.drops) m.stamps.push_back(m.stamp<plain::Plain<float>>(d));
  if (m.corrected) m.film = Framed(sized_input(c, "film"));
  return std::make_unique<SplatModel>(std::move(m));
}

std::unique_ptr<PassModel> bind_wipe_texture(const PassCase& c) {
  WipeTexture m;
  m.width = c.outputs.front().array.width;
  m.height = c.outputs.front().array.height;
  m.corrected = c.corrected();
  m.values = m.corrected ? 3 : 2;
  m.uniforms = capture::uniforms_of<WipeTextureUniforms>(c);
  m.wipers = capture::records_of<Wiper>(capture::record_input(c, "wipers"));
  limit(m.uniforms.wiper_count, m.wipers);
  m.water = BoundTexture(sized_input(c, "height"));
  (m.corrected ? m.wiped : m.mask) = BoundTexture(sized_input(c, m.corrected ? "wiped" : "mask"));
  return capture::model_of(std::move(m));
}

std::unique_ptr<PassModel> bind_normals(const PassCase& c) {
  Normals m;
  m.width = c.outputs.front().array.width;
  m.height = c.outputs.front().array.height;
  m.uniforms = capture::uniforms_of<NormalsUniforms>(c);
  m.corrected = c.corrected();
  m.water = Framed(sized_input(c, "height"));
  m.mask = Framed(sized_input(c, "mask"));
  return capture::model_of(std::move(m));
}

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
