// The variants' names, as tables of parameters and buffers say them.
#pragma once

#include "rainref/variant.h"

namespace rainref::scene {

inline constexpr const char *published = name(Variant::as_published), *correct = name(Variant::corrected);

}  // namespace rainref::scene
