// A sixth effect, which does not exist: breath on a cold pane. Its room is all that it needs, as CONTRIBUTING.md says.
#pragma once

#include <utility>

#include "breath/condense.pass.h"
#include "breath/veil.pass.h"
#include "effect/effect.h"
#include "math/half.h"
#include "math/perturbed.h"
#include "pass/info.h"
#include "pass/model.h"
#include "pass/run.h"
#include "rainref/variant.h"
#include "scene/member_parameter.h"

namespace rainref::breath {
namespace scalar {
using namespace rainref::scalar;
#define RAINREF_FN inline
#include "breath/condense.pass.h"
#include "breath/veil.pass.h"
#undef RAINREF_FN
}  // namespace scalar

struct Settings {
  Variant variant = Variant::corrected;
  std::uint64_t seed = 0;
  double fps = 60;
  int width = 1280, height = 720;
  double rate = 30, drying = 0.5, opacity = 0.05;
};
inline const std::vector<scene::MemberParameter<Settings>>& members() {
  using namespace scene;
  static const std::vector<MemberParameter<Settings>> table{
      real<&Settings::rate>("breath.rate", "um/s", 0, 1000, "Water that settles at the centre."),
      real<&Settings::drying>("breath.drying", "1/s", 0, 10, "Share of the water that dries.").only(correct),
      real<&Settings::opacity>("breath.opacity", "1/um", 0, 10, "Of a micrometre of water."),
  };
  return table;
}

/// The order of the passes.
class Breath {
 public:
  Breath(const Settings& settings, const parallel::Executor& executor)
      : settings_(settings), executor_(executor), scene_(Format::rgba16f, settings.width, settings.height) {
    for (Image* film : {&film_, &grown_}) *film = Image(Format::r32f, settings.width, settings.height);
    picture_ = Image(Format::rgba8, settings.width, settings.height);
    for (int y = 0; y < settings.height; ++y) {
      for (int x = 0; x < settings.width; ++x) {
        film_.row<float>(y)[x] = 0;
        for (int c = 0; c < 4; ++c) scene_.row<Half>(y)[4 * x + c] = to_half(static_cast<float>((5 * x + 3 * y + 7 * c) % 32) / 32);
      }
    }
  }
  void simulate(Recorder* recorder) {
    pass::HostIo<CondensePass> io;
    io.film = film_;
    io.grown = grown_;
    const auto frame = static_cast<float>(1 / settings_.fps);
    const CondenseUniforms u{{static_cast<float>(settings_.width) * 0.5f, static_cast<float>(settings_.height) * 0.25f},
                             static_cast<float>(settings_.width) * 0.4f,
                             static_cast<float>(settings_.rate) * frame,
                             static_cast<float>(settings_.drying) * frame,
                             0,
                             0,
                             0};
    run<CondensePass>(u, io, recorder);
    std::swap(film_, grown_);
    ++frame_;
  }
  void render(Recorder* recorder) {
    pass::HostIo<VeilPass> io;
    io.film = film_;
    io.scene = scene_;
    io.picture = picture_;
    --frame_;  // the frame whose breath this is
    run<VeilPass>(VeilUniforms{{0.8f, 0.85f, 0.9f}, static_cast<float>(settings_.opacity)}, io, recorder);
    ++frame_;
  }
  void list_state(state::Items& items) {
    items.number("frame", frame_, state::frames);
    items.image("film", film_);
  }
  int frame() const { return frame_; }
  const Image& film() const { return film_; }
  const Image& picture() const { return picture_; }

 private:
  template <class P>
  void run(const typename P::Uniforms& u, const pass::HostIo<P>& io, Recorder* recorder) const {
    const pass::Moment now{recorder, frame_, 0, frame_ / settings_.fps, 1 / settings_.fps, Rounding::rne};
    pass::Run<P> one(u, settings_.variant == Variant::corrected, Rounding::rne, io);
    one.start(now);
    one.tiles(executor_, 8);
    one.finish(now);
  }

  Settings settings_;
  const parallel::Executor& executor_;
  int frame_ = 0;
  Image scene_, film_, grown_, picture_;
};

class Instance final : public effect::InstanceOf<Breath> {
 public:
  Instance(const Settings& settings, const parallel::Executor& executor) : InstanceOf(settings, executor) {}
  std::vector<PassOutput> buffers() override { return {{"film", running().film()}, {"picture", running().picture()}}; }
  std::vector<image_io::Layer> layers() const override { return {{"", {"film"}, &running().film()}}; }
};

inline const capture::EffectInfo& info() {
  static const capture::EffectInfo all = [] {
    capture::EffectInfo i;
    i.name = "breath";
    i.passes = {pass::info_of<CondensePass>(), pass::info_of<VeilPass>()};
    i.buffers = {{"scene", "rgba16f", "Linear radiance behind the pane."}};
    for (const capture::BufferInfo& b : pass::buffers_of<CondensePass>()) i.buffers.push_back(b);
    for (const capture::BufferInfo& b : pass::buffers_of<VeilPass>()) i.buffers.push_back(b);
    return i;
  }();
  return all;
}

/// What the judge evaluates.
inline std::vector<capture::PassEvaluations> evaluations() {
  return {{"condense", pass::bind<CondensePass, scalar::CondensePassText>}, {"veil", pass::bind<VeilPass, scalar::VeilPassText>}};
}

/// What a registry holds.
inline effect::Effect entry() {
  static const std::vector<scene::Parameter> parameters = scene::parameters_of(members());
  return {"breath",
          {"as-published", "corrected"},
          parameters,
          &info(),
          [](const scene::Config& config) {
            const Settings s = scene::settings_from(members(), config);
            effect::RunMemory m{"run.size", {}, s.width, s.height, 4, 4};
            m.peak.hold(2 * image_bytes(m, Format::r32f) + image_bytes(m, Format::rgba16f) + image_bytes(m, Format::rgba8));
            return m;
          },
          [](const scene::Config& config, const parallel::Executor& executor, effect::Inputs&) -> std::unique_ptr<effect::Instance> {
            return std::make_unique<Instance>(scene::settings_from(members(), config), executor);
          }};
}

}  // namespace rainref::breath
