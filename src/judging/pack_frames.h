// Selects the frames of each pass for a pack.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <numeric>
#include <set>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "rainref/recorder.h"
#include "simulation/opened.h"

namespace rainref::judging {

/// The scene at a small size with the same aspect, which renders quickly. The same passes run in the same frames.
inline scene::Config at_small_size(scene::Config config) {
  const scene::Integer2 size = config.integer2("run.size");
  const std::int64_t divisor = std::gcd(size[0], size[1]), width = size[0] / divisor, height = size[1] / divisor;
  const std::int64_t scale = std::min(divisor, (63 + width) / width);
  config.set("run.size", scene::Integer2{scale * width, scale * height}, config.entry("run.size").origin);
  config.set("run.supersample", std::int64_t{1}, config.entry("run.supersample").origin);
  return config;
}

/// Advances one frame. Renders only if one of the frame's rendered passes is wanted.
inline void go_on(simulation::Opened& scene, Recorder& recorder, bool renders) {
  scene.simulate(&recorder);
  if (renders)
    scene.render(&recorder);
  else
    scene.skip(&recorder);
}

/// The frames of each pass: those asked for in which it runs; if there are none, the first in which it runs.
class Frames : public Recorder {
 public:
  explicit Frames(const std::vector<int>& asked) : asked_(asked) {}
  /// Runs the scene in advance until each pass has run in a frame asked for: to the last of these frames, and on to the end of the run
  /// while a pass has not run. After these frames it makes no pictures: a pass of pictures runs in the first one or in none (test:
  /// EveryState.APassOfPicturesRunsInTheFirstOne).
  void follow(simulation::Opened scene, const std::vector<std::string>& passes) {
    first_.clear();
    runs_when_asked_.clear();
    rendered_.clear();
    scene.show(false);
    const int longest = std::max(asked_.back() + 1, static_cast<int>(scene.config().integer("run.frames")));
    for (int frame = 0; frame < longest; ++frame) {
      if (std::all_of(passes.begin(), passes.end(), [&](const std::string& pass) { return runs_when_asked_.contains(pass); })) break;
      if (frame > asked_.back() && std::all_of(passes.begin(), passes.end(), [&](const std::string& pass) { return has(pass); })) break;
      is_rendering_ = false;
      scene.simulate(this);
      if (frame > asked_.back()) continue;
      is_rendering_ = true;
      scene.render(this);
    }
    followed_ = longest;
  }
  /// Says which passes have other frames than those asked for, or none.
  void tell(const std::vector<std::string>& passes, const std::function<void(const std::string&)>& line) const {
    for (const std::string& pass : passes) {
      if (!has(pass))
        line(fmt::format("left out: {} does not run in the first {} frame{}", pass, followed_, followed_ == 1 ? "" : "s"));
      else if (!runs_when_asked_.contains(pass))
        line(fmt::format("added: frame {}, the first in which {} runs", first_.at(pass), pass));
    }
  }
  bool reads(int, std::string_view) const override { return false; }
  void pass(const PassCall& call) override {
    first_.try_emplace(std::string(call.pass), call.frame);
    if (is_asked(call.frame)) runs_when_asked_.emplace(call.pass);
    if (is_rendering_) rendered_.emplace(call.pass);
  }

  /// True if the pass runs when the picture is rendered, not in the simulation step.
  bool is_rendered(const std::string& pass) const { return rendered_.contains(pass); }
  bool has(std::string_view pass) const { return first_.find(pass) != first_.end(); }
  void add(const std::string& pass, int frame) { added_[pass] = frame; }
  bool are_wanted(int frame, std::string_view pass) const {
    if (const auto added = added_.find(pass); added != added_.end() && added->second == frame) return true;
    return runs_when_asked_.find(pass) != runs_when_asked_.end() ? is_asked(frame) : has(pass) && first_.find(pass)->second == frame;
  }
  /// Last frame over all passes.
  int last(const std::vector<std::string>& passes) const {
    int last = 0;
    for (const std::string& pass : passes) last = std::max(last, runs_when_asked_.contains(pass) ? asked_.back() : first_.at(pass));
    for (const auto& [pass, frame] : added_) last = std::max(last, frame);
    return last;
  }

 private:
  bool is_asked(int frame) const { return std::binary_search(asked_.begin(), asked_.end(), frame); }

  const std::vector<int>& asked_;
  std::map<std::string, int, std::less<>> first_, added_;
  std::set<std::string, std::less<>> runs_when_asked_, rendered_;
  int followed_ = 0;
  bool is_rendering_ = false;
};

}  // namespace rainref::judging
