// What a windshield takes.
#pragma once

#include <array>

#include "base/memory.h"
#include "windshield/parameters.h"

namespace rainref::windshield {

/// Of the constructor and of so many frames. scene: columns and rows of a picture that takes the street's place, which the windshield then
/// owns; 0: the street.
MemoryPeak memory(const Settings& settings, int frames, std::array<int, 2> scene = {0, 0});

/// Drops of falling_rain in view at the most, in so many seconds.
double most_falling(const Settings& settings, double seconds);

}  // namespace rainref::windshield
