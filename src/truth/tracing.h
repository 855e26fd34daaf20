// Traced pictures of a running effect, and comparisons of its passes with them.
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

/// Scene parameters of traced pictures, which are added to those of an effect:
/// compositor.picture, .samples, .depth and .embree_config, for corrected variants.
std::vector<scene::Parameter> parameters();
/// compositor.glass_thickness, for scenes seen through a pane.
scene::Parameter pane_thickness();
/// Those and the thickness, for corrected panes.
std::vector<scene::Parameter> pane_parameters();

struct Choice {
  bool is_traced = false;  ///< the picture is traced instead of made by the passes
  PictureOptions picture;
  TracerOptions tracer;
};
/// The choice of a scene; if these parameters are not declared, the passes' picture.
Choice choice_from(const scene::Config& config);

/// The name under which traced pictures are recorded. It is not a pass of an effect, so no pack contains it.
inline constexpr std::string_view traced_pass = "compositor";

class Tracing {
 public:
  virtual ~Tracing() = default;
  /// Traces the last rendered frame, number `frame`, and records it.
  void trace(int frame, Recorder* recorder);
  /// The traced picture as display code, row 0 = bottom.
  const Image& shown() const { return shown_; }
  /// All traced channels by name: R G B, normal.X .Y .Z, depth.Z, film, mask; row 0 = bottom.
  std::vector<image_io::Layer> layers() const;
  /// Compares the passes of the last rendered frame with the truth.
  virtual Comparison compare() = 0;

 protected:
  Tracing(Choice choice, const parallel::Executor& executor) : choice_(std::move(choice)), executor_(executor) {}
  virtual Picture picture() = 0;
  /// The effect's display of a radiance.
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
  /// Its scene parameters.
  std::vector<scene::Parameter> (*parameters)();
  /// Null if this scene has no truth. Throws Error(usage) if it asks for a traced picture that is impossible. Instance and executor must
  /// outlive it. inputs: those with which the instance was opened.
  std::unique_ptr<Tracing> (*make)(const scene::Config& config, const effect::Instance& instance, const effect::Inputs& inputs,
                                   const parallel::Executor& executor);
  /// Adds the memory of traced pictures, if the scene asks for them.
  void (*hold)(effect::RunMemory& memory, const scene::Config& config);
};
/// Null for an effect without tracing.
const EffectTracing* tracing_of(std::string_view effect);

/// Adds the memory of a traced picture, its channels and its display.
void hold_traced(effect::RunMemory& memory, const scene::Config& config);

EffectTracing puddle_tracing();
EffectTracing windshield_tracing();
EffectTracing screen_drops_tracing();
EffectTracing rainy_glass_tracing();

}  // namespace rainref::truth
