// The time at which a pass runs, and its recorder.
#pragma once

#include <initializer_list>
#include <span>
#include <string_view>

#include "rainref/recorder.h"

namespace rainref::pass {

/// time and dt [s] as in PassStart.
struct Moment {
  Recorder* recorder;  ///< may be null
  int frame, step;
  double time, dt;
  Rounding rounding;
  int level = -1;  ///< the mip level, if the pass runs once for each

  template <class Uniforms>
  void before(std::string_view pass, const Uniforms& uniforms, std::span<const PassInput> inputs) const {
    if (recorder)
      recorder->before({frame, step, pass, inputs, std::as_bytes(std::span(&uniforms, 1)), static_cast<float>(time), static_cast<float>(dt),
                        rounding, level});
  }
  template <class Uniforms>
  void before(std::string_view pass, const Uniforms& uniforms, std::initializer_list<PassInput> inputs) const {
    before(pass, uniforms, std::span<const PassInput>(inputs.begin(), inputs.size()));
  }
  void after(std::string_view pass, std::initializer_list<PassOutput> outputs, double seconds) const {
    after(pass, std::span<const PassOutput>(outputs.begin(), outputs.size()), seconds);
  }
  void after(std::string_view pass, std::span<const PassOutput> outputs, double seconds) const {
    if (recorder) recorder->pass({frame, step, pass, outputs, seconds, level});
  }
  bool is_read(std::string_view pass) const { return recorder && recorder->reads(frame, pass); }
};

}  // namespace rainref::pass
