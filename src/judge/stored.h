// The values that a port and the reference stored for an invocation.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "capture/pass_model.h"
#include "image/code_range.h"
#include "judge/slots.h"
#include "math/profile.h"
#include "port_dump/kept.h"

namespace rainref::judge {

/// The range of a value that no device can reproduce; nothing for others. Under exact rules the step count of a march is reproducible too.
std::optional<std::array<double, 2>> free_range(const capture::PassModel& model, std::size_t value, const enclosed::Profile& profile);

/// The values of one invocation.
struct Stored {
  std::vector<std::int64_t> got, expected;
  std::vector<float> got_values, expected_values;
  std::vector<char> same;        ///< it has the reference's bits: -0 is not +0
  std::vector<char> free;        ///< declared as not reproducible
  std::vector<char> impossible;  ///< NaN, or free and out of its range
  bool any_impossible = false;
  /// How far below and above its value the port's own may lie (port_dump::Kept); empty: it is known of all.
  std::vector<std::array<float, 2>> spread;

  /// True if the port's own value is known to the bit.
  bool is_known(std::size_t v) const { return spread.empty() || (spread[v][0] == 0 && spread[v][1] == 0); }
  /// `port` holds the case's outputs, in their order; `kept` is what their forms leave open, or null.
  void read(const std::vector<Slot>& slots, const capture::PassCase& c, const capture::PassModel& model, const enclosed::Profile& profile,
            const std::vector<capture::Array>& port, int x, int y, const port_dump::KeptForms* kept = nullptr);
};

/// True if an alternative with these codes holds a value. Exact rules compare bits, if the port's are known.
bool holds(const enclosed::Profile& profile, const Stored& stored, std::size_t v, const enclosed::CodeRange& range);
/// True if it holds all values.
bool inside(const enclosed::Profile& profile, const std::vector<enclosed::CodeRange>& ranges, const Stored& stored);

}  // namespace rainref::judge
