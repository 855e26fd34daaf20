// What is traced of an effect on a pane of glass: its pictures, and its passes against them.
#pragma once

#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <nlohmann/json.hpp>

#include "capture/pass_clock.h"
#include "cli/truth.h"
#include "compositor/parameters.h"
#include "compositor/truth_pixels.h"

namespace rainref::cli {

/// An effect's own parameters, those of traced pictures, and the pane's thickness, of the corrected variant.
inline std::vector<scene::Parameter> with_pane_tracing(std::span<const scene::Parameter> own) {
  std::vector<scene::Parameter> all(own.begin(), own.end());
  for (scene::Parameter& p : compositor::parameters()) all.push_back(std::move(p));
  all.push_back(compositor::pane_thickness().only("corrected"));
  return all;
}

/// View: what the compositor knows of an effect, with scene(rendered), camera(), width(), height() and display(radiance, executor), and a
/// compare(rendered, view, options, executor) beside it. It is made when something is to be
/// traced, so that one that cannot be is refused before the first frame.
template <class View>
class PaneTracing {
 public:
  PaneTracing(const compositor::Choice& choice, const parallel::Executor& executor,
              std::function<View(const compositor::TracerOptions&)> make)
      : choice_(choice), executor_(executor), make_(std::move(make)) {}

  /// Before the first frame, when passes are to be compared. Throws Error(usage) for what cannot be traced.
  bool has_truth() const {
    view();
    return true;
  }

  /// Whether the scene wants traced pictures.
  bool is_traced() const { return choice_.is_traced; }
  void show(bool is_shown) { is_shown_ = is_shown; }
  template <class Rendered>
  void trace(const Rendered& rendered, int frame, Recorder* recorder) {
    if (!is_shown_) return;
    capture::Stopwatch time;
    const View& v = view();
    picture_ = compositor::trace_picture(*v.scene(rendered), v.camera(), v.width(), v.height(), choice_.picture, executor_);
    shown_ = v.display(picture_.beauty, executor_);
    report_traced(recorder, frame, picture_, shown_, time.seconds());
  }
  const Image& shown() const { return shown_; }
  void write_exr(const std::filesystem::path& path) const { write_traced_exr(path, picture_); }
  template <class Rendered>
  nlohmann::ordered_json write_truth(const Rendered& rendered, const std::filesystem::path& stem) {
    const compositor::PaneTruth truth = compare(rendered, view(), choice_.picture, executor_);
    nlohmann::ordered_json out;
    for (const auto& [name, count] : truth.pixels) out[name] = count;
    out["differences"] = write_differences(stem, truth.differences);
    return out;
  }

 private:
  const View& view() const {
    if (!view_) view_.emplace(make_(choice_.tracer));
    return *view_;
  }
  compositor::Choice choice_;
  const parallel::Executor& executor_;
  std::function<View(const compositor::TracerOptions&)> make_;
  mutable std::optional<View> view_;
  bool is_shown_ = true;
  compositor::Picture picture_;
  Image shown_;
};

}  // namespace rainref::cli
