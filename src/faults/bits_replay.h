// Makes mistakes in a list of records that is judged by bits, record by record in order.
#pragma once

#include <memory>
#include <vector>

#include "capture/pass_model.h"
#include "faults/replay.h"

namespace rainref::faults {

class BitsReplay : public Replay {
 public:
  /// For output `output`, where the port stored `port`; `evaluations` recomputes it. All arguments must outlive it.
  BitsReplay(const capture::PackPass& pass, const capture::PassCase& c, const capture::PassCase* before,
             const capture::PassEvaluations& evaluations, const capture::Array& port, std::size_t output,
             const parallel::Executor& executor);
  bool fails() const { return !failing_.empty(); }
  std::vector<Fault> plain() override;
  std::vector<Fault> fitted() override { return {}; }
  std::vector<Tried> causes(const std::vector<Fault>& all) const override;
  std::unique_ptr<Replay> elsewhere() const override { return nullptr; }
  std::vector<float> given(const Fault&) const override { return {}; }

 private:
  const capture::PackPass& pass_;
  const capture::PassCase& c_;
  const capture::PassCase* before_;
  const capture::PassEvaluations& evaluations_;
  std::size_t output_;
  const parallel::Executor& executor_;
  Records port_, right_;
  std::vector<std::size_t> failing_;  ///< numbers of the records that differ
};

}  // namespace rainref::faults
