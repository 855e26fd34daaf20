// The lines of tests/golden/hashes.txt, made of a running effect.
#pragma once

#include <algorithm>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "capture/hashing.h"

namespace rainref::golden {

/// The scene of this name.
template <class S>
S named(const std::vector<S>& scenes, std::string_view name) {
  return *std::ranges::find(scenes, name, &S::name);
}

/// Makes one public call, so that a test may make it as a hostile caller does. The first of a scene opens the effect; the others advance
/// and render it.
using Caller = std::function<void(const std::function<void()>& call)>;
inline void call_plainly(const std::function<void()>& call) { call(); }

/// "scene frame pass buffer hash" for frames 0, 1, 2 and 59, as far as there are so many, of an Effect made with these arguments.
template <class Effect, class... Arguments>
std::vector<std::string> lines_of(const std::string& scene, int frames, const Caller& caller, Arguments&&... arguments) {
  std::optional<Effect> effect;
  caller([&] { effect.emplace(std::forward<Arguments>(arguments)...); });
  std::vector<std::string> lines;
  for (int frame = 0; frame < frames; ++frame) {
    capture::HashRecorder recorder;
    const bool is_golden = frame <= 2 || frame == 59;
    caller([&] { effect->simulate(is_golden ? &recorder : nullptr); });
    caller([&] { effect->render(is_golden ? &recorder : nullptr); });
    for (const capture::HashLine& line : recorder.take_lines()) lines.push_back(fmt::format("{} {}", scene, line.text()));
  }
  return lines;
}

}  // namespace rainref::golden
