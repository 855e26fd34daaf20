// The camera in a uniform block.
#pragma once

#include <vector>

#include "puddle/uniforms.h"
#include "scene/uniform_block.h"

namespace rainref::puddle {

/// The members of a block whose first member is a CameraUniforms named camera, followed by these.
template <class Block>
std::vector<scene::Member> with_camera(std::vector<scene::Member> rest) {
  using scene::member;
  using C = CameraUniforms;
  std::vector<scene::Member> all =
      scene::nested<&Block::camera>("camera", {member<&C::position>("m", {-1e5, 1e5}, "Eye."),
                                               member<&C::pixel_scale>("1", {0, 23}, "Height of a pixel on the image plane at distance 1."),
                                               member<&C::right>("1", scene::component, "Unit vector to the right of the picture."),
                                               member<&C::plane_left>("1", {-1e6, 0}, "Left edge of the image plane at distance 1."),
                                               member<&C::up>("1", scene::component, "Unit vector to the top of the picture."),
                                               member<&C::plane_bottom>("1", {-12, 0}, "Bottom edge of the image plane at distance 1."),
                                               member<&C::forward>("1", scene::component, "Unit vector into the picture.")});
  all.insert(all.end(), rest.begin(), rest.end());
  return all;
}

}  // namespace rainref::puddle
