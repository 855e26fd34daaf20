#include "judge/shadow.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>

#include <fmt/format.h>

#include "base/path_text.h"
#include "capture/check_case.h"
#include "judge/conclude.h"
#include "judge/evaluations.h"
#include "judge/judge_pass.h"
#include "registry/registry.h"
#include "judge/port_files.h"
#include "judge/profiles.h"
#include "judge/reference_outputs.h"
#include "judge/shadow_checks.h"
#include "judge/slots.h"
#include "port_dump/dump_file.h"
#include "rainref/error.h"

namespace rainref::judge {
namespace {

namespace fs = std::filesystem;
using capture::Array;
using capture::PassCase;

/// A planned or dumped run.
struct Run {
  std::string id, pass;
  int frame = 0, step = 0, level = -1;
  const PlannedRun* plan = nullptr;  ///< null: not in the plan
  const PlannedRun* like = nullptr;  ///< describes its buffers
  bool is_dumped = false;
  std::string unusable = "";  ///< buffers whose files are unusable
  auto order() const { return std::tie(frame, step, level); }
};

class Shadow {
 public:
  Shadow(const ShadowPlan& plan, const fs::path& folder, const std::vector<DumpedRun>& dumped, const ValidateOptions& options)
      : plan_(plan),
        files_(folder, plan.effect, plan.variant, options.buffers ? options.buffers : std::make_shared<ReadBuffers>()),
        options_(options) {
    for (const auto& [buffer, own] : files_.info().encodings)
      if (!own.members.empty())
        throw Error(ExitCode::port_files,
                    fmt::format("'{}': encodings.{}: expected whole records, found some members: a port's own run has no expected record "
                                "that gives the others",
                                path_text(files_.folder() / "port.json"), buffer));
    for (const PlannedRun& r : plan.runs) runs_.push_back({r.c.folder(), r.c.pass, r.c.frame, r.c.step, r.c.level, &r, &r, false});
    for (const DumpedRun& d : dumped) {
      const auto known = std::find_if(runs_.begin(), runs_.end(), [&](const Run& r) { return r.id == d.id; });
      if (known != runs_.end())
        known->is_dumped = true;
      else
        runs_.push_back({d.id, d.pass, d.frame, d.step, d.level, nullptr, like(d), true});
    }
  }

  PortRun run(const std::string& id) {
    const auto found = std::find_if(runs_.begin(), runs_.end(), [&](const Run& r) { return r.id == id; });
    if (found == runs_.end()) throw Error(ExitCode::internal, fmt::format("no run {}", id));
    PortRun out = load(*found);
    if (!out.untested.empty()) return out;
    prepare(task_of(pass_of(*found)), out);
    return out;
  }

  PortJudgement judge() {
    read_all();
    PortJudgement result;
    result.pack = plan_.scene;
    result.port = path_text(files_.folder());
    result.profile = options_.profile;
    result.effect = plan_.effect;
    result.variant = plan_.variant;
    result.scene = plan_.scene;
    describe_port(files_.info(), result);
    std::vector<PassTask> tasks, voters;
    for (const capture::PackPass& pass : plan_.passes)
      if (may_run(pass.name)) (is_wanted(pass.name) ? tasks : voters).push_back(task_of(pass));
    const enclosed::Profile& chosen = profile(options_.profile);
    result.passes = judge_passes(
        tasks,
        {&chosen, chosen.reference ? nullptr : &profile("typical"), options_.executor, declared_mode(files_.info()), options_.sample},
        voters);
    for (PassJudgement& judged : result.passes) settle(judged);
    result.files = faults_.all();
    set_first_bad(result);
    const std::vector<std::string> notes = files_.notes();
    result.notes.insert(result.notes.end(), notes.begin(), notes.end());
    for (const Tally* tally : {&host_.foreign, &host_.rounded, &host_.of_state, &unchecked_})
      for (const std::string& line : tally->lines()) result.notes.push_back(line);
    conclude(result);
    return result;
  }

 private:
  const capture::PackPass& pass_of(const Run& run) const {
    return *std::find_if(plan_.passes.begin(), plan_.passes.end(), [&](const capture::PackPass& p) { return p.name == run.pass; });
  }
  /// Name of an input's mip level in DumpedContents.
  static std::string input_level(const capture::CaseInput& input, std::size_t level) { return fmt::format("in.{}.L{}", input.name, level); }
  bool is_wanted(const std::string& pass) const { return options_.wants(pass); }

  const PlannedRun* like(const DumpedRun& d) const {
    const PlannedRun* example = plan_.example(d.pass);
    if (example && !plan_.from_scene) return example;
    const auto runs = std::count_if(plan_.runs.begin(), plan_.runs.end(),
                                    [&](const PlannedRun& r) { return r.c.pass == d.pass && r.c.frame == d.frame; });
    throw Error(ExitCode::port_files,
                fmt::format("'{}': {}", path_text(files_.folder() / utf8_path(d.id)),
                            plan_.from_scene
                                ? fmt::format("{} runs {} {} time{} in frame {}", plan_.scene, d.pass, runs, runs == 1 ? "" : "s", d.frame)
                                : fmt::format("the manifest has no run of {} to say how its buffers are; name the scene", d.pass)));
  }

  // ---- files ---------------------------------------------------------------------------------------------------------
  Array read_input(const Run& run, std::size_t i, port_dump::KeptForm* kept = nullptr) {
    const capture::CaseInput& input = run.like->c.inputs[i];
    const std::string stem = "in." + input.name;
    const std::vector<std::string> shared = run.plan ? run.plan->input_stems[i] : std::vector<std::string>();
    if (!shared.empty() && shared.front() != run.id + "/" + stem) {
      // A manifest names one file for equal arrays; the port's own dump has priority.
      try {
        for (const std::string& file : port_dump::stems_of(stem, files_.info()))
          static_cast<void>(port_dump::find_dump_file(files_.folder() / utf8_path(run.id), file));
      } catch (const Error&) {
        // Each level may be shared with another run.
        Array all;
        for (std::size_t level = 0; level < shared.size(); ++level) {
          const fs::path path = utf8_path(shared[level]);
          Array one = files_.read(path.parent_path(), path_text(path.filename()), level_of(input.array, static_cast<int>(level)), kept);
          if (level == 0)
            all = std::move(one);
          else
            all.levels.push_back(std::move(one.levels.front()));
        }
        return all;
      }
    }
    return files_.read(utf8_path(run.id), stem, input.array, kept);
  }
  std::vector<std::byte> read_uniforms(const Run& run) const {
    fs::path path = files_.folder() / utf8_path(run.id) / "uniforms.bin";
    std::error_code ignored;
    if (!fs::exists(path, ignored) && run.plan && !run.plan->uniform_file.empty())
      path = files_.folder() / utf8_path(run.plan->uniform_file);
    if (!fs::exists(path, ignored))
      throw Error(ExitCode::port_files, fmt::format("'{}' is missing: the uniform block that the run took", path_text(path)));
    const std::size_t size = run.like->c.uniforms.size();
    std::vector<std::byte> bytes = port_dump::read_port_file(path, std::max(size, std::size_t{1} << 20));
    if (bytes.size() != size)
      throw Error(ExitCode::port_files,
                  fmt::format("'{}': expected the {} bytes of the uniform block, found {}", path_text(path), size, bytes.size()));
    return bytes;
  }
  Array read_output(const Run& run, std::size_t o, port_dump::KeptForm* kept = nullptr) {
    const capture::CaseOutput& output = run.like->c.outputs[o];
    return files_.read(utf8_path(run.id), "out." + output.name, output.array, kept);
  }
  /// Reads a buffer by its name in DumpedContents.
  Array read_buffer(const std::string& buffer) {
    const std::size_t slash = buffer.rfind('/');
    const std::string id = buffer.substr(0, slash), name = buffer.substr(slash + 1);
    const Run& run = *std::find_if(runs_.begin(), runs_.end(), [&](const Run& r) { return r.id == id; });
    for (std::size_t i = 0; i < run.like->c.inputs.size(); ++i) {
      const capture::CaseInput& input = run.like->c.inputs[i];
      if (name == "in." + input.name) return read_input(run, i);
      for (std::size_t level = 0; level < input.array.levels.size(); ++level)
        if (name == input_level(input, level)) return level_of(read_input(run, i), static_cast<int>(level));
    }
    for (std::size_t o = 0; o < run.like->c.outputs.size(); ++o)
      if (name == "out." + run.like->c.outputs[o].name) return read_output(run, o);
    throw Error(ExitCode::internal, fmt::format("no buffer {}", buffer));
  }

  /// Reads every file once, before anything is judged. For passes that are not judged, reads only the available files, for the links.
  void read_all() {
    for (Run& run : runs_) {
      if (!run.is_dumped) continue;
      FileFaults unwanted;
      FileFaults& own = is_wanted(run.pass) ? faults_ : unwanted;
      own.attempt(run.pass, run.id, "uniforms", [&] { read_uniforms(run); });
      for (std::size_t i = 0; i < run.like->c.inputs.size(); ++i) {
        const capture::CaseInput& input = run.like->c.inputs[i];
        own.attempt(run.pass, run.id, "in." + input.name, [&] {
          const Array array = read_input(run, i);
          contents_.add(fmt::format("{}/in.{}", run.id, input.name), content_hash(array));
          for (std::size_t level = 0; array.levels.size() > 1 && level < array.levels.size(); ++level)
            contents_.add(fmt::format("{}/{}", run.id, input_level(input, level)), content_hash(level_of(array, static_cast<int>(level))));
        });
      }
      for (std::size_t o = 0; o < run.like->c.outputs.size(); ++o) {
        const std::string stem = "out." + run.like->c.outputs[o].name;
        own.attempt(run.pass, run.id, stem, [&] { contents_.add(run.id + "/" + stem, content_hash(read_output(run, o))); });
      }
      run.unusable = unusable_text(own.all(), run.id);
    }
    faults_.require_files();
  }

  // ---- a pass --------------------------------------------------------------------------------------------------------
  /// A pass that neither the scene (or manifest) nor the port runs is omitted: a scene without rain behind its glass has no such pass.
  bool may_run(const std::string& pass) const {
    return std::any_of(runs_.begin(), runs_.end(), [&](const Run& r) { return r.pass == pass; });
  }
  /// The dumped runs of a pass; if it has none, missing runs are not listed either.
  PassTask task_of(const capture::PackPass& pass) {
    std::vector<const Run*> own;
    bool any = false;
    for (const Run& run : runs_) {
      if (run.pass != pass.name) continue;
      own.push_back(&run);
      any |= run.is_dumped;
    }
    std::stable_sort(own.begin(), own.end(), [](const Run* a, const Run* b) { return a->order() < b->order(); });
    PassRuns runs;
    runs.takes_inputs_of_port = true;
    runs.count = any ? own.size() : 0;
    for (const Run* run : own)
      if (run->is_dumped)
        runs.invocations += invocations_of(
            run->like->c.outputs, [](const auto& o) -> const auto& { return o.array; });
    runs.settle = [this, &pass](PortRun& run, const capture::PassModel* model) { settle(pass, run, model); };
    runs.load = [this, own](std::size_t k) { return load(*own[k]); };
    if (!is_wanted(pass.name)) return {&pass, binder(plan_.effect, pass.name), std::move(runs)};
    runs.explain = options_.explain;
    runs.done_one = [this] {
      if (options_.progress) options_.progress(++done_, static_cast<int>(runs_.size()));
    };
    return {&pass, binder(plan_.effect, pass.name), std::move(runs)};
  }

  /// Sets the effect of earlier passes on a pass; call in the order of execution.
  void settle(PassJudgement& judged) {
    if (judged.cases.empty()) {
      judged.status = Status::not_judged;
      judged.reason = "the port has dumped no run of this pass";
      return;
    }
    judged.inputs_are_good = !links_broken_.contains(judged.pass);
    for (const capture::PackEdge& e : plan_.edges)
      if (e.pass == judged.pass && not_good_.contains(e.from) && e.from != judged.pass) judged.inputs_are_good = false;
    if (judged.status == Status::fail || !judged.inputs_are_good) not_good_.insert(judged.pass);
  }

  PortRun load(const Run& run) {
    PortRun out;
    out.c = run.like->c;
    out.c.frame = run.frame;
    out.c.step = run.step;
    out.c.level = run.level;
    if (!run.is_dumped) {
      out.has_no_files = true;
      out.untested = "the port has not dumped this run";
      return out;
    }
    if (!run.unusable.empty()) {
      out.has_no_files = true;
      out.untested = fmt::format("{}: missing, or cannot be used", run.unusable);
      return out;
    }
    out.c.uniforms = read_uniforms(run);
    for (std::size_t i = 0; i < out.c.inputs.size(); ++i) {
      port_dump::KeptForm kept;
      out.c.inputs[i].array = read_input(run, i, &kept);
      if (kept && kept->widest > 0)
        out.untested = fmt::format("encodings.{}: its form rounds, so what the run took is not known to the bit", out.c.inputs[i].name);
    }
    for (std::size_t o = 0; o < out.c.outputs.size(); ++o) {
      out.stored.push_back(read_output(run, o, &out.kept.emplace_back()));
      out.c.outputs[o].array = out.stored.back();  // until the reference's are computed
    }
    std::string fault = capture::uniform_fault(*registry::effect_of_pack(plan_.effect).info, out.c);
    if (fault.empty()) fault = capture::record_fault(out.c);
    if (!fault.empty()) {
      out.broken = out.untested = fault;  // nothing can be computed from it
      return out;
    }
    if (!is_wanted(run.pass)) return out;  // only used to find the rounding of stores
    const bool is_first = loaded_.insert(run.id).second;
    if (!run.plan) {
      if (is_first)
        unchecked_.add(fmt::format("the manifest does not know all runs of {}; uniforms and inputs were taken as they are", run.pass),
                       run.id);
      return out;
    }
    HostNotes unused;
    HostNotes& notes = is_first ? host_ : unused;
    const HostRules rules{options_.foreign_host, evaluations_of(plan_.effect, run.pass)};
    out.broken = check_uniforms(plan_, *run.plan, out.c, rules, notes);
    for (std::size_t i = 0; i < out.c.inputs.size() && out.broken.empty(); ++i) {
      const capture::CaseInput& input = out.c.inputs[i];
      out.broken =
          plan_.is_given(*run.plan, input.name)
              ? check_given(plan_, *run.plan, i, input.array, contents_.hash(fmt::format("{}/in.{}", run.id, input.name)), rules, notes)
              : check_link(run, i, is_first);
    }
    return out;
  }

  /// Explains why an input is not the output that it should be, or returns "".
  std::string check_link(const Run& run, std::size_t i, bool is_first) {
    const capture::CaseInput& input = run.plan->c.inputs[i];
    const PlannedRun* source = plan_.source(*run.plan, input.name);
    // If the source pass runs once for each mip level, each level is compared with its own run.
    const std::size_t parts = source && source->c.level >= 0 ? input.array.levels.size() : 1;
    for (std::size_t level = 0; level < parts; ++level) {
      std::string broken = check_link(run, i, parts > 1 ? input_level(input, level) : "in." + input.name,
                                      plan_.source(*run.plan, input.name, static_cast<int>(level)), is_first);
      if (!broken.empty()) return broken;
    }
    return "";
  }
  /// The same for an input or one of its levels.
  std::string check_link(const Run& run, std::size_t i, const std::string& part, const PlannedRun* source, bool is_first) {
    const std::string& name = run.plan->c.inputs[i].name;
    const std::string buffer = fmt::format("{}/{}", run.id, part);
    const std::string output = source ? fmt::format("{}/out.{}", source->c.folder(), name) : "";
    if (contents_.hash(output).empty()) {
      if (is_first)
        unchecked_.add(fmt::format("input {} of {} was not compared with the output of {}, which is not there", name, run.pass,
                                   plan_.edge(run.pass, name)->from),
                       run.id);
      return "";
    }
    if (contents_.hash(output) == contents_.hash(buffer)) return "";
    links_broken_.insert(run.pass);
    return broken_link(buffer, output, contents_, [&](const std::string& b) { return read_buffer(b); });
  }

  /// Computes the reference's outputs for the port's inputs.
  void settle(const capture::PackPass& pass, PortRun& run, const capture::PassModel* model) const {
    const capture::PassEvaluations* evaluations = evaluations_of(plan_.effect, pass.name);
    if (run.broken.empty() && evaluations && evaluations->doubt) run.broken = evaluations->doubt(run.c);
    std::vector<Array> reference;
    if (model) reference = reference_outputs(run.c, *model, *options_.executor);
    std::optional<std::vector<Array>> recomputed;
    for (std::size_t o = 0; o < run.c.outputs.size(); ++o) {
      capture::CaseOutput& output = run.c.outputs[o];
      const bool is_keyed = output.judge == capture::Judge::keyed;
      if (is_placed(output) || (is_keyed && model && model->keyed(output.name))) {
        output.array = reference[o];
        continue;
      }
      if (output.judge != capture::Judge::bits && !is_keyed) continue;
      if (!evaluations || !evaluations->recompute) {
        run.untested = fmt::format("this build does not recompute {}", pass.name);
        return;
      }
      if (!recomputed) recomputed = evaluations->recompute(run.c);
      output.array = (*recomputed)[o];
    }
  }

  // ---- all passes ----------------------------------------------------------------------------------------------------
  /// The pass of the first bad run, in the order of execution, is the first bad pass.
  void set_first_bad(PortJudgement& j) const {
    std::map<std::string, std::pair<int, std::size_t>> place;  // frame, then position in the plan
    for (std::size_t k = 0; k < runs_.size(); ++k) place[runs_[k].id] = {runs_[k].frame, k};
    const CaseJudgement* first = nullptr;
    for (const PassJudgement& pass : j.passes) {
      for (const CaseJudgement& c : pass.cases) {
        if (c.status != Status::fail || (first && place[first->id] <= place[c.id])) continue;
        first = &c;
        j.first_bad_pass = pass.pass;
      }
    }
    if (first) j.notes.push_back(fmt::format("the first bad run is {}", first->id));
  }

  const ShadowPlan& plan_;
  PortFiles files_;
  const ValidateOptions& options_;
  std::vector<Run> runs_;
  FileFaults faults_;
  DumpedContents contents_;
  HostNotes host_;
  Tally unchecked_;
  std::set<std::string> loaded_, links_broken_, not_good_;
  int done_ = 0;
};

}  // namespace

PortJudgement shadow(const ShadowPlan& plan, const fs::path& folder, const std::vector<DumpedRun>& dumped, const ValidateOptions& options) {
  static_cast<void>(profile(options.profile));
  return Shadow(plan, folder, dumped, options).judge();
}

PortRun shadow_run(const ShadowPlan& plan, const fs::path& folder, const std::vector<DumpedRun>& dumped, const ValidateOptions& options,
                   const std::string& id) {
  return Shadow(plan, folder, dumped, options).run(id);
}

}  // namespace rainref::judge
