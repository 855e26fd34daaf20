// `rainref sweep run`.
#include <chrono>
#include <cstdlib>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "base/path_text.h"
#include "base/signals.h"
#include "cache/kept_images.h"
#include "cache/prepared.h"
#include "cli/own_program.h"
#include "cli/progress.h"
#include "cli/sweep.h"
#include "cli/terminal.h"
#include "image_io/codec.h"
#include "rainref/error.h"

namespace rainref::cli {
namespace {

namespace fs = std::filesystem;

/// Set in a process that makes cells, but not in the one that waits for it.
constexpr const char* worker = "RAINREF_SWEEP_WORKER";
/// Cache size of a process that makes cells.
constexpr std::size_t remembered_bytes = std::size_t{1} << 30;

int work(const SweepOptions& options) {
  const sweep::Shard shard = sweep::shard_from(options.shard, sweep::environment());
  const OpenPlan open(options.plan, options.out);
  const parallel::Executor executor(options.threads);
  cache::keep_in(cache::folder_of_user());
  cache::remember(remembered_bytes);
  image_io::codec();  // once, before the first cell
  std::int64_t cells = 0;
  const auto all = static_cast<std::int64_t>(open.cells.all().size());
  for (std::int64_t i = 0; i < all; ++i) cells += shard.takes(i, all);
  const auto start = std::chrono::steady_clock::now();
  sweep::Counts counts;
  {
    Progress progress("sweep", static_cast<int>(cells), "cells");
    counts = sweep::work(open.cells, open.store, {shard, options.again}, cell_maker(open, executor),
                         [&](const sweep::Cell& cell, sweep::Outcome outcome, const std::string& sentence) {
                           progress.advance();
                           if (!sentence.empty()) say("{}: {}: {}\n", sweep::name(outcome), open.cells.words(cell), sentence);
                         });
  }
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::string text;
  for (const sweep::Outcome o :
       {sweep::Outcome::had, sweep::Outcome::made, sweep::Outcome::lost, sweep::Outcome::refused, sweep::Outcome::failed})
    if (counts[o] > 0) text += fmt::format(", {} {}", counts[o], sweep::name(o));
  say("shard {}/{}: {}{} in {}\n", shard.number, shard.count, counted(cells, "cell"), text, duration_text(seconds));
  return counts.is_whole() ? 0 : 1;
}

/// Number of processes that died while making a cell, of this plan or another.
std::size_t all_deaths(const fs::path& out) {
  std::size_t count = 0;
  std::error_code error;
  const sweep::Store store(out);
  std::set<std::string> ids;
  for (fs::directory_iterator i(out / "tries", error), end; !error && i != end; i.increment(error))
    ids.insert(path_text(i->path().filename()).substr(0, 32));
  for (const std::string& id : ids) count += static_cast<std::size_t>(store.tries(id).dead);
  return count;
}

}  // namespace

int sweep_run(const SweepOptions& options) {
  if (std::getenv(worker)) return work(options);
  for (std::size_t deaths = all_deaths(options.out);;) {
    const int code = run_own_program(own_arguments(), fmt::format("{}=1", worker));
    if (code >= 0) return code;
    if (is_interruption(-code)) return 128 - code;
    const std::size_t now = all_deaths(options.out);
    complain(fmt::format("a process of this sweep died of {}{}", death_text(code), now > deaths ? "; another one goes on" : ""));
    // Each death that counts uses up a try of a cell, so this ends.
    if (now <= deaths) return static_cast<int>(ExitCode::internal);
    deaths = now;
  }
}

}  // namespace rainref::cli
