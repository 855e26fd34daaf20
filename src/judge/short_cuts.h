// The ways to know that an invocation lies inside its envelopes without computing them, the quickest first: it has the reference's bits, or
// those of a known device, or it lies in a part of them that the pass finds sooner.
#pragma once

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
  void prepare(const Sample& sample);
  /// Of some hundreds of the sample those that store what the reference does, by a rounding of halves.
  std::int64_t with_bits(std::size_t mode) const { return bits_.counted(mode); }

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
  /// that is tried. work.is_held says by which. `stored`: what the port stored for it is read into, where that is not enough.
  bool lies_inside(int x, int y, Stored& stored, Work& work) const;

 private:
  bool is_enough(const std::vector<char>& is_held) const;
  bool has_reference_bits(int x, int y) const;
  bool lies_in_part(int part, int x, int y, const Stored& stored, Work& work) const;

  const capture::PassCase& case_;
  const capture::PassModel& model_;
  const std::vector<capture::Array>& port_;
  const JudgeOptions& options_;
  const std::vector<Slot>& slots_;
  const std::vector<HalfMode>& modes_;
  ReferenceBits bits_;
  KnownDevice device_;
};

}  // namespace rainref::judge
