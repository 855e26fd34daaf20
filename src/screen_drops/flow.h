// The flowing layer of the corrected screen drops: rain that wind drives onto a still, upright pane. Drops stick or slide by contact-angle
// hysteresis, merge if they touch, and leave trails of water. The passes spawn, integrate, merge and splat are those of the room drops;
// this file gives their order on the pane.
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
  double wind = 2;                         ///< wind onto the pane [m/s]; it alone brings rain to upright glass
  double warm_up = 0;                      ///< time of rain before frame 0 [s]
  drops::Settings drops;                   ///< corrected; there is no wind along the pane
  drops::SplatKeys splat;                  ///< as for corrected
};
/// The settings of the keys in flow_parameters. pane [m]: positive; rounding: of stores; both come from the effect. The scene's variant is
/// corrected. Throws Error(usage) as drops::settings_from does.
FlowSettings flow_settings(const scene::Config& config, const std::array<double, 2>& pane, Rounding rounding);

/// Its bits depend neither on the executor's threads nor on the SIMD target.
class Flow {
 public:
  /// The executor must outlive it. Throws Error(usage) if there is not enough memory for the drops.
  Flow(const FlowSettings& settings, const parallel::Executor& executor);
  ~Flow();
  Flow(Flow&&) noexcept;

  /// Runs spawn, integrate and merge of each step, then splat. Frames run in the order 0, 1, 2 ...
  void simulate(Recorder* recorder = nullptr);
  /// Frames simulated so far.
  int frame() const;
  /// Adds the water, under names that begin with "flow."; `frames` is the number of frames after loading.
  void list_state(state::Items& items, const int& frames);

  const Image& height() const;  ///< r16f, of splat's size: height of the water over the whole pane, row 0 = bottom [mm]
  const Image& film() const;    ///< r32f of the same size: whole mass units in a texel
  /// The live drops, in slot order.
  std::vector<drops::Drop> drops() const;
  /// Totals of water since the start of the warm-up, in whole mass units of drops::mass_unit kg.
  const drops::MassBalance& mass_balance() const;
  /// Difference of the mass balance from drops and film: exactly 0.
  std::int64_t residual() const;

  /// Replaces all drops by these, of whole mass units. The mass balance counts them as arrived and the previous ones as removed. Throws
  /// Error(port_files) as drops::DropArrays::assign does.
  void set_drops(std::span<const drops::Drop> records);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

/// Brings the items of list() to their state after warm_up(), which is called unless the state is in the cache (cache/kept_images.h).
void warm_up_once(const FlowSettings& settings, const std::function<state::Items()>& list, const std::function<void()>& warm_up);

/// For corrected only: flow.capacity, flow.height_size, ..., rain.rate, rain.smallest_drop, rain.wind, world.gravity. Size of the pane and
/// rounding are keys of the effect.
std::vector<scene::Parameter> flow_parameters();

/// In the order of execution: spawn, integrate, merge, splat.
std::vector<capture::PassInfo> flow_passes();
/// Their buffers: drops, glass_frame, count_thresholds, spawn_masses, film, height.
std::vector<capture::BufferInfo> flow_buffers();
std::vector<scene::UniformBlock> flow_records();

/// Each of the four passes, bound to captured cases.
std::vector<capture::PassEvaluations> flow_evaluations();

}  // namespace rainref::screen_drops
