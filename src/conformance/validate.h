// From a pack and a port's files to a judgement.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "capture/pack_read.h"
#include "conformance/deviations.h"
#include "conformance/verdict.h"
#include "port_dump/port_info.h"
#include "rainref/executor.h"

namespace rainref::conformance {

struct ValidateOptions {
  std::string profile = "vulkan";
  std::string only;  ///< judge this pass alone; "": all
  bool diagnose = true;
  const parallel::Executor* executor = nullptr;
  std::function<void(int done, int of)> progress;  ///< after each case; may be null
};

/// The evaluations that this build has of a pass, or null; Error(usage) for an effect that it does not know.
const capture::PassEvaluations* evaluations_of(const std::string& effect, const std::string& pass);
/// Its binder; null where no output is judged by envelope.
Bind binder(const std::string& effect, const std::string& pass);

/// Judges the outputs in `port`, laid out as the pack. Throws Error(port_files) when files are missing or cannot be what
/// they should be, naming all of them, and when the pack's expected outputs are not this version's; Error(usage) when
/// `port` is the pack's own folder.
PortJudgement validate(const capture::Pack& pack, const std::filesystem::path& port, const ValidateOptions& options);

/// What the port says of itself, for reports, and of its stores to binary16.
void describe_port(const port_dump::PortInfo& info, PortJudgement& judgement);
std::optional<HalfMode> declared_mode(const port_dump::PortInfo& port);

/// One deviation on one pass of a pack.
struct MutantJudgement {
  std::string pass, name, sentence;
  bool legal = false;
  std::int64_t compared = 0;   ///< invocations, and ids of lists
  std::int64_t differing = 0;  ///< that store other bits than the reference
  std::int64_t outside = 0;    ///< that no alternative accepts
  bool caught() const { return outside > 0; }
};
struct MutationReport {
  std::string pack, profile;
  std::vector<MutantJudgement> mutants;
  std::vector<std::string> unjudged;  ///< passes that no envelope judges, and why
};
/// Which of the deviations the pack would catch under a profile. Compares at most `invocations` texels of each case,
/// spread over the picture, and every record of its lists.
MutationReport mutate(const capture::Pack& pack, const ValidateOptions& options, int invocations = 4096);

/// What explains the failing texels of a case, best first; empty when nothing explains any.
std::vector<Cause> diagnose(const capture::PackPass& pass, const capture::PassCase& c, const capture::PassCase* before, Bind bind,
                            const capture::PassModel& model, const std::vector<capture::Array>& port, const CaseJudgement& judgement,
                            const enclosed::Profile& profile, HalfMode mode, const parallel::Executor& executor);

/// The same for the lists of a case that are matched by id: what explains the failing ids. `model` may be null.
std::vector<Cause> diagnose_lists(const capture::PackPass& pass, const capture::PassCase& c, const capture::PassCase* before,
                                  const capture::PassModel* model, const std::vector<capture::Array>& port,
                                  const enclosed::Profile& profile, const parallel::Executor& executor);

/// The three best of them, of those that explain enough.
std::vector<Cause> best_causes(std::vector<Cause> causes);

/// The status of the whole from its passes.
void conclude(PortJudgement& judgement);

}  // namespace rainref::conformance
