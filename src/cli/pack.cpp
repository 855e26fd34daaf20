// `rainref pack`.
#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/memory.h"
#include "capture/capture_recorder.h"
#include "capture/pack_write.h"
#include "cli/commands.h"
#include "cli/progress.h"
#include "cli/scene_file.h"
#include "cli/terminal.h"
#include "rainref/error.h"
#include "registry/registry.h"
#include "simulation/opened.h"

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
  const scene::Config config = simulation::config_of_passes(load_scene(options.scene));
  const capture::EffectInfo& info = *registry::find(config.effect())->info;
  const std::vector<std::string> passes = chosen_passes(info, config.variant(), options.passes);
  const parallel::Executor executor(options.scene.threads);
  capture::PackWriter writer(options.output, info, config, options.scene.scene.filename().string(), true, passes);
  effect::RunMemory memory = simulation::memory_of(config);
  add_captures(memory);
  require_memory(memory);
  simulation::Opened opened = open_scene(config, executor);
  for (const effect::InputFile& input : opened.inputs().files) {
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
  capture::CaptureRecorder recorder(info, config.variant(), true, wanted, [&](const capture::PassCase& c) { writer.add(c); });
  const int frames = options.frames.back() + 1;
  {
    Progress progress(config.effect(), frames);
    for (int frame = 0; frame < frames; ++frame) {
      opened.next_frame(&recorder);
      progress.advance();
    }
  }
  const capture::PackWriter::Total total = writer.finish();
  say("{} of {} in {}, {}, in {}\n", counted(total.cases, "case"), fmt::join(passes, " "), counted(total.files, "file"),
      memory_text(total.bytes), options.output.string());
  return 0;
}

}  // namespace rainref::cli
