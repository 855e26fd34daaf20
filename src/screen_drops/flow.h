// The flowing layer of the corrected screen drops: rain that wind drives onto a still, upright pane; drops stick or slide by
// contact-angle hysteresis, merge where they touch, and leave trails of water behind. The passes spawn, integrate, merge
// and splat are those of the room drops; here is their order on this pane.
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <vector>

#include "capture/pass_info.h"
#include "capture/pass_model.h"
#include "drops/wet_glass.h"
#include "math/constants.h"
#include "rainref/executor.h"
#include "rainref/image.h"
#include "rainref/recorder.h"
#include "scene/config.h"
#include "scene/parameter.h"
#include "state/items.h"

namespace rainref::screen_drops {

struct FlowSettings {
  double fps = 60;
  int substeps = 1;                        ///< steps of the drops in a frame
  std::array<double, 2> pane{0.64, 0.36};  ///< width and height [m]: u runs to the right, v straight up
  double gravity = standard_gravity;       ///< [m/s^2]
  double wind = 2;                         ///< onto the pane [m/s]: all that brings rain to upright glass
  double warm_up = 0;                      ///< time that it has rained before frame 0 [s]
  drops::Settings drops;                   ///< of corrected; wind along the pane there is none
  drops::SplatKeys splat;                  ///< as corrected takes them
};
/// What the keys of flow_parameters say. pane [m]: positive; rounding: of what is stored; both are the effect's own. The
/// scene's variant is corrected. Throws Error(usage) as drops::settings_from does.
FlowSettings flow_settings(const scene::Config& config, const std::array<double, 2>& pane, Rounding rounding);

/// Its bits depend on neither the executor's threads nor the SIMD target.
class Flow {
 public:
  /// The executor must outlive it. Throws Error(usage) when memory for the drops cannot be had.
  Flow(const FlowSettings& settings, const parallel::Executor& executor);
  ~Flow();
  Flow(Flow&&) noexcept;

  /// spawn, integrate and merge of each step, then splat, of the frames 0, 1, 2 ... in this order.
  void simulate(Recorder* recorder = nullptr);
  /// Frames simulated so far.
  int frame() const;
  /// The water, under names that begin with "flow."; `frames` are behind it once that is loaded.
  void list_state(state::Items& items, const int& frames);

  const Image& height() const;  ///< r16f, of splat's size: height of the water over the whole pane, row 0 = bottom [mm]
  const Image& film() const;    ///< r32f of the same size: whole mass units in a texel
  /// The live drops, in slot order.
  std::vector<drops::Drop> drops() const;
  /// Water since the start of the warm-up, in whole mass units of drops::mass_unit kg.
  const drops::MassBalance& mass_balance() const;
  /// Of the mass balance, against drops and film: exactly 0.
  std::int64_t residual() const;

  /// Makes these the only drops, of whole mass units; the mass balance counts them as arrived and the ones before as removed. Throws
  /// Error(port_files) as drops::DropArrays::assign does.
  void set_drops(std::span<const drops::Drop> records);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// What list() lists is afterwards as after warm_up(), which is called unless the state is in the cache (cache/kept_images.h).
void warm_up_once(const FlowSettings& settings, const std::function<state::Items()>& list, const std::function<void()>& warm_up);

/// Of corrected alone: flow.capacity, flow.height_size, ..., rain.rate, rain.smallest_drop, rain.wind, world.gravity. Size
/// of the pane and rounding are keys of the effect.
std::vector<scene::Parameter> flow_parameters();

/// In the order of execution: spawn, integrate, merge, splat.
std::vector<capture::PassInfo> flow_passes();
/// What they exchange: drops, glass_frame, count_thresholds, spawn_masses, film, height.
std::vector<capture::BufferInfo> flow_buffers();
std::vector<scene::UniformBlock> flow_records();

/// Each of the four passes bound to captured cases.
std::vector<capture::PassEvaluations> flow_evaluations();

}  // namespace rainref::screen_drops
