// Splashes at edges as a scene says it: opened, run and written like every effect.
#pragma once

#include "effect/effect.h"
#include "rainref/edge_splash.h"

namespace rainref::edge_splash {

/// What the registry holds.
effect::Effect entry();

class Instance final : public effect::InstanceOf<EdgeSplash> {
 public:
  Instance(const Settings& settings, const Inputs& pictures, const parallel::Executor& executor);
  std::vector<PassOutput> buffers() override;
  std::vector<image_io::Layer> layers() const override;
};

}  // namespace rainref::edge_splash
