#include "cli/cli.h"

#include <signal.h>

#include <algorithm>
#include <cctype>
#include <cstdio>
#include <filesystem>
#include <new>
#include <optional>
#include <string_view>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/floating_point.h"
#include "base/signals.h"
#include "cli/commands.h"
#include "cli/terminal.h"
#include "conformance/profiles.h"
#include "math/simd_target.h"
#include "rainref/executor.h"
#include "rainref/error.h"
#include "rainref/version.h"

namespace rainref::cli {
namespace {

/// What `run` and `hash` take besides the scene, before it becomes overrides.
struct SceneFlags {
  std::string scene;
  std::optional<std::string> size, simd, frames, threads;
  std::vector<std::string> set;
};

void add_scene_flags(CLI::App& verb, SceneFlags& flags, bool with_frames = true) {
  verb.add_option("SCENE", flags.scene, "Scene file (TOML)")->type_name("FILE")->required();
  if (with_frames) verb.add_option("--frames", flags.frames, "Number of frames")->type_name("N");
  verb.add_option("--size", flags.size, "Picture size, WxH")->type_name("WxH");
  verb.add_option("--threads", flags.threads, "Threads; the result does not depend on them")->type_name("N");
  verb.add_option("--simd", flags.simd, "SIMD target; the result does not depend on it (see `rainref list`)")->type_name("TARGET");
  verb.add_option("--set", flags.set, "Override a scene value: key=value")->type_name("KEY=VALUE")->allow_extra_args(false);
}

int whole_number(const std::string& text, const char* option, int low, int high) {
  std::size_t used = 0;
  long value = 0;
  try {
    value = std::stol(text, &used);
  } catch (const std::exception&) {
    used = 0;
  }
  if (used != text.size() || text.empty() || value < low || value > high) {
    throw Error(ExitCode::usage, fmt::format("{}: expected a whole number from {} to {}, found '{}'", option, low, high, text));
  }
  return static_cast<int>(value);
}

// "a,b,c"
std::vector<std::string> list_of(const std::string& text) {
  std::vector<std::string> parts{""};
  for (const char c : text) {
    if (c == ',')
      parts.emplace_back();
    else
      parts.back() += c;
  }
  return parts;
}

SceneOptions resolve(const SceneFlags& flags) {
  SceneOptions options;
  options.scene = flags.scene;
  options.overrides = flags.set;
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

// The parser knows no nearest name, and speaks of what is missing before what is misspelt: so misspelt verbs and
// options are looked for first.
void refuse_unknown(const CLI::App& app, int argc, const char* const* argv) {
  const CLI::App* verb = nullptr;
  for (int i = 1; i < argc; ++i) {
    const std::string word = argv[i];
    if (word == "--") return;
    const bool is_long = word.starts_with("--");
    if (is_long || (word.size() > 1 && word[0] == '-' && std::isalpha(static_cast<unsigned char>(word[1])))) {
      const CLI::App& scope = verb ? *verb : app;
      const std::string name = is_long ? word.substr(0, word.find('=')) : word.substr(0, 2);
      const CLI::Option* option = scope.get_option_no_throw(name);
      if (!option) {
        std::vector<std::string> names;
        for (const CLI::Option* o : scope.get_options()) {
          for (const std::string& known : o->get_lnames()) names.push_back("--" + known);
        }
        throw Error(ExitCode::usage, fmt::format("{}: unknown option{}{}", name, verb ? fmt::format(" of '{}'", verb->get_name()) : "",
                                                 did_you_mean(name, names)));
      }
      if (option->get_items_expected_max() > 0 && word == name) ++i;  // its value
    } else if (!verb) {
      std::vector<std::string> names;
      for (const CLI::App* known : app.get_subcommands([](const CLI::App*) { return true; })) {
        names.push_back(known->get_name());
        if (word == known->get_name()) verb = known;
      }
      if (!verb)
        throw Error(ExitCode::usage,
                    fmt::format("expected one of {}, found '{}'{}", fmt::join(names, ", "), word, did_you_mean(word, names)));
    }
  }
}

/// `help` and `help VERB` as what they stand for.
std::vector<const char*> without_help_verb(int argc, const char* const* argv) {
  std::vector<const char*> words(argv, argv + argc);
  if (argc < 2 || std::string_view(argv[1]) != "help") return words;
  if (argc > 3) throw Error(ExitCode::usage, fmt::format("help: expected one verb, found '{}' too", argv[3]));
  words.erase(words.begin() + 1);
  if (argc == 2 || argv[2][0] != '-') words.push_back("--help");
  return words;
}

int parse_and_run(int argc, const char* const* argv) {
  CLI::App app{"rainref: the deterministic CPU reference for real-time rain"};
  app.set_version_flag("--version", std::string("rainref ") + version());
  app.require_subcommand(1);
  app.footer("`rainref help VERB` or `rainref VERB --help` says what a verb takes.\nExample: rainref run scenes/puddle/default.toml");

  bool list_json = false, describe_json = false;
  CLI::App& list_verb = *app.add_subcommand("list", "Effects, variants, passes, scenes and SIMD targets");
  list_verb.add_flag("--json", list_json, "As JSON");
  list_verb.footer("Example: rainref list --json");

  std::string described;
  LayoutRequest layout;
  CLI::App& describe_verb = *app.add_subcommand("describe", "Parameters, passes and buffers of an effect; GPU layouts");
  describe_verb.add_option("EFFECT", described, "Effect")->type_name("NAME")->required();
  describe_verb.add_flag("--json", describe_json, "As JSON");
  describe_verb.add_option("--layout", layout.language, "Uniform blocks, records and lists ready to paste: c, glsl, hlsl, wgsl or cuda")
      ->type_name("LANGUAGE");
  describe_verb.add_option("--pass", layout.pass, "With --layout: what this pass needs alone")->type_name("NAME");
  describe_verb.add_option("--variant", layout.variant, "With --layout: in this variant alone")->type_name("NAME");
  describe_verb.footer("Example: rainref describe puddle --layout glsl --pass wave_step --variant corrected");

  SceneFlags run_flags, hash_flags, pack_flags;
  RunOptions run_options;
  std::string image = "png";
  std::optional<std::string> output, every, captured;
  CLI::App& run_verb = *app.add_subcommand("run", "Simulate and render a scene");
  add_scene_flags(run_verb, run_flags);
  run_verb.add_option("-o,--output", output, "Folder for pictures and summary.json (default: out/<effect>/<scene>)")->type_name("DIR");
  run_verb.add_option("--image", image, "Pictures to write: exr, png, both or none")->type_name("KIND");
  run_verb.add_option("--every", every, "Write every K-th frame (default: the last frame only)")->type_name("K");
  run_verb.add_option("--capture", captured, "Write the passes' buffers of these frames to capture/: passes (outputs), all (inputs too)")
      ->type_name("WHAT");
  run_verb.add_flag("--compare-truth", run_options.compare_truth,
                    "Compare the passes of these frames with the traced truth: pictures of the differences, percentiles in summary.json");
  run_verb.add_flag("--json", run_options.json, "Print the summary as JSON");
  run_verb.footer("Example: rainref run scenes/puddle/default.toml --frames 120 --set rain.rate=40 -o out/heavy");

  CLI::App& hash_verb = *app.add_subcommand("hash", "Hash every buffer that every pass writes");
  add_scene_flags(hash_verb, hash_flags);
  hash_verb.footer("Example: rainref hash scenes/puddle/default.toml --frames 60 --threads 2 --simd avx2");

  std::string pack_output, at = "0,1,12";
  std::optional<std::string> passes;
  CLI::App& pack_verb = *app.add_subcommand("pack", "Write a conformance pack: inputs, uniforms and expected outputs of every pass");
  add_scene_flags(pack_verb, pack_flags, false);
  pack_verb.add_option("-o,--output", pack_output, "Folder of the pack; an older pack there is replaced")->type_name("DIR")->required();
  pack_verb.add_option("--at", at, "Frames to take, such as 0,1,12")->type_name("LIST");
  pack_verb.add_option("--passes", passes, "Passes to take, such as wave_step,shade (default: all)")->type_name("LIST");
  pack_verb.footer("Example: rainref pack scenes/puddle/default.toml --size 320x180 --at 0,1,12 -o out/pack");

  std::string diff_a, diff_b;
  CLI::App& diff_verb = *app.add_subcommand("diff", "The first difference between two captures or packs");
  diff_verb.add_option("A", diff_a, "Folder of a capture or pack")->type_name("DIR")->required();
  diff_verb.add_option("B", diff_b, "Folder of another")->type_name("DIR")->required();
  diff_verb.footer("Example: rainref diff out/a/capture out/b/capture");

  const std::string profiles = fmt::format("{}", fmt::join(conformance::profile_names(), ", "));
  ValidateRequest validate_request;
  std::optional<std::string> validate_threads, mutate_threads;
  std::string validate_pack, validate_port, mutate_pack;
  CLI::App& validate_verb = *app.add_subcommand("validate", "Judge a GPU port's outputs against a pack");
  SceneFlags shadow_flags;
  std::optional<std::string> shadow;
  validate_verb.add_option("PACK", validate_pack, "Folder of the pack; with --shadow the scene that the port ran")->type_name("DIR");
  std::optional<std::string> validate_exec, timeout, repeat;
  validate_verb.add_option("--port", validate_port, "Folder with the port's outputs, laid out as the pack")->type_name("DIR");
  validate_verb
      .add_option("--exec", validate_exec,
                  "Run the port first: a shell command with {pack} and {out} (or $RAINREF_PACK and $RAINREF_OUT), which becomes a new "
                  "folder or that of --port")
      ->type_name("COMMAND");
  validate_verb.add_option("--timeout", timeout, "Seconds that the command may take (default: 600)")->type_name("SECONDS");
  validate_verb.add_option("--repeat", repeat, "Run the command so often and look for races")->type_name("N");
  validate_verb.add_option("--shadow", shadow, "Judge the dumps of a port's own run, inputs and outputs of each pass, one step at a time")
      ->type_name("DIR");
  validate_verb.add_option("--size", shadow_flags.size, "With --shadow and a scene: its picture size, WxH")->type_name("WxH");
  validate_verb.add_option("--set", shadow_flags.set, "With --shadow and a scene: override one of its values, key=value")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  validate_verb.add_option("--profile", validate_request.profile, "What the port's API allows: " + profiles + " (default: vulkan)")
      ->type_name("NAME");
  validate_verb.add_option("--only", validate_request.only, "Judge this pass alone")->type_name("PASS");
  validate_verb.add_flag("--allow-untested", validate_request.allow_untested, "Forgive what could not be judged, beside at least one PASS");
  validate_verb.add_option("--threads", validate_threads, "Threads; the result does not depend on them")->type_name("N");
  add_report_options(validate_verb, validate_request.reports);
  for (CLI::Option* option : validate_verb.get_options([](const CLI::Option* o) { return o->get_type_name() == "TEXT"; }))
    option->type_name("FILE");
  validate_verb.footer(
      "Examples: rainref validate out/pack --port out/port --profile vulkan\n          rainref validate out/pack --exec './port {pack} "
      "{out}' --repeat 3\n          rainref validate --shadow out/dump scenes/puddle/default.toml");

  MutateRequest mutate_request;
  CLI::App& mutate_verb = *app.add_subcommand("mutate", "Which porting bugs a pack would catch");
  mutate_verb.add_option("PACK", mutate_pack, "Folder of the pack")->type_name("DIR")->required();
  mutate_verb.add_option("--profile", mutate_request.profile, "What the port's API allows: " + profiles + " (default: vulkan)")
      ->type_name("NAME");
  mutate_verb.add_option("--only", mutate_request.only, "Of this pass alone")->type_name("PASS");
  mutate_verb.add_flag("--all", mutate_request.all, "List every deviation, not only those missed");
  mutate_verb.add_option("--threads", mutate_threads, "Threads; the result does not depend on them")->type_name("N");
  mutate_verb.footer("Example: rainref mutate out/pack --profile vulkan");

  CLI::App& selftest_verb = *app.add_subcommand("selftest", "Prove determinism on this machine, in seconds");
  selftest_verb.footer("Example: rainref selftest");

  const std::vector<const char*> words = without_help_verb(argc, argv);
  refuse_unknown(app, static_cast<int>(words.size()), words.data());
  try {
    app.parse(static_cast<int>(words.size()), words.data());
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);  // --help, --version
    throw Error(ExitCode::usage, fmt::format("{} (see `rainref --help`)", e.what()));
  }
  if (list_verb.parsed()) return list(list_json);
  if (describe_verb.parsed()) return describe(described, describe_json, layout);
  if (run_verb.parsed()) {
    const std::vector<std::string> kinds{"exr", "png", "both", "none"};
    if (std::find(kinds.begin(), kinds.end(), image) == kinds.end()) {
      throw Error(ExitCode::usage,
                  fmt::format("--image: expected exr, png, both or none, found '{}'{}", image, did_you_mean(image, kinds)));
    }
    run_options.png = image == "png" || image == "both";
    run_options.exr = image == "exr" || image == "both";
    if (output && output->empty()) throw Error(ExitCode::usage, "--output: expected a folder, found ''");
    run_options.output = output.value_or("");
    if (every) run_options.every = whole_number(*every, "--every", 1, 1000000);
    if (captured) {
      const std::vector<std::string> what{"passes", "all"};
      if (std::find(what.begin(), what.end(), *captured) == what.end()) {
        throw Error(ExitCode::usage,
                    fmt::format("--capture: expected passes or all, found '{}'{}", *captured, did_you_mean(*captured, what)));
      }
      run_options.capture = *captured == "all" ? RunOptions::all : RunOptions::passes;
    }
    run_options.scene = resolve(run_flags);
    return run(run_options);
  }
  if (hash_verb.parsed()) return hash(resolve(hash_flags));
  if (pack_verb.parsed()) {
    PackOptions options;
    if (pack_output.empty()) throw Error(ExitCode::usage, "--output: expected a folder, found ''");
    options.output = pack_output;
    for (const std::string& frame : list_of(at)) options.frames.push_back(whole_number(frame, "--at", 0, 1000000));
    std::sort(options.frames.begin(), options.frames.end());
    if (passes) options.passes = list_of(*passes);
    options.scene = resolve(pack_flags);
    return pack(options);
  }
  if (diff_verb.parsed()) return diff(diff_a, diff_b);
  const auto threads_of = [](const std::optional<std::string>& text) {
    return text ? whole_number(*text, "--threads", 1, parallel::Executor::max_threads) : 0;
  };
  if (validate_verb.parsed()) {
    if (shadow) {
      if (shadow->empty()) throw Error(ExitCode::usage, "--shadow: expected a folder, found ''");
      if (validate_exec || !validate_port.empty())
        throw Error(ExitCode::usage, fmt::format("{}: does not go with --shadow", validate_exec ? "--exec" : "--port"));
      if (validate_pack.empty() && (shadow_flags.size || !shadow_flags.set.empty()))
        throw Error(ExitCode::usage, "--set and --size: expected the scene that they change");
      if (std::error_code ignored; std::filesystem::is_directory(validate_pack, ignored)) {
        throw Error(ExitCode::usage, fmt::format("--shadow: expected the scene that the port ran, found the folder '{}'; a manifest.json "
                                                 "beside the dumps would serve as well",
                                                 validate_pack));
      }
      validate_request.shadow = *shadow;
      shadow_flags.scene = validate_pack;
      validate_request.scene = resolve(shadow_flags);
    } else {
      if (validate_pack.empty()) throw Error(ExitCode::usage, "validate: expected the folder of a PACK, or --shadow DIR");
      if (shadow_flags.size || !shadow_flags.set.empty())
        throw Error(ExitCode::usage, "--set and --size: go with --shadow and a scene only");
      if (!validate_exec && validate_port.empty())
        throw Error(ExitCode::usage, "validate: expected --port DIR, or --exec COMMAND, which runs the port");
    }
    if (!validate_exec && (timeout || repeat))
      throw Error(ExitCode::usage, fmt::format("{}: goes with --exec only", timeout ? "--timeout" : "--repeat"));
    if (validate_exec) {
      validate_request.exec = *validate_exec;
      if (validate_request.exec.empty()) throw Error(ExitCode::usage, "--exec: expected a command, found ''");
      const bool has_out = validate_exec->find("{out}") != std::string::npos || validate_exec->find("RAINREF_OUT") != std::string::npos;
      if (!has_out && validate_port.empty()) {
        throw Error(
            ExitCode::usage,
            "--exec: expected {out} or $RAINREF_OUT in the command, where the port's outputs go; or --port, the folder that it writes to");
      }
      if (timeout) validate_request.timeout_s = whole_number(*timeout, "--timeout", 1, 1000000);
      if (repeat) validate_request.repeat = whole_number(*repeat, "--repeat", 1, 1000);
      if (validate_request.repeat > 1 && !has_out) {
        throw Error(ExitCode::usage, "--repeat: expected {out} or $RAINREF_OUT in the command: each run has a folder of its own");
      }
    }
    validate_request.pack = validate_pack;
    validate_request.port = validate_port;
    validate_request.threads = threads_of(validate_threads);
    validate_request.command = command_text(argc, argv);
    return validate(validate_request);
  }
  if (mutate_verb.parsed()) {
    mutate_request.pack = mutate_pack;
    mutate_request.threads = threads_of(mutate_threads);
    return mutate(mutate_request);
  }
  return selftest();
}

}  // namespace

int main(int argc, const char* const* argv) {
  undo_when_interrupted();  // first: threads that come later must leave signals to it
  // A reader of standard output who goes away shows as an error, so that files are cleaned up on the way.
  const bool dies_of_pipes = ::signal(SIGPIPE, SIG_IGN) == SIG_DFL;
  const FloatingPointGuard guard;  // libraries that are loaded at the start may have set another state
  ExitCode code = ExitCode::internal;
  std::string message;
  try {
    const int result = parse_and_run(argc, argv);
    // A full disk shows when standard output is flushed.
    if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return result;
    code = ExitCode::io;
    message = "standard output cannot be written";
  } catch (const Error& e) {
    code = e.code();
    message = e.what();
  } catch (const std::bad_alloc&) {
    code = ExitCode::usage;
    message = "this scene needs more memory than can be had";
  } catch (const std::exception& e) {
    // Printing throws when a full disk shows before the end.
    if (std::ferror(stdout)) code = ExitCode::io;
    message =
        std::ferror(stdout) ? fmt::format("standard output cannot be written: {}", e.what()) : fmt::format("internal error: {}", e.what());
  }
  if (dies_of_pipes && code == ExitCode::io && std::ferror(stdout) && reader_is_gone()) {
    ::signal(SIGPIPE, SIG_DFL);
    ::raise(SIGPIPE);
  }
  complain(message);
  return static_cast<int>(code);
}

}  // namespace rainref::cli
