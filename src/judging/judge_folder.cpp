#include "judging/judge_folder.h"

#include <memory>

#include "faults/diagnose.h"
#include "judge/conclude.h"
#include "judge/profiles.h"
#include "judge/validate.h"

namespace rainref::judging {

Judged judge_folder(const std::filesystem::path& pack, const std::filesystem::path& port, const FolderOptions& o,
                    const parallel::Executor& executor) {
  static_cast<void>(judge::judging_profile(o.profile));
  const auto opened = std::make_shared<const capture::Pack>(pack);
  judge::ValidateOptions options;
  options.profile = o.profile;
  options.only = o.passes;
  options.partial = o.partial;
  options.executor = &executor;
  options.progress = o.progress;
  options.explain = faults::diagnose;
  judge::PortJudgement judged = judge::validate(*opened, port, options);
  if (o.strict) judge::fail_warnings(judged);
  Verdict verdict = verdict_of(judged);
  return {std::move(judged), reports::page_source(opened, port), std::move(verdict)};
}

}  // namespace rainref::judging
