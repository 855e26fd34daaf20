// The verbs that judge: ports, and packs.
#include <filesystem>
#include <memory>
#include <optional>
#include <system_error>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/path_text.h"
#include "cli/commands.h"
#include "cli/option_values.h"
#include "cli/scene_flags.h"
#include "cli/verbs.h"
#include "judge/profiles.h"
#include "rainref/error.h"
#include "rainref/executor.h"

namespace rainref::cli {
namespace {

void add_profile(CLI::App& verb, std::string& profile) {
  verb.add_option("--profile", profile, "What the port's API allows (default: vulkan)")
      ->type_name(fmt::format("{}", fmt::join(judge::profile_names(), "|")));
}
void add_threads(CLI::App& verb, std::optional<std::string>& threads) {
  verb.add_option("--threads", threads, "Threads; the result does not depend on them")->type_name("N");
}
/// Adds the option for passes, "a,b" or repeated.
void add_only(CLI::App& verb, std::vector<std::string>& only, const char* sentence) {
  verb.add_option_function<std::vector<std::string>>(
          "--only",
          [&only](const std::vector<std::string>& lists) {
            for (const std::string& list : lists)
              for (std::string& pass : list_of(list)) only.push_back(std::move(pass));
          },
          sentence)
      ->type_name("PASS,...")
      ->allow_extra_args(false);
}
int threads_of(const std::optional<std::string>& text) {
  return text ? whole_number(*text, "--threads", 1, parallel::Executor::max_threads) : 0;
}

struct ValidateFlags {
  ValidateRequest request;
  std::string pack, port;
  SceneFlags scene;  // for --shadow
  std::optional<std::string> shadow, exec, timeout, repeat, threads, causes_within, spirv;
};

void add_validate_options(CLI::App& verb, ValidateFlags& f) {
  verb.add_option("PACK", f.pack, "Folder of the pack; with --shadow the scene that the port ran")->type_name("DIR");
  verb.add_option("--port", f.port, "Folder with the port's outputs, laid out as the pack")->type_name("DIR");
  verb.add_option("--exec", f.exec,
                  "Run the port first: a shell command with {pack} and {out} (or $RAINREF_PACK and $RAINREF_OUT), which becomes a new "
                  "folder or that of --port")
      ->type_name("COMMAND");
  verb.add_option("--timeout", f.timeout, "Seconds that the command may take (default: 600)")->type_name("SECONDS");
  verb.add_option("--repeat", f.repeat, "Run the command so often and look for races")->type_name("N");
  verb.add_option("--shadow", f.shadow, "Judge the dumps of a port's own run, inputs and outputs of each pass, one step at a time")
      ->type_name("DIR");
  verb.add_option("--size", f.scene.size, "With --shadow and a scene: its picture size, WxH")->type_name("WxH");
  add_preset_flag(verb, f.scene.presets, "With --shadow and a scene: ");
  verb.add_option("--set", f.scene.set, "With --shadow and a scene: override one of its values, key=value")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  verb.add_option("--spirv", f.spirv,
                  "Folder with the port's shaders and bindings.json: whether the shader is wrong or what ran it (examples/ports/README.md)")
      ->type_name("DIR");
  add_profile(verb, f.request.profile);
  add_only(verb, f.request.only, "Judge these passes alone");
  verb.add_option(
          "--fused", f.request.fused,
          "Passes that one shader of the port computes, such as ground_noise+shade: the last is judged from what the others may give")
      ->type_name("PASS+PASS")
      ->allow_extra_args(false);
  verb.add_flag("--partial", f.request.partial, "A port in progress: passes that it has no files of are NOT JUDGED, and not missing");
  verb.add_flag("--no-causes", f.request.no_causes, "Do not look for what went wrong, which may take longer than judging");
  verb.add_option("--causes-within", f.causes_within,
                  "Seconds of that for each failing pass; then the best so far is named (default: no limit)")
      ->type_name("SECONDS");
  verb.add_flag("--allow-untested", f.request.allow_untested, "Forgive UNTESTED and NOT JUDGED, beside at least one PASS");
  verb.add_flag("--strict", f.request.strict, "Each WARN fails");
  verb.add_flag("--exhaustive", f.request.exhaustive,
                "Compute every envelope: widths and shares of a large picture are otherwise those of a sample");
  verb.add_flag("--foreign-host", f.request.foreign_host,
                "With --shadow: uniforms, inputs and a first state that are not the scene's are notes, not failures");
  verb.add_flag("--verbose", f.request.verbose, "All that is known of each pass, and what of its text no run takes");
  add_threads(verb, f.threads);
  add_report_options(verb, f.request.reports);
  for (CLI::Option* option : verb.get_options([](const CLI::Option* o) { return o->get_type_name() == "TEXT"; })) option->type_name("FILE");
  verb.footer(
      "Examples: rainref validate out/pack --port out/port --profile vulkan\n          rainref validate out/pack --exec './port {pack} "
      "{out}' --repeat 3\n          rainref validate out/pack --port out/port --only wave_step,shade\n          rainref validate out/pack "
      "--port out/port --partial --allow-untested\n          rainref validate --shadow out/dump scenes/puddle/default.toml");
}

bool changes_scene(const ValidateFlags& f) { return f.scene.size || !f.scene.set.empty() || !f.scene.presets.empty(); }

/// A port's own run: PACK is the scene that it ran, or empty.
void ask_for_shadow(const ValidateFlags& f, ValidateRequest& request) {
  require_text(*f.shadow, "--shadow", "a folder");
  if (f.exec || f.spirv || !f.request.fused.empty() || !f.port.empty())
    throw Error(ExitCode::usage, fmt::format("{}: does not go with --shadow", f.exec                     ? "--exec"
                                                                              : f.spirv                  ? "--spirv"
                                                                              : !f.request.fused.empty() ? "--fused"
                                                                                                         : "--port"));
  if (f.pack.empty() && changes_scene(f)) throw Error(ExitCode::usage, "--set, --preset and --size: expected the scene that they change");
  if (std::error_code ignored; std::filesystem::is_directory(utf8_path(f.pack), ignored)) {
    throw Error(ExitCode::usage, fmt::format("--shadow: expected the scene that the port ran, found the folder '{}'; a manifest.json "
                                             "beside the dumps would serve as well",
                                             f.pack));
  }
  request.shadow = utf8_path(*f.shadow);
  SceneFlags scene = f.scene;
  scene.scene = f.pack;
  request.scene = resolve(scene);
}

/// Judging a pack requires the pack and the port's outputs.
void require_pack_and_port(const ValidateFlags& f) {
  if (f.pack.empty()) throw Error(ExitCode::usage, "validate: expected the folder of a PACK, or --shadow DIR");
  if (changes_scene(f)) throw Error(ExitCode::usage, "--set, --preset and --size: go with --shadow and a scene only");
  if (f.request.foreign_host) throw Error(ExitCode::usage, "--foreign-host: goes with --shadow only");
  if (!f.exec && f.port.empty()) throw Error(ExitCode::usage, "validate: expected --port DIR, or --exec COMMAND, which runs the port");
}

/// The port's own command, its time limit and number of runs.
void ask_for_command(const ValidateFlags& f, ValidateRequest& request) {
  if (!f.exec && (f.timeout || f.repeat))
    throw Error(ExitCode::usage, fmt::format("{}: goes with --exec only", f.timeout ? "--timeout" : "--repeat"));
  if (!f.exec) return;
  request.exec = *f.exec;
  require_text(request.exec, "--exec", "a command");
  const bool has_out = f.exec->find("{out}") != std::string::npos || f.exec->find("RAINREF_OUT") != std::string::npos;
  if (!has_out && f.port.empty()) {
    throw Error(
        ExitCode::usage,
        "--exec: expected {out} or $RAINREF_OUT in the command, where the port's outputs go; or --port, the folder that it writes to");
  }
  if (f.timeout) request.timeout_s = whole_number(*f.timeout, "--timeout", 1, 1000000);
  if (f.repeat) request.repeat = whole_number(*f.repeat, "--repeat", 1, 1000);
  if (request.repeat > 1 && !has_out)
    throw Error(ExitCode::usage, "--repeat: expected {out} or $RAINREF_OUT in the command: each run has a folder of its own");
}

}  // namespace

Verb validate_verb(CLI::App& app, const std::string& command) {
  CLI::App& verb = *app.add_subcommand("validate", "Judge a GPU port's outputs against a pack");
  const auto f = std::make_shared<ValidateFlags>();
  add_validate_options(verb, *f);
  return {&verb, [f, command] {
            ValidateRequest request = f->request;
            if (f->shadow)
              ask_for_shadow(*f, request);
            else
              require_pack_and_port(*f);
            ask_for_command(*f, request);
            if (f->causes_within && request.no_causes)
              throw Error(ExitCode::usage, "--causes-within: expected no --no-causes beside it, which looks for none");
            if (f->causes_within) request.causes_within = whole_number(*f->causes_within, "--causes-within", 1, 1000000);
            if (f->spirv) {
              require_text(*f->spirv, "--spirv", "a folder");
              request.spirv = utf8_path(*f->spirv);
            }
            request.pack = utf8_path(f->pack);
            request.port = utf8_path(f->port);
            request.threads = threads_of(f->threads);
            request.command = command;
            return validate(request);
          }};
}

Verb import_verb(CLI::App& app) {
  struct Flags {
    std::string file, as, pack, output;
    std::optional<std::string> origin, order, pitch;
  };
  CLI::App& verb = *app.add_subcommand("import", "Take a file of a debugger or an engine into a port's dump");
  const auto f = std::make_shared<Flags>();
  verb.add_option("FILE", f->file, "DDS, EXR, PNG, NPY or raw bytes of one image")->type_name("FILE")->required();
  verb.add_option("--as", f->as, "What it holds: a case and an output of the pack, such as puddle.display/0012.0/out.picture")
      ->type_name("CASE/out.BUFFER")
      ->required();
  verb.add_option("--pack", f->pack, "Folder of the pack, whose expected values tell what the file does not say")
      ->type_name("DIR")
      ->required();
  verb.add_option("-o,--output", f->output, "The port's folder")->type_name("DIR")->required();
  verb.add_option("--origin", f->origin, "The first stored row: v = 0 is top-left (default: as the values tell)")
      ->type_name("top-left|bottom-left");
  verb.add_option("--row-pitch", f->pitch, "Raw bytes: bytes from row to row")->type_name("N");
  verb.add_option("--channel-order", f->order, "Raw bytes of four channels")->type_name("rgba|bgra");
  verb.footer("Example: rainref import picture.dds --as puddle.display/0012.0/out.picture --pack out/pack -o out/port");
  return {&verb, [f] {
            ImportRequest request{utf8_path(f->file), utf8_path(f->pack), utf8_path(f->output), f->as, {}};
            if (f->origin) {
              require_word(*f->origin, "--origin", "top-left or bottom-left", {"top-left", "bottom-left"});
              request.hints.origin = *f->origin == "top-left" ? port_dump::Origin::top_left : port_dump::Origin::bottom_left;
            }
            if (f->order) {
              require_word(*f->order, "--channel-order", "rgba or bgra", {"rgba", "bgra"});
              request.hints.is_bgra = *f->order == "bgra";
            }
            if (f->pitch) request.hints.row_pitch = static_cast<std::size_t>(whole_number(*f->pitch, "--row-pitch", 1, 1 << 24));
            return import_file(request);
          }};
}

Verb mutate_verb(CLI::App& app) {
  struct Flags {
    MutateRequest request;
    std::string pack;
    std::optional<std::string> threads;
  };
  CLI::App& verb = *app.add_subcommand("mutate", "Which porting bugs a pack would catch");
  const auto f = std::make_shared<Flags>();
  verb.add_option("PACK", f->pack, "Folder of the pack")->type_name("DIR")->required();
  add_profile(verb, f->request.profile);
  add_only(verb, f->request.only, "Of these passes alone");
  verb.add_flag("--all", f->request.all, "List every fault, not only those missed");
  add_threads(verb, f->threads);
  verb.footer("Example: rainref mutate out/pack --profile vulkan");
  return {&verb, [f] {
            MutateRequest request = f->request;
            request.pack = utf8_path(f->pack);
            request.threads = threads_of(f->threads);
            return mutate(request);
          }};
}

}  // namespace rainref::cli
