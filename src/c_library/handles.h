// The contents of the handles of rainref.h.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "judging/case_list.h"
#include "judging/judge_cases.h"
#include "rainref.h"
#include "rainref/executor.h"
#include "rainref/simulation.h"

struct rr_simulation {
  rainref::parallel::Executor executor;
  rainref::Simulation running;
  std::vector<std::string> buffers;  ///< names
  std::string scene_json{}, hash_lines{}, notes{};

  rr_simulation(const rainref::SceneText& scene, int threads) : executor(threads), running(scene, executor), buffers(running.buffers()) {}
};

struct rr_cases {
  rainref::judging::CaseList list;
};

struct rr_judgement {
  rainref::judging::Judged made;
  std::optional<std::string> text{}, json{}, html{}, junit{};  ///< made on demand
};
