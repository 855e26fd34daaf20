// Ports that do nothing. A pack whose pass one of them passes says nothing of that pass.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "capture/pass_model.h"
#include "judge/judge.h"

namespace rainref::judge {

/// What such a port stores for a case, in the order of its outputs.
struct NullPort {
  std::string what;  ///< "zeros", "a copy of its input wave"
  std::vector<capture::Array> outputs;
};
/// Zeros, and of each input that has the format and size of an output its copy there, zeros elsewhere; of lists none and each input's.
std::vector<NullPort> null_ports(const capture::PassCase& c);

/// Which of them pass all cases of a pass. They are given up at the first invocation that fails.
class NullPorts {
 public:
  /// `model` may be null where no output is judged by envelope, `typical` as in JudgeOptions: one that a judgement would warn of
  /// does not pass. Cases that are taken as data say nothing. c.outputs must be what the reference gives.
  void judge(const capture::PassCase& c, const capture::PassModel* model, const enclosed::Profile& profile,
             const enclosed::Profile* typical, HalfMode mode, const parallel::Executor& executor);
  /// One that passes every case; "" where none does, or nothing was judged.
  std::string passing() const { return judged_ && !passing_.empty() ? passing_.front() : ""; }

 private:
  bool judged_ = false;
  std::vector<std::string> passing_;
};

}  // namespace rainref::judge
