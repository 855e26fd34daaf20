// Command line of `rainref sweep`.
#include <functional>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>

#include "base/number_text.h"
#include "base/path_text.h"
#include "cli/option_values.h"
#include "cli/sweep.h"
#include "cli/verbs.h"
#include "rainref/error.h"
#include "rainref/executor.h"

namespace rainref::cli {
namespace {

constexpr int most_shards = 100000;

struct Flags {
  std::string plan, out = "out/sweeps", shard = "0/1", engine, image = "rainref";
  std::optional<std::string> threads, shards, pairs, mask, split, split_seed, to;
  std::vector<std::string> plans;
  SweepOptions options;

  SweepOptions resolved() const {
    SweepOptions o = options;
    require_text(out, "--output", "a folder");
    require_text(engine.empty() ? "-" : engine, "--engine", "an engine");
    o.plan = utf8_path(plans.empty() ? plan : plans.front());
    for (std::size_t i = 1; i < plans.size(); ++i) o.others.push_back(utf8_path(plans[i]));
    o.out = utf8_path(out);
    o.shard = shard;
    o.engine = engine;
    o.image = image;
    if (threads) o.threads = whole_number(*threads, "--threads", 1, parallel::Executor::max_threads);
    if (shards) o.shards = whole_number(*shards, "--shards", 1, most_shards);
    take_pairs(o);
    return o;
  }
  void take_pairs(SweepOptions& o) const {
    for (const auto& [value, option] :
         {std::pair(&mask, "--mask"), std::pair(&split, "--split"), std::pair(&split_seed, "--split-seed"), std::pair(&to, "--to")})
      if (*value && !pairs) throw Error(ExitCode::usage, fmt::format("{}: needs --pairs", option));
    if (!pairs) return;
    const std::vector<std::string> labels = list_of(*pairs);
    if (labels.size() != 2 || labels[0].empty() || labels[1].empty())
      throw Error(ExitCode::usage, fmt::format("--pairs: expected two labels such as clean,rainy, found '{}'", *pairs));
    sweep::PairsAsked& asked = o.pairs.emplace();
    asked.clean = labels[0];
    asked.rainy = labels[1];
    if (mask) {
      require_text(*mask, "--mask", "a channel such as drops.A");
      asked.mask = *mask;
    }
    if (split) {
      const std::optional<double> share = number_from<double>(*split);
      if (!share || !(*share >= 0 && *share <= 1))
        throw Error(ExitCode::usage, fmt::format("--split: expected a number from 0 to 1, found '{}'", *split));
      asked.split = *share;
    }
    if (split_seed) asked.split_seed = whole_number(*split_seed, "--split-seed", 0, 1'000'000'000);
    if (to) {
      require_text(*to, "--to", "a folder");
      o.to = utf8_path(*to);
    }
  }
};

using Action = std::pair<const CLI::App*, int (*)(const SweepOptions&)>;

void add_common(CLI::App& action, Flags& f, bool has_plan = true) {
  if (has_plan) action.add_option("PLAN", f.plan, "File of the plan (TOML)")->type_name("FILE")->required();
  action.add_option("-o,--output", f.out, "Folder of the results, which plans may share (default: out/sweeps)")->type_name("DIR");
}
void add_threads(CLI::App& action, Flags& f, const char* sentence) { action.add_option("--threads", f.threads, sentence)->type_name("N"); }

Action plan_action(CLI::App& verb, Flags& f) {
  CLI::App& action = *verb.add_subcommand("plan", "Check every cell of a plan, and count what there is to do");
  add_common(action, f);
  action.add_flag("--list", f.options.is_listing, "A line for each cell: number, id, values");
  action.add_flag("--trial", f.options.is_trial, "Make the first cell, to tell what the others take");
  action.footer("Example: rainref sweep plan examples/sweeps/pairs_windshield.toml --trial");
  return {&action, sweep_plan};
}
Action run_action(CLI::App& verb, Flags& f) {
  CLI::App& action = *verb.add_subcommand("run", "Make the cells that are not there yet");
  add_common(action, f);
  action
      .add_option("--shard", f.shard,
                  "Of N processes number K, from 0 on; auto: as the array of Slurm, Grid Engine, PBS, Kubernetes or MPI says")
      ->type_name("K/N");
  add_threads(action, f, "Threads; the result does not depend on them");
  action.add_flag("--again", f.options.again, "Try cells again that failed for good, and judge those of a port's command (exec) anew");
  action.footer("Example: rainref sweep run examples/sweeps/rates.toml --shard 0/2 --threads 1");
  return {&action, sweep_run};
}
Action status_action(CLI::App& verb, Flags& f) {
  CLI::App& action = *verb.add_subcommand("status", "What is done; exit code 1 until all is");
  add_common(action, f);
  action.footer("Example: rainref sweep status examples/sweeps/rates.toml");
  return {&action, sweep_status};
}
Action collect_action(CLI::App& verb, Flags& f) {
  CLI::App& action = *verb.add_subcommand("collect", "Check every hash, and write tables and a contact sheet to DIR/plans/NAME");
  add_common(action, f);
  action.add_flag("!--no-sheet", f.options.with_sheet, "No contact sheet");
  action.add_flag("--film", f.options.with_film, "The first run's pictures as a film, where ffmpeg is installed");
  action.add_option("--pairs", f.pairs, "Write a data set too: cells with these two labels, in column `name` of the cases, as pairs")
      ->type_name("CLEAN,RAINY");
  action.add_option("--mask", f.mask, "Channel of the rainy cells' EXR, kept as exr:CHANNEL, as masks of the pairs")->type_name("CHANNEL");
  action.add_option("--split", f.split, "Share of the pairs that is for training (default: 0.9)")->type_name("SHARE");
  action.add_option("--split-seed", f.split_seed, "Another seed makes another split (default: 1)")->type_name("N");
  action.add_option("--to", f.to, "New folder of the data set (default: DIR/plans/NAME/pairs)")->type_name("DIR");
  action.footer("Example: rainref sweep collect examples/sweeps/pairs_screen_drops.toml --pairs clean,rainy --mask drops.A");
  return {&action, sweep_collect};
}
Action gc_action(CLI::App& verb, Flags& f) {
  CLI::App& action = *verb.add_subcommand("gc", "List what no plan named needs");
  add_common(action, f, false);
  action.add_option("PLAN", f.plans, "Plans whose results stay")->type_name("FILE")->required();
  action.add_flag("--remove", f.options.removes,
                  "Remove it: nothing but what bears the name of a cell, a state or a failure, in a folder that `sweep run` has marked");
  action.add_flag("--damaged", f.options.damaged, "Cells too whose files are not what their hashes say: a run makes them again");
  action.footer("Example: rainref sweep gc examples/sweeps/rates.toml --remove");
  return {&action, sweep_gc};
}
Action script_action(CLI::App& verb, Flags& f) {
  CLI::App& action = *verb.add_subcommand("script", "Print what an engine takes");
  add_common(action, f);
  action.add_option("--engine", f.engine, "slurm, parallel, sge or kubernetes")->type_name("NAME")->required();
  action.add_option("--shards", f.shards, "Processes that share the cells (default: 1)")->type_name("N");
  add_threads(action, f, "Threads of each (default: 1)");
  action.add_option("--image", f.image, "Container image, for kubernetes")->type_name("IMAGE");
  action.footer("Example: rainref sweep script examples/sweeps/rates.toml --engine slurm --shards 8 | sh");
  return {&action, sweep_script};
}

}  // namespace

Verb sweep_verb(CLI::App& app) {
  CLI::App& verb = *app.add_subcommand("sweep", "Many scenes, parameters, seeds, or shards of a film, on any number of machines");
  verb.require_subcommand(1);
  verb.footer("`rainref sweep ACTION --help` says what each takes.\nExample: rainref sweep run examples/sweeps/rates.toml");
  const auto f = std::make_shared<Flags>();
  const auto actions = std::make_shared<std::vector<Action>>();
  for (const auto& declare : {plan_action, run_action, status_action, collect_action, gc_action, script_action})
    actions->push_back(declare(verb, *f));
  return {&verb, [f, actions] {
            for (const auto& [parser, act] : *actions)
              if (parser->parsed()) return act(f->resolved());
            throw Error(ExitCode::internal, "no action was parsed");
          }};
}

}  // namespace rainref::cli
