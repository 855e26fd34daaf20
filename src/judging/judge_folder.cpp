#include "judging/judge_folder.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>

#include "base/path_text.h"
#include "faults/diagnose.h"
#include "judge/check_pack.h"
#include "judge/conclude.h"
#include "judge/fused.h"
#include "judge/port_files.h"
#include "judge/profiles.h"
#include "judge/races.h"
#include "judge/shadow.h"
#include "judging/own_upstream.h"
#include "judging/shader_answer.h"
#include "rainref/error.h"
#include "spirv/bindings.h"

namespace rainref::judging {
namespace {

bool is_likely(const judge::Cause& cause) { return cause.is_likely; }

/// Converts the options for the judge, with the search for causes and the buffers read from the port.
class JudgeCall {
 public:
  explicit JudgeCall(const FolderOptions& o) : options(o) {
    options.buffers = std::make_shared<judge::ReadBuffers>();
    options.explain = nullptr;
    if (!o.spirv.empty()) programs = spirv::read_programs(o.spirv);
    if (!o.seeks_causes) return;
    options.explain = [this, &o](const judge::FailedRun& failed) {
      if (o.at_cause) o.at_cause(failed.pass.name);
      const faults::SearchLimit limit(o.causes_within);
      std::optional<judge::Cause> own;
      if (pack && !failed.is_warned) {
        judge::PortFiles port(folder, pack->effect, pack->variant, options.buffers);
        own = made_from_own(failed, *pack, port);
      }
      if (own && own->is_likely) return judge::Explanation{{std::move(*own)}, ""};
      judge::Explanation why = judging::explain(failed, programs, limit);
      if (!own && pack && !failed.is_warned && std::none_of(why.causes.begin(), why.causes.end(), is_likely)) {
        own = computes_itself(failed, *pack);
        if (own) why.causes.insert(why.causes.begin(), std::move(*own));
      } else if (own) {
        why.causes.push_back(std::move(*own));
      }
      faults::keep_found(why.causes);
      if (limit.was_met() && (cut_short_.empty() || cut_short_.back() != failed.pass.name)) cut_short_.push_back(failed.pass.name);
      return why;
    };
  }
  JudgeCall(const JudgeCall&) = delete;
  JudgeCall& operator=(const JudgeCall&) = delete;

  judge::ValidateOptions options;
  Programs programs;  ///< the port's own
  /// With a pack, a cause may be that a pass was made from the port's own outputs in `folder`.
  const capture::Pack* pack = nullptr;
  std::filesystem::path folder;

  /// Adds notes about searches that reached their time limit.
  void add_notes(judge::PortJudgement& judgement) const {
    for (const std::string& pass : cut_short_)
      judgement.notes.push_back(
          fmt::format("the time for causes was over before all were tried in {}: what is named there is the best so far", pass));
  }

 private:
  std::vector<std::string> cut_short_;
};

void find_races(const capture::Pack& pack, const std::vector<std::filesystem::path>& runs, const judge::ValidateOptions& options,
                judge::PortJudgement& judgement) {
  std::vector<std::string> judged;
  for (const judge::PassJudgement& pass : judgement.passes)
    if (!pass.cases.empty()) judged.push_back(pass.pass);
  const judge::Races races = judge::find_races(pack, runs, judged, options.buffers);
  judge::add_races(races.found, judgement);
  judgement.files.insert(judgement.files.end(), races.files.begin(), races.files.end());
  judgement.notes.push_back(fmt::format("the port ran {} times; the first run was judged", runs.size()));
}

void ask_shaders(const capture::Pack& pack, const std::filesystem::path& port, const JudgeCall& call, judge::PortJudgement& judgement) {
  judge::PortFiles files(port, pack.effect, pack.variant, call.options.buffers);
  const auto load = [&](const std::string& id) -> std::optional<StoredRun> {
    const auto entry = std::find_if(pack.cases.begin(), pack.cases.end(), [&](const auto& c) { return c.id == id; });
    if (entry == pack.cases.end()) return std::nullopt;
    StoredRun run{judge::read_case(pack, *entry), {}, pack.pass(entry->pass).block};
    for (const capture::CaseOutput& output : run.c.outputs)
      run.stored.push_back(files.read(utf8_path(id), "out." + output.name, output.array, &run.kept.emplace_back()));
    return run;
  };
  judging::ask_shaders(
      load, [&](const std::string& pass) { return judge::binder(pack, pass); }, call.programs, judgement);
}

Judged with_verdict(judge::PortJudgement judgement, reports::PageSource source, const FolderOptions& o) {
  if (o.strict) judge::fail_warnings(judgement);
  Verdict verdict = verdict_of(judgement);
  return {std::move(judgement), std::move(source), std::move(verdict)};
}

}  // namespace

void check_request(const capture::Pack& pack, const FolderOptions& options) {
  static_cast<void>(judge::judging_profile(options.profile));
  for (const std::string& pass : options.only) static_cast<void>(pack.pass(pass));
  for (const std::string& passes : options.fused) static_cast<void>(judge::fused_passes(passes, pack));
  if (!options.spirv.empty()) static_cast<void>(spirv::read_programs(options.spirv));
}

Judged judge_folder(const std::shared_ptr<const capture::Pack>& pack, const std::vector<std::filesystem::path>& runs,
                    const FolderOptions& o) {
  check_request(*pack, o);
  JudgeCall call(o);
  call.pack = pack.get();
  call.folder = runs.front();
  judge::PortJudgement judgement = judge::validate(*pack, runs.front(), call.options);
  call.add_notes(judgement);
  if (runs.size() > 1) find_races(*pack, runs, call.options, judgement);
  if (!call.programs.empty()) ask_shaders(*pack, runs.front(), call, judgement);
  return with_verdict(std::move(judgement), reports::page_source(pack, runs.front(), call.options.buffers), o);
}

Judged judge_dumps(const std::shared_ptr<const judge::ShadowPlan>& plan, const std::filesystem::path& folder,
                   const std::vector<judge::DumpedRun>& dumped, const FolderOptions& o) {
  JudgeCall call(o);
  judge::PortJudgement judgement = judge::shadow(*plan, folder, dumped, call.options);
  call.add_notes(judgement);
  call.options.progress = nullptr;
  call.options.explain = nullptr;
  return with_verdict(std::move(judgement), reports::page_source(plan, folder, dumped, call.options), o);
}

}  // namespace rainref::judging
