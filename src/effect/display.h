// What an effect's pass display makes of which picture, for a picture that is developed in another way.
#pragma once

#include "rainref/image.h"

namespace rainref::effect {

struct Display {
  enum class Code : std::uint8_t { srgb, power };  ///< IEC 61966-2-1, or the published power 0.4545

  const Image* radiance = nullptr;  ///< linear, four channels of 16 or 32 bits, row 0 = bottom: what display reads
  double exposure = 0;              ///< EV
  double vignette = 0;              ///< loss of light at a distance of the picture's width, or height, from its centre
  Code code = Code::srgb;
};

}  // namespace rainref::effect
