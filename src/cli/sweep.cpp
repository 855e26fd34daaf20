// `rainref sweep plan`, `status`, `gc` and `script`.
#include "cli/sweep.h"

#include <fstream>
#include <map>
#include <system_error>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "base/memory.h"
#include "base/number_text.h"
#include "base/path_text.h"
#include "cli/own_program.h"
#include "cli/progress.h"
#include "cli/terminal.h"
#include "rainref/error.h"
#include "sweep/command_files.h"
#include "sweep/rubbish.h"
#include "sweep/table.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;
constexpr int most_sentences = 10;

/// Time and size of the plan's finished cells, from the logs of their makers.
struct Taken {
  std::int64_t cells = 0;
  double seconds = 0, bytes = 0;
};
Taken taken_by(const OpenPlan& open) {
  std::map<std::string, bool> ours;
  for (const sweep::Cell& cell : open.cells.all()) ours[cell.id] = true;
  Taken taken;
  std::error_code error;
  for (fs::directory_iterator i(open.store.root() / "log", error), end; !error && i != end; i.increment(error)) {
    std::ifstream in(i->path());
    for (std::string line; std::getline(in, line);) {  // columns: id,host,seconds,bytes,begun at
      std::array<std::string, 4> field;
      std::size_t at = 0;
      for (std::string& f : field) {
        const std::size_t comma = std::min(line.find(',', at), line.size());
        f = line.substr(at, comma - at);
        at = std::min(comma + 1, line.size());
      }
      const auto seconds = number_from<double>(field[2]), bytes = number_from<double>(field[3]);
      if (!ours.contains(field[0]) || !seconds || !bytes) continue;
      ++taken.cells;
      taken.seconds += *seconds;
      taken.bytes += *bytes;
    }
  }
  return taken;
}

struct Standing {
  std::map<sweep::State, std::int64_t> counts;
  std::string sentences;
};
Standing standing_of(const OpenPlan& open) {
  Standing s;
  int shown = 0;
  for (const sweep::Cell& cell : open.cells.all()) {
    std::string sentence;
    const sweep::State state = sweep::state_of(cell, open.store, sentence);
    ++s.counts[state];
    if (!sentence.empty() && shown++ < most_sentences)
      s.sentences += fmt::format("{}: {}: {}\n", sweep::name(state), open.cells.words(cell), sentence);
  }
  if (shown > most_sentences) s.sentences += fmt::format("and {} more\n", shown - most_sentences);
  return s;
}
std::string counts_text(const Standing& s) {
  std::string text;
  for (const auto& [state, count] : s.counts) text += fmt::format("{}{} {}", text.empty() ? "" : ", ", count, sweep::name(state));
  return text;
}

}  // namespace

sweep::Planned planning_progress() {
  // Fewer cells take too little time for a progress bar.
  constexpr std::int64_t worth_showing = 5000;
  return [progress = std::shared_ptr<Progress>()](std::int64_t done, std::int64_t all) mutable {
    if (all < worth_showing) return;
    if (!progress) progress = std::make_shared<Progress>("planning", static_cast<int>(all), "cells");
    progress->advance();
    if (done == all) progress.reset();
  };
}

OpenPlan::OpenPlan(const fs::path& file, const fs::path& out)
    : plan(std::make_unique<sweep::Plan>(sweep::read_plan(file))),
      cells(*plan, planning_progress()),
      store(fs::absolute(out).lexically_normal()) {}

int sweep_plan(const SweepOptions& options) {
  const OpenPlan open(options.plan, options.out);
  if (options.is_trial && !open.store.has(open.cells.all().front().id)) {
    const parallel::Executor executor(options.threads);
    const sweep::Maker make = cell_maker(open, executor);
    open.store.make();
    // If there are as many shards as cells, the first shard has the first cell.
    sweep::work(open.cells, open.store, {{0, static_cast<std::int64_t>(open.cells.all().size())}, false}, make,
                [](const sweep::Cell&, sweep::Outcome, const std::string&) {});
  }
  if (options.is_listing) {
    for (std::size_t i = 0; i < open.cells.all().size(); ++i)
      say("{} {} {}\n", i, open.cells.all()[i].id, open.cells.words(open.cells.all()[i]));
  }
  if (const std::string& exec = open.plan->judging.exec; !exec.empty()) {
    std::vector<std::string> files;
    for (const fs::path& file : sweep::files_named_by(exec)) files.push_back(path_text(file));
    say("exec: {}; a verdict of what else it runs stays until label changes, or run --again\n",
        files.empty() ? "names no file whose content would count" : fmt::format("the content of {} counts", fmt::join(files, ", ")));
  }
  const Standing standing = standing_of(open);
  const auto total = static_cast<double>(open.cells.all().size());
  say("{} of {}: {}\n", counted(static_cast<long long>(open.cells.all().size()), "cell"), sweep::name(open.plan->verb),
      counts_text(standing));
  print_text(standing.sentences);
  const auto missing = standing.counts.contains(sweep::State::missing) ? standing.counts.at(sweep::State::missing) : 0;
  if (const Taken taken = taken_by(open); taken.cells > 0) {
    const double count = static_cast<double>(taken.cells);
    say("by the {} made so far: {} in all, {} for what is missing, of one shard\n", taken.cells,
        memory_text(static_cast<std::size_t>(taken.bytes / count * total)),
        duration_text(taken.seconds / count * static_cast<double>(missing)));
  } else {
    say("bytes and time are unknown until a cell is made: --trial makes the first\n");
  }
  return 0;
}

int sweep_status(const SweepOptions& options) {
  const OpenPlan open(options.plan, options.out);
  const Standing standing = standing_of(open);
  say("{}: {}\n", counted(static_cast<long long>(open.cells.all().size()), "cell"), counts_text(standing));
  print_text(standing.sentences);
  return standing.counts.size() == 1 && standing.counts.contains(sweep::State::done) ? 0 : 1;
}

int sweep_gc(const SweepOptions& options) {
  std::vector<std::unique_ptr<sweep::Plan>> plans;
  std::vector<sweep::Cells> cells;
  std::vector<fs::path> files{options.plan};
  files.insert(files.end(), options.others.begin(), options.others.end());
  for (const fs::path& file : files) {
    plans.push_back(std::make_unique<sweep::Plan>(sweep::read_plan(file)));
    cells.emplace_back(*plans.back(), planning_progress());
  }
  std::size_t bytes = 0;
  const std::vector<sweep::Rubbish> found = sweep::rubbish_of(sweep::Store(options.out), cells, options.damaged);
  for (const sweep::Rubbish& r : found) {
    bytes += r.bytes;
    if (!options.removes) {
      say("{}: {}\n", path_text(r.path), r.why);
      continue;
    }
    std::error_code error;
    fs::remove_all(r.path, error);
    if (error) throw Error(ExitCode::io, fmt::format("{}: cannot be removed: {}", path_text(r.path), error.message()));
  }
  say("{}, {}{}\n", counted(static_cast<long long>(found.size()), "thing"), memory_text(bytes),
      options.removes ? ": removed"
      : found.empty() ? ""
                      : "; --remove removes them");
  return 0;
}

int sweep_script(const SweepOptions& options) {
  const OpenPlan open(options.plan, options.out);  // reports an invalid plan before it is submitted
  print_text(sweep::script({options.engine, own_program(), fs::absolute(options.plan).lexically_normal(), open.store.root(), options.shards,
                            options.threads > 0 ? options.threads : 1, options.image}));
  return 0;
}

}  // namespace rainref::cli
