// One run of one pass with its inputs and outputs, as in a pack or a dump of a port.
#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "capture/array.h"
#include "rainref/recorder.h"
#include "rainref/storage.h"

namespace rainref::capture {

/// The way an output is judged (`judge` in a pack).
enum class Judge : std::uint8_t { envelope, bits, keyed, input_only };

struct CaseInput {
  std::string name;
  Array array;
  Address address_u = Address::clamp, address_v = Address::clamp;
  std::array<float, 4> border{};                            ///< value outside the image if the address rule is border
  bool linear = false;                                      ///< the pass filters it linearly
  Filter filter = Filter::none, mip_filter = Filter::none;  ///< `none`: loaded by integer texel; one level only
};

struct CaseOutput {
  std::string name;
  Array array;  ///< the expected values
  Rounding store_rounding = Rounding::rne;
  Judge judge = Judge::envelope;
  std::array<double, 2> range{0, 1};            ///< of the stored values, as declared
  std::string unit = "", color_space = "none";  ///< as declared: one unit, or one for each channel; "none" for data
};

struct PassCase {
  std::string effect, variant, pass;
  int frame = 0, step = 0, level = -1;  ///< level: -1 if the pass does not run for each mip level
  float time = 0, dt = 0;               ///< [s] start of the frame, and time step of this run
  std::vector<std::byte> uniforms;      ///< the uniform block, bytes as declared
  std::vector<CaseInput> inputs;
  std::vector<CaseOutput> outputs;

  bool corrected() const { return variant == "corrected"; }
  /// "puddle.wave_step/0001.0": the folder of the case in a pack.
  std::string folder() const;
  /// Null if there is none of this name.
  const CaseInput* input(std::string_view name) const;
  const CaseOutput* output(std::string_view name) const;
};

}  // namespace rainref::capture
