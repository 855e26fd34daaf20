// Makes mistakes at the failing texels of a run.
#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "capture/traced_program.h"
#include "faults/probe.h"
#include "faults/replay.h"
#include "rainref/executor.h"

namespace rainref::faults {

/// Approximate tolerance: how far a conforming device may be from the reference. In codes it comes from the case's envelopes, in values
/// from the texel's own.
struct Leeway {
  std::vector<std::int64_t> codes;          // of each slot
  std::vector<std::vector<double>> values;  // of each texel and slot
};

/// Returns the first of the pass's alternative formulas (capture::AlternativeFormula) whose envelopes hold nine in ten of the failing
/// texels and of the passing ones; nothing if there is none. Does not compare bits: `explained` is 0.
std::optional<judge::Cause> alternative_formula(const capture::PassCase& c, const std::vector<capture::Array>& port,
                                                const enclosed::Profile& profile, judge::HalfMode mode, const std::vector<Texel>& failing,
                                                const std::vector<Texel>& passing);

class TexelReplay : public Replay {
 public:
  /// The arguments must outlive it.
  TexelReplay(const capture::PackPass& pass, const capture::PassCase& c, const capture::PassCase* before, judge::Bind bind,
              const capture::PassModel& model, const std::vector<capture::Array>& port, const judge::CaseJudgement& judgement,
              const enclosed::Profile& profile, judge::HalfMode mode, const parallel::Executor& executor);
  bool fails() const { return !failing_.empty(); }
  std::vector<Fault> plain() override;
  std::vector<Fault> deeper() override { return std::move(orders_); }
  std::vector<Fault> solved() override;
  std::vector<Fault> fitted() override;
  bool widen() override;
  std::vector<Tried> causes(const std::vector<Fault>& all) const override;
  std::unique_ptr<Replay> elsewhere() const override;
  std::vector<float> given(const Fault& d) const override;
  void follow(const Fault& d, std::vector<Followed>& out) const override;
  void follow_right(std::vector<Followed>& failing, std::vector<Followed>& passing) const override;
  /// Sets the port's own program for this run. It must outlive the replay.
  void take(const capture::TracedProgram& program) { source_ = program_ = &program; }
  /// Mistakes that need no search, and equally plain mistakes in finished buffers.
  std::vector<Fault> decidable() const;
  std::vector<Fault> of_finished() const;
  /// Tests faults::alternative_formula on the failing texels and some that passed.
  std::optional<judge::Cause> alternative_formula(const enclosed::Profile& profile) const;

 protected:
  /// For the run of a varied case; the reference serves as its port.
  TexelReplay(const TexelReplay& of, const capture::PassCase& c, const capture::PassModel& model);

 private:
  Tried cause(const Fault& given) const;
  /// What the port's program stores at a texel, and the slots in which stored values are not the reference's.
  StoredTexel of_program(Texel at) const;
  std::vector<int> changed_outputs(Texel at, const StoredTexel& stored) const;

  Probed probed_;
  const capture::PassCase* before_;
  judge::HalfMode mode_;
  const parallel::Executor& executor_;
  std::vector<judge::Slot> slots_;
  const std::vector<capture::Array>& port_;
  std::vector<capture::Array> reference_;
  std::vector<Texel> failing_, few_passing_, many_passing_;  ///< some of them
  Leeway leeway_;
  double passing_per_failing_ = 0;
  bool is_wide_ = false;
  unsigned patience_ = 8;  ///< a mistake that comes near at none of so many texels is given up; fewer for a long pass
  const capture::TracedProgram* program_ = nullptr;
  Constants constants_;
  std::vector<Fault> orders_;  ///< for deeper()
  std::vector<Probe> probes_;  ///< for solved()
  std::vector<float> known_;   ///< the constants that the probes were made with
};

}  // namespace rainref::faults
