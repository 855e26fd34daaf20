// The actions of `rainref sweep`.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "base/path_text.h"
#include "sweep/cells.h"
#include "sweep/pairs.h"
#include "sweep/script.h"
#include "sweep/shard.h"
#include "sweep/store.h"
#include "sweep/work.h"

namespace rainref::cli {

/// A plan, its cells, and their folder.
struct OpenPlan {
  std::unique_ptr<sweep::Plan> plan;
  sweep::Cells cells;
  sweep::Store store;

  OpenPlan(const std::filesystem::path& file, const std::filesystem::path& out);
  /// The folder of the plan's tables.
  std::filesystem::path tables() const { return store.root() / "plans" / utf8_path(plan->name()); }
};

/// A progress bar for checking the cells of a large plan.
sweep::Planned planning_progress();

struct SweepOptions {
  std::filesystem::path plan, out;
  bool is_listing = false, is_trial = false;  ///< of plan
  std::string shard = "0/1";                  ///< of run
  int threads = 0;
  bool again = false;
  bool with_sheet = true, with_film = false;  ///< of collect
  std::optional<sweep::PairsAsked> pairs;     ///< of collect: a data set is wanted
  std::filesystem::path to;                   ///< its folder; "": in the tables' folder
  std::vector<std::filesystem::path> others;  ///< of gc: further plans
  bool removes = false, damaged = false;
  std::string engine, image;  ///< of script
  std::int64_t shards = 1;
};

int sweep_plan(const SweepOptions& options);
/// Runs in a child process that may die; then starts another that continues.
int sweep_run(const SweepOptions& options);
int sweep_status(const SweepOptions& options);
int sweep_collect(const SweepOptions& options);
int sweep_gc(const SweepOptions& options);
int sweep_script(const SweepOptions& options);

/// Returns the function that makes a cell of this plan. The executor must outlive it.
sweep::Maker cell_maker(const OpenPlan& open, const parallel::Executor& executor);

}  // namespace rainref::cli
