// The ways to know that an invocation lies inside its envelopes without computing them, the quickest first: it has the reference's bits, or
// those of a known device, or it lies in a part of them that the pass finds sooner.
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
  /// What is given must outlive it.
  ShortCuts(const capture::PassCase& c, const capture::PassModel& model, const std::vector<capture::Array>& port,
            const JudgeOptions& options, const std::vector<Slot>& slots, const std::vector<HalfMode>& modes);
  /// Finds the rounding of halves that most of the sample is stored by. Before all others.
  void find_rounding(const Sample& sample);
  /// Computes what the rest is compared with, and finds a device that most of the sample comes from. Before lies_inside() and before any
  /// Work.
  void prepare(const Sample& sample);
  /// How many of some hundreds of sampled invocations lie inside by a rounding of halves, as far as short cuts tell.
  std::int64_t counted(std::size_t mode) const { return mode < counts_.size() ? counts_[mode] : 0; }

  /// What a thread needs to ask; one after the other.
  struct Work {
    explicit Work(const ShortCuts& of) {
      if (of.device_.device()) device.emplace(*of.device_.device());
    }
    std::vector<char> is_held;  ///< of each rounding of halves: whether the invocation lies inside by it
    Alternatives parts;
    std::vector<enclosed::CodeRange> ranges;
    std::optional<perturbed::Scope> device;
  };
  /// Whether an invocation is known to lie inside, by the profile and by what known devices do: by the rounding that most have, or by each
  /// that is tried. work.is_held says by which. `stored` holds what the port stored for it, if false comes back.
  bool lies_inside(int x, int y, Stored& stored, Work& work) const;
  /// Whether this is known at once of `count` invocations of a row, from x on, and work.is_held is the same for all: they have the bits of
  /// the expected outputs.
  bool lie_inside(int x, int y, int count, Work& work) const;

 private:
  bool is_enough(const std::vector<char>& is_held) const;
  bool has_reference_bits(int x, int y) const;
  void count(const Sample& sample);
  bool has_parts() const;
  /// For each rounding, whether an invocation lies in a part of the envelopes of both profiles, into work.is_held.
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
  std::size_t leading_ = 0;  ///< what it leaves unasked is known to lie inside by this rounding, not by the other
};

}  // namespace rainref::judge
