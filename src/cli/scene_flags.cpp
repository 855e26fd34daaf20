#include "cli/scene_flags.h"

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/path_text.h"
#include "cli/option_values.h"
#include "math/simd_target.h"
#include "rainref/error.h"
#include "rainref/executor.h"
#include "scene/presets.h"
#include "simulation/own_scenes.h"

namespace rainref::cli {

void add_preset_flag(CLI::App& verb, std::vector<std::string>& presets, const std::string& before) {
  verb.add_option("--preset", presets, before + "Weather and light over the scene's own, such as storm,night; --set changes them again")
      ->type_name("PRESET,...")
      ->allow_extra_args(false);
}

std::vector<std::string> preset_override(const std::vector<std::string>& presets) {
  if (presets.empty()) return {};
  return {fmt::format("{}={}", scene::preset_word, fmt::join(presets, ","))};
}

void add_scene_flags(CLI::App& verb, SceneFlags& flags, bool with_frames) {
  verb.add_option("SCENE", flags.scene,
                  "Scene file (TOML), a scene of `rainref list`, or a picture that rainref wrote: the scene in it, up to that frame")
      ->type_name("FILE")
      ->required();
  if (with_frames) verb.add_option("--frames", flags.frames, "Number of frames")->type_name("N");
  verb.add_option("--size", flags.size, "Picture size, WxH")->type_name("WxH");
  verb.add_option("--threads", flags.threads, "Threads; the result does not depend on them")->type_name("N");
  verb.add_option("--simd", flags.simd, "SIMD target; the result does not depend on it (see `rainref list`)")->type_name("TARGET");
  add_preset_flag(verb, flags.presets);
  verb.add_option("--set", flags.set, "Override a scene value: key=value")->type_name("KEY=VALUE")->allow_extra_args(false);
}

SceneOptions resolve(const SceneFlags& flags) {
  SceneOptions options;
  options.scene = simulation::find_scene(utf8_path(flags.scene));
  options.overrides = preset_override(flags.presets);
  options.overrides.insert(options.overrides.end(), flags.set.begin(), flags.set.end());
  if (flags.frames) options.overrides.push_back(fmt::format("run.frames={}", whole_number(*flags.frames, "--frames", 1, 1000000)));
  if (flags.size) {
    const std::string& size = *flags.size;
    const std::size_t x = size.find_first_of("xX");
    if (x == std::string::npos) throw Error(ExitCode::usage, fmt::format("--size: expected WxH such as 1280x720, found '{}'", size));
    options.overrides.push_back(fmt::format("run.size=[{}, {}]", whole_number(size.substr(0, x), "--size", 1, 65536),
                                            whole_number(size.substr(x + 1), "--size", 1, 65536)));
  }
  if (flags.threads) options.threads = whole_number(*flags.threads, "--threads", 1, parallel::Executor::max_threads);
  if (flags.simd && flags.simd->empty())
    throw Error(ExitCode::usage, fmt::format("--simd: expected one of {}, found ''", fmt::join(simd_targets(), ", ")));
  select_simd_target(flags.simd.value_or(""));
  return options;
}

}  // namespace rainref::cli
