// What a port stored for an invocation, and what the reference does.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "capture/pass_model.h"
#include "image/code_range.h"
#include "judge/slots.h"
#include "math/profile.h"

namespace rainref::judge {

/// The range of a value that no device can reproduce; nothing for others. Under exact rules a march has one number of
/// steps, too.
std::optional<std::array<double, 2>> free_range(const capture::PassModel& model, std::size_t value, const enclosed::Profile& profile);

/// Of one invocation, value by value.
struct Stored {
  std::vector<std::int64_t> got, expected;
  std::vector<float> got_values, expected_values;
  std::vector<char> same;        ///< the reference's bits: -0 is not +0
  std::vector<char> free;        ///< declared as not reproducible
  std::vector<char> impossible;  ///< not a number, or free and outside what it may be
  bool any_impossible = false;

  /// `port` holds the case's outputs, in their order.
  void read(const std::vector<Slot>& slots, const capture::PassCase& c, const capture::PassModel& model, const enclosed::Profile& profile,
            const std::vector<capture::Array>& port, int x, int y);
};

/// Whether an alternative of these codes holds a value: exact rules compare bits.
bool holds(const enclosed::Profile& profile, const Stored& stored, std::size_t v, const enclosed::CodeRange& range);
/// Whether it holds all of them.
bool inside(const enclosed::Profile& profile, const std::vector<enclosed::CodeRange>& ranges, const Stored& stored);

}  // namespace rainref::judge
