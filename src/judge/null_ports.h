// Null ports do nothing. If one of them gets a PASS for a pass, the pack does not test that pass.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "capture/pass_model.h"
#include "judge/judge.h"

namespace rainref::judge {

/// Outputs of a null port for a case, in order.
struct NullPort {
  std::string what;  ///< "zeros", "a copy of its input wave"
  std::vector<capture::Array> outputs;
};
/// One stores zeros; for each input with the format and size of an output, one copies it there and stores zeros elsewhere. Lists: an empty
/// one, and a copy of each input list.
std::vector<NullPort> null_ports(const capture::PassCase& c);

/// Finds null ports that pass all cases of a pass. Each is dropped at its first failing invocation.
class NullPorts {
 public:
  /// `model` may be null if no output is judged by envelope. `typical` as in JudgeOptions: a null port that would get a warning does not
  /// pass. Cases taken as data are ignored. c.outputs must be the reference's.
  void judge(const capture::PassCase& c, const capture::PassModel* model, const enclosed::Profile& profile,
             const enclosed::Profile* typical, HalfMode mode, const parallel::Executor& executor);
  /// A null port that passes every case; "" if there is none, or nothing was judged.
  std::string passing() const { return judged_ && !passing_.empty() ? passing_.front() : ""; }

 private:
  bool judged_ = false;
  std::vector<std::string> passing_;
};

}  // namespace rainref::judge
