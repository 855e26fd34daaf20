// `rainref pack`.
#include <optional>
#include <string>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/memory.h"
#include "base/path_text.h"
#include "capture/flat_pack.h"
#include "capture/pack_read.h"
#include "cli/commands.h"
#include "cli/progress.h"
#include "cli/scene_file.h"
#include "cli/terminal.h"
#include "judging/foreign_pack.h"
#include "judging/make_pack.h"
#include "simulation/opened.h"
#include "simulation/picture_notes.h"

namespace rainref::cli {

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
  const parallel::Executor executor(options.scene.threads);
  std::optional<Progress> progress;
  const judging::PackEvents events{[](const effect::Inputs& inputs) { complain_of(inputs); },
                                   [](const std::string& line) { say("{}\n", line); },
                                   [&](int done, int of) {
                                     if (!progress) progress.emplace(config.effect(), of);
                                     progress->advance();
                                     if (done == of) progress.reset();
                                   }};
  const judging::WrittenPack made =
      judging::make_pack({config, simulation::scene_text(options.scene.scene), options.scene.scene, options.output, options.frames,
                          options.may_add_frames, options.passes, options.has_random_seed, options.shows_coverage},
                         executor, events);
  if (options.has_random_seed) say("seed {0}: --seed {0} makes this pack again\n", config.integer("seed"));
  say("{} of {} in {}, {}, in {}\n", counted(made.total.cases, "case"), fmt::join(made.passes, " "), counted(made.total.files, "file"),
      memory_text(made.total.bytes), path_text(options.output));
  return 0;
}

}  // namespace rainref::cli
