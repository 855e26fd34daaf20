// What the handles of rainref.h hold.
#pragma once

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "capture/pack_read.h"
#include "capture/pass_case.h"
#include "judge/verdict.h"
#include "rainref.h"
#include "rainref/executor.h"
#include "rainref/simulation.h"
#include "reports/source.h"

struct rr_simulation {
  rainref::parallel::Executor executor;
  rainref::Simulation running;
  std::vector<std::string> buffers;  ///< their names
  std::string scene_json{}, hash_lines{};

  rr_simulation(const rainref::SceneText& scene, int threads) : executor(threads), running(scene, executor), buffers(running.buffers()) {}
};

namespace rainref::c_library {

/// A run of a pass, and what a port gave for it. Both are never changed once they are there: judgements hold them too.
struct Run {
  std::shared_ptr<const capture::PassCase> c;
  std::string id, formula;
  std::vector<std::shared_ptr<const capture::Array>> given{};  ///< one for each output; null: not given

  bool has_any() const;
  bool has_all() const;
};

}  // namespace rainref::c_library

struct rr_cases {
  std::string effect, variant, scene;
  std::vector<rainref::capture::PackPass> passes;  ///< in the order of execution
  std::vector<rainref::capture::PackEdge> edges;
  std::shared_ptr<const rainref::capture::Pack> pack{};  ///< null: of a simulation
  std::vector<rainref::c_library::Run> runs{};           ///< in the order of execution

  const rainref::capture::PackPass* pass(const std::string& name) const;
  void add(rainref::capture::PassCase c);
};

namespace rainref::c_library {

/// A failure and the words for it.
struct WorstElement {
  rr_failure failure;
  std::string case_id, output, field, text;
};

}  // namespace rainref::c_library

struct rr_judgement {
  rainref::judge::PortJudgement judged;
  rainref::reports::PageSource source;
  std::vector<std::vector<rainref::c_library::WorstElement>> worst{};  ///< of each pass
  std::optional<std::string> text{}, json{}, html{};                   ///< made when asked for
};
