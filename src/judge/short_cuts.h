// Fast tests that show, without envelopes, that an invocation lies inside them. The fastest comes first: the invocation has the reference's
// bits, or those of a known device, or it lies in a part of the envelopes that the pass finds faster.
#pragma once

#include <array>
#include <optional>
#include <vector>

#include "judge/alternatives.h"
#include "judge/judge.h"
#include "judge/known_device.h"
#include "judge/reference_bits.h"
#include "judge/stored.h"

namespace rainref::judge {

class ShortCuts {
 public:
  /// The arguments must outlive it.
  ShortCuts(const capture::PassCase& c, const capture::PassModel& model, const std::vector<capture::Array>& port,
            const JudgeOptions& options, const std::vector<Slot>& slots, const std::vector<HalfMode>& modes);
  /// Finds the rounding of halves that fits most of the sample. Call first.
  void find_rounding(const Sample& sample);
  /// Computes the data for the comparisons, and finds a device that fits most of the sample. Call before lies_inside() and before creating
  /// Work.
  void prepare(const Sample& sample);
  /// How many of some hundreds of sampled invocations the fast tests find inside under a rounding of halves.
  std::int64_t counted(std::size_t mode) const { return mode < counts_.size() ? counts_[mode] : 0; }

  /// Scratch data of one thread.
  struct Work {
    explicit Work(const ShortCuts& of) {
      if (of.device_.device()) device.emplace(*of.device_.device());
    }
    std::vector<char> is_held;  ///< for each rounding of halves: true if the invocation lies inside under it
    Alternatives parts;
    std::vector<enclosed::CodeRange> ranges;
    std::optional<perturbed::Scope> device;
  };
  /// True if an invocation is known to be inside the profile and the known devices: under the rounding that most have, or under each one
  /// that is tried. work.is_held says which. If false, `stored` holds the port's values.
  bool lies_inside(int x, int y, Stored& stored, Work& work) const;
  /// Whether this is known at once of `count` invocations of a row, from x on, and work.is_held is the same for all: they have the bits of
  /// the expected outputs.
  bool lie_inside(int x, int y, int count, Work& work) const;

 private:
  bool is_enough(const std::vector<char>& is_held) const;
  bool has_reference_bits(int x, int y) const;
  void count(const Sample& sample);
  bool has_parts() const;
  /// Sets work.is_held for each rounding: true if an invocation lies in a part of the envelopes of both profiles.
  void find_in_part(int part, int x, int y, const Stored& stored, Work& work) const;

  const capture::PassCase& case_;
  const capture::PassModel& model_;
  const std::vector<capture::Array>& port_;
  const JudgeOptions& options_;
  const std::vector<Slot>& slots_;
  const std::vector<HalfMode>& modes_;
  ReferenceBits bits_;
  KnownDevice device_;
  std::array<std::int64_t, 2> counts_{};
  std::size_t leading_ = 0;  ///< rounding under which skipped invocations are known to be inside, not necessarily under the other
};

}  // namespace rainref::judge
