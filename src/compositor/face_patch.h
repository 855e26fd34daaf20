// The part of a pane's face where some condition holds: wet or dry, in front of something or not.
#pragma once

#include <functional>
#include <memory>

#include "compositor/pane.h"
#include "compositor/pane_scene.h"

namespace rainref::compositor {

class FacePatch : public PaneFace {
 public:
  /// is_there: of (u, v) on the pane; a pure function.
  FacePatch(const Pane& pane, double lift, std::function<bool(double, double)> is_there)
      : PaneFace(pane, lift), is_there_(std::move(is_there)) {}

 protected:
  bool is_there(double u, double v) const override { return is_there_(u, v); }

 private:
  std::function<bool(double, double)> is_there_;
};

/// Adds inner face, dry and wet outer face, as add_pane does; the water's surface and the rim are the caller's.
inline void add_faces(Scene& scene, const Pane& pane, const std::function<bool(double, double)>& is_wet, const PaneMedia& media = {}) {
  scene.add(std::make_shared<PaneFace>(pane, -pane.shape().thickness), Material::interface_of(media.pane, media.within));
  scene.add(std::make_shared<FacePatch>(pane, 0, [is_wet](double u, double v) { return !is_wet(u, v); }),
            Material::interface_of(media.outside, media.pane));
  scene.add(std::make_shared<FacePatch>(pane, 0, is_wet), Material::interface_of(media.water, media.pane));
}

}  // namespace rainref::compositor
