// `rainref run` and `rainref hash`.
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <functional>
#include <optional>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "base/atomic_file.h"
#include "base/machine.h"
#include "base/path_text.h"
#include "cache/kept_images.h"
#include "capture/capture_recorder.h"
#include "capture/hashing.h"
#include "capture/pack_write.h"
#include "cli/checkpoint.h"
#include "cli/commands.h"
#include "cli/json_text.h"
#include "cli/output_folder.h"
#include "cli/progress.h"
#include "cli/differences.h"
#include "cli/scene_file.h"
#include "cli/terminal.h"
#include "image/flipped.h"
#include "image_io/codec.h"
#include "image_io/film.h"
#include "math/simd_target.h"
#include "rainref/error.h"
#include "rainref/version.h"
#include "scene/json.h"
#include "simulation/opened.h"

namespace rainref::cli {
namespace {

/// Captures the passes' buffers in the frames that are written, in a folder of its own.
struct Capture {
  capture::PackWriter writer;
  capture::CaptureRecorder recorder;

  Capture(const capture::EffectInfo& info, const RunOptions& options, const scene::Config& config, const std::filesystem::path& folder,
          const std::function<bool(int)>& written)
      : writer(folder, info, simulation::config_of_passes(config), path_text(options.scene.scene.filename()),
               options.capture == RunOptions::all, info.pass_names(config.variant())),
        recorder(
            info, config.variant(), options.capture == RunOptions::all,
            [written](int frame, std::string_view pass) { return pass != truth::traced_pass && written(frame); },
            [this](const capture::PassCase& c) { writer.add(c); }) {}
};

/// Rejects invalid combinations of options.
void check(const RunOptions& options, int frames) {
  if (options.first >= frames)
    throw Error(ExitCode::usage, fmt::format("--first {}: expected a frame before run.frames {}", options.first, frames));
  if (options.overwrite && options.resume)
    throw Error(ExitCode::usage, "--overwrite: expected no --resume beside it: one begins anew, the other goes on");
  if (options.capture != RunOptions::none && (options.checkpoint_every > 0 || options.resume))
    throw Error(ExitCode::usage,
                "--capture: expected neither --checkpoint-every nor --resume beside it: its folder appears whole, at the end");
  // Without --every the last frame is written.
  const auto has_frame = [&](int every) { return (frames - 1) / every * every >= options.first; };
  const auto refuse = [&](const char* option, int every) {
    throw Error(ExitCode::usage, fmt::format("{}: expected a frame to show, found none from {} to {} that {} divides", option,
                                             options.first, frames - 1, every));
  };
  if (options.film.empty()) {
    if (options.every > 0 && (options.png || options.exr) && !has_frame(options.every)) refuse("--every", options.every);
    return;
  }
  if (options.checkpoint_every > 0 || options.resume)
    throw Error(
        ExitCode::usage,
        "--film: expected neither --checkpoint-every nor --resume beside it: ffmpeg cannot go on with a film; write pictures, or run "
        "a sweep with chunks");
  if (const int every = std::max(options.every, 1); !has_frame(every)) refuse("--film", every);
}
image_io::FilmRate film_rate(const RunOptions& options, const scene::Config& config) {
  return {config.real("run.fps"), std::max(options.every, 1)};
}

nlohmann::ordered_json summary(const scene::Config& config, const std::vector<effect::InputFile>& inputs,
                               const parallel::Executor& executor, const capture::HashRecorder& recorder,
                               const std::vector<capture::HashLine>& last, double seconds, std::optional<double> between, int frames) {
  nlohmann::ordered_json out{{"rainref", version()},
                             {"golden_generation", golden_generation},
                             {"golden_hash", golden_hash()},
                             {"config", scene::config_json(config)},
                             {"origins", scene::origins_json(config)}};
  out["inputs"] = nlohmann::ordered_json::array();
  for (const effect::InputFile& f : inputs) {
    nlohmann::ordered_json input{{"key", f.key}, {"file", f.path}};
    if (f.count > 0) input.update({{"first", f.first}, {"count", f.count}});
    input.update({{f.count > 0 ? "files_hash" : "decoded_hash", f.hash}, {"lossy", f.lossy}});
    if (!f.channel.empty()) input["channel"] = f.channel;
    out["inputs"].push_back(input);
  }
  out["simd"] = selected_simd_target();
  out["threads"] = executor.threads();
  out["frames"] = frames;
  out["seconds"] = seconds;
  if (between) out["ms_per_frame"] = *between;
  for (const auto& t : recorder.times()) {
    out["passes"].push_back({{"name", t.pass}, {"calls", t.calls}, {"ms_per_frame", t.seconds * 1e3 / frames}});
  }
  for (const capture::HashLine& line : last) {
    out["last_frame"].push_back({{"frame", line.frame}, {"pass", line.pass}, {"buffer", line.buffer}, {"xxh3", line.hash.text()}});
  }
  return out;
}

}  // namespace

int run(const RunOptions& options) {
  const scene::Config config = load_scene(options.scene);
  const parallel::Executor executor(options.scene.threads);
  const std::filesystem::path folder =
      options.output.empty() ? std::filesystem::path("out") / utf8_path(config.effect()) / options.scene.scene.stem() : options.output;
  const int frames = static_cast<int>(config.integer("run.frames"));
  check(options, frames);
  if (!options.film.empty()) image_io::require_film(options.film, film_rate(options, config));
  OutputFolder made(folder);
  const Checkpoint checkpoint(folder, options);
  const std::optional<std::uintmax_t> left = options.resume ? checkpoint.bytes() : std::nullopt;
  const auto written = [&](std::int64_t frame) {
    return frame >= options.first && frame < frames && (options.every > 0 ? frame % options.every == 0 : frame == frames - 1);
  };
  made.require_one_run(options, checkpoint, left.has_value(), [&](const RunPicture& p) {
    const bool is_wanted = p.kind == RunPicture::Kind::png   ? options.png
                           : p.kind == RunPicture::Kind::exr ? options.exr
                                                             : options.compare_truth;
    return is_wanted && p.effect == config.effect() && written(p.frame);
  });

  effect::RunMemory memory = simulation::memory_of(config);
  add_pictures(memory, options.png || !options.film.empty(), options.exr);
  if (options.capture != RunOptions::none) add_captures(memory);
  if (left) memory.peak.pass(*left);
  require_memory(memory);
  // The least memory of the program and its stacks that every run will still touch.
  constexpr std::size_t own_pages = 1u << 20;
  const std::size_t stated = memory.peak.peak() + resident_memory() + own_pages + (options.exr ? image_io::codec_bytes() : 0);
  // A broken installation should not waste a run either. In parallel with the scene, because loading the codec's libraries takes 0.25 s.
  const std::function<void()> codec = options.exr ? image_io::codec_ahead() : [] {};
  if (options.keep_images) cache::keep_in(cache::folder_of_user());
  simulation::Opened opened = open_scene(config, executor);
  codec();
  if (options.compare_truth && !opened.has_truth()) {
    throw Error(ExitCode::usage, fmt::format("--compare-truth: {} {} has no traced truth to be compared with here; the corrected puddle "
                                             "and screen_drops have one, and with the street windshield and corrected panes of rainy_glass",
                                             config.effect(), config.variant()));
  }
  const auto filmed = [&](int frame) { return !options.film.empty() && frame >= options.first && frame % std::max(options.every, 1) == 0; };
  std::optional<image_io::Film> film;
  if (!options.film.empty()) {
    const scene::Integer2& size = config.integer2("run.size");
    film.emplace(options.film, static_cast<int>(size[0]), static_cast<int>(size[1]), film_rate(options, config));
  }
  capture::HashRecorder recorder;
  std::optional<Capture> capture;
  if (options.capture != RunOptions::none) capture.emplace(*opened.effect().info, options, config, folder / "capture", written);
  capture::RecorderList recorders(capture ? std::vector<Recorder*>{&recorder, &capture->recorder} : std::vector<Recorder*>{&recorder});
  std::vector<capture::HashLine> last;
  int pictures = 0;
  nlohmann::ordered_json truth = nlohmann::ordered_json::array();
  RunSoFar before;
  if (left) {
    before = checkpoint.resume(opened, truth);
    if (opened.frame() >= frames)
      throw Error(ExitCode::usage,
                  fmt::format("run.frames {}: expected more than the {} frames that the interrupted run came to", frames, opened.frame()));
    recorder.begin_with(before.times);
  }
  const int begin = opened.frame();
  const auto start = std::chrono::steady_clock::now();
  const auto seconds_so_far = [&] {
    return before.seconds + std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  };
  double first_ended = 0, last_began = 0;
  const auto forget_older_run = [&] { made.forget_older_run(checkpoint, left.has_value()); };
  {
    Progress progress(config.effect(), frames - begin);
    for (int frame = begin; frame < frames; ++frame) {
      last_began = seconds_so_far();
      recorder.set_hashing(frame == frames - 1);  // `rainref hash` needs all frames
      opened.show(written(frame) || filmed(frame) || frame == frames - 1);
      opened.simulate(&recorders);
      if (frame < options.first)
        opened.skip(&recorders);
      else
        opened.render(&recorders);
      last = recorder.take_lines();
      if (written(frame)) {
        if (options.png || options.exr || options.compare_truth) forget_older_run();
        const std::string stem = fmt::format("{}.{:04}", config.effect(), frame);
        if (options.png) opened.write_png(folder / utf8_path(stem + ".png"));
        if (options.exr) opened.write_exr(folder / utf8_path(stem + ".exr"), true);
        pictures += options.png + options.exr;
        if (options.compare_truth) {
          nlohmann::ordered_json of_frame{{"frame", frame}};
          of_frame.update(write_comparison(folder / utf8_path(stem + ".truth"), opened.compare_truth()));
          truth.push_back(of_frame);
        }
      }
      if (filmed(frame)) film->add(flipped(opened.picture()));
      const int done = frame + 1;
      if (options.checkpoint_every > 0 && done % options.checkpoint_every == 0 && done < frames) {
        forget_older_run();
        checkpoint.write(opened, {seconds_so_far(), recorder.times()}, truth);
      }
      if (frame == begin) first_ended = seconds_so_far();
      progress.advance();
    }
  }
  const double seconds = seconds_so_far();
  // The first frame also touches its memory for the first time; the last one is also hashed and developed.
  std::optional<double> between;
  if (const int count = frames - begin - 2; count > 0) between = 1e3 * (last_began - first_ended) / count;
  nlohmann::ordered_json report = summary(config, opened.inputs().files, executor, recorder, last, seconds, between, frames);
  report["memory"] = {{"stated", stated}, {"taken", machine::most_memory()}};
  if (options.compare_truth) report["truth"] = truth;
  if (film) film->finish();
  forget_older_run();
  if (capture) capture->writer.finish();
  write_file(made.summary(), json_text(report) + "\n");
  checkpoint.remove();
  made.keep();
  if (options.json)
    say("{}\n", json_text(report));
  else
    say("{} in {}{}, {}{} and summary.json in {}{}\n", counted(frames, "frame"), duration_text(seconds),
        left ? fmt::format(", the first {} of them before", begin) : "", counted(pictures, "picture"), capture ? ", capture/" : "",
        path_text(folder),
        film ? fmt::format(", film of {} at {:g} a second: {}", counted(film->pictures(), "picture"),
                           film_rate(options, config).per_second(), path_text(options.film))
             : "");
  return 0;
}

int hash(const SceneOptions& options) {
  const scene::Config config = load_scene(options);
  const parallel::Executor executor(options.threads);
  simulation::Opened opened = open_scene(config, executor);
  const int frames = static_cast<int>(config.integer("run.frames"));
  capture::HashRecorder recorder;
  Progress progress(config.effect(), frames);
  for (int frame = 0; frame < frames; ++frame) {
    opened.next_frame(&recorder);
    for (const capture::HashLine& line : recorder.take_lines()) say("{}\n", line.text());
    progress.advance();
  }
  say("scene {}\n", recorder.scene_hash().text());
  return 0;
}

}  // namespace rainref::cli
