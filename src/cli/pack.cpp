// `rainref pack`.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/memory.h"
#include "capture/capture_recorder.h"
#include "capture/pack_write.h"
#include "cli/commands.h"
#include "cli/progress.h"
#include "cli/registry.h"
#include "cli/scene_file.h"
#include "cli/terminal.h"
#include "rainref/error.h"

namespace rainref::cli {
namespace {

// The passes asked for, in the order of execution; all of the variant's where none is.
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

}  // namespace

int pack(const PackOptions& options) {
  const scene::Config config = config_of_passes(load_scene(options.scene));
  const EffectEntry& entry = effect(config.effect());
  const std::vector<std::string> passes = chosen_passes(*entry.info, config.variant(), options.passes);
  const parallel::Executor executor(options.scene.threads);
  capture::PackWriter writer(options.output, *entry.info, config, options.scene.scene.filename().string(), true, passes);
  RunMemory memory = entry.memory(config);
  add_captures(memory);
  require_memory(memory);
  std::vector<InputFile> inputs;
  const std::unique_ptr<Simulation> simulation = entry.make(config, executor, inputs);
  for (const InputFile& input : inputs) {
    if (input.lossy) {
      throw Error(
          ExitCode::usage,
          fmt::format("{}: '{}' is coded with loss, and machines may decode it differently; a pack takes PNG or losslessly coded EXR",
                      input.key, input.path));
    }
  }
  const auto wanted = [&](int frame, std::string_view pass) {
    return std::binary_search(options.frames.begin(), options.frames.end(), frame) &&
           std::find(passes.begin(), passes.end(), pass) != passes.end();
  };
  capture::CaptureRecorder recorder(*entry.info, config.variant(), true, wanted, [&](const capture::PassCase& c) { writer.add(c); });
  const int frames = options.frames.back() + 1;
  {
    Progress progress(config.effect(), frames);
    for (int frame = 0; frame < frames; ++frame) {
      simulation->frame(&recorder);
      progress.advance();
    }
  }
  const capture::PackWriter::Total total = writer.finish();
  say("{} of {} in {}, {}, in {}\n", counted(total.cases, "case"), fmt::join(passes, " "), counted(total.files, "file"),
      memory_text(total.bytes), options.output.string());
  return 0;
}

}  // namespace rainref::cli
