// `rainref pack`.
#include <algorithm>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/memory.h"
#include "base/path_text.h"
#include "capture/capture_recorder.h"
#include "capture/flat_pack.h"
#include "capture/pack_read.h"
#include "capture/pack_write.h"
#include "cli/commands.h"
#include "cli/pack_frames.h"
#include "cli/progress.h"
#include "cli/scene_file.h"
#include "cli/terminal.h"
#include "judge/coverage.h"
#include "judge/evaluations.h"
#include "judge/null_ports.h"
#include "judge/profiles.h"
#include "judging/foreign_pack.h"
#include "rainref/error.h"
#include "registry/registry.h"
#include "reports/figures.h"
#include "scene/unexercised.h"
#include "simulation/opened.h"
#include "simulation/picture_notes.h"

namespace rainref::cli {
namespace {

// The passes asked for, in the order of execution; all of the variant if none is named.
std::vector<std::string> chosen_passes(const capture::EffectInfo& info, const std::string& variant, const std::vector<std::string>& asked) {
  const std::vector<std::string> all = info.pass_names(variant);
  for (const std::string& name : asked) {
    if (std::find(all.begin(), all.end(), name) == all.end()) {
      throw Error(ExitCode::usage,
                  fmt::format("--passes: expected some of {}, found '{}'{}", fmt::join(all, ", "), name, did_you_mean(name, all)));
    }
  }
  std::vector<std::string> chosen;
  for (const std::string& name : all) {
    if (asked.empty() || std::find(asked.begin(), asked.end(), name) != asked.end()) chosen.push_back(name);
  }
  return chosen;
}

void require_lossless(const effect::Inputs& inputs) {
  for (const effect::InputFile& input : inputs.files)
    if (input.lossy)
      throw Error(
          ExitCode::usage,
          fmt::format("{}: '{}' is coded with loss, and machines may decode it differently; a pack takes PNG or losslessly coded EXR",
                      input.key, input.path));
}

/// Number of frames after a run's end in which to look for passes that have done nothing so far: a scene of one picture has drops that
/// arrive about every second.
constexpr int frames_beyond = 120;

/// Binds a case, and tests whether a null port passes it too.
void try_null_ports(const std::string& effect, const capture::PassCase& c, const parallel::Executor& executor, judge::NullPorts& ports) {
  const std::unique_ptr<capture::PassModel> model = judge::bound(c.pass, judge::binder(effect, c.pass), c);
  ports.judge(c, model.get(), judge::profile("vulkan"), &judge::profile("typical"), judge::HalfMode::either, executor);
}
/// Passes of a pack that a null port passes, with that port.
std::map<std::string, judge::NullPorts> idle_passes(const std::filesystem::path& folder, const parallel::Executor& executor) {
  const capture::Pack pack(folder);
  std::map<std::string, judge::NullPorts> idle;
  for (const capture::PackCase& entry : pack.cases) try_null_ports(pack.effect, pack.read(entry), executor, idle[entry.pass]);
  std::erase_if(idle, [](const auto& pass) { return pass.second.passing().empty(); });
  return idle;
}

/// A pack of the selected frames, and its coverage.
class Packing {
 public:
  /// `fresh`: the scene before its first frame.
  Packing(const scene::Config& config, const PackOptions& options, const parallel::Executor& executor, std::vector<std::string> passes,
          Frames& frames, simulation::Opened fresh)
      : fresh_(std::move(fresh)),
        config_(config),
        options_(options),
        executor_(executor),
        info_(*registry::find(config.effect())->info),
        passes_(std::move(passes)),
        frames_(frames),
        unexercised_(scene::unexercised(simulation::scene_text(options.scene.scene), path_text(options.scene.scene))) {
    for (const auto& [pass, alternatives] : unexercised_)
      if (const std::vector<std::string> all = info_.pass_names(config.variant()); std::find(all.begin(), all.end(), pass) == all.end())
        throw Error(ExitCode::usage, fmt::format("{}: unexercised.{}: expected a pass of this variant{}", path_text(options.scene.scene),
                                                 pass, did_you_mean(pass, all)));
  }

  capture::PackWriter::Total write() {
    const auto wanted = [&](int frame, std::string_view pass) {
      return frames_.are_wanted(frame, pass) && std::find(passes_.begin(), passes_.end(), pass) != passes_.end();
    };
    capture::PackWriter writer(options_.output, info_, config_, path_text(options_.scene.scene.filename()), true, passes_);
    std::map<std::string, judge::Exercise> exercised;
    capture::CaptureRecorder recorder(info_, config_.variant(), true, wanted, [&](const capture::PassCase& c) {
      writer.add(c);
      const std::unique_ptr<capture::PassModel> model = judge::bound(c.pass, judge::binder(config_.effect(), c.pass), c);
      exercised[c.pass].add(judge::coverage_of(c, model.get(), executor_, judge::least_sample));
    });
    const int count = frames_.last(passes_) + 1;
    simulation::Opened opened = fresh_ ? *std::exchange(fresh_, std::nullopt) : simulation::Opened(config_, executor_);
    opened.show(false);
    Progress progress(config_.effect(), count);
    for (int frame = 0; frame < count; ++frame) {
      go_on(opened, recorder, std::any_of(passes_.begin(), passes_.end(), [&](const std::string& pass) { return wanted(frame, pass); }));
      progress.advance();
    }
    if (std::any_of(passes_.begin(), passes_.end(), [&](const std::string& pass) { return !exercised.contains(pass); })) {
      // The small pictures should give the frames, but at this size passes run in other frames, or not at all.
      frames_.follow(simulation::Opened(config_, executor_), passes_);
      std::erase_if(passes_, [&](const std::string& pass) { return !frames_.has(pass); });
      return write();
    }
    not_exercised_.clear();
    for (const std::string& pass : passes_) {
      const std::map<std::string, std::string>& reasons = unexercised_[pass];
      const judge::PassCoverage c = judge::summary(exercised[pass], reasons);
      for (const auto& [alternative, reason] : reasons)
        if (!c.reasons.contains(alternative))
          not_exercised_ += fmt::format("warning: unexercised.{}: '{}' is exercised, or there is none\n", pass, alternative);
      if (c.alternatives == 0) continue;
      writer.add_coverage(pass, c.taken, c.alternatives, c.never, reasons, c.is_sampled);
      if (options_.shows_coverage && !c.never.empty())
        not_exercised_ += fmt::format("{} {}\n", pass, reports::coverage_text(c, c.never.size()));
    }
    return writer.finish();
  }
  /// For the last pack written: reasons for alternatives that are not taken; if asked for, a line for each pass with the alternatives that
  /// no case takes.
  const std::string& not_exercised() const { return not_exercised_; }
  /// The next write() omits this pass.
  void leave_out(const std::string& pass) { std::erase(passes_, pass); }
  /// Looks for later frames in which these passes do something, and removes the passes that have one. Returns false if there is none.
  bool add_frames(std::map<std::string, judge::NullPorts>& idle) const {
    const int end = static_cast<int>(config_.integer("run.frames")) + frames_beyond;
    std::map<std::string, int> found, tried;
    // A pass that runs many times in a frame is tried as often as one that runs once.
    const auto wanted = [&](int frame, std::string_view pass) {
      const std::string name(pass);
      return !frames_.are_wanted(frame, pass) && idle.contains(name) && !found.contains(name) && tried[name] < end;
    };
    capture::CaptureRecorder recorder(info_, config_.variant(), true, wanted, [&](const capture::PassCase& c) {
      ++tried[c.pass];
      judge::NullPorts with_this_frame = idle.at(c.pass);
      try_null_ports(config_.effect(), c, executor_, with_this_frame);
      if (with_this_frame.passing().empty()) found.emplace(c.pass, c.frame);
    });
    simulation::Opened opened(config_, executor_);
    opened.show(false);
    for (int frame = 0; frame < end && found.size() < idle.size(); ++frame)
      go_on(opened, recorder, std::any_of(idle.begin(), idle.end(), [&](const auto& pass) {
              return frames_.is_rendered(pass.first) && !found.contains(pass.first);
            }));
    for (const auto& [pass, frame] : found) {
      say("added: frame {}, the first in which {} does more than a port that does nothing\n", frame, pass);
      frames_.add(pass, frame);
      idle.erase(pass);
    }
    return !found.empty();
  }

 private:
  std::optional<simulation::Opened> fresh_;  // until the first write()
  const scene::Config& config_;
  const PackOptions& options_;
  const parallel::Executor& executor_;
  const capture::EffectInfo& info_;
  std::vector<std::string> passes_;
  Frames& frames_;
  scene::Unexercised unexercised_;
  std::string not_exercised_;
};

}  // namespace

int pack(const ForeignPackOptions& options) {
  const parallel::Executor executor(options.threads);
  const judging::ForeignPack made = judging::make_foreign_pack({options.effect, options.inputs, options.output}, executor);
  for (const std::string& warning : made.warnings) say("warning: {}\n", warning);
  say("{} of {} in {}, {}, in {}\n", counted(made.total.cases, "case"), fmt::join(made.passes, " "), counted(made.total.files, "file"),
      memory_text(made.total.bytes), path_text(options.output));
  return 0;
}

int flat_pack(const std::filesystem::path& pack, const std::filesystem::path& output) {
  const capture::PackWriter::Total total = capture::write_flat(capture::Pack(pack), output);
  say("{} in {}, {}, in {}\n", counted(total.cases, "case"), counted(total.files, "file"), memory_text(total.bytes), path_text(output));
  return 0;
}

int pack(const PackOptions& options) {
  const scene::Config config = simulation::config_of_passes(load_scene(options.scene));
  const capture::EffectInfo& info = *registry::find(config.effect())->info;
  std::vector<std::string> passes = chosen_passes(info, config.variant(), options.passes);
  const parallel::Executor executor(options.scene.threads);
  effect::RunMemory memory = simulation::memory_of(config);
  add_captures(memory);
  require_memory(memory);
  simulation::Opened first = open_scene(config, executor);
  require_lossless(first.inputs());
  Frames frames(options.frames);
  try {
    frames.follow(simulation::Opened(at_small_size(config), executor), passes);
  } catch (const Error&) {
    // The scene's pictures may have only one size.
    frames.follow(simulation::Opened(config, executor), passes);
  }
  frames.tell(passes);
  std::erase_if(passes, [&](const std::string& pass) { return !frames.has(pass); });
  if (passes.empty()) throw Error(ExitCode::usage, "--passes: expected one that runs in this scene, found none");
  Packing packing(config, options, executor, passes, frames, std::move(first));
  capture::PackWriter::Total total = packing.write();
  std::map<std::string, judge::NullPorts> idle = idle_passes(options.output, executor);
  if (!idle.empty() && options.may_add_frames) {
    bool has_changed = packing.add_frames(idle);
    // Without wipers, wiper passes move no drop in any frame: every port's pass would be UNTESTED, also a correct one.
    if (options.passes.empty() && idle.size() < passes.size()) {
      for (const auto& [pass, ports] : idle) {
        say("left out: {}: a port that does nothing passes ({}), and no frame was found in which it does more\n", pass, ports.passing());
        packing.leave_out(pass);
        std::erase(passes, pass);
        has_changed = true;
      }
      idle.clear();
    }
    if (has_changed) total = packing.write();
  }
  for (const auto& [pass, ports] : idle)
    say("warning: this pack says nothing of {}: a port that does nothing passes ({}); take other frames, or a scene with more in it\n",
        pass, ports.passing());
  say("{}", packing.not_exercised());
  say("{} of {} in {}, {}, in {}\n", counted(total.cases, "case"), fmt::join(passes, " "), counted(total.files, "file"),
      memory_text(total.bytes), path_text(options.output));
  return 0;
}

}  // namespace rainref::cli
