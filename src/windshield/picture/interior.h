// What of the car's inside stands before the glass: the pillar beside it and the dashboard's edge under it. A picture drawn once.
#pragma once

#include <array>

#include "rainref/executor.h"
#include "rainref/image.h"
#include "windshield/picture/interior.pass.h"
#include "windshield/picture/picture.h"

namespace rainref::windshield {

struct InteriorSettings {
  bool on = false;
  std::array<double, 2> pillar{0.18, 0.29};  ///< u of its inner edge where v is 0 and where it is 1; both 0: none
  double dashboard = 0.17;                   ///< v of its edge; 0: none
  double binnacle = 0.045;                   ///< height of the hood over the instruments, on the image plane at distance 1
  double light = 0.02;                       ///< radiance of its lightest parts
  double reflection = 0.25;                  ///< what the glass mirrors of the dashboard, over its light
};

InteriorUniforms interior_uniforms(const InteriorSettings& settings);

/// rgba16f of the picture's size, premultiplied; row 0 = bottom. Left of the pillar's edge and under the dashboard's alpha is 1; between,
/// an edge is as wide as the eye's pupil, 5 mm at the depth of the glass, for who looks at the street. Over the dashboard the glass mirrors
/// it: light of alpha 0. The hood stands straight ahead of the eye, along the car's x axis. glass: through which the eye looks.
Image draw_interior(const InteriorSettings& settings, const PictureSettings& picture, const Corners& glass,
                    const parallel::Executor& executor);

}  // namespace rainref::windshield
