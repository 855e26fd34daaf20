// What is traced of a running effect: its pictures, and its passes against them.
#pragma once

#include <memory>
#include <string_view>
#include <utility>
#include <vector>

#include "compositor/picture.h"
#include "effect/effect.h"
#include "scene/config.h"
#include "truth/difference.h"
#include "truth/tracer_names.h"

namespace rainref::truth {

/// Scene parameters of traced pictures, which the command line adds to those of an effect:
/// compositor.picture, .samples, .depth and .embree_config, of corrected variants.
std::vector<scene::Parameter> parameters();
/// compositor.glass_thickness, of what is seen through a pane.
scene::Parameter pane_thickness();
/// Those and the thickness, of corrected panes.
std::vector<scene::Parameter> pane_parameters();

struct Choice {
  bool is_traced = false;  ///< the picture is traced, not the passes'
  PictureOptions picture;
  TracerOptions tracer;
};
/// What a scene chose; where these parameters are not declared, the passes' picture.
Choice choice_from(const scene::Config& config);

/// The name under which traced pictures are recorded; no pass of an effect, so no pack holds it.
inline constexpr std::string_view traced_pass = "compositor";

class Tracing {
 public:
  virtual ~Tracing() = default;
  /// Traces the frame that was rendered last, number `frame`, and records it.
  void trace(int frame, Recorder* recorder);
  /// That picture as display code, row 0 = bottom.
  const Image& shown() const { return shown_; }
  /// All that was traced, as named channels: R G B, normal.X .Y .Z, depth.Z, film, mask; row 0 = bottom.
  std::vector<image_io::Layer> layers() const;
  /// The passes of the frame that was rendered last against its truth.
  virtual Comparison compare() = 0;

 protected:
  Tracing(Choice choice, const parallel::Executor& executor) : choice_(std::move(choice)), executor_(executor) {}
  virtual Picture picture() = 0;
  /// The picture that the effect's display makes of a radiance.
  virtual Image display(const Image& radiance) const = 0;
  const Choice& choice() const { return choice_; }
  const parallel::Executor& executor() const { return executor_; }

 private:
  Choice choice_;
  const parallel::Executor& executor_;
  Picture picture_;
  Image shown_;
};

/// How an effect is traced.
struct EffectTracing {
  const char* effect;
  /// What its scenes may say of it.
  std::vector<scene::Parameter> (*parameters)();
  /// Null where this scene has no truth. Throws Error(usage) where it wants a traced picture that cannot be. Instance and executor must
  /// outlive it. inputs: those that the instance was opened with.
  std::unique_ptr<Tracing> (*make)(const scene::Config& config, const effect::Instance& instance, const effect::Inputs& inputs,
                                   const parallel::Executor& executor);
  /// Adds what traced pictures take, where the scene wants them.
  void (*hold)(effect::RunMemory& memory, const scene::Config& config);
};
/// Null for an effect that is not traced.
const EffectTracing* tracing_of(std::string_view effect);

/// A traced picture, its channels and its display.
void hold_traced(effect::RunMemory& memory, const scene::Config& config);

EffectTracing puddle_tracing();
EffectTracing windshield_tracing();
EffectTracing screen_drops_tracing();
EffectTracing rainy_glass_tracing();

}  // namespace rainref::truth
