// Splashes at edges as a scene says it: opened, run and written like every effect.
#pragma once

#include "edge_splash/film.h"
#include "effect/effect.h"
#include "rainref/edge_splash.h"

namespace rainref::edge_splash {

/// What the registry holds.
effect::Effect entry();

class Instance final : public effect::InstanceOf<EdgeSplash> {
 public:
  /// `pictures`: of the film's frame 0, or made.
  Instance(const Settings& settings, const Inputs& pictures, Film film, const parallel::Executor& executor);
  std::vector<PassOutput> buffers() override;
  std::vector<image_io::Layer> layers() const override;
  bool has_film() const override { return film_.moves(); }

 private:
  void show_pictures_of(int frame) override;

  Film film_;
  Film::Shown shown_;
};

}  // namespace rainref::edge_splash
