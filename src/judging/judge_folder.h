// Judging the files that a port wrote: what `rainref validate`, rr_judge_folder and Python's judge_folder do.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "judge/shadow_plan.h"
#include "judge/validate.h"
#include "judging/judge_cases.h"

namespace rainref::judging {

struct FolderOptions : judge::ValidateOptions {
  bool strict = false;       ///< each WARN is a FAIL
  bool seeks_causes = true;  ///< why passes fail is looked for, in place of `explain`; that may take longer than judging
  /// Seconds of that for each failing pass; then the best so far is said, and a note says so. 0: as long as it takes.
  double causes_within = 0;
  std::filesystem::path spirv;  ///< a folder with bindings.json: what the port's own shaders say is a note; "": they are not asked
  std::function<void(const std::string& pass)> at_cause;  ///< before why this pass fails is looked for; may be null
};

/// What is wrong with the request whatever the port wrote: throws Error(usage) for an unknown profile or pass, and as
/// spirv::read_programs() where shaders are to be asked.
void check_request(const capture::Pack& pack, const FolderOptions& options);

/// Judges the outputs in the first of these folders for the pack. The others are of the same port's further runs: where one differs, the
/// pass has a race and fails. Files that are missing or cannot be used stand in the judgement. Its pictures are read from both folders,
/// as far as what was read is not kept. Errors as check_request's and judge::validate's.
Judged judge_folder(const std::shared_ptr<const capture::Pack>& pack, const std::vector<std::filesystem::path>& runs,
                    const FolderOptions& options);

/// Judges the dumps of a port's own run, as judge::shadow does. The executor must outlive the judgement, which computes its
/// pictures anew.
Judged judge_dumps(const std::shared_ptr<const judge::ShadowPlan>& plan, const std::filesystem::path& folder,
                   const std::vector<judge::DumpedRun>& dumped, const FolderOptions& options);

}  // namespace rainref::judging
