// Judges the files that a port wrote; used by `rainref validate`, rr_judge_folder and Python's judge_folder.
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
  bool seeks_causes = true;  ///< search for causes of failures, unless `explain` is set; this may take longer than judging
  /// Time limit in seconds for the causes of each failing pass; the best so far are then reported, with a note. 0: no limit.
  double causes_within = 0;
  std::filesystem::path spirv;  ///< a folder with bindings.json: results of the port's own shaders become notes; "": not executed
  std::function<void(const std::string& pass)> at_cause;  ///< called before the search for a failing pass's causes; may be null
};

/// Checks the request before any file of the port is read: throws Error(usage) for an unknown profile or pass, and like
/// spirv::read_programs() if shaders are given.
void check_request(const capture::Pack& pack, const FolderOptions& options);

/// Judges the outputs in the first of these folders for the pack. The others are further runs of the same port: if one differs, the pass
/// has a race and fails. Missing or unusable files are listed in the judgement. Its pictures are read from both folders, unless they are
/// still in memory. Throws like check_request and judge::validate.
Judged judge_folder(const std::shared_ptr<const capture::Pack>& pack, const std::vector<std::filesystem::path>& runs,
                    const FolderOptions& options);

/// Judges the dumps of a port's own run, like judge::shadow. The executor must outlive the judgement, which computes its pictures again.
Judged judge_dumps(const std::shared_ptr<const judge::ShadowPlan>& plan, const std::filesystem::path& folder,
                   const std::vector<judge::DumpedRun>& dumped, const FolderOptions& options);

}  // namespace rainref::judging
