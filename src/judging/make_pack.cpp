#include "judging/make_pack.h"

#include <algorithm>
#include <cerrno>
#include <map>
#include <memory>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/memory.h"
#include "base/number_text.h"
#include "base/path_text.h"
#include "base/system.h"
#include "base/system_failure.h"
#include "capture/capture_recorder.h"
#include "capture/hashing.h"
#include "capture/pack_read.h"
#include "judge/coverage.h"
#include "judge/evaluations.h"
#include "judge/null_ports.h"
#include "judge/profiles.h"
#include "judge/sample.h"
#include "judging/pack_frames.h"
#include "rainref/error.h"
#include "registry/registry.h"
#include "reports/figures.h"
#include "scene/unexercised.h"
#include "simulation/opened.h"

namespace rainref::judging {
namespace {

// The passes asked for, in the order of execution; all of the variant if none is named.
std::vector<std::string> chosen_passes(const capture::EffectInfo& info, const std::string& variant, const std::vector<std::string>& asked) {
  const std::vector<std::string> all = info.pass_names(variant);
  for (const std::string& name : asked) {
    if (std::find(all.begin(), all.end(), name) == all.end()) {
      throw Error(ExitCode::usage,
                  fmt::format("passes: expected some of {}, found '{}'{}", fmt::join(all, ", "), name, did_you_mean(name, all)));
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
class ScenePack {
 public:
  /// `fresh`: the scene before its first frame.
  ScenePack(const PackRequest& request, const PackEvents& events, const parallel::Executor& executor, std::vector<std::string> passes,
            Frames& frames, simulation::Opened fresh)
      : fresh_(std::move(fresh)),
        config_(request.config),
        request_(request),
        events_(events),
        executor_(executor),
        info_(*registry::find(config_.effect())->info),
        passes_(std::move(passes)),
        frames_(frames),
        unexercised_(scene::unexercised(request.toml, path_text(request.scene))) {
    for (const auto& [pass, alternatives] : unexercised_)
      if (const std::vector<std::string> all = info_.pass_names(config_.variant()); std::find(all.begin(), all.end(), pass) == all.end())
        throw Error(ExitCode::usage, fmt::format("{}: unexercised.{}: expected a pass of this variant{}", path_text(request.scene), pass,
                                                 did_you_mean(pass, all)));
  }

  capture::PackWriter::Total write() {
    const auto wanted = [&](int frame, std::string_view pass) {
      return frames_.are_wanted(frame, pass) && std::find(passes_.begin(), passes_.end(), pass) != passes_.end();
    };
    capture::PackWriter writer(request_.output, info_, config_, path_text(request_.scene.filename()), true, passes_);
    std::map<std::string, judge::Exercise> exercised;
    capture::CaptureRecorder recorder(info_, config_.variant(), true, wanted, [&](const capture::PassCase& c) {
      writer.add(c);
      const std::unique_ptr<capture::PassModel> model = judge::bound(c.pass, judge::binder(config_.effect(), c.pass), c);
      exercised[c.pass].add(judge::coverage_of(c, model.get(), executor_, judge::least_sample));
    });
    const int count = frames_.last(passes_) + 1;
    simulation::Opened opened = fresh_ ? *std::exchange(fresh_, std::nullopt) : simulation::Opened(config_, executor_);
    opened.show(false);
    for (int frame = 0; frame < count; ++frame) {
      go_on(opened, recorder, std::any_of(passes_.begin(), passes_.end(), [&](const std::string& pass) { return wanted(frame, pass); }));
      events_.frame(frame + 1, count);
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
          not_exercised_.push_back(fmt::format("warning: unexercised.{}: '{}' is exercised, or there is none", pass, alternative));
      if (c.alternatives == 0) continue;
      writer.add_coverage(pass, c.taken, c.alternatives, c.never, reasons, c.is_sampled);
      if (request_.shows_coverage && !c.never.empty())
        not_exercised_.push_back(fmt::format("{} {}", pass, reports::coverage_text(c, c.never.size())));
    }
    return writer.finish();
  }
  /// For the last pack written: reasons for alternatives that are not taken; if asked for, a line for each pass with the alternatives that
  /// no case takes.
  const std::vector<std::string>& not_exercised() const { return not_exercised_; }
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
      events_.line(fmt::format("added: frame {}, the first in which {} does more than a port that does nothing", frame, pass));
      frames_.add(pass, frame);
      idle.erase(pass);
    }
    return !found.empty();
  }

 private:
  std::optional<simulation::Opened> fresh_;  // until the first write()
  const scene::Config& config_;
  const PackRequest& request_;
  const PackEvents& events_;
  const parallel::Executor& executor_;
  const capture::EffectInfo& info_;
  std::vector<std::string> passes_;
  Frames& frames_;
  scene::Unexercised unexercised_;
  std::vector<std::string> not_exercised_;
};

/// Passes that run up to this frame and give the same for another seed: such as masks of fixed geometry, and all of the puddle as
/// published, whose drops are functions of time alone.
std::vector<std::string> seedless(const scene::Config& quick, const std::vector<std::string>& passes, int last,
                                  const parallel::Executor& executor) {
  const auto hashes = [&](std::int64_t seed) {
    scene::Config config = quick;
    config.set("seed", seed, config.entry("seed").origin);
    simulation::Opened opened(config, executor);
    opened.show(false);
    capture::HashRecorder recorder;
    std::map<std::string, std::string> all;
    for (int frame = 0; frame <= last; ++frame) {
      opened.next_frame(&recorder);
      for (const capture::HashLine& line : recorder.take_lines()) all[line.pass] += line.text() + "\n";
    }
    return all;
  };
  const std::int64_t seed = quick.integer("seed");
  std::map<std::string, std::string> one = hashes(seed), other = hashes(seed ^ 1);
  std::vector<std::string> found = passes;
  std::erase_if(found, [&](const std::string& pass) { return one[pass].empty() || one[pass] != other[pass]; });
  return found;
}

}  // namespace

WrittenPack make_pack(const PackRequest& request, const parallel::Executor& executor, const PackEvents& events) {
  const scene::Config& config = request.config;
  std::vector<std::string> passes = chosen_passes(*registry::find(config.effect())->info, config.variant(), request.passes);
  effect::RunMemory memory = simulation::memory_of(config);
  add_captures(memory);
  require_memory(memory);
  simulation::Opened first(config, executor);
  events.opened(first.inputs());
  require_lossless(first.inputs());
  Frames frames(request.frames);
  scene::Config quickly = config;
  try {
    quickly = at_small_size(config);
    frames.follow(simulation::Opened(quickly, executor), passes);
  } catch (const Error&) {
    // The scene's pictures may have only one size.
    quickly = config;
    frames.follow(simulation::Opened(config, executor), passes);
  }
  frames.tell(passes, events.line);
  std::erase_if(passes, [&](const std::string& pass) { return !frames.has(pass); });
  if (passes.empty()) throw Error(ExitCode::usage, "passes: expected one that runs in this scene, found none");
  ScenePack packing(request, events, executor, passes, frames, std::move(first));
  capture::PackWriter::Total total = packing.write();
  std::map<std::string, judge::NullPorts> idle = idle_passes(request.output, executor);
  if (!idle.empty() && request.may_add_frames) {
    bool has_changed = packing.add_frames(idle);
    // Without wipers, wiper passes move no drop in any frame: every port's pass would be UNTESTED, also a correct one.
    if (request.passes.empty() && idle.size() < passes.size()) {
      for (const auto& [pass, ports] : idle) {
        events.line(fmt::format("left out: {}: a port that does nothing passes ({}), and no frame was found in which it does more", pass,
                                ports.passing()));
        packing.leave_out(pass);
        std::erase(passes, pass);
        has_changed = true;
      }
      idle.clear();
    }
    if (has_changed) total = packing.write();
  }
  for (const auto& [pass, ports] : idle)
    events.line(
        fmt::format("warning: this pack says nothing of {}: a port that does nothing passes ({}); take other frames, or a scene with more "
                    "in it",
                    pass, ports.passing()));
  for (const std::string& line : packing.not_exercised()) events.line(line);
  if (!request.is_for_one_use) return {total, passes};
  if (const std::vector<std::string> same = seedless(quickly, passes, request.frames.back(), executor); !same.empty())
    events.line(fmt::format("warning: no seed changes what {} gives: take other frames or keys, so that it cannot be known before",
                            fmt::join(same, " ")));
  return {total, passes};
}

std::int64_t seed_of(const std::string& text, const char* option) {
  if (text == "random") {
    std::uint64_t bits = 0;
    if (system::random_bits(bits) != 0) throw_system_error(errno);
    return static_cast<std::int64_t>(bits >> 11);
  }
  const std::optional<std::int64_t> seed = whole_from<std::int64_t>(text);
  if (!seed || *seed < 0)
    throw Error(ExitCode::usage,
                fmt::format("{}: expected \"random\" or a whole number from 0 to {}, found '{}'", option, INT64_MAX, text));
  return *seed;
}

}  // namespace rainref::judging
