// Names of the tracer's scenes, surfaces and pictures without their namespace, for this room.
#pragma once

#include "compositor/picture.h"

namespace rainref::truth {

using namespace compositor;

}  // namespace rainref::truth
