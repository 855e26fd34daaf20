#include "cli/verbs.h"

#include <algorithm>
#include <memory>
#include <optional>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/path_text.h"
#include "cli/commands.h"
#include "cli/option_values.h"
#include "cli/scene_flags.h"
#include "judging/make_pack.h"
#include "rainref/error.h"
#include "rainref/executor.h"
#include "registry/registry.h"

// The parser's targets must live as long as the functions that run the verbs.
namespace rainref::cli {
namespace {

/// "puddle|windshield|...": shells complete words between bars.
std::string effect_words() {
  std::vector<std::string> names;
  for (const effect::Effect* e : registry::effects()) names.push_back(e->name);
  return fmt::format("{}", fmt::join(names, "|"));
}

/// Exactly one must be given: the subject of the verb, or shaders.
void require_either(const std::string& subject, const char* name, const std::string& spirv) {
  if (subject.empty() == spirv.empty())
    throw Error(ExitCode::usage, fmt::format("expected either {} or --spirv, found {}", name, subject.empty() ? "neither" : "both"));
}

}  // namespace

Verb list_verb(CLI::App& app) {
  struct Flags {
    std::string effect;
    bool json = false;
  };
  CLI::App& verb = *app.add_subcommand("list", "Effects, variants, passes, scenes, presets and SIMD targets");
  const auto f = std::make_shared<Flags>();
  verb.add_option("EFFECT", f->effect, "Only what is of this effect")->type_name(effect_words());
  verb.add_flag("--json", f->json, "As JSON");
  verb.footer("Example: rainref list puddle");
  return {&verb, [f] { return list(f->effect, f->json); }};
}

Verb describe_verb(CLI::App& app) {
  struct Flags {
    std::string effect, group;
    bool json = false;
    LayoutRequest layout;
    std::vector<std::string> presets, spirv;
  };
  CLI::App& verb = *app.add_subcommand("describe", "Keys, passes and buffers of an effect, or what a scene sets; GPU layouts");
  const auto f = std::make_shared<Flags>();
  verb.add_option("EFFECT", f->effect, "Effect, or a scene: a file, or a name of `rainref list`")->type_name(effect_words());
  verb.add_option("GROUP", f->group, "Only the keys of the effect that begin so, such as rain or rain.rate")->type_name("NAME");
  verb.add_flag("--json", f->json, "As JSON");
  add_preset_flag(verb, f->presets, "With a scene: ");
  verb.add_option("--layout", f->layout.language, "Uniform blocks, records, images and lists ready to paste")
      ->type_name("c|glsl|hlsl|wgsl|cuda|glsl330|gdshader");
  verb.add_option("--pass", f->layout.pass, "With --layout: what this pass needs alone")->type_name("NAME");
  verb.add_option("--variant", f->layout.variant, "With --layout: in this variant alone")->type_name("as-published|corrected");
  verb.add_option("--spirv", f->spirv, "Instead of an effect: the first draft of a description of these shaders, for `pack --spirv`")
      ->type_name("FILE...");
  verb.footer(
      "Example: rainref describe windshield condensation\n"
      "What a scene sets: rainref describe puddle/default --preset storm\n"
      "For a shader: rainref describe puddle --layout glsl --pass wave_step --variant corrected\n"
      "An effect of your own: rainref describe --spirv fog.spv shade.spv > effect.json");
  return {&verb, [f] {
            require_either(f->effect, "EFFECT", f->spirv.empty() ? "" : f->spirv.front());
            if (f->spirv.empty()) return describe(f->effect, f->group, f->json, f->layout, preset_override(f->presets));
            if (!f->group.empty() || !f->presets.empty() || f->json || f->layout.language || f->layout.pass || f->layout.variant)
              throw Error(ExitCode::usage, "--spirv: expected no other option beside it");
            std::vector<std::filesystem::path> shaders;
            for (const std::string& shader : f->spirv) shaders.push_back(utf8_path(shader));
            return describe_shaders(shaders);
          }};
}

Verb run_verb(CLI::App& app) {
  struct Flags {
    SceneFlags scene;
    RunOptions options;
    std::string image = "png";
    std::optional<std::string> output, film, first, every, captured, checkpoint_every;
  };
  CLI::App& verb = *app.add_subcommand("run", "Simulate and render a scene");
  const auto f = std::make_shared<Flags>();
  add_scene_flags(verb, f->scene);
  verb.add_option("-o,--output", f->output, "Folder for pictures and summary.json (default: out/<effect>/<scene>)")->type_name("DIR");
  verb.add_option("--image", f->image, "Pictures to write")->type_name("exr|png|both|none");
  verb.add_option("--film", f->film,
                  "Film of all frames from --first on, of every K-th with --every K, at the scene's speed (run.fps / K pictures a second), "
                  "made by ffmpeg: .mp4, .webm or .gif; its folder counts from here, not from DIR")
      ->type_name("FILE");
  verb.add_option("--every", f->every, "Write every K-th frame (default: the last frame only)")->type_name("K");
  verb.add_option("--first", f->first, "First frame of interest: those before it are simulated, and not rendered")->type_name("A");
  verb.add_option("--checkpoint-every", f->checkpoint_every,
                  "Keep the state in DIR/checkpoint.state, anew after every K-th frame, until the run is whole")
      ->type_name("K");
  verb.add_flag("--resume", f->options.resume,
                "Go on from DIR/checkpoint.state, where a killed run left one; from the beginning otherwise. Pictures are the same");
  verb.add_flag("--overwrite", f->options.overwrite,
                "Remove what an earlier run left in DIR. Without it DIR may hold no results of one that this run does not write anew");
  verb.add_option("--capture", f->captured, "Write the passes' buffers of these frames to capture/: passes (outputs), all (inputs too)")
      ->type_name("passes|all");
  verb.add_flag("--compare-truth", f->options.compare_truth,
                "Compare the passes of these frames with the traced truth: pictures of the differences, percentiles in summary.json");
  verb.add_flag("!--no-cache", f->options.keep_images,
                "Neither read nor keep the made street and other pictures that a scene begins with ($XDG_CACHE_HOME/rainref)");
  verb.add_flag("--json", f->options.json, "Print the summary as JSON");
  verb.footer(
      "Example: rainref run scenes/puddle/default.toml --frames 120 --set rain.rate=40 -o out/heavy\n"
      "Weather: rainref run puddle/default --preset storm,night\n"
      "A film:  rainref run scenes/rainy_glass/default.toml --size 960x540 --frames 600 --film rain.mp4\n"
      "What made a picture, again: rainref run out/heavy/puddle.0119.png\n"
      "Pictures of a long film, the same command until it ends:\n"
      "         rainref run scenes/windshield/drive.toml --frames 9000 --every 1 -o out/film --checkpoint-every 300 --resume");
  return {&verb, [f] {
            require_word(f->image, "--image", "exr, png, both or none", {"exr", "png", "both", "none"});
            RunOptions options = f->options;
            options.png = f->image == "png" || f->image == "both";
            options.exr = f->image == "exr" || f->image == "both";
            if (f->output) require_text(*f->output, "--output", "a folder");
            options.output = utf8_path(f->output.value_or(""));
            if (f->film) require_text(*f->film, "--film", "a file");
            options.film = utf8_path(f->film.value_or(""));
            if (f->every) options.every = whole_number(*f->every, "--every", 1, 1000000);
            if (f->first) options.first = whole_number(*f->first, "--first", 0, 999999);
            if (f->checkpoint_every) options.checkpoint_every = whole_number(*f->checkpoint_every, "--checkpoint-every", 1, 1000000);
            if (f->captured) {
              require_word(*f->captured, "--capture", "passes or all", {"passes", "all"});
              options.capture = *f->captured == "all" ? RunOptions::all : RunOptions::passes;
            }
            options.scene = resolve(f->scene);
            return run(options);
          }};
}

Verb hash_verb(CLI::App& app) {
  CLI::App& verb = *app.add_subcommand("hash", "Hash every buffer that every pass writes");
  const auto scene = std::make_shared<SceneFlags>();
  add_scene_flags(verb, *scene);
  verb.footer(
      "A line names frame, pass and buffer. Its hash is of all that the pass wrote there in that frame, in each of its steps.\n"
      "Example: rainref hash scenes/puddle/default.toml --frames 60 --threads 2 --simd avx2");
  return {&verb, [scene] { return hash(resolve(*scene)); }};
}

Verb pack_verb(CLI::App& app) {
  struct Flags {
    SceneFlags scene;
    std::string output;
    std::optional<std::string> at, passes, seed;
    bool shows_coverage = false;
    std::string spirv, inputs, flat;
  };
  CLI::App& verb = *app.add_subcommand("pack", "Write a conformance pack: inputs, uniforms and expected outputs of every pass");
  const auto f = std::make_shared<Flags>();
  add_scene_flags(verb, f->scene, false);
  verb.get_option("SCENE")->required(false);
  verb.add_option(
          "--spirv", f->spirv,
          "Instead of a scene: the description of an effect of your own, whose trusted shaders are the reference (see `describe --spirv`)")
      ->type_name("FILE");
  verb.add_option("--inputs", f->inputs, "With --spirv: inputs and uniforms of your own run")->type_name("DIR");
  verb.add_option(
          "--flat", f->flat,
          "Instead of a scene: a pack, whose inputs and uniforms are written once more as raw bytes with one flat.json, for engines "
          "that read no NPY")
      ->type_name("PACK");
  verb.add_option("-o,--output", f->output, "Folder of the pack; an older pack there is replaced")->type_name("DIR")->required();
  verb.add_option("--at", f->at, "Frames to take (default: 0,1,12, and one more for a pass that does nothing in these)")->type_name("LIST");
  verb.add_option("--passes", f->passes, "Passes to take, such as wave_step,shade (default: all)")->type_name("LIST");
  verb.add_option("--seed", f->seed,
                  "Seed of the scene's random numbers; random: one that nobody can know before, printed and kept in the manifest, so that "
                  "a port cannot know the expected outputs")
      ->type_name("N|random");
  verb.add_flag("--coverage", f->shows_coverage, "List what of each pass's text no case takes; the manifest has it too");
  verb.footer(
      "Example: rainref pack scenes/puddle/default.toml --size 320x180 --at 0,1,12 -o out/pack\n"
      "For a last judgement, new rain: rainref pack puddle/default.toml --size 320x180 --seed random -o out/fresh\n"
      "An effect of your own: rainref pack --spirv effect.json --inputs my_run -o out/pack\n"
      "For an engine without NPY: rainref pack --flat out/pack -o out/flat");
  return {&verb, [f] {
            require_text(f->output, "--output", "a folder");
            const int sources = !f->scene.scene.empty() + !f->spirv.empty() + !f->flat.empty();
            if (sources != 1)
              throw Error(ExitCode::usage,
                          fmt::format("expected one of SCENE, --spirv and --flat, found {}", sources == 0 ? "none" : "several"));
            if (f->scene.scene.empty()) {
              if (f->at || f->passes || f->seed || f->shows_coverage || f->scene.size || f->scene.simd || !f->scene.set.empty() ||
                  !f->scene.presets.empty())
                throw Error(
                    ExitCode::usage,
                    fmt::format("{}: expected none of --at, --passes, --seed, --coverage, --size, --simd, --preset and --set beside it",
                                f->flat.empty() ? "--spirv" : "--flat"));
            }
            if (!f->flat.empty()) {
              if (!f->inputs.empty()) throw Error(ExitCode::usage, "--inputs: only beside --spirv");
              return flat_pack(utf8_path(f->flat), utf8_path(f->output));
            }
            if (!f->spirv.empty()) {
              require_text(f->inputs, "--inputs", "the folder of a run");
              ForeignPackOptions own{utf8_path(f->spirv), utf8_path(f->inputs), utf8_path(f->output)};
              if (f->scene.threads) own.threads = whole_number(*f->scene.threads, "--threads", 1, parallel::Executor::max_threads);
              return pack(own);
            }
            if (!f->inputs.empty()) throw Error(ExitCode::usage, "--inputs: only beside --spirv");
            PackOptions options;
            options.output = utf8_path(f->output);
            for (const std::string& frame : list_of(f->at.value_or("0,1,12")))
              options.frames.push_back(whole_number(frame, "--at", 0, 1000000));
            options.may_add_frames = !f->at;
            options.shows_coverage = f->shows_coverage;
            std::sort(options.frames.begin(), options.frames.end());
            if (f->passes) options.passes = list_of(*f->passes);
            options.scene = resolve(f->scene);
            if (f->seed) {
              options.scene.overrides.push_back(fmt::format("seed={}", judging::seed_of(*f->seed, "--seed")));
              options.has_random_seed = *f->seed == "random";
            }
            return pack(options);
          }};
}

Verb diff_verb(CLI::App& app) {
  struct Flags {
    std::string a, b;
  };
  CLI::App& verb = *app.add_subcommand("diff", "The first difference between two captures or packs");
  const auto f = std::make_shared<Flags>();
  verb.add_option("A", f->a, "Folder of a capture or pack")->type_name("DIR")->required();
  verb.add_option("B", f->b, "Folder of another")->type_name("DIR")->required();
  verb.footer("Example: rainref diff out/a/capture out/b/capture");
  return {&verb, [f] { return diff(utf8_path(f->a), utf8_path(f->b)); }};
}

Verb selftest_verb(CLI::App& app) {
  CLI::App& verb = *app.add_subcommand("selftest", "Prove determinism on this machine, in seconds");
  verb.footer("Example: rainref selftest");
  return {&verb, [] { return selftest(); }};
}

Verb demo_verb(CLI::App& app) {
  CLI::App& verb = *app.add_subcommand("demo", "A first verdict: judge a port with one mistake, then the right one; no GPU needed");
  const auto output = std::make_shared<std::string>("rainref-demo");
  verb.add_option("-o,--output", *output, "Folder for the pack, both ports and the report (default: rainref-demo)")->type_name("DIR");
  verb.footer("Example: rainref demo");
  return {&verb, [output] {
            require_text(*output, "--output", "a folder");
            return demo(utf8_path(*output));
          }};
}

}  // namespace rainref::cli
