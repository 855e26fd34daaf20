// Tracing of effects on a pane of glass.
#pragma once

#include "truth/tracing.h"

namespace rainref::truth {

/// View: the traced pane of an effect, with scene(running), camera(), width(), height(), display(radiance, executor) and compare(running,
/// options, executor).
template <class View, class Instance>
class PaneTracing : public Tracing {
 public:
  Comparison compare() override {
    look_outside();
    return view_.compare(instance_.running(), choice().picture, executor());
  }

 protected:
  PaneTracing(const scene::Config& config, const Instance& instance, View view, const parallel::Executor& on)
      : Tracing(choice_from(config), on), instance_(instance), view_(std::move(view)) {}
  /// Gives the view the pictures of the last rendered frame, if those change.
  virtual void look_outside() {}
  const Instance& instance() const { return instance_; }
  View& view() { return view_; }

 private:
  Picture picture() override {
    look_outside();
    return trace_picture(*view_.scene(instance_.running()), view_.camera(), view_.width(), view_.height(), choice().picture, executor());
  }
  Image display(const Image& radiance) const override { return view_.display(radiance, executor()); }

  const Instance& instance_;
  View view_;
};

}  // namespace rainref::truth
