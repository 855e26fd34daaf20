// A scene that a page runs, by the operations that the page names. src/web/pages/live_operations.js has the same operations for the library
// that runs in the page.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "base/hidden.h"
#include "cli/view/scene_list.h"
#include "cli/view/server.h"
#include "rainref/executor.h"
#include "rainref/simulation.h"

namespace rainref::cli {

/// The result of an operation: a value, and bytes that the page finds in it under the name `member`.
struct Result {
  std::string json, member{};
  std::vector<std::byte> bytes{};
};
/// Tells the page how far an operation is. Returns false if the page is gone.
using Advance = std::function<bool(int done, int of)>;

class Session {
 public:
  /// `scenes` must outlive it. threads: as for Executor.
  Session(const SceneList& scenes, int threads) : scenes_(scenes), executor_(threads) {}

  /// Runs an operation; calls from several threads run one after the other. `sent.args`: an object with its arguments. Throws Error.
  ///   describe {}: {effects, version, generation, offers, where}
  ///   open {text, file, known?, sets}, and the scene's files: {effect, variant, frame, frames, sceneJson, warnings}. `known`: the scene of
  ///     the list that names files relative to its own folder. After an error the open scene stays.
  ///   set {key, value}: the same, after Simulation::set
  ///   step {}: the next frame: {lines, milliseconds, width, height}, picture: RGBA of 8 bits, top row first
  ///   film {frames, kind}: the open scene from its first frame on, with the keys as they are now: {}, film: a file
  Result run(std::string_view operation, const Sent& sent, const Advance& advance);

 private:
  Result describe() const;
  Result open(const nlohmann::ordered_json& args, const Sent& sent);
  Result set(const nlohmann::ordered_json& args);
  Result step();
  Result film(const nlohmann::ordered_json& args, const Advance& advance) const;
  Result info() const;
  Simulation& opened();

  const SceneList& scenes_;
  parallel::Executor executor_;
  std::mutex one_at_a_time_;
  SceneText scene_;                // of running_, with the keys set since
  std::unique_ptr<Hidden> files_;  // that the page sent
  std::unique_ptr<Simulation> running_;
};

}  // namespace rainref::cli
