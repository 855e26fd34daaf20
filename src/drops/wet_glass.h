// The water on one glass and the passes that move it, each recorded: the part shared by the effects with drops. An effect determines the
// order of the passes and runs its own between them.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "drops/host.h"
#include "drops/motion/passes.h"
#include "drops/splat/splat.h"
#include "pass/definition.h"
#include "pass/moment.h"
#include "rainref/recorder.h"

namespace rainref::drops {

class WetGlass {
 public:
  /// frame and area [m^2] of the glass; columns and rows of the film, which only corrected has. The executor must outlive it.
  WetGlass(const Settings& settings, const PlaneFrame& frame, double area, double steps_per_second, int columns, int rows,
           const parallel::Executor& executor);

  // The passes of one step; n counts the steps before it.
  void spawn(const pass::Moment& now, const Exposure& exposure, std::int64_t n);
  void integrate(const pass::Moment& now, const GlassFrame& glass);
  /// corrected: necks, if the settings have some, and merge.
  void merge(const pass::Moment& now, std::int64_t n);
  /// The pass of a frame. glass: of the frame's last step; height: r16f, of the film's size.
  void splat(const pass::Moment& now, const SplatSettings& splat, const GlassFrame& glass, Image& height);

  /// The live drops as records, in slot order; valid until the next call or pass.
  RecordView list();
  /// Mass units (as-published: drops) that arrived and are neither on the glass nor recorded as gone: exactly 0.
  std::int64_t residual() const;
  void list_state(state::Items& items);

  DropArrays drops;
  Image film;                ///< corrected: r32f, whole mass units in a texel
  MassBalance mass_balance;  ///< totals since the start

 private:
  template <class P>
  void run(const pass::Moment& now, const typename P::Uniforms& uniforms, pass::HostIo<P> io, const std::function<MassBalance()>& body);

  Settings settings_;
  PlaneFrame frame_;
  double area_, steps_per_second_;
  const parallel::Executor& executor_;
  Arrivals arrivals_;
  Merger merger_;
  Necks necks_;
  SplatScratch scratch_;
  std::vector<Drop> listed_;
};

}  // namespace rainref::drops
