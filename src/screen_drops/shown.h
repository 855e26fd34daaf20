// What the corrected pass drops takes the water to be and to do: for judging it against traced light, not a pass.
#pragma once

#include <array>
#include <vector>

#include "image/texture.h"
#include "rainref/screen_drops.h"
#include "scene/camera.h"
#include "screen_drops/uniforms.h"

namespace rainref::screen_drops {

/// Metres from the eye to the glass, along the view: where glass.height fills the picture.
double glass_distance(const Settings& settings);

/// A drop of the cells, on the glass: a spherical cap of the contact angle. From the picture's lower left corner [m].
struct Cap {
  double x, y, radius;
};
/// Those of a frame, layer by layer, coarser before finer.
std::vector<Cap> caps(const Settings& settings, const Image& cells);

/// The whole picture of the scene as a camera sees it that focuses on the glass: background's text over all of it. rgba16f of the
/// size of `colour`, texel centre (i, j) at ((i + 1/2) / width, (j + 1/2) / height).
Image defocused_scene(const Settings& settings, const Image& colour, const parallel::Executor& executor);

/// What a pixel of drops shows.
struct Shown {
  double cover;         ///< share that is water
  scene::Vector3 bent;  ///< unit direction along which the water shows the scene: right, up, ahead
  double reflected;     ///< share that the water's surface mirrors; 1 beyond the critical angle
};
/// The double evaluation of the pass's text, on the buffers of the frame that was rendered last.
class ShownDrops {
 public:
  ShownDrops(const Settings& settings, const ScreenDrops& rendered);
  Shown at(int column, int row) const;
  /// Of the image plane at distance 1.
  std::array<double, 2> half_size() const { return {uniforms_.half_size[0], uniforms_.half_size[1]}; }

 private:
  DropsUniforms uniforms_;
  TextureData cells_, height_;
};

}  // namespace rainref::screen_drops
