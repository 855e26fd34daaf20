// Films of a simulation. A file of its own, so that programs without films do not link what starts ffmpeg.
#include <fmt/format.h>

#include "base/floating_point.h"
#include "image/flipped.h"
#include "image_io/film.h"
#include "rainref/error.h"
#include "simulation/simulation_state.h"

namespace rainref {

void Simulation::film(const std::filesystem::path& path, const FilmOptions& options) {
  const FloatingPointGuard guard;
  simulation::Opened& opened = state_->opened;
  const scene::Config& config = opened.config();
  const int first = opened.frame(), count = options.frames != 0 ? options.frames : static_cast<int>(config.integer("run.frames")) - first;
  const auto refuse = [](const char* what, const char* expected, int found) {
    throw Error(ExitCode::usage, fmt::format("film: {}: expected {}, found {}", what, expected, found));
  };
  if (options.every < 1) refuse("every", "1 or more", options.every);
  if (count < 1) refuse("frames", options.frames != 0 ? "0 or more" : "some that remain of run.frames", count);
  if (const int last = first + count - 1; last / options.every * options.every < first)
    throw Error(ExitCode::usage,
                fmt::format("film: expected a frame to show, found none from {} to {} that {} divides", first, last, options.every));

  const scene::Integer2 size = config.integer2("run.size");
  image_io::Film film(path, static_cast<int>(size[0]), static_cast<int>(size[1]), {config.real("run.fps"), options.every});
  for (int done = 1; done <= count; ++done) {
    const bool is_shown = opened.frame() % options.every == 0;
    opened.simulate(nullptr);
    if (is_shown || done == count)
      opened.render(nullptr);
    else
      opened.skip(nullptr);
    if (is_shown) film.add(flipped(opened.picture()));
    if (options.progress) options.progress(done, count);
  }
  film.finish();
}

}  // namespace rainref
