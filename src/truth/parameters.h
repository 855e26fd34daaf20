// Scene parameters of traced pictures, which the command line adds to those of an effect.
#pragma once

#include <vector>

#include "compositor/picture.h"
#include "scene/config.h"
#include "truth/tracer_names.h"

namespace rainref::truth {

/// compositor.picture, .samples, .depth and .embree_config, of corrected variants.
std::vector<scene::Parameter> parameters();
/// compositor.glass_thickness, of what is seen through a pane.
scene::Parameter pane_thickness();
/// Those and the thickness, of corrected panes.
std::vector<scene::Parameter> pane_parameters();

struct Choice {
  bool is_traced = false;  ///< the picture is traced, not the passes'
  PictureOptions picture;
  TracerOptions tracer;
};
/// What a scene chose; where these parameters are not declared, the passes' picture.
Choice choice_from(const scene::Config& config);

}  // namespace rainref::truth
