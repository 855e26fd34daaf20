// The water and the refraction of the corrected pass drops, for comparison with traced light. Not a pass.
#pragma once

#include <array>
#include <vector>

#include "image/texture.h"
#include "rainref/screen_drops.h"
#include "scene/camera.h"
#include "screen_drops/uniforms.h"

namespace rainref::screen_drops {

/// Distance from the eye to the glass along the view [m], at which glass.height fills the picture.
double glass_distance(const Settings& settings);

/// A drop of the cells on the glass: a spherical cap with the contact angle. Position from the picture's lower left corner [m].
struct Cap {
  double x, y, radius;
};
/// The caps of a frame, layer by layer, coarser before finer.
std::vector<Cap> caps(const Settings& settings, const Image& cells);
/// Those that do not lie wholly inside one of a coarser layer, which the pass draws over them.
std::vector<Cap> shown_caps(const Settings& settings, const Image& cells);

/// The scene as a camera focused on the glass sees it: the text of background over the whole picture. rgba16f of the size of `colour`,
/// texel centre (i, j) at ((i + 1/2) / width, (j + 1/2) / height).
Image defocused_scene(const Settings& settings, const Image& colour, const parallel::Executor& executor);

/// The water and the scene at a pixel of drops.
struct Shown {
  double cover;         ///< share that is water
  scene::Vector3 bent;  ///< unit direction in which the water shows the scene: right, up, ahead
  double reflected;     ///< share that the water's surface mirrors; 1 beyond the critical angle
};
/// Evaluates the pass's text in double, on the buffers of the last rendered frame.
class ShownDrops {
 public:
  ShownDrops(const Settings& settings, const ScreenDrops& rendered);
  Shown at(int column, int row) const;
  /// Half size of the picture on the image plane at distance 1.
  std::array<double, 2> half_size() const { return {uniforms_.half_size[0], uniforms_.half_size[1]}; }

 private:
  DropsUniforms uniforms_;
  TextureData cells_, height_;
};

}  // namespace rainref::screen_drops
